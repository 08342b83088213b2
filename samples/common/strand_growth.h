// Grows one strand's centre line: combed, pulled down by gravity, kept outside the body. SPDX-License-Identifier: MIT
#pragma once

#include "groom_recipe.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace forelock::samples {

struct Root {
  glm::dvec3 position;   // on the skin (m)
  glm::dvec3 normal;     // out of the head
  double azimuth_turns;  // (-0.5, 0.5], 0 at the face, positive to the wearer's left (+x)
  double elevation_turns;
  double height;         // 0 at the nape, 1 at the crown
  double frontness;      // 0 at the back of the head, 1 at the front hairline
  double side;           // -1 or 1: of the parting
};

struct GrownPath {
  std::vector<glm::dvec3> points;   // a step apart, root first
  std::vector<glm::dvec3> outward;  // unit, across the path, away from the head: carried along without twist
};

// What hair is draped on.
class Body {
 public:
  explicit Body(const Recipe& recipe);
  double distance(const glm::dvec3& p) const;  // (m), negative inside
  glm::dvec3 normal(const glm::dvec3& p) const;

 private:
  bool bust_;
  glm::dvec3 centre_, radii_;
};

// `clearance` (m) is the distance from the skin that the strand keeps once it has left its root.
GrownPath growPath(const Recipe& recipe, const Body& body, const Root& root, double clearance, double lift,
                   double step, size_t steps);

}  // namespace forelock::samples
