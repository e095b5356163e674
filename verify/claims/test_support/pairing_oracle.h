// SPDX-License-Identifier: MIT
// Two independent judges of a pairing: its rule replayed from the definitions, and the optimum.
#pragma once

#include <fmt/core.h>
#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/max_cardinality_matching.hpp>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "fast/plan/printed_rules.h"

namespace limitcheck::verify {

inline std::vector<std::int32_t> free_neighbours(const fast::Adjacency& adjacency,
                                                 const std::vector<bool>& free, std::int32_t f) {
  std::vector<std::int32_t> result;
  for (int k = 0; k < 3; ++k) {
    const std::int32_t g = adjacency.neighbour(f, k);
    if (g >= 0 && free[g]) result.push_back(g);
  }
  return result;
}

inline std::vector<int> sets(const fast::Adjacency& adjacency, const std::vector<bool>& free, bool greatest) {
  std::vector<int> set(free.size(), -1);
  const auto faces = static_cast<std::int32_t>(free.size());
  for (std::int32_t f = 0; f < faces; ++f) {
    if (!free[f]) continue;
    const auto count = free_neighbours(adjacency, free, f).size();
    set[f] = count <= 1 ? 0 : count == 3 ? 3 : greatest ? 1 : -2;
  }
  // S1, by iteration from all (greatest) or none (least) of the faces with two free neighbours.
  for (bool changed = true; changed;) {
    changed = false;
    for (std::int32_t f = 0; f < faces; ++f) {
      if (set[f] != (greatest ? 1 : -2)) continue;
      const auto around = free_neighbours(adjacency, free, f);
      const bool supported = std::any_of(around.begin(), around.end(),
                                         [&](std::int32_t g) { return set[g] == 0 || set[g] == 1; });
      if (supported == greatest) continue;
      set[f] = greatest ? -2 : 1;
      changed = true;
    }
  }
  for (std::int32_t f = 0; f < faces; ++f) {
    if (set[f] != -2) continue;
    const auto around = free_neighbours(adjacency, free, f);
    if (std::all_of(around.begin(), around.end(), [&](std::int32_t g) { return set[g] == 3; })) set[f] = 2;
  }
  return set;
}

// Step 3 as it is printed, after faces f and g (or -1) were taken: "all neighbours of f and g from S3 to S2",
// "from S2 and S1 to S0", "all triangles from S2 with neighbours in S0, S1 or S2 to S1".
inline void step_3_as_printed(const fast::Adjacency& adjacency, const std::vector<bool>& free, std::int32_t f,
                              std::int32_t g, std::vector<int>& set) {
  set[f] = -1;
  std::vector<std::int32_t> touched = free_neighbours(adjacency, free, f);
  if (g >= 0) {
    set[g] = -1;
    for (const std::int32_t h : free_neighbours(adjacency, free, g)) touched.push_back(h);
  }
  for (const std::int32_t h : touched)
    if (set[h] == 3) set[h] = 2;
  for (const std::int32_t h : touched)
    if (set[h] == 2 || set[h] == 1) set[h] = 0;
  for (std::size_t h = 0; h < set.size(); ++h) {
    if (set[h] != 2) continue;
    const auto around = free_neighbours(adjacency, free, static_cast<std::int32_t>(h));
    if (std::any_of(around.begin(), around.end(), [&](std::int32_t k) { return set[k] <= 2; })) set[h] = 1;
  }
}

/// S0 .. S3 of every free face by the printed definitions, S1 as the greatest fixpoint of "two free
/// neighbours, one of them in S0 or S1"; -1 for a face that is not free, -2 for a free face that no
/// definition takes. [C36]
inline std::vector<int> sets_by_definition(const fast::Adjacency& adjacency, const std::vector<bool>& free) {
  return sets(adjacency, free, true);
}

/// The same with S1 as the least fixpoint.
inline std::vector<int> sets_by_least_fixpoint(const fast::Adjacency& adjacency,
                                               const std::vector<bool>& free) {
  return sets(adjacency, free, false);
}

/// Replays the pairs one by one. The first member must be of the highest set that is not empty, and its
/// partner the best one by the printed rule. Before each pair the sets are
///   kCorrected   computed anew by `sets_by_definition`
///   kPrinted     what the three lines of step 3, as printed, made of them after the pair before, over all
///                faces
/// Returns the first violation in words, or nothing. O(F^2). [C39, C40]
inline std::string first_violation(const fast::Adjacency& adjacency, std::span<const std::int32_t> depth,
                                   const fast::PairingResult& result,
                                   fast::PairingRule rule = fast::PairingRule::kCorrected) {
  std::vector<bool> free(depth.size());
  for (std::size_t f = 0; f < depth.size(); ++f) free[f] = depth[f] >= 0;
  const bool printed = rule == fast::PairingRule::kPrinted;
  std::vector<int> set = sets_by_definition(adjacency, free);
  for (std::size_t round = 0; round < result.grids.size(); ++round) {
    const std::int32_t f = result.grids[round].face0, g = result.grids[round].face1;
    if (!printed) set = sets_by_definition(adjacency, free);
    if (set[f] < 0) return fmt::format("round {}: face {} is not free", round, f);
    int highest = 4;
    for (const int s : set) {
      if (s >= 0) highest = std::min(highest, s);
    }
    if (set[f] != highest) {
      return fmt::format("round {}: face {} is of S{}, but S{} is not empty", round, f, set[f], highest);
    }
    const auto around = free_neighbours(adjacency, free, f);
    free[f] = false;
    if (g < 0) {
      if (!around.empty()) return fmt::format("round {}: face {} is left alone beside a free one", round, f);
      if (printed) step_3_as_printed(adjacency, free, f, g, set);
      continue;
    }
    if (std::find(around.begin(), around.end(), g) == around.end()) {
      return fmt::format("round {}: face {} gets {}, which is no free neighbour", round, f, g);
    }
    // In S0 before not in S0; among these an equal depth before another; then by priority.
    const auto rank = [&](std::int32_t h) { return std::tuple(set[h] != 0, depth[h] != depth[f], set[h]); };
    for (const std::int32_t h : around) {
      if (rank(h) < rank(g))
        return fmt::format("round {}: face {} gets {}, but {} ranks before it", round, f, g, h);
    }
    free[g] = false;
    if (printed) step_3_as_printed(adjacency, free, f, g, set);
  }
  const auto left = std::find(free.begin(), free.end(), true);
  return left == free.end() ? std::string() : fmt::format("face {} is never taken", left - free.begin());
}

/// The fewest singletons that any pairing of the faces that are not culled can leave: F - 2 |maximum
/// matching|, by Edmonds' algorithm (Boost). [C35, C41]
inline std::int64_t fewest_singletons(const fast::Adjacency& adjacency, std::span<const std::int32_t> depth) {
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
  Graph dual(depth.size());
  std::int64_t visible = 0;
  for (std::int32_t f = 0; f < adjacency.face_count(); ++f) {
    if (depth[f] < 0) continue;
    ++visible;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t g = adjacency.neighbour(f, k);
      if (g > f && depth[g] >= 0) add_edge(static_cast<std::size_t>(f), static_cast<std::size_t>(g), dual);
    }
  }
  std::vector<boost::graph_traits<Graph>::vertex_descriptor> mate(depth.size());
  const auto index = get(boost::vertex_index, dual);
  // Without Boost's own verifier, which g++ 12 warns about.
  boost::matching<Graph, decltype(mate.data()), decltype(index), boost::edmonds_augmenting_path_finder,
                  boost::extra_greedy_matching, boost::no_matching_verifier>(dual, mate.data(), index);
  return visible - 2 * static_cast<std::int64_t>(boost::matching_size(dual, mate.data()));
}

}  // namespace limitcheck::verify
