// SPDX-License-Identifier: MIT
// The topologies that proofs cover, with the faces around them: a pair of triangles, or one without neighbours;
// and of Catmull-Clark's scheme a quad, and what is sharp there.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
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

/// The mesh of these faces, with positions that are distinct floats in [-1, 1].
data::ControlMesh with_positions(data::Faces faces);

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

/// The quad whose corners A B C D, vertices 0 1 2 3, are interior vertices of these valences, each at least
/// 3, and all faces that touch it. Every four valences have one. The name has the valences: "3 4 5 6".
///
///        s_2       Face 0 is the quad, face 1 + k the one beyond its side k, from corner k to the next.
///      D --- C     The quads A B C D and B C D A are the same face, but a kernel runs differently on
/// s_3  |     | s_1 them.
///      A --- B
///        s_0
Neighbourhood interior_quad(const std::array<int, 4>& valence);

/// Ways to take faces away around others: one run of neighbouring faces, any of the four that share an edge with
/// those in the middle, or all of them.
///   around   the faces around as one walks around them
///   sides    those that share an edge
void for_each_removal(const std::vector<std::size_t>& around, const std::array<std::size_t, 4>& sides,
                      const std::function<void(const std::set<std::size_t>& removed)>& visit);

/// The interior quad with some of the faces around it taken away: one run of neighbouring faces, or any of
/// the four beyond its sides. Distinct names; the quad alone last. A corner on the boundary is named "2|1": so
/// many faces before the quad and after it, counter-clockwise.
std::vector<Neighbourhood> boundary_quads(const std::array<int, 4>& valence);

/// The interior quad with sharp edges: every set of its four sides, and for each a further edge at none of
/// its corners, at one, at all, at those with one sharp side or with two. One sharp edge makes a corner of
/// the quad a dart, two make it part of a crease, three a corner of creases. No two quads are alike. The name of a sharp edge has its ends: "AB", "A+" the further one at A.
std::vector<Neighbourhood> creased_quads(const std::array<int, 4>& valence);

/// The interior quad with semi-sharp edges and vertices, uniform and by Chaikin, at its sides and beyond;
/// some run into creases. The name has their sharpness: "AB 1.5".
std::vector<Neighbourhood> semi_sharp_quads(const std::array<int, 4>& valence);

/// Whether the surface at some corner of face 0 is that of a dart.
bool has_dart(const data::ControlMesh& mesh);

}  // namespace limitcheck::verify
