// Panels of how hair is drawn, and of two ways beside each other. SPDX-License-Identifier: MIT
#include "ui.h"
#include "view_session.h"

#include <algorithm>
#include <cstdio>

namespace forelock::samples {

namespace {

void methodWidgets(MethodChoice& choice, bool graphics) {
  ui::choose("Method", choice.method, methodNames(),
             "Which fragments of a pixel are shaded fully, and in what order. Hold the mouse over one in the list.",
             {"The default. The nearest k of a pixel in full quality and in order, the rest cheaply", "All in full quality and in order: what others are measured against",
              "All in full quality, shaded before they are sorted", "As core_tail, but the rest only hides", "All of it cheaply, in order", "The nearest alone, opaque: no lists, the quickest"});
  if (choice.hasCore()) {
    uint32_t k = choice.k == FLK_K_NONE ? 0 : choice.k == 0 ? 8 : choice.k;
    if (ui::slide("k", k, 0, 32, "Fragments of a pixel that are shaded fully: 25 shadow map reads and two highlights")) {
      choice.k = k == 0 ? FLK_K_NONE : k;
      choice.k_sort = choice.k_sort == 0 ? 0 : std::max(choice.k_sort, k);
    }
  }
  if (choice.sorts()) {
    const uint32_t k = choice.k == FLK_K_NONE || !choice.hasCore() ? 0 : choice.k == 0 ? 8 : choice.k;
    uint32_t sorted = choice.k_sort == 0 ? std::max(8u, k) : choice.k_sort;
    if (ui::slide("k sorted", sorted, std::max(k, 1u), 32, "Fragments of a pixel that are put in order: at least k, more where a cheap shade is to be blended in order too")) {
      choice.k_sort = sorted;
    }
  }
  if (choice.hasTail()) {
    ui::choose("Tail", choice.tail, tailNames(),
               "What lies behind the sorted ones. deterministic: a mean, the same from run to run; list: in order of arrival, as in the paper; once: "
               "its nearest fragment's colour for all of it");
    ui::choose("Cheap shade", choice.low_shade, lowShadeNames(), "diffuse as in the paper; mean-lobes: and what highlights give on average; lobes");
  }
  if (choice.method != FLK_METHOD_ALL_LOW) {
    const std::vector<uint32_t> taps{25, 9, 4, 1};
    const std::vector<std::string> names{"25", "9", "4", "1"};
    uint32_t index = static_cast<uint32_t>(std::find(taps.begin(), taps.end(), choice.core_taps) - taps.begin()) % 4;
    if (ui::choose("Shadow taps", index, names, "Reads of a shadow map for a full shade: fewer are quicker and noisier")) {
      choice.core_taps = taps[index] == 25 ? 0 : taps[index];
    }
  }
  if (choice.method != FLK_METHOD_HARD) {
    ui::choose("Payload", choice.payload, payloadNames(), "Coding of what a fragment keeps: default, or as in the paper");
  }
  if (graphics) {
    ui::choose("Capture", choice.capture, captureNames(), "Who turns strands into fragments: the rasteriser or compute shaders");
  }
}

}  // namespace

void methodPanel(ViewSession& session, bool graphics) {
  const ui::Section section("Method", true, "How hair is drawn: what each costs is below, under Cost");
  if (!section) {
    return;
  }
  if (!session.shaded()) {
    ui::faintText("Colours that show data are drawn by forward; choose \"shaded\" under Show to see methods.");
  }
  MethodChoice choice = methodOf(session.scene);
  methodWidgets(choice, graphics);
  if (!(choice == methodOf(session.scene))) {
    applyMethod(choice, session.scene);
  }
}

void comparePanel(ViewSession& session) {
  const ui::Section section("Compare, error", false, "Two methods beside each other, their difference, and the error against exact");
  if (!section) {
    return;
  }
  uint32_t mode = static_cast<uint32_t>(session.compare);
  if (ui::choose("Compare", mode, {"one method", "beside each other", "difference"}, "The left one is under Method, the right one is chosen here (keys C, D)")) {
    session.compare = static_cast<Compare>(mode);
  }
  if (session.compare != Compare::none) {
    const ui::Scope scope("Second");
    methodWidgets(session.second, true);
    if (session.compare == Compare::split) {
      ui::slide("Divider", session.divider, 0.02, 0.98, "Can be dragged in the picture too", "%.2f");
    } else {
      ui::slide("Gain", session.gain, 1.0, 256.0, "What differences are multiplied by, linear", "%.0f", true);
    }
  }
  ui::checkbox("Measure the error", session.measure_error,
               "Draws the picture with exact too and tells the root mean square of the difference, over pixels with hair, of 255: docs/methods.md section 8 (key E)");
  if (session.measure_error) {
    char text[64];
    std::snprintf(text, sizeof text, std::isnan(session.error) ? "..." : "%.3f of 255", session.error);
    ui::fact("RMSE", text);
    if (session.compare != Compare::none) {
      std::snprintf(text, sizeof text, std::isnan(session.error_second) ? "..." : "%.3f of 255", session.error_second);
      ui::fact("RMSE, right", text);
    }
  }
}

}  // namespace forelock::samples
