// SPDX-License-Identifier: MIT
// What refutes a proof: each figure of a report by itself.
#include "verify/proof/proof_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace limitcheck::verify {
namespace {

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
    EXPECT_NE(proof.report().table(false).find("FAILED"), std::string::npos) << k;
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
    EXPECT_NE(proof.report().table(false).find("STOPPED"), std::string::npos) << k;
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
