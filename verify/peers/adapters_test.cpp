// SPDX-License-Identifier: MIT
// The adapters deliver what their libraries compute, and say truly where each point lies.
// Three ways to the same points: the naive subdivider, Stam's evaluator, OpenSubdiv's uniform refinement with
// its limit masks. They share no code: reference/ has both of ours, by different methods.
#include <gtest/gtest.h>

#include <tbb/global_control.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/test_support/assertions.h"
#include "reference/loop/naive.h"
#include "reference/loop/stam.h"
#include "verify/peers/test_lattice.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;
using namespace limitcheck::verify::test;

struct Named {
  const char* subject;
  const char* options;
};
const std::vector<Named> kAdapters{{"opensubdiv-far", ""},
                                   {"opensubdiv-far", "precision=double"},
                                   {"opensubdiv-bfr", ""},
                                   {"opensubdiv-bfr", "precision=double,approx-level=4"},
                                   {"opensubdiv-far-patches", ""},
                                   {"opensubdiv-far-patches", "precision=double,level=4,end-cap=bspline"},
                                   {"cgal", ""},
                                   {"openmesh", ""}};

using Expected = test::Expected<data::Scheme::kLoop>;

TEST(Adapters, CoverEachFaceByItsLatticeOnceAndCounterClockwise) {
  for (const Named& named : kAdapters) {
    for (const auto& [name, mesh] : shapes()) {
      for (const int depth : {0, 1, 3}) {
        SCOPED_TRACE(std::string(named.subject) + " " + named.options + " on " + name);
        Session session(*find_subject(named.subject), mesh, named.options);
        const Tessellation t = session.tessellate(depth);
        EXPECT_TRUE(t.defects().empty());
        EXPECT_TRUE(t.overruns().empty());
        EXPECT_EQ(t.has_normals(), session.capabilities().normals == 1);
        expect_full_lattice(Expected(session.mesh(), depth), t, std::vector<int>(mesh.faces.size(), depth));
        for (std::int64_t v = 0; v < t.vertex_count(); ++v) EXPECT_FALSE(t.position_unwritten(v));
      }
    }
  }
}

TEST(Adapters, TakeADepthForEachFaceWhereTheySaySo) {
  const auto mesh = data::named_mesh("octahedron");
  const std::vector<std::int32_t> depth{0, 3, -1, 1, 2, -1, 3, 0};
  for (const Named& named : kAdapters) {
    Session session(*find_subject(named.subject), mesh, named.options);
    if (session.capabilities().per_face_depth == 0) continue;
    SCOPED_TRACE(named.subject);
    expect_full_lattice(Expected(mesh, 3), session.tessellate(depth), depth);
  }
}

TEST(Adapters, ThatRefineAWholeMeshShareEveryPoint) {
  for (const char* subject : {"opensubdiv-far", "cgal", "openmesh"}) {
    for (const auto& [name, mesh] : shapes()) {
      Session session(*find_subject(subject), mesh);
      for (const auto& [place, vertices] : places(mesh, session.tessellate(3))) {
        EXPECT_EQ(vertices.size(), 1u) << subject << " on " << name;
      }
    }
  }
}

// VTK's filter is there or not; where it is, it is one more of them, in float.
TEST(Adapters, ThatThisBuildMayLackAreThereOrSaidToBeMissing) {
  const lc_subject* vtk = find_subject("vtk");
  if (vtk == nullptr) {
    ASSERT_EQ(missing_subjects().size(), 1U);
    EXPECT_EQ(missing_subjects()[0].name, "vtk");
    EXPECT_TRUE(says(missing_subjects()[0].why, "libvtk9-dev"));
    return;
  }
  EXPECT_TRUE(missing_subjects().empty());
  for (const auto& [name, mesh] : shapes()) {
    SCOPED_TRACE(name);
    Session vtk_session(*vtk, mesh);
    Session cgal_session(*lc_subject_cgal(), vtk_session.mesh());
    const Tessellation in_float = vtk_session.tessellate(3), exact = cgal_session.tessellate(3);
    expect_full_lattice(Expected(mesh, 3), in_float, std::vector<int>(mesh.faces.size(), 3));
    const auto expected = places(mesh, exact);
    for (const auto& [place, vertices] : places(mesh, in_float)) {
      EXPECT_EQ(vertices.size(), 1u);
      // Three steps, each rounding to float once: 3 * sqrt(3) * 2^-24 of the largest coordinate.
      EXPECT_LE(distance(in_float.position(vertices[0]), exact.position(expected.at(place)[0])),
                1e-6 * data::box_diagonal(mesh));
    }
  }
}

