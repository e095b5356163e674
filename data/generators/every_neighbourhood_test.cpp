// SPDX-License-Identifier: MIT
// As many neighbourhoods as Burnside's lemma counts, each once.
#include "data/generators/every_neighbourhood.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <string>

#include "data/splitmix64.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

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

}  // namespace
}  // namespace limitcheck::data
