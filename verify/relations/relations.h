// SPDX-License-Identifier: MIT
// Checks that need more than one tessellation: what must stay the same in variants of a request. They need no
// exact surface, so they judge every family of weights.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "verify/evidence/audit_case.h"
#include "verify/evidence/evidence.h"
#include "verify/relations/refusal.h"

namespace limitcheck::verify {

/// The names of the rows, in the order of the table:
///   determinism          the same request again, and with other numbers of threads, and a deep one: the same
///                        bits
///   face-order           faces in another order
///   vertex-order         control vertices in another order
///   corner-rotation      some faces begin at another corner, drawn at random
///   mirror               the mirror image
///   rotation             axes exchanged with signs: an exact rotation
///   scaling              times 2^10, 2^-10, 2^40 and 2^-40
///   translation          moved by some diagonals, and by 2^20 times as many, in float by 2^10 (positions only: the
///                        rounding of the input turns normals)
///   crease-order         sharp edges and vertices in another order, their ends exchanged
///   infinite-sharpness   10 and 100 for a sharpness of 10 and more
///   boundary-crease      the boundary tagged as sharp
///   cut-by-hand          cut along the edges that stay sharp, which makes them a boundary
///   fractional-sharpness one sharpness s for all that is semi-sharp: linear in s between whole numbers (just
///                        below and above them, too), and what 10 and more adds to 9.99 is little
///   state                between other meshes and depths, on a new instance, the eighth time: the same bits
///   degenerate-geometry  all control points on a line, or the same: finite, normals of unit length
///   rejected-inputs      meshes that are no manifold, name vertices that do not exist or have coordinates
///                        that are no numbers: refused; one without faces: refused, or nothing delivered;
///                        if sharp edges or vertices are declared, tags that mean nothing: refused
/// Those of sharp edges are there only for meshes that have what they need: relation_rows_of().
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
///   on_row    called with the name of each row before it is looked at; false: the row is left out
std::vector<Result> check_relations(const AuditSubject& subject, const Evidence& e, int threads,
                                    std::vector<Refusal>& refusals,
                                    const std::function<bool(std::string_view)>& on_row = {});

/// Those of meshes that are audited without relations, because they cost little and other meshes do not stand for
/// them: `determinism`, of one deep request with 1 and with 4 threads, and `corner-rotation`.
std::vector<Result> check_cheap_relations(const AuditSubject& subject, const Evidence& e, int threads,
                                          const std::function<bool(std::string_view)>& on_row);

}  // namespace limitcheck::verify
