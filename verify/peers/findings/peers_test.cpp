// SPDX-License-Identifier: MIT
// The register of peers' findings (findings.json), each seen again on its small mesh.
// The pages of findings say what the register says, show the meshes as they are, and expect certified values.
#include <gtest/gtest.h>

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "data/generators/named_mesh.h"
#include "data/test_support/assertions.h"
#include "reference/surface/certified.h"
#include "reference/surface/channel.h"
#include "verify/audit/audit.h"
#include "verify/host/host.h"
#include "verify/relations/relations.h"
#include "verify/subject/registry.h"
#include "verify/subject/subject_error.h"

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
    try {
      (void)capabilities(*subject, f.value("options", ""));
    } catch (const SubjectError& error) {  // its library is there, and no driver
      EXPECT_EQ(name, "opensubdiv-gl") << error.what();
      fmt::print("{:<34} not looked at: {}\n", id, error.what());
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
      EXPECT_TRUE(says(row->message, f.at("message").get<std::string>())) << id;
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

namespace fs = std::filesystem;

const std::string kHere = "verify/peers/findings/";

std::string in_one_line(const std::string& text) {
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

fs::path root() {
  return LIMITCHECK_SOURCE_DIR;
}

std::string path_of(const std::string& mesh) {
  return mesh.ends_with(".obj") ? kHere + "meshes/" + mesh : mesh;
}

// The command of a finding as a page has it.
std::string command(const Json& finding) {
  const auto options = finding.value("options", "");
  return "limitcheck audit " + finding.at("subject").get<std::string>() +
         (options.empty() ? "" : ":" + options) + " " + path_of(finding.at("mesh")) +
         (finding.value("level", "") == "must-refuse"
              ? " --must-refuse\n"
              : " --depth " + std::to_string(finding.at("depth").get<int>()) + "\n");
}

// Where a page has a table with its certified row, followed by the command that gives it.
struct Expected {
  std::vector<std::string> digits;
  std::string mesh;
  int face;
  std::string u, v, channel;  // no name: a position or a normal
};

std::vector<Expected> expected_in(const std::string& page) {
  static const std::regex form(
      "\\| expected \\| (\\S+) \\| (\\S+) \\|( (\\S+) \\|)?\n.*\n\n"
      "Expected, certified: `limitcheck eval (\\S+) (\\d+) (\\S+) (\\S+)( --precision float)?( --channel "
      "(\\w+))? --digits 20`");
  std::vector<Expected> all;
  for (std::sregex_iterator m(page.begin(), page.end(), form), end; m != end; ++m) {
    all.push_back({{(*m)[1], (*m)[2]}, (*m)[5], std::stoi((*m)[6]), (*m)[7], (*m)[8], (*m)[11]});
    if ((*m)[4].matched) all.back().digits.push_back((*m)[4]);
  }
  return all;
}

TEST(Pages, ExpectCertifiedValues) {
  int values = 0;
  for (const auto& entry : fs::directory_iterator(root() / kHere)) {
    if (entry.path().extension() != ".md") continue;
    const std::string page = contents_of(entry.path());
    const auto all = expected_in(page);
    static const std::regex row("\\| expected \\|");
    EXPECT_EQ(std::distance(std::sregex_iterator(page.begin(), page.end(), row), {}), std::ssize(all))
        << entry.path().filename() << ": an expected value without its command";
    for (const Expected& e : all) {
      const fs::path file = root() / e.mesh;
      // Its coordinates are exact in float, which is all the difference that --precision could make.
      const auto mesh = data::open_mesh(fs::exists(file) ? file.string() : e.mesh).mesh;
      const auto u = reference::Parameter::parse(e.u), v = reference::Parameter::parse(e.v);
      const data::Scheme scheme = data::natural_scheme(mesh);
      reference::CertifiedPoint point;
      if (e.channel.empty()) {
        point = reference::CertifiedEvaluator(mesh, scheme).evaluate(e.face, 0, u, v, 20);
      } else {
        const data::Channel& channel = data::channel_of(mesh, e.channel);
        point = reference::ChannelEvaluator(mesh, channel, channel.rule.value(), scheme)
                    .evaluate(e.face, 0, u, v, 20)[0];
      }
      const auto is = [&](const reference::Enclosure3& exact) {
        return std::equal(e.digits.begin(), e.digits.end(), exact.begin(),
                          [](const std::string& digits, const auto& x) { return digits == x.value; });
      };
      EXPECT_TRUE(is(point.position) || is(point.normal))
          << entry.path().filename() << ", " << e.mesh << " face " << e.face << ": " << e.digits[0];
      ++values;
    }
  }
  EXPECT_GT(values, 30);
}

TEST(Pages, HaveTheCommandsAndTheMeshesOfTheRegister) {
  const Json text = Json::parse(std::ifstream(root() / kHere / "findings.json"));
  std::map<std::string, std::string> pages;
  std::set<std::string> meshes;
  const std::string list = contents_of(root() / kHere / "README.md");
  for (const Json& f : text.at("findings")) {
    const auto mesh = f.at("mesh").get<std::string>(), id = f.at("id").get<std::string>();
    if (mesh.ends_with(".obj")) {
      EXPECT_TRUE(fs::exists(root() / path_of(mesh))) << id;
      EXPECT_TRUE(f.contains("page")) << id;
      meshes.insert(mesh);
    }
    if (!f.contains("page")) continue;
    const auto name = f.at("page").get<std::string>();
    const auto page = pages.try_emplace(name, contents_of(root() / kHere / name)).first->second;
    EXPECT_TRUE(says(page, command(f))) << id << ": " << name << " has no " << command(f);
    EXPECT_TRUE(says(in_one_line(page), f.at("statement").get<std::string>())) << id;
    EXPECT_TRUE(says(list, "(" + name + ")")) << "README.md does not list " << name;
    if (mesh.ends_with(".obj")) {
      EXPECT_TRUE(says(page, contents_of(root() / path_of(mesh)))) << name << " does not show " << mesh;
    }
  }
  for (const auto& entry : fs::directory_iterator(root() / kHere))
    if (entry.path().extension() == ".md" && entry.path().filename() != "README.md") {
      EXPECT_TRUE(pages.contains(entry.path().filename())) << entry.path() << " belongs to no finding";
    }
  for (const auto& entry : fs::directory_iterator(root() / kHere / "meshes"))
    EXPECT_TRUE(meshes.contains(entry.path().filename())) << entry.path() << " belongs to no finding";
  EXPECT_GT(pages.size(), 10U);
}

}  // namespace
}  // namespace limitcheck::verify
