// What the numerics tests share: arrays of inputs, directions, values that a hostile caller would send.
#pragma once

#include "run_items.h"
#include "reference.h"
#include "stability.h"

#include <cfloat>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace forelock::test {

using reference::Vec3;

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInf = std::numeric_limits<float>::infinity();
inline constexpr float kDenormal = 1e-40f;
inline constexpr double kDegree = std::numbers::pi / 180;

inline void add(std::vector<float>& words, std::initializer_list<double> values) {
  for (const double v : values) words.push_back(float(v));
}
inline void add(std::vector<float>& words, Vec3 v) { add(words, {v.x, v.y, v.z}); }

inline uint32_t word(float v) {
  uint32_t bits;
  std::memcpy(&bits, &v, sizeof bits);
  return bits;
}

inline Vec3 at(const std::vector<float>& values, std::size_t i) { return {values[i], values[i + 1], values[i + 2]}; }
// As the device gets it.
inline Vec3 toFloat(Vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Vec3 v) { return std::sqrt(dot(v, v)); }
inline Vec3 scaled(Vec3 v, double s) { return {v.x * s, v.y * s, v.z * s}; }
inline Vec3 sum(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 normalized(Vec3 v) { return scaled(v, 1 / length(v)); }
inline double angleBetween(Vec3 a, Vec3 b) { return std::atan2(length(cross(a, b)), dot(a, b)); }
inline bool isFinite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
// cos(angle) a + sin(angle) b for unit a, b at right angles.
inline Vec3 turned(Vec3 a, Vec3 b, double angle) { return sum(scaled(a, std::cos(angle)), scaled(b, std::sin(angle))); }
inline Vec3 someNormal(Vec3 t) { return normalized(cross(t, std::fabs(t.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})); }

// Point i of n spread evenly over the sphere.
inline Vec3 fibonacci(std::size_t i, std::size_t n) {
  const double z = 1 - (2.0 * double(i) + 1) / double(n), r = std::sqrt(1 - z * z);
  const double turn = 2 * std::numbers::pi * std::fmod(double(i) * 0.61803398874989485, 1.0);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

inline Vec3 randomDirection(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const double z = 2 * uniform(random) - 1, r = std::sqrt(1 - z * z), turn = 2 * std::numbers::pi * uniform(random);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

}  // namespace forelock::test
