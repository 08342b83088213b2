// What a pass runs: shaders and specialisation constants. One file a pass; the GPU room turns a recipe into a pipeline.
#pragma once

#include "plan/plan.h"
#include "shared/node.h"

#include <cstdint>

namespace forelock {

enum class ShaderId : uint8_t {
  none,
  capture_vert,
  capture_frag,
  capture_depth_frag,
  capture_forward_frag,
  capture_forward_depth_frag,
  capture_forward_shadow_frag,
  capture_forward_shadow_depth_frag,
  capture_display_frag,
  capture_display_depth_frag,
  shadow_vert,
  shadow_frag,
  resolve_comp,
  resolve_shadow_comp,
  resolve_forward_comp,
  resolve_exact_comp,
  resolve_exact_shadow_comp,
  resolve_layers_comp,
  count
};

struct Recipe {
  ShaderId vertex = ShaderId::none;    // none: a compute pass
  ShaderId main = ShaderId::none;      // fragment or compute
  bool depth_attachment = false;       // D32_SFLOAT, less, written
  uint32_t constants[FLK_SPEC_COUNT] = {};  // by FLK_SPEC_...; 0 where the shader has no such constant
  bool operator==(const Recipe&) const = default;
};

Recipe shadowRecipe(const FramePlan& plan);
Recipe captureRecipe(const FramePlan& plan);
Recipe resolveRecipe(const FramePlan& plan);

}  // namespace forelock
