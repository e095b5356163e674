// SPDX-License-Identifier: MIT
// Writes the points of one patch of triangles to its block of vertices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "fast/frame/draw_writer.h"
#include "fast/frame/patch_indices.h"
#include "fast/frame/patch_store.h"

namespace limitcheck::fast {

/// The blocks of a patch, one after the other: a GridBlock if it is displayed as a whole; else of each half a
/// HalfBlock (strips), a HalfBlock and the border (stitched), or the centre and the border (fan).
inline std::int32_t border_size(const Half& half, const CrackPlan& plan) {
  std::int32_t border = 0;
  for (int e = 0; e < 3; ++e) border += 1 << edge_depth(plan, half.face, e);
  return border;
}
inline std::int32_t half_block_size(const Patch& patch, int side, const CrackPlan& plan) {
  const Half& half = patch.half[side];
  switch (half.display) {
    case Display::kStrips:
      return HalfBlock{1 << patch.depth}.size();
    case Display::kStitch:
      return HalfBlock{1 << patch.depth}.size() + border_size(half, plan);
    case Display::kFan:
      return 1 + border_size(half, plan);
    default:
      return 0;
  }
}
inline PatchWanted wanted_patch(const Grid& grid, const Patch& patch, const CrackPlan& plan) {
  PatchWanted wanted{{grid, {patch.half[0].display, patch.half[1].display}, {}}, 0, true};
  for (int s = 0; s < 2; ++s)
    for (int e = 0; patch.half[s].repaired() && e < 3; ++e)
      wanted.key.edge_depth[static_cast<std::size_t>(3 * s + e)] =
          static_cast<std::int8_t>(edge_depth(plan, patch.half[s].face, e));
  wanted.size = patch.full() ? GridBlock{1 << patch.depth}.size()
                             : half_block_size(patch, 0, plan) + half_block_size(patch, 1, plan);
  return wanted;
}

/// The calls that draw a patch whose block begins at vertex `base`.
template <class Add>
void add_patch_draws(const Patch& patch, const CrackPlan& plan, std::int64_t base, IndexForm form,
                     PatchIndices& patterns, std::vector<std::uint32_t>& indices, Add&& add) {
  const auto depth = static_cast<std::int8_t>(patch.depth);
  const auto draw = [&](const IndexPattern& pattern, std::int32_t size, const Half& half, IndexForm of,
                        Kind kind) {
    add(PatchDraw{base, pattern.first, pattern.count, size, pattern.triangles, pattern.triangles, half.face,
                  half.face, of, kind, depth});
    base += size;
  };
  if (patch.full()) {
    const IndexPattern pattern = patterns.grid(patch.depth, form, indices);
    return add(PatchDraw{base, pattern.first, pattern.count, GridBlock{1 << patch.depth}.size(),
                         pattern.triangles, pattern.triangles / 2, patch.half[0].face, patch.half[1].face,
                         form, patch.kind, depth});
  }
  for (int s = 0; s < 2; ++s) {
    const Half& half = patch.half[s];
    const std::int32_t size = half_block_size(patch, s, plan);
    if (half.display == Display::kStrips)
      draw(patterns.half(patch.depth, form, indices), size, half, form, patch.kind);
    if (half.display == Display::kFan)
      draw(patterns.fan(size - 1, indices), size, half, IndexForm::kTriangles, Kind::kFan);
    if (half.display == Display::kStitch) {
      std::array<int, 3> depths;
      for (int e = 0; e < 3; ++e) depths[static_cast<std::size_t>(e)] = edge_depth(plan, half.face, e);
      draw(patterns.stitched(patch.depth, half.edge, depths, indices), size, half, IndexForm::kTriangles,
           Kind::kStitched);
    }
  }
}

/// As DrawWriter: takes the rows and borders of a patch.
template <class Real>
class PatchWriter {
 public:
  using Vertex = SurfaceVertex<Real>;

  PatchWriter(const Patch& patch, const CrackPlan& plan, const Placement<Real>& placement,
              const PatchTarget<Real>& out)
      : patch_(patch), plan_(plan), placement_(placement), out_(out), k_(1 << patch.depth) {}

  /// Where the points of a patch of two displayed faces lie, row by row from corner C.
  Vertex* grid() const { return out_.vertices; }

  template <class At>
  void whole_strip(int row, const At& at) {
    const auto lattice = [&](int r, int c) {
      return r + c <= k_ ? patch_.half[0].lattice(k_, r, c) : patch_.half[1].lattice(k_, k_ - r, k_ - c);
    };
    for (int below = 0; below <= (row + 1 == k_ ? 1 : 0); ++below)
      put_row(at, below, k_ + 1, GridBlock{k_}.at(row + below, k_),
              [&](int c) { return lattice(row + below, c); });
  }

  template <class At>
  void half_strip(int side, int row, const At& at) {
    const Half& half = patch_.half[side];
    const std::uint32_t first = block(side);
    for (int below = 0; below <= (row + 1 == k_ ? 1 : 0); ++below) {
      const int last = k_ - row - below;
      put_row(at, below, last + 1, first + HalfBlock{k_}.at(row + below, last),
              [&](int c) { return half.lattice(k_, row + below, c); });
    }
  }

  void fan(int side, const Vertex& centre, const Border<Real>& border) {
    const Half& half = patch_.half[side];
    std::uint32_t at = block(side);
    put(at, centre, [&] { return LatticePoint{half.face, 1, 1, 3}; });
    put_border(half, border, at + 1);
  }

  void ring(int side, const Border<Real>& border) {
    put_border(patch_.half[side], border, block(side) + static_cast<std::uint32_t>(HalfBlock{k_}.size()));
  }

 private:
  std::uint32_t block(int side) const {
    return side == 0 ? 0 : static_cast<std::uint32_t>(half_block_size(patch_, 0, plan_));
  }

  /// Columns 0 .. count - 1 of one of a strip's rows, the last one first.
  template <class At, class Lattice>
  void put_row(const At& at, int below, int count, std::uint32_t first, Lattice&& lattice) {
    if constexpr (std::is_same_v<At, RowPair<Real>>) {
      if (out_.provenance == nullptr && placement_.is_identity() && at.step == -1)
        return out_.put(first, &at(2 * (count - 1) + below), static_cast<std::size_t>(count));
    }
    for (int c = count - 1; c >= 0; --c) put(first++, at(2 * c + below), [&] { return lattice(c); });
  }

  void put_border(const Half& half, const Border<Real>& border, std::uint32_t first) {
    for (int e = 0; e < 3; ++e) {
      const int count = 1 << edge_depth(plan_, half.face, e);
      for (int t = 0; t < count; ++t)
        put(first++, border[e][t], [&] { return lattice_on_edge(half.face, e, t, count); });
    }
  }

  template <class Lattice>
  void put(std::uint32_t at, const Vertex& vertex, Lattice&& lattice) {
    if (out_.provenance != nullptr) out_.provenance[at] = lattice();
    out_.put(at, placement_.is_identity() ? vertex : placed(vertex, placement_));
  }

  const Patch& patch_;
  const CrackPlan& plan_;
  const Placement<Real>& placement_;
  const PatchTarget<Real> out_;
  int k_;
};

}  // namespace limitcheck::fast
