// SPDX-License-Identifier: MIT
// What a fan's centre costs, and what a tessellation leaves alone. [C19, C64]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "data/shapes.h"
#include "data/splitmix64.h"
#include "fast/frame/crack_centre.h"
#include "reference/loop/refine.h"
#include "verify/host/host.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using V = fast::Vec3<double>;

TEST(Sec5_Centre, NeedsNoPointOfItsStepThatTheLimitPointsOfTheFirstBorderStepDoNotNeed) {
  RecordProperty("claim", "C64");
  double worst = 0;
  for (const auto& mesh : {data::icosahedron(), data::bumpy_sphere(200, 1)}) {
    const fast::Adjacency adjacency(mesh);
    const fast::PreparedMesh<double> prepared(adjacency, fast::positions_of<double>(mesh));
    const auto finer = reference::refine<double>(mesh, 1);
    for (std::int32_t f = 0; f < adjacency.face_count(); ++f) {
      // In the refined mesh: the three corners and three edge points of the face, and all that the limit
      // masks of the edge points reach.
      const auto face = static_cast<std::size_t>(f);
      std::set<std::int32_t> border, edge, needed;
      for (const auto& [i, j] : {std::pair{0, 0}, {2, 0}, {0, 2}}) border.insert(finer.vertex(face, i, j));
      for (const auto& [i, j] : {std::pair{1, 0}, {1, 1}, {0, 1}}) edge.insert(finer.vertex(face, i, j));
      for (const auto& t : finer.triangles())
        if (std::any_of(t.begin(), t.end(), [&](std::int32_t v) { return edge.contains(v); }))
          needed.insert(t.begin(), t.end());
      border.insert(edge.begin(), edge.end());
      ASSERT_EQ(border.size(), 6U);
      ASSERT_EQ(needed.size(), 12U) << "3 + 3 border points and 6 for their masks, none for the centre alone";
      ASSERT_TRUE(std::includes(needed.begin(), needed.end(), border.begin(), border.end()));

      // They are the twelve points that the centre is made of, each once.
      std::vector<V> storage(3 * static_cast<std::size_t>(adjacency.max_valence()));
      std::array<V, 3> corner;
      std::array<fast::CornerRing<double, fast::SurfaceVertex<double>>, 3> rings;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto h = 3 * f + static_cast<std::int32_t>(k);
        corner[k] = prepared.position(adjacency.origin(h));
        rings[k] = fast::gather_corner(prepared, h, false, storage.data() + k * storage.size() / 3);
      }
      std::set<std::int32_t> used;
      for (const V& p : fast::twelve_points(corner, rings)) {
        double nearest = 1e300;
        std::int32_t which = -1;
        for (const std::int32_t v : needed) {
          const auto& q = finer.positions()[v];
          const double distance = std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
          if (distance < nearest) nearest = distance, which = v;
        }
        worst = std::max(worst, nearest);
        used.insert(which);
      }
      ASSERT_EQ(used, needed) << "face " << f;
    }
  }
  EXPECT_LE(worst, 1e-14);
}

TEST(Sec43_SlidingWindow, ReadsTheControlMeshAndNeverWritesIt) {
  RecordProperty("claim", "C19");
  for (const auto& mesh : {data::bumpy_sphere(200, 1), data::holes(), data::wheel(50)}) {
    for (const char* options : {"output=strips", "output=indexed,precision=double", "repair=stitch"}) {
      Session session(*lc_subject_sliding_window(), mesh, options);
      data::SplitMix64 random(1);
      for (const int threads : {1, 4}) {
        std::vector<std::int32_t> depth(mesh.faces.size());
        for (auto& d : depth) d = static_cast<std::int32_t>(random.next() % 6) - 1;
        // The host compares every byte of the mesh it lent with a copy of its own.
        const Tessellation tessellation = session.tessellate(depth, threads);
        EXPECT_GT(tessellation.triangle_count(), 0);
        EXPECT_TRUE(tessellation.defects().empty()) << options << ": " << tessellation.defects()[0].array;
      }
    }
  }
}

}  // namespace
}  // namespace limitcheck::verify
