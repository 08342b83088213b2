// Segments to quads: clipping, joints, ends.
#include "reference_quads.h"

namespace forelock::reference {
namespace {

constexpr double shortest_px = 1e-6;  // methods.md section 1
constexpr double steepest_split = 2;  // slope of a split line that a joint may always have: 127 degrees
constexpr int share_nodes = 32;       // midpoints across a segment, beside a strand's end

struct ViewVertex {
  Vec3 p;  // view space
  double radius = 0, fraction = 0;
  Vec3 tangent;
  Vec3 color{1, 1, 1};
};

ViewVertex mixVertex(const ViewVertex& a, const ViewVertex& b, double t) {
  return {mix(a.p, b.p, t), mix(a.radius, b.radius, t), mix(a.fraction, b.fraction, t), mix(a.tangent, b.tangent, t),
          mix(a.color, b.color, t)};
}

// The tangent of a vertex as its segment `own` sees it, `other` being the direction beyond the vertex or zero.
Vec3 vertexTangent(Vec3 own, Vec3 other) {
  if (isZero(other)) return own;
  const Vec3 sum = own + other;
  return length(sum) > 1e-6 ? normalizeOrZero(sum) : own;
}

void shapeJoint(PlaneSegment& p, PlaneSegment& n, bool flush) {
  const double reach = std::max(p.h_b + (flush ? 0 : p.extent), n.h_a + (flush ? 0 : n.extent));
  const double turn = cross(p.t, n.t), along = 1 + dot(p.t, n.t);
  // tan(theta / 2) = sin / (1 + cos); a full turn back has no finite mitre.
  const double mitre = along > 1e-15 ? std::fabs(turn) / along : std::numeric_limits<double>::infinity();
  const double g = turn > 0 ? 1 : turn < 0 ? -1 : 0;
  // Half a segment is left to each joint: split lines that stay within it never cross, however steep.
  const double steepest = std::max(steepest_split, std::min(p.l, n.l) / (2 * std::max(reach, 1e-6)));
  p.tau_b = n.tau_a = g * std::min(mitre, steepest);
  for (const int s : {-1, 1}) {
    const Vec2 end = p.b + (s * reach) * p.n - (s * reach * p.tau_b) * p.t;
    const Vec2 start = n.a + (s * reach) * n.n + (s * reach * n.tau_a) * n.t;
    p.corner[s > 0 ? 2 : 3] = end;
    // Not clamped they are one point; rounding must not open a gap along a row of pixel centres.
    n.corner[s > 0 ? 1 : 0] = mitre <= steepest ? end : start;
  }
}

void shapeEnd(PlaneSegment& segment, bool root, double e, bool flush) {
  const double reach = (root ? segment.h_a : segment.h_b) + (flush ? 0 : segment.extent);
  const Vec2 base = root ? segment.a - e * segment.t : segment.b + e * segment.t;
  segment.corner[root ? 0 : 3] = base - reach * segment.n;
  segment.corner[root ? 1 : 2] = base + reach * segment.n;
}

// Beyond the point where its two split lines meet nothing belongs to the segment.
void cutCrossing(PlaneSegment& s) {
  const double slope = s.tau_a + s.tau_b;
  if (slope == 0) return;
  const double x = (s.l + s.e_root + s.e_tip) / slope;
  double reach = 0;
  for (const Vec2& c : s.corner) reach = std::max(reach, std::fabs(dot(c - s.a, s.n)));
  if (!(std::fabs(x) < reach)) return;
  const Vec2 meeting = s.a + x * s.n + (x * s.tau_a - s.e_root) * s.t;
  if (x > 0) s.corner[1] = s.corner[2] = meeting;
  else s.corner[0] = s.corner[3] = meeting;
}

// Mean of max(x - t, 0)^2 / 2 over the trapezoid kernel of F at t: P2(-t) of section 2.
double beyond(double t, double a, double b) {
  if (t < 0) return t * t / 2 + 1.0 / 24 - beyond(-t, a, b);
  const double rest = (a + b) / 2 - t;
  if (rest <= 0) return 0;
  if (t > (a - b) / 2) return std::pow(rest, 4) / (24 * a * b);
  return 1.0 / 48 - t * (3 * a * a + b * b) / (24 * a) + t * t / 4 - t * t * t / (6 * a);
}

// Integral of F + 1/2 up to t.
double rampSum(double t, double a, double b) {
  if (t > 0) return t + rampSum(-t, a, b);
  const double rest = (a + b) / 2 + t;
  if (rest <= 0) return 0;
  if (-t > (a - b) / 2) return std::pow(rest, 3) / (6 * a * b);
  return (3 * a * a + b * b) / (24 * a) + t / 2 + t * t / (2 * a);
}

// Integral of root + tip - 1 along t between the split lines where they are y apart; p, q: way to the strand's ends.
double rampArea(const PlaneSegment& s, double y, double p, double q, double a, double b) {
  const double whole = y + s.e_root + s.e_tip;
  if (whole <= 0) return 0;
  return std::max(0.0, rampSum(y + s.e_tip + p, a, b) - rampSum(p - s.e_root, a, b) +
                           rampSum(y + s.e_root + q, a, b) - rampSum(q - s.e_tip, a, b) - whole);
}

}  // namespace

double areaShare(const PlaneSegment& s, double p, double q) {
  const double slope = std::fabs(s.tau_a + s.tau_b), h = (s.h_a + s.h_b) / 2, reach = h + s.extent;
  if (!(slope > 0) || !(h > 0)) return 1;
  const double a = std::max(std::fabs(s.n.x), std::fabs(s.n.y)), b = std::min(std::fabs(s.n.x), std::fabs(s.n.y));
  if (std::min(p, q) >= s.extent) {
    if (slope * reach <= s.l) return 1;
    const double x = s.l / slope;
    return 1 / (1 + (beyond(x - h, a, b) - beyond(x + h, a, b)) / (2 * h * x));
  }
  if (slope * reach <= s.l - s.extent) return 1;
  double whole = 0, left = 0;
  for (int i = 0; i < share_nodes; ++i) {
    const double x = reach * ((2 * i + 1.0) / share_nodes - 1);
    const double strip = pixelHalfArea(x + h, s.n.x, s.n.y) - pixelHalfArea(x - h, s.n.x, s.n.y);
    whole += strip;
    left += strip * rampArea(s, s.l - slope * x, p, q, a, b);
  }
  return left > 0 ? std::min(rampArea(s, s.l, p, q, a, b) * whole / left, 1.0) : 1;
}

bool setDirection(PlaneSegment& segment) {
  const Vec2 d = segment.b - segment.a;
  segment.l = length(d);
  if (!segment.exists || !(segment.l >= shortest_px) || !std::isfinite(segment.l)) {
    segment.exists = false;
    return false;
  }
  segment.t = (1 / segment.l) * d;
  segment.n = {-segment.t.y, segment.t.x};
  segment.extent = (std::fabs(segment.n.x) + std::fabs(segment.n.y)) / 2;
  return true;
}

void shapeStrand(std::span<PlaneSegment> segments, bool flush) {
  const size_t count = segments.size();
  for (size_t i = 0; i < count; ++i) {
    PlaneSegment& segment = segments[i];
    if (!segment.exists) continue;
    segment.has_root = i == 0 && !segment.cut_a;
    segment.has_tip = i + 1 == count && !segment.cut_b;
    segment.e_root = segment.has_root && !flush ? segment.extent : 0;
    segment.e_tip = segment.has_tip && !flush ? segment.extent : 0;

    const bool joins_before = i > 0 && segments[i - 1].exists && !segment.cut_a && !segments[i - 1].cut_b;
    const bool joins_after = i + 1 < count && segments[i + 1].exists && !segment.cut_b && !segments[i + 1].cut_a;
    if (!joins_before) shapeEnd(segment, true, segment.e_root, flush);
    if (!joins_after) shapeEnd(segment, false, segment.e_tip, flush);
    if (joins_after) shapeJoint(segment, segments[i + 1], flush);
  }
  for (PlaneSegment& segment : segments) {
    if (segment.exists) cutCrossing(segment);
  }
}

std::vector<ScreenSegment> screenSegments(const Scene& scene, const Camera& camera, double scale, bool flush) {
  std::vector<ScreenSegment> out;
  const double* m = camera.view_from_world;
  const double* clip = camera.clip_from_view;
  const bool perspective = isPerspective(camera);
  const double near_plane = nearPlane(camera);
  uint32_t sequence = 0;
  std::vector<ViewVertex> vertices;
  std::vector<Vec3> directions;
  std::vector<PlaneSegment> planes;
  std::vector<std::array<ViewVertex, 2>> ends;

  for (uint32_t hair_index = 0; hair_index < scene.hairs.size(); ++hair_index) {
    const Hair& hair = scene.hairs[hair_index];
    const Strands& strands = hair.strands;
    for (size_t strand = 0; strand < strands.count(); ++strand) {
      const size_t begin = strands.first_vertex[strand], end = strands.first_vertex[strand + 1];
      if (end < begin + 2) continue;
      const size_t count = end - begin - 1;
      vertices.assign(count + 1, {});
      for (size_t i = 0; i <= count; ++i) {
        const Vec3 w = strands.positions[begin + i];
        vertices[i].p = {m[0] * w.x + m[4] * w.y + m[8] * w.z + m[12], m[1] * w.x + m[5] * w.y + m[9] * w.z + m[13],
                         m[2] * w.x + m[6] * w.y + m[10] * w.z + m[14]};
        vertices[i].radius = strands.radii[begin + i] * hair.material.width_scale;
        vertices[i].fraction = strands.fraction[begin + i];
        if (!strands.colors.empty()) vertices[i].color = strands.colors[begin + i];
      }
      directions.assign(count, {});
      for (size_t i = 0; i < count; ++i) directions[i] = normalizeOrZero(vertices[i + 1].p - vertices[i].p);

      planes.assign(count, {});
      ends.assign(count, {});
      for (size_t i = 0; i < count; ++i) {
        PlaneSegment& plane = planes[i];
        ViewVertex a = vertices[i], b = vertices[i + 1];
        a.tangent = vertexTangent(directions[i], i > 0 ? directions[i - 1] : Vec3{});
        b.tangent = vertexTangent(directions[i], i + 1 < count ? directions[i + 1] : Vec3{});
        const double da = -a.p.z, db = -b.p.z;
        if (!(da >= near_plane) && !(db >= near_plane)) continue;
        plane.exists = true;
        if (da < near_plane || db < near_plane) {
          const ViewVertex at = mixVertex(a, b, (near_plane - da) / (db - da));
          plane.cut_a = da < near_plane;
          plane.cut_b = db < near_plane;
          (plane.cut_a ? a : b) = at;
          (plane.cut_a ? a : b).p.z = -near_plane;
        }
        ends[i] = {a, b};
        double sx[2], sy[2];
        for (int side = 0; side < 2; ++side) {
          const Vec3 p = ends[i][size_t(side)].p;
          const double c = perspective ? -p.z : 1;
          const double w = clip[11] * p.z + clip[15];
          const double ndc_x = (clip[0] * p.x + clip[8] * p.z + clip[12]) / w;
          const double ndc_y = (clip[5] * p.y + clip[9] * p.z + clip[13]) / w;
          Vec2& at = side ? plane.b : plane.a;
          at = {(ndc_x + 1) / 2 * camera.width * scale, (ndc_y + 1) / 2 * camera.height * scale};
          sx[side] = std::fabs(clip[0]) * camera.width * scale / (2 * c);
          sy[side] = std::fabs(clip[5]) * camera.height * scale / (2 * c);
        }
        if (!setDirection(plane)) continue;
        plane.h_a = a.radius * sx[0] * sy[0] * length(Vec2{plane.t.x / sx[0], plane.t.y / sy[0]});
        plane.h_b = b.radius * sx[1] * sy[1] * length(Vec2{plane.t.x / sx[1], plane.t.y / sy[1]});
      }
      shapeStrand(planes, flush);
      for (size_t i = 0; i < count; ++i, ++sequence) {
        if (!planes[i].exists) continue;
        ScreenSegment& segment = out.emplace_back();
        segment.plane = planes[i];
        if (!flush) {
          const double per_fraction = planes[i].l / (ends[i][1].fraction - ends[i][0].fraction);
          segment.plane.share = areaShare(planes[i], ends[i][0].fraction * per_fraction,
                                          (1 - ends[i][1].fraction) * per_fraction);
        }
        segment.depth_a = -ends[i][0].p.z;
        segment.depth_b = -ends[i][1].p.z;
        segment.fraction_a = ends[i][0].fraction;
        segment.fraction_b = ends[i][1].fraction;
        segment.tangent_a = ends[i][0].tangent;
        segment.tangent_b = ends[i][1].tangent;
        segment.color_a = ends[i][0].color;
        segment.color_b = ends[i][1].color;
        segment.hair = hair_index;
        segment.sequence = sequence;
      }
    }
  }
  return out;
}

}  // namespace forelock::reference
