// SPDX-License-Identifier: MIT
// Definitions behind prove_map.h, for the .cpp files that instantiate them.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/loop/stam.h"
#include "verify/proof/maps/kernel_runs.h"
#include "verify/proof/maps/map_rows.h"
#include "verify/proof/maps/reference_map.h"
#include "verify/proof/maps/stream_runs.h"

namespace limitcheck::verify::detail {

/// Maps: a tuple of ReferenceMap.
template <class C, class Maps>
std::vector<ProofRow> prove_map(const Neighbourhood& neighbourhood, const MapOptions& options, Maps maps) {
  std::vector<ProofRow> rows;
  const std::int32_t faces = neighbourhood.mesh.faces.size() == 1 ? 1 : 2;
  const auto points = identity<C>(neighbourhood.mesh.positions.size());
  if (options.sliding_window) {
    const WindowRuns<Stencil<C>, LinearSurface<Stencil<C>>> runs(neighbourhood.mesh, points);
    rows.push_back(compare<C>(neighbourhood, "sliding-window", options, maps,
                              [&](int depth, auto&& visit) { runs.pair(depth, visit); }));
    rows.push_back(compare<C>(neighbourhood, "crack-edge", options, maps, [&](int depth, auto&& visit) {
      for (std::int32_t h = 0; h < 3 * faces; ++h) runs.edge(h, depth, visit);
    }));
    MapOptions once = options;
    once.first_depth = once.last_depth = 0;
    rows.push_back(compare<C>(neighbourhood, "crack-centre", once, maps, [&](int, auto&& visit) {
      for (std::int32_t face = 0; face < faces; ++face) runs.centre(face, visit);
    }));
  }
  if (options.row_stream) {
    const StreamRuns<Stencil<C>, StencilLane<C>::template Lane> runs(neighbourhood.mesh, points);
    rows.push_back(compare<C>(neighbourhood, "row-stream", options, maps,
                              [&](int depth, auto&& visit) { runs.pair(depth, visit); }));
    rows.push_back(compare<C>(neighbourhood, "row-stream-edge", options, maps, [&](int depth, auto&& visit) {
      for (std::int32_t h = 0; h < 3 * faces; ++h) runs.edge(h, depth, visit);
    }));
    check_scale(rows[rows.size() - 2]);
    check_scale(rows.back());
  }
  return rows;
}

}  // namespace limitcheck::verify::detail
