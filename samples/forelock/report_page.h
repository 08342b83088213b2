// The page of a report: one file with everything in it. SPDX-License-Identifier: MIT
#pragma once

#include "report_pictures.h"

namespace forelock::samples {

struct PageInput {
  const StudyFacts& facts;
  const Plots& plots;
  const Pictures& pictures;
  bool with_pictures = true;  // false: they were not asked for
  std::string folder;         // where the paths of plots and pictures begin
  std::string command;        // that makes the page again
};

std::string escapeHtml(const std::string& text);
std::string base64(const std::string& bytes);

std::string makePage(const PageInput& input);

}  // namespace forelock::samples
