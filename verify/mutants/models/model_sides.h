// SPDX-License-Identifier: MIT
// The sides of a vertex of the models: the stretches of its ring between edges that stay sharp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "reference/mesh/topology.h"
#include "verify/mutants/models/model_tags.h"

namespace limitcheck::verify {

/// Of unit length; (0, 0, 1) for the zero vector.
ModelTags::V unit_or_up(const ModelTags::V& n);

/// A limit position, and the normals in the faces around, in the order asked for; one if all are the same.
struct ModelLimit {
  ModelTags::V position;
  std::vector<ModelTags::V> normals;

  /// In the face around vertex v of which a and b are corners.
  const ModelTags::V& normal(const reference::Topology& topology, std::int32_t v, std::int32_t a,
                             std::int32_t b) const;
};

/// Of a vertex whose rule stays.
class ModelSides {
 public:
  using V = ModelTags::V;
  ModelSides(const reference::Topology& topology, const ModelTags& tags, std::int32_t v);

  ModelTags::Rule rule() const { return rule_; }
  /// Which neighbours lie across edges that stay sharp.
  const std::vector<std::size_t>& sharp() const { return sharp_; }
  /// Members of a ring from number `first` on, so many of them.
  static std::vector<V> turned(const std::vector<V>& ring, std::size_t first, std::size_t count);

  /// A crease is (2/3, 1/6, 1/6) in either scheme, a corner stays.
  ///   normal   of the `count` faces from face `first` of the ring on
  ///   faces    around the vertex, in the order of the normals asked for
  ModelLimit limit(const std::vector<V>& points, std::span<const std::int32_t> faces,
                   const std::function<V(std::size_t first, std::size_t count)>& normal) const;

 private:
  const ModelTags& tags_;
  reference::Sector sector_;
  std::int32_t vertex_;
  ModelTags::Rule rule_;
  std::vector<std::size_t> sharp_;
};

}  // namespace limitcheck::verify
