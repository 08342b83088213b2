// Plots of a report, drawn by gnuplot from scripts and data that stay beside them, so that anyone can redraw them.
// SPDX-License-Identifier: MIT
#pragma once

#include "report_facts.h"

#include <functional>

namespace forelock::samples {

// Fragments of a pixel, and how many pixels have as many: index 0 is of pixels without hair.
struct Histogram {
  std::string view;
  std::vector<uint64_t> pixels;
};

struct Plot {
  std::string section;  // error, passes, tail, load, sweeps
  std::string path;     // of the .svg, from the report's folder
  std::string title, caption;
};

struct Plots {
  std::vector<Plot> drawn;
  std::vector<std::string> problems;  // a sentence each
  bool no_gnuplot = false;
};

// Of a method, the same in every plot. Colours can be told apart by colour-blind eyes (Okabe and Ito), further methods get the
// colours that are left, then darker ones.
struct MethodStyle {
  std::string color;  // "#rrggbb"
  int point = 7;      // gnuplot's filled point; the number before it is the same one hollow
};
MethodStyle methodStyle(const StudyFacts& facts, const std::string& method);

// Writes FOLDER/error-vs-time.{svg,png} and everything else to FOLDER/report, which exists.
Plots drawPlots(const StudyFacts& facts, const std::vector<Histogram>& histograms, const std::string& folder,
                const std::function<void(uint64_t, uint64_t)>& progress);

// Letters, digits and "-_." of a name that came with the data, unique among `taken`.
std::string fileStem(const std::string& name, std::set<std::string>& taken);

// Text as gnuplot reads it, quotes and all, without what could end the string or start a command.
std::string gnuplotText(const std::string& text);

}  // namespace forelock::samples
