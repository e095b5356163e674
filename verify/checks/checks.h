// SPDX-License-Identifier: MIT
// The checks. Each is one function in one file: evidence in, rows out. No check relies on another one having
// held.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "verify/evidence/evidence.h"

namespace limitcheck::verify {

/// `written`: array defects and overruns that the host found, and entries that still hold the bytes with
/// which the memory was handed out.
std::vector<Result> check_written(const Evidence&);
/// `finite`: positions and normals that were written and are NaN or infinite.
std::vector<Result> check_finite(const Evidence&);
/// `positions`: distance from the exact limit point; `refined-positions`: from the vertex of the refined
/// control mesh, for subjects that deliver no limit points (their `positions` is not supported).
std::vector<Result> check_positions(const Evidence&);
/// `normals`: angle from the exact normal, where the surface
/// has one; `normal-length`: distance from unit length.
std::vector<Result> check_normals(const Evidence&);
/// `normals-against-positions`: the normals fit the facets as well as the exact ones do.
std::vector<Result> check_normals_against_positions(const Evidence&);
/// `orientation`: triangles counter-clockwise on their control face, and facing as the exact facet does.
std::vector<Result> check_orientation(const Evidence&);
/// `coverage`: every control face tiled exactly once, at its depth.
std::vector<Result> check_coverage(const Evidence&);
/// `shared-positions`, `shared-normals`: a point on a control edge or vertex that is delivered more than once
/// has the same bits each time.
std::vector<Result> check_shared(const Evidence&);
/// `continuity`: what the faces at a control edge or vertex deliver there differs by no more than their
/// errors may.
std::vector<Result> check_continuity(const Evidence&);
/// `watertight`: merging equal positions only, the triangles form a manifold with exactly the boundary of the
/// control mesh; `t-vertices`: no vertex lies inside an edge of another triangle.
std::vector<Result> check_watertight(const Evidence&);

struct Check {
  std::string_view name;  // of the file and the function; the names of its rows are in `rows`
  std::vector<std::string_view> rows;
  std::vector<Result> (*run)(const Evidence&);
  bool needs_reference;  // does not make sense without the exact surface
};

/// In the order of the table.
const std::vector<Check>& checks();

}  // namespace limitcheck::verify
