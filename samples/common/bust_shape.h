// The bust as a signed distance field: what grooms drape on and what the samples draw behind the hair.
// SPDX-License-Identifier: MIT
//
// Metres, y up, the face looks along +z, head centre at the origin, symmetric in x. Built from ellipsoids and capsules
// joined by polynomial smooth minima; +, -, *, / and sqrt only, so that the double instance gives the same bits
// everywhere. Distances are exact near the surface and may be up to 20 % off far from it.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace forelock::samples::shape {

template <typename T>
using Vec3 = glm::vec<3, T, glm::defaultp>;

// First-order distance to an ellipsoid: |p/r| (|p/r| - 1) / |p/r^2|.
template <typename T>
T ellipsoid(const Vec3<T>& p, const Vec3<T>& centre, const Vec3<T>& radii) {
  const Vec3<T> q = (p - centre) / radii;
  const Vec3<T> g = q / radii;
  const T k0 = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  const T k1 = std::sqrt(g.x * g.x + g.y * g.y + g.z * g.z);
  return k1 > T(0) ? k0 * (k0 - T(1)) / k1 : -radii.x;  // at the centre the quotient is 0/0
}

// Capsule from a to b whose radius goes linearly from ra to rb.
template <typename T>
T capsule(const Vec3<T>& p, const Vec3<T>& a, const Vec3<T>& b, T ra, T rb) {
  const Vec3<T> pa = p - a;
  const Vec3<T> ba = b - a;
  T h = (pa.x * ba.x + pa.y * ba.y + pa.z * ba.z) / (ba.x * ba.x + ba.y * ba.y + ba.z * ba.z);
  h = h < T(0) ? T(0) : h > T(1) ? T(1) : h;
  const Vec3<T> d = pa - ba * h;
  return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z) - (ra + (rb - ra) * h);
}

template <typename T>
T smoothMin(T a, T b, T k) {
  const T diff = a > b ? a - b : b - a;
  const T h = diff < k ? (k - diff) / k : T(0);
  return (a < b ? a : b) - h * h * k * T(0.25);
}

template <typename T>
T smoothMax(T a, T b, T k) {
  return -smoothMin(-a, -b, k);
}

template <typename T>
T torso(const Vec3<T>& q) {  // q.x >= 0
  using V = Vec3<T>;
  T d = capsule(q, V(0, T(-0.075), T(-0.024)), V(0, T(-0.215), T(-0.045)), T(0.050), T(0.056));
  if (q.y + T(0.130) > d + T(0.060)) {  // high above all that follows
    return d;
  }
  d = smoothMin(d, capsule(q, V(T(0.020), T(-0.175), T(-0.056)), V(T(0.150), T(-0.222), T(-0.050)), T(0.036), T(0.036)),
                T(0.040));
  d = smoothMin(d, capsule(q, V(T(0.050), T(-0.262), T(-0.046)), V(T(0.158), T(-0.252), T(-0.046)), T(0.062), T(0.060)),
                T(0.045));
  d = smoothMin(d, ellipsoid(q, V(0, T(-0.375), T(-0.030)), V(T(0.160), T(0.175), T(0.100))), T(0.060));
  d = smoothMin(d, ellipsoid(q, V(T(0.066), T(-0.372), T(0.018)), V(T(0.074), T(0.078), T(0.058))), T(0.060));
  d = smoothMin(d, capsule(q, V(T(0.176), T(-0.268), T(-0.048)), V(T(0.205), T(-0.460), T(-0.050)), T(0.050), T(0.044)),
                T(0.040));
  return d;
}

template <typename T>
T face(T d, const Vec3<T>& q) {  // q.x >= 0; d: the head without features
  using V = Vec3<T>;
  d = smoothMin(d, ellipsoid(q, V(0, T(-0.098), T(0.062)), V(T(0.024), T(0.018), T(0.024))), T(0.034));     // chin
  d = smoothMin(d, ellipsoid(q, V(T(0.038), T(-0.030), T(0.056)), V(T(0.022), T(0.022), T(0.022))), T(0.030));  // cheek
  d = smoothMin(d, ellipsoid(q, V(T(0.022), T(0.018), T(0.068)), V(T(0.028), T(0.011), T(0.013))), T(0.028));   // brow
  d = smoothMax(d, -ellipsoid(q, V(T(0.031), T(-0.002), T(0.100)), V(T(0.018), T(0.011), T(0.017))), T(0.018));
  d = smoothMin(d, ellipsoid(q, V(T(0.031), T(-0.003), T(0.0690)), V(T(0.0150), T(0.0095), T(0.0125))), T(0.008));
  d = smoothMin(d, capsule(q, V(0, T(0.010), T(0.080)), V(0, T(-0.034), T(0.102)), T(0.0065), T(0.0085)), T(0.014));
  d = smoothMin(d, ellipsoid(q, V(T(0.0100), T(-0.039), T(0.094)), V(T(0.0070), T(0.0062), T(0.0095))), T(0.008));
  d = smoothMin(d, ellipsoid(q, V(T(0.005), T(-0.0640), T(0.0850)), V(T(0.0165), T(0.0045), T(0.0085))), T(0.009));
  d = smoothMin(d, ellipsoid(q, V(0, T(-0.0725), T(0.0840)), V(T(0.0165), T(0.0055), T(0.0085))), T(0.009));
  return d;
}

template <typename T>
T head(const Vec3<T>& q) {  // q.x >= 0
  using V = Vec3<T>;
  T d = ellipsoid(q, V(0, T(0.022), T(-0.014)), V(T(0.076), T(0.088), T(0.096)));
  d = smoothMin(d, ellipsoid(q, V(0, T(-0.034), T(0.030)), V(T(0.061), T(0.084), T(0.060))), T(0.030));
  d = smoothMin(d, ellipsoid(q, V(T(0.074), T(-0.012), T(-0.010)), V(T(0.010), T(0.030), T(0.017))), T(0.012));  // ear
  const T fx = q.x, fy = q.y + T(0.036), fz = q.z - T(0.078);
  if (std::sqrt(fx * fx + fy * fy + fz * fz) - T(0.088) < d + T(0.034)) {
    d = face(d, q);
  }
  return d;
}

// Signed distance (m) of p to the bust, negative inside. The bust ends in a flat base at y = -0.43.
template <typename T>
T bust(const Vec3<T>& p) {
  // A rounded |x|: the mirror plane leaves no crease.
  const Vec3<T> q(std::sqrt(p.x * p.x + T(0.000036)), p.y, p.z);
  constexpr T joint = T(0.034);
  T d = torso(q);
  // Beyond the joint's reach the smooth minimum is the plain one: the head need not be looked at.
  const T head_bound = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z) - T(0.150);
  if (head_bound < d + joint) {
    d = smoothMin(d, head(q), joint);
  }
  return smoothMax(d, T(-0.43) - p.y, T(0.012));
}

// Gradient of the field by central differences on a tetrahedron, normalised: the outward normal.
template <typename T>
Vec3<T> bustNormal(const Vec3<T>& p) {
  using V = Vec3<T>;
  constexpr T h = T(0.0004);
  const V a(1, -1, -1), b(-1, -1, 1), c(-1, 1, -1), e(1, 1, 1);
  const V g = a * bust(p + a * h) + b * bust(p + b * h) + c * bust(p + c * h) + e * bust(p + e * h);
  const T length = std::sqrt(g.x * g.x + g.y * g.y + g.z * g.z);
  return length > T(0) ? g / length : V(0, 1, 0);
}

}  // namespace forelock::samples::shape
