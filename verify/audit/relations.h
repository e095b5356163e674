// SPDX-License-Identifier: MIT
// Checks that need more than one tessellation: what must stay the same when the same surface is asked for
// otherwise. They need no exact surface, so they judge every family of weights.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "verify/audit/audit.h"
#include "verify/audit/evidence.h"
#include "verify/audit/refusal.h"

namespace limitcheck::verify {

/// The names of the rows, in the order of the table:
///   determinism          the same request again, and with other numbers of threads: the same bits
///   face-order           faces in another order
///   vertex-order         control vertices numbered otherwise
///   corner-rotation      corners of the faces begun elsewhere
///   mirror               the mirror image
///   rotation             axes exchanged with signs: an exact rotation
///   scaling              times 2^10 and 2^-10
///   translation          moved by some diagonals (positions only: the rounding of the input turns normals)
///   extreme-scale        times 2^40 and 2^-40
///   state                between other meshes and depths, made again, for the eighth time: the same bits
///   degenerate-geometry  all control points on a line, or the same: finite, normals of unit length
///   rejected-inputs      meshes that are no manifold, name vertices that do not exist or have coordinates
///                        that are no numbers: refused; one without faces: refused, or nothing delivered
/// The rows from face-order to extreme-scale hold if positions and normals differ by at most twice what one
/// result may be off; a difference in bits beneath that is a quality warning where the numbers handed in are
/// the same ones.
const std::vector<std::string_view>& relation_rows();

/// One row for each. `e` is the evidence of the request as it was; never throws for what the subject does: a
/// process that dies or hangs in one request makes its row a crash or a timeout, with the input that did it,
/// and the next request gets a new process.
///   refusals  what the subject made of broken_meshes(); asked for if empty: it is the same for each mesh
///   on_row    called with the name of each row before it is looked at
std::vector<Result> check_relations(const AuditSubject& subject, const Evidence& e, int threads,
                                    std::vector<Refusal>& refusals,
                                    const std::function<void(std::string_view)>& on_row = {});

}  // namespace limitcheck::verify
