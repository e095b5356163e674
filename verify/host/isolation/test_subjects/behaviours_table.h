// SPDX-License-Identifier: MIT
// What libraries and programs may do, and the expected outcome of an audit. For tests.
#pragma once

#include <vector>

namespace limitcheck::verify {

struct Behaviour {
  const char*
      how;  // THING@PLACE of test_subjects/behaviours.cpp, or THING of test_subjects/behaviours_program.cpp
  const char*
      outcome;  // right, defect, refused, crash, timeout, memory, protocol; the first of two is told with
  const char* words = "";  // these words
};

const std::vector<Behaviour>& library_behaviours();
const std::vector<Behaviour>& program_behaviours();

}  // namespace limitcheck::verify
