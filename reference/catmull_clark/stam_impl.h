// SPDX-License-Identifier: MIT
// Definitions behind stam.h, for the .cpp files that instantiate them.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <type_traits>
#include <utility>

#include "reference/catmull_clark/patch.h"
#include "reference/catmull_clark/refine.h"
#include "reference/catmull_clark/stam.h"
#include "reference/catmull_clark/stepped_ring_impl.h"
#include "reference/catmull_clark/two_ring.h"
#include "reference/mesh/cut_mesh.h"
#include "reference/point/parameter_exact.h"

namespace limitcheck::reference::catmull_clark {
namespace detail {

/// The points (x, y), -1 <= x, y <= 3, one step after a sector's two-ring, where c is (0, 0), e_i (2, 0) and
/// e_{i+1} (0, 2). (-1, -1) has no point and is not needed.
template <class N>
class FinerSector {
 public:
  explicit FinerSector(const TwoRingSector<N>& s) {
    const Vec3<N> c{};
    const auto& e = s.e;
    const auto& f = s.f;
    const auto& p = s.p;
    // Face points, then edge points between them, then vertices.
    put(1, 1) = face_point(c, e[2], f[2], e[3]);
    put(3, 1) = face_point(e[2], p[0], s.g, f[2]);
    put(1, 3) = face_point(e[3], f[2], s.h, p[1]);
    put(3, 3) = face_point(f[2], s.g, s.r, s.h);
    put(1, 2) = edge_point(e[3], f[2], at(1, 1), at(1, 3));
    put(2, 1) = edge_point(e[2], f[2], at(1, 1), at(3, 1));
    put(3, 2) = edge_point(f[2], s.g, at(3, 1), at(3, 3));
    put(2, 3) = edge_point(f[2], s.h, at(1, 3), at(3, 3));
    put(2, 2) = regular(f[2], {e[2], e[3], s.g, s.h}, {at(1, 1), at(3, 1), at(1, 3), at(3, 3)});
    put(0, 0) = s.c_after;
    using Side = typename TwoRingSector<N>::Side;
    if (s.before == Side::kBoundary) {
      put(1, 0) = boundary_edge_point(c, e[2]);
      put(3, 0) = boundary_edge_point(e[2], p[0]);
      put(2, 0) = boundary_vertex_point(e[2], c, p[0]);
    } else {
      put(1, -1) = face_point(c, e[1], f[1], e[2]);
      put(3, -1) = face_point(e[2], f[1], s.h_before, p[0]);
      put(1, 0) = edge_point(c, e[2], at(1, 1), at(1, -1));
      put(3, 0) = edge_point(e[2], p[0], at(3, 1), at(3, -1));
      put(2, -1) = edge_point(e[2], f[1], at(1, -1), at(3, -1));
      put(2, 0) = regular(e[2], {c, p[0], f[2], f[1]}, {at(1, 1), at(3, 1), at(1, -1), at(3, -1)});
      put(0, -1) = s.before == Side::kFaceThenBoundary
                       ? boundary_edge_point(c, e[1])
                       : edge_point(c, e[1], at(1, -1), face_point(c, e[0], f[0], e[1]));
    }
    if (s.after == Side::kBoundary) {
      put(0, 1) = boundary_edge_point(c, e[3]);
      put(0, 3) = boundary_edge_point(e[3], p[1]);
      put(0, 2) = boundary_vertex_point(e[3], c, p[1]);
    } else {
      put(-1, 1) = face_point(c, e[3], f[3], e[4]);
      put(-1, 3) = face_point(e[3], p[1], s.g_after, f[3]);
      put(0, 1) = edge_point(c, e[3], at(1, 1), at(-1, 1));
      put(0, 3) = edge_point(e[3], p[1], at(1, 3), at(-1, 3));
      put(-1, 2) = edge_point(e[3], f[3], at(-1, 1), at(-1, 3));
      put(0, 2) = regular(e[3], {c, p[1], f[2], f[3]}, {at(1, 1), at(1, 3), at(-1, 1), at(-1, 3)});
      put(-1, 0) = s.after == Side::kFaceThenBoundary
                       ? boundary_edge_point(c, e[4])
                       : edge_point(c, e[4], at(-1, 1), face_point(c, e[4], f[4], e[5]));
    }
    for (int i = 0; i <= 3; ++i) {
      if (s.before == Side::kBoundary) put(i, -1) = ghost_point(at(i, 0), at(i, 1));
      if (s.after == Side::kBoundary) put(-1, i) = ghost_point(at(0, i), at(1, i));
    }
  }

