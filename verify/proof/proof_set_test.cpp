// SPDX-License-Identifier: MIT
// The sets hold what they say: topologies are counted by other means, and what was not done is not claimed.
// What refutes a proof: each figure of a report by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "data/test_support/assertions.h"
#include "verify/proof/proof_set.h"

namespace limitcheck::verify {
namespace {

using Valences = std::array<int, 4>;

const ProofSet& full_set() {
  static const ProofSet set = [] {
    ProofRequest request{.size = ProofSize::kFull};
    return proof_set(request);
  }();
  return set;
}

std::vector<const ProofTask*> tasks_of(const ProofSet& set, const std::string& group, Arithmetic arithmetic) {
  std::vector<const ProofTask*> found;
  for (const ProofTask& task : set.tasks)
    if (task.group == group && task.options.arithmetic == arithmetic) found.push_back(&task);
  return found;
}

Valences valences_of(const ProofTask& task) {
  Valences v{};
  std::istringstream(task.neighbourhood.name) >> v[0] >> v[1] >> v[2] >> v[3];
  return v;
}

// Else source_faults.sh, which takes long and is run by hand, plants fewer faults than the list has.
TEST(Proof_SourceFaults, AreInTextThatIsThere) {
  const std::filesystem::path root = LIMITCHECK_SOURCE_DIR;
  std::istringstream list(contents_of(root / "verify/proof/source_faults.txt"));
  int faults = 0;
  for (std::string line; std::getline(list, line);) {
    if (line.empty() || line.front() == '#') continue;
    const std::size_t text = line.find(" | ") + 3, end = line.find(" | ", text);
    ASSERT_NE(end, std::string::npos) << line;
    EXPECT_TRUE(says(contents_of(root / line.substr(0, text - 3)), line.substr(text, end - text))) << line;
    ++faults;
  }
  EXPECT_GT(faults, 0);
}

// Of ten valences there are C(12, 3) = 220 triples in any order, and 55 * 10 with one corner apart from the
// other two, which lie on the diagonal. A face with 3 3 n, n > 3, cannot be: 9 triples, each with the 3s on
// the diagonal or one of them apart.
TEST(Proof_Set, HoldsEveryTripleWithEachOfItsCornersApart) {
  const ProofSet standard = proof_set({});
  for (const ProofSet* set : {&full_set(), &standard}) {
    EXPECT_EQ(set->impossible.size(), 9U);
    for (const auto& [group, arithmetic] : {std::pair{"triples", Arithmetic::kResidues},
                                            {"deep", Arithmetic::kResidues},
                                            {"digits", Arithmetic::kDigits}}) {
      std::set<std::array<int, 3>> whole, apart;
      for (const ProofTask* task : tasks_of(*set, group, arithmetic)) {
        const Valences v = valences_of(*task);
        for (const int d : {v[1], v[3]}) {
          apart.insert({std::min(v[0], v[2]), std::max(v[0], v[2]), d});
          std::array<int, 3> triple{v[0], v[2], d};
          std::ranges::sort(triple);
          whole.insert(triple);
        }
      }
      EXPECT_EQ(whole.size(), 220U - 9) << group;
      if (group == std::string("triples")) {
        EXPECT_EQ(apart.size(), 550U - 2 * 9);
      }
    }
  }
}

// Counted from the edges of the sphere, without half-edges or signatures.
std::set<Valences> pairs_by_edges(const data::ControlMesh& mesh) {
  std::map<std::int32_t, int> valence;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> apex;  // left of the directed edge
  for (const auto& [a, b, c] : triangles_of(mesh)) {
    for (const auto v : {a, b, c}) ++valence[v];  // closed: as many faces as neighbours
    apex[{a, b}] = c, apex[{b, c}] = a, apex[{c, a}] = b;
  }
  std::set<Valences> pairs;
  for (const auto& [edge, d] : apex) {
    const auto& [a, c] = edge;
    pairs.insert({valence[a], valence[apex.at({c, a})], valence[c], valence[d]});
  }
  return pairs;
}

TEST(Proof_Set, HoldsEveryPairOfTheBumpySpheres) {
  const ProofSet standard = proof_set({});
  for (const ProofSize size : {ProofSize::kStandard, ProofSize::kFull}) {
    std::set<Valences> expected;
    for (const int faces : size == ProofSize::kFull ? std::vector{200, 800, 2000, 4000} : std::vector{200})
      expected.merge(pairs_by_edges(data::bumpy_sphere(faces, 1)));
    std::set<Valences> found;
    const ProofSet& set = size == ProofSize::kFull ? full_set() : standard;
    const auto tasks = tasks_of(set, "spheres", Arithmetic::kResidues);
    for (const ProofTask* task : tasks) found.insert(valences_of(*task));
    EXPECT_EQ(found, expected);
    EXPECT_EQ(tasks.size(), expected.size()) << "each once";
  }
}

// Around a pair of regular faces lie 6 + 6 + 6 + 6 - 10 = 14 others, four of them beside the pair's edges,
// with 2, 3, 2 and 3 between those. Taken away is a run of 1 .. 13 of them (14 * 13 ways), any of the four
// beside the edges, or all. What is left of a run touches the pair at a vertex alone if it lies between two
// of the four (3 + 6 + 3 + 6 runs): then the pair's fans are those of the pair alone. Of the sets of the four
// only two opposite ones (2 ways) leave other fans than a run or nothing.
TEST(Proof_Set, HoldsEveryWayToTakeFacesAwayAroundTheRegularPair) {
  const ProofSet& set = full_set();
  const auto tasks = tasks_of(set, "boundary-deep", Arithmetic::kResidues);
  std::set<std::string> names;
  for (const ProofTask* task : tasks) names.insert(task->neighbourhood.name);
  EXPECT_EQ(names.size(), tasks.size());
  EXPECT_EQ(names.size(), 14U * 13 - (3 + 6 + 3 + 6) + 1 + 2);
  for (const ProofTask* task : tasks_of(set, "boundary", Arithmetic::kResidues))
    names.erase(task->neighbourhood.name);
  EXPECT_TRUE(names.empty()) << "the shallow group holds them, too";
}

TEST(Proof_Set, OfASampleHasEveryTenthOfEachGroupAndArithmetic) {
  for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark}) {
    ProofRequest request{.scheme = scheme, .valences = {3, 4, 5}};
    std::map<std::pair<std::string, Arithmetic>, std::vector<std::string>> standard, sample;
    for (const ProofTask& task : proof_set(request).tasks)
      standard[{task.group, task.options.arithmetic}].push_back(task.neighbourhood.name);
    request.size = ProofSize::kSample;
    for (const ProofTask& task : proof_set(request).tasks)
      sample[{task.group, task.options.arithmetic}].push_back(task.neighbourhood.name);
    ASSERT_EQ(sample.size(), standard.size()) << "no group is left out";
    for (const auto& [group, names] : standard) {
      std::vector<std::string> expected;
      for (std::size_t k = 0; k < names.size(); k += 10) expected.push_back(names[k]);
      EXPECT_EQ(sample[group], expected) << group.first;
    }
  }
}

