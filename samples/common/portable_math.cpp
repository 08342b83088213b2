// SPDX-License-Identifier: MIT
#include "portable_math.h"

#include <cmath>

namespace forelock::samples {

namespace {

uint64_t mix(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

// Quintic fade: second derivatives are continuous across cells, so strands show no kinks.
double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

uint64_t cell(double floored) { return static_cast<uint64_t>(static_cast<int64_t>(floored)); }

}  // namespace

uint64_t hashBits(uint64_t seed, uint64_t a, uint64_t b, uint64_t c) {
  return mix(mix(mix(mix(seed) ^ a) ^ b) ^ c);
}

double hashUnit(uint64_t seed, uint64_t a, uint64_t b, uint64_t c) {
  return static_cast<double>(hashBits(seed, a, b, c) >> 11) * 0x1p-53;
}

double sinTurns(double turns) {
  double x = turns - std::floor(turns + 0.5);  // [-0.5, 0.5)
  if (x > 0.25) {
    x = 0.5 - x;
  } else if (x < -0.25) {
    x = -0.5 - x;
  }
  const double r = x * 6.283185307179586;
  const double q = r * r;
  // Taylor to r^17: the next term is below 3e-14 at a quarter turn.
  double sum = 1.0;
  for (int n = 8; n >= 1; --n) {
    sum = 1.0 - sum * q / static_cast<double>((2 * n) * (2 * n + 1));
  }
  return r * sum;
}

double atan2Turns(double y, double x) {
  const double ax = std::fabs(x);
  const double ay = std::fabs(y);
  const double largest = ax > ay ? ax : ay;
  if (!(largest > 0.0)) {
    return 0.0;
  }
  double z = (ax > ay ? ay : ax) / largest;  // [0, 1]
  double base = 0.0;
  if (z > 0.41421356237309503) {  // tan(pi/8): the series then sees |z| <= 0.4143
    z = (z - 1.0) / (z + 1.0);
    base = 0.125;
  }
  const double q = z * z;
  double sum = 0.0;
  for (int n = 10; n >= 0; --n) {
    sum = 1.0 / static_cast<double>(2 * n + 1) - q * sum;
  }
  double angle = base + z * sum * 0.15915494309189535;
  if (ay > ax) {
    angle = 0.25 - angle;
  }
  if (x < 0.0) {
    angle = 0.5 - angle;
  }
  return y < 0.0 ? -angle : angle;
}

double noise1(uint64_t seed, uint64_t stream, double x) {
  const double base = std::floor(x);
  const double f = x - base;
  const double g0 = hashSigned(seed, stream, cell(base));
  const double g1 = hashSigned(seed, stream, cell(base + 1.0));
  // Gradient noise has magnitude at most 0.5 between lattice points; doubled to fill [-1, 1].
  const double t = fade(f);
  return 2.0 * (g0 * f * (1.0 - t) + g1 * (f - 1.0) * t);
}

double noise3(uint64_t seed, uint64_t stream, const glm::dvec3& p) {
  const glm::dvec3 base(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  const glm::dvec3 f = p - base;
  const glm::dvec3 t(fade(f.x), fade(f.y), fade(f.z));
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1;
    const int dy = (corner >> 1) & 1;
    const int dz = corner >> 2;
    const double weight = (dx ? t.x : 1.0 - t.x) * (dy ? t.y : 1.0 - t.y) * (dz ? t.z : 1.0 - t.z);
    sum += weight * hashSigned(hashBits(seed, stream), cell(base.x + dx), cell(base.y + dy), cell(base.z + dz));
  }
  return sum;
}

}  // namespace forelock::samples