// Decides that both libraries use Loop's weights (with Warren's the vertex of valence 4 would move by
// 0.375 instead of 0.484 of the way) and the B-spline boundary.
TEST(RefiningAdapters, UseLoopsWeightsAndTheSplineBoundary) {
  double worst = 0;
  for (const char* subject : {"cgal", "openmesh"}) {
    for (const auto& [name, mesh] : shapes()) {
      Session session(*find_subject(subject), mesh);
      const Tessellation t = session.tessellate(1);
      const Expected expected(mesh, 1);
      for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
        const double error =
            distance(t.position(v), expected.point(expected.vertex(t.place(v)), LC_POINTS_REFINED));
        EXPECT_LE(error, 1e-15) << subject << " on " << name;  // a dozen roundings of numbers near 1
        worst = std::max(worst, error);
      }
    }
  }
  record("worst_distance", worst);
}

TEST(Adapters, DoNotDependOnTheNumberOfThreads) {
  const auto bytes = [](const Tessellation& t) {
    std::string all;
    for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
      for (const auto bits : {t.position_bits(v), t.has_normals() ? t.normal_bits(v) : t.position_bits(v)}) {
        all.append(reinterpret_cast<const char*>(bits.data()), bits.size());
      }
    }
    all.append(reinterpret_cast<const char*>(t.provenance().data()), t.provenance().size_bytes());
    all.append(reinterpret_cast<const char*>(t.triangles().data()), t.triangles().size_bytes());
    return all;
  };
  const tbb::global_control four(tbb::global_control::max_allowed_parallelism,
                                 4);  // whatever this machine has
  const auto mesh = data::named_mesh("bumpy:4000");
  for (const Named& named : kAdapters) {
    Session session(*find_subject(named.subject), mesh, named.options);
    const std::string one = bytes(session.tessellate(2, 1));
    EXPECT_EQ(one, bytes(session.tessellate(2, 4))) << named.subject;
    EXPECT_EQ(one, bytes(session.tessellate(2, 1))) << named.subject << ", asked again";
  }
}

TEST(Adapters, RefuseWhatDoesNotFitIn32BitIndices) {
  const auto mesh = data::named_mesh("bumpy:11000");
  for (const char* subject : {"opensubdiv-far", "cgal", "openmesh"}) {
    Session session(*find_subject(subject), mesh);
    const auto refused = thrown<SubjectError>([&] { session.tessellate(8); });
    EXPECT_TRUE(refused && refused->status() == LC_NOT_SUPPORTED) << subject;
  }
}

// OpenMesh reads beyond its weight table from valence 50 on: the adapter refuses in its place, and says why.
TEST(OpenMesh, IsNotRunWhereItReadsOutOfBounds) {
  EXPECT_NO_THROW(Session(*lc_subject_openmesh(), data::named_mesh("wheel:49")));
  const auto refused =
      thrown<SubjectError>([] { Session(*lc_subject_openmesh(), data::named_mesh("wheel:50")); });
  ASSERT_TRUE(refused) << "valence 50 was accepted";
  EXPECT_EQ(refused->status(), LC_INVALID_INPUT);
  EXPECT_TRUE(says(refused->what(), "50 weights"));
}

// 20000 faces of 4^10 triangles: 10^10 vertices, and 10^11 bytes that nobody asks for.
TEST(SubjectAdapters, RefuseMoreVerticesThanIndicesNameBeforeTheyAllocate) {
  const auto mesh = data::named_mesh("sheet:100:100");
  const std::vector<std::int32_t> depth(mesh.faces.size(), 10);
  for (const lc_subject* subject : {lc_subject_row_stream(), lc_subject_sliding_window()}) {
    for (const char* options : {"output=strips", "output=indexed"}) {
      Session session(*subject, mesh, options);
      EXPECT_TRUE(says(refusal_of<SubjectError>([&] { session.tessellate(depth, 1); }), "32-bit indices"));
    }
  }
}

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
