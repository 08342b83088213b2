#include "gpu/shader_code.h"

#include "shaders_spv/capture_depth_frag.h"
#include "shaders_spv/capture_display_depth_frag.h"
#include "shaders_spv/capture_display_frag.h"
#include "shaders_spv/capture_forward_depth_frag.h"
#include "shaders_spv/capture_forward_frag.h"
#include "shaders_spv/capture_forward_shadow_depth_frag.h"
#include "shaders_spv/capture_forward_shadow_frag.h"
#include "shaders_spv/capture_frag.h"
#include "shaders_spv/capture_vert.h"
#include "shaders_spv/resolve_comp.h"
#include "shaders_spv/resolve_exact_comp.h"
#include "shaders_spv/resolve_exact_shadow_comp.h"
#include "shaders_spv/resolve_forward_comp.h"
#include "shaders_spv/resolve_layers_comp.h"
#include "shaders_spv/resolve_shadow_comp.h"
#include "shaders_spv/shadow_frag.h"
#include "shaders_spv/shadow_vert.h"

namespace forelock {

std::span<const uint32_t> shaderCode(ShaderId id) {
  switch (id) {
    case ShaderId::none:
    case ShaderId::count: return {};
    case ShaderId::capture_vert: return capture_vert;
    case ShaderId::capture_frag: return capture_frag;
    case ShaderId::capture_depth_frag: return capture_depth_frag;
    case ShaderId::capture_forward_frag: return capture_forward_frag;
    case ShaderId::capture_forward_depth_frag: return capture_forward_depth_frag;
    case ShaderId::capture_forward_shadow_frag: return capture_forward_shadow_frag;
    case ShaderId::capture_forward_shadow_depth_frag: return capture_forward_shadow_depth_frag;
    case ShaderId::capture_display_frag: return capture_display_frag;
    case ShaderId::capture_display_depth_frag: return capture_display_depth_frag;
    case ShaderId::shadow_vert: return shadow_vert;
    case ShaderId::shadow_frag: return shadow_frag;
    case ShaderId::resolve_comp: return resolve_comp;
    case ShaderId::resolve_shadow_comp: return resolve_shadow_comp;
    case ShaderId::resolve_forward_comp: return resolve_forward_comp;
    case ShaderId::resolve_exact_comp: return resolve_exact_comp;
    case ShaderId::resolve_exact_shadow_comp: return resolve_exact_shadow_comp;
    case ShaderId::resolve_layers_comp: return resolve_layers_comp;
  }
  return {};
}

}  // namespace forelock
