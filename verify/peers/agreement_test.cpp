// SPDX-License-Identifier: MIT
// Three ways to the same points: the naive subdivider, Stam's evaluator, OpenSubdiv's uniform refinement with
// its limit masks. They share no code: reference/ has both of ours, by different methods.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "reference/loop/naive.h"
#include "reference/loop/stam.h"
#include "verify/peers/test_lattice.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;
using namespace limitcheck::verify::test;

// Vertices where OpenSubdiv's tangents are of another rule, so that its normal is not the surface's (see
// opensubdiv_test.cpp): on the boundary, with four faces or more.
std::set<std::int64_t> boundary_vertices_of_four_faces_or_more(const data::ControlMesh& mesh) {
  std::vector<int> faces(mesh.positions.size()), edges(mesh.positions.size());
  std::set<std::pair<int, int>> directed;
  for (const auto& t : triangles_of(mesh)) {
    for (std::size_t k = 0; k < 3; ++k) {
      ++faces[t[k]];
      directed.emplace(t[k], t[(k + 1) % 3]);
    }
  }
  std::set<std::int64_t> result;
  for (const auto& [a, b] : directed) {
    if (directed.contains({b, a})) continue;
    for (const int v : {a, b}) {
      if (faces[v] >= 4) result.insert(v);
    }
  }
  return result;
}

struct Worst {
  double position = 0;  // of the box
  double normal = 0;    // degrees
};

Worst against_stam(const char* subject, const char* options, const std::string& name, int depth) {
  const auto mesh = data::named_mesh(name);
  const auto spared = boundary_vertices_of_four_faces_or_more(mesh);
  Session session(*find_subject(subject), mesh, options);
  const Tessellation t = session.tessellate(depth, 2);
  const reference::StamEvaluator<double> stam(session.mesh());
  const double unit = data::box_diagonal(mesh);
  Worst worst;
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
    const lc_provenance& p = t.provenance()[v];
    const auto exact = stam.evaluate(p.face, double(p.i) / p.denominator, double(p.j) / p.denominator,
                                     reference::Order::kFirst);
    worst.position = std::max(worst.position, distance(t.position(v), vector_of(exact.position)) / unit);
    const PointName at = place(mesh, p);
    const bool spare =
        std::get<0>(at) == 0 && spared.contains(std::get<1>(at)) && std::string(subject) != "naive";
    const double a = angle_degrees(t.normal(v), vector_of(exact.normal));
    if (!spare) worst.normal = std::max(worst.normal, std::isfinite(a) ? a : 180);
  }
  record("position_" + name, worst.position);
  record("normal_" + name, worst.normal);
  return worst;
}

const std::vector<std::string> kMeshes{"bumpy:200",  "bumpy:800", "bumpy:4000",     "tetrahedron",
                                       "octahedron", "cube",      "torus",          "wheel:3",
                                       "wheel:7",    "wheel:50",  "fan:3",          "ragged-disc",
                                       "holes",      "strip:5",   "two-components", "triangle"};

TEST(Agreement, OfTheNaiveSubdividerWithStamsEvaluator) {
  for (const auto& name : kMeshes) {
    const Worst worst = against_stam("naive", "", name, 3);
    EXPECT_LE(worst.position, 1e-14) << name;
    EXPECT_LE(worst.normal, 1e-9) << name;
  }
}

// Beyond the depths and valences of the other tests. A coordinate is rounded some eight times at each of
// depth + 2 steps, by 2^-24 of the largest, which is less than the box; normals are differences of points
// 2^-depth apart: 1e-3 rad at depth 5, twice that with each level (verify/row/bounds.h).
TEST(Agreement, OfRowStreamWithStamsEvaluatorAtDepthsSevenAndEightAndHighValences) {
  for (const int depth : {7, 8}) {
    for (const char* name : {"wheel:13:1", "wheel:14:1", "wheel:17:1", "wheel:33:1", "bipyramid:13"}) {
      const Worst worst = against_stam("row-stream", "", name, depth);
      EXPECT_LE(worst.position, std::sqrt(3.) * 8 * (depth + 2) * 0x1p-24) << name << " depth " << depth;
      EXPECT_LE(worst.normal, std::ldexp(1e-3, depth - 5) * 180 / std::numbers::pi)
          << name << " depth " << depth;
    }
  }
}

// Every value that it delivers is one that the recursion says, some of them for a neighbour: never a mean,
// and no further from what the recursion says in this triangle than rounding (a few ulp of coordinates below
// 2, and differences of points 1/8 apart for normals). A face has one vertex for each lattice point.
TEST(Naive, DeliversWhatTheRecursionSays) {
  Session session(*lc_subject_naive(), data::named_mesh("bumpy:200"));
  const Tessellation t = session.tessellate(3);
  const reference::NaiveSubdivider<double> subdivider(session.mesh());
  std::set<Vector> positions, normals;
  const auto each_corner = [&](const auto& body) {
    std::int64_t triangle = 0;
    for (std::size_t face = 0; face < subdivider.face_count(); ++face)
      subdivider.tessellate(face, 3, [&](const reference::LeafTriangle<double>& leaf) {
        for (std::size_t k = 0; k < 3; ++k) {
          const auto& [p, n] = std::tie(leaf[k].position, leaf[k].normal);
          body(t.triangles()[triangle][k], vector_of(p), vector_of(n));
        }
        ++triangle;
      });
    EXPECT_EQ(triangle, t.triangle_count());
  };
  each_corner([&](std::int64_t, const Vector& p, const Vector& n) {
    positions.insert(p);
    normals.insert(n);
  });
  each_corner([&](std::int64_t v, const Vector& p, const Vector& n) {
    EXPECT_TRUE(positions.contains(t.position(v))) << v;
    EXPECT_TRUE(normals.contains(t.normal(v))) << v;
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(t.position(v)[c], p[c], 16 * 0x1p-53) << v;
      EXPECT_NEAR(t.normal(v)[c], n[c], 256 * 0x1p-53) << v;
    }
  });
  EXPECT_EQ(t.vertex_count(), 200 * 45);
}

TEST(Agreement, OfOpenSubdivFarInDoubleWithStamsEvaluator) {
  for (const auto& name : kMeshes) {
    const Worst worst = against_stam("opensubdiv-far", "precision=double", name, 3);
    EXPECT_LE(worst.position, 1e-14) << name;
    EXPECT_LE(worst.normal, 1e-9) << name;
  }
}

TEST(Agreement, OfOpenSubdivBfrAtLevelsBeyondTheDepthWithStamsEvaluator) {
  for (const char* name : {"bumpy:200", "bumpy:800", "octahedron", "wheel:3", "wheel:7", "torus"}) {
    const Worst worst = against_stam("opensubdiv-bfr", "precision=double,approx-level=4", name, 3);
    EXPECT_LE(worst.position, 1e-14) << name;
  }
}

// Gregory end caps are exact in lattice points as deep as the patches are isolated, whole patches everywhere
// else; the library's corners of one face are not (findings.json).
TEST(Agreement, OfOpenSubdivFarsPatchesAtLevelsBeyondTheDepthWithStamsEvaluator) {
  for (const char* name :
       {"bumpy:200", "bumpy:800", "octahedron", "wheel:3", "wheel:7", "torus", "fan:1", "triangle"}) {
    const Worst worst =
        against_stam("opensubdiv-far-patches", "precision=double,level=4,corners=smooth", name, 3);
    EXPECT_LE(worst.position, 1e-14) << name;
  }
}

}  // namespace
