// FLIP for pictures of low dynamic range: how different two pictures look when one takes the other's place.
// Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild: FLIP: A Difference Evaluator for Alternating Images,
// Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2), 2020. SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace forelock::study {

// A 0.7 m wide display of 3840 pixels seen from 0.7 m, as in the paper.
inline constexpr double kPixelsPerDegree = 67;

// Linear Rec. 709 primaries, clamped to [0, 1].
struct FlipInput {
  uint32_t width = 0, height = 0;
  std::vector<float> rgb;
};

// A value in [0, 1] a pixel. The pictures are of one size.
std::vector<float> flip(const FlipInput& reference, const FlipInput& test, double pixels_per_degree = kPixelsPerDegree);

// Parts, for tests.
std::array<double, 3> labOfLinear(double r, double g, double b);  // CIE L*a*b*, D65
std::array<double, 3> huntAdjusted(const std::array<double, 3>& lab);
double hyab(const std::array<double, 3>& a, const std::array<double, 3>& b);
double flipColorMaximum();             // of the powered colour difference: between green and blue
double redistributed(double powered);  // the powered colour difference into [0, 1]

}  // namespace forelock::study
