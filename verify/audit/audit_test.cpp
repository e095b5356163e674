// SPDX-License-Identifier: MIT
// The auditor audited: good subjects hold, every planted fault turns the checks red that are meant to see it, a
// subject that refuses or crashes in an orderly way is a row, and a signal ends an audit whatever it is at.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <map>
#include <semaphore>
#include <set>
#include <thread>

#include "data/generators/named_mesh.h"
#include "data/shapes.h"
#include "verify/audit/audit.h"
#include "verify/checks/checks.h"
#include "verify/interrupt/interrupt.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/row/commands.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

const char* const kBase = "opensubdiv-far";  // right at lattice points of a closed mesh, in double
const char* const kBaseOptions = "precision=double";

std::vector<Result> run(const lc_subject* subject, const std::string& options, const std::string& mesh,
                        int depth) {
  return Auditor(depth, 1).run({subject, options}, {mesh, data::named_mesh(mesh)});
}

std::set<std::string> red(const std::vector<Result>& results) {
  std::set<std::string> names;
  for (const Result& r : results)
    if (is_bad(r)) names.insert(r.check);
  return names;
}

std::string describe(const std::vector<Result>& results) {
  std::string out;
  for (const Result& r : results)
    out += fmt::format("{}: {} {}/{} {}\n", r.check, word(r.status), r.bad, r.of, r.message);
  return out;
}

TEST(Audit, AGoodSubjectHoldsOnAClosedMeshInEveryCheck) {
  for (const char* mesh : {"bumpy:200", "tetrahedron", "bipyramid:7", "torus"}) {
    const auto results = run(find_subject(kBase), kBaseOptions, mesh, 3);
    EXPECT_TRUE(red(results).empty()) << mesh << "\n" << describe(results);
    EXPECT_EQ(row(results, "positions").status, Status::kHeld);
    EXPECT_EQ(row(results, "normals").status, Status::kHeld);
    RecordProperty(fmt::format("worst_position_{}", mesh),
                   fmt::format("{:.2e}", row(results, "positions").worst.value_or(-1)));
  }
}

std::array<std::atomic<int>, 2> inside;  // requests that each of two subjects is at
std::atomic<int> most_inside = 0;
std::atomic<bool> both_inside = false;

// The naive subject, which stays at a request until the other is at one, too.
template <std::size_t Which>
lc_subject watched() {
  lc_subject subject = *find_subject("naive");
  subject.name = Which == 0 ? "one" : "other";
  subject.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out,
                          const char** message) {
    most_inside = std::max(most_inside.load(), ++inside[Which]);
    static const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (!both_inside && std::chrono::steady_clock::now() < until) {
      if (inside[1 - Which] > 0) both_inside = true;
      std::this_thread::yield();
    }
    const lc_status status = find_subject("naive")->tessellate(instance, request, out, message);
    --inside[Which];
    return status;
  };
  return subject;
}

TEST(Audit, AsksDifferentSubjectsAtATimeAndEachOneThing) {
  const lc_subject one = watched<0>(), other = watched<1>();
  std::vector<AuditMesh> meshes;
  for (const char* name : {"octahedron", "tetrahedron", "icosahedron", "bumpy:20", "torus"})
    meshes.push_back({name, data::named_mesh(name)});
  const auto results =
      Auditor(1, 4).run(std::vector<AuditSubject>{{&one, ""}, {&other, ""}, {&one, ""}}, meshes);
  EXPECT_TRUE(both_inside);
  EXPECT_EQ(most_inside, 1);
  std::size_t at = 0;
  for (const char* subject : {"one", "other", "one"})
    for (const AuditMesh& mesh : meshes)
      for (const std::string& check : Auditor(1, 1).row_names({&one, ""}, mesh)) {
        ASSERT_LT(at, results.size());
        EXPECT_EQ(results[at].subject, subject);
        EXPECT_EQ(results[at].mesh, mesh.name);
        EXPECT_EQ(results[at++].check, check);
      }
}

TEST(Audit, HolesAreNotShownAndShapeTheirNeighbours) {
  AuditMesh mesh{"bumpy:60", data::named_mesh("bumpy:60")};
  mesh.mesh.holes = {3, 17, 18};
  const auto results = Auditor(2, 1).run({find_subject("naive"), ""}, mesh);
  EXPECT_TRUE(red(results).empty()) << describe(results);
  EXPECT_EQ(row(results, "coverage").status, Status::kHeld);
  EXPECT_EQ(row(results, "positions").status, Status::kHeld) << "on the surface of the whole mesh";
  // Whoever takes one depth for all faces has no holes.
  EXPECT_EQ(row(Auditor(2, 1).run({find_subject(kBase), kBaseOptions}, mesh), "tessellates").status,
            Status::kNotSupported);
}

