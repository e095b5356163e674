// SPDX-License-Identifier: MIT
// How sharp the edges and vertices of a mesh are, what that makes of their rules in a step, and the cut along
// edges that stay sharp. The same in both schemes. Heavy: include from .cpp files.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "data/cut_out.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/mesh/support.h"
#include "reference/mesh/topology.h"
#include "reference/number/number_exact.h"
#include "reference/number/sparse_rationals.h"
#include "reference/number/vec3.h"

namespace limitcheck::reference {

/// The rule of a vertex, by its sharp edges: none, one, two, more, or held by a sharpness of its own.
enum class VertexRule : std::uint8_t { kSmooth, kDart, kCrease, kCorner };

/// Of a vertex in one step: the rule that it has, the one that it will have, and how much of the former
/// counts.
struct VertexRules {
  struct One {
    VertexRule rule;
    std::array<std::int32_t, 2> ends;  ///< kCrease: the neighbours along it
  };
  One parent, child;
  Rational parent_share;  ///< 1 where there is nothing to blend
};

/// Sharpness by edge and vertex of a topology, boundary edges aside, which are always sharp. 10 and more is
/// infinite.
class Sharpness {
 public:
  /// Throws data::ArgumentError: no such edge or vertex, a negative sharpness, or an edge tagged twice
  /// differently.
  Sharpness(const Topology& topology, const SharpTags& tags);

  const Rational& edge(std::int32_t e) const { return edge_[static_cast<std::size_t>(e)]; }
  data::Creasing creasing() const { return chaikin_ ? data::Creasing::kChaikin : data::Creasing::kUniform; }
  /// Whether an edge is smooth, and a vertex with all its edges.
  bool is_smooth(std::int32_t e) const { return edge_.is_zero(static_cast<std::size_t>(e)); }
  bool is_smooth_around(const Topology& topology, std::int32_t v) const;
  static bool is_infinite(const Rational& s) { return s >= 10; }
  static bool is_semi_sharp(const Rational& s) { return s > 0 && s < 10; }

  /// How much the midpoint counts in the point of an edge: the rest is the smooth rule's.
  Rational edge_share(const Topology& topology, std::int32_t e) const;
  VertexRules rules(const Topology& topology, std::int32_t v) const;

  /// After one step. The vertices of the finer mesh are the vertices, then the edge points, in their order.
  Sharpness refined(const Topology& topology, const Topology& finer) const;
  /// Of a part of the mesh.
  ///   faces   those of the mesh that became the part's faces, corner by corner
  Sharpness of_part(const Topology& topology, const Topology& part, const std::vector<std::int32_t>& faces,
                    const std::vector<std::int32_t>& vertices) const;

  /// The same as tags.
  SharpTags tags(const Topology& topology) const;

  /// Of each face: whether a corner has a semi-sharp tag, on itself or on an edge of it, or an edge that
  /// stays sharp and cannot be cut, since no other sharp edge meets either of its ends. Such faces need a
  /// step.
  std::vector<bool> needs_a_step(const Topology& topology) const;

  /// The mesh with a copy of the points of each edge that stays sharp for either of its sides.
  struct Cut {
    data::Faces faces;
    std::vector<std::int32_t> origin;  ///< of each vertex, what it is a copy of; the old ones come first
    std::vector<VertexState> states;   ///< of each vertex
  };
  Cut cut(const Topology& topology) const;

 private:
  Sharpness() = default;
  bool is_sharp(const Topology& topology, std::int32_t e) const {
    return topology.edges()[static_cast<std::size_t>(e)].on_boundary() || !is_smooth(e);
  }
  bool stays_sharp(const Topology& topology, std::int32_t e) const {
    return topology.edges()[static_cast<std::size_t>(e)].on_boundary() ||
           (!is_smooth(e) && is_infinite(edge(e)));
  }
  int lasting_edges(const Topology& topology, std::int32_t v) const;
  /// Of the half of an edge at its end v, after a step.
  Rational child_at(const Topology& topology, std::int32_t e, std::int32_t v) const;

  SparseRationals edge_, vertex_;
  bool chaikin_ = false;
};

template <class N>
N number_from_rational(const Rational& a) {
  if constexpr (std::is_same_v<N, Rational>)
    return a;
  else if constexpr (std::is_same_v<N, double>)
    return a.convert_to<double>();
  else
    return NumberTraits<N>::from_rational(a);
}

/// Turns the points of a step by the smooth rules (vertices, edge points, ..) into those of a step with sharp
/// edges and vertices.
template <class N>
void sharpen(const Topology& topology, const Sharpness& sharpness, const std::vector<Vec3<N>>& positions,
             std::vector<Vec3<N>>& refined) {
  const auto at = [&](std::int32_t v) -> const Vec3<N>& { return positions[static_cast<std::size_t>(v)]; };
  const N half = N(1) / N(2), eighth = N(1) / N(8);
  for (std::size_t e = 0; e < topology.edges().size(); ++e) {
    const Edge& edge = topology.edges()[e];
    if (sharpness.is_smooth(static_cast<std::int32_t>(e))) continue;
    const Rational share = sharpness.edge_share(topology, static_cast<std::int32_t>(e));
    if (edge.on_boundary() || share == 0) continue;
    Vec3<N>& point = refined[positions.size() + e];
    const Vec3<N> middle = (at(edge.a) + at(edge.b)) * half;
    point = share == 1 ? middle : point + (middle - point) * number_from_rational<N>(share);
  }
  for (std::size_t id = 0; id < positions.size(); ++id) {
    const auto v = static_cast<std::int32_t>(id);
    if (topology.sector(v).faces.empty() || sharpness.is_smooth_around(topology, v)) continue;
    const VertexRules rules = sharpness.rules(topology, v);
    const Vec3<N> smooth = refined[id], &c = positions[id];
    const auto point = [&](const VertexRules::One& one) -> Vec3<N> {
      if (one.rule == VertexRule::kCorner) return c;
      if (one.rule != VertexRule::kCrease) return smooth;
      return c + ((at(one.ends[0]) - c) + (at(one.ends[1]) - c)) * eighth;
    };
    refined[id] = point(rules.parent);
    if (rules.parent_share != 1) {
      const Vec3<N> child = point(rules.child);
      refined[id] = child + (refined[id] - child) * number_from_rational<N>(rules.parent_share);
    }
  }
}

/// A mesh with its tags.
template <class N>
struct TaggedMesh {
  Topology topology;
  std::vector<Vec3<N>> positions;
  Sharpness sharpness;

  /// Some faces, which come first, and all that their surface depends on.
  TaggedMesh around(std::vector<std::int32_t> faces) const {
    faces = support_of(std::move(faces), topology, sharpness.creasing());
    const data::CutOut part = data::cut_out(topology.faces(), faces);
    Topology local(part.vertices.size(), part.faces);
    Sharpness sharp = sharpness.of_part(topology, local, faces, part.vertices);
    return {std::move(local), part.of(positions), std::move(sharp)};
  }
  TaggedMesh around(std::size_t face) const {
    return around(std::vector<std::int32_t>{static_cast<std::int32_t>(face)});
  }
};

}  // namespace limitcheck::reference
