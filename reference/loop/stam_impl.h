// SPDX-License-Identifier: MIT
// Definitions behind stam.h, for the .cpp files that instantiate them.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <variant>

#include "data/error.h"
#include "reference/loop/ringed_face.h"
#include "reference/loop/stam.h"
#include "reference/loop/stepped_ring.h"
#include "reference/loop/sub_faces.h"
#include "reference/loop/two_ring.h"
#include "reference/mesh/cut_mesh.h"

namespace limitcheck::reference {
namespace detail {

template <class N>
class StamData {
 public:
  /// `asked` says where anybody will ask of each face, everywhere if it is empty.
  StamData(TaggedMesh<N> mesh, const std::vector<int>& asked, Weights weights)
      : StamData(CutMesh<N>(std::move(mesh)), weights, asked) {}
  StamData(CutMesh<N> mesh, Weights weights, const std::vector<int>& asked = {}, Valences valences = {})
      : weights_(weights),
        valences_(std::move(valences)),
        mesh_(std::move(mesh)),
        next_(mesh_.needs_a_step, asked),
        topology_(mesh_.topology),
        control_(mesh_.positions) {
    if (!mesh_.answers_any(asked)) return;
    points_ = refine_once(topology_, control_, weights, mesh_.states, valences_);
    make_two_rings();
    make_patches(asked);
  }
  StamData(const StamData&) = delete;  // its members refer to each other
  StamData& operator=(const StamData&) = delete;

  int face_count() const { return static_cast<int>(topology_.faces().size()); }
  /// A sub-face at a corner begins there.
  static int corner_of_child(int k) { return k < 3 ? 0 : kNowhere; }

  template <class P>
  SurfacePoint<N> evaluate(int face, const P& l1, const P& l2, Derivatives order) const {
    if (face < 0 || face >= face_count()) throw data::ArgumentError("no face " + std::to_string(face));
    const std::size_t f = face;
    const SubFaceLocation<P> location = locate<P>(l1, l2);
    if (!mesh_.is_settled(f)) return evaluate_after_steps(f, l1, l2, order);
    SurfacePoint<N> result;
    const std::size_t corner = location.subface;
    const std::int32_t v = location.subface == 3 ? -1 : topology_.faces()[f][corner];
    const std::int32_t ring = v < 0 ? -1 : ring_of_[v];
    if (ring < 0)
      evaluate_regular(f, location, order, result);
    else if (location.u + location.v == 0)
      return evaluate_corner(f, location.subface, location.gradients, order);
    else
      std::visit([&](const auto& its) { evaluate_near_corner(f, location, its, order, result); },
                 rings_[ring]);
    if (order == Derivatives::kPosition) return result;
    Tangents<N> tangents = tangents_of(result);
    if (ring >= 0 && is_ordinary_end(v) && nearly_parallel(result.t1, result.t2))
      separate_tangents(f, location, std::get<SteppedRing<N>>(rings_[ring]), tangents);
    set_normal(result, tangents, fallback_normal(f));
    return result;
  }

 private:
  std::int32_t edge_point(std::int32_t edge) const {
    return static_cast<std::int32_t>(topology_.vertex_count()) + edge;
  }

  void make_two_rings() {
    ring_of_.assign(topology_.vertex_count(), -1);
    std::vector<Vec3<N>> r, q, p;
    for (std::size_t id = 0; id < topology_.vertex_count(); ++id) {
      const auto v = static_cast<std::int32_t>(id);
      const Sector sector = topology_.sector(v);
      const VertexState state = state_of(mesh_.states, v);
      const int valence = valence_of(valences_, v, sector.faces.size());
      if (valence == 0 || is_regular_vertex(static_cast<std::size_t>(valence), !sector.closed, state))
        continue;
      r.clear(), q.clear(), p.clear();
      for (const std::int32_t edge : sector.edges) r.push_back(points_[edge_point(edge)]);
      for (const std::int32_t neighbour : sector.neighbours) p.push_back(points_[neighbour]);
      for (const std::int32_t f : sector.faces) {
        const Triangle t = triangle_of(topology_, f);
        const int k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
        q.push_back(points_[edge_point(topology_.edge(f, (k + 1) % 3))]);
      }
      ring_of_[id] = static_cast<std::int32_t>(rings_.size());
      const bool closed = sector.closed;
      if (closed && state == VertexState::kOrdinary && valence < kManyFaces) {
        const auto& modes = modes_.try_emplace(valence, valence, weights_).first->second;
        rings_.emplace_back(std::in_place_type<TwoRing<N>>, modes, points_[v], r, q, p);
        continue;
      }
      const std::tuple kind(valence, closed, state);
      const auto& found = stepped_kinds_.try_emplace(kind, valence, closed, state, weights_).first->second;
      rings_.emplace_back(std::in_place_type<SteppedRing<N>>, found, points_[v], r, q, p);
      if (kRounds<N> && valence >= kManyFaces)  // who asks for balls asks for few points
        limit_of_.emplace(v, limit_at(v));
    }
  }

