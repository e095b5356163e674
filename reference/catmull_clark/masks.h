// SPDX-License-Identifier: MIT
// Catmull-Clark's masks: subdivision, limit position and tangents, at vertices inside and on the boundary.
//
// All are written as a point plus weighted differences, so that coincident points stay coincident in floating
// point and a far-away origin does no harm. All weights but those of the tangents are rational at every
// valence.
//
// The ring of a vertex c, counter-clockwise seen from outside: its neighbours e_i, and f_i, which lies
// opposite c in the quad between e_i and e_{i+1}.
//
//      f_1 --- e_1 --- f_0         inside     e_0 .. e_{n-1}, f_0 .. f_{n-1}
//       |       |       |          boundary   e_0 .. e_K, f_0 .. f_{K-1}: a sector of K faces, e_0 and e_K
//      e_2 ---- c ---- e_0                    lie on the boundary
//       |       |       |
//      f_2 --- e_3 --- f_3
// [catmull1978; halstead1993; the paper's reference 1]
#pragma once

#include <cstddef>
#include <span>

#include "reference/number/number.h"
#include "reference/number/vec3.h"
#include "reference/point/boundary_curve.h"
#include "reference/point/normal.h"

namespace limitcheck::reference::catmull_clark {

/// The centroid of a face's corners, three or more.
template <class N>
Vec3<N> face_point(std::span<const Vec3<N>> corners) {
  Vec3<N> sum{};
  for (std::size_t i = 1; i < corners.size(); ++i) sum += corners[i] - corners[0];
  return corners[0] + sum * (N(1) / N(static_cast<int>(corners.size())));
}
/// The same of a quad.
template <class N>
Vec3<N> face_point(const Vec3<N>& a, const Vec3<N>& b, const Vec3<N>& c, const Vec3<N>& d) {
  return a + ((b - a) + (c - a) + (d - a)) * (N(1) / N(4));
}

/// Interior edge a-b between faces with the face points f1, f2: the mean of the four.
template <class N>
Vec3<N> edge_point(const Vec3<N>& a, const Vec3<N>& b, const Vec3<N>& f1, const Vec3<N>& f2) {
  return a + ((b - a) + (f1 - a) + (f2 - a)) * (N(1) / N(4));
}

/// Interior vertex of valence n: (n - 2) / n c + (sum e_i + sum F_i) / n^2, F_i the face points of this step.
///   valence   n, if there are no more than points with the same means
template <class N>
Vec3<N> interior_vertex_point(const Vec3<N>& c, std::span<const Vec3<N>> edges,
                              std::span<const Vec3<N>> face_points, int valence = 0) {
  const auto n = static_cast<int>(edges.size());
  Vec3<N> sum{};
  for (const Vec3<N>& e : edges) sum += e - c;
  for (const Vec3<N>& f : face_points) sum += f - c;
  return c + sum * (N(1) / (N(n) * N(valence > 0 ? valence : n)));
}

/// Limit of an interior vertex: n / (n + 5) c + 4 / (n (n + 5)) sum e_i + 1 / (n (n + 5)) sum f_i.
template <class N>
Vec3<N> interior_limit(const Vec3<N>& c, std::span<const Vec3<N>> edges, std::span<const Vec3<N>> faces) {
  const auto n = static_cast<int>(edges.size());
  Vec3<N> near{}, far{};
  for (const Vec3<N>& e : edges) near += e - c;
  for (const Vec3<N>& f : faces) far += f - c;
  return c + (near * N(4) + far) * (N(1) / (N(n) * N(n + 5)));
}

/// 4 lambda - 1 of the eigenvalue lambda = (5 + cos t + cos(t/2) sqrt(2 (9 + cos t))) / 16 of the first
/// frequency: t = 2 pi / n inside (q = n), t = pi / K on the boundary (q = 2 K).
template <class N>
N four_lambda_minus_one(long q) {
  const N c = NumberTraits<N>::cos_pi(2, q), half = NumberTraits<N>::cos_pi(1, q);
  return (N(1) + c + half * NumberTraits<N>::sqrt(N(2) * (N(9) + c))) * (N(1) / N(4));
}

/// C = sum 4 cos(i t) e_i + (cos(i t) + cos((i + 1) t)) / (4 lambda - 1) f_i and S with sines, t = 2 pi / n,
/// taken from differences to c. C points towards e_0, S a quarter turn on.
template <class N>
Tangents<N> interior_tangents(const Vec3<N>& c, std::span<const Vec3<N>> edges,
                              std::span<const Vec3<N>> faces) {
  const std::size_t n = edges.size();
  const CircleTable<N>& table = circle_table<N>(static_cast<long>(n));
  const N share = N(1) / four_lambda_minus_one<N>(static_cast<long>(n));
  Tangents<N> t{};
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t here = 2 * i, next = 2 * (i + 1) % (2 * n);
    add_difference(t.first, t.first_terms, N(4) * table.cosine[here], edges[i], c);
    add_difference(t.second, t.second_terms, N(4) * table.sine[here], edges[i], c);
    add_difference(t.first, t.first_terms, (table.cosine[here] + table.cosine[next]) * share, faces[i], c);
    add_difference(t.second, t.second_terms, (table.sine[here] + table.sine[next]) * share, faces[i], c);
  }
  return t;
}

