// What a frame hands on beside its colour: the outputs of section 6.
#pragma once

#include "reference.h"

namespace forelock::reference {

using Matrix = std::array<double, 16>;  // column-major, affine

// How the frame before saw the scene. Empty lists: the hair has not moved; else one per hair of the scene.
struct Motion {
  Camera camera_before;
  std::vector<Matrix> world_from_hair{}, world_from_hair_before{};
};

// Of a pixel without a fragment: written is false and the rest meaningless.
struct OutputPixel {
  bool written = false;
  double front_depth = 0;  // of the nearest fragment, metre
  double transmittance = 1;
  double velocity[2] = {0, 0};  // pixels, now less before; 0 where the point was behind the camera
  double depth_min = 0, depth_max = 0;
};

// Row-major. The lists may be gatherHard's.
std::vector<OutputPixel> outputsOf(const Scene& scene, const Camera& camera, const FragmentLists& lists,
                                   const Motion& motion);

}  // namespace forelock::reference
