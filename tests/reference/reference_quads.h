// Section 1 of methods.md in one plane: pixels, texels or samples.
#pragma once

#include "reference_vector.h"

#include <algorithm>

namespace forelock::reference {

// One segment of a strand in the plane. The first block is given, the rest is computed by shapeStrand.
struct PlaneSegment {
  bool exists = false;  // false: wholly before the near plane
  bool cut_a = false, cut_b = false;
  Vec2 a, b;
  double h_a = 0, h_b = 0;  // half widths at the ends, plane units

  Vec2 t, n;
  double l = 0, extent = 0;            // extent: E, half a pixel seen along n
  bool has_root = false, has_tip = false;
  double e_root = 0, e_tip = 0;        // reach of the end ramps beyond the strand
  double tau_a = 0, tau_b = 0;         // slopes of the split lines: x tau_a <= y < l - x tau_b
  double share = 1;                    // m: set by screenSegments
  Vec2 corner[4];                      // start -n, start +n, end +n, end -n; two are one where the lines cross
};

// direction, normal and length; false where the segment makes no quad.
bool setDirection(PlaneSegment& segment);
// Corners and ramps of all the segments of one strand, in order. flush: E counts as 0 and ends have no ramps.
void shapeStrand(std::span<PlaneSegment> segments, bool flush);

// The factor m of section 2, which keeps a segment's area; p, q: distances to the strand's root and tip.
double areaShare(const PlaneSegment& segment, double p, double q);

// Calls visit(column, row) for each cell of [0, columns) x [row_begin, row_end) whose centre lies in the polygon:
// left and top edges belong to it, right and bottom ones do not, so neighbours on a shared edge never share a cell.
template <class Visit>
void forEachCell(const Vec2 (&corner)[4], int columns, int row_begin, int row_end, Visit visit) {
  double low = corner[0].y, high = corner[0].y;
  for (const Vec2& c : corner) {
    if (!std::isfinite(c.x) || !std::isfinite(c.y)) return;
    low = std::min(low, c.y);
    high = std::max(high, c.y);
  }
  const double first = std::max(double(row_begin), std::ceil(low - 0.5));
  const double last = std::min(double(row_end) - 1, std::ceil(high - 0.5) - 1);
  if (first > last) return;
  for (int row = int(first); row <= int(last); ++row) {
    const double y = row + 0.5;
    double crossing[4];
    int crossings = 0;
    for (int i = 0; i < 4; ++i) {
      Vec2 p = corner[i], q = corner[(i + 1) % 4];
      if ((p.y <= y) == (q.y <= y)) continue;
      if (p.y > q.y) std::swap(p, q);  // the same numbers from either side of a shared edge
      const double x = p.x + (y - p.y) * ((q.x - p.x) / (q.y - p.y));
      int at = crossings++;
      for (; at > 0 && crossing[at - 1] > x; --at) crossing[at] = crossing[at - 1];
      crossing[at] = x;
    }
    for (int i = 0; i + 1 < crossings; i += 2) {
      const double begin = std::max(0.0, std::ceil(crossing[i] - 0.5));
      const double end = std::min(double(columns), std::ceil(crossing[i + 1] - 0.5));
      for (int column = int(std::min(begin, double(columns))); column < end; ++column) visit(column, row);
    }
  }
}

// A segment of the scene on the screen with what its fragments need.
struct ScreenSegment {
  PlaneSegment plane;
  double depth_a = 0, depth_b = 0;
  double fraction_a = 0, fraction_b = 0;
  Vec3 tangent_a, tangent_b;  // view space
  Vec3 color_a, color_b;      // of the vertices
  uint32_t hair = 0;          // index in the scene
  uint32_t sequence = 0;
};

// All quads of the scene in submission order. scale multiplies the pixel grid; flush as above.
std::vector<ScreenSegment> screenSegments(const Scene& scene, const Camera& camera, double scale, bool flush);

// The fibre's colour of section 2.
std::array<double, 3> fibreColor(const Material& material, const ScreenSegment& segment, double u, double fraction);

// Where a pixel centre lies in a segment.
struct Placed {
  double x, y, v;  // along n, along t, clamped segment parameter on the screen
};

inline Placed place(const PlaneSegment& s, int column, int row) {
  const Vec2 from_a = Vec2{column + 0.5, row + 0.5} - s.a;
  const double y = dot(from_a, s.t);
  return {dot(from_a, s.n), y, std::clamp(y / s.l, 0.0, 1.0)};
}

// The segment parameter in 3-D and the depth there.
struct Along {
  double u, depth;
};
inline Along along(const ScreenSegment& s, double v, bool perspective) {
  if (!perspective) return {v, mix(s.depth_a, s.depth_b, v)};
  const double depth = 1 / ((1 - v) / s.depth_a + v / s.depth_b);
  return {v * depth / s.depth_b, depth};
}

}  // namespace forelock::reference
