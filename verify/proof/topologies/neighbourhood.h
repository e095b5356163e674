// SPDX-License-Identifier: MIT
// The topologies that proofs cover: a pair of faces, or a face without neighbours, with the faces around it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/control_mesh.h"

namespace limitcheck::verify {

/// A pair of faces with every face that touches it: all that its limit points depend on.
///
///        D ---- C        Vertices 0 1 2 3 are A B C D; the others lie around them.
///        |    / |        Face 0 is (A, C, D), face 1 is (A, B, C); half-edge 0 runs from A to C.
///        |  /   |        The pairs A B C D and C D A B are the same two faces, but a kernel runs
///        A ---- B        differently on them.
struct Neighbourhood {
  std::string name;        ///< signature()
  data::ControlMesh mesh;  ///< positions mean nothing here; they are distinct floats in [-1, 1]
};

/// The corners A B C D of a pair in words: "5" an interior vertex of that valence, "2|1" a boundary vertex
/// with two faces before the pair's own and one after, counter-clockwise. Equal signatures have equal kernel
/// runs as long as their one-rings do not meet outside the pair.
///   half_edge   of any mesh, with a twin; A is its origin
std::string signature(const data::ControlMesh& mesh, std::int32_t half_edge);

/// The pair of a half-edge and the faces that touch it, renumbered; vertices that only far faces hold
/// together are split. Throws data::ArgumentError: no twin, or not a manifold mesh.
Neighbourhood cut_out(const data::ControlMesh& mesh, std::int32_t half_edge);

/// The pair whose corners A B C D are interior vertices of these valences, each at least 3; nothing if there
/// is no such mesh (two neighbours of valence 3 force the valences of the others).
std::optional<Neighbourhood> interior_pair(const std::array<int, 4>& valence);

/// The interior pair of these valences with some of the faces around it taken away: one run of neighbouring
/// faces, or any of the four that share an edge with the pair. Distinct signatures, boundary edges and
/// boundary vertices of every kind, the pair alone last.
std::vector<Neighbourhood> boundary_pairs(const std::array<int, 4>& valence);

/// A face without neighbours, "alone": face 0 is all there is. A mesh has no other such face, since a vertex
/// has its faces in one fan. A singleton of the pairing with a neighbour is a pair of which
/// half is displayed.
Neighbourhood face_alone();

/// One pair of every signature that the mesh has, in both directions.
std::vector<Neighbourhood> pairs_of(const data::ControlMesh& mesh);

}  // namespace limitcheck::verify
