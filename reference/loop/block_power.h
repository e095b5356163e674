// SPDX-License-Identifier: MIT
// Powers of a triangular 3 x 3 matrix by divided differences.
#pragma once

namespace limitcheck::reference {

/// x^J, y^J, z^J and the divided differences of t^J at them: xy = (x^J - y^J) / (x - y), and so on. They are
/// the entries of the J-th power of the bidiagonal matrix (x 1; y 1; z), computed by repeated squaring: sums
/// of positive terms only, O(log J), and x, y, z may be equal.
template <class N>
struct BlockPower {
  N x, y, z, xy, yz, xz, xyz;

  BlockPower(const N& x1, const N& y1, const N& z1, long exponent)
      : x(1), y(1), z(1), xy(0), yz(0), xz(0), xyz(0) {
    int bit = 0;
    while ((exponent >> bit) > 1) ++bit;
    if (exponent > 0) {
      for (; bit >= 0; --bit) {
        xyz = x * xyz + xy * yz + xyz * z;
        xy = xy * (x + y);
        yz = yz * (y + z);
        xz = xz * (x + z);
        x = x * x;
        y = y * y;
        z = z * z;
        if (((exponent >> bit) & 1) != 0) {
          xyz = x1 * xyz + yz;
          xy = x1 * xy + y;
          yz = y1 * yz + z;
          xz = x1 * xz + z;
          x = x * x1;
          y = y * y1;
          z = z * z1;
        }
      }
    }
  }
};

/// a^e, e >= 0
template <class N>
N power(N a, long e) {
  N result(1);
  for (; e > 0; e >>= 1) {
    if ((e & 1) != 0) result = result * a;
    if (e > 1) a = a * a;
  }
  return result;
}

}  // namespace limitcheck::reference
