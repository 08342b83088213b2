// What `forward` would pay for shading if capture handed its fragments over without loss. SPDX-License-Identifier: MIT
#pragma once

#include "headless_host.h"
#include "lighting.h"
#include "twin.h"
#include "views.h"

#include <optional>

namespace forelock::study {

// Milliseconds that the device takes to shade every fragment of the view in full, a lane each, from memory in order of pixels; the least
// of several runs. map: of the view's one directional light, as the device has drawn it. Nothing where the view has other light, fibres
// whose colour varies, several hairs, or more fragments than a buffer binding holds.
std::optional<double> denseShading(samples::HeadlessHost& host, const Twin& twin, const View& view, const FlkMaterial& material,
                                   const Lighting& lighting, const FlkShadowMap& map);

}  // namespace forelock::study