TEST(Proof_Set, HoldsHighValencesAndTheFaceAlone) {
  const ProofSet& set = full_set();
  EXPECT_EQ(tasks_of(set, "high", Arithmetic::kResidues).size(), 3U * 4);
  for (const Arithmetic a : {Arithmetic::kResidues, Arithmetic::kDigits, Arithmetic::kExact})
    EXPECT_EQ(tasks_of(set, "alone", a).size(), 1U);
}

// "every topology to depth 6, with bounds to depth 6 or 4": what the table and --help say of the full set.
TEST(Proof_Set, GoesToDepthSixWithEveryTopology) {
  const ProofSet& set = full_set();
  std::map<std::string, int> deepest, bounds;
  for (const ProofTask& task : set.tasks) {
    const auto note = [&](std::map<std::string, int>& list, int depth) {
      int& d = list[task.neighbourhood.name];
      d = std::max(d, depth);
    };
    if (task.options.arithmetic == Arithmetic::kExact) continue;  // those of the triples
    note(deepest, task.options.last_depth);
    note(bounds, task.bounds ? task.bounds->last_depth : -1);
  }
  for (const auto& [name, depth] : deepest) EXPECT_EQ(depth, 6) << name;
  for (const auto& [name, depth] : bounds) EXPECT_GE(depth, 4) << name;
}

TEST(Proof_Set, IsReportedAsStoppedWhereItWas) {
  ProofRequest request{.valences = {6}, .depth = 0};
  ProofSet set = proof_set(request);
  set.tasks.resize(6);
  std::atomic<std::size_t> done = 0;  // it is asked by any thread whether to stop
  const auto rows = prove(
      set.tasks, [&](const ProofProgress& progress) { done = progress.tasks; }, [&] { return done >= 2; });
  const auto proved = std::ranges::count_if(rows, [](const auto& r) { return !r.empty(); });
  EXPECT_GE(proved, 2);
  EXPECT_LT(proved, 6);
  EXPECT_FALSE(rows.front().empty()) << "begun in order";
  const ProofReport report(set, rows);
  EXPECT_TRUE(report.held());
  EXPECT_FALSE(report.complete());
  EXPECT_TRUE(says(report.table(false), "STOPPED"));
  EXPECT_FALSE(nlohmann::json::parse(report.json())["complete"].get<bool>());
}

