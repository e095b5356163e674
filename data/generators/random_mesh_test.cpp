// SPDX-License-Identifier: MIT
#include "data/generators/random_mesh.h"

#include <gtest/gtest.h>

#include <set>

#include "data/error.h"
#include "data/generators/test_census.h"
#include "data/generators/test_hash.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

TEST(RandomMesh, IsValidWhateverTheSeed) {
  std::int64_t faces = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const ControlMesh mesh = random_mesh(seed, {.faces = 1 + static_cast<int>(seed * 7 % 400)});
    const auto findings = validate(mesh);
    ASSERT_TRUE(findings.empty()) << "seed " << seed << ": " << findings.front().message;
    faces += static_cast<std::int64_t>(mesh.faces.size());
    for (const auto& p : mesh.positions) {
      for (const double x : p) ASSERT_EQ(x, static_cast<double>(static_cast<float>(x)));
    }
  }
  RecordProperty("faces", std::to_string(faces));
}

TEST(RandomMesh, HasAllValencesAndBoundariesAmongAHundredSeeds) {
  std::set<int> interior_valences, boundary_faces;
  int open = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Census c = census(random_mesh(seed));
    open += !c.boundary_faces.empty();
    for (const auto& [n, count] : c.interior_valences) interior_valences.insert(n);
    for (const auto& [k, count] : c.boundary_faces) boundary_faces.insert(k);
  }
  for (int n = 3; n <= 20; ++n) EXPECT_TRUE(interior_valences.contains(n)) << n;
  EXPECT_GE(*interior_valences.begin(), 3);
  EXPECT_GT(*interior_valences.rbegin(), 40);
  EXPECT_LE(*interior_valences.rbegin(), 50);
  for (int k = 1; k <= 9; ++k) EXPECT_TRUE(boundary_faces.contains(k)) << k;
  EXPECT_GT(open, 30);
  EXPECT_LT(open, 80);
  RecordProperty("largest_valence", *interior_valences.rbegin());
  RecordProperty("open", open);
}

TEST(RandomMesh, HasAboutTheFacesAskedFor) {
  for (const int faces : {50, 200, 5000}) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const auto made = static_cast<double>(random_mesh(seed, {.faces = faces}).faces.size());
      EXPECT_NEAR(made, faces, 2) << "seed " << seed;
    }
  }
}

// The value was obtained with g++ 12 and with clang 14, optimised and not; other compilers must
// give the same.
TEST(RandomMesh, IsTheSameWithEveryCompiler) {
  std::uint64_t all = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) all = all * 31 + hash(random_mesh(seed));
  EXPECT_EQ(all, 15635355288976397870u);
}

TEST(RandomMesh, RefusesWhatItCannotMake) {
  EXPECT_THROW(random_mesh(1, {.faces = 0}), InputError);
  EXPECT_THROW(random_mesh(1, {.faces = 1'000'001}), InputError);
  EXPECT_THROW(random_mesh(1, {.max_valence = 11}), InputError);
}

}  // namespace
}  // namespace limitcheck::data
