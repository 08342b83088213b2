#pragma once

#include "passes/recipe.h"

#include <cstdint>
#include <span>

namespace forelock {

// SPIR-V of a shader; empty for ShaderId::none.
std::span<const uint32_t> shaderCode(ShaderId id);

}  // namespace forelock
