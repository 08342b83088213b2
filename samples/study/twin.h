// The subject as the float64 reference knows it. SPDX-License-Identifier: MIT
#pragma once

#include "lighting.h"
#include "reference.h"
#include "subject.h"

namespace forelock::study {

struct Twin {
  reference::Scene scene;      // materials and lights are set by setTwin...
  reference::Sphere sphere;    // of the shadow maps: section 4 has it by boxes in hair space
};

// Strands of all assets, follow strands and transforms included; materials of the colour.
Twin makeTwin(const Subject& subject, samples::HairColor color);
void setTwinMaterials(Twin& twin, const Subject& subject, samples::HairColor color);
void setTwinLights(Twin& twin, const Lighting& lighting);
// Of the lights that were set, at their own sizes.
std::vector<reference::LightMaps> twinMaps(const Twin& twin);

}  // namespace forelock::study
