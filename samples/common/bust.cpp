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

// Share of the light that the bust itself lets through: marched along its field, with a soft edge.
float pastBust(const glm::vec3& p, const glm::vec3& normal, const glm::vec3& to_light, float reach) {
  float t = 0.004f;
  float visible = 1.0f;
  for (int i = 0; i < 8 && t < std::min(reach, 0.30f) && visible > 0.02f; ++i) {
    const float d = shape::bust<float>(p + normal * 0.0015f + to_light * t);
    visible = std::min(visible, 10.0f * d / t);
    t += std::max(1.2f * d, 0.010f);
  }
  return std::clamp(visible, 0.0f, 1.0f);
}

// What arrives at p of a light of colour 1, and from where.
float arriving(const BustLight& light, const glm::vec3& p, glm::vec3& to_light, float& distance) {
  if (!light.placed) {
    to_light = glm::normalize(light.to_light);
    distance = std::numeric_limits<float>::infinity();
    return 1.0f;
  }
  const glm::vec3 d = light.position - p;
  distance = std::max(glm::length(d), 1e-6f);
  to_light = d / distance;
  const float square = distance * distance;
  const float reach = light.range > 0.0f ? square / (light.range * light.range) : 0.0f;
  const float window = std::max(1.0f - reach * reach, 0.0f);
  float cone = 1.0f;
  if (light.cos_inner > light.cos_outer) {
    const float cosine = glm::dot(to_light, glm::normalize(light.to_light));
    cone = std::clamp((cosine - light.cos_outer) / (light.cos_inner - light.cos_outer), 0.0f, 1.0f);
  }
  return window * window * cone * cone / std::max(square, light.source_radius * light.source_radius);
}

// Irradiance / pi from nine coefficients of radiance: Ramamoorthi and Hanrahan 2001, their A_l / pi being 1, 2/3, 1/4.
glm::vec3 irradiance(const std::array<glm::vec3, 9>& c, const glm::vec3& n) {
  const glm::vec3 sum = 0.282095f * c[0] + (2.0f / 3.0f) * 0.488603f * (n.y * c[1] + n.z * c[2] + n.x * c[3]) +
                        0.25f * (1.092548f * (n.x * n.y * c[4] + n.y * n.z * c[5] + n.x * n.z * c[7]) +
                                 0.315392f * (3.0f * n.z * n.z - 1.0f) * c[6] +
                                 0.546274f * (n.x * n.x - n.y * n.y) * c[8]);
  return glm::max(sum, glm::vec3(0.0f));
}

glm::vec3 shadePoint(const BustLook& look, const glm::vec3& p, const glm::vec3& to_eye) {
  const glm::vec3 normal = shape::bustNormal<float>(p);
  // Two samples of the field along the normal darken eye sockets and the neck under the chin.
  const float near_gap = shape::bust<float>(p + normal * 0.012f) / 0.012f;
  const float far_gap = shape::bust<float>(p + normal * 0.045f) / 0.045f;
  const float open = std::clamp(0.35f + 0.30f * near_gap + 0.35f * far_gap, 0.0f, 1.0f);
  glm::vec3 diffuse(0.0f), gloss(0.0f);
  float weight = 0.0f, weighted_through = 0.0f;
  for (const BustLight& light : look.lights) {
    glm::vec3 to_light;
    float distance = 0.0f;
    const float strength = arriving(light, p, to_light, distance);
    float lit = std::max(glm::dot(normal, to_light), 0.0f) * strength;
    if (lit <= 0.0f) {
      continue;
    }
    lit *= pastBust(p, normal, to_light, distance);
    if (light.light_through_hair && lit > 0.0f) {
      const float through = std::clamp(light.light_through_hair(p), 0.0f, 1.0f);
      const float share = lit * (light.color.x + light.color.y + light.color.z);
      weight += share;
      weighted_through += share * through;
      lit *= through;
    }
    const glm::vec3 half = glm::normalize(to_light + to_eye);
    const float cosine = std::max(glm::dot(normal, half), 0.0f);
    const float square = cosine * cosine;
    diffuse += light.color * (lit * 0.3183099f);
    gloss += light.color * (0.05f * lit * square * square * square * square * 0.3183099f);
  }
  const float through = weight > 0.0f ? weighted_through / weight : 1.0f;
  const float sky_through = 0.4f + 0.6f * through;  // what hides the light hides much of the sky
  const glm::vec3 sky = look.ambient * (0.6f + 0.4f * normal.y) + irradiance(look.ambient_sh, normal);
  return look.albedo * (diffuse + sky * (open * sky_through)) + gloss;
}

}  // namespace

BustImage drawBust(const Camera& camera, uint32_t width, uint32_t height, const BustLook& look) {
  BustImage result;
  result.color = Image(width, height);
  result.depth.assign(size_t{width} * height, std::numeric_limits<float>::infinity());
  const RayMaker maker(camera, width, height);
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
        const glm::vec3 color = shadePoint(look, origin + direction * t, -direction);
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
