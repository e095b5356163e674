// SPDX-License-Identifier: MIT
// What the surface of some faces depends on. Whoever cuts faces out of a mesh asks here which others to take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include "data/faces.h"
#include "data/sharpness.h"
#include "reference/mesh/topology.h"

namespace limitcheck::reference {

/// Some faces, which come first, and all others on which their limit surface depends, with every tag and with
/// the boundary of the part that they make: it is the surface of the whole mesh, exactly. Both schemes:
///   uniform creasing      the faces that touch a corner of theirs
///   Chaikin's creasing    those, and the faces that touch one of these
///
/// Proof, by induction over the steps; F is a face, F' one of its children, "near" a vertex of a face that
/// touches a corner of F. A vertex is whole in the part if the part has all of its faces: then its edges, which
/// of them are on the boundary, its tags and whether it is one of a single face are those of the whole mesh.
///
/// Points. A face that touches F' has as corners only points of the corners of F, of edges at such a corner, and
/// of faces at such a corner. The rules of these points read faces at corners of F, and the limit of F reads the
/// points of faces that touch it. So one ring of points does in every step.
///
/// Sharpness by uniform creasing. The point of an edge at a corner of F reads the edge's own sharpness, that of a
/// corner reads the tags of the corner and of its edges. The tags of the corners of F' and of their edges are
/// those of corners of F and of their edges, less one. So the edges at the corners of F do, in every step.
///
/// Chaikin's creasing. The half of an edge at its end v takes a mean over all semi-sharp edges at v, and the
/// point of an edge of sharpness below 1 asks whether both halves stay sharp: the point of an edge at a corner of
/// F reads the edges at its far end, too. Let D be the edges at corners of F and at far ends of edges of these
/// corners. D' is made of D, however many steps there are: the corners of F' and the far ends of their edges are
/// corners of F, points of edges at a corner of F, and points of faces, at which no edge is sharp. The sharp
/// edges at the first are halves at a corner of F; at the point of an edge they are its two halves, of which one
/// is at the corner, and the other at the far end w takes its mean over the edges at w, all in D. So a chain of
/// semi-sharp edges, however long, reaches F from its far ends alone. Far ends of edges are near, and the second
/// ring makes all near vertices whole.
///
/// What a part adds is a boundary, and, by the option that holds boundary vertices of one face, corners: at
/// vertices that are not whole. The rules above read the tags of whole vertices alone. An edge that stays sharp
/// and has no other at either end is cut or stepped (Sharpness::needs_a_step) by what its far end has: both
/// give one surface.
///
///   faces_at   of a vertex: the numbers of its faces, a range
template <class FacesAt>
std::vector<std::int32_t> support_of(std::vector<std::int32_t> some, const data::Faces& faces,
                                     const FacesAt& faces_at, data::Creasing creasing) {
  std::unordered_set<std::int32_t> known(some.begin(), some.end());
  std::size_t done = 0;
  for (int ring = 0; ring < (creasing == data::Creasing::kChaikin ? 2 : 1); ++ring)
    for (const std::size_t end = some.size(); done < end; ++done)
      for (const std::int32_t v : faces[static_cast<std::size_t>(some[done])])
        for (const std::int32_t f : faces_at(v))
          if (known.insert(f).second) some.push_back(f);
  return some;
}
inline std::vector<std::int32_t> support_of(std::vector<std::int32_t> some, const Topology& topology,
                                            data::Creasing creasing) {
  return support_of(
      std::move(some), topology.faces(), [&](std::int32_t v) { return topology.sector(v).faces; }, creasing);
}

}  // namespace limitcheck::reference
