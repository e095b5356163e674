// SPDX-License-Identifier: MIT
// The tags of a known answer.
#pragma once

#include "data/test_support/known_answers.h"
#include "reference/mesh/sharp_tags.h"

namespace limitcheck::reference {

inline SharpTags tags_of(const data::QuadAnswer& answer) {
  SharpTags tags;
  for (const auto& e : answer.sharp_edges) tags.edges.push_back({e.a, e.b, Parameter::parse(e.sharpness)});
  for (const auto& v : answer.sharp_vertices) tags.vertices.push_back({v.a, Parameter::parse(v.sharpness)});
  if (answer.boundary == "edge+corner") tags.boundary = data::Boundary::kEdgeAndCorner;
  if (answer.creasing == "chaikin") tags.creasing = data::Creasing::kChaikin;
  if (answer.triangles == "smooth") tags.triangles = data::TriangleRule::kSmooth;
  return tags;
}

}  // namespace limitcheck::reference
