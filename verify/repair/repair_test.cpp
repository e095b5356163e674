// SPDX-License-Identifier: MIT
#include "verify/repair/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <tuple>

#include "verify/repair/test_repair_properties.h"

namespace limitcheck::verify {
namespace {

using data::io::PolygonSoup;
using Faces = std::vector<std::vector<std::int64_t>>;

PolygonSoup soup(std::size_t vertices, const Faces& faces) {
  PolygonSoup s;
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto x = static_cast<double>(v);
    s.positions.push_back({x, x * x, x * x * x});  // no three on a line, no two alike
  }
  for (const auto& f : faces) {
    s.corners.insert(s.corners.end(), f.begin(), f.end());
    s.close_polygon();
  }
  return s;
}

Faces faces_of(const PolygonSoup& s) {
  Faces faces;
  std::size_t begin = 0;
  for (const std::size_t end : s.polygon_end) {
    faces.emplace_back(s.corners.begin() + static_cast<std::ptrdiff_t>(begin),
                       s.corners.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
  }
  return faces;
}

bool is_valid(const PolygonSoup& s) {
  return data::io::examine(s, {}).faults.empty();
}

const Faces kTetrahedron{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};

TEST(Repair, LeavesAValidMeshAsItIs) {
  const PolygonSoup mesh = soup(4, kTetrahedron);
  const Repaired r = repair(mesh);
  EXPECT_TRUE(r.changes.empty());
  EXPECT_EQ(faces_of(r.soup), kTetrahedron);
  EXPECT_EQ(r.soup.positions, mesh.positions);
}

TEST(Repair, KeepsChannelsWhereAllFacesStay) {
  PolygonSoup mesh = soup(4, kTetrahedron);
  mesh.channels.push_back({.name = "uv", .components = 1, .values = {1, 2, 3}});
  for (std::int64_t k = 0; k < 12; ++k) mesh.channels[0].corners.push_back(k % 3);
  const auto kept = [](const Repaired& r) {
    return r.soup.channels.empty() ? std::vector<std::int64_t>{} : r.soup.channels[0].corners;
  };
  EXPECT_EQ(kept(repair(mesh)), mesh.channels[0].corners);
  PolygonSoup with_unused = mesh;  // other vertices have other numbers then
  with_unused.positions.insert(with_unused.positions.begin(), {9, 9, 9});
  for (std::int64_t& v : with_unused.corners) ++v;
  EXPECT_EQ(kept(repair(with_unused)), mesh.channels[0].corners);
  PolygonSoup turned = mesh;
  std::swap(turned.corners[1], turned.corners[2]);
  const Repaired r = repair(turned);
  EXPECT_TRUE(r.soup.channels.empty());
  EXPECT_EQ(std::count(r.changes.begin(), r.changes.end(),
                       "dropped 1 channel of faces that are not those of before"),
            1);
}

using Tag = std::tuple<std::int64_t, std::int64_t, double>;
std::vector<Tag> tags_of(const PolygonSoup& s) {
  std::vector<Tag> tags;
  for (const auto& t : s.sharp) tags.emplace_back(t.a, t.b, t.sharpness);
  return tags;
}

TEST(Repair, SharpEdgesAndVerticesGoWithTheirVertices) {
  // Vertex 1 is not used, and 5 and 6 lie where 0 and 3 do.
  PolygonSoup mesh = soup(7, {{0, 2, 3}, {5, 6, 4}});
  mesh.positions[5] = mesh.positions[0];
  mesh.positions[6] = mesh.positions[3];
  mesh.sharp = {{3, 0, 2.5, 1}, {5, 6, 1, 2}, {4, -1, 10, 3}, {1, 2, 3, 4}, {2, 4, 3, 5}, {0, 99, 1, 6}};
  mesh.choices.creasing = data::Creasing::kChaikin;
  const Repaired apart = repair(mesh);
  EXPECT_EQ(tags_of(apart.soup), (std::vector<Tag>{{2, 0, 2.5}, {4, 5, 1}, {3, -1, 10}}));
  EXPECT_TRUE(is_valid(apart.soup));
  EXPECT_EQ(apart.soup.choices, mesh.choices);
  const Repaired welded = repair(mesh, {.weld = true});
  EXPECT_EQ(tags_of(welded.soup), (std::vector<Tag>{{2, 0, 2.5}, {3, -1, 10}})) << "the sharper of two stays";
  EXPECT_TRUE(is_valid(welded.soup));
  // Where a mesh is cut apart, the copies are sharp as well.
  PolygonSoup book = soup(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  book.sharp = {{0, 1, 3, 1}};
  const Repaired cut = repair(book);
  EXPECT_TRUE(is_valid(cut.soup));
  EXPECT_GE(cut.soup.sharp.size(), 2U);
}

TEST(Repair, DropsWhatNamesNothingOrItself) {
  Faces faces = kTetrahedron;
  faces.push_back({0, 1, 99});
  faces.push_back({0, -1, 2});
  faces.push_back({2, 2, 3});
  faces.push_back({1, 2});
  const Repaired r = repair(soup(6, faces));
  EXPECT_EQ(faces_of(r.soup), kTetrahedron);
  EXPECT_EQ(r.changes, (std::vector<std::string>{"dropped 2 faces that named a vertex which does not exist",
                                                 "dropped 1 face with fewer than three corners",
                                                 "dropped 1 face with a repeated corner",
                                                 "dropped 2 vertices that no face names"}));
}

TEST(Repair, DropsFacesWithAVertexThatIsNotFinite) {
  PolygonSoup mesh = soup(7, {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}});
  mesh.positions[5][1] = std::numeric_limits<double>::quiet_NaN();
  for (const bool weld : {false, true}) {
    const Repaired r = repair(mesh, {.weld = weld});
    EXPECT_EQ(faces_of(r.soup), (Faces{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_TRUE(is_valid(r.soup));
  }
}

TEST(Repair, DropsTheLaterOfTwoFacesWithTheSameCorners) {
  Faces faces = kTetrahedron;
  faces.push_back({1, 2, 0});
  faces.push_back({0, 2, 1});  // the other way round
  const Repaired r = repair(soup(4, faces));
  EXPECT_EQ(faces_of(r.soup), kTetrahedron);
}

TEST(Repair, TurnsFacesThatRunAgainstTheirNeighbours) {
  const Repaired r = repair(soup(4, {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 3, 2}}));
  EXPECT_TRUE(is_valid(r.soup));
  EXPECT_EQ(r.soup.polygon_end.size(), 4U);
  ASSERT_EQ(r.changes.size(), 1U);
  EXPECT_EQ(r.changes[0].substr(0, 6), "turned");
}

// Two triangles that touch in vertex 0 only, and an edge of three faces.
TEST(Repair, CutsTheMeshApartWhereItIsNoManifold) {
  const PolygonSoup bowtie = soup(5, {{0, 1, 2}, {0, 3, 4}});
  EXPECT_FALSE(is_valid(bowtie));
  const Repaired r = repair(bowtie);
  EXPECT_TRUE(is_valid(r.soup));
  EXPECT_EQ(r.soup.positions.size(), 6U);

  const PolygonSoup book = soup(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  EXPECT_FALSE(is_valid(book));
  const Repaired three = repair(book);
  EXPECT_TRUE(is_valid(three.soup));
  EXPECT_EQ(three.soup.polygon_end.size(), 3U);
}

// A cube, one of whose quads, 0 3 2 1, is two around vertex 8.
TEST(Repair, MakesOneFaceOfTwoAroundAnInteriorVertex) {
  const Faces cube{{4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  Faces doublet = cube;
  doublet.insert(doublet.end(), {{0, 3, 2, 8}, {2, 1, 0, 8}});
  ASSERT_FALSE(is_valid(soup(9, doublet)));
  const Repaired r = repair(soup(9, doublet));
  EXPECT_TRUE(is_valid(r.soup));
  EXPECT_EQ(r.soup.positions.size(), 8U);
  Faces whole = faces_of(r.soup);
  ASSERT_EQ(whole.size(), 6U);
  EXPECT_EQ(whole.back(), (std::vector<std::int64_t>{0, 3, 2, 1}));
  whole.pop_back();
  EXPECT_EQ(whole, cube);
  EXPECT_EQ(r.changes[0], "removed 1 vertex inside with two faces only, which became one");
}

TEST(Repair, ClosesSeamsOnlyWhenAsked) {
  PolygonSoup cut = soup(6, {{0, 1, 2}, {3, 4, 5}});
  cut.positions[3] = cut.positions[0];
  cut.positions[4] = cut.positions[2];
  EXPECT_EQ(repair(cut).soup.positions.size(), 6U);
  const Repaired welded = repair(cut, {.weld = true});
  EXPECT_EQ(welded.soup.positions.size(), 4U);
  EXPECT_TRUE(is_valid(welded.soup));
  // Vertices of one face that lie at one place: the face has no area, and goes.
  cut.positions[1] = cut.positions[0];
  EXPECT_EQ(repair(cut, {.weld = true}).soup.polygon_end.size(), 1U);
}

// As three.js leaves a strip: its last column 1e-16 from the first. Inner vertices are no border, however close.
TEST(Repair, JoinsBorderVerticesThatLieCloseTogether) {
  PolygonSoup strip = soup(8, {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}});
  strip.positions[3] = strip.positions[0];
  strip.positions[7] = strip.positions[4];
  strip.positions[3][0] += 1e-16;
  strip.positions[7][1] += 1e-14;
  strip.sharp = {{3, 7, 2, 1}};
  EXPECT_EQ(repair(strip, {.weld = true}).soup.positions.size(), 8U);
  const Repaired joined = repair(strip, {.weld = true, .weld_distance = 1e-6});
  EXPECT_EQ(faces_of(joined.soup), (Faces{{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}));
  EXPECT_EQ(tags_of(joined.soup), (std::vector<Tag>{{0, 3, 2}}));
  EXPECT_EQ(joined.soup.positions[0], strip.positions[0]) << "the first stays where it is";

  PolygonSoup closed = soup(4, kTetrahedron);
  closed.positions[1] = closed.positions[0];
  closed.positions[1][0] += 1e-9;
  EXPECT_TRUE(repair(closed, {.weld = true, .weld_distance = 1e-6}).changes.empty());
}

TEST(Repair, KeepsPolygons) {
  const Faces cube{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  EXPECT_EQ(faces_of(repair(soup(8, cube)).soup), cube);
}

// Polygons of anything, few vertices, some of them at one place, and tags of anything.
PolygonSoup random_soup(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto below = [&](std::uint32_t n) { return static_cast<std::int64_t>(random() % n); };
  const std::int64_t vertices = 3 + below(8);
  PolygonSoup s = soup(static_cast<std::size_t>(vertices), {});
  if (below(3) == 0)
    for (std::int64_t n = below(4); n > 0; --n) s.positions[below(vertices)] = s.positions[below(vertices)];
  for (std::int64_t faces = 1 + below(9); faces > 0; --faces) {
    for (std::int64_t n = 3 + below(3); n > 0; --n) s.corners.push_back(below(vertices));
    s.close_polygon();
  }
  for (std::int64_t n = below(6); n > 0; --n) {
    const bool vertex = below(3) == 0;
    s.sharp.push_back({below(vertices), vertex ? -1 : below(vertices), static_cast<double>(below(12)), n});
  }
  return s;
}

TEST(Repair, EndsInAMeshThatItLeavesAsItIs) {
  EXPECT_EQ(broken_property(soup(4, {{0, 1, 2, 3}, {0, 1, 2}}), {}), "");
  // An edge without its first end is no vertex, though a vertex's tag has no second one; nor does it hide that one.
  auto half = soup(3, {{0, 1, 2}});
  half.sharp = {{-1, 2, 8, 1}, {2, -1, 4, 2}};
  EXPECT_EQ(broken_property(half, {}), "");
  EXPECT_EQ(repair(half, {}).soup.sharp.size(), 1U);
  // A tag of a vertex that does not exist is not one of the vertex that gets its number where the mesh is cut.
  auto fin = soup(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  fin.sharp = {{2, 0, 2, 1}, {2, 5, 9, 2}, {2, 6, 9, 3}, {4, 5, 9, 4}, {4, 6, 9, 5}};
  EXPECT_EQ(broken_property(fin, {}), "");
  for (const auto& tag : repair(fin, {}).soup.sharp) EXPECT_EQ(tag.sharpness, 2);
  for (std::uint32_t seed = 0; seed < 4000; ++seed)
    for (const RepairOptions& options :
         {RepairOptions{}, {.weld = true}, {.weld = true, .weld_distance = 1e-2}})
      ASSERT_EQ(broken_property(random_soup(seed), options), "") << seed << " " << options.weld_distance;
}

}  // namespace
}  // namespace limitcheck::verify
