// SPDX-License-Identifier: MIT
// What `limitcheck prove` proves: which topologies, in which arithmetic, to which depth.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "verify/proof/prove_map.h"

namespace limitcheck::verify {

enum class ProofSize : std::uint8_t {
  kStandard,  ///< every kind of topology; two minutes on two cores
  kFull       ///< deeper, and all bumpy spheres
};

struct ProofRequest {
  std::vector<int> valences{3, 4, 5, 6, 7, 8, 9, 10, 11, 12};  ///< of the interior triples
  int depth = 6;                                               ///< the deepest
  bool sliding_window = true, row_stream = true;
  ProofSize size = ProofSize::kStandard;
};

/// One topology, one arithmetic; and the bounds of the rounding errors, if asked for.
struct ProofTask {
  std::string group;
  Neighbourhood neighbourhood;
  MapOptions options;
  int bound_depth = -1;  ///< bounds for depths 0 .. bound_depth
  int bound_meshes = 0;  ///< control meshes tried against them, at each depth
};

struct ProofSet {
  std::vector<ProofTask> tasks;
  std::vector<std::string> impossible;  ///< triples of valences that no face of a manifold mesh has
};

/// Groups, in this order:
/// - triples: every triple of valences, each of its corners once facing the pair's diagonal; residues
/// - deep: every triple once, the depths beyond
/// - digits: the same to 45 decimal digits, shallower, against Stam's evaluator too
/// - rational: all pairs with valences 3, 4 and 6; exact
/// - high: valences 20, 50 and 100
/// - boundary: boundary edges and vertices around pairs of several valences
/// - spheres: every pair of the bumpy spheres
ProofSet proof_set(const ProofRequest& request);

/// Runs the tasks on all cores. The rows of task t are result[t], whatever the number of threads.
///   progress   called from any one thread at a time with the number of tasks done
std::vector<std::vector<ProofRow>> prove(const std::vector<ProofTask>& tasks,
                                         const std::function<void(std::size_t)>& progress = {});

}  // namespace limitcheck::verify
