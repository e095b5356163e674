// SPDX-License-Identifier: MIT
// Rules that the paper prints and that are wrong, or that it leaves open. Only the tests of its claims choose
// them, to measure what they cost; whoever wants a surface takes the defaults.
#pragma once

#include <cstdint>
#include <span>

#include "fast/plan/crack.h"
#include "fast/plan/pairing.h"

namespace limitcheck::fast {

/// How faces move between the priority sets of the pairing, step 3. [C39]
enum class PairingRule : std::uint8_t {
  kCorrected,  // as in erratum 6: what falls to one free neighbour goes to S0, then S3 -> S2, then S2 -> S1
  kPrinted     // in the printed order: S3 -> S2 first, so that the next line carries the same faces on to S0
};

/// Up to which depth a face collects points on its edge to a neighbour. [C57, C58]
enum class EdgeDepthRule : std::uint8_t {
  kMaximum,     // the larger depth of both faces: symmetric, no cracks
  kRespective,  // the neighbour's depth, as printed: two adjacent fans exchange depths
  kTwoOrMore    // as kMaximum, but only faces with two or more deeper neighbours are repaired
};

struct PrintedRules {
  PairingRule pairing = PairingRule::kCorrected;
  bool prefer_equal_depth = true;  // false: the partner of highest priority whatever its depth [C42]
  EdgeDepthRule edge_depth = EdgeDepthRule::kMaximum;
};

/// As pair_faces() without rules. `keep`: pairs that are there before the others, each
/// of faces of one depth.
PairingResult pair_faces(const Adjacency& adjacency, std::span<const std::int32_t> depth,
                         const PrintedRules& rules, std::span<const Grid> keep = {});
/// After the pairing, when `depth` is final, -1 = culled: a face is repaired if a neighbour is deeper, and
/// the depth of an edge is the larger of its faces'. A culled neighbour counts as the face's own depth; a cut is an
/// edge like others, so that its sides meet.
///   throws   data::ArgumentError: not one depth per face
template <class Faces>
CrackPlan plan_cracks(const Faces& faces, std::span<const std::int32_t> depth, const CrackOptions& options,
                      const PrintedRules& rules = {});

}  // namespace limitcheck::fast
