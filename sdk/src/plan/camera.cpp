#include "plan/camera.h"

#include <algorithm>
#include <limits>

namespace forelock {
namespace {

// A mitre of slope 2 ends sqrt(5) (h + E) from its joint, E <= sqrt(1/2) pixel; one more for rounding.
constexpr double kMarginPixels = 3;

}  // namespace

double Camera::pixelsPerMetre(double view_depth) const {
  const double w = orthographic ? 1.0 : std::max(view_depth, near_plane);
  return std::max(std::abs(scale[0]) * width, std::abs(scale[1]) * height) / (2.0 * w);
}

const char* makeCamera(const double view_from_world[16], const float clip_from_view[16], bool reversed_depth,
                       uint32_t width, uint32_t height, Camera& camera) {
  for (int i = 0; i < 16; ++i) {
    if (!(std::abs(view_from_world[i]) <= 1e15)) return "view_from_world holds a value that is not within 1e15";
    if (!std::isfinite(clip_from_view[i])) return "clip_from_view holds a value that is not finite";
    camera.view_from_world[i] = view_from_world[i];
  }
  const double* v = view_from_world;
  if (v[3] != 0 || v[7] != 0 || v[11] != 0 || v[15] != 1) return "the last row of view_from_world is not 0 0 0 1";
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const double d = v[i * 4] * v[j * 4] + v[i * 4 + 1] * v[j * 4 + 1] + v[i * 4 + 2] * v[j * 4 + 2];
      if (std::abs(d - (i == j)) > 1e-3)
        return "view_from_world is not rigid (its columns are not of length 1 and orthogonal)";
    }

  const float* p = clip_from_view;
  if (p[1] != 0 || p[2] != 0 || p[3] != 0 || p[4] != 0 || p[6] != 0 || p[7] != 0)
    return "clip_from_view is skewed: only P00, P11, P20, P21, P22, P23, P30, P31, P32, P33 may differ from 0";
  if (p[0] == 0 || p[5] == 0) return "clip_from_view scales an axis to nothing";
  const bool perspective = p[11] == -1 && p[15] == 0 && p[12] == 0 && p[13] == 0;
  const bool orthographic = p[11] == 0 && p[15] == 1 && p[8] == 0 && p[9] == 0;
  if (!perspective && !orthographic)
    return "clip_from_view is neither perspective (last row 0 0 -1 0) nor orthographic (last row 0 0 0 1)";
  camera.orthographic = orthographic;
  camera.scale[0] = p[0], camera.scale[1] = p[5];
  camera.offset[0] = orthographic ? p[12] : p[8], camera.offset[1] = orthographic ? p[13] : p[9];
  camera.depth[0] = p[10], camera.depth[1] = p[14];
  camera.width = width, camera.height = height;

  // The view depth d at which clip depth is the near value n: perspective (-P22 d + P32) / d = n, orthographic -P22 d + P32 = n.
  const double n = reversed_depth ? 1.0 : 0.0;
  const double near_plane =
      orthographic ? (camera.depth[1] - n) / camera.depth[0] : camera.depth[1] / (n + camera.depth[0]);
  if (!std::isfinite(near_plane)) return "clip_from_view has no near plane (is reversed_depth right?)";
  // An infinite far plane sits where the perspective denominator vanishes; a near plane behind the eye means the other convention.
  const double far_plane =
      orthographic ? (camera.depth[1] - (1 - n)) / camera.depth[0] : camera.depth[1] / ((1 - n) + camera.depth[0]);
  if (orthographic && near_plane < 0) return "the near plane of an orthographic clip_from_view lies behind the camera";
  if (orthographic ? !(far_plane > near_plane) : !(near_plane > 0 && (far_plane > near_plane || far_plane < 0)))
    return "the near plane of clip_from_view does not lie before its far plane (is reversed_depth right?)";
  camera.near_plane = near_plane;
  return nullptr;
}

Rect screenRect(const Camera& camera, const Mat4& world_from_box, const Box& box, double margin, double& nearest,
                double& farthest) {
  const Mat4 view = camera.view_from_world * world_from_box;
  nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  double low[2] = {nearest, nearest}, high[2] = {farthest, farthest};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p = transformPoint(view, {corner & 1 ? box.max[0] : box.min[0], corner & 2 ? box.max[1] : box.min[1],
                                         corner & 4 ? box.max[2] : box.min[2]});
    const double d = -p[2];
    nearest = std::min(nearest, d - margin), farthest = std::max(farthest, d + margin);
    // Quads stand in the view plane at the depth of their axis; what is nearer than the margin gets the whole target below.
    const double w = camera.orthographic ? 1.0 : std::max(d, camera.near_plane);
    for (int axis = 0; axis < 2; ++axis) {
      const double size = axis ? camera.height : camera.width;
      for (double sign : {-1.0, 1.0}) {
        const double clip = (p[axis] + sign * margin) * camera.scale[axis] +
                            (camera.orthographic ? camera.offset[axis] : p[2] * camera.offset[axis]);
        const double pixel = (clip / w * 0.5 + 0.5) * size;
        low[axis] = std::min(low[axis], pixel), high[axis] = std::max(high[axis], pixel);
      }
    }
  }
  if (farthest < camera.near_plane) return {};
  Rect rect{0, 0, camera.width, camera.height};
  if (nearest <= camera.near_plane && !camera.orthographic) return rect;  // projections of its corners do not bound it
  const double width = camera.width, height = camera.height;
  const double x0 = std::clamp(std::floor(low[0]) - kMarginPixels, 0.0, width),
               x1 = std::clamp(std::ceil(high[0]) + kMarginPixels, 0.0, width);
  const double y0 = std::clamp(std::floor(low[1]) - kMarginPixels, 0.0, height),
               y1 = std::clamp(std::ceil(high[1]) + kMarginPixels, 0.0, height);
  if (!(x1 > x0 && y1 > y0)) return {};
  rect.x = uint32_t(x0), rect.y = uint32_t(y0);
  rect.width = uint32_t(x1 - x0), rect.height = uint32_t(y1 - y0);
  return rect;
}

Rect unite(const Rect& a, const Rect& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  const uint32_t x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

}  // namespace forelock
