// SPDX-License-Identifier: MIT
#include "strand_growth.h"

#include "bust_shape.h"
#include "portable_math.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace forelock::samples {

namespace {

glm::dvec3 normalizeOr(const glm::dvec3& v, const glm::dvec3& fallback) {
  const double squared = glm::dot(v, v);
  return squared > 1e-24 ? v / std::sqrt(squared) : fallback;
}

// Where a comb leaves the hair: away from the parting and to the back; behind the crown, away from the whorl.
glm::dvec3 combedDirection(const Recipe& recipe, const Root& root) {
  const glm::dvec3 whorl = recipe.scalp.centre + glm::dvec3(recipe.parting.offset, recipe.scalp.radii.y * 0.85,
                                                            -recipe.scalp.radii.z * 0.55);
  // The downward part is for the temples, where what points sideways has next to no direction along the skin.
  const glm::dvec3 parted(root.side * recipe.parting.strength, -0.4 * recipe.flow.gravity, -recipe.flow.back);
  const glm::dvec3 straight = normalizeOr(root.position - whorl, glm::dvec3(0.0, -1.0, 0.0));
  const glm::dvec3 radial = straight + glm::cross(root.normal, straight) * 0.6;  // a whorl turns
  const double front = smoothStep(whorl.z - 0.02, whorl.z + 0.04, root.position.z);
  const glm::dvec3 strayed(noise3(recipe.seed, 1001, root.position * 150.0), 0.0,
                           noise3(recipe.seed, 1002, root.position * 150.0));
  glm::dvec3 wanted = parted * front + radial * ((1.0 - front) * recipe.flow.whorl) + strayed * 0.35;
  if (recipe.flow.ruffle > 0.0) {
    const glm::dvec3 place = root.position / recipe.flow.ruffle_size;
    wanted += glm::dvec3(noise3(recipe.seed, 1003, place), noise3(recipe.seed, 1004, place),
                         noise3(recipe.seed, 1005, place)) * recipe.flow.ruffle;
  }
  return normalizeOr(wanted - root.normal * glm::dot(wanted, root.normal), glm::dvec3(root.side, 0.0, 0.0));
}

// Pushes a point sideways out of the ellipsoid before the face, so that hair frames it.
void clearFace(const Recipe& recipe, const Root& root, glm::dvec3& point, glm::dvec3& direction) {
  const double gap = recipe.flow.face_gap;
  if (!(gap > 0.0)) {
    return;
  }
  const glm::dvec3 centre(0.0, -0.035, 0.090);
  const glm::dvec3 radii(gap, 0.115, 0.085);
  const double d = shape::ellipsoid<double>(point, centre, radii);
  if (d >= 0.0) {
    return;
  }
  const glm::dvec3 q = (point - centre) / (radii * radii);
  glm::dvec3 away = normalizeOr(glm::dvec3(q.x, 0.0, 0.25 * q.z), glm::dvec3(root.side, 0.0, 0.0));
  if (away.x * root.side < 0.0) {
    away.x = -away.x;
  }
  // Part of the way each step: a strand leaves the face in a curve rather than in a corner.
  point -= away * (d * 0.35);
  const double inward = glm::dot(direction, away);
  if (inward < 0.0) {
    direction -= away * inward;
  }
}

// Hair that comes to lie on a shoulder is drawn to the chest or to the back, and in from the arm, as hands and friction
// would; gravity alone would comb it over the arms.
glm::dvec3 shoulderPull(const Recipe& recipe, const Root& root, const glm::dvec3& point, double distance) {
  const double low = smoothStep(0.10, 0.17, -point.y) * (1.0 - smoothStep(0.015, 0.045, distance));
  const double side = smoothStep(0.06, 0.13, std::fabs(point.x));
  const double forward = point.z > -0.055 ? 1.0 : -1.0;
  // Neighbours differ smoothly, so that the hair fans out instead of ending in one rope.
  const double inward = 0.55 + 0.9 * noise3(recipe.seed, 1000, root.position * 40.0);
  return glm::dvec3(point.x > 0.0 ? -inward : inward, 0.0, 1.2 * forward) * (recipe.flow.gather * low * side);
}

}  // namespace

Body::Body(const Recipe& recipe)
    : bust_(recipe.drape_on_bust), centre_(recipe.scalp.centre), radii_(recipe.scalp.radii) {}

double Body::distance(const glm::dvec3& p) const {
  return bust_ ? shape::bust<double>(p) : shape::ellipsoid<double>(p, centre_, radii_);
}

glm::dvec3 Body::normal(const glm::dvec3& p) const {
  if (bust_) {
    return shape::bustNormal<double>(p);
  }
  return normalizeOr((p - centre_) / (radii_ * radii_), glm::dvec3(0.0, 1.0, 0.0));
}

GrownPath growPath(const Recipe& recipe, const Body& body, const Root& root, double clearance, double lift,
                   double step, size_t steps) {
  const glm::dvec3 gravity(0.0, -1.0, 0.0);
  const glm::dvec3 combed = combedDirection(recipe, root);
  const double turn = step / recipe.flow.bend;

  GrownPath path;
  path.points.reserve(steps + 1);
  path.outward.reserve(steps + 1);
  glm::dvec3 point = root.position;
  glm::dvec3 direction = normalizeOr(root.normal * lift + combed * (1.0 - lift), root.normal);
  glm::dvec3 outward = normalizeOr(root.normal - direction * glm::dot(root.normal, direction), gravity);
  path.points.push_back(point);
  path.outward.push_back(outward);
  double distance = 0.0;  // of the last point from the skin

  for (size_t i = 1; i <= steps; ++i) {
    const double s = static_cast<double>(i) * step;
    const double faded = 1.0 + (s / recipe.flow.comb) * (s / recipe.flow.comb);
    glm::dvec3 pull = gravity * recipe.flow.gravity + combed * (2.0 / (faded * faded));
    if (recipe.drape_on_bust) {
      pull += shoulderPull(recipe, root, point, distance);
    }
    direction = normalizeOr(direction + (pull - direction * glm::dot(pull, direction)) * turn, gravity);
    point += direction * step;
    clearFace(recipe, root, point, direction);

    const double kept = clearance * smoothStep(0.0, 0.09, s) + 0.001 * smoothStep(0.0, 0.006, s);
    distance = body.distance(point);
    if (distance < kept) {
      const glm::dvec3 normal = body.normal(point);
      point += normal * (kept - distance);
      distance = kept;
      const double inward = glm::dot(direction, normal);
      if (inward < 0.0) {
        direction = normalizeOr(direction - normal * inward, gravity);
      }
    }
    outward = normalizeOr(outward - direction * glm::dot(outward, direction), outward);
    path.points.push_back(point);
    path.outward.push_back(outward);
  }
  return path;
}

}  // namespace forelock::samples
