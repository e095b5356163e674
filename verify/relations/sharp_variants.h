// SPDX-License-Identifier: MIT
// The surface of a mesh with sharp edges, asked for in other ways.
#pragma once

#include <optional>

#include "verify/relations/relation_variants.h"

namespace limitcheck::verify {

/// In the order of the table (relations.h says what each is). All need sharp edges or vertices.
const std::vector<Relation>& sharp_relations();

/// Whether an edge or a vertex has a sharpness that ends.
bool has_semi_sharp(const data::ControlMesh& mesh);
/// The sharpness of all that do, if it is the same and there are some.
std::optional<float> common_sharpness(const data::ControlMesh& mesh);
/// The mesh with another one for all of them; 0 is none.
data::ControlMesh with_sharpness(data::ControlMesh mesh, float sharpness);

}  // namespace limitcheck::verify
