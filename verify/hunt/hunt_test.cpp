// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "data/io/read.h"
#include "data/validate.h"
#include "verify/evidence/cells.h"
#include "verify/hunt/hunt.h"
#include "verify/subject/lent_mesh.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

const std::vector<data::Scheme> kLoop{data::Scheme::kLoop};

HuntReport hunt(const std::string& options, std::uint64_t cases, const Shard& shard = {}, int attempts = 0,
                const std::string& folder = "") {
  const AuditSubject subject{find_subject("faulty"), options};
  HuntReport report;
  report.subject = subject.label(), report.shard = shard, report.asked = cases;
  HuntReport again = report;  // by way of a journal
  Hunt hunt(subject, HuntPlan(1, schemes_of(subject, kLoop)), {attempts, folder});
  for (std::uint64_t n = 0; n < cases; ++n)
    if (shard.has(n / HuntPlan::kBlock)) again.add_again(report.add(hunt.look(n).value()));
  hunt.shrink_findings(report);
  again.add_again(report.small_meshes());
  EXPECT_EQ(to_json(again), to_json(report));
  EXPECT_EQ(again.kinds, report.kinds);
  report.seconds = 0;
  return report;
}

// The finding of a check with the smallest mesh.
const HuntFinding* smallest(const HuntReport& report, const std::string& check) {
  const HuntFinding* best = nullptr;
  for (const auto& [signature, f] : report.findings)
    if (f.check == check && f.faces > 0 && (best == nullptr || f.faces < best->faces)) best = &f;
  return best;
}

TEST(Hunt, FindsFaultsThatNeedARareNeighbourhoodAndShrinksThem) {
  struct {
    const char* fault;
    std::uint64_t cases;
    std::int64_t faces;  // that its smallest mesh has at most; of a star about one vertex 70
  } const all[]{
      {"adjacent_extraordinary", 32, 8}, {"depth_difference_3", 48, 3}, {"valence_above_40", 192, 70}};
  for (const auto& [fault, cases, faces] : all) {
    const auto folder = std::filesystem::path(testing::TempDir()) / fault;
    const HuntReport report =
        hunt(std::string("of=sliding-window,fault=") + fault, cases, {}, 200, folder.string());
    const HuntFinding* f = smallest(report, "positions");
    ASSERT_NE(f, nullptr) << fault;
    EXPECT_LE(f->faces, faces) << fault << ": " << f->command;
    EXPECT_EQ(static_cast<std::int64_t>(
                  data::read_mesh(std::filesystem::path(f->witness) / "control.obj").faces.size()),
              f->faces);
    std::filesystem::remove_all(folder);
  }
}

TEST(Hunt, FindsNothingWhereNothingIsWrong) {
  const HuntReport report = hunt("of=sliding-window,precision=double,fault=none", 48);
  EXPECT_EQ(report.cases, 48U);
  EXPECT_EQ(report.judged, 48);
  EXPECT_GT(report.kinds.size(), 300U);
  for (const auto& [signature, f] : report.findings) ADD_FAILURE() << signature << ": " << f.found_on;
}

TEST(Hunt, ShardsGiveWhatTheWholeGives) {
  const std::string options = "of=sliding-window,fault=adjacent_extraordinary";
  const HuntReport whole = hunt(options, 64, {}, 20);
  std::vector<HuntReport> parts;
  for (const std::uint64_t k : {2U, 0U, 1U})
    parts.push_back(read_hunt_report(to_json(hunt(options, 64, {k, 3}, 20))));
  EXPECT_EQ(to_json(merged(parts)), to_json(whole));

  std::vector<HuntReport> wrong = parts;
  wrong.pop_back();
  EXPECT_THROW(merged(wrong), data::ArgumentError) << "one is missing";
  wrong.push_back(parts[0]);
  EXPECT_THROW(merged(wrong), data::ArgumentError) << "one is there twice";
  wrong.back() = parts[2], wrong.back().seed = 5;
  EXPECT_THROW(merged(wrong), data::ArgumentError) << "one is of another hunt";
  wrong.back() = parts[2], wrong.back().incomplete = "interrupted by SIGINT";
  EXPECT_THROW(merged(wrong), data::ArgumentError);
  EXPECT_THROW(merged({}), data::ArgumentError);
}

