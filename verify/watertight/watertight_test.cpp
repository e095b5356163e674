// SPDX-License-Identifier: MIT
#include "verify/watertight/watertight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace limitcheck::verify {
namespace {

using Triangles = std::vector<std::array<std::int32_t, 3>>;

const Triangles kTetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

// With a closed surface apart, so many triangles at either apex that CGAL's mesh is put together in another
// way.
Triangles with_hubs(std::int32_t points, Triangles triangles) {
  constexpr std::int32_t kCount = 1100;
  const std::int32_t top = points, bottom = points + 1, first = points + 2;
  for (std::int32_t i = 0; i < kCount; ++i) {
    const std::int32_t a = first + i, b = first + (i + 1) % kCount;
    triangles.push_back({a, b, top});
    triangles.push_back({b, a, bottom});
  }
  return triangles;
}

// Both methods are asked, and must agree on manifold and closed; the report of ours is returned.
SurfaceReport look(std::int64_t points, const Triangles& triangles) {
  const SurfaceReport report = inspect_surface(points, triangles);
  const SurfaceJudgement judgement = judge_surface(points, triangles);
  EXPECT_EQ(report.manifold(), judgement.manifold());
  if (report.manifold()) {
    EXPECT_EQ(report.closed(), judgement.closed);
    EXPECT_EQ(report.open_loops, judgement.boundary_cycles);
  }
  const auto known = static_cast<std::int32_t>(points);
  const SurfaceJudgement linked = judge_surface(points + 1102, with_hubs(known, triangles));
  EXPECT_EQ(linked.manifold(), judgement.manifold());
  if (report.manifold()) {
    EXPECT_EQ(linked.closed, judgement.closed);
    EXPECT_EQ(linked.boundary_cycles, judgement.boundary_cycles);
  }
  return report;
}

// A (rows x columns) grid on a torus or, open, on a plane.
Triangles grid(std::int32_t rows, std::int32_t columns, bool wrap) {
  Triangles out;
  const std::int32_t pitch = wrap ? columns : columns + 1;
  const auto at = [&](std::int32_t r, std::int32_t c) {
    return wrap ? (r % rows) * pitch + c % columns : r * pitch + c;
  };
  for (std::int32_t r = 0; r < rows; ++r)
    for (std::int32_t c = 0; c < columns; ++c) {
      out.push_back({at(r, c), at(r, c + 1), at(r + 1, c + 1)});
      out.push_back({at(r, c), at(r + 1, c + 1), at(r + 1, c)});
    }
  return out;
}

TEST(Merge, JoinsEqualCoordinatesOnlyAndNumbersByFirstAppearance) {
  const double tiny = std::nextafter(1.0, 2.0);
  const std::vector<double> p{1, 2, 3, tiny, 2, 3, 1, 2, 3, 3, 2, 1, tiny, 2, 3};
  const MergedPoints merged = merge_identical(std::span<const double>(p));
  EXPECT_EQ(merged.point_of, (std::vector<std::int32_t>{0, 1, 0, 2, 1}));
  EXPECT_EQ(merged.vertex_of, (std::vector<std::int32_t>{0, 1, 3}));
}

TEST(Merge, TakesMinusZeroForZeroAndNaNForNoPlace) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> p{0, 0, 1, -0.0F, 0, 1, nan, 0, 1, nan, 0, 1};
  const MergedPoints merged = merge_identical(std::span<const float>(p));
  EXPECT_EQ(merged.point_of, (std::vector<std::int32_t>{0, 0, -1, -1}));
}

Triangles with(Triangles triangles, const Triangles& more) {
  triangles.insert(triangles.end(), more.begin(), more.end());
  return triangles;
}

