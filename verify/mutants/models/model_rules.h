// SPDX-License-Identifier: MIT
// Loop's rules with one of them changed: what the subject `model` computes with.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "reference/loop/masks.h"
#include "reference/mesh/topology.h"
#include "reference/number/vec3.h"

namespace limitcheck::verify {

struct Mutation {
  std::string_view name, description;
  std::string_view check;       // the row of the audit meant for it
  std::string_view claim = {};  // of the paper, where this is the paper taken literally
  bool in_float = false;        // delivered in float: small faults hide in wider bounds
  bool sharp = false;           // only sharp edges and vertices bring it out
};

/// All mutations of the model; the first is "none".
std::span<const Mutation> mutations();

/// The rules under one mutation, in double. Points are those of a mesh at some level.
///   weights   the family that the subject declares
///   refined   limit() leaves points as they are
class ModelRules {
 public:
  using V = reference::Vec3<double>;
  ModelRules(std::string_view mutation, reference::Weights weights, bool refined)
      : mutation_(mutation), weights_(weights), refined_(refined) {}

  bool is(std::string_view name) const { return mutation_ == name; }
  std::string_view mutation() const { return mutation_; }
  reference::Weights weights() const { return weights_; }

  /// One step of `depth`: vertex points in the order of the vertices, then edge points in the order of the
  /// edges.
  std::vector<V> refine(const reference::Topology& topology, const std::vector<V>& points, int depth) const;
  /// At level `depth`, sums over the ring of an interior vertex begun at its neighbour `first`.
  V limit(const reference::Topology& topology, const std::vector<V>& points, std::int32_t v, int depth,
          std::size_t first = 0) const;
  V normal(const reference::Topology& topology, const std::vector<V>& points, std::int32_t v,
           std::size_t first = 0) const;
  /// Of a vertex amid its ring, or with the neighbours of one side of a crease.
  V normal(const V& p, const std::vector<V>& ring, bool open) const;

 private:
  double alpha(int n) const;
  bool taken_as_vanishing(const reference::Tangents<double>& t, const V& p) const;
  V vertex_point(const reference::Topology& topology, const std::vector<V>& points, std::int32_t v) const;
  V edge_point(const reference::Topology& topology, const std::vector<V>& points,
               const reference::Edge& edge) const;

  std::string_view mutation_;
  reference::Weights weights_;
  bool refined_;
};

}  // namespace limitcheck::verify
