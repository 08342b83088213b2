// SPDX-License-Identifier: MIT
#include "bust.h"

#include "bust_shape.h"
#include "parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace forelock::samples {

namespace {

constexpr uint32_t kTile = 16;
constexpr float kHit = 0.0001f;      // (m), or a third of a pixel where that is more
constexpr float kRelaxed = 0.85f;    // the field may overestimate where ellipsoids are slender
constexpr float kReach = 0.62f;      // (m) of the whole bust from its centre
const glm::vec3 kCentre(0.0f, -0.16f, 0.0f);

struct RayMaker {
  explicit RayMaker(const Camera& camera, uint32_t w, uint32_t h) : orthographic(camera.orthographic) {
    const CameraBasis basis = cameraBasis(camera);
    back = glm::vec3(basis.back);
    eye = glm::vec3(camera.eye);
    const double half =
        camera.orthographic ? 0.5 * camera.view_height : std::tan(0.5 * camera.vertical_fov);
    const double pixel = 2.0 * half / static_cast<double>(h);
    right_step = glm::vec3(basis.right * pixel);
    up_step = glm::vec3(basis.up * pixel);
    half_width = 0.5f * static_cast<float>(w);
    half_height = 0.5f * static_cast<float>(h);
    pixel_size = static_cast<float>(pixel);
  }

  void ray(float x, float y, glm::vec3& origin, glm::vec3& direction) const {
    const glm::vec3 offset = right_step * (x - half_width) + up_step * (half_height - y);
    origin = orthographic ? eye + offset : eye;
    direction = orthographic ? -back : glm::normalize(offset - back);
  }

  bool orthographic;
  glm::vec3 eye, back, right_step, up_step;
  float half_width, half_height;
  float pixel_size;  // (m) orthographic, (m per m of view depth) perspective
};

// Where along the ray the sphere around the bust begins and ends; false: never.
bool enterBounds(const glm::vec3& origin, const glm::vec3& direction, float margin, float& from, float& to) {
  const glm::vec3 oc = origin - kCentre;
  const float b = glm::dot(oc, direction);
  const float radius = kReach + margin;
  const float discriminant = b * b - (glm::dot(oc, oc) - radius * radius);
  if (discriminant <= 0.0f) {
    return false;
  }
  const float root = std::sqrt(discriminant);
  from = std::max(-b - root, 0.0f);
  to = -b + root;
  return to > from;
}

glm::vec3 shadePoint(const BustLook& look, const glm::vec3& to_light, const glm::vec3& p, const glm::vec3& to_eye) {
  const glm::vec3 normal = shape::bustNormal<float>(p);
  // Two samples of the field along the normal darken eye sockets and the neck under the chin.
  const float near_gap = shape::bust<float>(p + normal * 0.012f) / 0.012f;
  const float far_gap = shape::bust<float>(p + normal * 0.045f) / 0.045f;
  const float open = std::clamp(0.35f + 0.30f * near_gap + 0.35f * far_gap, 0.0f, 1.0f);
  float lit = std::max(glm::dot(normal, to_light), 0.0f);
  float through = 1.0f;
  if (lit > 0.0f) {
    float t = 0.004f;
    float visible = 1.0f;
    for (int i = 0; i < 8 && t < 0.30f && visible > 0.02f; ++i) {
      const float d = shape::bust<float>(p + normal * 0.0015f + to_light * t);
      visible = std::min(visible, 10.0f * d / t);
      t += std::max(1.2f * d, 0.010f);
    }
    lit *= std::clamp(visible, 0.0f, 1.0f);
    if (look.light_through_hair && lit > 0.0f) {
      through = std::clamp(look.light_through_hair(p), 0.0f, 1.0f);
      lit *= through;
    }
  }
  const float sky = 0.6f + 0.4f * normal.y;
  const glm::vec3 half = glm::normalize(to_light + to_eye);
  const float cosine = std::max(glm::dot(normal, half), 0.0f);
  const float square = cosine * cosine;
  const float gloss = 0.05f * lit * square * square * square * square;
  const float sky_through = 0.4f + 0.6f * through;  // what hides the light hides much of the sky
  const glm::vec3 arriving = look.light * (lit * 0.3183099f) + look.ambient * (sky * open * sky_through);
  return look.albedo * arriving + look.light * (gloss * 0.3183099f);
}

}  // namespace

