// SPDX-License-Identifier: MIT
// The tasks of `limitcheck prove --scheme catmull-clark`.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "verify/proof/proof_set.h"
#include "verify/proof/topologies/quad_neighbourhood.h"

namespace limitcheck::verify {
namespace {

using Valences = std::array<int, 4>;

std::vector<Valences> quadruples(const std::vector<int>& valences) {
  std::vector<Valences> all;
  for (const int a : valences)
    for (const int b : valences)
      for (const int c : valences)
        for (const int d : valences) all.push_back({a, b, c, d});
  return all;
}

Valences turned(const Valences& v, std::size_t by) {
  return {v[by % 4], v[(by + 1) % 4], v[(by + 2) % 4], v[(by + 3) % 4]};
}

/// One of every quadruple and its turns: each begins elsewhere.
std::vector<Valences> up_to_turns(const std::vector<Valences>& all) {
  std::vector<Valences> chosen;
  std::set<Valences> seen;
  for (const Valences& v : all) {
    if (seen.contains(v)) continue;
    for (std::size_t k = 0; k < 4; ++k) seen.insert(turned(v, k));
    chosen.push_back(turned(v, chosen.size()));
  }
  return chosen;
}

std::vector<Neighbourhood> quads_of(const std::vector<Valences>& valences) {
  std::vector<Neighbourhood> quads;
  for (const Valences& v : valences) quads.push_back(interior_quad(v));
  return quads;
}

/// Seconds of a core, roughly: for the progress bar.
double estimated_seconds(const ProofTask& task) {
  const auto vertices = static_cast<double>(task.neighbourhood.mesh.positions.size());
  const double points = std::exp2(2. * task.options.last_depth);
  double seconds = 1e-3;
  switch (task.options.arithmetic) {
    case Arithmetic::kResidues:
      seconds += 8e-6 * vertices * points;
      break;
    case Arithmetic::kExact:
      seconds += 1.5e-4 * vertices * points;
      break;
    case Arithmetic::kDigits:
      seconds += 3e-4 * vertices * points;
      break;
  }
  if (task.bounds) seconds += 4e-4 * std::exp2(2. * task.bounds->last_depth);
  return seconds;
}

}  // namespace

ProofSet quad_proof_set(const ProofRequest& request) {
  ProofSet set;
  set.scheme = data::Scheme::kCatmullClark;
  const bool full = request.size == ProofSize::kFull;
  const auto add = [&](const char* group, const std::vector<Neighbourhood>& quads, Arithmetic arithmetic,
                       int last, std::optional<BoundOptions> bounds = {}) {
    MapOptions options;
    options.arithmetic = arithmetic;
    options.last_depth = std::min(last, request.depth);
    options.sliding_window = request.sliding_window;
    options.row_stream = request.row_stream;
    if (bounds) bounds->last_depth = std::min(bounds->last_depth, request.depth);
    for (const Neighbourhood& quad : quads) {
      ProofTask task{group, quad, options, bounds, 0};
      task.estimate = estimated_seconds(task);
      set.tasks.push_back(std::move(task));
    }
  };
  const int meshes = full ? 200 : 20;

  const std::vector<Valences> all = quadruples(request.valences), once = up_to_turns(all);
  add("quadruples", quads_of(all), Arithmetic::kResidues, full ? 4 : 2,
      BoundOptions{0, full ? 4 : 2, meshes});
  add("quadruples", quads_of(once), Arithmetic::kExact, full ? 3 : 1);
  add("quadruples", quads_of(once), Arithmetic::kDigits, full ? 2 : 0);

  const std::vector<Neighbourhood> regular{interior_quad({4, 4, 4, 4})};
  std::vector<Valences> deep, high;
  for (const Valences& v :
       {Valences{4, 4, 4, 3}, Valences{5, 4, 4, 4}, Valences{3, 5, 7, 4}, Valences{6, 3, 8, 5}})
    for (std::size_t k = 0; k < 4; ++k) deep.push_back(turned(v, k));
  std::vector<Neighbourhood> deeper = quads_of(deep);
  deeper.push_back(regular.front());
  add("deep", deeper, Arithmetic::kResidues, full ? 7 : 6, BoundOptions{0, full ? 6 : 5, meshes});
  add("deep", deeper, Arithmetic::kExact, full ? 5 : 3);
  add("deep", deeper, Arithmetic::kDigits, full ? 4 : 2);

  for (const int n : {20, 50})
    for (const Valences& v :
         {Valences{n, 4, 4, 4}, Valences{n, 3, 5, 8}, Valences{n, n, 4, 3}, Valences{n, n, n, n}})
      for (std::size_t k = 0; k < (v[1] == n && v[2] == n ? 1U : 4U); ++k) high.push_back(turned(v, k));
  add("high", quads_of(high), Arithmetic::kResidues, full ? 5 : 2, BoundOptions{0, full ? 4 : 2, meshes});
  if (!full) std::erase_if(high, [](const Valences& v) { return v[0] + v[1] + v[2] + v[3] > 70; });
  add("high", quads_of(high), Arithmetic::kExact, full ? 2 : 1);
  add("high", quads_of(high), Arithmetic::kDigits, full ? 1 : 0);

  std::vector<Neighbourhood> boundary, cuts, darts, semi_sharp;
  std::set<std::string> seen;
  const auto add_new = [&](std::vector<Neighbourhood>& to, std::vector<Neighbourhood> quads) {
    for (Neighbourhood& quad : quads)
      if (seen.insert(quad.name).second) to.push_back(std::move(quad));
  };
  for (const Valences& v : full
                               ? std::vector{Valences{4, 4, 4, 4}, Valences{5, 3, 6, 4}, Valences{3, 3, 8, 5}}
                               : std::vector{Valences{4, 4, 4, 4}, Valences{5, 3, 6, 4}})
    add_new(boundary, boundary_quads(v));
  add("boundary", boundary, Arithmetic::kResidues, full ? 5 : 3, BoundOptions{0, full ? 4 : 2, meshes});
  add("boundary", boundary, Arithmetic::kExact, full ? 3 : 1);
  add("boundary", boundary, Arithmetic::kDigits, full ? 2 : 0);

  for (const Valences& v : {Valences{4, 4, 4, 4}, Valences{5, 3, 6, 4}}) {
    for (Neighbourhood& quad : creased_quads(v)) {
      std::vector<Neighbourhood>& to = has_dart(quad.mesh) ? darts : cuts;
      to.push_back(std::move(quad));
    }
    for (Neighbourhood& quad : semi_sharp_quads(v))
      if (!has_dart(quad.mesh)) semi_sharp.push_back(std::move(quad));
  }
  add("cuts", cuts, Arithmetic::kExact, full ? 3 : 2, BoundOptions{0, full ? 4 : 2, meshes});
  add("cuts", cuts, Arithmetic::kDigits, full ? 2 : 0);
  add("darts", darts, Arithmetic::kDigits, full ? 3 : 1, BoundOptions{0, full ? 4 : 2, meshes});
  add("semi-sharp", semi_sharp, Arithmetic::kExact, full ? 3 : 1, BoundOptions{0, full ? 4 : 2, meshes});
  return set;
}

}  // namespace limitcheck::verify
