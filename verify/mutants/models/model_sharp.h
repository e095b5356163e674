// SPDX-License-Identifier: MIT
// What the model does where edges and vertices are sharp: Loop's scheme.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/mesh/topology.h"
#include "verify/mutants/models/model_rules.h"
#include "verify/mutants/models/model_sides.h"
#include "verify/mutants/models/model_tags.h"

namespace limitcheck::verify {

/// One step of `depth`, as ModelRules::refine gives it, with tags.
std::vector<ModelRules::V> sharp_refine(const ModelRules& rules, const reference::Topology& topology,
                                        const std::vector<ModelRules::V>& points, const ModelTags& tags,
                                        int depth);

/// Of a vertex that has tags; the normals are in the order of its sector.
ModelLimit sharp_limit(const ModelRules& rules, const reference::Topology& topology,
                       const std::vector<ModelRules::V>& points, const ModelTags& tags, std::int32_t v,
                       int depth);

}  // namespace limitcheck::verify
