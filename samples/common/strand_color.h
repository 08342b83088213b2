// Colours that show what strands are like: values of each vertex, and the scale from blue to red that they are drawn in.
// SPDX-License-Identifier: MIT
#pragma once

#include <forelock/asset.h>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace forelock::samples {

// What the colours of a picture show beside FLK_DISPLAY_...: made here, of the strands alone.
enum class StrandColoring : uint32_t { none, curvature, length, segments, thickness, groups, guides, bad };

// As the command and scene files spell them, in the order of StrandColoring; the first is "shaded".
const std::vector<std::string>& coloringNames();

// A value of each vertex; each strand on its own.
std::vector<float> strandLengths(const FlkStrands& strands);    // of its strand (unit of the positions)
std::vector<float> strandCurvature(const FlkStrands& strands);  // angle turned per length (rad / unit); at the ends that of the neighbour
// Segment lengths by the mean of their strand: of the two that meet in a vertex the more unusual one.
std::vector<float> segmentRatios(const FlkStrands& strands);
std::vector<float> strandDiameters(const FlkStrands& strands);

// Where blue and red lie; values beyond have the colours of the ends.
struct ColorScale {
  double blue = 0.0, red = 1.0;
  bool logarithmic = false;
  double share(double value) const;  // 0 at blue, 1 at red
};

// A scale over what is usual among values: from the 5th to the 95th of a hundred, rounded outwards to two digits, or from 0 where
// `from_zero`. Where these are alike they lie in the middle, above 0.
ColorScale usualScale(const std::vector<float>& values, bool from_zero);

// Of a scale: blue, cyan, green, yellow, red; linear.
glm::vec3 scaleColor(double share);

// Number `index` of colours that are told apart, linear; they repeat after 12.
glm::vec3 distinctColor(uint32_t index);

// 3 a vertex, as FlkStrands.colors.
std::vector<float> scaleColors(const std::vector<float>& values, const ColorScale& scale);

}  // namespace forelock::samples
