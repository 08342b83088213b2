// SPDX-License-Identifier: MIT
#include "strand_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numbers>
#include <string_view>
#include <unordered_map>

namespace forelock::samples {
namespace {

// Reorders `values`.
template <class T> Spread spreadOf(std::vector<T>& values) {
  Spread spread;
  if (values.empty()) return spread;
  double sum = 0;
  for (const T value : values) sum += double(value);
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  spread = {double(*least), 0, sum / double(values.size()), double(*most)};
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  spread.median = double(*middle);
  if (values.size() % 2 == 0) spread.median = 0.5 * (spread.median + double(*std::max_element(values.begin(), middle)));
  return spread;
}

std::vector<RankedStrand> rank(const std::vector<float>& values, size_t count, bool descending) {
  std::vector<uint32_t> order(values.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  count = std::min(count, order.size());
  std::partial_sort(order.begin(), order.begin() + std::ptrdiff_t(count), order.end(), [&](uint32_t a, uint32_t b) {
    return values[a] != values[b] ? (descending ? values[a] > values[b] : values[a] < values[b]) : a < b;
  });
  std::vector<RankedStrand> ranked;
  for (size_t i = 0; i < count; ++i) ranked.push_back({order[i], double(values[order[i]])});
  return ranked;
}

std::string text(const char* format, double a, double b = 0) {
  char line[200];
  std::snprintf(line, sizeof line, format, a, b);
  return line;
}

}  // namespace

StrandStatistics measureStrands(const FlkStrands& strands, size_t ranked) {
  StrandStatistics result;
  std::vector<float> segments, turns, widths, lengths(strands.strand_count), sharpest(strands.strand_count), uneven;
  segments.reserve(strands.vertex_count);
  turns.reserve(strands.vertex_count);
  std::vector<uint32_t> counts(strands.strand_count);
  double all = 0;
  result.min_bounds.fill(std::numeric_limits<double>::max());
  result.max_bounds.fill(-std::numeric_limits<double>::max());
  for (uint32_t strand = 0; strand < strands.strand_count; ++strand) {
    const uint32_t begin = strands.first_vertex[strand], end = strands.first_vertex[strand + 1];
    counts[strand] = end - begin;
    double length = 0, longest = 0, worst = 0;
    std::array<double, 3> before{};
    double before_length = 0;
    for (uint32_t v = begin; v < end; ++v) {
      const float* p = strands.positions + 3 * size_t(v);
      for (size_t axis = 0; axis < 3; ++axis) {
        result.min_bounds[axis] = std::min(result.min_bounds[axis], double(p[axis]) - double(strands.radii[v]));
        result.max_bounds[axis] = std::max(result.max_bounds[axis], double(p[axis]) + double(strands.radii[v]));
      }
      if (v + 1 == end) break;
      const std::array<double, 3> step{double(p[3]) - double(p[0]), double(p[4]) - double(p[1]), double(p[5]) - double(p[2])};
      const double size = std::hypot(step[0], step[1], step[2]);
      segments.push_back(float(size));
      length += size;
      longest = std::max(longest, size);
      if (size <= 0) continue;
      if (before_length > 0) {
        const double cosine = (step[0] * before[0] + step[1] * before[1] + step[2] * before[2]) / (size * before_length);
        const double turn = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
        turns.push_back(float(turn));
        worst = std::max(worst, turn);
      }
      before = step;
      before_length = size;
    }
    lengths[strand] = float(length);
    sharpest[strand] = float(worst);
    uneven.push_back(float(length > 0 ? longest * (end - begin - 1) / length : 1));
    all += length;
    for (size_t axis = 0; axis < 3; ++axis)
      result.direction[axis] += double(strands.positions[3 * (size_t(end) - 1) + axis]) - double(strands.positions[3 * size_t(begin) + axis]);
  }
  for (double& axis : result.direction) axis = all > 0 ? axis / all : 0;
  result.longest = rank(lengths, ranked, true);
  result.shortest = rank(lengths, ranked, false);
  result.sharpest = rank(sharpest, ranked, true);
  result.vertices = spreadOf(counts);
  result.length = spreadOf(lengths);
  result.segment_length = spreadOf(segments);
  result.turn_degrees = spreadOf(turns);
  result.unevenness = spreadOf(uneven);
  widths.assign(strands.radii, strands.radii + strands.vertex_count);
  for (float& width : widths) width *= 2;
  result.width = spreadOf(widths);
  const std::vector<uint32_t> first = firstOfEqualStrands(strands);
  for (uint32_t strand = 0; strand < first.size(); ++strand) result.duplicates += first[strand] != strand;
  return result;
}

std::vector<uint32_t> firstOfEqualStrands(const FlkStrands& strands) {
  std::vector<uint32_t> first(strands.strand_count);
  std::unordered_map<std::string_view, uint32_t> known;
  known.reserve(strands.strand_count);
  for (uint32_t strand = 0; strand < strands.strand_count; ++strand) {
    const size_t begin = strands.first_vertex[strand], end = strands.first_vertex[strand + 1];
    const std::string_view bytes(reinterpret_cast<const char*>(strands.positions + 3 * begin), 12 * (end - begin));
    first[strand] = known.try_emplace(bytes, strand).first->second;
  }
  return first;
}

Guess guessUnit(const FlkAssetInfo& info) {
  double reach = 0, size = 0;
  for (int axis = 0; axis < 3; ++axis) {
    reach = std::max({reach, std::abs(double(info.min_bounds[axis])), std::abs(double(info.max_bounds[axis]))});
    size = std::max(size, double(info.max_bounds[axis]) - double(info.min_bounds[axis]));
  }
  // The bounds of the finding UNIT_SUSPECT: a person is below 10 m, below 1,000 cm, and above a millimetre.
  if (reach > 1000) return {"mm", text("coordinates reach %.4g", reach)};
  if (reach > 10) return {"cm", text("coordinates reach %.4g", reach)};
  if (size < 1e-3) return {"", text("the hair is only %.3g across", size)};
  return {"m", text("the hair is %.3g across and coordinates reach %.3g", size, reach)};
}

Guess guessUpAxis(const FlkAssetInfo& info, const StrandStatistics& numbers) {
  constexpr const char* names[] = {"x", "y", "z"};
  std::array<double, 3> middle{}, half{};
  for (size_t axis = 0; axis < 3; ++axis) {
    middle[axis] = 0.5 * (double(info.min_bounds[axis]) + double(info.max_bounds[axis]));
    half[axis] = 0.5 * (double(info.max_bounds[axis]) - double(info.min_bounds[axis]));
  }
  // Characters stand on the origin, so that the hair of a head is above it; that says more than which way the hair lies.
  for (size_t axis = 0; axis < 3; ++axis) {
    const double others = std::max(std::abs(middle[(axis + 1) % 3]), std::abs(middle[(axis + 2) % 3]));
    if (middle[axis] > 1.4 * half[axis] && middle[axis] > 2 * others)
      return {names[axis], text("the hair is above the origin along it, from %.3g to %.3g", double(info.min_bounds[axis]), double(info.max_bounds[axis]))};
  }
  const std::array<double, 3>& lies = numbers.direction;
  for (size_t axis = 1; axis < 3; ++axis) {  // no program has x up
    if (std::abs(lies[axis]) < 0.6 || std::abs(lies[axis]) < 0.85 * std::hypot(lies[0], lies[1], lies[2])) continue;
    return {names[axis], text(lies[axis] < 0 ? "the hair hangs down along it: its tips are %.2g of a length below the roots, on average"
                                              : "the hair stands up along it: its tips are %.2g of a length above the roots, on average",
                              std::abs(lies[axis]))};
  }
  return {"", "the hair is around the origin and lies in all directions"};
}

double followWidthScale(const FlkAssetInfo& info, uint32_t follow) {
  double side = 0;
  for (int axis = 0; axis < 3; ++axis) side = std::max(side, double(info.max_bounds[axis]) - double(info.min_bounds[axis]));
  const double wanted = side / 5000 * std::max(1.0, 1e5 / (double(info.strand_count) * (1.0 + follow))), held = 2 * double(info.max_radius);
  return follow > 0 && held > wanted ? wanted / held : 1;
}

uint64_t hairBytes(const FlkAssetInfo& info) {
  const uint64_t vertices = info.vertex_count;
  return vertices * 16 + (vertices - info.strand_count) * 4 + (info.has_colors ? vertices * 4 : 0);
}

}  // namespace forelock::samples
