// SPDX-License-Identifier: MIT
// The subject `unusual`: another subject with a habit that is rare but allowed by subject.h, to test that no
// check reports it as a fault.
//
//   options   of=SUBJECT, habit=NAME (default none), and any option of that subject
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

struct Habit {
  std::string_view name;
  std::string_view description;
  bool of_the_process = false;  // touches what all code of a process shares: to be tried in one of its own
};

/// All habits; the first is "none".
std::span<const Habit> habits();

/// The options that give `subject`, run under `options`, the habit.
std::string unusual_options(std::string_view habit, std::string_view subject, std::string_view options = {});

}  // namespace limitcheck::verify
