// SPDX-License-Identifier: MIT
// The checks. Each is one function: evidence in, rows out. No check relies on another one having held.
//
// Findings are confirmed in certified arithmetic: what is beyond its bound by the reference in double is
// evaluated again.
#pragma once

#include <functional>
#include <string>
#include <string_view>
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
///   bound    of an error
///   measure  the error against certified numbers, negative if nothing can be judged there
/// A point that the certified evaluator does not take counts as confirmed. Throws Interrupted.
inline constexpr std::int64_t kMostCertified = 1000;
Confirmation confirm(std::vector<double>& error, const std::function<double(std::size_t)>& bound,
                     const std::function<double(std::size_t)>& measure);
/// The same of points of the surface.
///   side     whose exact point an error is held against
///   measure  the error against that
Confirmation confirm(const Evidence& e, std::vector<double>& error,
                     const std::function<Sides::Id(std::size_t)>& side,
                     const std::function<double(std::size_t)>& bound,
                     const std::function<double(std::size_t, const ExactPoint&)>& measure);

/// Errors of which some have bounds of their own, and all of it in a row:
///   worst, bound, rms, p99   of the points whose bound is the ordinary one; worst and bound of another point where
///                            that is the one that the row is about
///   ill_conditioned          of the other points: how many, and how far their bounds go
///   confirmed                what the row is about: an error that was confirmed, or -1: the worst
///   why                      the other points, in words
/// Returns the error that the row's witness is, or -1.
std::int64_t judge(const std::vector<double>& error, const std::function<double(std::size_t)>& bound,
                   double ordinary_bound, std::int64_t confirmed, const char* why, Result& row);

/// confirm() and judge() of angles of normals in degrees, one for each of e.uses against normal_bound_at() of its
/// side.
std::int64_t judge_angles(const Evidence& e, std::vector<double>& angle,
                          const std::function<double(std::size_t, const ExactPoint&)>& measure, Result& row);

/// Whether a row of normals has any to look at; if not, it says why.
///   of_limits   the subject must deliver limit points, too
bool has_normals(const Evidence& e, Result& row, bool of_limits = false);

/// Says how many of something a row leaves out because they are NaN or infinite: only `finite` (or `written`)
/// reports those.
void say_left_out(Result& row, std::int64_t count, const char* what);

/// The checks, in the order of the table. checks() says which rows each finds; what a row looks at is told in
/// verify/row/rows.cpp.
std::vector<Result> check_written(const Evidence&);
std::vector<Result> check_finite(const Evidence&);
std::vector<Result> check_positions(const Evidence&);
std::vector<Result> check_normals(const Evidence&);
std::vector<Result> check_normals_against_positions(const Evidence&);
std::vector<Result> check_orientation(const Evidence&);
std::vector<Result> check_coverage(const Evidence&);
std::vector<Result> check_shared(const Evidence&);
std::vector<Result> check_continuity(const Evidence&);
std::vector<Result> check_watertight(const Evidence&);
std::vector<Result> check_channels(const Evidence&);

struct Check {
  std::string_view name;  // of the file and the function; the names of its rows are in `rows`
  std::vector<std::string_view> rows;
  std::vector<Result> (*run)(const Evidence&);
  bool needs_reference;  // does not make sense without the exact surface
};

/// In the order of the table.
const std::vector<Check>& checks();
/// Whether a mesh has what a check looks at: channels.
bool has_matter(const Check& check, const data::ControlMesh& mesh);

}  // namespace limitcheck::verify