/// Along the boundary, r_0 - r_K, and across it into the surface, for a sector of K faces with the ordinary
/// edge rule on its inner edges. With t = pi / K, lambda as above and T = cot(t / 2):
///
///   inner e_i   4 sin(i t)                   f_i   (sin(i t) + sin((i + 1) t)) / (4 lambda - 1)
///   ends        l0 = (4 lambda sin t - (8 lambda - 1) T) / (4 lambda - 1)^2
///   c           -2 l0 - T (16 lambda - 2) / (4 lambda - 1), which makes the sum zero
///   K = 1       (-2; 1, 1; 0)
///
/// The mask of catmarkScheme.h in OpenSubdiv belongs to another edge rule (Biermann, Levin, Zorin 2000). For
/// K = 4 the surface takes the plane on like 1/k, for K >= 5 it has none.
template <class N>
Tangents<N> boundary_tangents(const Vec3<N>& c, std::span<const Vec3<N>> edges,
                              std::span<const Vec3<N>> faces) {
  const std::size_t count = faces.size();
  Tangents<N> t{};
  add_difference(t.first, t.first_terms, N(1), edges.front(), edges.back());
  const auto across = [&](const Vec3<N>& r, const N& weight) {
    add_difference(t.second, t.second_terms, weight, r, c);
  };
  if (count == 1) {
    across(edges.front(), N(1));
    across(edges.back(), N(1));
    return t;
  }
  const CircleTable<N>& table = circle_table<N>(static_cast<long>(count));
  const N share = four_lambda_minus_one<N>(2 * static_cast<long>(count));
  const N cotangent = table.sine[1] / (N(1) - table.cosine[1]);
  const N end = ((share + N(1)) * table.sine[1] - (N(2) * share + N(1)) * cotangent) / (share * share);
  across(edges.front(), end);
  across(edges.back(), end);
  for (std::size_t i = 1; i < count; ++i) across(edges[i], N(4) * table.sine[i]);
  for (std::size_t i = 0; i < count; ++i) across(faces[i], (table.sine[i] + table.sine[i + 1]) / share);
  return t;
}

/// Eigenvalue of the mean at the tip of a cone, an interior vertex that is held: larger than that of the
/// first frequency at any valence, so that the surface has no tangent plane there.
template <class N>
N cone_eigenvalue() {
  return (N(3) + NumberTraits<N>::sqrt(N(5))) * (N(1) / N(8));
}

}  // namespace limitcheck::reference::catmull_clark
