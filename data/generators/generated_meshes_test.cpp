// SPDX-License-Identifier: MIT
// As many neighbourhoods as Burnside's lemma counts, each once.
// Irregular meshes of triangles and of polygons, and changes of topology.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "data/error.h"
#include "data/generators/every_neighbourhood.h"
#include "data/generators/random_mesh.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/star_meshes.h"
#include "data/generators/surgery.h"
#include "data/shapes.h"
#include "data/sharpness_classes.h"
#include "data/splitmix64.h"
#include "data/summary.h"
#include "data/test_meshes.h"
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

constexpr std::int32_t kAll = 31;

std::int64_t power(std::int64_t k, std::int64_t n) {
  return n == 0 ? 1 : k * power(k, n - 1);
}
// Bracelets of n beads of k colours.
std::int64_t bracelets(std::int64_t n, std::int64_t k) {
  std::int64_t fixed = 0;
  for (std::int64_t turn = 0; turn < n; ++turn) fixed += power(k, std::gcd(turn, n));
  for (std::int64_t axis = 0; axis < n; ++axis)
    fixed += power(k, n % 2 == 1 ? (n + 1) / 2 : axis % 2 == 0 ? n / 2 : n / 2 + 1);
  return fixed / (2 * n);
}
// Words of n letters that may be read from either end.
std::int64_t rows(std::int64_t n, std::int64_t k) {
  return (power(k, n) + power(k, (n + 1) / 2)) / 2;
}

// Of n faces, with everything that may be sharp.
std::int64_t tagged(std::int64_t n, bool closed) {
  const auto words = [&](std::int64_t k) { return closed ? bracelets(n, k) : rows(n - 1, k); };
  const std::int64_t of_four = words(4) + (words(4) - words(2));         // and those of Chaikin's creasing
  const std::int64_t with_own = 3 * (words(3) + (words(3) - words(2)));  // in three lengths
  const std::int64_t of_class = 2 * (words(2) - 1) + words(2) + (words(2) - 1);
  return of_four + with_own + 12 * of_class;
}
// Of faces that are no quads.
std::int64_t polygons(std::int64_t n, bool closed) {
  const auto words = [&](std::int64_t k) { return closed ? bracelets(n, k) : rows(n, k); };
  const std::int64_t smooth = words(3) - words(2);
  // One such face amid edges of two kinds: only the mirror that exchanges its sides leaves it where it is.
  std::int64_t amid = (power(2, n) + power(2, (n + 1) / 2)) / 2 - 1;
  if (!closed) {
    const std::int64_t fixed = n % 2 == 1 ? power(2, (n - 1) / 2) : 0;
    amid = (n * power(2, n - 1) + fixed) / 2 - (n + 1) / 2;
  }
  return words(3) - 1 + smooth + 3 * (words(2) - 1) + 30 * amid;
}

std::int64_t count(bool triangles, int most, std::int32_t kinds) {
  std::int64_t all = 0;
  for (const Stars& mesh : every_neighbourhood(triangles, most, kinds))
    all += static_cast<std::int64_t>(mesh.stars.size());
  return all;
}

TEST(EveryNeighbourhood, IsThereAsOftenAsBurnsidesLemmaSays) {
  std::int64_t loop = 0, quads = 0;
  for (std::int64_t n = 1; n <= 2; ++n) {
    const std::int64_t held = n == 1 ? 2 : 1;  // by each boundary option
    loop += held * tagged(n, false), quads += held * (tagged(n, false) + polygons(n, false));
  }
  for (std::int64_t n = 3; n <= 7; ++n) {
    loop += tagged(n, true) + tagged(n, false);
    quads += tagged(n, true) + tagged(n, false) + polygons(n, true) + polygons(n, false);
    EXPECT_EQ(count(true, static_cast<int>(n), kAll), loop) << n;
    EXPECT_EQ(count(false, static_cast<int>(n), kAll), quads) << n;
  }
  EXPECT_EQ(count(true, 6, 0), 4 + 6) << "smooth ones alone, inside and on a boundary";
  EXPECT_EQ(count(true, 5, kWithCreases), bracelets(3, 2) + bracelets(4, 2) + bracelets(5, 2) + 1 +
                                              rows(1, 2) + rows(2, 2) + rows(3, 2) + rows(4, 2));
  RecordProperty("neighbourhoods_up_to_8",
                 std::to_string(count(true, 8, kAll)) + " and " + std::to_string(count(false, 8, kAll)));
}

TEST(EveryNeighbourhood, IsThereOnceHoweverItIsTurnedOrMirrored) {
  std::set<std::string> all;
  for (const Stars& mesh : every_neighbourhood(true, 6, kAll))
    for (const Star& star : mesh.stars)
      EXPECT_TRUE(all.insert(Stars{0, mesh.chaikin, mesh.corners_held, false, false, {star}}.text()).second)
          << star.text();
  SplitMix64 random(1);
  for (int k = 0; k < 500; ++k) {
    Star star;
    for (std::size_t n = 3 + random.next() % 4; star.spokes.size() < n;)
      star.spokes += ".beJ"[random.next() % 4];
    const bool chaikin = star.spokes.find_first_of("be") != std::string::npos && random.next() % 2 == 0;
    if (star.spokes.find_first_not_of('.') != std::string::npos) star.beyond = '=';
    std::set<std::string> images, found;
    for (std::size_t turn = 0; turn < star.spokes.size(); ++turn)
      for (int mirror = 0; mirror < 2; ++mirror) {
        std::rotate(star.spokes.begin(), star.spokes.begin() + (mirror == 0 ? 1 : 0), star.spokes.end());
        std::reverse(star.spokes.begin(), star.spokes.end());
        images.insert(Stars{0, chaikin, false, false, false, {star}}.text());
      }
    std::set_intersection(images.begin(), images.end(), all.begin(), all.end(),
                          std::inserter(found, found.end()));
    EXPECT_EQ(found.size(), 1U) << star.text();
  }
}

TEST(EveryNeighbourhood, IsValidAndKnownByItsFaces) {
  for (const bool triangles : {true, false})
    for (const Stars& stars : every_neighbourhood(triangles, 5, kAll)) {
      const ControlMesh mesh = star_mesh(stars, triangles);
      ASSERT_TRUE(validate(mesh, triangles ? Scheme::kLoop : Scheme::kCatmullClark).empty()) << stars.text();
      std::size_t first = 0;
      for (const Star& star : stars.stars) {
        EXPECT_EQ(&star_of_face(stars, mesh, first), &star);
        EXPECT_EQ(&star_of_face(stars, mesh, (first += star.faces()) - 1), &star);
      }
      EXPECT_EQ(&star_of_face(stars, mesh, mesh.faces.size() - 1), &stars.stars.back());
    }
}

TEST(EveryNeighbourhood, WithoutDartsHasNoneInside) {
  for (const Stars& stars : every_neighbourhood(false, 4, kWithCreases | kWithoutDarts))
    for (const Star& star : stars.stars)
      EXPECT_TRUE(star.open || std::count(star.spokes.begin(), star.spokes.end(), 'J') != 1) << star.text();
}

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
