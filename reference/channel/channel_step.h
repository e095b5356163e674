// SPDX-License-Identifier: MIT
// One step of a channel by its rules, on the mesh that is not cut. Heavy: include from .cpp files.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "data/scheme.h"
#include "reference/catmull_clark/masks.h"
#include "reference/catmull_clark/refine.h"
#include "reference/channel/channel_mesh.h"
#include "reference/loop/masks.h"
#include "reference/loop/sub_faces.h"

namespace limitcheck::reference {

/// The values after a step, and the faces that they are at.
template <class N>
class ChannelStep {
 public:
  ChannelStep(const ChannelMesh<N>& mesh, data::Scheme scheme, data::TriangleRule triangles)
      : mesh_(mesh), loop_(scheme == data::Scheme::kLoop), triangles_(triangles) {}

  ChannelMesh<N> result() {
    for (std::size_t f = 0; f < topology().faces().size(); ++f) face_points_.push_back(mean(f));
    for (std::size_t e = 0; e < topology().edges().size(); ++e) {
      const Edge& edge = topology().edges()[e];
      edge_points_.push_back(
          {edge_point(e, edge.left_face), edge.on_boundary() ? Vec3<N>{} : edge_point(e, edge.right_face)});
    }
    vertex_points_.resize(mesh_.values.size());
    for (std::size_t v = 0; v < topology().vertex_count(); ++v) put_vertex(static_cast<std::int32_t>(v));

    const std::size_t vertices = topology().vertex_count(), edges = topology().edges().size();
    Topology finer(vertices + edges + (loop_ ? 0 : face_points_.size()),
                   loop_ ? refined_triangles(topology()) : catmull_clark::refined_faces(topology()));
    Sharpness sharpness = mesh_.sharpness.refined(topology(), finer);
    ChannelMesh<N> refined(ChannelTopology(std::move(finer), std::move(sharpness)), {});
    std::size_t child = 0;
    for (std::size_t f = 0; f < topology().faces().size(); ++f) {
      const std::size_t children = loop_ ? 4 : topology().faces()[f].size();
      for (std::size_t k = 0; k < children; ++k, ++child)
        for (const std::int32_t point : refined.topology.faces()[child]) put_corner(f, point, refined);
    }
    for (const Edge& edge : refined.topology.edges()) {
      const auto [v, point] = std::minmax(edge.a, edge.b);
      const auto parent = static_cast<std::size_t>(point) - vertices;
      refined.seams.push_back(static_cast<std::size_t>(v) < vertices && parent < edges &&
                              mesh_.seams[parent]);
    }
    return refined;
  }

 private:
  const Topology& topology() const { return mesh_.topology; }
  /// The value that a face names at a vertex.
  const Vec3<N>& at(std::int32_t face, std::int32_t v) const { return mesh_.values[mesh_.corner(face, v)]; }

  Vec3<N> mean(std::size_t f) const {
    const std::size_t first = topology().faces().first_corner(f);
    return catmull_clark::face_point<N>(std::span(mesh_.values).subspan(first, topology().faces()[f].size()));
  }

  /// Of an edge as a face beside it has it.
  Vec3<N> edge_point(std::size_t e, std::int32_t face) const {
    const Edge& edge = topology().edges()[e];
    const Vec3<N>&a = at(face, edge.a), &b = at(face, edge.b);
    const Vec3<N> middle = boundary_edge_point(a, b);
    if (edge.on_boundary() || mesh_.seams[e]) return middle;
    const Rational share = mesh_.sharpness.edge_share(topology(), static_cast<std::int32_t>(e));
    if (share == 1) return middle;
    const Vec3<N> smooth =
        loop_ ? interior_edge_point(a, b, beyond(edge, edge.left_face), beyond(edge, edge.right_face))
              : middle + (across(edge.left_face, middle) + across(edge.right_face, middle)) *
                             (weight(edge.left_face) + weight(edge.right_face));
    return smooth + (middle - smooth) * number_from<N>(share);
  }
  const Vec3<N>& beyond(const Edge& edge, std::int32_t face) const {
    return at(face, opposite(topology(), edge, face));
  }
  Vec3<N> across(std::int32_t face, const Vec3<N>& middle) const {
    return face_points_[static_cast<std::size_t>(face)] - middle;
  }
  /// What a face beside an edge adds to the weight that both face points have in its point, Catmull-Clark's.
  N weight(std::int32_t face) const {
    const bool triangle = topology().faces()[static_cast<std::size_t>(face)].size() == 3;
    return triangle && triangles_ == data::TriangleRule::kSmooth ? N(47) / N(200) : N(1) / N(8);
  }

  void put_vertex(std::int32_t v) {
    const Sector sector = topology().sector(v);
    if (sector.faces.empty()) return;
    for (const Run& run : mesh_.runs(v)) {
      const Vec3<N> value = vertex_point(v, sector, run);
      for (std::size_t i = 0; i < run.count; ++i)
        vertex_points_[mesh_.corner(mesh_.face(sector, run, i), v)] = value;
    }
  }

