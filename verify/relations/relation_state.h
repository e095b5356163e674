// SPDX-License-Identifier: MIT
// Whether earlier requests change the answers of a subject.
#pragma once

#include "verify/relations/relation_row.h"

namespace limitcheck::verify {

/// Asks for the tessellation of the evidence eight times in one session, each time after something else
/// (verify/host/in_turns.h), and the fourth time with 8 threads, and once in a session for each mesh that may
/// come first: each must have the bits that it had in a process that was asked for nothing else. NaNs are
/// compared by their bits, too.
void ask_in_turns(RelationRow& row, const AuditSubject& subject, const Evidence& e, const Compared& compared);

}  // namespace limitcheck::verify
