// SPDX-License-Identifier: MIT
// The surface of a mesh with sharp edges, asked for in other ways.
#pragma once

#include <optional>

#include "verify/relations/relation_variants.h"

namespace limitcheck::verify {

/// In the order of the table (relations.h says what each is). All need sharp edges or vertices.
const std::vector<Relation>& sharp_relations();

/// The two surfaces between which that of a mesh lies whose only crease has one sharpness that is no whole
/// number: S(2.3) = 0.7 S(2) + 0.3 S(3), the limit points and the refined ones.
struct Blend {
  float lower;   // 2
  double share;  // 0.3, of the next
};
/// Nothing if the mesh is another one: with another sharpness, sharp vertices, a vertex of three sharp edges,
/// a crease that meets the boundary.
std::optional<Blend> blend_of(const data::ControlMesh& mesh, const Lattice& lattice);
/// The mesh with another sharpness of its crease.
data::ControlMesh with_sharpness(data::ControlMesh mesh, float sharpness);

}  // namespace limitcheck::verify
