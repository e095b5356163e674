// SPDX-License-Identifier: MIT
// What kind of place of a control mesh a point lies at, as far as the rules of subdivision tell places apart.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace limitcheck::verify {

/// From the most ordinary to the most special. A point on an edge counts to the more special of its faces.
enum class PlaceKind : std::uint8_t {
  kRegularFace,          // inside a face (or on its edges) none of whose vertices is any of those below
  kBoundaryFace,         // .. that touches the boundary
  kIrregularFace,        // .. at an extraordinary vertex, or no quad of Catmull-Clark's scheme
  kSharpFace,            // .. at a sharp edge or vertex
  kSharpEdge,            // on a sharp edge
  kRegularVertex,        // a control vertex inside the mesh, of valence 6 (Loop) or 4
  kExtraordinaryVertex,  // of any other valence
  kPolygonVertex,        // Catmull-Clark: inside the mesh, at a face that is no quad
  kBoundaryVertex,       // on the boundary
  kDart,                 // where one sharp edge ends
  kCrease,               // between two sharp edges
  kCorner                // three and more sharp edges, or a sharp vertex
};

/// How many of the points at one kind of place were wrong, of how many looked at.
///   faces   around the vertex, for kExtraordinaryVertex and kBoundaryVertex; otherwise 0
struct PlaceCount {
  PlaceKind kind = PlaceKind::kRegularFace;
  std::int32_t faces = 0;
  std::int64_t bad = 0, of = 0;
};

inline bool is_vertex(PlaceKind kind) {
  return kind >= PlaceKind::kRegularVertex;
}

/// "boundary-vertex": stable, for the report's JSON.
std::string_view word(PlaceKind kind);

/// Adds counts of one list to another; both are ascending by kind and faces.
void add(std::vector<PlaceCount>& to, const std::vector<PlaceCount>& counts);

/// Whether something is wrong inside regular faces.
bool is_everywhere(const std::vector<PlaceCount>& counts);

/// The places with something wrong, in words that follow "only": "at boundary vertices of 4 or more faces", and
/// that nothing regular was looked at, if so; empty if nothing is wrong. Where is_everywhere(): "everywhere, in
/// regular faces, too".
std::string where_wrong(const std::vector<PlaceCount>& counts);

}  // namespace limitcheck::verify