  /// The sixteen points around the quad from (x, y) to (x + 1, y + 1).
  Patch<N> patch(int x, int y) const {
    Patch<N> result;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) result[static_cast<std::size_t>(4 * j + i)] = at(x - 1 + i, y - 1 + j);
    return result;
  }

 private:
  static Vec3<N> regular(const Vec3<N>& v, const std::array<Vec3<N>, 4>& edges,
                         const std::array<Vec3<N>, 4>& faces) {
    return interior_vertex_point<N>(v, edges, faces);
  }
  Vec3<N>& put(int x, int y) { return points_[static_cast<std::size_t>(5 * (y + 1) + x + 1)]; }
  const Vec3<N>& at(int x, int y) const { return points_[static_cast<std::size_t>(5 * (y + 1) + x + 1)]; }

  std::array<Vec3<N>, 25> points_;
};

template <class N>
class StamData {
 public:
  StamData(data::Faces faces, std::vector<Vec3<N>> positions, const SharpTags& tags, const Valences& valences)
      : StamData(QuadMesh<N>(std::move(faces), std::move(positions), tags, valences), {}, valences) {}
  /// `asked` says where anybody will ask of each quad, everywhere if it is empty.
  explicit StamData(TaggedMesh<N> mesh, const std::vector<int>& asked)
      : StamData(QuadMesh<N>(std::move(mesh)), asked) {}
  explicit StamData(QuadMesh<N> mesh, const std::vector<int>& asked = {}, const Valences& valences = {})
      : mesh_(std::move(mesh)), next_(mesh_.needs_a_step, asked) {
    if (!mesh_.answers_any(asked)) return;
    points_ = points_after_step(mesh_.topology, mesh_.positions, mesh_.states, valences);
    const Topology finer(points_.size(), refined_faces(mesh_.topology));
    make_two_rings(finer, valences);
    make_patches(finer, asked);
  }

  std::size_t face_count() const { return mesh_.face_count(); }
  static int corner_of_child(int k) { return k; }

  template <class P>
  SurfacePoint<N> evaluate(int face, int corner, const P& u, const P& v, Derivatives order) const {
    const QuadParameter<P> at = locate(mesh_, face, corner, u, v);
    return mesh_.is_settled(at.quad) ? evaluate(at, order) : evaluate_after_steps(at, order);
  }

 private:
  template <class P>
  SurfacePoint<N> evaluate(const QuadParameter<P>& at, Derivatives order) const {
    const P half = P(1) / P(2);
    const bool right = at.u > half, up = at.v > half;
    const std::size_t k = up ? (right ? 2 : 3) : (right ? 1 : 0);
    const std::int32_t ring = two_ring_of_[static_cast<std::size_t>(mesh_.topology.faces()[at.quad][k])];
    const N halved(at.halved ? 2 : 1);
    SurfacePoint<N> result;
    if (ring < 0) {
      Patch<N> patch;
      for (std::size_t i = 0; i < 16; ++i)
        patch[i] = points_[static_cast<std::size_t>(patches_[4 * at.quad + k][i])];
      const LocalPoint<N> p = evaluate_patch<N>(patch, number_from<N>(P(2 * at.u - (right ? 1 : 0))),
                                                number_from<N>(P(2 * at.v - (up ? 1 : 0))), order);
      result.position = p.position;
      set_derivatives(result, p, turn_of(0), N(2) * halved, N(4) * halved * halved, order);
    } else {
      // Towards the next and the previous corner; 1 - u is exact next to u = 1.
      const P from_right = 2 * (1 - at.u), from_top = 2 * (1 - at.v), from_left = 2 * at.u,
              from_bottom = 2 * at.v;
      const P x = k == 0 ? from_left : k == 1 ? from_bottom : k == 2 ? from_right : from_top;
      const P y = k == 0 ? from_bottom : k == 1 ? from_right : k == 2 ? from_top : from_left;
      if (x == 0 && y == 0) return evaluate_corner(at.quad, k, at.halved, order);
      near_corner(rings_[static_cast<std::size_t>(ring)], mesh_.topology.ring_index(at.quad, k), x, y,
                  turn_of(k), halved, order, result);
    }
    if (order != Derivatives::kPosition) set_normal(result, tangents_of(result), fallback(at.quad));
    return result;
  }