  void make_patches(const std::vector<int>& asked) {
    const Topology finer(points_.size(), refined_triangles(topology_));
    patches_.resize(finer.faces().size());
    for (std::size_t child = 0; child < patches_.size(); ++child) {
      if (!mesh_.is_answered(child / 4, asked)) continue;
      const std::size_t k = child % 4;
      const std::int32_t v = k == 3 ? -1 : topology_.faces()[child / 4][k];
      if (v >= 0 && ring_of_[v] >= 0) continue;
      const auto face = gather_triangle<std::int32_t>(
          finer, child, [](std::int32_t point) { return point; }, mesh_.states);
      patches_[child] = face.patch([&](std::int32_t a, std::int32_t b, std::int32_t c) {
        points_.push_back(ghost_point(points_[a], points_[b], points_[c]));
        return static_cast<std::int32_t>(points_.size() - 1);
      });
    }
  }

  template <class P>
  void evaluate_regular(std::size_t f, const SubFaceLocation<P>& location, Derivatives order,
                        SurfacePoint<N>& result) const {
    Basis<N> basis;
    evaluate_basis(basis, number_from<N>(location.u), number_from<N>(location.v), order);
    std::array<Vec3<N>, 12> points;
    for (std::size_t i = 0; i < 12; ++i) points[i] = points_[patches_[4 * f + location.subface][i]];
    const LocalPoint<N> s = evaluate_patch<N>(points, basis, order);
    result.position = s.position;
    set_derivatives(result, s, location.gradients, N(2), N(4), order);
  }

  SurfacePoint<N> evaluate_corner(std::size_t f, int k, const ParameterGradients& gradients,
                                  Derivatives order) const {
    const std::int32_t v = topology_.faces()[f][k];
    const Sector sector = topology_.sector(v);
    const auto known = limit_of_.find(v);
    return extraordinary_corner<N>(known != limit_of_.end() ? known->second : limit_at(v),
                                   sector.neighbours.size(), !sector.closed, topology_.ring_index(f, k),
                                   gradients, weights_, order, state_of(mesh_.states, v));
  }

  bool is_ordinary_end(std::int32_t v) const {
    return topology_.on_boundary(v) && state_of(mesh_.states, v) == VertexState::kOrdinary;
  }

  VertexLimit<N> limit_at(std::int32_t v) const {
    const Sector sector = topology_.sector(v);
    std::vector<Vec3<N>> ring;
    for (const std::int32_t r : sector.neighbours) ring.push_back(control_[r]);
    return vertex_limit<N>(control_[v], ring, !sector.closed, weights_, state_of(mesh_.states, v));
  }

  /// Near semi-sharp tags: on the piece of the face that has none.
  template <class P>
  SurfacePoint<N> evaluate_after_steps(std::size_t f, const P& l1, const P& l2, Derivatives order) const {
    // Two doubles may be more than 1 by a last bit; from the larger one 1 - l is exact.
    const P largest = P(1) - std::max(l1, l2);
    SubFacePath<P> path(l1 < l2 ? std::min(l1, largest) : l1, l1 < l2 ? l2 : std::min(l2, largest));
    SurfacePoint<N> p;
    if constexpr (std::is_same_v<N, double>) {
      const StamData* level = this;
      for (std::size_t face = f;;) {
        if (level->mesh_.is_settled(face)) {
          if (path.w[1] + path.w[2] > 1) path.w[1] = 1 - path.w[2];  // by rounding
          p = level->evaluate(static_cast<int>(face), path.w[1], path.w[2], order);
          break;
        }
        const bool at_corner = path.at_corner();
        const int k = path.descend();
        level = &level->next_.descend(
            face, k, at_corner, *level->mesh_.tagged,
            [&](const TaggedMesh<N>& mesh) { return refine_once(mesh, weights_); }, weights_);
      }
    } else {  // whoever wants many digits asks for few points
      const StamData piece(settled_around(*mesh_.tagged, f, weights_, path), weights_);
      p = piece.evaluate(0, path.w[1], path.w[2], order);
    }
    SurfacePoint<N> result = p;
    const N first = power(N(2), path.level), second = first * first;
    LocalPoint<N> local{p.position, p.d1, p.d2, p.d11, p.d12, p.d22, p.t1_terms, p.t2_terms};
    set_derivatives(result, local, path.gradients(), first, second, order);
    result.first_exist = p.first_exist;
    result.second_exist = p.second_exist;
    local.a = p.t1, local.b = p.t2;
    SurfacePoint<N> tangents;
    set_derivatives(tangents, local, path.gradients(), first, second, std::min(order, Derivatives::kFirst));
    result.t1 = tangents.d1, result.t2 = tangents.d2;
    return result;
  }

