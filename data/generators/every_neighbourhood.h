// SPDX-License-Identifier: MIT
// Every tagged neighbourhood of a vertex up to a valence: what an exhaustive audit looks at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "data/generators/star_meshes.h"

namespace limitcheck::data {

/// What neighbourhoods may have, to be or-ed: the numbers of LC_SHARP_.. (verify/subject/subject.h).
enum Kinds : std::int32_t {
  kWithCreases = 1,
  kWithSemiSharp = 2,
  kWithChaikin = 4,
  kWithCorners = 8,
  kWithSmoothTriangles = 16,
  kWithoutDarts = 32
};

/// Every neighbourhood, one of those that rotations and the mirror make of each other, as stars amid regular faces
/// (wherever an edge is sharp, it goes on alike): 3 to `most` faces around a vertex inside, 1 to `most` on a
/// boundary. Each edge is smooth, sharp for a part of one step, for one step and a part of the next, or for ever,
/// in all ways; with a sharpness of the vertex itself, edges are smooth, sharp for more than a step, or for ever;
/// and edges and the vertex that are sharp at all have one sharpness of each other finite class
/// (data/sharpness_classes.h), in all ways. Those with semi-sharp edges are there for each way of creasing, a
/// boundary vertex of one face for each boundary option.
///
/// Of Catmull-Clark's scheme the faces are quads there, and beside these: faces of 3, 4 and 5 corners in all
/// ways without tags, 4 and one other number up to 8 in all ways, triangles by each rule; and one face of 3 or
/// 5 to 8 corners anywhere amid edges that are smooth or of one sharpness of the four, in all ways.
///
/// Dozens in a mesh, the choices of which they share; the mesh's number is the seed of its positions.
/// `most` 3 to 10. The list is kept.                                                       O(4^most most^2)
const std::vector<Stars>& every_neighbourhood(bool triangles, int most, std::int32_t kinds);

/// "neighbourhoods:MOST:KINDS:" or "quad-neighbourhoods:MOST:KINDS:", followed by the number of a mesh from 1 on.
std::string neighbourhoods_name(bool triangles, int most, std::int32_t kinds);

/// The star of a mesh that has a face.
const Star& star_of_face(const Stars& stars, const ControlMesh& mesh, std::size_t face);

}  // namespace limitcheck::data
