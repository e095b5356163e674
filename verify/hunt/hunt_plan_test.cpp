// SPDX-License-Identifier: MIT
#include "verify/hunt/hunt_plan.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "data/validate.h"
#include "verify/evidence/cells.h"
#include "verify/evidence/face_depths.h"
#include "verify/subject/lent_mesh.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

constexpr std::int32_t kAllSharp =
    LC_SHARP_CREASES | LC_SHARP_SEMI | LC_SHARP_CHAIKIN | LC_SHARP_CORNERS | LC_SHARP_SMOOTH_TRIANGLES;
const std::vector<Does> kBoth{{data::Scheme::kLoop, 0}, {data::Scheme::kCatmullClark, kAllSharp}};

TEST(HuntPlan, EveryCaseIsValidAndCanBeTypedAgain) {
  HuntPlan plan(7, kBoth);
  for (std::uint64_t n = 0; n < 200; ++n) {
    const HuntCase c = plan.at(n);
    EXPECT_EQ(c.number, n);
    EXPECT_EQ(data::named_mesh(c.mesh.name), c.mesh.mesh) << c.mesh.name;
    EXPECT_TRUE(data::validate(c.mesh.mesh, c.mesh.scheme()).empty()) << c.mesh.name;
    if (c.mesh.scheme() == data::Scheme::kLoop) {
      EXPECT_TRUE(c.mesh.mesh.sharpness.empty()) << c.mesh.name;
    }
  }
}

TEST(HuntPlan, ACaseDependsOnNothingButItsNumber) {
  HuntPlan forward(3, kBoth), jumping(3, kBoth);
  std::map<std::uint64_t, std::string> names;
  const auto text = [](const HuntCase& c) {
    return c.mesh.name + " " + c.mesh.depths + " " + std::to_string(c.mesh.depth) + c.options;
  };
  for (std::uint64_t n = 0; n < 80; ++n) names[n] = text(forward.at(n));
  for (const std::uint64_t n : {40U, 41U, 3U, 79U, 78U, 16U, 15U, 0U, 40U})
    EXPECT_EQ(text(jumping.at(n)), names[n]) << n;
  HuntPlan other(4, kBoth);
  EXPECT_NE(text(other.at(0)), names[0]);
}

TEST(HuntPlan, HasEveryFamilyAndEveryWayOfChoosingDepths) {
  HuntPlan plan(1, kBoth);
  std::set<std::string> families, depths, wrappers;
  bool earlier = false, relations = false;
  for (std::uint64_t n = 0; n < 600; ++n) {
    const HuntCase c = plan.at(n);
    std::string name = c.mesh.name;
    for (const std::string wrapper : {"stretched:", "handled:", "turned:"}) {
      if (!name.starts_with(wrapper)) continue;
      wrappers.insert(wrapper);
      name = name.substr(name.find(':', wrapper.size()) + 1);
    }
    families.insert(name.substr(0, name.find(':')));
    const std::string before = after_of(c.mesh.depths);
    earlier = earlier || !before.empty();
    depths.insert(
        c.mesh.depths.substr(before.size(), c.mesh.depths.find(':', before.size()) - before.size()) +
        (c.mesh.depths.ends_with("visible") ? " visible" : ""));
    relations = relations || c.mesh.relations;
  }
  for (const char* family :
       {"random", "wheel", "fan", "bipyramid", "mixed", "mixed-sharp", "smooth-triangles", "quad-wheel",
        "quad-fan", "prism", "quad-dart", "quad-corner"})
    EXPECT_TRUE(families.contains(family)) << family;
  for (const char* way : {"uniform", "random", "random visible", "view", "face0-culled"})
    EXPECT_TRUE(depths.contains(way)) << way;
  EXPECT_EQ(wrappers.size(), 3U);
  EXPECT_TRUE(earlier && relations);
}