BustImage drawBust(const Camera& camera, uint32_t width, uint32_t height, const BustLook& look) {
  BustImage result;
  result.color = Image(width, height);
  result.depth.assign(size_t{width} * height, std::numeric_limits<float>::infinity());
  const RayMaker maker(camera, width, height);
  const glm::vec3 to_light = glm::normalize(look.to_light);
  const uint32_t tiles_x = (width + kTile - 1) / kTile;
  const uint32_t tiles_y = (height + kTile - 1) / kTile;

  parallelFor(size_t{tiles_x} * tiles_y, 4, [&](size_t tile) {
    const uint32_t x0 = static_cast<uint32_t>(tile % tiles_x) * kTile;
    const uint32_t y0 = static_cast<uint32_t>(tile / tiles_x) * kTile;
    // A cone around the tile's rays is marched first: all its pixels start where it first comes near the surface.
    glm::vec3 origin, direction;
    maker.ray(static_cast<float>(x0) + 0.5f * kTile, static_cast<float>(y0) + 0.5f * kTile, origin, direction);
    const float spread = 0.7072f * kTile * maker.pixel_size;
    float from = 0.0f, to = 0.0f;
    const float widest = maker.orthographic ? spread : spread * (glm::length(origin - kCentre) + kReach);
    if (!enterBounds(origin, direction, widest, from, to)) {
      return;
    }
    float start = from;
    for (int i = 0; i < 64; ++i) {
      const float radius = maker.orthographic ? spread : spread * start;
      const float d = shape::bust<float>(origin + direction * start) * kRelaxed - radius;
      if (d < 0.002f) {
        break;
      }
      start += d / (maker.orthographic ? 1.0f : 1.0f + spread);
      if (start > to) {
        return;
      }
    }
    start = std::max(start - 0.002f, 0.0f);

    for (uint32_t y = y0; y < std::min(y0 + kTile, height); ++y) {
      for (uint32_t x = x0; x < std::min(x0 + kTile, width); ++x) {
        maker.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, origin, direction);
        float t = start;
        bool hit = false;
        for (int i = 0; i < 128 && t < to + widest; ++i) {
          const float d = shape::bust<float>(origin + direction * t);
          if (d < std::max(kHit, 0.33f * maker.pixel_size * (maker.orthographic ? 1.0f : t))) {
            hit = true;
            break;
          }
          t += d * kRelaxed;
        }
        const float depth = -glm::dot(direction * t, maker.back);
        if (!hit || depth < static_cast<float>(camera.near_m) || depth > static_cast<float>(camera.far_m)) {
          continue;
        }
        const glm::vec3 color = shadePoint(look, to_light, origin + direction * t, -direction);
        float* pixel = result.color.pixel(x, y);
        pixel[0] = color.x;
        pixel[1] = color.y;
        pixel[2] = color.z;
        pixel[3] = 1.0f;
        result.depth[size_t{y} * width + x] = depth;
      }
    }
  });
  return result;
}

void bustBounds(float min_bounds[3], float max_bounds[3]) {
  const float low[3] = {-0.25f, -0.43f, -0.15f};
  const float high[3] = {0.25f, 0.11f, 0.12f};
  std::copy(low, low + 3, min_bounds);
  std::copy(high, high + 3, max_bounds);
}

void headBounds(float min_bounds[3], float max_bounds[3]) {
  const float low[3] = {-0.085f, -0.125f, -0.11f};
  const float high[3] = {0.085f, 0.11f, 0.105f};
  std::copy(low, low + 3, min_bounds);
  std::copy(high, high + 3, max_bounds);
}

}  // namespace forelock::samples
