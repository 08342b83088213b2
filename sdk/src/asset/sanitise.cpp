#include "asset/sanitise.h"

#include "asset/suspicions.h"
#include "asset/value_range.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <iterator>
#include <limits>

namespace forelock {
namespace {

constexpr float dropped = -1.0f;  // in place of a strand's length
constexpr double micro_fraction = 1e-4;
constexpr float unset_radius = -1.0f;  // until the default is known, which the strands that stay decide

// Length of a strand, or `dropped` after noting why. `in_range`: all its coordinates are known to be.
float measureStrand(const StrandArrays& arrays, uint32_t strand, bool in_range, const Places& places, Findings& findings) {
  const uint32_t begin = arrays.first_vertex[strand], end = arrays.first_vertex[strand + 1];
  const auto drop = [&](FindingKind kind, uint32_t vertex) {
    findings.note(kind, strand, places.positions.byte(strand, vertex));
    return dropped;
  };
  if (end - begin == 1 && places.bald_roots) return drop(FindingKind::strand_root_only, begin);
  if (end - begin < 2) return drop(FindingKind::strand_too_short, begin);

  for (uint32_t vertex = begin; vertex < end && !in_range; ++vertex)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float value = arrays.positions[std::size_t{vertex} * 3 + axis];
      if (std::fabs(value) <= largest_coordinate) continue;
      return drop(std::isfinite(value) ? FindingKind::position_out_of_range : FindingKind::position_not_finite, vertex);
    }

