// SPDX-License-Identifier: MIT
// For hausdorff.cpp: triangles of a tessellation over those of a face's domain.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "verify/audit/vector.h"

namespace limitcheck::verify {

// Of triangles barycentric; in the domain affine, as Chart has them.
using Barycentric = std::array<double, 3>;

// A triangle of the tessellation over one face, its corners in the coordinates of that face, perhaps beyond
// its edges.
struct Over {
  std::int32_t triangle;
  std::array<Barycentric, 3> l;
};

inline double determinant(const Barycentric& a, const Barycentric& b, const Barycentric& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Coordinates of u with respect to a triangle of the domain.
inline Barycentric within(const std::array<Barycentric, 3>& t, double area, const Barycentric& u) {
  return {determinant(u, t[1], t[2]) / area, determinant(t[0], u, t[2]) / area,
          determinant(t[0], t[1], u) / area};
}

// The common part of two triangles of the domain: Sutherland
// and Hodgman's clipping of `a` along the sides of `b`.
inline void clip(const std::array<Barycentric, 3>& a, const std::array<Barycentric, 3>& b,
                 std::vector<Barycentric>& part) {
  const double area = determinant(b[0], b[1], b[2]);
  part.assign(a.begin(), a.end());
  std::vector<Barycentric> before;
  for (int k = 0; k < 3 && !part.empty(); ++k) {
    before.swap(part);
    part.clear();
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Barycentric &p = before[i], &q = before[(i + 1) % before.size()];
      const double x = within(b, area, p)[k], y = within(b, area, q)[k];
      if (x >= 0) part.push_back(p);
      if ((x > 0 && y < 0) || (x < 0 && y > 0)) {
        const double s = x / (x - y);
        part.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]), p[2] + s * (q[2] - p[2])});
      }
    }
  }
}

inline double area_of(const std::vector<Barycentric>& part) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < part.size(); ++k) sum += determinant(part[0], part[k], part[k + 1]);
  return std::abs(sum);
}

inline Vector mix(const std::array<Vector, 3>& corner, const Barycentric& weight) {
  return weight[0] * corner[0] + weight[1] * corner[1] + weight[2] * corner[2];
}

}  // namespace limitcheck::verify
