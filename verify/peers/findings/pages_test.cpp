// SPDX-License-Identifier: MIT
// The pages of findings say what the register says, show the meshes as they are, and expect certified values.
#include <gtest/gtest.h>

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
#include "reference/surface/certified.h"

namespace limitcheck::verify {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string kHere = "verify/peers/findings/";

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

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
  std::array<std::string, 3> digits;
  std::string mesh;
  int face;
  std::string u, v;
};

std::vector<Expected> expected_in(const std::string& page) {
  static const std::regex form(
      "\\| expected \\| (\\S+) \\| (\\S+) \\| (\\S+) \\|\n.*\n\n"
      "Expected, certified: `limitcheck eval (\\S+) (\\d+) (\\S+) (\\S+)( --precision float)? --digits 20`");
  std::vector<Expected> all;
  for (std::sregex_iterator m(page.begin(), page.end(), form), end; m != end; ++m)
    all.push_back({{(*m)[1], (*m)[2], (*m)[3]}, (*m)[4], std::stoi((*m)[5]), (*m)[6], (*m)[7]});
  return all;
}

TEST(Pages, ExpectCertifiedValues) {
  int values = 0;
  for (const auto& entry : fs::directory_iterator(root() / kHere)) {
    if (entry.path().extension() != ".md") continue;
    const std::string page = text_of(entry.path());
    const auto all = expected_in(page);
    static const std::regex row("\\| expected \\|");
    EXPECT_EQ(std::distance(std::sregex_iterator(page.begin(), page.end(), row), {}), std::ssize(all))
        << entry.path().filename() << ": an expected value without its command";
    for (const Expected& e : all) {
      const fs::path file = root() / e.mesh;
      // Its coordinates are exact in float, which is all the difference that --precision could make.
      const auto mesh = data::open_mesh(fs::exists(file) ? file.string() : e.mesh).mesh;
      const reference::CertifiedEvaluator evaluator(mesh, data::natural_scheme(mesh));
      const auto point = evaluator.evaluate(e.face, 0, reference::Parameter::parse(e.u),
                                            reference::Parameter::parse(e.v), 20);
      const auto is = [&](const reference::Enclosure3& exact) {
        return exact[0].value == e.digits[0] && exact[1].value == e.digits[1] &&
               exact[2].value == e.digits[2];
      };
      EXPECT_TRUE(is(point.position) || is(point.normal))
          << entry.path().filename() << ", " << e.mesh << " face " << e.face << ": " << e.digits[2];
      ++values;
    }
  }
  EXPECT_GT(values, 30);
}

TEST(Pages, HaveTheCommandsAndTheMeshesOfTheRegister) {
  const Json text = Json::parse(std::ifstream(root() / kHere / "findings.json"));
  std::map<std::string, std::string> pages;
  std::set<std::string> meshes;
  const std::string list = text_of(root() / kHere / "README.md");
  for (const Json& f : text.at("findings")) {
    const auto mesh = f.at("mesh").get<std::string>(), id = f.at("id").get<std::string>();
    if (mesh.ends_with(".obj")) {
      EXPECT_TRUE(fs::exists(root() / path_of(mesh))) << id;
      EXPECT_TRUE(f.contains("page")) << id;
      meshes.insert(mesh);
    }
    if (!f.contains("page")) continue;
    const auto name = f.at("page").get<std::string>();
    const auto page = pages.try_emplace(name, text_of(root() / kHere / name)).first->second;
    EXPECT_NE(page.find(command(f)), std::string::npos) << id << ": " << name << " has no " << command(f);
    EXPECT_NE(in_one_line(page).find(f.at("statement").get<std::string>()), std::string::npos) << id;
    EXPECT_NE(list.find("(" + name + ")"), std::string::npos) << "README.md does not list " << name;
    if (mesh.ends_with(".obj")) {
      EXPECT_NE(page.find(text_of(root() / path_of(mesh))), std::string::npos)
          << name << " does not show " << mesh;
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
