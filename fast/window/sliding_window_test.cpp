// SPDX-License-Identifier: MIT
#include "fast/window/sliding_window.h"

#include <gtest/gtest.h>

#include "fast/test_support/global_refinement.h"
#include "fast/test_support/test_meshes.h"

namespace limitcheck::fast {
namespace {

/// (row, column) of the window as a point of the face left of half-edge h0 (upper left) or of its twin h1.
LatticePoint lattice_of(std::int32_t h0, std::int32_t h1, int k, int row, int column, bool upper) {
  std::uint32_t weight[3];
  const int edge = upper ? h0 % 3 : h1 % 3;
  if (upper) {  // h0 runs corner0 -> corner2, then corner3
    weight[edge] = row;
    weight[(edge + 1) % 3] = column;
    weight[(edge + 2) % 3] = k - row - column;
  } else {  // h1 runs corner2 -> corner0, then corner1
    weight[edge] = k - row;
    weight[(edge + 1) % 3] = k - column;
    weight[(edge + 2) % 3] = row + column - k;
  }
  return {(upper ? h0 : h1) / 3, weight[1], weight[2], static_cast<std::uint32_t>(k)};
}

struct Worst {
  long double position = 0, normal = 0;
};

template <class N>
Worst compare(const data::ControlMesh& mesh, int depth) {
  const Adjacency adjacency(mesh);
  const PreparedMesh<N> prepared(adjacency, positions_of<N>(mesh));
  SlidingWindow<N> window(depth, adjacency.max_valence());
  const RefinedMesh refined = RefinedMesh::of(mesh, depth);
  const int k = 1 << depth;
  Worst worst;
  for (std::int32_t h = 0; h < 3 * adjacency.face_count(); ++h) {
    const std::int32_t twin = adjacency.twin(h);
    if (twin < 0) continue;
    int expected_row = 0;
    window.run(prepared, h, depth, [&](int row, const SurfaceVertex<N>* strip) {
      EXPECT_EQ(row, expected_row++);
      for (int i = 0; i <= k; ++i) {
        for (int below = 0; below < 2; ++below) {
          const int r = row + below;
          const bool upper = r + i <= k;
          const auto expected = refined.limit(lattice_of(h, twin, k, r, i, upper));
          const auto& got = strip[2 * i + below];
          const Point p{got.position.x, got.position.y, got.position.z};
          const Point n{got.normal.x, got.normal.y, got.normal.z};
          worst.position = std::max(worst.position, norm(p - expected.position));
          worst.normal = std::max(worst.normal, norm(n - expected.normal));
        }
      }
    });
    EXPECT_EQ(expected_row, k);
  }
  return worst;
}

struct Shape {
  const char* name;
  data::ControlMesh mesh;
};

std::vector<Shape> shapes() {
  return {{"tetrahedron", tetrahedron()},
          {"octahedron", octahedron()},
          {"bipyramid 3", bipyramid(3)},
          {"bipyramid 7", bipyramid(7)},
          {"torus", grid_torus(3, 4)},
          {"bipyramid 60", bipyramid(60)},
          {"sheet", grid_sheet(2, 3)},
          {"wheel 3", wheel(3, .5)},
          {"wheel 5", wheel(5, .3)},
          {"fan 2", fan(2)},
          {"fan 3", fan(3)},
          {"fan 5", fan(5)}};
}

TEST(Sec4_SlidingWindow, EqualsTheMeshRefinedAsAWhole) {
  for (const auto& [name, mesh] : shapes()) {
    for (int depth = 0; depth <= (mesh.faces.size() > 50 ? 2 : 4); ++depth) {
      const Worst worst = compare<double>(mesh, depth);
      EXPECT_LE(worst.position, 1e-14L) << name << " depth " << depth;
      EXPECT_LE(worst.normal, 1e-12L) << name << " depth " << depth;
    }
  }
}

}  // namespace
}  // namespace limitcheck::fast
