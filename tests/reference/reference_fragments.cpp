// Coverage (section 2), the fragment lists, and the supersampled R_cover.
#include "reference_quads.h"

namespace forelock::reference {
namespace {

constexpr int band_rows = 8;  // rows of one job

struct Binned {
  std::vector<std::vector<uint32_t>> bands;  // segment numbers, in submission order
};

Binned binSegments(const std::vector<ScreenSegment>& segments, int rows, int rows_per_band) {
  Binned binned;
  const int bands = (rows + rows_per_band - 1) / rows_per_band;
  binned.bands.resize(size_t(bands));
  for (size_t i = 0; i < segments.size(); ++i) {
    double low = segments[i].plane.corner[0].y, high = low;
    bool finite = true;
    for (const Vec2& c : segments[i].plane.corner) {
      finite = finite && std::isfinite(c.x) && std::isfinite(c.y);
      low = std::min(low, c.y);
      high = std::max(high, c.y);
    }
    if (!finite || high < 0 || low >= rows) continue;
    const int first = int(std::max(0.0, low)) / rows_per_band;
    const int last = int(std::min(double(rows - 1), high)) / rows_per_band;
    for (int band = first; band <= last; ++band) binned.bands[size_t(band)].push_back(uint32_t(i));
  }
  return binned;
}

double signOf(double t) { return t > 0 ? 1 : t < 0 ? -1 : 0; }

double coverageAt(const ScreenSegment& segment, const Placed& at) {
  const PlaneSegment& s = segment.plane;
  const double h = mix(s.h_a, s.h_b, at.v);
  const double strip = pixelHalfArea(at.x + h, s.n.x, s.n.y) - pixelHalfArea(at.x - h, s.n.x, s.n.y);
  const double per_fraction = s.l / (segment.fraction_b - segment.fraction_a);
  // Distances from the lines that split it from its neighbours, along t: a mitre is no way past the strand's end.
  const double from_root = at.y - at.x * s.tau_a + segment.fraction_a * per_fraction;
  const double to_tip = s.l - at.y - at.x * s.tau_b + (1 - segment.fraction_b) * per_fraction;
  // A pixel seen along t has the same extents as along n, with the components swapped.
  const double root = pixelHalfArea(from_root, s.t.x, s.t.y) + 0.5;
  const double tip = pixelHalfArea(to_tip, s.t.x, s.t.y) + 0.5;
  return s.share * strip * std::max(root + tip - 1, 0.0);
}

double opacityAt(const Material& material, double fraction) {
  return mix(material.opacity_root, material.opacity_tip, fraction);
}

}  // namespace

double pixelHalfArea(double t, double nx, double ny) {
  const double a = std::max(std::fabs(nx), std::fabs(ny)), b = std::min(std::fabs(nx), std::fabs(ny));
  const double d = std::fabs(t);
  if (d <= (a - b) / 2) return t / a;
  const double rest = (a + b) / 2 - d;
  if (rest <= 0 || b <= 0) return signOf(t) / 2;
  return signOf(t) * (0.5 - rest * rest / (2 * a * b));
}

FragmentLists gatherFragments(const Scene& scene, const Camera& camera, const GatherOptions& options) {
  const std::vector<ScreenSegment> segments = screenSegments(scene, camera, 1, false);
  const bool perspective = isPerspective(camera);
  const bool colored = hasColors(scene);
  const Binned binned = binSegments(segments, camera.height, band_rows);
  const int bands = int(binned.bands.size());

  struct Band {
    std::vector<Fragment> sorted;
    std::vector<uint32_t> count;
  };
  std::vector<Band> out{size_t(bands)};
  parallelFor(bands, options.threads, [&](int band) {
    const int row_begin = band * band_rows, row_end = std::min(camera.height, row_begin + band_rows);
    std::vector<Fragment> found;
    std::vector<uint32_t> pixel_of;
    std::vector<uint32_t> count(size_t(row_end - row_begin) * size_t(camera.width));
    for (const uint32_t index : binned.bands[size_t(band)]) {
      const ScreenSegment& s = segments[index];
      const Hair& hair = scene.hairs[s.hair];
      forEachCell(s.plane.corner, camera.width, row_begin, row_end, [&](int column, int row) {
        const Placed at = place(s.plane, column, row);
        const double coverage = coverageAt(s, at);
        const Along where = along(s, at.v, perspective);
        const double fraction = mix(s.fraction_a, s.fraction_b, where.u);
        const double modifier = opacityModifier(options.modifiers, column + 0.5, row + 0.5, where.depth);
        const double alpha = std::clamp(coverage * opacityAt(hair.material, fraction) * modifier, 0.0, 1.0);
        const double coded = codedAlpha(alpha, options.payload);
        if (!(coded > 0)) return;
        const size_t pixel = size_t(row) * size_t(camera.width) + size_t(column);
        if (!options.host_depth.empty() && !(where.depth <= options.host_depth[pixel])) return;
        const Vec3 tangent = normalizeOrZero(mix(s.tangent_a, s.tangent_b, where.u));
        found.push_back({where.depth, coded, coverage, codedTangent(tangent, options.payload), hair.slot, s.sequence});
        if (colored) {
          found.back().has_color = true;
          found.back().color = codedColor(fibreColor(hair.material, s, where.u, fraction), options.payload);
        }
        const uint32_t local = uint32_t(pixel - size_t(row_begin) * size_t(camera.width));
        pixel_of.push_back(local);
        ++count[local];
      });
    }
    std::vector<uint32_t> cursor(count.size());
    uint32_t sum = 0;
    for (size_t i = 0; i < count.size(); ++i) {
      cursor[i] = sum;
      sum += count[i];
    }
    out[size_t(band)].sorted.resize(found.size());
    for (size_t i = 0; i < found.size(); ++i) out[size_t(band)].sorted[cursor[pixel_of[i]]++] = found[i];
    out[size_t(band)].count = std::move(count);
  });

  FragmentLists lists;
  lists.width = camera.width;
  lists.height = camera.height;
  lists.first.reserve(size_t(camera.width) * size_t(camera.height) + 1);
  lists.first.push_back(0);
  size_t total = 0;
  for (const Band& band : out) total += band.sorted.size();
  lists.fragments.reserve(total);
  for (Band& band : out) {
    for (const uint32_t n : band.count) lists.first.push_back(lists.first.back() + n);
    lists.fragments.insert(lists.fragments.end(), band.sorted.begin(), band.sorted.end());
    band = {};
  }
  return lists;
}

std::vector<double> renderCover(const Scene& scene, const Camera& camera, int samples, int threads) {
  const std::vector<ScreenSegment> segments = screenSegments(scene, camera, samples, true);
  const bool perspective = isPerspective(camera);
  const Binned binned = binSegments(segments, camera.height * samples, samples);
  std::vector<double> cover(size_t(camera.width) * size_t(camera.height));
  const int columns = camera.width * samples;
  parallelFor(camera.height, threads, [&](int pixel_row) {
    const auto& band = binned.bands[size_t(pixel_row)];
    if (band.empty()) return;
    // Only the pixel columns that a quad of this row may touch.
    double low = columns, high = 0;
    for (const uint32_t index : band) {
      for (const Vec2& c : segments[index].plane.corner) {
        low = std::min(low, c.x);
        high = std::max(high, c.x);
      }
    }
    const int first = int(std::clamp(low / samples, 0.0, double(camera.width)));
    const int last = int(std::clamp(high / samples + 1, double(first), double(camera.width)));
    const size_t stride = size_t(last - first) * size_t(samples), skip = size_t(first) * size_t(samples);
    std::vector<double> transmittance(stride * size_t(samples), 1.0);
    const int row_begin = pixel_row * samples;
    for (const uint32_t index : band) {
      const ScreenSegment& s = segments[index];
      const Material& material = scene.hairs[s.hair].material;
      forEachCell(s.plane.corner, last * samples, row_begin, row_begin + samples, [&](int column, int row) {
        if (size_t(column) < skip) return;  // the edge of an immense quad rounds by more than a pixel
        const Placed at = place(s.plane, column, row);
        if (std::fabs(at.x) > mix(s.plane.h_a, s.plane.h_b, at.v)) return;
        const double fraction = mix(s.fraction_a, s.fraction_b, along(s, at.v, perspective).u);
        double& t = transmittance[size_t(row - row_begin) * stride + size_t(column) - skip];
        t *= 1 - std::clamp(opacityAt(material, fraction), 0.0, 1.0);
      });
    }
    for (size_t i = 0; i < transmittance.size(); ++i) {
      const size_t pixel = size_t(first) + i % stride / size_t(samples);
      cover[size_t(pixel_row) * size_t(camera.width) + pixel] +=
          (1 - transmittance[i]) / (double(samples) * samples);
    }
  });
  return cover;
}

}  // namespace forelock::reference
