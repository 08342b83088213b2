// R_exact, R_forward and R_cover of a view, made or taken from the cache. SPDX-License-Identifier: MIT
#pragma once

#include "reference_cache.h"
#include "twin.h"
#include "views.h"

#include <functional>
#include <vector>

namespace forelock::study {

struct References {
  double factor = 1;            // by which all light is scaled: the condition's mean
  std::vector<Picture> exact;   // along kDrift, the first without a shift; scaled
  Picture forward;              // scaled
  std::vector<float> cover;     // opacity; empty: not made
  std::string scene_hash;       // of strands, materials, lights and camera
  std::string reference_hash;   // of the pixels of R_exact
};

// The view's rectangle in bands of rows, so that lists of many millions of fragments fit into memory.
std::vector<Rect> bandsOf(const View& view);

// What to make, and who is told of it.
struct ReferenceWish {
  bool drift = true, cover = false;
  std::function<void(const char* what)> says;
};

// Changes the twin's lights to `unit_lighting`. Fills in view.max_overdraw.
References makeReferences(Twin& twin, View& view, const Lighting& unit_lighting, samples::HairColor color,
                          const ReferenceWish& wish, const ReferenceCache& cache);

}  // namespace forelock::study
