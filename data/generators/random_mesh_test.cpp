// SPDX-License-Identifier: MIT
#include "data/generators/random_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "data/error.h"
#include "data/generators/test_hash.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

// Counted from the triangles, without the generator's help.
struct Census {
  std::set<int> interior_valences, boundary_faces;
  bool open = false;
};

Census census(const ControlMesh& mesh) {
  std::map<std::int32_t, int> faces;
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  std::set<std::int32_t> boundary;
  for (const auto& t : triangles_of(mesh)) {
    for (int k = 0; k < 3; ++k) {
      ++faces[t[k]];
      ++edges[std::minmax(t[k], t[(k + 1) % 3])];
    }
  }
  for (const auto& [e, count] : edges) {
    if (count == 1) boundary.insert(e.first), boundary.insert(e.second);
  }
  Census c;
  c.open = !boundary.empty();
  for (const auto& [v, count] : faces) {
    if (boundary.contains(v))
      c.boundary_faces.insert(count);
    else
      c.interior_valences.insert(count);
  }
  return c;
}

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
  Census all;
  int open = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Census c = census(random_mesh(seed));
    open += c.open;
    all.interior_valences.insert(c.interior_valences.begin(), c.interior_valences.end());
    all.boundary_faces.insert(c.boundary_faces.begin(), c.boundary_faces.end());
  }
  for (int n = 3; n <= 20; ++n) EXPECT_TRUE(all.interior_valences.contains(n)) << n;
  EXPECT_GE(*all.interior_valences.begin(), 3);
  EXPECT_GT(*all.interior_valences.rbegin(), 40);
  EXPECT_LE(*all.interior_valences.rbegin(), 50);
  for (int k = 1; k <= 9; ++k) EXPECT_TRUE(all.boundary_faces.contains(k)) << k;
  EXPECT_GT(open, 30);
  EXPECT_LT(open, 80);
  RecordProperty("largest_valence", *all.interior_valences.rbegin());
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
