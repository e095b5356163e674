// SPDX-License-Identifier: MIT
// The transformations of glTF's nodes. Private to gltf.cpp.
#pragma once

#include <array>

namespace limitcheck::data::io {

using Matrix = std::array<double, 16>;  // by columns, as glTF has them
inline constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

inline Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      for (int k = 0; k < 4; ++k) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return c;
}

inline double determinant(const Matrix& m) {
  return m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) +
         m[8] * (m[1] * m[6] - m[5] * m[2]);
}

inline std::array<double, 3> moved(const Matrix& m, const std::array<double, 3>& p) {
  std::array<double, 3> q{m[12], m[13], m[14]};
  for (int row = 0; row < 3; ++row)
    for (int k = 0; k < 3; ++k) q[row] += m[4 * k + row] * p[k];
  return q;
}
// Normals go with the cofactors: the transposed inverse, but for its length and, when mirrored, its sign.
inline std::array<double, 3> turned(const Matrix& m, const std::array<double, 3>& n) {
  const double sign = determinant(m) < 0 ? -1 : 1;
  std::array<double, 3> q{};
  for (int row = 0; row < 3; ++row)
    for (int k = 0; k < 3; ++k) {
      const int r1 = (row + 1) % 3, r2 = (row + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      q[row] += sign * (m[4 * k1 + r1] * m[4 * k2 + r2] - m[4 * k2 + r1] * m[4 * k1 + r2]) * n[k];
    }
  return q;
}

}  // namespace limitcheck::data::io
