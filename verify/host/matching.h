// SPDX-License-Identifier: MIT
// Where the vertices and triangles of a uniform tessellation lie on the control mesh, found by how they are connected.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "reference/surface/surface.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// How the cells of a mesh are connected: those of a control mesh refined uniformly, or those that were delivered.
/// They are polygons. A side is numbered through all cells: side k of cell c is first[c] + k, from its corner k to the next.
struct Cells {
  std::vector<std::int32_t> corners;      // vertices, one cell after the other
  std::vector<std::int64_t> first = {0};  // of each cell, and one behind the last
  std::vector<std::int64_t> across;       // of each side the one of the neighbour, or -1
  std::vector<std::int32_t> cell_of;      // of each side
  std::vector<std::int32_t> valence;      // cells at each vertex
  std::vector<std::uint8_t> on_boundary;  // of each vertex

  std::int64_t count() const { return static_cast<std::int64_t>(first.size()) - 1; }
  std::int64_t size(std::int64_t cell) const { return first[cell + 1] - first[cell]; }
  std::int64_t next(std::int64_t side) const {
    const std::int64_t cell = cell_of[side];
    return side + 1 == first[cell + 1] ? first[cell] : side + 1;
  }
  std::int32_t from(std::int64_t side) const { return corners[side]; }
  std::int32_t to(std::int64_t side) const { return corners[next(side)]; }
  /// Finds the neighbours. False if a side has three cells or two that run the same way along it.
  bool connect(std::int64_t vertices);
  /// All cells the other way round; connect() has been called.
  Cells reversed() const;
};

/// The control mesh refined `depth` times; `about` is where the control mesh is at its vertices. One thread may use it.
struct RefinedComplex {
  ///   mesh    valid for the scheme
  ///   depth   0 .. 15
  RefinedComplex(const data::ControlMesh& mesh, data::Scheme scheme, int depth);

  /// Where the limit surface is at a vertex.
  std::array<double, 3> on_surface(std::int32_t vertex) const;

  const int depth;
  Cells cells;
  std::vector<std::int32_t> face_of_cell;
  std::int64_t vertices = 0;          // that a cell has
  std::vector<lc_provenance> place;   // of each side where it begins, on the face of its cell
  std::vector<std::int32_t> corner;   // of each side, to that place
  std::vector<std::int64_t> side_at;  // of each vertex one that begins there, or -1
  std::vector<std::array<double, 3>> about;

 private:
  const data::ControlMesh mesh_;
  const data::Scheme scheme_;
  mutable std::optional<reference::Surface> surface_;  // made when it is first asked
  mutable std::unordered_map<std::int32_t, std::array<double, 3>> known_;
};

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