// Its box has no diagonal: errors are fractions of the coordinates, or as they are.
TEST(Audit, AMeshThatIsOnePointBlamesNoSoundSubjectAndSeesAWrongMask) {
  AuditMesh mesh{"one point", data::named_mesh("bumpy:20")};
  for (const Vector& point : {Vector{0, 0, 0}, Vector{5, -3, .1}}) {
    for (Vector& p : mesh.mesh.positions) p = point;
    for (const char* subject : {"row-stream", "sliding-window", "naive"}) {
      const auto results = Auditor(3, 1).run({find_subject(subject), ""}, mesh);
      EXPECT_TRUE(red(results).empty()) << subject << '\n' << describe(results);
      for (const char* check : {"positions", "continuity"})
        EXPECT_EQ(row(results, check).status, Status::kHeld) << subject << ' ' << check;
    }
  }
  const auto results =
      Auditor(3, 1).run({lc_subject_faulty(), faulty_options("wrong_edge_mask", kBase, kBaseOptions)}, mesh);
  EXPECT_EQ(row(results, "positions").status, Status::kFinding) << describe(results);
}

// The faults that can be planted in any mesh.
std::vector<std::string> planted() {
  std::vector<std::string> names;
  for (const Fault& f : faults())
    if (f.name != "none" && !f.on_some_meshes) names.push_back(f.name);
  return names;
}

// Which checks must report which fault, if not the one alone that is meant for it. (verify/mutants tests that the default
// audit finds each by that.) A fault may turn more of them red (a shifted provenance spoils nearly everything), so
// these are the ones whose business it is.
const std::map<std::string, std::vector<std::string>> kSeenBy{
    {"unmoved_vertices", {"positions"}},
    {"unwritten_triangle", {"written", "coverage", "watertight"}},
    {"flipped_normals", {"normals", "normals-against-positions"}},
    {"shifted_provenance", {"positions", "coverage"}},
    {"mirrored_provenance", {"positions", "orientation"}},
    {"swapped_points", {"positions", "orientation"}},
    {"provenance_out_of_range", {"written", "coverage"}},
    {"one_flipped_triangle", {"orientation", "watertight"}},
    {"missing_triangle", {"coverage", "watertight"}},
    {"duplicated_triangle", {"coverage", "watertight"}},
    {"index_out_of_range", {"written", "coverage", "watertight"}},
    {"t_vertex", {"t-vertices", "coverage", "watertight"}},
    {"one_ulp_crack", {"shared-positions", "watertight"}}};

class PlantedFault : public testing::TestWithParam<std::string> {};

