// SPDX-License-Identifier: MIT
// How sharp the edges and vertices of a mesh are at one level, for the model: what DeRose, Kass and Truong
// 1998 say of a step, as OpenSubdiv has it, with Chaikin's way of falling. The same in both schemes.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "data/sharpness.h"
#include "reference/mesh/topology.h"
#include "reference/number/vec3.h"

namespace limitcheck::verify {

class MutantTags {
 public:
  using V = reference::Vec3<double>;
  static constexpr double kForEver = std::numeric_limits<double>::infinity();
  enum class Rule : std::uint8_t { kSmooth, kDart, kCrease, kCorner };

  /// None. Nothing may be asked of it but that.
  MutantTags() = default;
  /// Tags of edges that do not exist are left out.
  MutantTags(const data::Sharpness& sharpness, const reference::Topology& topology,
             std::string_view mutation);

  bool is(std::string_view name) const { return mutation_ == name; }
  bool none() const { return vertex_.empty(); }
  bool smooth_triangles() const { return smooth_triangles_; }

  /// 0 and more; kForEver on the boundary.
  double edge(const reference::Topology& topology, std::int32_t e) const;
  double vertex(std::int32_t v) const { return vertex_[v]; }
  bool lasts(const reference::Topology& topology, std::int32_t e) const {
    return edge(topology, e) == kForEver;
  }

  /// Whether a vertex and the edges at it are untouched by tags: its rule is that of a mesh without.
  bool plain(const reference::Topology& topology, std::int32_t v) const;
  /// Whether the rule of a vertex is for ever the one that it has.
  bool settled(const reference::Topology& topology, std::int32_t v) const;

  /// Turns the points of a step by the rules of smooth meshes (vertices, edge points, ..) into those of a
  /// step with tags.
  void sharpen(const reference::Topology& topology, const std::vector<V>& points,
               std::vector<V>& refined) const;
  /// After that step.
  MutantTags refined(const reference::Topology& topology, const reference::Topology& finer) const;
  MutantTags of_part(const reference::Topology& topology, const reference::Topology& part,
                     const std::vector<std::int32_t>& vertices) const;

 private:
  // The rule of a vertex in a step and, of a crease, the two neighbours along it.
  struct Step {
    Rule rule;
    std::int32_t ends[2];
  };
  Step step(const reference::Topology& topology, std::int32_t v, bool next) const;
  V point(const Step& step, const std::vector<V>& points, std::int32_t v, const V& smooth) const;
  // What is left after a step of an edge at its end v, and of a vertex.
  double fallen(const reference::Topology& topology, std::int32_t e, std::int32_t v) const;
  double fallen(double sharpness) const;
  double edge_share(const reference::Topology& topology, std::int32_t e) const;
  double old_share(const reference::Topology& topology, std::int32_t v) const;

  std::vector<double> edge_, vertex_;
  bool chaikin_ = false, smooth_triangles_ = false;
  bool control_ = true;  // of the control mesh
  std::string_view mutation_ = "none";
};

}  // namespace limitcheck::verify
