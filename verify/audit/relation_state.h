// SPDX-License-Identifier: MIT
// Whether what a subject has been asked before changes what it answers.
#pragma once

#include "verify/audit/relation_row.h"

namespace limitcheck::verify {

/// Asks for the tessellation of the evidence eight times in one session, each time after something else
/// (verify/subject/in_turns.h), and the fourth time with 8 threads: each must have the bits that it had in a
/// process that was asked for nothing else. NaN has the bits that it has.
void ask_in_turns(RelationRow& row, const AuditSubject& subject, const Evidence& e, const Compared& compared);

}  // namespace limitcheck::verify