TEST_P(PlantedFault, IsSeenByTheChecksWhoseBusinessItIs) {
  const auto results =
      run(lc_subject_faulty(), faulty_options(GetParam(), kBase, kBaseOptions), "bumpy:60", 2);
  const auto fault =
      std::find_if(faults().begin(), faults().end(), [](const Fault& f) { return f.name == GetParam(); });
  const auto others = kSeenBy.find(fault->name);
  const std::set<std::string> names = red(results);
  for (const std::string& check :
       others == kSeenBy.end() ? std::vector<std::string>{fault->check} : others->second)
    EXPECT_TRUE(names.contains(check)) << check << " did not see it:\n" << describe(results);
  for (const Result& r : results) {
    EXPECT_NE(r.status, Status::kError) << r.check << ": " << r.message;
    if (r.status == Status::kFinding) {
      EXPECT_GT(r.bad, 0) << r.check;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, PlantedFault, testing::ValuesIn(planted()),
                         [](const auto& instance) { return instance.param; });

TEST(PlantedFaults, APerfectCopyOfAGoodSubjectHolds) {
  const auto results = run(lc_subject_faulty(), faulty_options("none", kBase, kBaseOptions), "bumpy:60", 2);
  EXPECT_TRUE(red(results).empty()) << describe(results);
}

TEST(PlantedFaults, TheWitnessNamesThePointAndTheCommandThatRecomputesIt) {
  const auto results =
      run(lc_subject_faulty(), faulty_options("wrong_limit_mask", kBase, kBaseOptions), "bumpy:60", 2);
  const Result& r = row(results, "positions");
  ASSERT_TRUE(r.witness.has_value());
  ASSERT_EQ(r.witness->expected.size(), 3U);
  ASSERT_EQ(r.witness->got.size(), 3U);
  EXPECT_NE(r.witness->expected, r.witness->got);
  // The fault is at control vertices, which are corners.
  for (const std::string& l : {r.witness->l1, r.witness->l2}) EXPECT_TRUE(l == "0" || l == "1") << l;
  EXPECT_EQ(eval_command(r),
            fmt::format("limitcheck eval bumpy:60 {} {} {}{}", r.witness->face, r.witness->l1, r.witness->l2,
                        r.precision == LC_FLOAT32 ? " --precision float" : ""));
}

TEST(Audit, TheNullSubjectFailsCleanly) {
  const auto results = run(lc_subject_null(), "", "tetrahedron", 1);
  EXPECT_FALSE(red(results).empty()) << describe(results);
  for (const Result& r : results)
    EXPECT_TRUE(r.check == "tessellates" || r.status != Status::kHeld)
        << r.check << " held with nothing to look at";
}

TEST(Audit, ASubjectThatRefusesIsARowAndNothingElseIsConfirmed) {
  const auto results = run(find_subject(kBase), "no-such-option=1", "tetrahedron", 1);
  EXPECT_EQ(row(results, "tessellates").status, Status::kFinding);
  EXPECT_FALSE(row(results, "tessellates").message.empty());
  std::size_t rows = 1;
  for (const Check& check : checks()) rows += has_matter(check, data::tetrahedron()) ? check.rows.size() : 0;
  EXPECT_EQ(results.size(), rows);
  for (const Result& r : results)
    EXPECT_TRUE(r.check == "tessellates" || r.status == Status::kNotRun) << r.check;
}

TEST(Audit, TheBoundaryOfTheControlMeshIsTheOnlyBoundaryAllowed) {
  for (const char* mesh : {"fan:1", "strip:3", "holes", "triangle", "two-components"}) {
    const auto results = run(find_subject(kBase), kBaseOptions, mesh, 2);
    EXPECT_EQ(row(results, "watertight").status, Status::kHeld) << mesh << "\n" << describe(results);
    EXPECT_EQ(row(results, "coverage").status, Status::kHeld) << mesh << "\n" << describe(results);
  }
}

// The recursive subdivider does nothing about cracks, so it shows what differing depths do without.
TEST(Audit, DifferingDepthsWithoutRepairAreTiledButNotTight) {
  AuditMesh mesh{"bumpy:60", data::named_mesh("bumpy:60")};
  for (std::size_t f = 0; f < mesh.mesh.faces.size(); ++f)
    mesh.face_depth.push_back(static_cast<std::int32_t>(f % 4));
  const auto results = Auditor(3, 1).run({find_subject("naive"), ""}, mesh);
  EXPECT_EQ(row(results, "positions").status, Status::kHeld) << describe(results);
  EXPECT_EQ(row(results, "coverage").status, Status::kHeld) << describe(results);
  EXPECT_EQ(row(results, "orientation").status, Status::kHeld) << describe(results);
  EXPECT_EQ(row(results, "watertight").status, Status::kFinding) << describe(results);
  EXPECT_EQ(row(results, "t-vertices").status, Status::kFinding) << describe(results);
}

TEST(Audit, TheRimOfCulledFacesIsABoundaryThatIsAllowed) {
  const AuditMesh mesh{"tetrahedron",
                       data::named_mesh("tetrahedron"),  // bit-symmetric: the naive points do agree
                       {2, -1, 2, 2}};
  const auto results = Auditor(2, 1).run({find_subject("naive"), ""}, mesh);
  for (const char* check : {"coverage", "watertight", "positions"})
    EXPECT_EQ(row(results, check).status, Status::kHeld) << describe(results);
}

TEST(Audit, VisibleFacesThatMeetInAPointOnlyAreNoFault) {
  const data::ControlMesh cage = data::named_mesh("icosahedron");
  const auto& first = triangles_of(cage)[0];
  const std::int32_t pole = first[0];
  const auto common = [&](const std::array<std::int32_t, 3>& t) {
    return std::count_if(t.begin(), t.end(), [&](std::int32_t v) {
      return std::find(first.begin(), first.end(), v) != first.end();
    });
  };
  std::vector<std::int32_t> depth(cage.faces.size(), 2);
  int across = 0;  // the faces at the pole: one stays besides the first, which shares nothing else with it
  for (std::size_t f = 1; f < depth.size(); ++f) {
    const auto& t = triangles_of(cage)[f];
    if (std::count(t.begin(), t.end(), pole) == 0) continue;
    if (common(t) > 1 || across++ > 0) depth[f] = -1;
  }
  ASSERT_EQ(across, 2);
  const auto results = Auditor(2, 1).run({find_subject("sliding-window"), ""}, {"icosahedron", cage, depth});
  EXPECT_TRUE(red(results).empty()) << describe(results);
}

TEST(Audit, OfRandomFacesCulledAndRandomDepthsOurEngineShowsExactlyTheOutline) {
  for (const char* name : {"bumpy:60", "octahedron", "holes", "wheel:9"}) {
    AuditMesh mesh{name, data::named_mesh(name)};
    std::uint32_t state = 1;
    for (int round = 0; round < 20; ++round) {
      mesh.face_depth.clear();
      for (std::size_t f = 0; f < mesh.mesh.faces.size(); ++f) {
        state = state * 1664525U + 1013904223U;
        mesh.face_depth.push_back(static_cast<std::int32_t>((state >> 24) % 5) - 1);
      }
      const auto results = Auditor(3, 1).run({find_subject("sliding-window"), ""}, mesh);
      EXPECT_TRUE(red(results).empty()) << name << " round " << round << "\n" << describe(results);
    }
  }
}

TEST(Audit, ResultsDoNotDependOnThreads) {
  const AuditMesh mesh{"bumpy:200", data::named_mesh("bumpy:200")};
  const auto one = Auditor(3, 1).run({find_subject(kBase), ""}, mesh);
  const auto four = Auditor(3, 4).run({find_subject(kBase), ""}, mesh);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].worst, four[k].worst) << one[k].check;
    EXPECT_EQ(one[k].rms, four[k].rms) << one[k].check;
    EXPECT_EQ(one[k].bad, four[k].bad) << one[k].check;
    EXPECT_EQ(one[k].message, four[k].message) << one[k].check;
  }
}