/// A proof of one row, and one mesh compared with the true surface.
struct Proof {
  Proof() {
    set.tasks.resize(1);
    set.certified = {{"icosahedron", "row-stream", 4, {}}};
    certified = set.certified;
    certified[0].errors = {12, 1e-7, .001, 1e-20, 0, "0", "0", 0, 1, 2, 1e-7};
    ProofRow row;
    row.kernel = "row-stream";
    row.map.equal = true;
    row.bound.emplace();
    row.bound->position_bound = 2e-7, row.bound->product_bound = 2e-5, row.bound->share = .5;
    row.bound->shipped = {.5, .5, "avx2 scalar", ""};
    rows = {{row}};
  }
  ProofReport report() const { return {set, rows, certified}; }
  BoundProof& bound() { return *rows[0][0].bound; }
  CertifiedErrors& errors() { return certified[0].errors; }

  ProofSet set;
  std::vector<std::vector<ProofRow>> rows;
  std::vector<CertifiedLine> certified;
};

TEST(Proof_Report, HoldsWithAllOfIt) {
  const Proof proof;
  EXPECT_TRUE(proof.report().held());
  EXPECT_TRUE(proof.report().complete());
  const auto line = nlohmann::json::parse(proof.report().json())["certified"][0];
  // sqrt(3) (1.02 * 2e-7 + 2^-24) of a unit that is the diagonal; asin(1.02 * 2e-5 * 2 + 1e-7) + 2^-23.
  EXPECT_NEAR(line["position_bound"].get<double>(), 4.566e-7, 1e-10);
  EXPECT_NEAR(line["normal_bound"].get<double>(), .0023502, 1e-6);
}

TEST(Proof_Report, IsRefutedByEachOfItsFigures) {
  const std::vector<std::function<void(Proof&)>> faults{
      [](Proof& p) { p.rows[0][0].map.equal = false; },
      [](Proof& p) { p.bound().share = 1.01; },
      [](Proof& p) { p.bound().share = std::nan(""); },
      [](Proof& p) { p.bound().alike = false; },
      [](Proof& p) { p.bound().shipped.position_share = 1.01; },
      [](Proof& p) { p.bound().shipped.normal_share = std::numeric_limits<double>::infinity(); },
      [](Proof& p) { p.bound().shipped.unlike = "avx2"; },
      [](Proof& p) { p.errors().position = .5; },
      [](Proof& p) { p.errors().position = 5e-7; },
      [](Proof& p) { p.errors().position = std::nan(""); },
      [](Proof& p) { p.errors().normal = .0024; },
      [](Proof& p) { p.errors().normal = 30; }};
  for (std::size_t k = 0; k < faults.size(); ++k) {
    Proof proof;
    faults[k](proof);
    EXPECT_FALSE(proof.report().held()) << k;
    EXPECT_FALSE(nlohmann::json::parse(proof.report().json())["held"].get<bool>()) << k;
    EXPECT_TRUE(says(proof.report().table(false), "FAILED")) << k;
  }
}

TEST(Proof_Report, WithoutCertifiedLinesIsNotComplete) {
  const std::vector<std::function<void(Proof&)>> omissions{
      [](Proof& p) { p.certified.clear(); }, [](Proof& p) { p.certified[0].mesh = "cube"; },
      [](Proof& p) { p.certified[0].depth = 0; }, [](Proof& p) { p.errors().points = 0; }};
  for (std::size_t k = 0; k < omissions.size(); ++k) {
    Proof proof;
    omissions[k](proof);
    EXPECT_FALSE(proof.report().complete()) << k;
    EXPECT_TRUE(says(proof.report().table(false), "STOPPED")) << k;
  }
}

TEST(Proof_Report, ComparesNothingBeforeAllRowsAreThere) {
  Proof proof;
  proof.errors().position = .5;
  proof.rows.emplace_back();
  proof.set.tasks.resize(2);
  EXPECT_TRUE(proof.report().held());
  EXPECT_FALSE(proof.report().complete());
  EXPECT_TRUE(nlohmann::json::parse(proof.report().json())["certified"][0]["position_bound"].is_null());
}

}  // namespace
}  // namespace limitcheck::verify
