// SPDX-License-Identifier: MIT
#include "fast/frame/patch_indices.h"

#include "fast/frame/quad_patch.h"

namespace limitcheck::fast {

namespace {

// The rows of a half from `from` on, `count` of them; at(row, column) is the index of a point.
template <class At>
void add_half(int from, int count, IndexForm form, At&& at, std::vector<std::uint32_t>& out) {
  for (int row = from; row < from + count; ++row) {
    const int end = from + count - (row - from);  // the last column of the row
    if (form == IndexForm::kStrips) {
      for (int c = from; c < end; ++c) out.insert(out.end(), {at(row, c), at(row + 1, c)});
      out.insert(out.end(), {at(row, end), kRestartIndex});
      continue;
    }
    for (int c = from; c < end; ++c) {
      out.insert(out.end(), {at(row, c), at(row + 1, c), at(row, c + 1)});
      if (c + 1 < end) out.insert(out.end(), {at(row, c + 1), at(row + 1, c), at(row + 1, c + 1)});
    }
  }
}

// The cells of a part between rows j and j - 1.
void add_cells(PartBlock block, int part, int from, int to, int j, std::vector<std::uint32_t>& out) {
  for (int i = from; i < to; ++i) {
    const std::uint32_t a = block.at({part, i, j}), b = block.at({part, i, j - 1}),
                        c = block.at({part, i + 1, j});
    out.insert(out.end(), {a, b, c, c, b, block.at({part, i + 1, j - 1})});
  }
}

// Appends a pattern unless it is known: make() returns the number of its triangles.
template <class Make>
const IndexPattern& once(IndexPattern& pattern, std::vector<std::uint32_t>& out, Make&& make) {
  if (pattern.count > 0) return pattern;
  pattern.first = static_cast<std::uint32_t>(out.size());
  pattern.triangles = make();
  pattern.count = static_cast<std::uint32_t>(out.size()) - pattern.first;
  return pattern;
}

IndexPattern& at_least(std::vector<IndexPattern>& list, int number) {
  const auto n = static_cast<std::size_t>(number);
  if (list.size() <= n) list.resize(n + 1);
  return list[n];
}

std::vector<int> stitched_key(int depth, int edge, const auto& face) {
  std::vector<int> key{depth, edge};
  for (int side = 0; side < face.sides(); ++side) key.push_back(face.depth(side));
  return key;
}

// The outer ring of a face whose border points begin with number `border`: inner(side, t) is the index of point t of the
// row next to a side. Returns the number of its triangles.
template <class Faces, class Inner>
std::int32_t add_ring(const FaceInRepair<Faces>& face, int depth, std::int32_t border, Inner&& inner,
                      std::vector<std::uint32_t>& out) {
  std::int64_t first = 0;
  for (int side = 0; side < face.sides(); ++side) {
    const auto point = [&](std::int64_t t, bool is_inner) {
      if (is_inner) return inner(side, static_cast<int>(t));
      return static_cast<std::uint32_t>(border + (first + t) % face.border());
    };
    face.stitch(1 << depth, side,
                [&](std::int64_t a, bool ai, std::int64_t b, bool bi, std::int64_t c, bool ci) {
                  out.insert(out.end(), {point(a, ai), point(b, bi), point(c, ci)});
                });
    first += face.points(side);
  }
  return static_cast<std::int32_t>(face.ring_triangles(std::int64_t{1} << depth));
}

}  // namespace

IndexPattern PatchIndices::grid(int depth, IndexForm form, std::vector<std::uint32_t>& out) {
  return once(grids_[depth][static_cast<std::size_t>(form)], out, [&] {
    const int k = 1 << depth;
    const GridBlock block{k};
    add_half(
        0, k, form, [&](int r, int c) { return block.at(r, c); }, out);
    add_half(
        0, k, form, [&](int r, int c) { return block.at(k - r, k - c); }, out);
    return 2 * k * k;
  });
}

IndexPattern PatchIndices::half(int depth, IndexForm form, std::vector<std::uint32_t>& out) {
  return once(halves_[depth][static_cast<std::size_t>(form)], out, [&] {
    const int k = 1 << depth;
    const HalfBlock block{k};
    add_half(
        0, k, form, [&](int r, int c) { return block.at(r, c); }, out);
    return k * k;
  });
}

IndexPattern PatchIndices::fan(int border, std::vector<std::uint32_t>& out) {
  return once(at_least(fans_, border), out, [&] {
    const auto n = static_cast<std::uint32_t>(border);
    for (std::uint32_t t = 1; t <= n; ++t) out.insert(out.end(), {0, t, t == n ? 1 : t + 1});
    return border;
  });
}

IndexPattern PatchIndices::stitched(const Half& half, int depth, const LoopFaces& faces,
                                    const CrackPlan& plan, std::vector<std::uint32_t>& out) {
  const FaceInRepair<LoopFaces> face{faces, plan, half.face};
  return once(stitched_[stitched_key(depth, half.edge, face)], out, [&] {
    const int k = 1 << depth;
    const HalfBlock block{k};
    add_half(
        1, k - 3, IndexForm::kTriangles, [&](int r, int c) { return block.at(r, c); }, out);
    const auto inner = [&](int e, int t) {
      const auto [row, column] = half.beside(k, e, t);
      return block.at(row, column);
    };
    return (k - 3) * (k - 3) + add_ring(face, depth, block.size(), inner, out);
  });
}

IndexPattern PatchIndices::quads(int parts, int cells, IndexForm form, std::vector<std::uint32_t>& out) {
  return once(quads_[{parts, cells, static_cast<int>(form)}], out, [&] {
    for (int part = 0; part < parts; ++part) {
      for (int j = cells; j > 0; --j) {
        if (form == IndexForm::kTriangles) {
          add_cells({cells}, part, 0, cells, j, out);
          continue;
        }
        for (int i = 0; i <= cells; ++i)
          for (const int row : {j, j - 1}) out.push_back(PartBlock{cells}.at({part, i, row}));
        out.push_back(kRestartIndex);
      }
    }
    return 2 * parts * cells * cells;
  });
}

IndexPattern PatchIndices::corners(int sides, std::vector<std::uint32_t>& out) {
  return once(at_least(corners_, sides), out, [&] {
    for (std::uint32_t k = 1; k + 1 < static_cast<std::uint32_t>(sides); ++k)
      out.insert(out.end(), {0, k, k + 1});
    return sides - 2;
  });
}

IndexPattern PatchIndices::stitched(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan,
                                    std::vector<std::uint32_t>& out) {
  const FaceInRepair<QuadFaces> face{faces, plan, patch.face};
  return once(stitched_[stitched_key(patch.depth, -1, face)], out, [&] {
    const int parts = faces.parts(patch.face);
    const PartBlock block{faces.part_size(patch.depth)};
    const InnerCells cells(patch, faces);
    for (int part = 0; part < parts; ++part)
      for (int j = cells.to; j > cells.from; --j) add_cells(block, part, cells.from, cells.to, j, out);
    const auto inner = [&](int side, int t) {
      return block.at(faces.beside(patch.face, patch.depth, side, t));
    };
    return 2 * parts * cells.count() * cells.count() +
           add_ring(face, patch.depth, parts * block.size(), inner, out);
  });
}

}  // namespace limitcheck::fast
