// SPDX-License-Identifier: MIT
// Catmull and Clark's rules with one of them changed: what the subject `quad-model` computes with.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "reference/mesh/topology.h"
#include "reference/number/vec3.h"
#include "verify/subject/model_rules.h"

namespace limitcheck::verify {

/// All mutations of the quad model; the first is "none".
std::span<const Mutation> quad_mutations();

/// The rules under one mutation, in double. Points are those of a mesh at some level.
class QuadModelRules {
 public:
  using V = reference::Vec3<double>;
  explicit QuadModelRules(std::string_view mutation) : mutation_(mutation) {}

  bool is(std::string_view name) const { return mutation_ == name; }

  /// The step from `level` to the next: vertex points, then edge points, then face points.
  std::vector<V> refine(const reference::Topology& topology, const std::vector<V>& points, int level) const;
  /// Of a mesh of quads.
  V limit(const reference::Topology& topology, const std::vector<V>& points, std::int32_t v) const;
  V normal(const reference::Topology& topology, const std::vector<V>& points, std::int32_t v) const;

 private:
  V face_point(std::span<const std::int32_t> corners, const std::vector<V>& points, int level) const;
  V vertex_point(const reference::Topology& topology, const std::vector<V>& points,
                 const std::vector<V>& refined, std::int32_t v) const;

  std::string_view mutation_;
};

}  // namespace limitcheck::verify
