// Double-precision matrices and vectors for the CPU side: column-major 4x4, column vectors.
#pragma once

#include <array>
#include <cmath>

namespace forelock {

using Vec3 = std::array<double, 3>;
using Mat4 = std::array<double, 16>;

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec3 operator*(Vec3 a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline double dot(Vec3 a, Vec3 b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalize(Vec3 a) { return a * (1.0 / length(a)); }

inline constexpr Mat4 kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

inline Mat4 operator*(const Mat4& a, const Mat4& b) {
  Mat4 r{};
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      for (int i = 0; i < 4; ++i) r[column * 4 + row] += a[i * 4 + row] * b[column * 4 + i];
  return r;
}
inline Vec3 transformPoint(const Mat4& m, Vec3 p) {
  return {m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12], m[1] * p[0] + m[5] * p[1] + m[9] * p[2] + m[13],
          m[2] * p[0] + m[6] * p[1] + m[10] * p[2] + m[14]};
}
inline Vec3 transformDirection(const Mat4& m, Vec3 v) {
  return {m[0] * v[0] + m[4] * v[1] + m[8] * v[2], m[1] * v[0] + m[5] * v[1] + m[9] * v[2],
          m[2] * v[0] + m[6] * v[1] + m[10] * v[2]};
}
// Of the upper 3x3: how volumes grow.
inline double determinant3(const Mat4& m) {
  return dot({m[0], m[1], m[2]}, cross({m[4], m[5], m[6]}, {m[8], m[9], m[10]}));
}
// Of any affine matrix whose determinant is not 0.
inline Mat4 inverseAffine(const Mat4& m) {
  const Vec3 x{m[0], m[1], m[2]}, y{m[4], m[5], m[6]}, z{m[8], m[9], m[10]};
  const double scale = 1.0 / determinant3(m);
  const Vec3 rows[3] = {cross(y, z) * scale, cross(z, x) * scale, cross(x, y) * scale};
  Mat4 r = kIdentity;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) r[column * 4 + row] = rows[row][column];
    r[12 + row] = -dot(rows[row], {m[12], m[13], m[14]});
  }
  return r;
}
// Of a rotation and translation.
inline Mat4 inverseRigid(const Mat4& m) {
  Mat4 r = kIdentity;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i * 4 + j] = m[j * 4 + i];
  const Vec3 t = transformDirection(r, {m[12], m[13], m[14]});
  r[12] = -t[0], r[13] = -t[1], r[14] = -t[2];
  return r;
}

}  // namespace forelock