  /// The sub-triangle of outer_patch that holds a point, and the point's parameters there.
  template <class P>
  struct SubTriangle {
    int which = 2;
    P a, b;
    SubTriangle(const SubFaceLocation<P>& location, long steps) {
      const P u = times_power_of_two(location.u, steps + 1),
              v = times_power_of_two(location.v, steps + 1);  // 1 < u + v <= 2
      a = 1 - u, b = 1 - v;
      if (u >= 1)
        which = 0, a = u - 1, b = v;
      else if (v >= 1)
        which = 1, a = u, b = v - 1;
    }
  };

  ///   Ring   TwoRing or SteppedRing
  template <class P, class Ring>
  void evaluate_near_corner(std::size_t f, const SubFaceLocation<P>& location, const Ring& ring,
                            Derivatives order, SurfacePoint<N>& result) const {
    const int face = topology_.ring_index(f, location.subface);
    const long steps = steps_to_corner(P(location.u + location.v));
    const SubTriangle<P> outer(location, steps);
    const RingPoints<N> s = ring.face_points(face, steps);
    Basis<N> basis;
    evaluate_basis(basis, number_from<N>(outer.a), number_from<N>(outer.b), order);
    const LocalPoint<N> local = evaluate_patch<N>(
        outer_patch(ring.faces(), ring.on_boundary(), face, s, outer.which), basis, order, ring.size(steps));

    // Put back growth^J, the scale of the triangle, the linear part and the limit.
    const N growth = ring.growth();
    const ParameterGradients& g = location.gradients;
    const auto [to_first, to_second, first_size, second_size] = ring.linear_part(face);
    result.position = ring.limit() +
                      (to_first * number_from<N>(location.u) + to_second * number_from<N>(location.v)) +
                      (local.position - s.c_to_limit) * power(growth, steps);
    if (order == Derivatives::kPosition) return;
    set_derivatives(result, local, outer.which == 2 ? g.turned() : g, N(4) * power(N(2) * growth, steps),
                    N(16) * power(N(4) * growth, steps), order);
    result.t1 = result.d1 += (to_first * N(g.a1) + to_second * N(g.b1)) * N(2);
    result.t2 = result.d2 += (to_first * N(g.a2) + to_second * N(g.b2)) * N(2);
    result.t1_terms += (first_size * N(std::abs(g.a1)) + second_size * N(std::abs(g.b1))) * N(2);
    result.t2_terms += (first_size * N(std::abs(g.a2)) + second_size * N(std::abs(g.b2))) * N(2);
  }

  /// The control points of one of the three sub-triangles that one more step of face (c, r_i, r_{i+1}) gives
  /// away from c. On the lattice with c = (0, 0), r_i = (1, 0), r_{i+1} = (0, 1) they are
  ///   0  (r_i, p_i, q_i)    1  (r_{i+1}, q_i, p_{i+1})    2  (q_i, r_{i+1}, r_i), the middle one
  static std::array<Vec3<N>, 12> outer_patch(int count, bool on_boundary, int face, const RingPoints<N>& s,
                                             int which) {
    const auto edge = [](const Vec3<N>& a, const Vec3<N>& b, const Vec3<N>& c, const Vec3<N>& d) {
      return interior_edge_point(a, b, c, d);
    };
    const auto vertex = [](const Vec3<N>& centre, const std::array<Vec3<N>, 6>& ring) {
      return interior_vertex_point<N>(centre, ring);
    };
    const auto &c = s.c, &next_c = s.c_after, *r = s.r, *q = s.q, *p = s.p;
    const Vec3<N> r_i = edge(c, r[2], r[1], r[3]), r_next = edge(c, r[3], r[2], r[4]);
    const Vec3<N> q_i = edge(r[2], r[3], c, q[1]);
    const Vec3<N> p_i = vertex(r[2], {c, r[3], q[1], p[0], q[0], r[1]}),
                  p_next = vertex(r[3], {c, r[4], q[2], p[1], q[1], r[2]});
    const Vec3<N> x_i = edge(r[2], q[1], r[3], p[0]), x_next = edge(r[3], q[1], r[2], p[1]);
    const auto before = [&] {  // r_{i-1}
      if (s.first_edge_on_boundary) return ghost_point(next_c, r_i, r_next);
      return face == 1 && on_boundary ? boundary_edge_point(c, r[1]) : edge(c, r[1], r[0], r[2]);
    };
    const auto after = [&] {  // r_{i+2}
      if (s.last_edge_on_boundary) return ghost_point(next_c, r_next, r_i);
      return face + 2 == count && on_boundary ? boundary_edge_point(c, r[4]) : edge(c, r[4], r[3], r[5]);
    };
    const auto q_before = [&] { return edge(r[1], r[2], c, q[0]); };
    const auto q_after = [&] { return edge(r[3], r[4], c, q[2]); };
    if (which == 0)
      return {before(),   next_c,
              q_before(), r_i,
              r_next,     edge(r[2], q[0], p[0], r[1]),
              p_i,        q_i,
              p_next,     edge(r[2], p[0], q[0], q[1]),
              x_i,        x_next};
    if (which == 1)
      return {next_c, after(),   r_i,
              r_next, q_after(), p_i,
              q_i,    p_next,    edge(r[3], q[2], p[1], r[4]),
              x_i,    x_next,    edge(r[3], p[1], q[1], q[2])};
    return {x_next, x_i, p_next, q_i, p_i, q_after(), r_next, r_i, q_before(), after(), next_c, before()};
  }

