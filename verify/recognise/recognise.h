// SPDX-License-Identifier: MIT
// Recognises what a subject delivered in place of the surface that it should have delivered, and in place of its normals.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "data/control_mesh.h"
#include "verify/evidence/evidence.h"
#include "verify/evidence/vector.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {

// What other rules of subdivision make of a control mesh, and whether points are those.

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

/// In words, "the limit points of Loop's rule with Warren's simplified weights (1 step)", and as a report has it.
Recognised recognised(GuessedRule scheme, int steps, bool limit, bool tags);

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

// For the rows of an audit.

/// What other rules make of a mesh, kept for its next subject: by its reference, the rule, whether limit points, and
/// whether with its tags.
using KeptGuesses = std::map<std::tuple<const ReferenceSurface*, GuessedRule, bool, bool>, SchemePoints>;

/// Adds a sentence, and of positions `recognised`, to the findings among `results`, the rows of this evidence,
/// that it can explain:
///   positions, refined-positions   the points are those of another scheme at the same lattice points, or of
///                                  Loop's without or with the limit mask, by majority
///                                  (Likeness); all visible faces have one depth
///   normals                        origin_of_normals()
/// Then the row `recognised` is added: the points that are not those of what was recognised, by the bound of
/// the positions. Does nothing without such a finding, or if there are more than kRecognised lattice points.
void recognise(const Evidence& e, std::vector<Result>& results, KeptGuesses& kept);

inline constexpr Lattice::Id kRecognised = 300000;

/// A delivered normal and where it belongs.
struct DeliveredNormal {
  std::int32_t vertex = -1;
  Vector direction{};     // of any length but 0, finite
  Vector expected{};      // the surface's
  std::int32_t face = 0;  // the control face it lies on ...
  double l1 = 0, l2 = 0;  // ... and where
};

/// A sentence with figures, or nothing if nothing is recognised: that most normals point the other way; and
/// that they are nearer, by half at least, to the facets' normals, to averages of the facets around a point
/// (weighted by area or angle, or all alike), or to those of the control mesh, flat or interpolated, than to
/// the surface's.
///   point_of   of each vertex: vertices in one place are one point; -1: not finite, left out
///   positions  of the vertices
std::string origin_of_normals(std::span<const DeliveredNormal> normals, const data::ControlMesh& control,
                              std::span<const Vector> positions,
                              std::span<const std::array<std::int32_t, 3>> triangles,
                              std::span<const std::int32_t> point_of);

}  // namespace limitcheck::verify