  /// Near semi-sharp tags: on the piece of the quad that has none.
  template <class P>
  SurfacePoint<N> evaluate_after_steps(QuadParameter<P> at, Derivatives order) const {
    long steps = 0;
    SurfacePoint<N> result;
    if constexpr (std::is_same_v<N, double>) {
      const StamData* level = this;
      for (; !level->mesh_.is_settled(at.quad); ++steps) {
        const bool at_corner = (at.u == 0 || at.u == 1) && (at.v == 0 || at.v == 1);
        const int k = static_cast<int>(descend(at.u, at.v));
        level = &level->next_.descend(
            at.quad, k, at_corner, *level->mesh_.tagged,
            [](const TaggedMesh<N>& mesh) { return refine_once(mesh, data::TriangleRule::kCatmark); });
      }
      result = level->evaluate(at, order);
    } else {  // whoever wants many digits asks for few points
      const StamData piece(settled_around(*mesh_.tagged, at.quad, at.u, at.v, steps));
      at.quad = 0;
      result = piece.evaluate(at, order);
    }
    scale_derivatives(result, power(N(2), steps));
    return result;
  }

  SurfacePoint<N> evaluate_corner(std::size_t quad, std::size_t k, bool halved, Derivatives order) const {
    const std::int32_t v = mesh_.topology.faces()[quad][k];
    const auto known = limit_of_.find(v);
    const Sector sector = mesh_.topology.sector(v);
    return extraordinary_corner<N>(known != limit_of_.end() ? known->second : limit_of(corner_of(v)),
                                   {static_cast<int>(sector.faces.size()), mesh_.topology.ring_index(quad, k),
                                    !sector.closed, state_of(mesh_.states, v)},
                                   k, halved, order);
  }
  RingedCorner<Vec3<N>> corner_of(std::int32_t v) const {
    return gather_vertex<Vec3<N>>(
        mesh_.topology, v,
        [&](std::int32_t of) -> const Vec3<N>& { return mesh_.positions[static_cast<std::size_t>(of)]; },
        mesh_.states);
  }
  Vec3<N> fallback(std::size_t quad) const {
    const auto at = [&](std::size_t k) -> const Vec3<N>& {
      return mesh_.positions[static_cast<std::size_t>(mesh_.topology.faces()[quad][k])];
    };
    return area_of(at(0), at(1), at(2), at(3));
  }

  template <class P>
  void near_corner(const TwoRing<N>& ring, int sector, const P& x, const P& y, const ParameterGradients& turn,
                   const N& halved, Derivatives order, SurfacePoint<N>& result) const {
    const long steps = steps_to_corner(std::max(x, y));
    const P a = times_power_of_two(x, steps + 1),
            b = times_power_of_two(y, steps + 1);  // the larger in (1, 2]
    TwoRingSector<N> s;
    ring.sector(sector, steps, s);
    const int i = a >= 1 ? 1 : 0, j = b >= 1 ? 1 : 0;
    const LocalPoint<N> p = evaluate_patch<N>(FinerSector<N>(s).patch(i, j), number_from<N>(P(a - i)),
                                              number_from<N>(P(b - j)), order, ring.size(steps));
    const N growth = ring.growth();
    result.position = ring.limit() + (p.position - s.c_to_limit) * power(growth, steps);
    set_derivatives(result, p, turn, N(4) * halved * power(N(2) * growth, steps),
                    N(16) * halved * halved * power(N(4) * growth, steps), order);
  }

