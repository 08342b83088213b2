// Section 5: Kajiya-Kay with two shifted lobes.
#include "reference_vector.h"

#include <algorithm>
#include <map>
#include <numbers>

namespace forelock::reference {
namespace {

double lobe(double angle, double exponent) {
  const double cosine = std::cos(angle);
  return cosine > 0 ? std::pow(cosine, std::clamp(exponent, 0.0, 1e6)) : 0;
}

}  // namespace

// The integral over a whole turn by the midpoint rule, which for a periodic function converges with the number of its points.
double meanLobe(double exponent) {
  constexpr int points = 1 << 14;
  thread_local std::map<double, double> known;
  const auto [found, is_new] = known.try_emplace(exponent, 0.0);
  for (int i = 0; is_new && i < points; ++i) found->second += lobe(2 * std::numbers::pi * (i + 0.5) / points, exponent) / points;
  return found->second;
}

std::array<double, 3> shadeLobes(const Material& material, const LobeInput& input, Lobes lobes) {
  const Vec3 t = input.tangent;
  const bool valid = !isZero(t) && std::isfinite(t.x + t.y + t.z);
  // Sines from cross products: exact where a root of 1 - cos^2 would lose them or turn negative.
  const double sin_l = valid ? std::min(1.0, length(cross(t, input.to_light))) : 1;
  double lobe_r = 0, lobe_trt = 0;
  if (lobes == Lobes::mean) {
    lobe_r = meanLobe(material.exponent_r);
    lobe_trt = meanLobe(material.exponent_trt);
  }
  if (lobes == Lobes::own && valid) {
    const double angle_r = std::atan2(sin_l, -dot(t, input.to_light));  // the mirrored light
    const double angle_v = std::atan2(length(cross(t, input.to_eye)), dot(t, input.to_eye));
    lobe_r = lobe(angle_r + 2 * material.cuticle_tilt - angle_v, material.exponent_r);
    lobe_trt = lobe(angle_r - 3 * material.cuticle_tilt - angle_v, material.exponent_trt);
  }
  std::array<double, 3> out{};
  for (size_t c = 0; c < 3; ++c) {
    out[c] = material.kd * sin_l * material.color[c] + material.kr * lobe_r +
             material.kt * lobe_trt * material.color[c];
  }
  return out;
}

std::array<double, 3> shadeFragment(const Scene& scene, const Camera& camera, std::span<const ShadowMap> maps, int x,
                                    int y, const Fragment& fragment, bool full) {
  std::vector<std::span<const ShadowMap>> faces;
  for (const ShadowMap& map : maps) faces.push_back({&map, 1});
  return shadeFragmentLit(scene, camera, faces, x, y, fragment, full);
}

std::array<double, 3> shadeFragmentLit(const Scene& scene, const Camera& camera,
                                       std::span<const std::span<const ShadowMap>> faces, int x, int y,
                                       const Fragment& fragment, bool full) {
  const Material* material = nullptr;
  for (const Hair& hair : scene.hairs) {
    if (hair.slot == fragment.slot) material = &hair.material;
  }
  if (!material) return {};
  Material coloured;
  if (fragment.has_color) {
    coloured = *material;
    for (size_t c = 0; c < 3; ++c) coloured.color[c] = fragment.color[c];
    material = &coloured;
  }
  const double* m = camera.view_from_world;
  auto toWorld = [m](Vec3 v) {
    return Vec3{m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
                m[8] * v.x + m[9] * v.y + m[10] * v.z};
  };
  const Vec3 position = unproject(camera, x + 0.5, y + 0.5, fragment.depth);
  const Vec3 tangent = toWorld(fragment.tangent);
  Vec3 to_eye = toWorld({0, 0, 1});
  if (isPerspective(camera)) to_eye = normalizeOrZero(toWorld({-m[12], -m[13], -m[14]}) - position);

  const Lobes kind = full || scene.low_shade == LowShade::lobes     ? Lobes::own
                     : scene.low_shade == LowShade::mean_lobes ? Lobes::mean
                                                               : Lobes::none;
  std::array<double, 3> out = ambientLight(scene, tangent);
  for (size_t c = 0; c < 3; ++c) out[c] *= material->kd * material->color[c];
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    if (!lightReaches(scene.light_tiles, i, x, y)) continue;
    const Arriving arriving = arrivingLight(light, position);
    if (isZero(arriving.to_light)) continue;  // in the light itself
    double reaching = i < faces.size() ? shadowTaps(faces[i], *material, position, tangent, full ? scene.core_taps : 1) : 1;
    if (light.host_shadow) reaching *= hostShadowLight(*light.host_shadow, position);
    if (!light.visibility.empty()) reaching *= light.visibility[size_t(y) * size_t(camera.width) + size_t(x)];
    const auto lobes = shadeLobes(*material, {tangent, arriving.to_light, to_eye}, kind);
    for (size_t c = 0; c < 3; ++c) out[c] += arriving.radiance[c] * reaching * lobes[c];
  }
  return out;
}

}  // namespace forelock::reference
