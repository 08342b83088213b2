#pragma once

#include "passes/recipe.h"

#include <cstdint>
#include <span>

namespace forelock {

// SPIR-V of a shader for a set of images; empty for ShaderId::none, and where this build does without it.
std::span<const uint32_t> shaderCode(ShaderId id, uint8_t images);

// Of the SPIR-V that a recipe runs and of those of its constants that are declared there: equal hashes, equal pipelines.
uint64_t recipeHash(const Recipe& recipe);

}  // namespace forelock
