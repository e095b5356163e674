// SPDX-License-Identifier: MIT
// Catmull and Clark's rules with one of them changed: what the subject `quad-model` computes with.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "reference/mesh/topology.h"
#include "reference/number/vec3.h"
#include "verify/mutants/models/model_rules.h"
#include "verify/mutants/models/model_sides.h"
#include "verify/mutants/models/model_tags.h"
#include "verify/mutants/quad_models/quad_model_ring.h"

namespace limitcheck::verify {

/// All mutations of the quad model; the first is "none".
std::span<const Mutation> quad_mutations();

/// The rules under one mutation, in double. Points are those of a mesh at some level.
class QuadModelRules {
 public:
  using V = reference::Vec3<double>;
  explicit QuadModelRules(std::string_view mutation) : mutation_(mutation) {}

  bool is(std::string_view name) const { return mutation_ == name; }

  /// None if the mesh has no sharp edges.
  ModelTags tags(const data::Sharpness& sharpness, const reference::Topology& topology) const;

  /// The step from `level` to the next: vertex points, then edge points, then face points.
  std::vector<V> refine(const reference::Topology& topology, const std::vector<V>& points,
                        const ModelTags& tags, int level) const;

  /// Of a mesh of quads.
  static QuadRing ring(const reference::Topology& topology, const std::vector<V>& points, std::int32_t v);
  /// Of a vertex without tags, or of what lies to one side of sharp edges.
  V limit(const QuadRing& ring) const;
  V normal(const QuadRing& ring) const;

  /// Of any vertex of a mesh of quads; the normals are in the order of its sector.
  ModelLimit limit(const reference::Topology& topology, const std::vector<V>& points, const ModelTags& tags,
                   std::int32_t v) const;

 private:
  V face_point(std::span<const std::int32_t> corners, const std::vector<V>& points, int level) const;
  V vertex_point(const reference::Topology& topology, const std::vector<V>& points,
                 const std::vector<V>& refined, std::int32_t v) const;
  ModelLimit sharp_limit(const reference::Topology& topology, const std::vector<V>& points,
                         const ModelTags& tags, std::int32_t v, std::span<const std::int32_t> faces) const;

  std::string_view mutation_;
};

/// Of the triangles between a vertex and its neighbours.
QuadModelRules::V mean_of_facets(const QuadRing& ring);

}  // namespace limitcheck::verify
