// SPDX-License-Identifier: MIT
// The oracle's certificates agree with each other on the meshes of its hunt, and those with a fault do not.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "data/cut_out.h"
#include "reference/mesh/support.h"
#include "verify/checks/check_oracle.h"
#include "verify/evidence/faces_around.h"
#include "verify/hunt/hunt.h"

namespace limitcheck::verify {
namespace {

using data::ControlMesh;
using reference::Parameter;

const std::vector<data::Scheme> kBoth{data::Scheme::kLoop, data::Scheme::kCatmullClark};

HuntPlan plan(std::uint64_t seed) {
  return {seed, schemes_of({&oracle_subject(), ""}, kBoth), {}, true};
}

TEST(Oracle, ItsCertificatesAgreeWithEachOther) {
  HuntPlan cases = plan(1);
  std::int64_t points = 0;
  for (std::uint64_t n = 0; n < 30; ++n) {
    const HuntCase at = cases.at(n);
    for (const Result& r : check_oracle(at.mesh)) {
      EXPECT_EQ(r.status, Status::kHeld) << at.mesh.name << " " << data::name_of(r.scheme) << " " << r.check
                                         << ": " << r.worst.value_or(0) << " bounds; " << r.message;
      points += r.check == "oracle-faces" ? r.of : 0;
    }
  }
  EXPECT_EQ(points, 30 * kOraclePoints);
}

TEST(Oracle, IsHuntedAsOthersAre) {
  HuntReport report{.subject = "oracle"};
  Hunt hunt({&oracle_subject(), ""}, plan(2), {0, ""});
  for (std::uint64_t n = 0; n < 8; ++n) report.add(hunt.look(n).value());
  EXPECT_EQ(report.judged, 8);
  EXPECT_TRUE(report.findings.empty());
}

// An oracle that evaluates a face in a part of the mesh, after a fault was planted in it.
//   creasing   whose support the part has
template <class Plant>
Oracle with_fault(data::Creasing creasing_of_support, Plant plant) {
  return [=](const ControlMesh& mesh, data::Scheme scheme) -> Certificates {
    const auto around = std::make_shared<const FacesAround>(mesh.faces, mesh.positions.size());
    return [=](const Place& p) {
      const auto faces = reference::support_of(
          {p.face}, mesh.faces, [&](std::int32_t v) { return around->of(v); }, creasing_of_support);
      data::CutOut cut = data::cut_out(mesh.faces, faces);
      ControlMesh part{cut.of(mesh.positions), {}, cut.of(mesh.sharpness)};
      part.faces = std::move(cut.faces);
      plant(part);
      const auto at = [&](std::uint32_t k) { return Parameter::fraction(k, p.denominator); };
      return reference::CertifiedEvaluator(part, scheme)
          .evaluate(0, p.corner, at(p.i), at(p.j), kOracleDigits);
    };
  };
}

// In how many cases a fault is found first.
std::uint64_t cases_to_find(const Oracle& faulty, std::uint64_t most, std::string& by) {
  HuntPlan cases = plan(3);
  for (std::uint64_t n = 0; n < most; ++n) {
    for (const Result& r : check_oracle(cases.at(n).mesh, kOraclePoints, faulty))
      if (r.status == Status::kFinding) by += (by.empty() ? "" : " ") + r.check;
    if (!by.empty()) return n + 1;
  }
  return most;
}

TEST(Oracle, EachPlantedFaultIsFoundInLessThan200Cases) {
  constexpr auto kFull = data::Creasing::kChaikin;
  const auto nothing = [](ControlMesh&) {};
  const std::pair<const char*, Oracle> faults[] = {
      {"one_ring", with_fault(data::Creasing::kUniform, nothing)},
      {"edge_tag_lost", with_fault(kFull,
                                   [](ControlMesh& m) {
                                     if (!m.sharpness.edges.empty())
                                       m.sharpness.edges.erase(m.sharpness.edges.begin());
                                   })},
      {"vertex_tag_lost", with_fault(kFull,
                                     [](ControlMesh& m) {
                                       if (!m.sharpness.vertices.empty()) m.sharpness.vertices.pop_back();
                                     })},
      {"boundary_option_lost", with_fault(kFull, [](ControlMesh& m) { m.sharpness.boundary = {}; })},
      {"creasing_lost", with_fault(kFull, [](ControlMesh& m) { m.sharpness.creasing = {}; })},
      {"triangle_rule_lost", with_fault(kFull, [](ControlMesh& m) { m.sharpness.triangles = {}; })},
  };
  for (const auto& [name, faulty] : faults) {
    std::string by;
    const std::uint64_t cases = cases_to_find(faulty, 200, by);
    EXPECT_LT(cases, 200U) << name;
    RecordProperty(name, std::to_string(cases) + " cases, " + by);
  }
  std::string by;
  EXPECT_EQ(cases_to_find(with_fault(kFull, nothing), 8, by), 8U)
      << "without a fault nothing is found: " << by;
}

}  // namespace
}  // namespace limitcheck::verify
