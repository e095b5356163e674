// SPDX-License-Identifier: MIT
#include "data/generators/surgery.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

#include "data/error.h"
#include "data/generators/mixed_mesh.h"
#include "data/generators/random_mesh.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/test_hash.h"
#include "data/scheme.h"
#include "data/shapes.h"
#include "data/summary.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

std::int64_t euler(const ControlMesh& mesh) {
  return summarise(mesh).euler;
}

TEST(Handles, RaiseTheGenus) {
  EXPECT_EQ(euler(torus(12, 6)), 0);
  for (const int count : {0, 1, 2, 5}) {
    const ControlMesh mesh = with_handles(torus(12, 6), count, 3);
    EXPECT_TRUE(validate(mesh).empty()) << count;
    EXPECT_TRUE(mesh.faces.are_triangles());
    EXPECT_EQ(euler(mesh), -2 * count);
  }
  EXPECT_EQ(with_handles(tetrahedron(), 3, 1), tetrahedron()) << "no two faces of it lie apart";
  EXPECT_THROW(with_handles(torus(12, 6), -1, 1), InputError);
}

TEST(Handles, LeaveAnyMeshValid) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const int faces = 6 + static_cast<int>(seed * 3 % 150);
    const ControlMesh triangles = with_handles(random_mesh(seed, {.faces = faces}), 2, seed);
    ASSERT_TRUE(validate(triangles).empty()) << seed << ": " << validate(triangles)[0].message;
    const ControlMesh mixed =
        with_handles(with_random_sharpness(mixed_mesh(seed, {.faces = faces}), seed), 2, seed);
    ASSERT_TRUE(validate(mixed, Scheme::kCatmullClark).empty()) << seed;
  }
}

TEST(TurnedEdges, LeaveAnyMeshValid) {
  std::set<std::size_t> corners;
  int changed = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const int faces = 6 + static_cast<int>(seed * 3 % 150);
    const ControlMesh triangles = random_mesh(seed, {.faces = faces}),
                      mixed = mixed_mesh(seed, {.faces = faces});
    const ControlMesh flipped = with_turned_edges(triangles, seed);
    ASSERT_TRUE(validate(flipped).empty()) << seed << ": " << validate(flipped)[0].message;
    EXPECT_TRUE(flipped.faces.are_triangles());
    EXPECT_EQ(euler(flipped), euler(triangles));
    const ControlMesh turned = with_turned_edges(mixed, seed);
    ASSERT_TRUE(validate(turned, Scheme::kCatmullClark).empty())
        << seed << ": " << validate(turned, Scheme::kCatmullClark)[0].message;
    EXPECT_EQ(euler(turned), euler(mixed));
    changed += !(turned == mixed);
    for (std::size_t f = 0; f < turned.faces.size(); ++f) corners.insert(turned.faces[f].size());
    const ControlMesh sharp = with_random_sharpness(mixed, seed);
    ASSERT_TRUE(validate(with_turned_edges(sharp, seed), Scheme::kCatmullClark).empty()) << seed;
  }
  EXPECT_GT(changed, 150);
  for (std::size_t n = 3; n <= 10; ++n) EXPECT_TRUE(corners.contains(n)) << n;
}

// As of random_mesh: obtained with g++ 12.
TEST(Surgery, IsTheSameWithEveryCompiler) {
  std::uint64_t all = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed)
    all = all * 31 + hash(with_turned_edges(with_handles(random_mesh(seed), 2, seed), seed));
  EXPECT_EQ(all, 11336603162438035092u);
}

}  // namespace
}  // namespace limitcheck::data
