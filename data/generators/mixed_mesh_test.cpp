// SPDX-License-Identifier: MIT
#include "data/generators/mixed_mesh.h"

#include <gtest/gtest.h>

#include "data/error.h"
#include "data/generators/test_census.h"
#include "data/generators/test_hash.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

TEST(MixedMesh, IsValidWhateverTheSeed) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const RandomMeshOptions options{.faces = 1 + static_cast<int>(seed * 7 % 400)};
    const ControlMesh mesh = mixed_mesh(seed, options);
    const auto faults = validate(mesh, Scheme::kCatmullClark);
    ASSERT_TRUE(faults.empty()) << "seed " << seed << ": " << faults[0].message;
    const ControlMesh before = random_mesh(seed, options);
    EXPECT_EQ(mesh.positions, before.positions) << seed;
    const Census c = census(mesh), b = census(before);
    EXPECT_EQ(c.euler, b.euler) << seed;
    EXPECT_EQ(c.boundary_faces.empty(), b.boundary_faces.empty()) << seed;
  }
}

TEST(MixedMesh, HasFacesOfAllSizesAmongAHundredSeeds) {
  Census all;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Census c = census(mixed_mesh(seed));
    for (const auto& [size, count] : c.sizes) all.sizes[size] += count;
    for (const auto& [n, count] : c.interior_valences) all.interior_valences[n] += count;
    for (const auto& [k, count] : c.boundary_faces) all.boundary_faces[k] += count;
    EXPECT_GE(c.sizes.size(), 3U) << "triangles, quads and larger faces; seed " << seed;
  }
  for (std::size_t n = 3; n <= 8; ++n) {
    EXPECT_GT(all.sizes[n], 100) << n;
    RecordProperty("faces_of_" + std::to_string(n), all.sizes[n]);
  }
  EXPECT_EQ(all.sizes.rbegin()->first, 8U);
  for (int n = 3; n <= 12; ++n) EXPECT_GT(all.interior_valences[n], 0) << n;
  for (int k = 1; k <= 5; ++k) EXPECT_GT(all.boundary_faces[k], 0) << k;
}

TEST(MixedMesh, KeepsToTheCornersAllowed) {
  EXPECT_EQ(census(mixed_mesh(4, {}, 3)).sizes, census(random_mesh(4)).sizes);
  EXPECT_EQ(census(mixed_mesh(4, {}, 4)).sizes.rbegin()->first, 4U);
  EXPECT_GT(census(mixed_mesh(4, {.faces = 2000}, 20)).sizes.rbegin()->first, 10U);
}

// The value was obtained with g++ 12 and with clang 14, optimised and not; other compilers must give the
// same.
TEST(MixedMesh, IsTheSameWithEveryCompiler) {
  std::uint64_t all = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) all = all * 31 + hash(mixed_mesh(seed));
  EXPECT_EQ(all, 17628335372642523725u);
}

TEST(MixedMesh, RefusesWhatItCannotMake) {
  EXPECT_THROW(mixed_mesh(1, {.faces = 0}), InputError);
}

}  // namespace
}  // namespace limitcheck::data
