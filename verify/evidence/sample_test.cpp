// SPDX-License-Identifier: MIT
// A sample of a mesh is judged as the whole would be: same surface, same verdicts, faults found where they
// are.
#include "verify/evidence/audit_case.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "data/generators/named_mesh.h"
#include "data/splitmix64.h"
#include "data/validate.h"
#include "reference/loop/stam.h"
#include "reference/mesh/topology.h"
#include "verify/audit/audit.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

const char* const kSampledMeshes[] = {"bumpy:800", "holes",    "ragged-disc", "wheel:50",
                                      "torus",     "random:3", "random:4",    "tetrahedron"};

TEST(MeshSample, IsAValidMeshWithAtLeastTheFacesAskedFor) {
  for (const char* name : kSampledMeshes)
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
      for (const std::size_t faces : {1U, 10U, 100U, 100000U}) {
        const data::ControlMesh whole = data::named_mesh(name);
        const MeshSample sample(whole, faces, seed);
        const auto findings = data::validate(sample.part());
        ASSERT_TRUE(findings.empty()) << name << " " << seed << ": " << findings[0].message;
        const auto depth = sample.cull(std::vector<std::int32_t>(whole.faces.size(), 2));
        const auto visible = std::count(depth.begin(), depth.end(), 2);
        EXPECT_GE(static_cast<std::size_t>(visible), std::min(faces, whole.faces.size()));
        const auto part = sample.depths_of_part(depth);
        EXPECT_EQ(std::count(part.begin(), part.end(), 2), visible) << "every visible face is in the part";
      }
}

// The largest difference of a coordinate over the faces that are looked at.
double apart(const data::ControlMesh& whole, const MeshSample& sample) {
  const auto depth = sample.cull(std::vector<std::int32_t>(whole.faces.size(), 0));
  const reference::StamEvaluator<double> of_whole(whole), of_part(sample.part());
  double worst = 0;
  for (std::size_t p = 0; p < sample.faces().size(); ++p) {
    const std::int32_t f = sample.faces()[p];
    EXPECT_EQ(sample.part_of()[f], static_cast<std::int32_t>(p));
    if (depth[f] < 0) continue;
    for (const auto& [l1, l2] : {std::pair(0., 0.), {1., 0.}, {0., 1.}, {.5, .5}, {.25, .125}, {.9, .05}}) {
      const auto a = of_whole.evaluate(f, l1, l2, reference::Order::kPosition).position;
      const auto b = of_part.evaluate(static_cast<int>(p), l1, l2, reference::Order::kPosition).position;
      worst = std::max({worst, std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
    }
  }
  return worst;
}
// Rings may start elsewhere, so sums run in another order: some roundings of coordinates below 8.
constexpr double kRoundings = 64 * 0x1p-53 * 8;

TEST(MeshSample, HasTheSurfaceOfTheWholeOverItsPatches) {
  for (const char* name : kSampledMeshes) {
    const data::ControlMesh whole = data::named_mesh(name);
    const double worst = apart(whole, MeshSample(whole, 20, 7));
    EXPECT_LE(worst, kRoundings) << name;
    RecordProperty(fmt::format("worst_{}", name), fmt::format("{:.2e}", worst));
  }
}

TEST(MeshSample, HasTheSurfaceOfTheWholeByChaikinsCreasingToo) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    data::ControlMesh whole = data::named_mesh("torus");
    data::SplitMix64 random(seed);
    const reference::Topology topology(whole.positions.size(), whole.faces);
    for (const reference::Edge& e : topology.edges())  // a third of them below 1
      if (random.next() % 2 == 0)
        whole.sharpness.edges.push_back({e.a, e.b, static_cast<float>(random.next() % 48 + 1) / 16});
    whole.sharpness.creasing = data::Creasing::kChaikin;
    // Each of at most 4 steps before the evaluation adds as much again.
    EXPECT_LE(apart(whole, MeshSample(whole, 1, seed)), 8 * kRoundings) << "seed " << seed;
  }
}

std::vector<Result> audit(const lc_subject& subject, const std::string& options, const char* name,
                          std::size_t faces) {
  const data::ControlMesh mesh = data::named_mesh(name);
  return Auditor(3, 1).run({&subject, options},
                           {name, mesh, {}, std::make_shared<MeshSample>(mesh, faces, 1)});
}

TEST(SampledAudit, AGoodSubjectHoldsAndOnlyTheSampleIsLookedAt) {
  for (const char* name : {"bumpy:2000", "holes", "ragged-disc"})
    for (const Result& r : audit(*find_subject("row-stream"), "", name, 30)) {
      EXPECT_FALSE(is_bad(r)) << name << " " << r.check << ": " << r.message;
      if (r.check != "coverage") continue;
      EXPECT_GE(r.of, 30);
      EXPECT_LE(r.of, 300) << "patches and what touches them, not the mesh";
    }
}

TEST(SampledAudit, AFaultInThePatchesIsFoundWithTheFaceOfTheWhole) {
  const char* name = "bumpy:2000";
  const data::ControlMesh mesh = data::named_mesh(name);
  const auto sample = std::make_shared<MeshSample>(mesh, 30, 1);
  for (const auto& [fault, check] : {std::pair("wrong_edge_mask", "positions"),
                                     {"one_ulp_crack", "shared-positions"},
                                     {"missing_triangle", "coverage"},
                                     {"one_flipped_triangle", "orientation"}}) {
    const AuditSubject subject{find_subject("faulty"), faulty_options(fault, "row-stream")};
    std::set<std::string> red;
    for (const Result& r : Auditor(3, 1).run(subject, {name, mesh, {}, sample})) {
      if (!is_bad(r)) continue;
      red.insert(r.check);
      if (r.witness && r.witness->face >= 0) {
        EXPECT_GE(sample->part_of().at(r.witness->face), 0) << r.check;
      }
    }
    EXPECT_TRUE(red.contains(check)) << fault;
  }
}

}  // namespace
}  // namespace limitcheck::verify
