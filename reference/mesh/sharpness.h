// SPDX-License-Identifier: MIT
// How sharp the edges and vertices of a mesh are, what that makes of their rules in a step, and the cut along
// edges that stay sharp. The same in both schemes. Heavy: include from .cpp files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "data/faces.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/mesh/topology.h"
#include "reference/number/number_exact.h"

namespace limitcheck::reference {

/// A list of exact numbers of which nearly all are 0: these take four bytes and no memory of their own.
class SparseRationals {
 public:
  explicit SparseRationals(std::size_t count = 0) : place_(count) {}

  std::size_t size() const { return place_.size(); }
  bool is_zero(std::size_t i) const { return place_[i] == 0; }
  const Rational& operator[](std::size_t i) const { return values_[static_cast<std::size_t>(place_[i])]; }
  void set(std::size_t i, const Rational& value) {
    place_[i] = 0;
    if (value == 0) return;
    place_[i] = static_cast<std::int32_t>(values_.size());
    values_.push_back(value);
  }

 private:
  std::vector<std::int32_t> place_;  // in values_
  std::vector<Rational> values_{Rational(0)};
};

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
  const Rational& vertex(std::int32_t v) const { return vertex_[static_cast<std::size_t>(v)]; }
  data::Creasing creasing() const { return chaikin_ ? data::Creasing::kChaikin : data::Creasing::kUniform; }
  /// Whether an edge is smooth, and a vertex with all its edges.
  bool is_smooth(std::int32_t e) const { return edge_.is_zero(static_cast<std::size_t>(e)); }
  bool is_smooth_around(const Topology& topology, std::int32_t v) const;
  static bool is_infinite(const Rational& s) { return s >= 10; }
  static bool is_semi_sharp(const Rational& s) { return s > 0 && s < 10; }
  /// After a step: of a vertex, and of the half of an edge at its end v.
  static Rational one_less(const Rational& s) {
    return is_infinite(s) ? s : s > 1 ? Rational(s - 1) : Rational(0);
  }
  Rational half_after_step(const Topology& topology, std::int32_t e, std::int32_t v) const;

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
  /// Of an inner edge at a vertex, or of one beyond a seam.
  Rational half_after_step(const Topology& topology, const Rational& s, std::int32_t v) const;

  /// See SharpTags::Beyond.
  struct Beyond {
    Rational sharpness;
    bool holds;
  };
  SparseRationals edge_, vertex_;
  std::map<std::int32_t, std::vector<Beyond>> beyond_;  // by vertex
  bool chaikin_ = false;
};

}  // namespace limitcheck::reference
