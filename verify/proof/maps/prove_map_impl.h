// SPDX-License-Identifier: MIT
// Definitions behind prove_map.h, for the .cpp files that instantiate them: one for each arithmetic.
#pragma once

#include <vector>

#include "verify/proof/maps/map_comparison.h"
#include "verify/proof/maps/scheme_runs.h"
#include "verify/proof/numbers/quad_weights.h"

namespace limitcheck::verify::detail {

/// Whether a float or double engine scales limit points by the number next to what the proof's own numbers
/// are scaled by: fast::row_stream::scaled has a branch for them. A sample of units stands for all, which are
/// powers of two.
template <class Scheme, class T, class Scaled>
bool scales_rightly(int depth, Scaled&& scaled) {
  for (int e = -60; e <= 60; e += 20) {
    const T unit = std::ldexp(T(1), e);
    const double found = std::ldexp(static_cast<double>(scaled(unit, depth)), Scheme::kTwos * depth);
    // times * found - unit is exact; half a unit in the last place of `found` is allowed.
    const double half = std::ldexp(0.5, std::ilogb(found) + 1 - std::numeric_limits<T>::digits);
    constexpr double kTimes = Scheme::kTimes;
    if (!(std::abs(std::fma(kTimes, found, -static_cast<double>(unit))) <= kTimes * half)) return false;
  }
  return true;
}
template <class Scheme, class T>
bool scales_rightly(int depth) {
  return scales_rightly<Scheme, T>(depth, Scheme::template scaled<T>);
}

/// A row whose depths are not all scaled rightly is no proof.
template <class Scheme>
void check_scale(ProofRow& row) {
  for (int depth = row.first_depth; depth <= row.last_depth && row.map.equal; ++depth) {
    if (scales_rightly<Scheme, float>(depth) && scales_rightly<Scheme, double>(depth)) continue;
    row.map.equal = false;
    row.map.witness = MapWitness{fmt::format("depth {}", depth), "scale of limit points", -1, 0, 0};
  }
}

///   Maps   a tuple of reference's maps
template <class Scheme, class C, class Maps>
std::vector<ProofRow> prove_map(const Neighbourhood& neighbourhood, const MapOptions& options, Maps maps) {
  std::vector<ProofRow> rows;
  const data::ControlMesh& mesh = neighbourhood.mesh;
  SchemeRuns<Scheme, Stencil<C>, StencilLane<C>::template Lane> runs(mesh,
                                                                     identity<C>(mesh.positions.size()));
  for (const ProvedKernel kernel : kProvedKernels) {
    if (!(is_stream(kernel) ? options.row_stream : options.sliding_window) || !runs.has(kernel)) continue;
    MapOptions depths = options;
    if (kernel == ProvedKernel::kCrackCentre)
      depths.first_depth = depths.last_depth = 0;  // it knows no depth
    rows.push_back(compare<C>(neighbourhood, name_of(kernel), depths, maps,
                              [&](int depth, auto&& visit) { runs.run(kernel, depth, visit); }));
    if (kernel == ProvedKernel::kRowStream || kernel == ProvedKernel::kRowStreamEdge)
      check_scale<Scheme>(rows.back());
  }
  return rows;
}

}  // namespace limitcheck::verify::detail
