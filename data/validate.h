// SPDX-License-Identifier: MIT
// Whether a control mesh is one that a scheme is defined on: an oriented 2-manifold, boundaries allowed; of
// triangles for Loop's scheme, of any polygons for Catmull-Clark's.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"

namespace limitcheck::data {

/// What can be wrong with a mesh. In brackets the elements of a finding: vertices and faces counted from 0,
/// in the order given here.
enum class MeshFault {
  kEmpty,             ///< no vertices or no faces                                     [nothing]
  kTooLarge,          ///< more vertices or half-edges than 32-bit indices name        [vertex and face count]
  kIndexOutOfRange,   ///< a face names a vertex that does not exist                   [face, index]
  kNotFinite,         ///< a coordinate is NaN or infinite                             [vertex]
  kDegenerateFace,    ///< a face names a vertex twice, or has fewer than 3 corners    [face, vertex]
  kDuplicateFace,     ///< two faces have the same corners, in either direction        [first face, later one]
  kNonmanifoldEdge,   ///< an edge has three faces or more                             [v0, v1, faces...]
  kOrientationClash,  ///< both faces of an edge run along it in the same direction    [v0, v1, two faces]
  kBowtieVertex,      ///< the faces at a vertex form two fans or more                 [vertex, face of each]
  kLowValence,        ///< an interior vertex with fewer than 3 neighbours, D9         [vertex]
  kPolygon,           ///< a face that is no triangle, where the scheme is Loop's      [face]
  kIsolatedVertex,    ///< a vertex that no face names                                 [vertex]
  kSharpness,         ///< sharpness of no edge or vertex, below 0, or two of one      [v0, v1, or vertex]
  kHole,              ///< a hole that is no face, or not after the one before it        [face]
};

/// The stable name: "MESH_NONMANIFOLD_EDGE", ...
std::string_view code(MeshFault fault);

/// One thing that is wrong, and where.
struct MeshFinding {
  MeshFault fault{};
  std::vector<std::int64_t> elements;  ///< as listed at MeshFault
  std::string message;                 ///< "edge 4–9 has 3 faces (12, 13, 40)"
  std::int64_t face = -1;              ///< the face that brought the fault in (the latest involved), or -1
  std::int64_t vertex = -1;            ///< if no face did: the vertex at fault, or -1
  std::int64_t tag = -1;               ///< kSharpness: which one, sharp edges first, then sharp vertices
};

/// How messages number vertices and faces; the elements of a finding always count from 0.
struct Numbering {
  std::int64_t first = 0;  ///< of the first vertex and the first face: 1 in OBJ files
  /// For each triangle the polygon, from 0, that it was cut from. Empty where every triangle is a polygon.
  std::span<const std::int64_t> face{};
};

/// Everything that is wrong with the mesh; empty if it is valid. One cause gives one finding: an element that
/// one property refuses is left out when the later properties are examined. Ordered by fault, then by
/// element. Time and memory are O(vertices + faces), whatever the valences: 0.1 to 0.5 s for a million faces,
/// depending on their order in memory.
std::vector<MeshFinding> validate(const ControlMesh& mesh, Scheme scheme, const Numbering& numbering = {});
/// The same for the scheme that the mesh is meant for, natural_scheme(mesh).
std::vector<MeshFinding> validate(const ControlMesh& mesh, const Numbering& numbering = {});

/// The finding kEmpty if there are no vertices or no faces, kTooLarge if 32-bit indices cannot name that many
/// vertices or corners; else nothing.
std::vector<MeshFinding> validate_counts(std::int64_t vertices, std::int64_t faces, std::int64_t corners);

}  // namespace limitcheck::data
