// SPDX-License-Identifier: MIT
// What other rules of subdivision make of a control mesh, and whether points are those: to recognise a
// tessellation that is not what it should be.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "verify/evidence/vector.h"
#include "verify/row/result.h"
#include "verify/row/statistics.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {

enum class GuessedRule {
  kLoop,          // Loop's weights of 1987
  kWarren,        // the simplified a(n) = 3/8 for n > 3, 9/16 for n = 3
  kLinear,        // midpoints: the flat control mesh with more vertices
  kCatmullClark,  // quads after the first step
};

/// Vertices after `steps` steps, `limit`: moved to the limit surface of that scheme, but for Catmull-Clark
/// after zero steps. Boundaries by the cubic B-spline (Linear: midpoints). The mesh is valid
/// (data/validate.h); all but Catmull-Clark need triangles. Sharp edges and vertices are as the mesh has
/// them. Computed by the reference.
std::vector<Vector> scheme_points(const data::ControlMesh& mesh, GuessedRule scheme, int steps, bool limit);

/// The same points with their places on the control mesh: the lattice of depth `steps` has them. A vertex
/// that is none of its points (Catmull and Clark's inside of Loop's faces) has denominator 0.
struct SchemePoints {
  std::vector<Vector> position;
  std::vector<Place> place;
};
///   lattice  of which scheme the places are
SchemePoints placed_scheme_points(const data::ControlMesh& mesh, GuessedRule scheme, int steps, bool limit,
                                  data::Scheme lattice = data::Scheme::kLoop);

/// The mesh as somebody has it who knows nothing of sharp edges and vertices.
data::ControlMesh without_tags(const data::ControlMesh& mesh);

/// "catmull-clark": stable.
std::string_view word(GuessedRule scheme);
/// "the limit points of Loop's rule with Warren's simplified weights (1 step)"
std::string describe(GuessedRule scheme, int steps, bool limit);

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
