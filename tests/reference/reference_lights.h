// Lights, their hair shadow maps, and all else that dims or masks them: sections 4 and 5.
#pragma once

#include "reference_scene.h"

namespace forelock::reference {

struct Sphere {
  Vec3 center;
  double radius = 0;
};
// The sphere of section 4. Of several hairs each has its own enlarged sphere first.
Sphere boundingSphere(const Hair& hair);
Sphere boundingSphere(const Scene& scene);

// size == 0: no map, everything lit. depth is row-major, metre along z from the sphere's near side, infinity: empty.
struct ShadowMap {
  int size = 0;
  double texel = 0, rho = 0;  // metre
  Vec3 center, x, y, z;       // world
  std::vector<float> depth;
};

// Axes, texel size and empty depths; for a map that comes from elsewhere.
ShadowMap shadowFrame(const Sphere& sphere, Vec3 direction_to_light, int size);
ShadowMap renderShadowMap(const Scene& scene, const Light& light);
ShadowMap renderShadowMap(const Scene& scene, const Light& light, const Sphere& sphere);
// One per light; lights without a shadow get an empty map.
std::vector<ShadowMap> renderShadowMaps(const Scene& scene);
// Transmittance of one tap: map_depth and the fragment's D in metre.
double shadowTap(double depth, double map_depth, double bias, double opacity, double spacing);
double gaussianWeight(int i, int j);  // |i|, |j| <= 2; the 25 sum to 1
// Light that reaches the world point on a strand of that unit tangent.
double shadowLight(const ShadowMap& map, const Material& material, Vec3 position, Vec3 tangent, bool core);

// What of a light arrives at a world point, before any shadow. Both zero at the light itself.
struct Arriving {
  Vec3 to_light;  // unit
  std::array<double, 3> radiance{};
};
Arriving arrivingLight(const Light& light, Vec3 position);

}  // namespace forelock::reference
