// SPDX-License-Identifier: MIT
// The topologies that proofs of Catmull-Clark's scheme cover: a quad with the faces around it, and what is
// sharp there.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "verify/proof/topologies/neighbourhood.h"

namespace limitcheck::verify {

/// The quad whose corners A B C D, vertices 0 1 2 3, are interior vertices of these valences, each at least
/// 3, and all faces that touch it. Every four valences have one. The name has the valences: "3 4 5 6".
///
///        s_2       Face 0 is the quad, face 1 + k the one beyond its side k, from corner k to the next.
///      D --- C     The quads A B C D and B C D A are the same face, but a kernel runs differently on
/// s_3  |     | s_1 them.
///      A --- B
///        s_0
Neighbourhood interior_quad(const std::array<int, 4>& valence);

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
