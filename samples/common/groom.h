// Procedural grooms: a recipe in, strands out, the same bytes on every machine. SPDX-License-Identifier: MIT
#pragma once

#include "groom_recipe.h"

#include <forelock/asset.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace forelock::samples {

// Strands as arrays, laid out like FlkStrands. Metres, y up, the face looks along +z, head centre at the origin.
struct Groom {
  std::vector<uint32_t> first_vertex;  // strands + 1
  std::vector<float> positions;        // 3 a vertex, root first; multiples of 2^-20 m
  std::vector<float> radii;            // a vertex, half the diameter; multiples of 2^-30 m
  std::vector<float> root_uvs;         // 2 a strand: azimuth and elevation on the scalp, [0, 1]

  uint32_t strandCount() const { return static_cast<uint32_t>(first_vertex.size()) - 1; }
  uint32_t vertexCount() const { return static_cast<uint32_t>(radii.size()); }
};

// Grows the strands of a recipe. The first n strands are an even sample of all. Uses all cores; about 90 us a strand
// and core for half-metre hair. `progress` is called from any of the threads with strands done and strands in all.
// Throws RecipeError where the recipe cannot be grown.
Groom makeGroom(const Recipe& recipe, const std::function<void(uint64_t, uint64_t)>& progress = {});

// A view of the groom's arrays for flkAssetCreate; valid as long as the groom is.
FlkStrands describeGroom(const Groom& groom);

// 64-bit FNV-1a over all arrays, little endian: what the determinism test stores.
uint64_t hashGroom(const Groom& groom);

}  // namespace forelock::samples