TEST(Hunt, ReportsAreReadAsTheyWereWritten) {
  const HuntReport report = hunt("of=sliding-window,fault=nan_position", 16, {1, 2});
  EXPECT_EQ(to_json(read_hunt_report(to_json(report))), to_json(report));
  for (const char* text :
       {"", "{}", "[]", "{\"program\": \"limitcheck audit\"}", "{\"program\": \"limitcheck hunt\"}"})
    EXPECT_THROW(read_hunt_report(text), data::ArgumentError) << text;
  std::string no_list = to_json(hunt("of=sliding-window,fault=none", 1));
  no_list = "{" + no_list.substr(no_list.find(',') + 1);  // its digest may lack
  EXPECT_NO_THROW((void)read_hunt_report(no_list));
  no_list.replace(no_list.find("\"findings\": []"), 14, "\"findings\": null");
  EXPECT_THROW(read_hunt_report(no_list), data::ArgumentError) << "is no empty baseline";
}

TEST(LikelyCause, IsWhatProgramsCanTellApart) {
  const auto words = [](const char* name, std::int64_t face, std::vector<std::int32_t> depth = {}) {
    AuditMesh m{name, data::named_mesh(name)};
    m.face_depth = std::move(depth);
    Result r{.scheme = m.scheme()};
    if (face >= 0) r.witness = Witness{face};
    return likely_cause(r, m).words();
  };
  EXPECT_EQ(words("octahedron", -1), "");
  EXPECT_EQ(words("torus", 5), "regular");
  EXPECT_EQ(words("octahedron", 0), "inner vertex of 4 faces, beside another extraordinary one");
  EXPECT_EQ(words("bipyramid:50", 0), "inner vertex of more than 40 faces, beside another extraordinary one");
  EXPECT_EQ(words("bipyramid:6", 0, {3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}),
            "inner vertex of 4 faces, beside another extraordinary one; depths differ by 3");
  EXPECT_EQ(words("triangle", 0), "boundary vertex of 1 face, beside another extraordinary one");
  EXPECT_EQ(words("quad-torus", 3), "regular");
  EXPECT_EQ(words("prism:5", 0), words("prism:5", 1)) << "both are the faces of five corners";
  EXPECT_EQ(words("dart:6", 0), "dart of 6 faces, beside another extraordinary one");
  EXPECT_EQ(words("corner:3", 0), "corner of 6 faces, beside another extraordinary one");
}

TEST(LikelyCause, CoversThoseThatHaveAllOfItAndMore) {
  const LikelyCause regular{"regular", "", 0, false, 0}, unequal{"regular", "", 0, false, 2};
  const LikelyCause five{"inner vertex", "5", 1, false, 0}, seven{"inner vertex", "7", 1, false, 0};
  const LikelyCause many{"inner vertex", "more than 40", 3, true, 1}, dart{"dart", "5", 1, false, 0};
  EXPECT_TRUE(regular.covers(unequal) && regular.covers(five) && regular.covers(dart) && five.covers(many));
  EXPECT_FALSE(unequal.covers(regular) || unequal.covers(five) || five.covers(seven) || seven.covers(five) ||
               five.covers(dart) || many.covers(five) || five.covers(five) || regular.covers({}) ||
               LikelyCause{}.covers(regular));
  const std::vector<LikelyCause> all{regular, unequal, five, seven, many, dart};
  for (const LikelyCause& a : all)
    for (const LikelyCause& b : all)
      if (a.covers(b)) {
        EXPECT_LT(a.level(), b.level()) << a.words() << " / " << b.words();
      }
}

TEST(LikelyCause, IsThatOfTheNearestExtraordinaryCorner) {
  const auto near = [](const char* name, std::int64_t face, const char* u, const char* v, int corner = -1) {
    const AuditMesh m{name, data::named_mesh(name)};
    Result r{.scheme = m.scheme(), .witness = Witness{face, u, v}};
    r.witness->corner = corner;
    return likely_cause(r, m).words();
  };
  // bipyramid:9 has apices of 9 faces and an equator of 4.
  std::set<std::string> all;
  for (const auto& [u, v] : {std::pair{"0", "0"}, std::pair{"1", "0"}, std::pair{"0", "7/8"}})
    all.insert(near("bipyramid:9", 0, u, v));
  EXPECT_EQ(all, (std::set<std::string>{"inner vertex of 8 to 40 faces, beside another extraordinary one",
                                        "inner vertex of 4 faces, beside another extraordinary one"}));
  EXPECT_EQ(near("prism:7", 0, "3/4", "3/4", 2), "face of 7 corners, beside another extraordinary one");
  EXPECT_EQ(near("prism:7", 0, "1/8", "0", 2), "inner vertex of 3 faces, beside another extraordinary one");
}

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
