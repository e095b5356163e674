// SPDX-License-Identifier: MIT
#include "fast/frame/patch_indices.h"

#include "fast/frame/crack_stitch.h"
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

IndexPattern PatchIndices::stitched(int depth, int edge, const std::array<int, 3>& edge_depth,
                                    std::vector<std::uint32_t>& out) {
  return once(stitched_[{depth, edge, edge_depth[0], edge_depth[1], edge_depth[2]}], out, [&] {
    const int k = 1 << depth;
    const HalfBlock block{k};
    add_half(
        1, k - 3, IndexForm::kTriangles, [&](int r, int c) { return block.at(r, c); }, out);
    std::int32_t triangles = (k - 3) * (k - 3);
    std::array<std::uint32_t, 4> first{
        static_cast<std::uint32_t>(block.size())};  // of each edge, and the end
    for (std::size_t e = 0; e < 3; ++e) first[e + 1] = first[e] + (1u << edge_depth[e]);
    for (int e = 0; e < 3; ++e) {
      const auto point = [&](std::int64_t t, bool is_inner) {
        if (is_inner) {
          // weights k - t - 2, t + 1, 1 at corners e, e + 1, e + 2, in the half's frame
          const int w[3] = {k - static_cast<int>(t) - 2, static_cast<int>(t) + 1, 1};
          return block.at(w[(edge - e + 3) % 3], w[(edge - e + 4) % 3]);
        }
        const std::uint32_t at = first[e] + static_cast<std::uint32_t>(t);
        return at == first[3] ? first[0] : at;
      };
      stitch_edge(k, edge_depth[e],
                  [&](std::int64_t a, bool ai, std::int64_t b, bool bi, std::int64_t c, bool ci) {
                    out.insert(out.end(), {point(a, ai), point(b, bi), point(c, ci)});
                    ++triangles;
                  });
    }
    return triangles;
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
  const int sides = faces.sides(patch.face);
  std::vector<int> key{patch.depth};
  for (int s = 0; s < sides; ++s) key.push_back(plan.edge_depth[faces.first[patch.face] + s]);
  return once(stitched_faces_[key], out, [&] {
    const int parts = faces.parts(patch.face);
    const PartBlock block{faces.part_size(patch.depth)};
    const InnerCells inner(patch, faces);
    for (int part = 0; part < parts; ++part)
      for (int j = inner.to; j > inner.from; --j) add_cells(block, part, inner.from, inner.to, j, out);
    std::int32_t triangles = 2 * parts * inner.count() * inner.count();
    const auto border = static_cast<std::uint32_t>(parts * block.size());
    std::uint32_t first = border, points = 0;
    for (int s = 0; s < sides; ++s) points += 1u << key[static_cast<std::size_t>(s) + 1];
    for (int s = 0; s < sides; ++s) {
      const int depth = key[static_cast<std::size_t>(s) + 1];
      const auto point = [&](std::int64_t t, bool is_inner) {
        if (is_inner) return block.at(faces.beside(patch.face, patch.depth, s, static_cast<int>(t)));
        return border + (first - border + static_cast<std::uint32_t>(t)) % points;
      };
      stitch_side(1 << patch.depth, depth,
                  [&](std::int64_t a, bool ai, std::int64_t b, bool bi, std::int64_t c, bool ci) {
                    out.insert(out.end(), {point(a, ai), point(b, bi), point(c, ci)});
                    ++triangles;
                  });
      first += 1u << depth;
    }
    return triangles;
  });
}

}  // namespace limitcheck::fast
