// SPDX-License-Identifier: MIT
// Recognises what a subject delivered in place of the surface that it should have delivered, and in place of its normals.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "data/control_mesh.h"
#include "verify/evidence/evidence.h"
#include "verify/evidence/vector.h"
#include "verify/recognise/guessed_rule.h"

namespace limitcheck::verify {

/// What other rules make of a mesh, kept for its next subject: by its reference, the rule, whether limit points, and
/// whether with its tags.
using KeptGuesses = std::map<std::tuple<const ReferenceSurface*, GuessedRule, bool, bool>, SchemePoints>;

/// Adds a sentence, and of positions `recognised`, to the findings among `results`, the rows of this evidence,
/// that it can explain:
///   positions, refined-positions   the points are those of another scheme at the same lattice points, or of
///                                  Loop's without or with the limit mask, by majority
///                                  (guessed_rule.h); all visible faces have one depth
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
