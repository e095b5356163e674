// SPDX-License-Identifier: MIT
// The exact surface at lattice points in certified arithmetic: the last word on a finding.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reference/loop/masks.h"
#include "verify/evidence/lattice.h"
#include "verify/evidence/sides.h"
#include "verify/evidence/vector.h"

namespace limitcheck::verify {

/// One point: to 40 significant digits of the largest coordinate, and the same rounded to double.
struct ExactPoint {
  Vector position, normal;
  std::vector<std::string> position_digits, normal_digits;  // x, y, z
  bool has_normal;  // false: the tangents may be parallel, or there is no tangent plane (D5, D12)
};

/// The limit surface of the lattice's control mesh (reference/surface/certified.h).
class CertifiedSurface {
 public:
  /// `lattice` and `sides` outlive this. Nothing is computed yet: an audit without a finding never needs any
  /// of it.
  CertifiedSurface(const Lattice& lattice, const Sides& sides, reference::Weights weights);
  ~CertifiedSurface();

  /// A side of a point; nullptr where the evaluator cannot certify it. It takes some milliseconds and is
  /// kept. Any number of threads may ask.
  const ExactPoint* at(Sides::Id side) const;

 private:
  struct State;
  const Lattice& lattice_;
  const Sides& sides_;
  reference::Weights weights_;
  std::unique_ptr<State> state_;
};

}  // namespace limitcheck::verify
