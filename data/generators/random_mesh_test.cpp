// SPDX-License-Identifier: MIT
// Irregular meshes of triangles and of polygons, and changes of topology.
#include "data/generators/random_mesh.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "data/error.h"
#include "data/generators/mixed_mesh.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/surgery.h"
#include "data/shapes.h"
#include "data/summary.h"
#include "data/test_meshes.h"

namespace limitcheck::data {
namespace {

TEST(RandomMesh, IsValidWhateverTheSeed) {
  std::int64_t faces = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const ControlMesh mesh = random_mesh(seed, {.faces = 1 + static_cast<int>(seed * 7 % 400)});
    expect_sound(mesh, "seed " + std::to_string(seed));
    faces += static_cast<std::int64_t>(mesh.faces.size());
  }
  RecordProperty("faces", std::to_string(faces));
}

TEST(RandomMesh, HasAllValencesAndBoundariesAmongAHundredSeeds) {
  std::set<int> interior_valences, boundary_faces;
  int open = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const MeshSummary c = summarise(random_mesh(seed));
    open += !c.boundary_faces.empty();
    for (const auto& [n, count] : c.valence) interior_valences.insert(n);
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

// The values were obtained with g++ 12 and with clang 14, optimised and not, but for the last; other compilers must
// give the same.
TEST(RandomMesh, IsTheSameWithEveryCompiler) {
  EXPECT_EQ(hash_of_seeds([](std::uint64_t seed) { return random_mesh(seed); }), 15635355288976397870u);
  EXPECT_EQ(hash_of_seeds([](std::uint64_t seed) { return mixed_mesh(seed); }), 17628335372642523725u);
  EXPECT_EQ(hash_of_seeds([](std::uint64_t seed) {
              return with_turned_edges(with_handles(random_mesh(seed), 2, seed), seed);
            }),
            11336603162438035092u);
}

TEST(RandomMesh, RefusesWhatItCannotMake) {
  EXPECT_THROW(random_mesh(1, {.faces = 0}), InputError);
  EXPECT_THROW(random_mesh(1, {.faces = 1'000'001}), InputError);
  EXPECT_THROW(random_mesh(1, {.max_valence = 11}), InputError);
  EXPECT_THROW(mixed_mesh(1, {.faces = 0}), InputError);
  EXPECT_THROW(with_handles(torus(12, 6), -1, 1), InputError);
}

TEST(MixedMesh, IsValidWhateverTheSeed) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const RandomMeshOptions options{.faces = 1 + static_cast<int>(seed * 7 % 400)};
    const ControlMesh mesh = mixed_mesh(seed, options);
    expect_valid(mesh, "seed " + std::to_string(seed), Scheme::kCatmullClark);
    const ControlMesh before = random_mesh(seed, options);
    EXPECT_EQ(mesh.positions, before.positions) << seed;
    const MeshSummary c = summarise(mesh), b = summarise(before);
    EXPECT_EQ(c.euler, b.euler) << seed;
    EXPECT_EQ(c.boundary_faces.empty(), b.boundary_faces.empty()) << seed;
  }
}

TEST(MixedMesh, HasFacesOfAllSizesAmongAHundredSeeds) {
  std::map<std::size_t, int> all_sizes;
  MeshSummary all;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const ControlMesh mesh = mixed_mesh(seed);
    const MeshSummary s = summarise(mesh);
    const auto sizes = sizes_of(mesh);
    for (const auto& [size, count] : sizes) all_sizes[size] += count;
    for (const auto& [n, count] : s.valence) all.valence[n] += count;
    for (const auto& [k, count] : s.boundary_faces) all.boundary_faces[k] += count;
    EXPECT_GE(sizes.size(), 3U) << "triangles, quads and larger faces; seed " << seed;
  }
  for (std::size_t n = 3; n <= 8; ++n) {
    EXPECT_GT(all_sizes[n], 100) << n;
    RecordProperty("faces_of_" + std::to_string(n), all_sizes[n]);
  }
  EXPECT_EQ(all_sizes.rbegin()->first, 8U);
  for (int n = 3; n <= 12; ++n) EXPECT_GT(all.valence[n], 0) << n;
  for (int k = 1; k <= 5; ++k) EXPECT_GT(all.boundary_faces[k], 0) << k;
}

TEST(MixedMesh, KeepsToTheCornersAllowed) {
  EXPECT_EQ(sizes_of(mixed_mesh(4, {}, 3)), sizes_of(random_mesh(4)));
  EXPECT_EQ(sizes_of(mixed_mesh(4, {}, 4)).rbegin()->first, 4U);
  EXPECT_GT(sizes_of(mixed_mesh(4, {.faces = 2000}, 20)).rbegin()->first, 10U);
}

TEST(Handles, RaiseTheGenus) {
  EXPECT_EQ(summarise(torus(12, 6)).euler, 0);
  for (const int count : {0, 1, 2, 5}) {
    const ControlMesh mesh = with_handles(torus(12, 6), count, 3);
    expect_valid(mesh, std::to_string(count));
    EXPECT_TRUE(mesh.faces.are_triangles());
    EXPECT_EQ(summarise(mesh).euler, -2 * count);
  }
  EXPECT_EQ(with_handles(tetrahedron(), 3, 1), tetrahedron()) << "no two faces of it lie apart";
}

TEST(Handles, LeaveAnyMeshValid) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const int faces = 6 + static_cast<int>(seed * 3 % 150);
    const ControlMesh triangles = with_handles(random_mesh(seed, {.faces = faces}), 2, seed);
    expect_valid(triangles, std::to_string(seed));
    const ControlMesh mixed =
        with_handles(with_random_sharpness(mixed_mesh(seed, {.faces = faces}), seed), 2, seed);
    expect_valid(mixed, std::to_string(seed), Scheme::kCatmullClark);
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
    expect_valid(flipped, std::to_string(seed));
    EXPECT_TRUE(flipped.faces.are_triangles());
    EXPECT_EQ(summarise(flipped).euler, summarise(triangles).euler);
    const ControlMesh turned = with_turned_edges(mixed, seed);
    expect_valid(turned, std::to_string(seed), Scheme::kCatmullClark);
    EXPECT_EQ(summarise(turned).euler, summarise(mixed).euler);
    changed += !(turned == mixed);
    for (std::size_t f = 0; f < turned.faces.size(); ++f) corners.insert(turned.faces[f].size());
    const ControlMesh sharp = with_random_sharpness(mixed, seed);
    expect_valid(with_turned_edges(sharp, seed), std::to_string(seed), Scheme::kCatmullClark);
  }
  EXPECT_GT(changed, 150);
  for (std::size_t n = 3; n <= 10; ++n) EXPECT_TRUE(corners.contains(n)) << n;
}

}  // namespace
}  // namespace limitcheck::data
