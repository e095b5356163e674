// SPDX-License-Identifier: MIT
// The control faces of either scheme: their sides, where points lie on them, and the quads that each of those of
// Catmull-Clark's consists of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "data/faces.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/plan/pairing.h"

namespace limitcheck::fast {

/// The control faces of Loop's scheme, by the names of QuadFaces: side 3 f + k is half-edge k of face f. Refers to the
/// adjacency.
struct LoopFaces {
  /// Along a side of a lattice of k cells the row next to it has k - kRowIsShorter inner edges: see stitch_rows().
  static constexpr int kRowIsShorter = 3;

  int size() const { return adjacency->face_count(); }
  int vertex_count() const { return adjacency->vertex_count(); }
  static int sides(std::int32_t /*f*/) { return 3; }
  static std::int32_t first_side(std::int32_t f) { return 3 * f; }
  static std::int32_t face_of(std::int32_t c) { return c / 3; }
  static std::int32_t next(std::int32_t c) { return Adjacency::next(c); }
  std::int32_t twin(std::int32_t c) const { return adjacency->twin(c); }
  /// The face on the other side, of a cut too; -1 at a boundary.
  std::int32_t across(std::int32_t c) const {
    return mesh != nullptr ? mesh->across(c) : twin(c) < 0 ? -1 : face_of(twin(c));
  }
  std::int32_t vertex(std::int32_t c) const { return adjacency->origin(c); }
  static LatticePoint corner(std::int32_t f, int k) { return {f, k == 1 ? 1u : 0u, k == 2 ? 1u : 0u, 1}; }
  static LatticePoint centre(std::int32_t f) { return {f, 1, 1, 3}; }
  static LatticePoint on_side(std::int32_t f, int side, int t, int count) {
    std::uint32_t w[3] = {};
    w[side] = static_cast<std::uint32_t>(count - t);
    w[(side + 1) % 3] = static_cast<std::uint32_t>(t);
    return {f, w[1], w[2], static_cast<std::uint32_t>(count)};
  }

  const Adjacency* adjacency;
  const TriangleMesh* mesh = nullptr;  // that of the adjacency, if it may be cut
};

/// A point of one of the parts of a face, in steps of the part's grid.
struct PartPoint {
  int part, i, j;
};

/// Control faces of any number of sides. Sides and corners are numbered through, one face after the other;
/// side c runs from corner c to the next. A face is a single quad, or it was cut by one step into as many
/// parts as it has corners, each a quad with its corner 0 there. Keeps a reference to the mesh, which must
/// outlive it.
struct QuadFaces {
  static constexpr int kRowIsShorter = 2;

  QuadFaces(const data::Faces& faces, const QuadMesh& mesh);

  int vertex_count() const { return mesh->adjacency.vertex_count(); }
  std::int32_t first_side(std::int32_t f) const { return static_cast<std::int32_t>(first[f]); }
  std::int32_t face_of(std::int32_t c) const { return face[c]; }
  int size() const { return static_cast<int>(first.size()) - 1; }
  int sides(std::int32_t f) const { return static_cast<int>(first[f + 1] - first[f]); }
  std::int32_t next(std::int32_t c) const {
    return c + 1 == first_side(face[c] + 1) ? first_side(face[c]) : c + 1;
  }
  /// The side on the other side; -1 at a boundary or, of twin(), at a cut.
  std::int32_t twin(std::int32_t c) const { return side_of(mesh->adjacency.twin(first_half(c))); }
  std::int32_t beyond(std::int32_t c) const {
    const std::int32_t t = twin(c);
    return t >= 0 || mesh->cut_twin.empty() ? t : side_of(mesh->cut_twin[first_half(c)]);
  }
  /// The face on the other side; -1 at a boundary.
  std::int32_t across(std::int32_t c) const { return beyond(c) < 0 ? -1 : face[beyond(c)]; }
  /// The vertex of the mesh of quads at a corner.
  std::int32_t vertex(std::int32_t c) const { return mesh->adjacency.origin(first_half(c)); }
  /// The half-edges that a side consists of: one, or two of half its length.
  std::int32_t first_half(std::int32_t c) const { return cut() ? 4 * c : c; }
  std::int32_t second_half(std::int32_t c) const { return 4 * next(c) + 3; }

  bool cut() const { return mesh->steps == 1; }
  int parts(std::int32_t f) const { return cut() ? sides(f) : 1; }
  std::int32_t quad(std::int32_t f, int part) const { return cut() ? first_side(f) + part : f; }
  /// Cells along a side of a part: 2^depth, or half of it.
  int part_size(int depth) const { return cut() ? (depth == 0 ? 0 : 1 << (depth - 1)) : 1 << depth; }

  /// Where things lie.
  LatticePoint lattice(std::int32_t f, int depth, PartPoint p) const;
  LatticePoint corner(std::int32_t f, int k) const;
  LatticePoint on_side(std::int32_t f, int side, int t, int count) const;
  LatticePoint centre(std::int32_t f) const;
  /// Point t = 0 .. 2^depth - 2 of the row next to a side. Depth >= 2.
  PartPoint beside(std::int32_t f, int depth, int side, int t) const;

  std::vector<std::size_t> first;  // per face, and the number of all corners
  std::vector<std::int32_t> face;  // per corner
  const QuadMesh* mesh;

 private:
  /// The side that begins with the half-edge, or whose last part it is.
  std::int32_t side_of(std::int32_t h) const;
};

}  // namespace limitcheck::fast
