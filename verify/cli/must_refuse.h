// SPDX-License-Identifier: MIT
// `limitcheck audit SUBJECT BROKEN.obj --must-refuse`: what a subject makes of meshes that are none.
#pragma once

#include <string>
#include <vector>

#include "verify/audit/audit.h"

namespace limitcheck::cli {

/// A file as it is, polygons cut as fans. Throws InputError: it cannot be read, or an index has more than 32
/// bits; std::invalid_argument: nothing is wrong with the mesh.
data::ControlMesh open_broken_mesh(const std::string& file);

/// One row `rejected-inputs` for each subject and mesh.
std::vector<verify::Result> must_refuse(const std::vector<verify::AuditSubject>& subjects,
                                        const std::vector<verify::AuditMesh>& meshes, int threads);

}  // namespace limitcheck::cli
