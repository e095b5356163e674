// SPDX-License-Identifier: MIT
// Writes the points of one patch of either scheme to its block of vertices; what a patch wants of such a block, and the
// calls that draw it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "fast/frame/draw_writer.h"
#include "fast/frame/patch_indices.h"
#include "fast/frame/patch_store.h"

namespace limitcheck::fast {

/// The blocks of a patch, one after the other: a GridBlock if it is displayed as a whole; else of each half a
/// HalfBlock (strips), a HalfBlock and the border (stitched), or the centre and the border (fan).
inline std::int32_t half_block_size(const LoopPatch& patch, int side, const LoopFaces& faces,
                                    const CrackPlan& plan) {
  const Half& half = patch.half[side];
  const FaceInRepair<LoopFaces> face{faces, plan, half.face};
  switch (half.display) {
    case Display::kStrips:
      return HalfBlock{1 << patch.depth}.size();
    case Display::kStitch:
      return HalfBlock{1 << patch.depth}.size() + face.border();
    case Display::kFan:
      return 1 + face.border();
    default:
      return 0;
  }
}
inline std::int32_t block_size(const LoopPatch& patch, const LoopFaces& faces, const CrackPlan& plan) {
  return patch.full() ? GridBlock{1 << patch.depth}.size()
                      : half_block_size(patch, 0, faces, plan) + half_block_size(patch, 1, faces, plan);
}
/// The block of a face: its parts (strips; the corners alone where it has none), its parts and the border
/// (stitched), or the centre and the border (fan).
inline std::int32_t block_size(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan) {
  if (corners_only(patch, faces)) return faces.sides(patch.face);
  const std::int32_t border = FaceInRepair<QuadFaces>{faces, plan, patch.face}.border();
  if (patch.display == Display::kFan) return 1 + border;
  const std::int32_t parts = faces.parts(patch.face) * PartBlock{faces.part_size(patch.depth)}.size();
  return patch.display == Display::kStitch ? parts + border : parts;
}

inline PatchWanted wanted_patch(const Grid& grid, const LoopPatch& patch, const LoopFaces& faces,
                                const CrackPlan& plan) {
  PatchWanted wanted{
      {grid, {patch.half[0].display, patch.half[1].display}, {}}, block_size(patch, faces, plan), true};
  for (int s = 0; s < 2; ++s)
    for (int e = 0; patch.half[s].repaired() && e < 3; ++e)
      wanted.key.edge_depth[static_cast<std::size_t>(3 * s + e)] =
          plan.edge_depth[3 * patch.half[s].face + e];
  return wanted;
}
inline PatchWanted wanted_patch(const Grid& grid, const QuadPatch& patch, const QuadFaces& faces,
                                const CrackPlan& plan) {
  PatchWanted wanted{{grid, {patch.display}, {}}, block_size(patch, faces, plan), true};
  if (patch.display == Display::kStrips) return wanted;
  const auto sides = static_cast<std::size_t>(faces.sides(patch.face));
  wanted.comparable = sides <= PatchKey::kEdges;
  for (std::size_t s = 0; s < sides && wanted.comparable; ++s)
    wanted.key.edge_depth[s] = plan.edge_depth[faces.first[patch.face] + s];
  return wanted;
}

/// Adds the calls that draw a patch whose block begins at vertex `base`.
inline void add_patch_draws(const LoopPatch& patch, const LoopFaces& faces, const CrackPlan& plan,
                            std::int64_t base, IndexForm form, PatchIndices& patterns,
                            std::vector<std::uint32_t>& indices, std::vector<PatchDraw>& out) {
  const auto depth = static_cast<std::int8_t>(patch.depth);
  const auto draw = [&](const IndexPattern& pattern, std::int32_t size, const Half& half, IndexForm of,
                        Kind kind) {
    out.push_back({base, pattern.first, pattern.count, size, pattern.triangles, pattern.triangles, half.face,
                   half.face, of, kind, depth});
    base += size;
  };
  if (patch.full()) {
    const IndexPattern pattern = patterns.grid(patch.depth, form, indices);
    draw(pattern, GridBlock{1 << patch.depth}.size(), patch.half[0], form, patch.kind);
    out.back().split = pattern.triangles / 2;
    out.back().face_after = patch.half[1].face;
    return;
  }
  for (int s = 0; s < 2; ++s) {
    const Half& half = patch.half[s];
    const std::int32_t size = half_block_size(patch, s, faces, plan);
    if (half.display == Display::kStrips)
      draw(patterns.half(patch.depth, form, indices), size, half, form, patch.kind);
    if (half.display == Display::kFan)
      draw(patterns.fan(size - 1, indices), size, half, IndexForm::kTriangles, Kind::kFan);
    if (half.display == Display::kStitch)
      draw(patterns.stitched(half, patch.depth, faces, plan, indices), size, half, IndexForm::kTriangles,
           Kind::kStitched);
  }
}
inline void add_patch_draws(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan,
                            std::int64_t base, IndexForm form, PatchIndices& patterns,
                            std::vector<std::uint32_t>& indices, std::vector<PatchDraw>& out) {
  const std::int32_t size = block_size(patch, faces, plan);
  IndexPattern pattern;
  Kind kind = Kind::kPair;
  if (patch.display != Display::kStrips || corners_only(patch, faces)) form = IndexForm::kTriangles;
  if (corners_only(patch, faces)) {
    pattern = patterns.corners(faces.sides(patch.face), indices);
  } else if (patch.display == Display::kStrips) {
    pattern = patterns.quads(faces.parts(patch.face), faces.part_size(patch.depth), form, indices);
  } else {
    kind = patch.display == Display::kFan ? Kind::kFan : Kind::kStitched;
    pattern =
        kind == Kind::kFan ? patterns.fan(size - 1, indices) : patterns.stitched(patch, faces, plan, indices);
  }
  out.push_back({base, pattern.first, pattern.count, size, pattern.triangles, pattern.triangles, patch.face,
                 patch.face, form, kind, static_cast<std::int8_t>(patch.depth)});
}

/// What the writers of both schemes do alike.
template <class Real>
class PatchOutput {
 public:
  using Vertex = SurfaceVertex<Real>;

