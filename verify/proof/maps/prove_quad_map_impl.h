// SPDX-License-Identifier: MIT
// Definitions behind prove_map.h for Catmull-Clark's scheme, for the .cpp files that instantiate them.
#pragma once

#include <tuple>
#include <vector>

#include "verify/proof/maps/map_rows.h"
#include "verify/proof/maps/quad_reference_map.h"
#include "verify/proof/maps/quad_runs.h"
#include "verify/proof/numbers/quad_weights.h"

namespace limitcheck::verify::detail {

/// As scales_rightly, of quads: limit points are 36 * 4^depth times too large.
template <class T>
bool scales_quads_rightly(int depth) {
  return scales_rightly<T>(
      depth, [](T unit, int d) { return fast::row_stream::quad_unit(unit, d); }, 36, 2 * depth);
}
inline void check_quad_scale(ProofRow& row) {
  check_scale(row, [](int depth) {
    return scales_quads_rightly<float>(depth) && scales_quads_rightly<double>(depth);
  });
}

/// Maps: a tuple of QuadReferenceMap.
template <class C, class Maps>
std::vector<ProofRow> prove_quad_map(const Neighbourhood& neighbourhood, const MapOptions& options,
                                     Maps maps) {
  std::vector<ProofRow> rows;
  const auto points = identity<C>(neighbourhood.mesh.positions.size());
  if (options.sliding_window) {
    const QuadWindowRuns<Stencil<C>, LinearSurface<Stencil<C>>> runs(neighbourhood.mesh, points);
    rows.push_back(compare<C>(neighbourhood, "sliding-window", options, maps,
                              [&](int depth, auto&& visit) { runs.quad(depth, visit); }));
    rows.push_back(compare<C>(neighbourhood, "crack-edge", options, maps,
                              [&](int depth, auto&& visit) { runs.sides(depth, visit); }));
  }
  if (options.row_stream && !fast::QuadMesh(neighbourhood.mesh).semi_sharp()) {
    const QuadStreamRuns<Stencil<C>, StencilLane<C>::template Lane> runs(neighbourhood.mesh, points);
    rows.push_back(compare<C>(neighbourhood, "row-stream", options, maps,
                              [&](int depth, auto&& visit) { runs.quad(depth, visit); }));
    rows.push_back(compare<C>(neighbourhood, "row-stream-edge", options, maps,
                              [&](int depth, auto&& visit) { runs.sides(depth, visit); }));
    check_quad_scale(rows[rows.size() - 2]);
    check_quad_scale(rows.back());
    if (runs.is_regular()) {
      rows.push_back(compare<C>(neighbourhood, "row-stream-patch", options, maps,
                                [&](int depth, auto&& visit) { runs.patch(depth, visit); }));
    }
  }
  return rows;
}

}  // namespace limitcheck::verify::detail