  double length = 0, longest = 0;
  uint64_t vanishing = 0;
  uint32_t first_vanishing = 0;
  for (uint32_t vertex = begin; vertex + 1 < end; ++vertex) {
    const float* a = arrays.positions.data() + std::size_t{vertex} * 3;
    const double x = double{a[3]} - a[0], y = double{a[4]} - a[1], z = double{a[5]} - a[2];
    const double segment = std::sqrt(x * x + y * y + z * z);
    if (segment <= vanishing_length && vanishing++ == 0) first_vanishing = vertex;
    longest = std::max(longest, segment);
    length += segment;
  }
  if (longest <= vanishing_length) return drop(FindingKind::strand_zero_length, begin);
  if (vanishing != 0)
    findings.note(FindingKind::segment_zero_length, strand, places.positions.byte(strand, first_vanishing), vanishing);
  return static_cast<float>(length);
}

// Lengths of all strands and how many are kept; `range` gets to know all coordinates. In pieces, so that what has been looked over is
// still in the cache when its strands are measured.
uint32_t measureStrands(const StrandArrays& arrays, const Places& places, std::pmr::vector<float>& lengths, ValueRange& range, Findings& findings) {
  constexpr std::size_t piece = 6144;
  static_assert(piece % ValueRange::lanes == 0);
  uint32_t strand = 0, kept = 0;
  const std::span<const float> positions(arrays.positions);
  for (std::size_t at = 0, end = 0; strand < lengths.size(); at = end) {
    end = std::min(at + piece, positions.size());
    range.add(positions.subspan(at, end - at));
    const bool in_range = range.within(-largest_coordinate, largest_coordinate);
    for (; strand < lengths.size() && std::size_t{arrays.first_vertex[strand + 1]} * 3 <= end; ++strand) {
      lengths[strand] = measureStrand(arrays, strand, in_range, places, findings);
      kept += lengths[strand] != dropped;
    }
  }
  return kept;
}

// Gives the median length.
double noteMicroStrands(const StrandArrays& arrays, const std::pmr::vector<float>& lengths, const Places& places,
                        Findings& findings) {
  std::pmr::vector<float> kept(lengths.get_allocator());
  kept.reserve(lengths.size());
  std::copy_if(lengths.begin(), lengths.end(), std::back_inserter(kept), [](float length) { return length != dropped; });
  const auto middle = kept.begin() + static_cast<std::ptrdiff_t>(kept.size() / 2);
  std::nth_element(kept.begin(), middle, kept.end());
  const double shortest = *middle * micro_fraction;
  for (uint32_t strand = 0; strand < lengths.size(); ++strand)
    if (lengths[strand] != dropped && lengths[strand] < shortest)
      findings.note(FindingKind::strand_micro, strand, places.positions.byte(strand, arrays.first_vertex[strand]));
  return *middle;
}

ValueRange rangeOf(const FloatArray& values) {
  ValueRange range;
  range.add(values);
  return range;
}

// Replaces what no radius, UV, mass or colour may be. Only in strands that stay: findings about dropped ones would mislead.
// `radii_in_range`: there are none to replace.
void repairValues(StrandArrays& arrays, const std::pmr::vector<float>& lengths, bool radii_in_range, const Places& places,
                  Findings& findings) {
  for (uint32_t strand = 0; strand < lengths.size(); ++strand) {
    if (lengths[strand] == dropped) continue;
    const uint32_t begin = arrays.first_vertex[strand], end = arrays.first_vertex[strand + 1];
    if (!radii_in_range)
      for (uint32_t vertex = begin; vertex < end; ++vertex) {
        float& radius = arrays.radii[vertex];
        if (radius >= 0 && radius <= largest_coordinate) continue;
        radius = unset_radius;
        findings.note(FindingKind::radius_invalid, strand, places.radii.byte(strand, vertex));
      }
    if (!arrays.inverse_masses.empty())
      for (uint32_t vertex = begin; vertex < end; ++vertex) {
        float& mass = arrays.inverse_masses[vertex];
        if (mass >= 0 && std::isfinite(mass)) continue;
        mass = 0;
        findings.note(FindingKind::inverse_mass_invalid, strand, places.inverse_masses.byte(strand, vertex));
      }
    if (!arrays.colors.empty())
      for (uint32_t vertex = begin; vertex < end; ++vertex) {
        float* color = arrays.colors.data() + std::size_t{vertex} * 3;
        const uint64_t byte = places.colors.byte(strand, vertex);
        if (!std::isfinite(color[0]) || !std::isfinite(color[1]) || !std::isfinite(color[2])) {
          // All of it: with one component replaced it would be a colour of another hue that nobody chose.
          std::fill_n(color, 3, 1.0f);
          findings.note(FindingKind::color_not_finite, strand, byte);
        } else if (std::any_of(color, color + 3, [](float value) { return value < 0 || value > 1; })) {
          for (int i = 0; i < 3; ++i) color[i] = std::clamp(color[i], 0.0f, 1.0f);
          findings.note(FindingKind::color_outside_unit, strand, byte);
        }
      }
    if (!arrays.root_uvs.empty()) {
      float* uv = arrays.root_uvs.data() + std::size_t{strand} * 2;
      const uint64_t byte = places.root_uvs.byte(strand, begin);
      if (!std::isfinite(uv[0]) || !std::isfinite(uv[1])) {
        findings.note(FindingKind::root_uv_not_finite, strand, byte);
        for (int i = 0; i < 2; ++i)
          if (!std::isfinite(uv[i])) uv[i] = 0;
      }
      if (uv[0] < 0 || uv[0] > 1 || uv[1] < 0 || uv[1] > 1)
        findings.note(FindingKind::root_uv_outside_unit, strand, byte);
    }
  }
}

// Closes the gaps of dropped strands. Everything moves towards the front, so it can be done in place.
void removeDropped(StrandArrays& arrays, const std::pmr::vector<float>& lengths, uint32_t kept) {
  arrays.dropped_strands.reserve(lengths.size() - kept);
  uint32_t strands = 0, vertices = 0;
  const auto move = [](FloatArray& array, std::size_t from, std::size_t to, std::size_t count) {
    if (array.empty() || from == to) return;
    const auto source = array.begin() + static_cast<std::ptrdiff_t>(from);
    std::copy(source, source + static_cast<std::ptrdiff_t>(count), array.begin() + static_cast<std::ptrdiff_t>(to));
  };
  for (uint32_t strand = 0; strand < lengths.size(); ++strand) {
    if (lengths[strand] == dropped) {
      arrays.dropped_strands.push_back(strand);
      continue;
    }
    const uint32_t begin = arrays.first_vertex[strand], count = arrays.first_vertex[strand + 1] - begin;
    move(arrays.positions, std::size_t{begin} * 3, std::size_t{vertices} * 3, std::size_t{count} * 3);
    move(arrays.radii, begin, vertices, count);
    move(arrays.inverse_masses, begin, vertices, count);
    move(arrays.colors, std::size_t{begin} * 3, std::size_t{vertices} * 3, std::size_t{count} * 3);
    move(arrays.root_uvs, std::size_t{strand} * 2, std::size_t{strands} * 2, 2);
    // Never ahead of what is still to be read: `strands` is at most `strand`, whose own entry has just been used.
    arrays.first_vertex[strands++] = vertices;
    vertices += count;
  }
  arrays.first_vertex[strands] = vertices;
  arrays.first_vertex.resize(std::size_t{strands} + 1);
  arrays.positions.resize(std::size_t{vertices} * 3);
  if (!arrays.radii.empty()) arrays.radii.resize(vertices);
  if (!arrays.inverse_masses.empty()) arrays.inverse_masses.resize(vertices);
  if (!arrays.colors.empty()) arrays.colors.resize(std::size_t{vertices} * 3);
  if (!arrays.root_uvs.empty()) arrays.root_uvs.resize(std::size_t{strands} * 2);
}

// Zero has two signs, of which a least or greatest value has that of the first: the same whatever the order of comparison.
float firstOf(const FloatArray& values, std::size_t first, std::size_t step, float value) {
  for (std::size_t i = first; value == 0 && i < values.size(); i += step)
    if (values[i] == 0) return values[i];
  return value;
}

void measure(const StrandArrays& arrays, const std::pmr::vector<float>& lengths, const ValueRange& positions, FlkAssetInfo& info) {
  info.strand_count = arrays.strandCount();
  info.vertex_count = arrays.vertexCount();
  info.min_vertices_per_strand = UINT32_MAX;
  info.max_vertices_per_strand = 0;
  for (uint32_t strand = 0; strand < info.strand_count; ++strand) {
    const uint32_t count = arrays.first_vertex[strand + 1] - arrays.first_vertex[strand];
    info.min_vertices_per_strand = std::min(info.min_vertices_per_strand, count);
    info.max_vertices_per_strand = std::max(info.max_vertices_per_strand, count);
  }

  for (std::size_t axis = 0; axis < 3; ++axis) {
    info.min_bounds[axis] = firstOf(arrays.positions, axis, 3, positions.least(axis, 3));
    info.max_bounds[axis] = firstOf(arrays.positions, axis, 3, positions.greatest(axis, 3));
  }
  double sum = 0;
  info.min_length = std::numeric_limits<float>::max();
  info.max_length = 0;
  for (const float length : lengths) {
    if (length == dropped) continue;
    sum += length;
    info.min_length = std::min(info.min_length, length);
    info.max_length = std::max(info.max_length, length);
  }
  info.mean_length = static_cast<float>(sum / info.strand_count);
}

void guessUnit(const FlkAssetInfo& info, Findings& findings) {
  float reach = 0, size = 0;
  for (int axis = 0; axis < 3; ++axis) {
    reach = std::max({reach, std::fabs(info.min_bounds[axis]), std::fabs(info.max_bounds[axis])});
    size = std::max(size, info.max_bounds[axis] - info.min_bounds[axis]);
  }
  if (reach > 10) {
    const bool millimetres = reach > 1000;
    findings.note(FindingKind::unit_suspect, no_strand, no_byte);
    findings.describe(FindingKind::unit_suspect,
                      "coordinates reach %s, which suggests %s rather than metres; nothing was scaled: if so, scale by %s",
                      Number(double{reach}, 6).text, millimetres ? "millimetres" : "centimetres", millimetres ? "0.001" : "0.01");
  } else if (size < 1e-3f) {
    findings.note(FindingKind::unit_suspect, no_strand, no_byte);
    findings.describe(FindingKind::unit_suspect,
                      "the whole asset is only %s across, which is less than a millimetre if the unit is the metre; nothing "
                      "was scaled: check the scale of the export",
                      Number(double{size}, 6).text);
  }
}

}  // namespace

