// SPDX-License-Identifier: MIT
// Two independent judges of a pairing: its rule replayed from the definitions, and the optimum.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fast/plan/printed_rules.h"

namespace limitcheck::verify {

/// S0 .. S3 of every free face by the printed definitions, S1 as the greatest fixpoint of "two free
/// neighbours, one of them in S0 or S1"; -1 for a face that is not free, -2 for a free face that no
/// definition takes. [C36]
std::vector<int> sets_by_definition(const fast::Adjacency& adjacency, const std::vector<bool>& free);
/// The same with S1 as the least fixpoint.
std::vector<int> sets_by_least_fixpoint(const fast::Adjacency& adjacency, const std::vector<bool>& free);

/// Replays the pairs one by one. The first member must be of the highest set that is not empty, and its
/// partner the best one by the printed rule. Before each pair the sets are
///   kCorrected   computed anew by `sets_by_definition`
///   kPrinted     what the three lines of step 3, as printed, made of them after the pair before, over all
///                faces
/// Returns the first violation in words, or nothing. O(F^2). [C39, C40]
std::string first_violation(const fast::Adjacency& adjacency, std::span<const std::int32_t> depth,
                            const fast::PairingResult& result,
                            fast::PairingRule rule = fast::PairingRule::kCorrected);

/// The fewest singletons that any pairing of the faces that are not culled can leave: F - 2 |maximum
/// matching|, by Edmonds' algorithm (Boost). [C35, C41]
std::int64_t fewest_singletons(const fast::Adjacency& adjacency, std::span<const std::int32_t> depth);

}  // namespace limitcheck::verify
