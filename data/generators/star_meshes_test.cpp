// SPDX-License-Identifier: MIT
#include "data/generators/star_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "data/error.h"
#include "data/sharpness_classes.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

TEST(SharpnessClasses, EverySharpnessHasTheClassThatItsNameSays) {
  for (std::size_t k = 0; k < kSharpnessClasses.size(); ++k) {
    EXPECT_EQ(sharpness_class(kSharpnessClasses[k].typical), k) << kSharpnessClasses[k].name;
    EXPECT_EQ(sharpness_of(kSharpnessClasses[k].letter), kSharpnessClasses[k].typical);
    EXPECT_EQ(kSharpnessClasses[k].typical >= kInfiniteSharpness, k >= kFirstInfiniteClass);
  }
  EXPECT_EQ(sharpness_class(1e-30F), 0U);
  EXPECT_EQ(sharpness_class(std::nextafter(1.F, 0.F)), 2U);
  EXPECT_EQ(sharpness_class(std::nextafter(1.F, 2.F)), 4U);
  EXPECT_EQ(sharpness_class(std::nextafter(2.F, 0.F)), 6U);
  EXPECT_EQ(sharpness_class(std::nextafter(2.F, 3.F)), 8U);
  EXPECT_EQ(sharpness_class(std::nextafter(10.F, 0.F)), 13U);
  EXPECT_EQ(sharpness_class(std::nextafter(10.F, 11.F)), 15U);
  EXPECT_EQ(sharpness_of('z'), -1);
}

TEST(StarMeshes, AreReadAsTheyAreWritten) {
  for (const char* text : {"1:.3", "7ch:J.5", "12s:ovBwJ.3aBc/5-3", "3:or.._.4_vKJJ", "0:.64", "5:rzb.J4"})
    EXPECT_EQ(parse_stars(text).text(), text);
  for (const char* text : {"", "1", "x:.3", "1y:.3", "1:..q", "1:...~", "1:.3/", "1:.3/4-", "1:.3/4x"})
    EXPECT_THROW(parse_stars(text), InputError) << text;
}

TEST(StarMeshes, HaveTheNeighbourhoodsThatTheyName) {
  const ControlMesh mesh = star_mesh(parse_stars("4ch:ovBwe.Jc../3-5-4-256_.7_r.3"), false);
  EXPECT_TRUE(validate(mesh, Scheme::kCatmullClark).empty());
  EXPECT_EQ(mesh.sharpness.creasing, Creasing::kChaikin);
  EXPECT_EQ(mesh.sharpness.boundary, Boundary::kEdgeAndCorner);
  EXPECT_EQ(mesh.sharpness.edges.size(), 4U);  // J, c and what is beyond them
  ASSERT_EQ(mesh.sharpness.vertices.size(), 1U);
  EXPECT_EQ(mesh.sharpness.vertices[0].sharpness, 2);
  const std::vector<std::size_t> corners{3, 5, 4, 256};
  for (std::size_t f = 0; f < corners.size(); ++f) {
    EXPECT_EQ(mesh.faces[f].size(), corners[f]);
    EXPECT_EQ(mesh.faces[f][0], mesh.sharpness.vertices[0].vertex);
  }
}

TEST(StarMeshes, AreValidOfEveryValenceInsideAndOnTheBoundary) {
  for (const bool triangles : {false, true})
    for (int faces = 1; faces <= 40; faces += faces < 12 ? 1 : 9)
      for (const bool open : {false, true})
        for (const bool bare : {false, true}) {
          if (!open && faces < 3) continue;
          Star star{std::string(static_cast<std::size_t>(faces + (open ? 1 : 0)), '.'), open, bare};
          const ControlMesh mesh = star_mesh({.seed = 3, .stars = {star, star}}, triangles);
          const Scheme scheme = triangles ? Scheme::kLoop : Scheme::kCatmullClark;
          EXPECT_TRUE(validate(mesh, scheme).empty()) << star.text();
          EXPECT_EQ(mesh.faces.size(), static_cast<std::size_t>(2 * faces * (bare ? 1 : 4)));
        }
}

TEST(StarMeshes, RefuseWhatIsNoStar) {
  for (const char* text : {"1:..", "1:o.", "1:.3/2"})
    EXPECT_THROW(star_mesh(parse_stars(text), false), InputError) << text;
  EXPECT_THROW(star_mesh(parse_stars("1:.3/4"), true), InputError);
}

}  // namespace
}  // namespace limitcheck::data
