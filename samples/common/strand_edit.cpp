// SPDX-License-Identifier: MIT
#include "strand_edit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace forelock::samples {
namespace {

double distance(const float* a, const float* b) {
  return std::hypot(double(a[0]) - double(b[0]), double(a[1]) - double(b[1]), double(a[2]) - double(b[2]));
}

template <class T> void reverseRecords(std::vector<T>& values, size_t begin, size_t end, size_t size) {
  if (values.empty()) return;
  for (size_t a = begin, b = end; a + 1 < b; ++a) {
    --b;
    std::swap_ranges(&values[a * size], &values[a * size] + size, &values[b * size]);
  }
}

template <class T> void append(std::vector<T>& to, const std::vector<T>& from, size_t begin, size_t end) {
  if (!from.empty()) to.insert(to.end(), from.begin() + std::ptrdiff_t(begin), from.begin() + std::ptrdiff_t(end));
}

}  // namespace

std::vector<double> lengthsAlong(const EditableStrands& strands, uint32_t strand) {
  std::vector<double> along{0};
  for (size_t v = strands.first_vertex[strand] + size_t{1}; v < strands.first_vertex[strand + 1]; ++v)
    along.push_back(along.back() + distance(&strands.positions[3 * v], &strands.positions[3 * v - 3]));
  return along;
}

void appendStrand(EditableStrands& to, const EditableStrands& from, uint32_t strand) {
  const size_t begin = from.first_vertex[strand], end = from.first_vertex[strand + 1];
  append(to.positions, from.positions, 3 * begin, 3 * end);
  append(to.radii, from.radii, begin, end);
  append(to.inverse_masses, from.inverse_masses, begin, end);
  append(to.colors, from.colors, 3 * begin, 3 * end);
  append(to.root_uvs, from.root_uvs, 2 * size_t{strand}, 2 * size_t{strand} + 2);
  to.first_vertex.push_back(to.first_vertex.back() + uint32_t(end - begin));
}

FlkStrands EditableStrands::view() const {
  const auto orNone = [](const std::vector<float>& values) { return values.empty() ? nullptr : values.data(); };
  return {FLK_TYPE_STRANDS, nullptr, strands(), vertices(), first_vertex.data(), positions.data(), orNone(radii), orNone(root_uvs),
          orNone(inverse_masses), orNone(colors)};
}

EditableStrands editableStrands(const FlkStrands& held, bool with_radii) {
  const size_t vertices = held.vertex_count, strands = held.strand_count;
  const auto copy = [](const float* values, size_t count) { return values ? std::vector<float>(values, values + count) : std::vector<float>(); };
  return {{held.first_vertex, held.first_vertex + strands + 1}, copy(held.positions, 3 * vertices), copy(with_radii ? held.radii : nullptr, vertices),
          copy(held.root_uvs, 2 * strands), copy(held.inverse_masses, vertices), copy(held.colors, 3 * vertices)};
}

void scaleStrands(EditableStrands& strands, double factor) {
  for (float& value : strands.positions) value = float(value * factor);
  for (float& value : strands.radii) value = float(value * std::abs(factor));
}

bool AxisMap::mirrors() const {
  const bool odd = from == std::array<int, 3>{0, 2, 1} || from == std::array<int, 3>{2, 1, 0} || from == std::array<int, 3>{1, 0, 2};
  return odd != (sign[0] * sign[1] * sign[2] < 0);
}

AxisMap parseAxes(const std::string& text) {
  AxisMap map;
  std::array<bool, 3> taken{};
  size_t at = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) {
      if (at >= text.size() || text[at] != ',') throw std::invalid_argument("is " + text + ", must be three axes like x,-z,y");
      ++at;
    }
    if (at < text.size() && (text[at] == '-' || text[at] == '+')) map.sign[size_t(axis)] = text[at++] == '-' ? -1.0f : 1.0f;
    const int from = at < text.size() ? text[at++] - 'x' : -1;
    if (from < 0 || from > 2) throw std::invalid_argument("is " + text + ", must be three axes like x,-z,y");
    if (taken[size_t(from)]) throw std::invalid_argument("is " + text + ", must name each of x, y and z once");
    taken[size_t(from)] = true;
    map.from[size_t(axis)] = from;
  }
  if (at != text.size()) throw std::invalid_argument("is " + text + ", must be three axes like x,-z,y");
  return map;
}

