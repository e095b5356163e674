// SPDX-License-Identifier: MIT
// What libraries and programs may do, and the expected outcome of an audit. For tests.
#pragma once

#include <vector>

namespace limitcheck::verify {

// Those with one outcome.
struct BehaviourGroup {
  const char* outcome;  // right, defect, refused, crash, timeout, memory, protocol
  const char* words;    // with which the first of these is told
  // Each THING@PLACE of test_subjects/behaviours.cpp, or THING of test_subjects/behaviours_program.cpp.
  std::vector<const char*> how;
};

const std::vector<BehaviourGroup>& library_behaviours();
const std::vector<BehaviourGroup>& program_behaviours();

}  // namespace limitcheck::verify