TEST(Interrupt, KeepsWhatWasDoneAndSaysWhatWasNot) {
  const InterruptGuard guard;
  Auditor auditor(2, 1, [](const AuditStep& step) {
    if (step.mesh == "icosahedron" && step.check == "normals") raise(SIGTERM);
  });
  const auto results = auditor.run(
      {{find_subject("naive"), ""}},
      {{"tetrahedron", data::tetrahedron()}, {"icosahedron", data::icosahedron()}, {"cube", data::cube()}});
  EXPECT_TRUE(auditor.gave_up());
  std::map<std::string, std::map<Status, int>> count;
  for (const Result& r : results) {
    ++count[r.mesh][r.status];
    if (r.mesh == "icosahedron" && (r.check == "positions" || r.check == "normals")) {
      EXPECT_EQ(r.status, Status::kHeld) << r.check << ": what was begun is ended";
    }
    if (r.status == Status::kNotRun) {
      EXPECT_EQ(r.message, "interrupted") << r.mesh << " " << r.check;
    }
  }
  EXPECT_EQ(count["tetrahedron"][Status::kNotRun], 0);
  EXPECT_GT(count["icosahedron"][Status::kNotRun], 3);
  EXPECT_EQ(count["cube"][Status::kHeld], 0);
  const auto each =
      std::count_if(results.begin(), results.end(), [](const Result& r) { return r.mesh == "icosahedron"; });
  EXPECT_GT(each, 10) << "a row for each check of the mesh that was begun";
  EXPECT_EQ(count["cube"][Status::kNotRun], 1) << "one row for all of what was not begun";
}

// Signals, and never answers.
lc_status hang(void*, const lc_request*, lc_tessellation*, const char**) {
  raise(SIGTERM);
  std::binary_semaphore never(0);
  never.acquire();
  return LC_FAILED;
}

// In a process of its own, since what is left uses what stands here.
[[noreturn]] void audit_and_leave() {
  lc_subject subject = *find_subject("naive");
  subject.tessellate = hang;
  const InterruptGuard guard;
  Auditor auditor(1, 1);
  auditor.leave_what_is_interrupted();
  const std::vector<AuditSubject> subjects{{&subject, ""}};
  const std::vector<AuditMesh> meshes{{"icosahedron", data::named_mesh("icosahedron")},
                                      {"octahedron", data::named_mesh("octahedron")}};
  const std::vector<Result> results = auditor.run(subjects, meshes);
  const bool told = std::all_of(results.begin(), results.end(), [](const Result& r) {
    return r.status == Status::kNotRun && r.message == "interrupted";
  });
  leave(told && results.size() > 10 && auditor.gave_up() && auditor.abandoned() ? 42 : 1, 2);
}

TEST(AbandonedAudit, HasARowForEachCheckOfWhatWasBegun) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(audit_and_leave(), testing::ExitedWithCode(42), "");
}

}  // namespace

}  // namespace limitcheck::verify
