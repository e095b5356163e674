// SPDX-License-Identifier: MIT
// Writes the points of one control face of Catmull-Clark's scheme to its block of vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "fast/frame/draw_writer.h"
#include "fast/frame/patch_indices.h"
#include "fast/frame/patch_store.h"
#include "fast/frame/quad_patch.h"

namespace limitcheck::fast {

/// The block of a face: its parts (strips; the corners alone where it has none), its parts and the border
/// (stitched), or the centre and the border (fan).
inline std::int32_t quad_block_size(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan) {
  if (corners_only(patch, faces)) return faces.sides(patch.face);
  const auto border = static_cast<std::int32_t>(border_points(patch, faces, plan));
  if (patch.display == Display::kFan) return 1 + border;
  const std::int32_t parts = faces.parts(patch.face) * PartBlock{faces.part_size(patch.depth)}.size();
  return patch.display == Display::kStitch ? parts + border : parts;
}

inline PatchWanted wanted_quad_patch(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan) {
  PatchWanted wanted{{{patch.face, -1, -1, -1, patch.depth}, {patch.display}, {}},
                     quad_block_size(patch, faces, plan),
                     true};
  if (patch.display == Display::kStrips) return wanted;
  const std::size_t first = faces.first[patch.face], sides = faces.first[patch.face + 1] - first;
  wanted.comparable = sides <= PatchKey::kEdges;
  for (std::size_t s = 0; s < sides && wanted.comparable; ++s)
    wanted.key.edge_depth[s] = plan.edge_depth[first + s];
  return wanted;
}

inline PatchDraw quad_patch_draw(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan,
                                 std::int64_t base, IndexForm form, PatchIndices& patterns,
                                 std::vector<std::uint32_t>& indices) {
  const std::int32_t size = quad_block_size(patch, faces, plan);
  IndexPattern pattern;
  Kind kind = Kind::kPair;
  if (corners_only(patch, faces)) {
    pattern = patterns.corners(faces.sides(patch.face), indices);
    form = IndexForm::kTriangles;
  } else if (patch.display == Display::kStrips) {
    pattern = patterns.quads(faces.parts(patch.face), faces.part_size(patch.depth), form, indices);
  } else {
    kind = patch.display == Display::kFan ? Kind::kFan : Kind::kStitched;
    pattern =
        kind == Kind::kFan ? patterns.fan(size - 1, indices) : patterns.stitched(patch, faces, plan, indices);
    form = IndexForm::kTriangles;
  }
  return {base,
          pattern.first,
          pattern.count,
          size,
          pattern.triangles,
          pattern.triangles,
          patch.face,
          patch.face,
          form,
          kind,
          static_cast<std::int8_t>(patch.depth)};
}

/// As QuadDrawWriter: takes the strips and borders of a face.
template <class Real>
class QuadPatchWriter {
 public:
  using Vertex = SurfaceVertex<Real>;

  QuadPatchWriter(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan,
                  const Placement<Real>& placement, const PatchTarget<Real>& out)
      : patch_(patch),
        faces_(faces),
        plan_(plan),
        placement_(placement),
        out_(out),
        block_{faces.part_size(patch.depth)} {}

  /// Strips know where they go.
  void skip(std::int64_t /*strips*/) {}

  /// Where the points of a part lie, row by row from the top, each from right to left.
  Vertex* grid(int part) const { return out_.vertices + part * block_.size(); }

  template <class At>
  void strip(int part, int row, const At& at) {
    const int m = block_.cells;
    for (int below = 0; below <= (row + 1 == m ? 1 : 0); ++below) {
      const int j = m - row - below;
      std::uint32_t to = block_.at({part, m, j});
      if constexpr (std::is_same_v<At, RowPair<Real>>) {
        if (out_.provenance == nullptr && placement_.is_identity() && at.step == -1) {
          out_.put(to, &at(2 * m + below), static_cast<std::size_t>(m) + 1);
          continue;
        }
      }
      for (int i = m; i >= 0; --i) put(to++, at(2 * i + below), PartPoint{part, i, j});
    }
  }

  template <class Limit>
  void corners(Limit&& limit) {
    for (int k = 0; k < faces_.sides(patch_.face); ++k)
      put(static_cast<std::uint32_t>(k), limit(k), faces_.corner(patch_.face, k));
  }

  void fan(const Vertex& centre, const QuadBorder<Real>& border) {
    put(0, centre, faces_.centre(patch_.face));
    put_border(border, 1);
  }

  void stitch(const FacePoints<Real>& points, const QuadBorder<Real>& border) {
    const int parts = faces_.parts(patch_.face), m = block_.cells;
    for (int part = 0; part < parts; ++part)
      for (int j = m; j >= 0; --j)
        for (int i = m; i >= 0; --i) {
          const PartPoint p{part, i, j};
          put(block_.at(p), points.at(p), p);
        }
    put_border(border, static_cast<std::uint32_t>(parts * block_.size()));
  }

 private:
  void put_border(const QuadBorder<Real>& border, std::uint32_t at) {
    for (int side = 0; side < faces_.sides(patch_.face); ++side) {
      const int count = 1 << plan_.edge_depth[faces_.first[patch_.face] + static_cast<std::size_t>(side)];
      for (int t = 0; t < count; ++t) put(at++, border[side][t], faces_.on_side(patch_.face, side, t, count));
    }
  }
  void put(std::uint32_t at, const Vertex& v, PartPoint p) {
    if (out_.provenance != nullptr) return put(at, v, faces_.lattice(patch_.face, patch_.depth, p));
    put(at, v, LatticePoint{});
  }
  void put(std::uint32_t at, const Vertex& v, const LatticePoint& lattice) {
    out_.put(at, placement_.is_identity() ? v : placed(v, placement_));
    if (out_.provenance != nullptr) out_.provenance[at] = lattice;
  }

  const QuadPatch& patch_;
  const QuadFaces& faces_;
  const CrackPlan& plan_;
  const Placement<Real>& placement_;
  const PatchTarget<Real> out_;
  PartBlock block_;
};

}  // namespace limitcheck::fast
