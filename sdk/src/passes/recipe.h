// What a pass runs: shaders and specialisation constants. One file a pass; the GPU room turns a recipe into a pipeline.
#pragma once

#include "plan/plan.h"
#include "shared/node.h"

#include <cstdint>

namespace forelock {

// As in shaders/CMakeLists.txt.
enum class ShaderId : uint8_t {
  none,
  capture_vert,
  capture,
  capture_forward,
  capture_display,
  capture_compute,
  capture_forward_compute,
  capture_display_compute,
  shadow_vert,
  shadow_frag,
  shadow_compute,
  shadow_width_vert,
  shadow_width_frag,
  shadow_width_compute,
  clear,
  prepare,
  resolve,
  resolve_colors,
  resolve_exact,
  resolve_hard,
  resolve_layers,
  output_front_depth,
  output_transmittance,
  output_velocity,
  output_depth_range
};

struct Recipe {
  ShaderId vertex = ShaderId::none;    // none: a compute pass
  ShaderId main = ShaderId::none;      // fragment or compute
  uint8_t images = 0;                  // bits of Images that `main` is bound to
  bool depth_attachment = false;       // D32_SFLOAT, less, written
  uint32_t constants[FLK_SPEC_COUNT] = {};  // by FLK_SPEC_...; 0 where the shader has no such constant
  bool operator==(const Recipe&) const = default;
};

Recipe clearRecipe(const FramePlan& plan);  // nothing, but with shadow maps by compute
Recipe prepareRecipe();
Recipe shadowRecipe(const FramePlan& plan);
Recipe captureRecipe(const FramePlan& plan, PassId pass);
Recipe resolveRecipe(const FramePlan& plan);
Recipe outputRecipe(const FramePlan& plan, uint32_t output);
Recipe recipeOf(const FramePlan& plan, const Pass& pass);

// Constants of shaders that shade, and the images they read for it.
void addLight(const FramePlan& plan, Recipe& recipe);

}  // namespace forelock
