// SPDX-License-Identifier: MIT
// A mesh of polygons with the sharpness of every side, and Catmull and Clark's step for it.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"

namespace limitcheck::fast {

inline constexpr double kAlwaysSharp = std::numeric_limits<double>::infinity();

/// What one step makes of the sharpness of an edge, seen from one of its ends, or of a vertex. [DeRose 1998]
///   sum, count   of the sharpness of all edges at that end which are sharp, but not for ever: for Chaikin's
///                way alone
double softened(double sharpness, double sum, int count, data::Creasing creasing);

/// Polygons whose tags lie where they are used.
///   side     per corner, faces one after the other: the sharpness of the side from it to the next corner; 0
///            smooth, kAlwaysSharp on the boundary and from data::kInfiniteSharpness on. Both faces of a side
///            say the same.
///   vertex   likewise; kAlwaysSharp also where the mesh's boundary option holds a vertex of one face
struct SharpPolygons {
  std::vector<std::array<double, 3>> positions;
  data::Faces faces;
  std::vector<double> side, vertex;
  data::Creasing creasing = data::Creasing::kUniform;
  data::TriangleRule triangles = data::TriangleRule::kCatmark;

  /// Throws data::ArgumentError: a mesh that data::validate refuses for the scheme; what it says.
  static SharpPolygons of(const data::ControlMesh& mesh, data::Scheme scheme = data::Scheme::kCatmullClark);

  /// One step, in double: quad c lies at corner c of all corners, as (V, E, F, E'): the vertex, the middle of
  /// the side from it, the middle of the face, the middle of the side to it. Vertices: the old ones, then
  /// those of edges, then those of faces.
  SharpPolygons step() const;
};

}  // namespace limitcheck::fast