void mapAxes(EditableStrands& strands, const AxisMap& map) {
  for (size_t i = 0; i < strands.positions.size(); i += 3) {
    const std::array<float, 3> old{strands.positions[i], strands.positions[i + 1], strands.positions[i + 2]};
    for (size_t axis = 0; axis < 3; ++axis) strands.positions[i + axis] = map.sign[axis] * old[size_t(map.from[axis])];
  }
}

void flipV(EditableStrands& strands) {
  for (size_t i = 1; i < strands.root_uvs.size(); i += 2) strands.root_uvs[i] = 1 - strands.root_uvs[i];
}

void reverseStrands(EditableStrands& strands) {
  for (uint32_t strand = 0; strand < strands.strands(); ++strand) {
    const size_t begin = strands.first_vertex[strand], end = strands.first_vertex[strand + 1];
    reverseRecords(strands.positions, begin, end, 3);
    reverseRecords(strands.radii, begin, end, 1);
    reverseRecords(strands.inverse_masses, begin, end, 1);
    reverseRecords(strands.colors, begin, end, 3);
  }
}

std::array<double, 3> recentreStrands(EditableStrands& strands) {
  std::array<double, 3> shift{};
  for (size_t axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::max(), high = -low;
    for (size_t i = axis; i < strands.positions.size(); i += 3)
      low = std::min(low, double(strands.positions[i])), high = std::max(high, double(strands.positions[i]));
    shift[axis] = -0.5 * (low + high);
    for (size_t i = axis; i < strands.positions.size(); i += 3) strands.positions[i] = float(strands.positions[i] + shift[axis]);
  }
  return shift;
}

uint32_t removeShortStrands(EditableStrands& strands, double length) {
  EditableStrands kept;
  kept.first_vertex.push_back(0);
  for (uint32_t strand = 0; strand < strands.strands(); ++strand)
    if (lengthsAlong(strands, strand).back() >= length) appendStrand(kept, strands, strand);
  const uint32_t removed = strands.strands() - kept.strands();
  strands = std::move(kept);
  return removed;
}

ResampleReport resampleStrands(EditableStrands& strands, uint32_t vertices) {
  ResampleReport report;
  EditableStrands even;
  even.root_uvs = strands.root_uvs;
  even.first_vertex.push_back(0);
  double errors = 0;
  for (uint32_t strand = 0; strand < strands.strands(); ++strand) {
    const uint32_t begin = strands.first_vertex[strand], count = strands.first_vertex[strand + 1] - begin;
    const std::vector<double> along = lengthsAlong(strands, strand);
    const double length = along.back();
    uint32_t segment = 0;
    for (uint32_t i = 0; i < vertices; ++i) {
      const double wanted = length * i / (vertices - 1);
      while (segment + 2 < count && along[segment + 1] < wanted) ++segment;
      const double span = along[segment + 1] - along[segment];
      const double t = i == 0 ? 0 : i + 1 == vertices ? 1 : span > 0 ? std::clamp((wanted - along[segment]) / span, 0.0, 1.0) : 0;
      if (i + 1 == vertices) segment = count - 2;
      const size_t a = begin + segment, b = a + 1;
      const auto mix = [&](const std::vector<float>& from, std::vector<float>& to, size_t size) {
        for (size_t c = 0; c < size && !from.empty(); ++c) {
          const double from_a = from[a * size + c], from_b = from[b * size + c];
          to.push_back(t == 0 ? from[a * size + c] : t == 1 ? from[b * size + c] : float(from_a + (from_b - from_a) * t));
        }
      };
      mix(strands.positions, even.positions, 3);
      mix(strands.radii, even.radii, 1);
      mix(strands.colors, even.colors, 3);
      if (!strands.inverse_masses.empty()) {
        const uint32_t from_tip = vertices - 1 - i;
        const uint32_t nearest = i < 2 ? std::min(i, count - 1) : from_tip < 2 ? count - 1 - std::min(from_tip, count - 1)
                                                                               : segment + (t < 0.5 ? 0u : 1u);
        even.inverse_masses.push_back(strands.inverse_masses[begin + nearest]);
      }
    }
    even.first_vertex.push_back(even.first_vertex.back() + vertices);
    const double error = length > 0 ? std::abs(lengthsAlong(even, strand).back() / length - 1) : 0;
    errors += error;
    if (error > report.worst_error) report.worst_error = error, report.worst_strand = strand;
  }
  report.mean_error = strands.strands() ? errors / strands.strands() : 0;
  strands = std::move(even);
  return report;
}

}  // namespace forelock::samples
