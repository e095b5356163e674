// SPDX-License-Identifier: MIT
// Findings are confirmed in certified arithmetic: what is beyond its bound by the reference in double is
// evaluated again.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "verify/evidence/evidence.h"

namespace limitcheck::verify {

/// What certified arithmetic says of the values that are beyond their bounds by the reference in double.
struct Confirmation {
  std::int64_t looked = 0;     // evaluated again
  std::int64_t acquitted = 0;  // of these: within the bound after all, or at a point where nothing is judged
  std::int64_t left = 0;       // beyond the bound in double and not looked at, though some were acquitted
  std::int64_t worst = -1;     // the first that was confirmed
  std::string message;         // empty unless some were acquitted
};

/// Evaluates the points of the errors that are beyond their bounds in certified arithmetic, in the order of
/// error over bound, until one is confirmed. If that is the very first, double and certified numbers agree,
/// and the errors of all others count as they are. If any was acquitted, double cannot be trusted on this
/// mesh: then up to kMostCertified are evaluated, and the others are not judged.
///   error    of each vertex, or of each use of a vertex; negative where there is none; corrected where it
///            was looked at
///   side     whose exact point it is held against
///   bound    of an error
///   measure  the error against the exact point, negative if nothing can be judged there
/// A point that the certified evaluator does not take counts as confirmed. Throws Interrupted.
inline constexpr std::int64_t kMostCertified = 1000;
Confirmation confirm(const Evidence& e, std::vector<double>& error,
                     const std::function<Sides::Id(std::size_t)>& side,
                     const std::function<double(std::size_t)>& bound,
                     const std::function<double(std::size_t, const ExactPoint&)>& measure);

/// The same for angles of normals in degrees, one for each of e.uses against normal_bound_at() of its side,
/// and all of it into a row:
///   worst, bound, rms, p99   of the points whose bound is that of ordinary ones; worst and bound of the
///                            confirmed point if there is one
///   ill_conditioned          of the other points: how many, and how far their bounds go
///   message                  both in words
/// Returns the use that the row's witness is, or -1.
std::int64_t judge_angles(const Evidence& e, std::vector<double>& angle,
                          const std::function<double(std::size_t, const ExactPoint&)>& measure, Result& row);

/// Adds a sentence to what a row says.
void say(Result& row, const std::string& sentence);

/// Says how many of something a row leaves out because they are NaN or infinite: only `finite` (or `written`)
/// reports those.
void say_left_out(Result& row, std::int64_t count, const char* what);

}  // namespace limitcheck::verify