 protected:
  PatchOutput(const Placement<Real>& placement, const PatchTarget<Real>& out)
      : placement_(placement), out_(out) {}

  template <class Lattice>
  void put(std::uint32_t at, const Vertex& vertex, Lattice&& lattice) {
    if (out_.provenance != nullptr) out_.provenance[at] = lattice();
    out_.put(at, placement_.is_identity() ? vertex : placed(vertex, placement_));
  }
  /// Columns 0 .. count - 1 of the upper or lower row of a strip, the last one first.
  template <class At, class Lattice>
  void put_row(const At& at, int below, int count, std::uint32_t first, Lattice&& lattice) {
    if constexpr (std::is_same_v<At, RowPair<Real>>) {
      if (out_.provenance == nullptr && placement_.is_identity() && at.step == -1)
        return out_.put(first, &at(2 * (count - 1) + below), static_cast<std::size_t>(count));
    }
    for (int c = count - 1; c >= 0; --c) put(first++, at(2 * c + below), [&] { return lattice(c); });
  }
  template <class Faces, class Border>
  void put_border(const FaceInRepair<Faces>& face, const Border& border, std::uint32_t first) {
    for (int side = 0; side < face.sides(); ++side)
      for (int t = 0, count = face.points(side); t < count; ++t)
        put(first++, border[side][t], [&] { return face.on_side(side, t); });
  }
  template <class Faces, class Border>
  void put_fan(const FaceInRepair<Faces>& face, const Vertex& centre, const Border& border,
               std::uint32_t first) {
    put(first, centre, [&] { return face.centre(); });
    put_border(face, border, first + 1);
  }

  const Placement<Real>& placement_;
  const PatchTarget<Real> out_;
};

/// As LoopDrawWriter: takes the rows and borders of a patch.
template <class Real>
class LoopPatchWriter : PatchOutput<Real> {
 public:
  using typename PatchOutput<Real>::Vertex;

  LoopPatchWriter(const LoopPatch& patch, const LoopFaces& faces, const CrackPlan& plan,
                  const Placement<Real>& placement, const PatchTarget<Real>& out)
      : PatchOutput<Real>(placement, out), patch_(patch), faces_(faces), plan_(plan), k_(1 << patch.depth) {}

