// Arithmetic that gives the same bits on every machine: hashes, angles and noise from +, -, *, / and sqrt alone.
// SPDX-License-Identifier: MIT
//
// The C library's sin, atan2 and exp may differ in the last bit from platform to platform; a groom must not.
// Holds only where the compiler does not fuse multiplications and additions (-ffp-contract=off).
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace forelock::samples {

// A well mixed 64-bit number from four small ones (splitmix64 finaliser over a chain).
uint64_t hashBits(uint64_t seed, uint64_t a, uint64_t b = 0, uint64_t c = 0);

// Uniform in [0, 1), a multiple of 2^-53.
double hashUnit(uint64_t seed, uint64_t a, uint64_t b = 0, uint64_t c = 0);

// Uniform in [-1, 1).
inline double hashSigned(uint64_t seed, uint64_t a, uint64_t b = 0, uint64_t c = 0) {
  return 2.0 * hashUnit(seed, a, b, c) - 1.0;
}

// Angles are in turns (1 turn = 2 pi rad): their reduction is exact. Error below 1e-12.
double sinTurns(double turns);
inline double cosTurns(double turns) { return sinTurns(turns + 0.25); }

// Angle of (x, y) in (-0.5, 0.5] turns; 0 for the zero vector. Error below 1e-9 turns.
double atan2Turns(double y, double x);

// Smooth noise in [-1, 1] with one lattice cell a unit; `stream` selects independent noises.
double noise1(uint64_t seed, uint64_t stream, double x);
double noise3(uint64_t seed, uint64_t stream, const glm::dvec3& p);

inline double clamp01(double x) { return x < 0.0 ? 0.0 : x > 1.0 ? 1.0 : x; }

// 0 up to `from`, 1 from `to` on, smooth between; a step where both are equal.
inline double smoothStep(double from, double to, double x) {
  const double t = to > from ? clamp01((x - from) / (to - from)) : (x >= from ? 1.0 : 0.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace forelock::samples
