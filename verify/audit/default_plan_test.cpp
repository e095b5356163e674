// SPDX-License-Identifier: MIT
// The default plan asks for all it says, and tessellators that are right hold on it.
#include "verify/audit/default_plan.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "data/validate.h"

namespace limitcheck::verify {
namespace {

// How each mesh is asked for: "tetrahedron 7 uniform".
std::set<std::string> asked(const std::vector<AuditMesh>& plan) {
  std::set<std::string> all;
  for (const AuditMesh& m : plan) all.insert(fmt::format("{} {} {}", m.name, m.depth, m.depths));
  return all;
}

// Whatever a subject does: the cases that ask for no more look at all kinds of neighbourhood that need no more.
TEST(DefaultPlan, LooksAtEveryCellWhateverASubjectDoes) {
  for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark}) {
    std::vector<Looked> known;
    for (const AuditMesh& m : default_plan(Level::kQuick))
      if (m.scheme() == scheme) known.push_back(look_at(m));
    for (const std::int32_t ability : steps_of_ability()) {
      const Covered now = covered_by(known, scheme, ability);
      for (std::size_t k = 0; k < now.wanted.size(); ++k) {
        EXPECT_TRUE(now.looked[k] || !now.wanted[k])
            << name_of(scheme) << ", ability " << ability << ": " << cells(scheme)[k].name();
      }
    }
  }
}

TEST(DefaultPlan, AFaultInOneCellIsSeenWhenItsMeshesAreLeftOut) {
  std::vector<Looked> known;
  for (const AuditMesh& m : default_plan(Level::kQuick))
    if (m.scheme() == data::Scheme::kLoop && m.name.find("stars:") == std::string::npos)
      known.push_back(look_at(m));
  const Covered now = covered_by(known, data::Scheme::kLoop, steps_of_ability().back());
  EXPECT_GT(std::count(now.wanted.begin(), now.wanted.end(), true),
            2 * std::count(now.looked.begin(), now.looked.end(), true));
}

TEST(DefaultPlan, AsksForEveryStockShapeAtDepths2And4) {
  const auto cases = asked(default_plan(Level::kStandard));
  for (const std::string& shape : data::stock_shapes())
    for (const int depth : {2, 4})
      EXPECT_TRUE(cases.contains(fmt::format("{} {} uniform", shape, depth)) || shape == "wheel:200")
          << shape;
}

TEST(DefaultPlan, AsksForEveryDepthUpToSevenAndForUnequalDepths) {
  std::set<std::string> depths;
  for (const AuditMesh& m : default_plan(Level::kStandard))
    depths.insert(m.depths == "uniform" ? fmt::format("{}", m.depth) : m.depths);
  for (const char* d :
       {"0", "1", "2", "3", "4", "5", "6", "7", "random:1", "view", "face0-culled", "all-culled"})
    EXPECT_TRUE(depths.contains(d)) << d;
}

TEST(DefaultPlan, ItsCasesAreValidTypeableAndAreAskedForOnce) {
  const auto plan = default_plan(Level::kStandard);
  EXPECT_EQ(asked(plan).size(), plan.size());
  for (const AuditMesh& m : plan) {
    EXPECT_TRUE(data::validate(m.mesh, m.scheme()).empty()) << m.name;
    // What a user types gives the same.
    EXPECT_EQ(data::named_mesh(m.name).positions, m.mesh.positions) << m.name;
    EXPECT_EQ(face_depths(parse_depths(m.depths), m.mesh, m.depth), m.face_depth) << m.name;
  }
}

TEST(DefaultPlan, IsShorterOnDevicesAndUnderOptionsWhereAllSubjectsAreAudited) {
  std::size_t large = 0, on_a_device = 0;
  std::set<std::tuple<data::Scheme, bool, bool>> kinds;  // with sharp edges, with relations
  for (const AuditMesh& m : default_plan(Level::kStandard)) {
    EXPECT_TRUE(is_looked_at_beside_all({nullptr, ""}, false, m)) << m.name;
    EXPECT_EQ(is_looked_at_beside_all({nullptr, "level=4"}, false, m), m.mesh.faces.size() <= 1000) << m.name;
    large += m.mesh.faces.size() > 1000;
    if (!is_looked_at_beside_all({nullptr, ""}, true, m)) continue;
    ++on_a_device;
    kinds.emplace(m.scheme(), !m.mesh.sharpness.empty(), m.relations);
  }
  EXPECT_GT(large, 10U);
  EXPECT_EQ(on_a_device, 7U) << "a mesh for devices is no longer in the plan";
  using data::Scheme;
  EXPECT_TRUE(kinds.contains({Scheme::kLoop, false, true}));
  EXPECT_TRUE(kinds.contains({Scheme::kCatmullClark, false, false}));
  EXPECT_TRUE(kinds.contains({Scheme::kCatmullClark, true, true}));
}

