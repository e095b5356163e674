// SPDX-License-Identifier: MIT
// The exact surface at the lattice points of a control mesh: the expected values of the checks, in double, and
// in certified arithmetic, which is the last word on a finding.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "reference/loop/masks.h"
#include "verify/evidence/vector.h"
#include "verify/row/bounds.h"
#include "verify/subject/lattice.h"

namespace limitcheck::verify {

/// One point: to 40 significant digits of the largest coordinate, and the same rounded to double.
struct ExactPoint {
  Vector position, normal;
  std::vector<std::string> position_digits, normal_digits;  // x, y, z
  bool has_normal;  // false: the tangents may be parallel, or there is no tangent plane (D5, D12)
};

/// After how many steps no tag is left but those that stay sharp.
int steps_of(const data::Sharpness& tags);

/// The limit surface or the refined mesh at lattice points, evaluated when first asked for and kept, so that
/// several subjects share it.
///
/// Doubles lie within rounding of the exact values, which is not enough where a normal is ill-conditioned:
/// findings are confirmed by certified().
class ReferenceSurface {
 public:
  /// `mesh` is copied. `depth` is that of the lattice; `weights` are those of Loop's scheme.
  ///   others   limit points off the lattice that will be asked for, too
  ReferenceSurface(const data::ControlMesh& mesh, data::Scheme scheme, int depth, lc_points points,
                   reference::Weights weights = reference::Weights::kLoop,
                   std::span<const Place> others = {});
  /// Of the scheme that the mesh is meant for.
  ReferenceSurface(const data::ControlMesh& mesh, int depth, lc_points points,
                   reference::Weights weights = reference::Weights::kLoop)
      : ReferenceSurface(mesh, data::natural_scheme(mesh), depth, points, weights) {}
  ~ReferenceSurface();

  const data::ControlMesh& mesh() const { return mesh_; }
  const Lattice& lattice() const { return lattice_; }
  const Sides& sides() const { return sides_; }
  /// How many steps a subject takes at least: the depth, or until semi-sharp edges are smooth.
  int steps() const { return steps_; }
  /// How many points the longest sum of a place has: of its face the mask at the corner with most points in its
  /// faces, the corner included. The surface over the face depends on no other rings. (bounds.h)
  std::int64_t terms_at(Lattice::Id id) const {
    return terms_.empty() || id == Lattice::kNone ? kOrdinaryTerms : terms_[lattice_.place(id).face];
  }
  lc_points points() const { return points_; }
  reference::Weights weights() const { return weights_; }

  /// Evaluates what is missing among these points (kNone is skipped), in parallel. Not to be called at the
  /// same time as anything else.
  void prepare(std::span<const Lattice::Id> ids);

  /// All functions below are for prepared points only. The position is a double; reference/surface/surface.h
  /// says where its error is stated.
  const Vector& position(Lattice::Id id) const { return position_[id]; }
  /// Unit normal of a side; limit points only.
  const Vector& normal(Sides::Id id) const { return normal_[id]; }
  /// False where the surface has no normal (D12: zero by the masks; D5: vertices of boundaries and creases
  /// without a tangent plane, spikes).
  bool has_normal(Sides::Id id) const { return state_[id] == State::kRegular; }
  /// Where there is a normal: (|t1| + |t2|) / |t1 x t2|, t1 and t2 the derivatives by l1 and l2, or by u and
  /// v. An error of e in both tangents turns the normal by e times this, in radians. Infinite if t1 x t2
  /// vanishes in double. At a control vertex, that of the middle of the finest facet there if it is larger,
  /// and in any case where the derivatives vanish: a control vertex that is extraordinary need not have any.
  double normal_condition(Sides::Id id) const { return condition_[id]; }

  /// A side of a point in certified arithmetic (reference/surface/certified.h); nullptr where that cannot certify it. It
  /// takes some milliseconds and is kept: an audit without a finding never needs any of it. Any number of threads
  /// may ask.
  const ExactPoint* certified(Sides::Id side) const;

 private:
  void evaluate(Sides::Id side);

  enum class State : std::uint8_t { kMissing, kWanted, kRegular, kNoNormal };
  struct Evaluators;

  data::ControlMesh mesh_;
  Lattice lattice_;
  Sides sides_;
  int steps_;
  lc_points points_;
  reference::Weights weights_;
  std::vector<std::int64_t> terms_;  // of each face; empty: no more than kOrdinaryTerms
  std::unique_ptr<Evaluators> evaluators_;
  std::vector<Vector> position_, normal_;
  std::vector<double> condition_;
  std::vector<State> state_;
};

}  // namespace limitcheck::verify
