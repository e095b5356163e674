// SPDX-License-Identifier: MIT
// A finding as files that anyone can pick up: the control mesh, and what to see on it.
#pragma once

#include <filesystem>
#include <string>

#include "verify/evidence/audit_case.h"
#include "verify/row/result.h"

namespace limitcheck::verify {

/// Makes the folder `folder`/SUBJECT-CHECK-MESH with
///   control.obj    the control mesh, bit for bit as the audit had it
///   depths.txt     the depth of each face, if they had depths of their own
///   witness.json   subject, check, face and parameter; expected and got as in the report;
///                  `limit_position` and `limit_normal` there to 40 digits, for the mesh rounded to the
///                  subject's precision; and two commands that repeat the expected value and the finding
/// The commands name control.obj as `folder` does, so they run where the audit ran. Each file appears whole
/// or not at all. `report` is the one the result is of, `level` how much was looked at. Returns the folder
/// made. Throws std::runtime_error, data::InputError: a file cannot be written.
std::filesystem::path write_witness(const std::filesystem::path& folder, const Report& report,
                                    const Result& result, const AuditMesh& mesh, const std::string& level);

}  // namespace limitcheck::verify
