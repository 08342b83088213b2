// SPDX-License-Identifier: MIT
#include "strand_lod.h"

#include "strand_coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace forelock::samples {
namespace {

constexpr size_t kAxes = 6;  // root and tip
using Key = std::array<float, kAxes>;

// Sorts [begin, end) into an order with the property that every prefix is even.
void orderEvenly(const std::vector<Key>& keys, std::vector<uint32_t>& order, std::vector<uint32_t>& scratch, size_t begin, size_t end) {
  if (end - begin < 3) return;
  size_t axis = 0;
  float widest = -1;
  for (size_t a = 0; a < kAxes; ++a) {
    float low = keys[order[begin]][a], high = low;
    for (size_t i = begin + 1; i < end; ++i) low = std::min(low, keys[order[i]][a]), high = std::max(high, keys[order[i]][a]);
    if (high - low > widest) widest = high - low, axis = a;
  }
  const size_t middle = begin + (end - begin + 1) / 2;  // the half that begins has one more where the number is odd
  std::nth_element(order.begin() + std::ptrdiff_t(begin), order.begin() + std::ptrdiff_t(middle), order.begin() + std::ptrdiff_t(end),
                   [&](uint32_t a, uint32_t b) { return keys[a][axis] != keys[b][axis] ? keys[a][axis] < keys[b][axis] : a < b; });
  orderEvenly(keys, order, scratch, begin, middle);
  orderEvenly(keys, order, scratch, middle, end);
  for (size_t i = begin; i < end; ++i) scratch[i] = order[i];
  for (size_t i = begin; i < end; ++i) order[i] = (i - begin) % 2 == 0 ? scratch[begin + (i - begin) / 2] : scratch[middle + (i - begin) / 2];
}

}  // namespace

std::vector<uint32_t> evenOrder(const EditableStrands& strands) {
  std::vector<Key> keys(strands.strands());
  for (uint32_t strand = 0; strand < strands.strands(); ++strand)
    for (size_t a = 0; a < 3; ++a) {
      keys[strand][a] = strands.positions[3 * size_t{strands.first_vertex[strand]} + a];
      keys[strand][3 + a] = strands.positions[3 * (size_t{strands.first_vertex[strand + 1]} - 1) + a];
    }
  std::vector<uint32_t> order(strands.strands()), scratch(order.size());
  std::iota(order.begin(), order.end(), 0u);
  orderEvenly(keys, order, scratch, 0, order.size());
  return order;
}

void orderStrands(EditableStrands& strands, const std::vector<uint32_t>& order) {
  EditableStrands ordered;
  ordered.first_vertex.push_back(0);
  for (const uint32_t strand : order) appendStrand(ordered, strands, strand);
  strands = std::move(ordered);
}

LodReport keepFirstStrands(EditableStrands& strands, uint32_t count, double opacity) {
  if (strands.radii.empty()) throw std::invalid_argument("strands without widths cannot be widened");
  LodReport report;
  report.kept = std::min(count, strands.strands());
  const CoverageMeter meter(strands, opacity);
  report.coverage_before = report.coverage_after = meter.measure(strands, 1);
  const double all = strands.strands();
  std::vector<uint32_t> first(report.kept);
  std::iota(first.begin(), first.end(), 0u);
  if (report.kept == strands.strands()) return report;
  orderStrands(strands, first);
  // Coverage grows with width, in a nearly straight line over its logarithm: secants from what the number of strands asks for.
  double before = 0, before_off = 0, widening = all / report.kept;
  for (int step = 0; step < 12; ++step) {
    report.widening = std::clamp(widening, 0.25, 4 * all / report.kept);
    report.coverage_after = meter.measure(strands, report.widening);
    const double off = report.coverage_after - report.coverage_before, at = std::log(report.widening);
    if (std::abs(off) <= 1e-3 * report.coverage_before) break;
    const double slope = step == 0 ? 0.5 * report.coverage_before : (off - before_off) / (at - before);
    if (!(slope > 0)) break;  // both at a limit
    before = at, before_off = off;
    widening = std::exp(at - off / slope);
  }
  for (float& radius : strands.radii) radius = float(radius * report.widening);
  return report;
}

}  // namespace forelock::samples