  /// Where the points of a patch of two displayed faces lie, row by row from corner C.
  Vertex* grid() const { return this->out_.vertices; }

  template <class At>
  void whole_strip(int row, const At& at) {
    const auto lattice = [&](int r, int c) {
      return r + c <= k_ ? patch_.half[0].lattice(k_, r, c) : patch_.half[1].lattice(k_, k_ - r, k_ - c);
    };
    for (int below = 0; below <= (row + 1 == k_ ? 1 : 0); ++below)
      this->put_row(at, below, k_ + 1, GridBlock{k_}.at(row + below, k_),
                    [&](int c) { return lattice(row + below, c); });
  }

  template <class At>
  void half_strip(int side, int row, const At& at) {
    const Half& half = patch_.half[side];
    const std::uint32_t first = block(side);
    for (int below = 0; below <= (row + 1 == k_ ? 1 : 0); ++below) {
      const int last = k_ - row - below;
      this->put_row(at, below, last + 1, first + HalfBlock{k_}.at(row + below, last),
                    [&](int c) { return half.lattice(k_, row + below, c); });
    }
  }

  void fan(int side, const Vertex& centre, const Border<Real>& border) {
    this->put_fan(in_repair(side), centre, border, block(side));
  }
  void ring(int side, const Border<Real>& border) {
    this->put_border(in_repair(side), border, block(side) + static_cast<std::uint32_t>(HalfBlock{k_}.size()));
  }

 private:
  FaceInRepair<LoopFaces> in_repair(int side) const { return {faces_, plan_, patch_.half[side].face}; }
  std::uint32_t block(int side) const {
    return side == 0 ? 0 : static_cast<std::uint32_t>(half_block_size(patch_, 0, faces_, plan_));
  }

  const LoopPatch& patch_;
  const LoopFaces& faces_;
  const CrackPlan& plan_;
  int k_;
};

/// As QuadDrawWriter: takes the strips and borders of a face.
template <class Real>
class QuadPatchWriter : PatchOutput<Real> {
 public:
  using typename PatchOutput<Real>::Vertex;

  QuadPatchWriter(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan,
                  const Placement<Real>& placement, const PatchTarget<Real>& out)
      : PatchOutput<Real>(placement, out),
        patch_(patch),
        faces_(faces),
        plan_(plan),
        block_{faces.part_size(patch.depth)} {}

  /// Strips know where they go.
  void skip(std::int64_t /*strips*/) {}

  /// Where the points of a part lie, row by row from the top, each from right to left.
  Vertex* grid(int part) const { return this->out_.vertices + part * block_.size(); }

  template <class At>
  void strip(int part, int row, const At& at) {
    const int m = block_.cells;
    for (int below = 0; below <= (row + 1 == m ? 1 : 0); ++below) {
      const int j = m - row - below;
      this->put_row(at, below, m + 1, block_.at({part, m, j}), [&](int i) { return lattice({part, i, j}); });
    }
  }

  template <class Limit>
  void corners(Limit&& limit) {
    for (int k = 0; k < faces_.sides(patch_.face); ++k)
      this->put(static_cast<std::uint32_t>(k), limit(k), [&] { return faces_.corner(patch_.face, k); });
  }

  void fan(const Vertex& centre, const QuadBorder<Real>& border) {
    this->put_fan(in_repair(), centre, border, 0);
  }
  void stitch(const FacePoints<Real>& points, const QuadBorder<Real>& border) {
    const int parts = faces_.parts(patch_.face), m = block_.cells;
    for (int part = 0; part < parts; ++part)
      for (int j = m; j >= 0; --j)
        for (int i = m; i >= 0; --i) {
          const PartPoint p{part, i, j};
          this->put(block_.at(p), points.at(p), [&] { return lattice(p); });
        }
    this->put_border(in_repair(), border, static_cast<std::uint32_t>(parts * block_.size()));
  }

 private:
  FaceInRepair<QuadFaces> in_repair() const { return {faces_, plan_, patch_.face}; }
  LatticePoint lattice(PartPoint p) const { return faces_.lattice(patch_.face, patch_.depth, p); }

  const QuadPatch& patch_;
  const QuadFaces& faces_;
  const CrackPlan& plan_;
  PartBlock block_;
};

}  // namespace limitcheck::fast