float defaultRadius(const FlkAssetInfo& info, double median_length) noexcept {
  double side = 0;
  for (int axis = 0; axis < 3; ++axis) side = std::max(side, double{info.max_bounds[axis]} - info.min_bounds[axis]);
  const double wanted = side / 5000 * std::max(1.0, 100'000.0 / info.strand_count);
  return static_cast<float>(0.5 * std::min({wanted, side / 1000, median_length / 100}));
}

FlkResult sanitise(StrandArrays& arrays, const Places& places, std::pmr::memory_resource* memory, Findings& findings,
                   const Report& report, FlkAssetInfo& info) {
  const uint32_t source_strands = arrays.strandCount();
  info.strands_in_source = source_strands;

  std::pmr::vector<float> lengths(source_strands, memory);
  ValueRange positions;
  const uint32_t kept = measureStrands(arrays, places, lengths, positions, findings);
  if (kept == 0)
    return report.fail(FLK_ERROR_EMPTY_ASSET, "NO_STRAND_LEFT",
                       "none of its %" PRIu32 " strands can be drawn: %" PRIu64 " have fewer than two vertices, %" PRIu64
                       " hold NaN or infinite coordinates, %" PRIu64 " coordinates beyond 1e6, and %" PRIu64
                       " have no length; export it again",
                       source_strands, findings.count(FindingKind::strand_too_short) + findings.count(FindingKind::strand_root_only),
                       findings.count(FindingKind::position_not_finite),
                       findings.count(FindingKind::position_out_of_range), findings.count(FindingKind::strand_zero_length));

  const double median_length = noteMicroStrands(arrays, lengths, places, findings);
  ValueRange radii = rangeOf(arrays.radii);
  const bool radii_in_range = arrays.radii.empty() || radii.within(0, largest_coordinate);
  repairValues(arrays, lengths, radii_in_range, places, findings);
  if (kept != source_strands) {
    removeDropped(arrays, lengths, kept);
    positions = rangeOf(arrays.positions);
  }

  info.has_radii = !arrays.radii.empty();
  info.has_root_uvs = !arrays.root_uvs.empty();
  info.has_inverse_masses = !arrays.inverse_masses.empty();
  info.has_colors = !arrays.colors.empty();
  measure(arrays, lengths, positions, info);
  const float default_radius = defaultRadius(info, median_length);
  if (!info.has_radii) {
    arrays.radii.assign(arrays.vertexCount(), default_radius);
    findings.note(FindingKind::width_defaulted, no_strand, no_byte);
    findings.describe(FindingKind::width_defaulted,
                      "no widths in the source: a diameter of %s (unit of the positions) is used, chosen by the size of the hair, its %" PRIu32
                      " strands and their median length; give radii or set a width on the hair to change it",
                      Number(double{default_radius} * 2).text, kept);
  } else if (findings.count(FindingKind::radius_invalid) != 0) {
    std::replace(arrays.radii.begin(), arrays.radii.end(), unset_radius, default_radius);
  }
  if (info.has_radii && (kept != source_strands || !radii_in_range)) radii = rangeOf(arrays.radii);
  info.min_radius = info.has_radii ? firstOf(arrays.radii, 0, 1, radii.least()) : default_radius;
  info.max_radius = info.has_radii ? radii.greatest() == 0 ? arrays.radii.back() : radii.greatest() : default_radius;
  if (info.max_radius == 0) findings.note(FindingKind::radius_all_zero, no_strand, places.radii.offset, info.vertex_count);
  guessUnit(info, findings);
  noteSuspicions(arrays, places, lengths, median_length, info, memory, findings);
  return FLK_SUCCESS;
}

}  // namespace forelock