// Of valences, sharpnesses, options and corners, those that an audit counts.
TEST(HuntPlan, DrawsEveryClassOfNeighbourhood) {
  for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark}) {
    HuntPlan plan(1, {{scheme, kAllSharp}});
    std::set<std::size_t> seen;
    for (std::uint64_t n = 0; n < 1500; ++n)
      for (const auto& found : neighbourhoods(plan.at(n).mesh)) seen.insert(found.begin(), found.end());
    for (const Cell& cell : cells(scheme)) {
      const Axis axis = on_axis(cell.first).first;
      // Kinds of vertex are made of other classes; the rest is the size of a mesh.
      if (cell.first != cell.second || axis == Axis::kVertex || axis == Axis::kIndex || axis == Axis::kTags ||
          axis == Axis::kDepth)
        continue;
      EXPECT_TRUE(seen.contains(cell.first)) << name_of(scheme) << ": " << cell.name();
    }
  }
}

TEST(HuntPlan, AsksOnlyForWhatTheSubjectDoes) {
  for (const std::int32_t sharp : {0, int{LC_SHARP_CREASES}, LC_SHARP_CREASES | LC_SHARP_CORNERS}) {
    HuntPlan plan(5, {{data::Scheme::kCatmullClark, sharp}});
    std::int32_t asked = 0;
    for (std::uint64_t n = 0; n < 100; ++n)
      asked |= sharp_kinds(plan.at(n).mesh.mesh, data::Scheme::kCatmullClark);
    EXPECT_EQ(asked, sharp);
  }
  EXPECT_THROW(HuntPlan(1, {}), data::ArgumentError);
}

TEST(Ways, AreThoseThatTheOptionsTextNames) {
  const std::vector<data::Scheme> both{data::Scheme::kLoop, data::Scheme::kCatmullClark};
  const auto ways = [&](const char* name, const std::string& options, const std::vector<std::string>& keys) {
    std::set<std::string> all;
    for (const Way& w : ways_of({find_subject(name), options}, both, keys)) all.insert(w.options);
    return all;
  };
  EXPECT_EQ(ways("naive", "", {"weights"}), (std::set<std::string>{"weights=loop", "weights=warren"}));
  EXPECT_EQ(
      ways("sliding-window", "repair=stitch", {"precision", "output"}),
      (std::set<std::string>{
          "repair=stitch,precision=float", "repair=stitch,precision=double", "repair=stitch,output=strips",
          "repair=stitch,output=indexed", "repair=stitch,precision=float,output=strips",
          "repair=stitch,precision=float,output=indexed", "repair=stitch,precision=double,output=strips",
          "repair=stitch,precision=double,output=indexed"}));
  EXPECT_TRUE(ways("sliding-window", "precision=double", {"precision"}).empty()) << "it is chosen";
  EXPECT_TRUE(ways("naive", "", {}).empty());
  EXPECT_TRUE(ways("row-stream", "", {"target"}).contains("target=scalar"));
  EXPECT_TRUE(ways("row-stream", "", {"all"}).contains("output=patches,frames=2"));
  EXPECT_THROW(ways("naive", "", {"target"}), data::ArgumentError);
  EXPECT_THROW(ways("embree", "", {"precision"}), data::ArgumentError);

  HuntPlan plan(1, kBoth, ways_of({find_subject("naive"), ""}, both, {"all"}));
  std::map<std::string, int> options;
  for (std::uint64_t n = 0; n < 200; ++n) ++options[plan.at(n).options];
  EXPECT_EQ(options.size(), 3U);
  EXPECT_GT(options[""], 60);
}

TEST(HuntPlan, TellsEdgesApartByWhatLiesAboutThem) {
  const auto kinds = [](const char* name, std::vector<std::int32_t> depth = {}) {
    AuditMesh m{name, data::named_mesh(name)};
    m.face_depth = std::move(depth);
    return kinds_of_edges(m).size();
  };
  EXPECT_EQ(kinds("octahedron"), 1U);
  EXPECT_EQ(kinds("octahedron", {3, 3, 3, 3, 0, 0, 0, 0}), 2U);
  EXPECT_EQ(kinds("bipyramid:7"), 2U);
  EXPECT_EQ(kinds("triangle-pair"), 2U);
  EXPECT_EQ(kinds("prism:5"), 2U);
  EXPECT_EQ(kinds("quad-dart:5"), kinds("quad-wheel:5") + 1);
}

}  // namespace
}  // namespace limitcheck::verify
