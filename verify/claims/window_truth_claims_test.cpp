// SPDX-License-Identifier: MIT
// The engine against the exact evaluator: every shape, valence, boundary and depth. [C19, C52, D1, D2, D11]
// What a fan's centre costs, and what a tessellation leaves alone. [C19, C64]
#include <gtest/gtest.h>

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "data/bounding_box.h"
#include "data/generators/bumpy_sphere.h"
#include "data/shapes.h"
#include "data/splitmix64.h"
#include "fast/frame/crack_centre.h"
#include "fast/window/tessellator.h"
#include "reference/loop/refine.h"
#include "reference/loop/stam.h"
#include "verify/claims/test_support/figures.h"
#include "verify/host/host.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

struct Shape {
  std::string name;
  data::ControlMesh mesh;
};

std::vector<Shape> shapes() {
  std::vector<Shape> all{{"tetrahedron", data::tetrahedron()},
                         {"octahedron", data::octahedron()},
                         {"icosahedron", data::icosahedron()},
                         {"torus", data::torus(6, 8)},
                         {"bumpy 200", data::bumpy_sphere(200, 1)},
                         {"triangle", data::triangle()},
                         {"triangle pair", data::triangle_pair()},
                         {"strip", data::strip(6)},
                         {"sheet", data::sheet(3, 3)},
                         {"holes", data::holes()},
                         {"ragged disc", data::ragged_disc()},
                         {"two components", data::two_components()}};
  for (const int n : {3, 4, 5, 7, 12, 50, 51, 100, 200})
    all.push_back({fmt::format("wheel {}", n), data::wheel(n, 2)});
  for (int k = 1; k <= 8; ++k) all.push_back({fmt::format("fan {}", k), data::fan(k, 2)});
  return all;
}

struct Worst {
  double position = 0, normal = 0;  // fraction of the box's diagonal; radians
  std::string where, position_where;
};

/// Compares about `samples` vertices of a frame with Stam's evaluator. The mesh is representable in Real.
template <class Real>
void compare(const std::string& name, const data::ControlMesh& mesh,
             const reference::StamEvaluator<double>& truth, const std::vector<std::int32_t>& depth,
             fast::Repair repair, std::size_t samples, Worst& worst) {
  fast::TessellatorOptions options{.provenance = true};
  options.cracks.repair = repair;
  fast::Tessellator<Real> tessellator(mesh, options);
  fast::IndexedMesh<Real> out;
  tessellator.frame(depth, out);
  const double diagonal = data::box_diagonal(mesh);
  const std::size_t step = std::max<std::size_t>(1, out.vertices.size() / samples);
  for (std::size_t v = 0; v < out.vertices.size(); v += step) {
    const auto& at = out.provenance[v];
    const auto expected =
        truth.evaluate(at.face, reference::Parameter::fraction(at.i, at.denominator),
                       reference::Parameter::fraction(at.j, at.denominator), reference::Order::kFirst);
    const auto& got = out.vertices[v];
    const auto apart = [](const auto& a, const auto& b) {
      return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
    };
    const double position = apart(got.position, expected.position) / diagonal;
    const double normal = 2 * std::asin(std::min(1., apart(got.normal, expected.normal) / 2));
    if (position > worst.position) worst.position_where = name;
    worst.position = std::max(worst.position, position);
    if (expected.normal_kind != reference::NormalKind::kRegular) continue;
    if (normal > worst.normal)
      worst.where = fmt::format("{} face {} ({}, {}) / {}", name, at.face, at.i, at.j, at.denominator);
    worst.normal = std::max(worst.normal, normal);
  }
}

template <class Real>
void compare_all(const std::vector<double>& position_bound, const std::vector<double>& normal_bound) {
  data::SplitMix64 random(3);
  for (int depth = 0; depth <= 7; ++depth) {
    Worst worst;
    for (Shape shape : shapes()) {
      for (auto& p : shape.mesh.positions)
        for (double& x : p) x = static_cast<Real>(x);
      const reference::StamEvaluator<double> truth(shape.mesh);
      std::vector<std::int32_t> depths(shape.mesh.faces.size(), depth);
      compare<Real>(shape.name, shape.mesh, truth, depths, fast::Repair::kFan, 1000, worst);
      if (depth == 0 || depth > 5) continue;
      for (auto& d : depths)
        d = static_cast<std::int32_t>(random.next() % static_cast<std::uint64_t>(depth + 1));
      compare<Real>(shape.name, shape.mesh, truth, depths, fast::Repair::kFan, 1000, worst);
      compare<Real>(shape.name, shape.mesh, truth, depths, fast::Repair::kStitch, 1000, worst);
    }
    record("{:.2g}", worst.position, "depth_{}_position", depth);
    record("{:.2g}", worst.normal, "depth_{}_normal", depth);
    fmt::print("depth {}: position {:.3g}, normal {:.3g} at {}\n", depth, worst.position, worst.normal,
               worst.where);
    EXPECT_LE(worst.position, position_bound[depth]) << "depth " << depth << " on " << worst.position_where;
    EXPECT_LE(worst.normal, normal_bound[depth]) << "depth " << depth << " at " << worst.where;
  }
}

TEST(Sec43_SlidingWindow, EqualsTheExactEvaluatorInFloat) {
  // Positions: each level rounds once more, half an ulp of the largest coordinate. Worst seen 6.7e-8 up to
  // depth 4, 1.2e-7 at depth 7 (two components far apart); without that shape below 1e-7. Normals: points are
  // off by 1e-7 and 2^-depth apart, so the bound doubles with each level; worst seen 4.6e-5 at depth
  // 5, 1.5e-4 at depth 7.
  compare_all<float>({1e-7, 1e-7, 1e-7, 1e-7, 1e-7, 1.5e-7, 1.5e-7, 1.5e-7},
                     {1e-6, 1e-5, 2e-5, 4e-5, 8e-5, 1.6e-4, 3.2e-4, 6.4e-4});
}

TEST(Sec43_SlidingWindow, EqualsTheExactEvaluatorInDouble) {
  compare_all<double>(std::vector<double>(8, 1e-14), std::vector<double>(8, 1e-10));
}

using V = fast::Vec3<double>;

TEST(Sec5_Centre, NeedsNoPointOfItsStepThatTheLimitPointsOfTheFirstBorderStepDoNotNeed) {
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