  void make_two_rings(const Topology& finer, const Valences& valences) {
    two_ring_of_.assign(mesh_.topology.vertex_count(), -1);
    const auto at = [&](std::int32_t v) -> const Vec3<N>& { return points_[static_cast<std::size_t>(v)]; };
    const auto index = [](std::int32_t v) { return v; };
    for (std::size_t id = 0; id < two_ring_of_.size(); ++id) {
      const auto v = static_cast<std::int32_t>(id);
      const Sector sector = finer.sector(v);
      const VertexState state = state_of(mesh_.states, v);
      const int faces = valence_of(valences, v, sector.faces.size());
      if (faces == 0 || is_regular_vertex(faces, !sector.closed, state)) continue;
      TwoRingPoints<N> points;
      points.c = at(v);
      for (const std::int32_t f : sector.faces) {
        const auto quad = finer.faces()[static_cast<std::size_t>(f)];
        std::size_t k = 0;
        while (quad[k] != v) ++k;
        const auto corner = [&](std::size_t i) {  // of the quad, but for v, whose ring may be large
          return gather_corner<std::int32_t>(finer, static_cast<std::size_t>(f), (k + i) % 4, index);
        };
        const auto next = corner(1), far = corner(2), last = corner(3);
        points.e.push_back(at(next.point)), points.p.push_back(at(next.edge(-1)));
        points.f.push_back(at(far.point)), points.r.push_back(at(far.face(2)));
        points.g.push_back(at(next.face(-1))), points.h.push_back(at(last.face(1)));
        if (!sector.closed && f == sector.faces.back())
          points.e.push_back(at(last.point)), points.p.push_back(at(last.edge(2)));
      }
      two_ring_of_[id] = static_cast<std::int32_t>(rings_.size());
      if (sector.closed && faces < kManyFaces) {
        const std::pair key(faces, state);
        rings_.emplace_back(interior_.try_emplace(key, faces, state).first->second, points);
      } else {
        const std::tuple key(faces, sector.closed, state);
        const bool closed = sector.closed;
        rings_.emplace_back(stepped_.try_emplace(key, faces, closed, state).first->second, points);
      }
      if (kRounds<N> && faces >= kManyFaces)  // who asks for balls asks for few points
        limit_of_.emplace(v, limit_of(corner_of(v)));
    }
  }

  void make_patches(const Topology& finer, const std::vector<int>& asked) {
    patches_.resize(finer.faces().size());
    for (std::size_t child = 0; child < patches_.size(); ++child) {
      if (!mesh_.is_answered(child / 4, asked)) continue;
      if (two_ring_of_[static_cast<std::size_t>(mesh_.topology.faces()[child / 4][child % 4])] >= 0) continue;
      const auto quad = gather<std::int32_t>(
          finer, child, [](std::int32_t v) { return v; }, mesh_.states);
      patches_[child] = quad.patch([&](std::int32_t on, std::int32_t inside) {
        points_.push_back(
            ghost_point(points_[static_cast<std::size_t>(on)], points_[static_cast<std::size_t>(inside)]));
        return static_cast<std::int32_t>(points_.size() - 1);
      });
    }
  }

  QuadMesh<N> mesh_;
  NextStep<N, StamData> next_;
  std::vector<Vec3<N>> points_;  ///< after one more step: vertices, edge points, face points, then ghosts
  std::vector<std::array<std::int32_t, 16>> patches_;  ///< of the quads of that step
  std::vector<std::int32_t> two_ring_of_;              ///< of each vertex of mesh_, -1 where it is regular
  std::map<std::pair<int, VertexState>, InteriorKind<N>> interior_;
  std::map<std::tuple<int, bool, VertexState>, SteppedRingKind<N>> stepped_;
  std::vector<TwoRing<N>> rings_;
  std::map<std::int32_t, VertexLimit<N>> limit_of_;  ///< of vertices of many faces, each of which may ask
};

}  // namespace detail

template <class N>
StamEvaluator<N>::StamEvaluator(data::Faces faces, std::vector<Vec3<N>> positions, const SharpTags& tags,
                                const Valences& valences)
    : data_(std::make_shared<const detail::StamData<N>>(std::move(faces), std::move(positions), tags,
                                                        valences)) {}

template <class N>
int StamEvaluator<N>::face_count() const {
  return static_cast<int>(data_->face_count());
}

template <class N>
SurfacePoint<N> StamEvaluator<N>::evaluate(int face, int corner, double u, double v,
                                           Derivatives order) const {
  if constexpr (std::is_same_v<N, double>) {
    return data_->evaluate(face, corner, u, v, order);
  } else {
    return evaluate(face, corner, Parameter(u), Parameter(v), order);
  }
}

template <class N>
SurfacePoint<N> StamEvaluator<N>::evaluate(int face, int corner, const Parameter& u, const Parameter& v,
                                           Derivatives order) const {
  if constexpr (std::is_same_v<N, double>)
    if (u.is_double() && v.is_double())
      return data_->evaluate(face, corner, u.as_double(), v.as_double(), order);
  return data_->evaluate(face, corner, exact_value(u), exact_value(v), order);
}

}  // namespace limitcheck::reference::catmull_clark
