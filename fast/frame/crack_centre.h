// SPDX-License-Identifier: MIT
// The centre of a fan: limit position and normal at (1/3, 1/3, 1/3). [mueller2000, section 5; C61-C68, D10]
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "data/error.h"
#include "fast/plan/crack.h"
#include "fast/rules/prepared_mesh.h"

namespace limitcheck::fast {

/// Weights of the twelve control points of a regular triangle (4, 7, 8) at its centre, times 324. [C66]
///
///          1 --- 2                Rows as in Fig. 9. gamma = 1 at 4, alpha = 1 at 7, beta = 1 at 8.
///         / \   / \               .
///        3 --- 4 --- 5
///       / \   / \   / \           .
///      6 --- 7 --- 8 --- 9
///       \   / \   / \   /
///        10 -- 11 -- 12           After one subdivision step 4, 7, 8 are the edge points of the face,
///                                 5, 3, 11 its corners, and the others lie in its neighbours.
inline constexpr std::array<int, 12> kCentrePosition{1, 1, 14, 92, 14, 1, 92, 92, 1, 1, 14, 1};
/// The same for d/dalpha and d/dbeta, times 162; each sums to 0. [C68]
inline constexpr std::array<int, 12> kCentreAlpha{-4, -5, 0, -78, -30, 4, 78, 0, -1, 5, 30, 1};
inline constexpr std::array<int, 12> kCentreBeta{-5, -4, -30, -78, 0, -1, 0, 78, 4, 1, 30, 5};

/// Position and tangents at the centre of a regular triangle; p in the order above.
template <class N>
LimitFrame<N> regular_centre(const std::array<Vec3<N>, 12>& p) {
  using T = NumberTraits<N>;
  LimitFrame<N> frame{};
  for (std::size_t i = 0; i < 12; ++i) {
    const Vec3<N> difference = p[i] - p[3];
    frame.position = frame.position + T::ratio(kCentrePosition[i], 324) * difference;
    frame.du = frame.du + T::ratio(kCentreAlpha[i], 162) * difference;
    frame.dv = frame.dv + T::ratio(kCentreBeta[i], 162) * difference;
  }
  frame.position = p[3] + frame.position;
  return frame;
}

/// The twelve points around the middle sub-triangle of a control face after one step. Beyond a boundary edge
/// a b with c opposite lie ghosts a + b - c of its two halves, which give the same surface. [D10]
///   rings   slots 0 and 1 of rings[k] are corners k + 1 and k + 2
template <class N, class Vertex>
std::array<Vec3<N>, 12> twelve_points(const std::array<Vec3<N>, 3>& corner,
                                      const std::array<CornerRing<N, Vertex>, 3>& rings) {
  std::array<Vec3<N>, 3> vertex, edge, near_origin, near_target;  // per edge k, from corner k to k + 1
  for (std::size_t k = 0; k < 3; ++k) {
    vertex[k] = subdivide_corner(corner[k], rings[k]);
    const CornerRing<N, Vertex>& ring = rings[k];
    const Vec3<N>&to = corner[(k + 1) % 3], &opposite = corner[(k + 2) % 3];
    edge[k] = ring.has_face_after(ring.n - 1) ? edge_point(corner[k], to, opposite, ring.ring[ring.n - 1])
                                              : midpoint(corner[k], to);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const CornerRing<N, Vertex>&ring = rings[k], &next = rings[(k + 1) % 3];
    const Vec3<N>&from = corner[k], &to = corner[(k + 1) % 3];
    if (ring.has_face_after(ring.n - 1)) {
      const Vec3<N>& apex = ring.ring[ring.n - 1];
      near_origin[k] = ring.has_face_after(ring.n - 2) ? edge_point(from, apex, to, ring.ring[ring.n - 2])
                                                       : midpoint(from, apex);
      near_target[k] = next.has_face_after(2) ? edge_point(to, apex, from, next.at(3)) : midpoint(to, apex);
    } else {
      near_origin[k] = vertex[k] + edge[k] - edge[(k + 2) % 3];
      near_target[k] = edge[k] + vertex[(k + 1) % 3] - edge[(k + 1) % 3];
    }
  }
  return {near_target[0], near_origin[0], vertex[1],      edge[0],        vertex[0], near_origin[1],
          edge[1],        edge[2],        near_target[2], near_target[1], vertex[2], near_origin[2]};
}

/// Evaluates centres; arrays allocated once, one instance per thread.
template <class N, class Surface = LimitSurface<N>>
class FanCentreEvaluator {
 public:
  using Vertex = typename Surface::Vertex;
  using Wide = typename NumberTraits<N>::Wide;

  explicit FanCentreEvaluator(int max_valence) : storage_(3 * static_cast<std::size_t>(max_valence)) {}

  /// The normal is that of the limit surface, whatever the position.
  ///   throws   data::ArgumentError: a valence beyond the arrays
  Vertex evaluate(const PreparedMesh<N, Surface>& mesh, std::int32_t face, FanCentre centre) {
    const Adjacency& adjacency = mesh.adjacency();
    const std::size_t stride = storage_.size() / 3;
    if (static_cast<std::size_t>(adjacency.max_valence()) > stride)
      throw data::ArgumentError("fan centre: a valence beyond the arrays");
    std::array<Vec3<N>, 3> corner;
    std::array<CornerRing<N, Vertex>, 3> rings;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t h = 3 * face + static_cast<std::int32_t>(k);
      corner[k] = mesh.position(adjacency.origin(h));
      rings[k] = gather_corner(mesh, h, false, storage_.data() + k * stride);
    }
    const std::array<Vec3<N>, 12> points = twelve_points(corner, rings);
    std::array<Vec3<Wide>, 12> wide;
    for (std::size_t i = 0; i < 12; ++i) wide[i] = widen<N>(points[i]);
    LimitFrame<Wide> frame = regular_centre(wide);
    const auto third = NumberTraits<Wide>::ratio(1, 3);
    if (centre == FanCentre::kFlatControl)
      frame.position = third * (widen<N>(corner[0]) + widen<N>(corner[1]) + widen<N>(corner[2]));
    if (centre == FanCentre::kFlatLimit) {
      const auto limit = [&](int k) { return widen<N>(mesh.limit(adjacency.corner(face, k)).position); };
      frame.position = third * (limit(0) + limit(1) + limit(2));
    }
    return Surface::vertex(
        LimitFrame<N>{narrow<N>(frame.position), narrow<N>(frame.du), narrow<N>(frame.dv)},
        [&] { return substitute(wide, corner); }, zero_normals_);
  }

  std::int64_t zero_normals() const { return zero_normals_; }

 private:
  /// The centre is no vertex: the face around it after one step, else the control face, else (0, 0, 1). [D12]
  static Vec3<Wide> substitute(const std::array<Vec3<Wide>, 12>& points,
                               const std::array<Vec3<N>, 3>& corner) {
    const Vec3<Wide> finer[] = {points[6], points[7]}, control[] = {widen<N>(corner[1]), widen<N>(corner[2])};
    Vec3<Wide> normal = area_normal<Wide>(points[3], finer, true, kParallel<N>);
    if (normal == Vec3<Wide>{}) normal = area_normal<Wide>(widen<N>(corner[0]), control, true, kParallel<N>);
    return normal != Vec3<Wide>{} ? normal : Vec3<Wide>{Wide(0), Wide(0), Wide(1)};
  }

  std::vector<Vec3<N>> storage_;
  std::int64_t zero_normals_ = 0;
};

}  // namespace limitcheck::fast
