// SPDX-License-Identifier: MIT
// Meshes on which the scheme is not defined: a subject must refuse them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/io/polygon_soup.h"
#include "verify/evidence/audit_case.h"
#include "verify/row/result.h"

namespace limitcheck::verify {

struct BrokenMesh {
  const char* what;  // "an edge with three faces"
  data::ControlMesh mesh;
  std::int32_t sharp = 0;  // of tags: which kinds have to be declared for it to be asked, LC_SHARP_...
};

/// One mesh for each way in which faces fail to form an oriented manifold, one without faces, one without
/// vertices, one with an index out of range and one with a coordinate that is no number; then closed ones
/// with a tag that means nothing.
const std::vector<BrokenMesh>& broken_meshes();

/// Held: the subject refused the mesh, with any message, or delivered nothing for a mesh without faces.
/// Finding: it accepted the mesh. Crash, timeout: its process broke down. Not supported: it was not asked,
/// because it does not validate, or does not do the scheme.
struct Refusal {
  bool asked = true;  // false: the mesh has tags of a kind that the subject does not declare
  Status status = Status::kHeld;
  std::string message;
  std::optional<Origin> origin = {};  // of a breakdown
};

/// What a subject that declares `sharp`, LC_SHARP_..., made of each of broken_meshes().
std::vector<Refusal> ask_for_refusals(const AuditSubject& subject, data::Scheme scheme, int threads,
                                      std::int32_t sharp);

/// Hands `mesh` to the subject as it is. Never throws for what the subject does.
Refusal ask_for_refusal(const AuditSubject& subject, const data::ControlMesh& mesh, data::Scheme scheme,
                        int threads);

/// A broken mesh from a file, as it is, but for faces of fewer than three corners, which no interface takes.
///   options  how larger faces are cut, if they are, and the scheme by which something is wrong with the mesh
///   throws   data::InputError: the file cannot be read, or an index has more than 32 bits;
///            data::ArgumentError: nothing is wrong with the mesh
data::io::Examination read_broken_mesh(const std::string& file, const data::ReadOptions& options);

/// One row `rejected-inputs` for each subject and mesh: whether the subject refuses the mesh.
std::vector<Result> must_refuse(const std::vector<AuditSubject>& subjects,
                                const std::vector<AuditMesh>& meshes, int threads);

}  // namespace limitcheck::verify