TEST(Surface, IsClosedOrHasItsFaultsCounted) {
  Triangles ring = grid(2, 8, true), flipped = kTetrahedron, other = kTetrahedron;
  ring.resize(16);  // one row of the torus
  std::swap(flipped[2][0], flipped[2][1]);
  for (auto& triangle : other)
    for (std::int32_t& p : triangle) p += p == 3 ? 0 : 4;  // over 4, 5, 6 and the same apex 3
  struct {
    const char* what;
    std::int64_t points;
    Triangles triangles;
    std::int64_t open_edges, loops, clashing, duplicate, crowded, degenerate, bow_ties;
  } const all[]{{"a tetrahedron", 4, kTetrahedron, 0, 0, 0, 0, 0, 0, 0},
                {"a triangle less", 4, {kTetrahedron.begin(), kTetrahedron.end() - 1}, 3, 1, 0, 0, 0, 0, 0},
                {"an annulus", 16, ring, 16, 2, 0, 0, 0, 0, 0},
                {"a flipped triangle", 4, flipped, 0, 0, 3, 0, 0, 0, 0},
                {"a triangle twice", 4, with(kTetrahedron, {{1, 3, 0}}), 0, 0, 0, 1, 3, 0, 0},
                {"lines", 4, with(kTetrahedron, {{1, 1, 0}, {1, -1, 0}}), 0, 0, 0, 0, 0, 2, 0},
                {"three at an edge", 5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 6, -1, 0, 0, 1, 0, 0},
                {"two cones at a point", 7, with(kTetrahedron, other), 0, 0, 0, 0, 0, 0, 1},
                {"two triangles at a point", 5, {{0, 1, 2}, {0, 3, 4}}, 6, -1, 0, 0, 0, 0, 1}};
  for (const auto& of : all) {
    const SurfaceReport r = look(of.points, of.triangles);
    EXPECT_EQ(std::ssize(r.open_edges), of.open_edges) << of.what;
    EXPECT_EQ(r.open_loops, of.loops) << of.what;
    EXPECT_EQ(r.clashing_edges, of.clashing) << of.what;
    EXPECT_EQ(r.duplicate_triangles, of.duplicate) << of.what;
    EXPECT_EQ(r.crowded_edges, of.crowded) << of.what;
    EXPECT_EQ(r.degenerate_triangles, of.degenerate) << of.what;
    EXPECT_EQ(r.bow_tie_points, of.bow_ties) << of.what;
    EXPECT_EQ(r.manifold(), of.clashing + of.duplicate + of.crowded + of.degenerate + of.bow_ties == 0)
        << of.what;
    EXPECT_EQ(r.closed(), r.manifold() && of.open_edges == 0) << of.what;
    EXPECT_EQ(r.duplicate_witness, std::vector<std::int32_t>(of.duplicate, 4));
    EXPECT_EQ(r.bow_tie_witness, std::vector<std::int32_t>(of.bow_ties, of.points == 7 ? 3 : 0));
  }
  EXPECT_EQ(look(4, kTetrahedron).edges, 6);
  const SurfaceReport book = look(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  ASSERT_EQ(book.crowded_witness.size(), 1U);
  EXPECT_EQ(book.crowded_witness[0].from, 0);
  EXPECT_EQ(book.crowded_witness[0].to, 1);
}

TEST(Surface, ATVertexIsFoundExactly) {
  // Square 0 1 2 3; the lower side is split at 4 by a triangle outside and not by the one inside.
  const std::vector<double> p{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.25, 0, 0, 0.5, -1, 0};
  const Triangles t{{0, 1, 2}, {0, 2, 3}, {0, 5, 4}, {4, 5, 1}};
  const MergedPoints merged = merge_identical(std::span<const double>(p));
  const SurfaceReport r = inspect_surface(6, t);
  std::vector<TVertex> found = find_t_vertices(p, merged.vertex_of, r.open_edges);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].point, 4);
  EXPECT_EQ(r.open_edges[found[0].edge].from, 0);
  EXPECT_EQ(r.open_edges[found[0].edge].to, 1);

  std::vector<double> moved = p;  // one ulp off the edge: a crack, and no T-vertex
  moved[13] = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(find_t_vertices(moved, merged.vertex_of, r.open_edges).empty());
}

TEST(Surface, ABigTorusIsClosedByBothMethods) {
  const Triangles t = grid(256, 512, true);
  const SurfaceReport r = look(256 * 512, t);
  EXPECT_TRUE(r.closed());
  EXPECT_EQ(r.edges, 3 * 256 * 512);
}

}  // namespace
}  // namespace limitcheck::verify
