// The methods of the study, a line each: a name in the CSV and what it sets in a frame. SPDX-License-Identifier: MIT
#pragma once

#include <forelock/render.h>

#include <span>
#include <string>

namespace forelock::study {

struct Method {
  const char* name;
  void (*set)(FlkFrame& frame);
  bool has_core;  // k means something
  bool sorts;     // k_sort means something
  bool shades_fully;  // some fragments: core_taps means something
  bool lists;     // keeps fragments in lists: they can overflow, and payloads differ
  bool in_every_view;  // measured in the views beside the main one too, unless --methods says otherwise
};

inline constexpr Method kMethods[] = {
    {"forward", [](FlkFrame& f) { f.method = FLK_METHOD_FORWARD; }, false, true, true, true, true},
    {"core_tail", [](FlkFrame& f) { f.method = FLK_METHOD_CORE_TAIL; }, true, true, true, true, true},
    // The paper's: the tail in the order in which fragments arrived.
    {"core_tail_list", [](FlkFrame& f) { f.method = FLK_METHOD_CORE_TAIL, f.tail = FLK_TAIL_LIST; }, true, true, true, true, true},
    {"core_only", [](FlkFrame& f) { f.method = FLK_METHOD_CORE_ONLY; }, true, true, true, true, true},
    {"all_low", [](FlkFrame& f) { f.method = FLK_METHOD_ALL_LOW; }, false, true, false, true, true},
    // Cheaper or better tails: one shade a pixel for all of it; highlights on average, and in full, in the cheap shade.
    {"core_tail_once", [](FlkFrame& f) { f.method = FLK_METHOD_CORE_TAIL, f.tail = FLK_TAIL_ONCE; }, true, true, true, true, false},
    {"core_tail_lobes", [](FlkFrame& f) { f.method = FLK_METHOD_CORE_TAIL, f.low_shade = FLK_LOW_SHADE_LOBES; }, true, true, true, true, false},
    {"all_low_mean_lobes", [](FlkFrame& f) { f.method = FLK_METHOD_ALL_LOW, f.low_shade = FLK_LOW_SHADE_MEAN_LOBES; }, false, true, false, true, false},
    {"all_low_lobes", [](FlkFrame& f) { f.method = FLK_METHOD_ALL_LOW, f.low_shade = FLK_LOW_SHADE_LOBES; }, false, true, false, true, false},
    {"exact", [](FlkFrame& f) { f.method = FLK_METHOD_EXACT; }, false, false, true, true, true},
    {"hard", [](FlkFrame& f) { f.method = FLK_METHOD_HARD; }, false, false, true, false, false},
};

// What every row's time is compared with: of this method, k 8 and default settings.
inline constexpr const char* kBaseline = "core_tail";

const Method* findMethod(const std::string& name);

}  // namespace forelock::study
