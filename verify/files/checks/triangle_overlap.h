// SPDX-License-Identifier: MIT
// For overlay.h: triangles of a tessellation over those of a face's domain.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "verify/evidence/vector.h"

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

// A convex polygon of few corners. Cutting along a side adds one corner at most, but for rounding.
class Part {
 public:
  static constexpr std::size_t kMost = 12;
  std::size_t size() const { return size_; }
  const Barycentric& operator[](std::size_t k) const { return corner_[k]; }
  const Barycentric* begin() const { return corner_.data(); }
  const Barycentric* end() const { return corner_.data() + size_; }
  void clear() { size_ = 0; }
  void push_back(const Barycentric& corner) {
    if (size_ < kMost) corner_[size_++] = corner;
  }

 private:
  std::array<Barycentric, kMost> corner_;
  std::size_t size_ = 0;
};

// The common part of two triangles of the domain: Sutherland
// and Hodgman's clipping of `a` along the sides of `b`.
inline Part clip(const std::array<Barycentric, 3>& a, const std::array<Barycentric, 3>& b) {
  const double sign = determinant(b[0], b[1], b[2]) < 0 ? -1 : 1;
  Part part;
  for (const Barycentric& corner : a) part.push_back(corner);
  for (std::size_t k = 0; k < 3 && part.size() > 0; ++k) {
    const Part before = part;
    std::array<double, Part::kMost> height;  // over side k of b, in any unit
    for (std::size_t i = 0; i < before.size(); ++i)
      height[i] = sign * determinant(before[i], b[(k + 1) % 3], b[(k + 2) % 3]);
    part.clear();
    for (std::size_t i = 0; i < before.size(); ++i) {
      const std::size_t next = i + 1 < before.size() ? i + 1 : 0;
      const Barycentric &p = before[i], &q = before[next];
      const double x = height[i], y = height[next];
      if (x >= 0) part.push_back(p);
      if ((x > 0 && y < 0) || (x < 0 && y > 0)) {
        const double s = x / (x - y);
        part.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]), p[2] + s * (q[2] - p[2])});
      }
    }
  }
  return part;
}

inline double area_of(const Part& part) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < part.size(); ++k) sum += determinant(part[0], part[k], part[k + 1]);
  return std::abs(sum);
}

inline Vector mix(const std::array<Vector, 3>& corner, const Barycentric& weight) {
  return weight[0] * corner[0] + weight[1] * corner[1] + weight[2] * corner[2];
}

}  // namespace limitcheck::verify