  Vec3<N> vertex_point(std::int32_t v, const Sector& sector, const Run& run) const {
    const std::size_t corner = mesh_.corner(mesh_.face(sector, run, 0), v);
    const Vec3<N>& c = mesh_.values[corner];
    const auto crease = [&] {
      return boundary_vertex_point(
          c, at(mesh_.face(sector, run, 0), sector.neighbours[mesh_.edge(sector, run, 0)]),
          at(mesh_.face(sector, run, run.count - 1), sector.neighbours[mesh_.edge(sector, run, run.count)]));
    };
    switch (mesh_.states[corner]) {
      case ValueState::kMatches:
        return matching_point(v, sector, c);
      case ValueState::kHeld:
        return c;
      case ValueState::kCrease:
        return crease();
      case ValueState::kSemiSharp:
      case ValueState::kDependent:
        break;
    }
    // Held as the parent, a crease as the child: those that vanish count with their mean.
    bool held = false, stays_held = false;
    Rational sum;
    int vanishing = 0;
    for (const auto& [now, after] : mesh_.holding(v, run)) {
      held = held || now > 0;
      stays_held = stays_held || after > 0;
      if (now > 0 && after == 0) sum += now, ++vanishing;
    }
    if (stays_held) return c;
    if (!held) return crease();
    const Rational share = std::min(Rational(1), Rational(sum / vanishing));
    const Vec3<N> child = crease();
    return child + (c - child) * number_from<N>(share);
  }

  /// By the surface's own rule, on the values that the faces round the vertex name.
  Vec3<N> matching_point(std::int32_t v, const Sector& sector, const Vec3<N>& c) const {
    std::vector<Vec3<N>> around, faces;
    for (std::size_t i = 0; i < sector.neighbours.size(); ++i)
      around.push_back(at(sector.faces[std::min(i, sector.faces.size() - 1)], sector.neighbours[i]));
    for (const std::int32_t f : sector.faces) faces.push_back(face_points_[static_cast<std::size_t>(f)]);
    const Vec3<N> smooth = !sector.closed ? boundary_vertex_point(c, around.front(), around.back())
                           : loop_        ? interior_vertex_point<N>(c, around)
                                          : catmull_clark::interior_vertex_point<N>(c, around, faces);
    const VertexRules rules = mesh_.sharpness.rules(topology(), v);
    const auto neighbour = [&](std::int32_t end) -> const Vec3<N>& {
      return around[static_cast<std::size_t>(
          std::find(sector.neighbours.begin(), sector.neighbours.end(), end) - sector.neighbours.begin())];
    };
    const auto point = [&](const VertexRules::One& one) {
      return one.rule == VertexRule::kCorner ? c
             : one.rule != VertexRule::kCrease
                 ? smooth
                 : boundary_vertex_point(c, neighbour(one.ends[0]), neighbour(one.ends[1]));
    };
    const Vec3<N> child = point(rules.child);
    return child + (point(rules.parent) - child) * number_from<N>(rules.parent_share);
  }

  /// A corner of the finer mesh, which lies in face f.
  void put_corner(std::size_t f, std::int32_t point, ChannelMesh<N>& refined) const {
    const auto vertices = static_cast<std::int32_t>(topology().vertex_count());
    const auto edges = static_cast<std::int32_t>(topology().edges().size());
    if (point < vertices) {
      const std::size_t corner = mesh_.corner(static_cast<std::int32_t>(f), point);
      refined.values.push_back(vertex_points_[corner]);
      refined.states.push_back(mesh_.states[corner]);
    } else if (point < vertices + edges) {
      const auto e = static_cast<std::size_t>(point - vertices);
      const bool is_left = topology().edges()[e].left_face == static_cast<std::int32_t>(f);
      refined.values.push_back(edge_points_[e][is_left ? 0 : 1]);
      refined.states.push_back(mesh_.seams[e] ? ValueState::kCrease : ValueState::kMatches);
    } else {
      refined.values.push_back(face_points_[static_cast<std::size_t>(point - vertices - edges)]);
      refined.states.push_back(ValueState::kMatches);
    }
  }

  const ChannelMesh<N>& mesh_;
  const bool loop_;
  const data::TriangleRule triangles_;
  std::vector<Vec3<N>> face_points_, vertex_points_;  // of each face, of each corner
  std::vector<std::array<Vec3<N>, 2>> edge_points_;   // of each edge, as its left and its right face have it
};

/// One step. The faces are those of the scheme's own step.
template <class N>
ChannelMesh<N> refine_once(const ChannelMesh<N>& mesh, data::Scheme scheme, data::TriangleRule triangles) {
  return ChannelStep<N>(mesh, scheme, triangles).result();
}

}  // namespace limitcheck::reference
