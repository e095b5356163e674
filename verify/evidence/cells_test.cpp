// SPDX-License-Identifier: MIT
// Neighbourhoods have the cells that their stars say.
#include "verify/evidence/cells.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "data/generators/named_mesh.h"

namespace limitcheck::verify {
namespace {

// The names of the cells of a mesh that are one feature.
std::set<std::string> names(const std::string& mesh, int depth = 1, std::vector<std::int32_t> depths = {}) {
  AuditMesh m{mesh, data::named_mesh(mesh)};
  m.depth = depth;
  m.face_depth = std::move(depths);
  std::set<std::string> list;
  const CellSet set = cells_of(m);
  for (std::size_t k = 0; k < set.size(); ++k) {
    const Cell& cell = cells(m.scheme())[k];
    if (set[k] && cell.first == cell.second) list.insert(cell.name());
  }
  return list;
}

TEST(Cells, AreThoseThatAStarSays) {
  const auto inside = names("quad-star:1c:rvBJ.k./5-3");
  for (const char* name :
       {"inside", "1 infinite edge", "1 semi-sharp edge", "a finite sharpness of its own", "4 faces",
        "an edge of sharpness 10", "an edge of sharpness 4 to 7", "Chaikin's creasing", "of sharpness 2",
        "a face of 5 corners", "a triangle by the ordinary rule", "depth 1",
        "inside with 1 infinite edge, 1 semi-sharp edge, a finite sharpness of its own",
        "a mesh of 1 to 12 tags", "a mesh of one component", "a mesh of genus 0", "faces of one depth",
        "an index up to 255", "4 faces inside"})
    EXPECT_TRUE(inside.contains(name)) << name;
  for (const char* name :
       {"2 infinite edges", "held", "uniform creasing", "3 faces", "a face of 6 corners", "depth 2"})
    EXPECT_FALSE(inside.contains(name)) << name;
  const auto boundary = names("star:1h:orvK.c.");
  for (const char* name :
       {"on the boundary", "held", "of sharpness above 10", "an edge of sharpness next below 1",
        "uniform creasing", "2 faces on the boundary"})
    EXPECT_TRUE(boundary.contains(name)) << name;
  EXPECT_TRUE(names("star:1h:orvb..").contains("one face by a boundary of edges and corners"));
  EXPECT_TRUE(names("star:1c:rbe..").contains("Chaikin's creasing of unequal edges"));
  EXPECT_TRUE(
      names("star:1c:rhD..").contains("Chaikin's creasing of unequal edges sharp for more than 2 steps"));
  EXPECT_FALSE(
      names("star:1c:reh..").contains("Chaikin's creasing of unequal edges sharp for more than 2 steps"));
  EXPECT_TRUE(names("star:1c:wDbh..").contains("an edge below 1 between semi-sharp ones above 2"));
  EXPECT_FALSE(names("star:1c:wbbh..").contains("an edge below 1 between semi-sharp ones above 2"));
  EXPECT_FALSE(names("star:1c:rhh..").contains("Chaikin's creasing of unequal edges"));
  EXPECT_FALSE(boundary.contains("an edge of sharpness 1"));
}

TEST(Cells, KnowWhatLiesAround) {
  EXPECT_TRUE(names("star:1:wJJ.J..").contains("a sharp edge that goes on alike"));
  EXPECT_TRUE(names("star:1:wbA.J..").contains("a sharp edge that goes on with another sharpness"));
  EXPECT_TRUE(names("star:1:zBJ.J..").contains("a smooth edge to another sharp vertex"));
  EXPECT_FALSE(names("star:1:zBJ.J..").contains("a sharp edge that goes on with another sharpness"));
  EXPECT_TRUE(names("star:1:yJJ.J..").contains("a smooth edge between two creases"));
  EXPECT_FALSE(names("star:1:zJJ.J..").contains("a smooth edge between two creases"));
  EXPECT_TRUE(names("icosahedron").contains("beside an irregular vertex"));
  EXPECT_FALSE(names("torus").contains("beside an irregular vertex"));
}

TEST(Cells, KnowTheDepthsOfTheFacesAround) {
  const auto some = names("star:1:r.4", 4, {4, 3, -1, 0});
  for (const char* name :
       {"depth 0", "depth 3", "depth 4", "depths that differ by 3 and more", "some faces culled"})
    EXPECT_TRUE(some.contains(name)) << name;
  EXPECT_FALSE(names("star:1:r.4").contains("some faces culled"));
  EXPECT_TRUE(names("star:1:r.4", 2, {-1, -1, -1, -1}).empty()) << "nothing is displayed";
}

TEST(Cells, KnowTheWholeMesh) {
  EXPECT_TRUE(names("torus").contains("a mesh of genus 1"));
  EXPECT_TRUE(names("handles:2").contains("a mesh of genus 2"));
  EXPECT_TRUE(names("handles:3").contains("a mesh of genus 3 and more"));
  EXPECT_TRUE(names("star:1:rJ300").contains("a mesh of more than 255 tags"));
  EXPECT_TRUE(names("star:1:.5_.6").contains("a mesh of several components"));
  EXPECT_TRUE(names("octahedron").contains("asked for the relations, too"));
  EXPECT_FALSE(names("bumpy:800").contains("asked for the relations, too"));
  const auto crowd = names("quad-crowd:8250", 0);
  for (const char* name : {"an index up to 32767", "an index up to 65535", "an index up to 2147483647"})
    EXPECT_TRUE(crowd.contains(name)) << name;
}

TEST(Cells, HaveNamesOfTheirOwnAndAreReadAsTheyAreWritten) {
  for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark}) {
    std::set<std::string> all;
    for (const Cell& cell : cells(scheme)) EXPECT_TRUE(all.insert(cell.name()).second) << cell.name();
    CellSet set(cells(scheme).size());
    for (std::size_t k = 0; k < set.size(); ++k) set[k] = k % 5 == 1 || k % 7 == 0;
    EXPECT_EQ(cell_set(text_of(set), scheme), set);
  }
}

}  // namespace
}  // namespace limitcheck::verify
