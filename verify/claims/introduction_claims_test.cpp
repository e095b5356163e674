// SPDX-License-Identifier: MIT
// Section 1: growth of the meshes, and the figures of the introduction.                            [C01-C04]
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "data/generators/named_mesh.h"
#include "data/shapes.h"
#include "reference/catmull_clark/refined_mesh.h"
#include "reference/loop/refine.h"
#include "verify/host/host.h"
#include "verify/picture/canvas.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

TEST(Sec1_Growth, IsFourfoldForTrianglesAndForPolygonsFromTheSecondStepOn) {
  RecordProperty("claim", "C01");
  for (const auto& mesh : {data::tetrahedron(), data::holes(), data::bumpy_sphere(60, 1)}) {
    std::size_t faces = mesh.faces.size();
    for (int depth = 1; depth <= 3; ++depth) {
      faces *= 4;
      EXPECT_EQ(reference::refine<double>(mesh, depth).triangles().size(), faces);
    }
  }
  // Catmull-Clark by OpenSubdiv, on a prism over a heptagon: two heptagons and seven quads. A polygon of n
  // corners becomes n quads, whatever it was; from then on each becomes four.
  std::vector<int> corners{7, 7}, vertices{0, 1, 2, 3, 4, 5, 6, 13, 12, 11, 10, 9, 8, 7};
  for (int k = 0; k < 7; ++k) {
    corners.push_back(4);
    const int next = (k + 1) % 7;
    vertices.insert(vertices.end(), {next, k, k + 7, next + 7});
  }
  using namespace OpenSubdiv;
  Far::TopologyDescriptor prism;
  prism.numVertices = 14, prism.numFaces = static_cast<int>(corners.size());
  prism.numVertsPerFace = corners.data(), prism.vertIndicesPerFace = vertices.data();
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  const std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(prism, Factory::Options(Sdc::SCHEME_CATMARK)));
  ASSERT_TRUE(refiner);
  refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(3));
  int faces = 7 + 7 + 7 * 4;
  for (int step = 1; step <= 3; ++step, faces *= 4)
    EXPECT_EQ(refiner->GetLevel(step).GetNumFaces(), faces) << "step " << step;
  // The same by our own rules, also where triangles, quads and larger faces meet.
  for (const char* name : {"prism:7", "quad-cube", "mixed:1:60", "dual:bumpy:60"}) {
    const data::ControlMesh mesh = data::named_mesh(name);
    reference::catmull_clark::RefinedMesh<double> refined(mesh.faces, reference::positions_of<double>(mesh));
    std::size_t quads = mesh.faces.corners().size();
    for (int step = 1; step <= 3; ++step, quads *= 4) {
      refined.refine();
      EXPECT_EQ(refined.topology().faces().size(), quads) << name << ", step " << step;
    }
  }
}

TEST(Sec1_Triangles, PerControlTriangleAre64To1024AtDepthsThreeToFive) {
  RecordProperty("claim", "C02");
  for (const auto* subject : {lc_subject_naive(), lc_subject_sliding_window()}) {
    Session session(*subject, data::tetrahedron());
    EXPECT_EQ(session.tessellate(3).triangle_count(), 4 * 64);
    EXPECT_EQ(session.tessellate(5).triangle_count(), 4 * 1024);
  }
}

// A wall of 125 x 80 squares, two triangles each, that fills the screen: pixels of a triangle. If of 20 000
// only three in five are seen, and these fill it, each has so many more.
TEST(Sec1_ScreenSize, OfTwentyThousandTrianglesIsThirtyNinePixelsAndSixtyFiveIfTwoInFiveFaceAway) {
  RecordProperty("claim", "C03");
  fast::Camera camera;
  camera.eye = {0, 0, 1};
  camera.field_of_view = 90;  // half of the height is 1
  const double half = static_cast<double>(camera.width) / camera.height;
  const auto corner = [&](int i, int j) {
    return fast::SurfaceVertex<float>{
        {static_cast<float>(half * (2 * i / 125. - 1)), static_cast<float>(2 * j / 80. - 1), 0}, {0, 0, 1}};
  };
  // Beyond the border the last column would miss pixels by rounding: the wall is a hair larger than the
  // screen.
  camera.field_of_view -= 1e-3;
  Canvas canvas(camera);
  int triangles = 0;
  for (int j = 0; j < 80; ++j)
    for (int i = 0; i < 125; ++i) {
      canvas.triangle(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
      canvas.triangle(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
      triangles += 2;
    }
  const auto& shade = canvas.picture().shade;
  const auto pixels =
      std::count_if(shade.begin(), shade.end(), [](float s) { return s != Picture::kNothing; });
  ASSERT_EQ(triangles, 20'000);
  EXPECT_EQ(pixels, 1024 * 768);
  const double all = static_cast<double>(pixels) / triangles, some = all / (1 - 2. / 5);
  RecordProperty("pixels_each_if_all_are_seen", fmt::format("{:.1f}", all));
  RecordProperty("pixels_each_if_two_in_five_face_away", fmt::format("{:.1f}", some));
  EXPECT_NEAR(all, 40, 1);
  EXPECT_NEAR(some, 65, 1);
}

TEST(Sec1_ScreenSize, NineToElevenPixelsIsTheLegOfARightTriangleAndNoOtherDiameter) {
  RecordProperty("claim", "C04");
  const auto near = [](double low, double high) { return std::round(low) == 9 && std::round(high) == 11; };
  const auto leg = [](double a) { return std::sqrt(2 * a); };
  const auto side = [](double a) { return std::sqrt(4 * a / std::sqrt(3.)); };
  const auto circle = [](double a) { return 2 * std::sqrt(a / std::numbers::pi); };
  const auto hypotenuse = [&](double a) { return std::sqrt(2.) * leg(a); };
  EXPECT_TRUE(near(leg(40), leg(65)));
  EXPECT_FALSE(near(side(40), side(65)));
  EXPECT_FALSE(near(circle(40), circle(65)));
  EXPECT_FALSE(near(hypotenuse(40), hypotenuse(65)));
}

}  // namespace
}  // namespace limitcheck::verify
