// SPDX-License-Identifier: MIT
// Checks that need more than one tessellation: what must stay the same in variants of a request. They need no
// exact surface, so they judge every family of weights. And meshes on which the scheme is not defined: a subject must
// refuse them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/io/polygon_soup.h"
#include "verify/evidence/audit_case.h"
#include "verify/evidence/evidence.h"

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

/// The names of the rows, in the order of the table; what each looks at is told in verify/row/rows.cpp. Those of
/// sharp edges are there only for meshes that have what they need: relation_rows_of().
/// The rows from face-order to fractional-sharpness hold if positions and normals differ by at most twice
/// what one result may be off; a smaller difference in bits is a quality warning if the subject was given the
/// same numbers. They are findings, too, if a point that faces share is delivered with unlike bits in a variant and never in
/// the original: faces begun at other corners show it where a mesh is written too evenly. The witness is such a point,
/// the two values its two vertices'.
const std::vector<std::string_view>& relation_rows();
/// Those that a mesh has.
std::vector<std::string_view> relation_rows_of(const data::ControlMesh& mesh, data::Scheme scheme);

/// One row for each name that the mesh has. `e` is the evidence of the original request. Nothing that the
/// subject does throws: a process that dies or hangs in one request makes its row a crash or a timeout, with
/// the input that did it, and the next request gets a new process.
///   refusals  what the subject made of broken_meshes(); asked for if empty: it is the same for each mesh
///   again     false: `determinism` is one deep request with 1 and with 4 threads alone, as of meshes that are audited
///             without relations: it and `corner-rotation` cost little, and other meshes do not stand for them
///   on_row    called with the name of each row before it is looked at; false: the row is left out
std::vector<Result> check_relations(const AuditSubject& subject, const Evidence& e, int threads,
                                    std::vector<Refusal>& refusals, bool again,
                                    const std::function<bool(std::string_view)>& on_row);

}  // namespace limitcheck::verify
