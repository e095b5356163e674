// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "data/error.h"
#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "verify/files/read/provenance.h"

namespace limitcheck::verify {
namespace {

using Coordinates = std::array<double, 3>;

// For a tessellation of four vertices, and a control mesh of eight triangles.
auto parse(const std::string& text, const std::string& name) {
  return parse_provenance(text, name, 4, data::octahedron(), data::Scheme::kLoop);
}

TEST(Provenance, ReadsParametersAndLatticePointsWithAndWithoutAHeading) {
  const auto real = parse("0,7,0.25,1/2\n3, 2, 0, 1\n", "t");
  ASSERT_EQ(real.size(), 2U);
  EXPECT_EQ(real[0].at.face, 7);
  EXPECT_EQ(real[0].at.l, (Coordinates{.25, .25, .5}));
  EXPECT_EQ(real[1].vertex, 3);
  EXPECT_EQ(real[1].at.l, (Coordinates{0, 0, 1}));
  const auto lattice = parse("# made by hand\nface,i,j,denominator,vertex\n7,1,2,4,0\n\n", "t");
  ASSERT_EQ(lattice.size(), 1U);
  EXPECT_EQ(lattice[0].at.l, (Coordinates{.25, .25, .5}));
}

TEST(Provenance, OfCatmullClarksSchemeNamesTheCornerOfAFaceThatIsNoQuad) {
  const data::ControlMesh prism = data::polygon_prism(5);  // two pentagons and five quads, in some order
  std::int64_t pentagon = 0, quad = 0;
  for (std::size_t f = 0; f < prism.faces.size(); ++f)
    (prism.faces[f].size() == 5 ? pentagon : quad) = static_cast<std::int64_t>(f);
  const auto read = [&](const std::string& text) {
    return parse_provenance(text, "map.csv", 4, prism, data::Scheme::kCatmullClark);
  };
  const auto rows = read(fmt::format("vertex,face,corner,u,v\n0,{},3,1/4,1\n1,{},,1,1\n", pentagon, quad));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at.face, pentagon);
  EXPECT_EQ(rows[0].corner, 3);
  EXPECT_EQ(rows[0].at.l[1], .25);
  EXPECT_EQ(rows[0].at.l[2], 1);
  EXPECT_EQ(rows[1].corner, -1);
  for (const std::string wrong : {"vertex,face,corner,u,v\n0,{},5,0,0\n", "vertex,face,u,v\n0,{},0,0\n",
                                  "vertex,face,corner,u,v\n0,{},0,0,1.5\n"})
    EXPECT_THROW(read(fmt::format(fmt::runtime(wrong), pentagon)), data::InputError) << wrong;
  EXPECT_THROW(read(fmt::format("vertex,face,corner,u,v\n0,{},1,0,0\n", quad)), data::InputError);
}

std::string error_of(const std::string& text) {
  try {
    parse(text, "map.csv");
  } catch (const data::InputError& error) {
    return std::string(error.what()).substr(0, std::string(error.what()).find(": ", 12));
  }
  return "none";
}

TEST(Provenance, RefusesWhatItCannotMeanWithTheLine) {
  EXPECT_EQ(error_of("vertex,face\n0,1\n"), "map.csv:1: FILE_SYNTAX");
  EXPECT_EQ(error_of("0,1,0,0\n1,1,0\n"), "map.csv:2: FILE_SYNTAX");
  EXPECT_EQ(error_of("0,1,x,0\n"), "map.csv:1: FILE_SYNTAX");
  EXPECT_EQ(error_of("4,1,0,0\n"), "map.csv:1: FILE_PROVENANCE");
  EXPECT_EQ(error_of("0,8,0,0\n"), "map.csv:1: FILE_PROVENANCE");
  EXPECT_EQ(error_of("0,1,0.6,0.6\n"), "map.csv:1: FILE_PROVENANCE");
  EXPECT_EQ(error_of("0,1,0,0\n0,1,0,0\n"), "map.csv:2: FILE_PROVENANCE");
  EXPECT_EQ(error_of("0,1,1,1,0\n"), "map.csv:1: FILE_SYNTAX");  // denominator 0
  EXPECT_EQ(error_of(""), "map.csv: FILE_TRUNCATED");
}

}  // namespace
}  // namespace limitcheck::verify
