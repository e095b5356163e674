// SPDX-License-Identifier: MIT
// Where the vertices and triangles of a uniform tessellation lie on the control mesh, found by how they are connected.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "verify/host/refined_complex.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// What a subject without provenance delivers: of each vertex where it is, of each triangle its corners.
struct Bare {
  std::int64_t vertices = 0;
  std::span<const std::array<std::uint32_t, 3>> triangles;
  std::function<std::array<double, 3>(std::int64_t)> position;
};

/// Ways to lay a connected part that are compared.
inline constexpr std::int64_t kMostWays = 8;

/// For each vertex and triangle what lc_tessellation has of it.
struct Matching {
  std::vector<lc_provenance> provenance{};
  std::vector<std::int32_t> corner{}, triangle_face{};
  std::string failure{};    // why there is none; all else is empty
  bool not_judged = false;  // it cannot be told whether there is one
  bool welded = false;      // vertices at equal coordinates were taken for one
  bool reversed = false;    // the triangles are clockwise seen from outside
  /// How many ways there are to lay the triangles on the mesh that were compared, at most kMostWays for each connected part
  /// and 1 if nothing else fits. Of several the one is taken whose median distance from the limit surface is least.
  std::int64_t ways = 1;
};

/// Lays the triangles on the faces of the control mesh, each cut into those of depth `depth`: 4^depth triangles (Loop), or
/// quads of two triangles each, which follow one another in the list and are cut along either diagonal; a face that is no
/// quad, at depth 0, has its triangles in one row, in the order of the faces. Vertices and triangles may be in any order
/// otherwise; if the vertices are too many, those at equal coordinates (bit by bit) are taken for one. Positions decide
/// nothing else, but between several ways to lay them.
Matching match(const RefinedComplex& expected, const Bare& delivered);

}  // namespace limitcheck::verify
