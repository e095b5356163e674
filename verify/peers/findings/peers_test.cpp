// SPDX-License-Identifier: MIT
// The register of peers' findings (findings.json), each seen again on its small mesh.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "data/generators/named_mesh.h"
#include "verify/audit/audit.h"
#include "verify/relations/refusal.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using Json = nlohmann::json;

// The mesh of a finding: a name, or a file beside the register.
std::string place_of(const std::string& mesh) {
  return mesh.ends_with(".obj") ? LIMITCHECK_SOURCE_DIR "/verify/peers/findings/meshes/" + mesh : mesh;
}

std::vector<Result> audited(const Json& finding, const AuditSubject& subject) {
  const auto mesh = finding.at("mesh").get<std::string>();
  const std::string level = finding.value("level", "quick");
  if (level == "must-refuse") {
    AuditMesh broken{mesh, read_broken_mesh(place_of(mesh), {}).mesh};
    return must_refuse({subject}, {broken}, 1);
  }
  Auditor auditor(finding.at("depth").get<int>(), 1, {},
                  level == "standard" ? Level::kStandard : Level::kQuick);
  return auditor.run(subject, {mesh, data::open_mesh(place_of(mesh)).mesh});
}

// Prints a list besides the EXPECTs, so that the output has every finding with its figure.
TEST(Peers, EveryFindingOfTheRegisterIsStillThere) {
  const Json text = Json::parse(std::ifstream(LIMITCHECK_SOURCE_DIR "/verify/peers/findings/findings.json"));
  int seen = 0;
  for (const Json& f : text.at("findings")) {
    const auto id = f.at("id").get<std::string>(), name = f.at("subject").get<std::string>();
    const auto check = f.at("check").get<std::string>();
    const lc_subject* subject = find_subject(name);
    const auto missing = missing_subjects();
    if (subject == nullptr) {
      EXPECT_TRUE(std::any_of(missing.begin(), missing.end(), [&](const auto& m) { return m.name == name; }))
          << name << " is neither there nor known to be missing";
      fmt::print("{:<34} not looked at: no {} in this build\n", id, name);
      continue;
    }
    const auto results = audited(f, {subject, f.value("options", "")});
    const auto row =
        std::find_if(results.begin(), results.end(), [&](const Result& r) { return r.check == check; });
    ASSERT_NE(row, results.end()) << id;
    fmt::print("{:<34} {} {} of {}, worst {} {} {}\n", id, word(row->status), row->bad, row->of,
               row->worst ? fmt::format("{:.3g}", *row->worst) : "-", row->unit, row->message);
    if (f.contains("status")) {
      EXPECT_EQ(word(row->status), f.at("status").get<std::string>()) << id;
    } else if (row->status != Status::kFinding) {
      ADD_FAILURE() << id << ": not there any more (" << word(row->status) << "). Has " << name
                    << " been mended? If so, take it out of the register and out of what we say about it.";
      continue;
    }
    if (f.contains("least")) {  // and a place to look at; a worst value that is not finite is worse than any
      EXPECT_GE(row->worst.value_or(1e300), f.at("least").get<double>()) << id;
      EXPECT_TRUE(row->witness.has_value()) << id;
    }
    if (f.contains("share")) {
      EXPECT_GE(static_cast<double>(row->bad), f.at("share").get<double>() * static_cast<double>(row->of))
          << id;
    }
    if (f.contains("message")) {
      EXPECT_NE(row->message.find(f.at("message").get<std::string>()), std::string::npos)
          << id << ": " << row->message;
    }
    ++seen;
  }
  RecordProperty("findings_seen", seen);
  EXPECT_GT(seen, 80);
}

// CGAL's Catmull-Clark is right wherever it was looked at: on quads and other polygons, at every valence and
// boundary. It is the second opinion that the register of the others rests on.
TEST(Peers, CgalHasNoFindingOnCatmullClark) {
  for (const std::string name :
       {"quad-cube", "quad-torus:4:3", "quad-wheel:3", "quad-wheel:12", "quad-wheel:50", "quad-fan:1",
        "quad-fan:2", "quad-fan:3", "quad-fan:4", "quad-fan:5", "quad-fan:6", "prism:3", "prism:5", "prism:8",
        "dual:bumpy:60", "octahedron"}) {
    AuditMesh mesh{name, data::named_mesh(name)};
    mesh.asked_scheme = data::Scheme::kCatmullClark;
    for (const int depth : {0, 1, 3}) {
      Auditor auditor(depth, 1, {}, depth == 1 ? Level::kStandard : Level::kQuick);
      for (const Result& r : auditor.run({find_subject("cgal"), ""}, mesh)) {
        if (r.check == "rejected-inputs") continue;  // cgal-accepts-bow-ties, with either scheme
        EXPECT_TRUE(r.status == Status::kHeld || r.status == Status::kQualityWarning ||
                    r.status == Status::kNotSupported)
            << name << " at depth " << depth << ", " << r.check << ": " << word(r.status) << ", " << r.bad
            << " of " << r.of << ": " << r.message;
      }
    }
  }
}

}  // namespace
}  // namespace limitcheck::verify
