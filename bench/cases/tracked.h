// SPDX-License-Identifier: MIT
// What performance tracking looks at: one list for instruction counts and for times, of both schemes.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace limitcheck::bench {

/// Counted: callgrind runs it, which is fifty times slower and knows no AVX-512; or timed.
enum class Way { kCounted, kTimed };

/// A piece of work. Each way has a size of its own and, where both have it, may have a name of its own.
struct Tracked {
  std::string counted, timed;  // the names; empty: not that way
  /// Makes ready what must be there beforehand; what it returns is measured, and may be repeated.
  std::function<std::function<void()>(Way)> make;
};

/// Kernels of every target that this machine has, in each output form, at depths 3 and 5; set-up; frames in each
/// output form, at unequal depths, of points that move, on two threads; quads that are regular, not, semi-sharp,
/// n-gons; and speed at equal error (matched.h).
std::vector<Tracked> tracked_cases();

/// Identifies a build, since figures of different builds are not to be compared: compiler, C library, flags, as in
/// "GNU-12.2.0/glibc-2.36/-O3 -DNDEBUG".
std::string build_identity();

}  // namespace limitcheck::bench
