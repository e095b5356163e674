// SPDX-License-Identifier: MIT
#include "fast/frame/patch_indices.h"

#include "fast/frame/quad_patch.h"

namespace limitcheck::fast {

namespace {

// The triangles between the rows of a block; at(row, column) is the index of a point.
template <class At>
void add_rows(const RowBlock& block, IndexForm form, At&& at, std::vector<std::uint32_t>& out) {
  for (int row = 0; row < block.k; ++row) {
    const int last = block.last(row), below = block.last(row + 1);
    if (form == IndexForm::kStrips) {
      for (int c = 0; c <= below; ++c) out.insert(out.end(), {at(row, c), at(row + 1, c)});
      if (below < last) out.push_back(at(row, last));
      out.push_back(kRestartIndex);
      continue;
    }
    for (int c = 0; c < last; ++c) {
      out.insert(out.end(), {at(row, c), at(row + 1, c), at(row, c + 1)});
      if (c < below) out.insert(out.end(), {at(row, c + 1), at(row + 1, c), at(row + 1, c + 1)});
    }
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

IndexPattern PatchIndices::strips(const ShownFace& shown, int depth, IndexForm form,
                                  std::vector<std::uint32_t>& out) {
  const RowBlock block = shown.block();
  const auto of_form = static_cast<std::size_t>(form);
  const auto add = [&](const RowBlock& rows, auto&& at) {
    add_rows(rows, form, at, out);
    return static_cast<std::int32_t>(rows.strips().triangles);
  };
  if (shown.both_halves) {
    return once(grids_[depth][of_form], out, [&] {
      const int k = block.k;
      return add({k, true}, [&](int r, int c) { return block.at(r, c); }) +
             add({k, true}, [&](int r, int c) { return block.at(k - r, k - c); });
    });
  }
  auto& known =
      block.triangle ? halves_[depth][of_form] : quads_[{shown.parts, block.k, static_cast<int>(form)}];
  return once(known, out, [&] {
    std::int32_t triangles = 0;
    for (int part = 0; part < shown.parts; ++part)
      triangles += add(block, [&](int r, int c) { return part * block.size() + block.at(r, c); });
    return triangles;
  });
}

IndexPattern PatchIndices::fan(int border, std::vector<std::uint32_t>& out) {
  return once(at_least(fans_, border), out, [&] {
    const auto n = static_cast<std::uint32_t>(border);
    for (std::uint32_t t = 1; t <= n; ++t) out.insert(out.end(), {0, t, t == n ? 1 : t + 1});
    return border;
  });
}

IndexPattern PatchIndices::corners(int sides, std::vector<std::uint32_t>& out) {
  return once(at_least(corners_, sides), out, [&] {
    for (std::uint32_t k = 1; k + 1 < static_cast<std::uint32_t>(sides); ++k)
      out.insert(out.end(), {0, k, k + 1});
    return sides - 2;
  });
}

template <class Patch, class Faces>
IndexPattern PatchIndices::stitched(const Patch& patch, int s, const Faces& faces, const CrackPlan& plan,
                                    std::vector<std::uint32_t>& out) {
  const ShownFace shown = patch.shown(s);
  const FaceInRepair<Faces> face{faces, plan, shown.face};
  std::vector<int> key{patch.depth, patch.edge_of(s)};
  for (int side = 0; side < face.sides(); ++side) key.push_back(face.depth(side));
  return once(stitched_[key], out, [&] {
    const auto index = [&](PatchPoint p) {
      return (p.part - Patch::first_part(s)) * shown.block().size() + shown.block().at(p.row, p.column);
    };
    const PatchPoint first = shown.first_inner(0);
    for (int part = Patch::first_part(s), k = 0; k < shown.parts; ++part, ++k)
      add_rows(
          shown.inner(), IndexForm::kTriangles,
          [&](int r, int c) {
            return index({part, first.row + r, first.column + c});
          },
          out);
    const auto inner = [&](int side, int t) { return index(patch.beside(faces, s, side, t)); };
    return static_cast<std::int32_t>(shown.parts * shown.inner().strips().triangles) +
           add_ring(face, patch.depth, shown.parts * shown.block().size(), inner, out);
  });
}

template IndexPattern PatchIndices::stitched(const LoopPatch&, int, const LoopFaces&, const CrackPlan&,
                                             std::vector<std::uint32_t>&);
template IndexPattern PatchIndices::stitched(const QuadPatch&, int, const QuadFaces&, const CrackPlan&,
                                             std::vector<std::uint32_t>&);

}  // namespace limitcheck::fast
