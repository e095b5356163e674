// SPDX-License-Identifier: MIT
// Whether points are those of a guess rather than the ones that were expected: by majority, so that some that
// are wrong by themselves neither hide what the others are nor are explained by it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "verify/row/result.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {

class Likeness {
 public:
  ///   rounding   how far a point of the guess may be delivered from where it is ...
  ///   tolerance  .. and one that was expected, in the same unit
  Likeness(double rounding, double tolerance)
      : rounding_(std::max(rounding, std::numeric_limits<double>::min())), tolerance_(tolerance) {}

  /// One point, by its distances.
  void add(double from_guess, double from_truth) {
    const bool off = !(from_guess <= rounding_);
    ++points_;
    off_ += off;
    misfit_ += std::log(std::max(from_guess, rounding_));
    if (!off && from_truth <= tolerance_) return;  // does not tell them apart
    ++telling_;
    nearer_ += kTimesNearer * from_guess <= from_truth;
  }

  /// Most points are those of the guess but for rounding; and most of those that are off the one or the other
  /// are ten times nearer to the guess.
  bool convincing() const { return points_ >= kFewest && 2 * off_ <= points_ && 2 * nearer_ > telling_; }
  /// Whether points that are only some of all leave hope for that.
  bool plausible() const { return 4 * nearer_ >= telling_; }

  std::int64_t points() const { return points_; }
  /// Points that are not those of the guess.
  std::int64_t off() const { return off_; }
  /// The mean logarithm of the distances from the guess, none below rounding: the guess with the least is
  /// the best, and a few points that are far off do not change which.
  double misfit() const { return misfit_ / static_cast<double>(std::max<std::int64_t>(points_, 1)); }

 private:
  static constexpr double kTimesNearer = 10;
  static constexpr std::int64_t kFewest = 10;

  double rounding_, tolerance_, misfit_ = 0;
  std::int64_t points_ = 0, off_ = 0, telling_ = 0, nearer_ = 0;
};

/// Fills in the row `recognised` or `file-recognised`: which points are not those of what was recognised.
///   distances   of all points from it, in diagonals, and what rounding may make of them
///   worst       where the worst one is; may be nothing if none is off
void say_recognised(Result& row, const Recognised& recognised, const Statistics& distances, double rounding,
                    const std::optional<Witness>& worst);

}  // namespace limitcheck::verify
