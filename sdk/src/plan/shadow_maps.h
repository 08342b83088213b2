// Hair shadow maps: what each light needs, and where it lies in the one image that holds them all. docs/methods.md section 4.
#pragma once

#include "plan/facts.h"

namespace forelock {

inline constexpr std::size_t kMaxFaces = 96;

// One map.
struct ShadowFace {
  Mat4 map_from_world = kIdentity;  // orthographic: texels from the map's middle, metre from its front; perspective: metre in the light's axes
  double focal = 0;   // perspective: texels at distance 1 along the axis; 0: orthographic
  double texel = 0;   // metre; perspective: at distance 1
  double range = 0;   // metre of a full depth value
  double near = 0;    // perspective: metre
  uint32_t size = 0;  // texels a side
  uint32_t x = 0, y = 0;  // in the image
  uint32_t light = 0, face = 0;
  bool cover_width = false;
};

struct ShadowLayout {
  FixedList<ShadowFace, kMaxFaces> faces;
  uint32_t width = 0, height = 0;  // of the image; 0: there is none
};

struct Sphere {
  Vec3 center{};
  double radius = 0;
};
Sphere sphereOfAll(std::span<const HairFacts> hairs);

// Null, or why the lights' maps cannot be had. `limit`: texels that an image may have a side.
const char* layoutShadowMaps(std::span<const LightFacts> lights, std::span<const HairFacts> hairs, uint32_t limit, ShadowLayout& layout);

}  // namespace forelock