TEST(DefaultPlan, ItsRandomFrameHasCulledFacesAndEveryDepthAndItsViewMoreThanOne) {
  for (const AuditMesh& m : default_plan(Level::kStandard)) {
    const std::set<std::int32_t> depths(m.face_depth.begin(), m.face_depth.end());
    if (m.depths.starts_with("random") && m.mesh.faces.size() > 40 &&
        m.name.find("stars:") == std::string::npos) {
      EXPECT_EQ(static_cast<int>(depths.size()), m.depth + 2) << m.name;
    }
    if (m.depths == "view") {
      EXPECT_TRUE(depths.contains(-1));
      EXPECT_GE(depths.size(), 3U);
    }
    if (m.depths == "all-culled") {
      EXPECT_EQ(depths, (std::set<std::int32_t>{-1}));
    }
  }
}

TEST(DefaultPlan, ItsSamplesLookAtTaggedVerticesWhoseIndicesNeedMoreThanFifteenAndSixteenBits) {
  for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark}) {
    std::set<int> seen;
    for (const AuditMesh& m : default_plan(Level::kStandard)) {
      if (!m.sample || m.scheme() != scheme) continue;
      const auto depth = m.sample->cull(std::vector<std::int32_t>(m.mesh.faces.size(), 0));
      std::set<std::int32_t> shown;
      for (std::size_t f = 0; f < depth.size(); ++f)
        if (depth[f] == 0) shown.insert(m.mesh.faces[f].begin(), m.mesh.faces[f].end());
      for (const data::SharpEdge& e : m.mesh.sharpness.edges)
        if (shown.contains(e.a)) seen.insert(e.a >> 15);
    }
    EXPECT_TRUE(seen.contains(1) && seen.contains(2)) << name_of(scheme);
  }
}

TEST(DefaultPlan, QuickLeavesOutTheWorstCases) {
  const auto quick = asked(default_plan(Level::kQuick));
  EXPECT_FALSE(quick.contains("random:360:60 4 uniform"));
  EXPECT_TRUE(asked(default_plan(Level::kStandard)).contains("random:360:60 4 uniform"));
}

TEST(Depths, AreReadAsTheyAreWritten) {
  for (const char* text :
       {"uniform", "random:7", "random:7:visible", "view", "face0-culled", "all-culled", "file:a:b.txt",
        "after:3:uniform", "after:3:random:7:visible", "after:3:file:a:b.txt"})
    EXPECT_EQ(parse_depths(text).text(), text);
  EXPECT_EQ(parse_depths("random").text(), "random:1");
  for (const char* text : {"", "random:", "random:x", "random:1:", "random:1:seen", "random:-1", "culled",
                           "after:", "after:3", "after:3:", "after:x:uniform", "after:3:after:3:uniform"})
    EXPECT_THROW(parse_depths(text), data::ArgumentError) << text;
}

TEST(Depths, BeforehandAreOtherRequests) {
  EXPECT_TRUE(earlier_depths("random:3", 10, 4, true).empty());
  std::set<std::size_t> lists;
  bool culled = false, unequal = false, all_equal = true;
  for (int seed = 0; seed < 40; ++seed) {
    const std::string depths = "after:" + std::to_string(seed) + ":uniform";
    const auto requests = earlier_depths(depths, 10, 4, true);
    lists.insert(requests.size());
    for (const auto& r : requests) {
      ASSERT_EQ(r.size(), 10U);
      const auto [least, most] = std::minmax_element(r.begin(), r.end());
      EXPECT_TRUE(*least >= -1 && *most <= 4);
      culled = culled || *least < 0, unequal = unequal || *least != *most;
    }
    for (const auto& r : earlier_depths(depths, 10, 4, false))
      all_equal = all_equal && std::count(r.begin(), r.end(), r[0]) == 10 && r[0] >= 0;
  }
  EXPECT_EQ(lists, (std::set<std::size_t>{1, 2, 3}));
  EXPECT_TRUE(culled && unequal && all_equal);
}

TEST(Depths, OfRandomFacesSomeAreCulledUnlessVisible) {
  const data::ControlMesh mesh = data::named_mesh("bumpy:60");
  const auto least = [&](const char* text) {
    const auto depths = face_depths(parse_depths(text), mesh, 3);
    return *std::min_element(depths.begin(), depths.end());
  };
  EXPECT_EQ(least("random:5"), -1);
  EXPECT_EQ(least("random:5:visible"), 0);
}

TEST(Depths, OfAViewCullFacesThatLookAwayAtAnyScale) {
  for (const char* name : {"icosahedron", "tiny-box", "huge-box", "far-box"}) {
    const auto depths = face_depths(parse_depths("view"), data::named_mesh(name), 9);
    const auto culled = std::count(depths.begin(), depths.end(), -1);
    EXPECT_GT(culled, 0) << name;
    EXPECT_LT(culled, static_cast<std::ptrdiff_t>(depths.size())) << name;
  }
  const auto flat = face_depths(parse_depths("view"), data::named_mesh("flat"), 9);
  EXPECT_EQ(std::count(flat.begin(), flat.end(), -1), 0) << "seen from above";
}

}  // namespace
}  // namespace limitcheck::verify