  /// Replaces one of d1, d2 so that their product keeps its direction and no longer cancels, near a boundary
  /// vertex: (f1 A + r1) x (f2 A + r2) = d1 x (r2 - (f2 / f1) r1).
  template <class P>
  void separate_tangents(std::size_t f, const SubFaceLocation<P>& location, const SteppedRing<N>& ring,
                         Tangents<N>& t) const {
    SurfacePoint<N> rest, factor;
    evaluate_near_corner(f, location, ring.without_dominant(), Derivatives::kFirst, rest);
    evaluate_near_corner(f, location, ring.only_dominant(), Derivatives::kFirst, factor);
    const N f1 = factor.d1.x, f2 = factor.d2.x;
    if (f1 * f1 > f2 * f2) {
      t.second = rest.d2 - rest.d1 * (f2 / f1);
      t.second_terms = rest.t2_terms + rest.t1_terms;  // |f2 / f1| <= 1
    } else if (f2 * f2 > N(0)) {
      t.first = rest.d1 - rest.d2 * (f1 / f2);
      t.first_terms = rest.t1_terms + rest.t2_terms;
    }
  }

  /// Twice the control face's area times its normal: what D12 falls back to inside a face.
  Vec3<N> fallback_normal(std::size_t f) const {
    const auto [a, b, c] = triangle_of(topology_, f);
    return cross(control_[b] - control_[a], control_[c] - control_[a]);
  }

  Weights weights_;
  Valences valences_;
  CutMesh<N> mesh_;
  NextStep<N, StamData> next_;
  const Topology& topology_;
  const std::vector<Vec3<N>>& control_;
  std::vector<Vec3<N>> points_;  ///< after one step: vertices, edge points, then ghosts
  std::vector<std::array<std::int32_t, 12>>
      patches_;                        ///< of the faces of that step; unset at irregular vertices
  std::vector<std::int32_t> ring_of_;  ///< of each vertex, -1 where it is regular
  std::map<int, TwoRingModes<N>> modes_;
  std::map<std::tuple<int, bool, VertexState>, SteppedRingKind<N>> stepped_kinds_;
  std::vector<std::variant<TwoRing<N>, SteppedRing<N>>> rings_;
  std::map<std::int32_t, VertexLimit<N>> limit_of_;  ///< of vertices of many faces
};

}  // namespace detail

template <class N>
StamEvaluator<N>::StamEvaluator(const data::ControlMesh& mesh, Weights weights)
    : StamEvaluator(positions_of<N>(mesh), triangles_of(mesh).to_vector(), weights, mesh.sharpness) {}
template <class N>
StamEvaluator<N>::StamEvaluator(std::vector<Vec3<N>> positions, const std::vector<Triangle>& triangles,
                                Weights weights, const SharpTags& tags, Valences valences)
    : data_(std::make_shared<const detail::StamData<N>>(
          CutMesh<N>(std::move(positions), data::Faces(triangles), tags), weights, std::vector<int>{},
          std::move(valences))) {}

template <class N>
int StamEvaluator<N>::face_count() const {
  return data_->face_count();
}

template <class N>
SurfacePoint<N> StamEvaluator<N>::evaluate(int face, double l1, double l2, Derivatives order) const {
  if constexpr (std::is_same_v<N, double>) {
    return data_->evaluate(face, l1, l2, order);
  } else {
    return evaluate(face, Parameter(l1), Parameter(l2), order);
  }
}

template <class N>
SurfacePoint<N> StamEvaluator<N>::evaluate(int face, const Parameter& l1, const Parameter& l2,
                                           Derivatives order) const {
  if constexpr (std::is_same_v<N, double>)
    if (l1.is_double() && l2.is_double()) return data_->evaluate(face, l1.as_double(), l2.as_double(), order);
  const auto [first, second] = exact_parameters(l1, l2);
  return data_->evaluate(face, first, second, order);
}

}  // namespace limitcheck::reference
