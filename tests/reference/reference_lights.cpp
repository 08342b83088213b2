// What arrives of a light: section 4.
#include "reference_lights.h"

#include "reference_vector.h"

#include <algorithm>

namespace forelock::reference {
namespace {

double windowOf(double distance, double range) {
  if (!(range > 0)) return 1;
  const double rest = std::clamp(1 - std::pow(distance / range, 4), 0.0, 1.0);
  return rest * rest;
}

double coneOf(const Light& light, Vec3 to_light) {
  const double cosine = -dot(to_light, normalizeOrZero(light.axis));
  const double inner = std::cos(light.inner_angle), outer = std::cos(light.outer_angle);
  // A cone without a soft edge is a step.
  if (!(inner > outer)) return cosine >= outer ? 1 : 0;
  const double t = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
  return t * t;
}

}  // namespace

Arriving arrivingLight(const Light& light, Vec3 position) {
  Arriving out;
  double factor = 1;
  if (light.kind == LightKind::directional) {
    out.to_light = normalizeOrZero(light.direction_to_light);
  } else {
    const Vec3 way = light.position - position;
    const double r = length(way);
    out.to_light = normalizeOrZero(way);
    if (isZero(out.to_light)) return out;
    factor = windowOf(r, light.range) / std::max(r * r, light.source_radius * light.source_radius);
    if (light.kind == LightKind::spot) factor *= coneOf(light, out.to_light);
  }
  for (size_t c = 0; c < 3; ++c) out.radiance[c] = light.radiance[c] * factor;
  return out;
}

}  // namespace forelock::reference
