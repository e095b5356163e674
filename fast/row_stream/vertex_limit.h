// SPDX-License-Identifier: MIT
// Limit position, limit normal and ring recursion of one control vertex, in double and in the order of its
// ring.
#pragma once

#include <array>
#include <vector>

namespace limitcheck::fast::row_stream {

struct Vec {
  double x = 0, y = 0, z = 0;
  friend Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec operator*(double s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
};

struct VertexLimit {
  std::array<double, 2> recursion;  // c' = 8 c + k0 d, d' = k1 d: both 8 times the subdivided ones
  Vec difference;                   // d: sum of r_i - c over the ring; over its two ends on the boundary
  Vec position;
  Vec normal;               // unit, outward for a counter-clockwise ring
  bool degenerate = false;  // the tangents did not span a plane [claim D12]
};

/// cos and sin of 2 pi k / n, made once per valence.
class ValenceTables {
 public:
  struct Angle {
    double cos, sin;
  };
  const std::vector<Angle>& angles(int n);
  /// Loop's a(n).                                                                                      [claim
  /// C11]
  double weight(int n) { return (angles(n), weights_[static_cast<std::size_t>(n)]); }

 private:
  std::vector<std::vector<Angle>> tables_;
  std::vector<double> weights_;
};

/// Closed ring, counter-clockwise, n >= 3. Limit weight 3 n / (8 a(n)) : 1; tangents sum cos, sum sin.  [C10,
/// C14, C17]
VertexLimit interior_limit(const Vec& v, const std::vector<Vec>& ring, ValenceTables& tables);

/// Open ring r_0 .. r_K, K >= 1. Limit (4 v + r_0 + r_K) / 6, along r_0 - r_K, across by the eigenvector of
/// the ordinary interior rules. For K >= 6 the surface has no unique tangent plane there. [claims D1, D2, D5]
VertexLimit boundary_limit(const Vec& v, const std::vector<Vec>& ring);

}  // namespace limitcheck::fast::row_stream
