// SPDX-License-Identifier: MIT
// The kinds of neighbourhood that an audit looks at, and those that there are: what "held" is said of.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/scheme.h"
#include "verify/evidence/audit_case.h"
#include "verify/subject/lattice.h"

namespace limitcheck::verify {

/// The relations are looked at on meshes of at most this size, in faces of four corners (audit/audit.h).
inline constexpr std::size_t kRelationFaces = 200;
inline std::size_t size_for_relations(const data::ControlMesh& mesh) {
  return std::max(mesh.faces.size(), mesh.faces.corners().size() / 4);
}

/// What tells the neighbourhoods of a control vertex apart: the rules of subdivision see no more of it.
enum class Axis : std::uint8_t {
  kSide,        ///< inside or on the boundary
  kInfinite,    ///< how many of its edges are sharp for ever; those of the boundary do not count
  kSemi,        ///< how many are sharp for some steps
  kOwn,         ///< its own sharpness: none, finite, infinite
  kFaces,       ///< how many there are around it
  kSharpness,   ///< of its edges
  kAround,      ///< what lies at the other ends of its edges
  kCreasing,    ///< of semi-sharp edges
  kBoundary,    ///< whether boundary vertices of one face are held
  kTriangles,   ///< the rule for triangles of Catmull-Clark's first step
  kCorners,     ///< of its faces; Catmull-Clark
  kDepth,       ///< of its faces
  kNeighbour,   ///< how much the depths of its faces differ, and whether some are culled
  kOwnClass,    ///< the class of its own sharpness
  kVertex,      ///< kSide, kInfinite, kSemi and kOwn in one
  kFan,         ///< kSide and kFaces in one
  kIndex,       ///< how large its index is
  kTags,        ///< how many the mesh has
  kComponents,  ///< .. of the mesh
  kGenus,
  kAsked  ///< whether the relations (verify/relations) are looked at, too
};
inline constexpr std::size_t kAxes = static_cast<std::size_t>(Axis::kAsked) + 1;

/// One value on one axis.
///   needs   LC_SHARP_...: what a subject has to do to be asked; kNeedsBoundary .. beyond
struct Feature {
  Axis axis;
  std::string name;
  std::int32_t needs = 0;
};
inline constexpr std::int32_t kNeedsBoundary = 1 << 20, kNeedsDepths = 1 << 21;
inline constexpr std::int32_t kNeedsOtherFaces = 1 << 23;  // than quads, by Catmull-Clark
inline constexpr std::int32_t kNeedsRelations = 1 << 22;   // not of the subject, but of the audit's level

/// All of them, axis by axis.
const std::vector<Feature>& features();
/// The axis of a feature, and which value on it: the k-th class of sharpness, so many edges, ..
std::pair<Axis, std::size_t> on_axis(std::size_t feature);
/// The feature that is value k on an axis.
std::size_t feature_on(Axis axis, std::size_t k);
/// What a value on the axis kVertex says; the largest numbers mean "and more". `own` as on its axis.
inline constexpr int kInfiniteEdges = 5, kSemiEdges = 3;
struct VertexTags {
  bool boundary;
  int infinite, semi, own;
  std::size_t feature() const;
};
VertexTags vertex_tags(std::size_t k);
/// What a value on the axis kFan says: the class of the number of faces, and on which side. Inside there is none of
/// fewer than three faces.
struct Fan {
  bool boundary;
  std::size_t size_class;
  std::optional<std::size_t> feature() const;
};
Fan fan(std::size_t k);
/// The least number of faces of class k < kSizeClasses, or of corners of class k - 2; and the class of a number.
inline constexpr std::size_t kSizeClasses = 22;
int least_of(std::size_t size_class);
std::size_t size_class_of(std::int64_t count);
/// What the classes on the axes kIndex and kTags go up to; and the axis kNeighbour: depths that differ by 0 .. 3, culled.
inline constexpr std::array<std::int64_t, 4> kIndexes{255, 32767, 65535, INT32_MAX},
    kTagCounts{0, 12, 100, 255};
inline constexpr int kDepthClasses = 8, kMostDifference = 3, kMostGenus = 3;
/// Values on the axes kAround and kCreasing.
inline constexpr std::size_t kBetweenCreases = 4, kWeakBetweenStrong = 5, kUnequal = 2;

/// The faces of a control vertex, its edges (Lattice::edges()), and the tags there.
struct ControlVertex {
  bool boundary = false;
  int infinite = 0, semi = 0;  // edges that are sharp for ever, and for some steps; not those of the boundary
  float own = 0;
  std::vector<std::size_t> edges;
  std::vector<std::int32_t> faces;
  bool sharp() const { return own > 0 || infinite + semi > 0; }
};
/// All of a mesh, and the sharpness of each edge; 0 on the boundary.                                 O(faces)
struct ControlVertices {
  explicit ControlVertices(const Lattice& lattice);
  std::vector<ControlVertex> all;
  std::vector<float> sharpness;
};

/// The features of the control vertices that have a displayed face, each list once and ascending. On some axes a vertex has
/// several: edges of several sharpnesses.                                                         O(faces)
std::vector<std::vector<std::uint16_t>> neighbourhoods(const AuditMesh& mesh);

/// A feature, or two of one neighbourhood (first < second).
struct Cell {
  std::size_t first, second;   ///< the same: one feature
  std::string name() const;    ///< "inside", "1 face, depth 3"
  std::int32_t needs() const;  ///< LC_SHARP_.. as in Feature
};
/// Those that a subject of the scheme can meet, within what an audit without meshes takes on: many faces, or
/// corners, are combined with small depths only.
const std::vector<Cell>& cells(data::Scheme scheme);

/// A set of the cells of a scheme: element k is whether cells(scheme)[k] is in it.
using CellSet = std::vector<bool>;
CellSet cells_of(const AuditMesh& mesh);
/// Adds all of another set.
void add_cells(CellSet& to, const CellSet& from);
/// Adds those of one neighbourhood.
void add_cells(CellSet& to, const std::vector<std::uint16_t>& features, data::Scheme scheme);
/// Hexadecimal digits, four cells each.
std::string text_of(const CellSet& set);
CellSet cell_set(const std::string& text, data::Scheme scheme);

}  // namespace limitcheck::verify
