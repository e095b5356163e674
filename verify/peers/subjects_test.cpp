// SPDX-License-Identifier: MIT
// What is special to some of the subjects: what this build may lack, what they refuse, and what the two of ours and
// OpenSubdiv compute.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data/bounding_box.h"
#include "data/generators/named_mesh.h"
#include "data/test_support/assertions.h"
#include "reference/loop/recursion.h"
#include "reference/surface/surface.h"
#include "verify/peers/test_lattice.h"
#include "verify/row/bounds.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

// Each of them is there or not, whether the others are or not.
TEST(MissingAdapters, AreThereOrSaidToBeMissing) {
  const auto all = missing_subjects();
  for (const auto& known :
       {std::pair{"vtk", "libvtk9-dev"}, {"opensubdiv-gl", "libgl1"}, {"row-stream-gl", "libgl1"}}) {
    const auto missing =
        std::find_if(all.begin(), all.end(), [&](const auto& m) { return m.name == known.first; });
    ASSERT_EQ(missing == all.end(), find_subject(known.first) != nullptr) << known.first;
    if (missing != all.end()) {
      EXPECT_TRUE(says(missing->why, known.second)) << missing->why;
    }
  }
}

TEST(RefiningAdapters, RefuseWhatDoesNotFitIn32BitIndices) {
  const auto mesh = data::named_mesh("bumpy:11000");
  for (const char* subject : {"opensubdiv-far", "cgal", "openmesh"}) {
    Session session(*find_subject(subject), mesh);
    const auto refused = thrown<SubjectError>([&] { session.tessellate(8); });
    EXPECT_TRUE(refused && refused->status() == LC_NOT_SUPPORTED) << subject;
  }
}

// 20000 faces of 4^10 triangles: 10^10 vertices, and 10^11 bytes that nobody asks for.
TEST(Engines, RefuseMoreVerticesThanIndicesNameBeforeTheyAllocate) {
  const auto mesh = data::named_mesh("sheet:100:100");
  const std::vector<std::int32_t> depth(mesh.faces.size(), 10);
  for (const lc_subject* subject : {lc_subject_row_stream(), lc_subject_sliding_window()}) {
    for (const char* options : {"output=strips", "output=indexed"}) {
      Session session(*subject, mesh, options);
      EXPECT_TRUE(says(refusal_of<SubjectError>([&] { session.tessellate(depth, 1); }), "32-bit indices"));
    }
  }
}

// Beyond the depths and valences of the other tests (bounds: verify/row/bounds.h).
TEST(Engines, RowStreamIsStamsSurfaceAtDepthsSevenAndEightAndHighValences) {
  for (const int depth : {7, 8})
    for (const char* name : {"wheel:13:1", "wheel:14:1", "wheel:17:1", "wheel:33:1", "bipyramid:13"}) {
      Session session(*lc_subject_row_stream(), data::named_mesh(name));
      const Tessellation t = session.tessellate(depth, 2);
      const reference::Surface stam(session.mesh(), data::Scheme::kLoop);
      const double unit = data::box_diagonal(session.mesh());
      double worst_position = 0, worst_normal = 0;
      for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
        const lc_provenance& p = t.provenance()[v];
        const auto exact = stam.evaluate(p.face, 0, double(p.i) / p.denominator, double(p.j) / p.denominator,
                                         reference::Order::kFirst);
        worst_position = std::max(worst_position, norm(t.position(v) - vector_of(exact.position)) / unit);
        const double turned = angle_degrees(t.normal(v), vector_of(exact.normal));
        worst_normal = std::max(worst_normal, std::isfinite(turned) ? turned : 180);
      }
      EXPECT_LE(worst_position, position_bound(LC_FLOAT32, depth, unit, unit)) << name << " depth " << depth;
      EXPECT_LE(worst_normal, normal_bound(LC_FLOAT32, depth)) << name << " depth " << depth;
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
        for (std::size_t k = 0; k < 3; ++k)
          body(t.triangles()[triangle][k], vector_of(leaf[k].position), vector_of(leaf[k].normal));
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

// sdc/loopScheme.h takes the across-tangent of another boundary rule (D4) for vertices of more than three faces: the
// ends of the ring weigh sin(theta) / (2 cos(theta) - 2), theta = pi / faces, those between sin(k theta). The adapter
// hands that on.
TEST(OpenSubdivFar, UsesATangentMaskOfAnotherRuleAtBoundaryVerticesOfFourFacesOrMore) {
  for (int faces = 1; faces <= 8; ++faces) {
    const auto mesh = data::named_mesh("fan:" + std::to_string(faces));
    const test::Expected<data::Scheme::kLoop> expected(mesh, 1);
    Session session(*lc_subject_opensubdiv_far(), mesh, "precision=double");
    const Tessellation t = session.tessellate(1);
    std::int64_t centre = 0;
    while (expected.vertex(t.place(centre)) != 0) ++centre;
    const Vector normal = t.normal(centre);
    EXPECT_EQ(angle_degrees(normal, expected.normal(0)) > 0.1, faces > 3) << faces << " faces";
    if (faces < 4) continue;
    const auto ring = expected.refined().topology().ring(0);
    const auto at = [&](std::size_t k) { return expected.point(ring[k], LC_POINTS_REFINED); };
    const double theta = std::numbers::pi / faces;
    Vector across = std::sin(theta) / (2 * std::cos(theta) - 2) * (at(0) + at(ring.size() - 1));
    for (std::size_t k = 1; k + 1 < ring.size(); ++k)
      across = across + std::sin(static_cast<double>(k) * theta) * at(k);
    EXPECT_LE(angle_degrees(normal, cross(at(0) - at(ring.size() - 1), across)), 1e-10) << faces << " faces";
  }
}

}  // namespace
}  // namespace limitcheck::verify
