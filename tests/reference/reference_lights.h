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

// One map of a light. size == 0: no map, everything lit. depth is row-major, metre, infinity: empty; of a directional
// light along z from the sphere's near side, of a perspective map (focal > 0) from the origin.
struct ShadowMap {
  int size = 0;
  double texel = 0, rho = 0;  // metre; perspective: the texel is v.z / focal and this one 0
  Vec3 center, x, y, z;       // world
  std::vector<float> depth{};
  double focal = 0;       // texels
  double near_depth = 0;  // metre along z: what is nearer casts no shadow and gets none
  Vec3 origin{};          // the light, world
  bool cover_width = false;
};

// None (all lit), one, or six in the order +x, -x, +y, -y, +z, -z of the world.
struct LightMaps {
  std::vector<ShadowMap> faces{};
};

// Axes, texel size and empty depths; for a map that comes from elsewhere.
ShadowMap shadowFrame(const Sphere& sphere, Vec3 direction_to_light, int size);
// widest_cosine: of the angle between the axis and the widest ray, 1 where the axis points at the sphere.
ShadowMap perspectiveFrame(const Sphere& sphere, Vec3 origin, Vec3 axis, double half_angle, int size, double widest_cosine);
// The light's maps, empty; none where it casts no shadow or the sphere is empty.
LightMaps lightFrames(const Light& light, const Sphere& sphere);
// Adds all strands of the scene to a map.
void drawShadowMap(ShadowMap& map, const Scene& scene);
std::vector<LightMaps> renderLightMaps(const Scene& scene);

// For lights of at most one map; of a light with six they give an empty map.
ShadowMap renderShadowMap(const Scene& scene, const Light& light);
ShadowMap renderShadowMap(const Scene& scene, const Light& light, const Sphere& sphere);
// One per light; lights without a shadow get an empty map.
std::vector<ShadowMap> renderShadowMaps(const Scene& scene);
// Transmittance of one tap: map_depth and the fragment's D in metre.
double shadowTap(double depth, double map_depth, double bias, double opacity, double spacing);
double gaussianWeight(int i, int j);  // |i|, |j| <= 2; the 25 sum to 1
// Light that reaches the world point on a strand of that unit tangent.
// by the mean of 1, 4, 9 or 25 taps.
double shadowTaps(const ShadowMap& map, const Material& material, Vec3 position, Vec3 tangent, int taps);
double shadowTaps(std::span<const ShadowMap> faces, const Material& material, Vec3 position, Vec3 tangent, int taps);
// core: 25 taps, else one. Faces: a map or a span of them.
template <class Faces>
double shadowLight(const Faces& faces, const Material& material, Vec3 position, Vec3 tangent, bool core) {
  return shadowTaps(faces, material, position, tangent, core ? 25 : 1);
}

// What of a light arrives at a world point, before any shadow. Both zero at the light itself.
struct Arriving {
  Vec3 to_light;  // unit
  std::array<double, 3> radiance{};
};
Arriving arrivingLight(const Light& light, Vec3 position);

// The share of a light that a host's shadow map lets through to the world point.
double hostShadowLight(const HostShadow& shadow, Vec3 position);
// False where the tile of the pixel masks the light out; a light beyond the words reaches nothing.
bool lightReaches(const LightTiles& tiles, size_t light, int x, int y);
// A(T) of section 5; tangent: unit, world, or zero.
std::array<double, 3> ambientLight(const Scene& scene, Vec3 tangent);

}  // namespace forelock::reference
