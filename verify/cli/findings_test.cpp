// SPDX-License-Identifier: MIT
// The table "What it found" of README.md is what the default audit says. To write it anew:
//   bash verify/findings.sh
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "data/test_support/assertions.h"
#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

using nlohmann::json;

const std::filesystem::path kReadme = std::filesystem::path(LIMITCHECK_SOURCE_DIR) / "README.md";

// The checks of each column after the tessellator's name. The last one is a question, yes or no.
const std::vector<std::set<std::string>> kColumns{
    {"positions", "refined-positions"},
    {"normals"},
    {"shared-positions", "shared-normals"},
    {"determinism", "face-order", "vertex-order", "corner-rotation", "mirror", "rotation", "translation",
     "state"},
    {"scaling"},
    {"rejected-inputs"}};

// How a subject came out in a column, over the cases (a mesh at its depths).
std::string cell(const json& report, const std::string& subject, std::size_t column) {
  std::set<std::tuple<std::string, int, std::string, std::string>> bad, looked;
  for (const json& r : report["results"]) {
    const std::string status = r["status"];
    if (r["subject"] != subject || !kColumns[column].contains(r["check"]) || status == "not-supported" ||
        status == "not-run")
      continue;
    const std::tuple key(r["mesh"].get<std::string>(), r["depth"].get<int>(), r["depths"].dump(),
                         r["sample"].dump());
    looked.insert(key);
    for (const std::string_view wrong : {"finding", "crash", "timeout", "error"})
      if (status == wrong) bad.insert(key);
  }
  if (looked.empty()) return "–";
  if (column + 1 == kColumns.size()) return bad.empty() ? "yes" : "no";
  return bad.empty() ? "held" : fmt::format("{} of {}", bad.size(), looked.size());
}

// A row of the table, with what it should say: notes behind a name or a figure stay.
struct Row {
  std::size_t begin = 0, end = 0;  // in the text
  std::string is, should_be;
};
std::vector<Row> rows(const std::string& text, const json& report) {
  std::vector<Row> all;
  for (const json& s : report["subjects"]) {
    const std::string subject = s;
    const std::size_t begin = text.find("| `" + subject + "`");
    if (begin == std::string::npos) continue;
    const std::size_t end = text.find('\n', begin);
    Row row{begin, end, text.substr(begin, end - begin), ""};
    std::vector<std::string> cells;
    for (std::size_t at = 2; at < row.is.size();) {
      const std::size_t bar = row.is.find(" |", at);
      cells.push_back(row.is.substr(at, bar - at));
      at = bar + 3;
    }
    cells.resize(kColumns.size() + 1);
    row.should_be = "| " + cells[0] + " |";
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
      std::string note;
      for (const std::string_view mark : {" ¹", " ²", " ³"})
        if (cells[k + 1].ends_with(mark)) note = mark;
      row.should_be += " " + cell(report, subject, k) + note + " |";
    }
    all.push_back(row);
  }
  return all;
}

class Findings : public CommandTest {};

// The paper's engine, which has findings; the others take longer.
TEST_F(Findings, OfThePapersEngineAreThoseOfTheReadme) {
  ASSERT_EQ(run("audit sliding-window --all-rows --json report.json").code, 1);
  const json report = json_in("report.json");
  const std::vector<Row> all = rows(contents_of(kReadme), report);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].is, all[0].should_be) << "bash verify/findings.sh writes the table anew";
  // It sums in the paper's order: where tangents are nearly parallel, its normals and what depends on the order of
  // the faces are off by more than rounding need be; nothing else is.
  for (const json& r : report["results"])
    if (r["status"] == "finding") {
      EXPECT_TRUE(r["check"] == "normals" || r["check"] == "face-order") << r;
    }
}

// Writes the table, if the environment names a report of an audit of all.
TEST_F(Findings, AreWrittenToTheReadmeIfAReportIsNamed) {
  const char* file = std::getenv("LIMITCHECK_FINDINGS");
  if (file == nullptr) GTEST_SKIP() << "LIMITCHECK_FINDINGS is not set";
  const json report = json::parse(contents_of(file));
  ASSERT_FALSE(report.contains("in_short")) << "a report in short lacks rows: limitcheck audit --all-rows";
  std::string text = contents_of(kReadme);
  std::vector<Row> all = rows(text, report);
  std::ranges::sort(all, std::greater{}, &Row::begin);  // the last one first: each moves those behind it
  for (const Row& row : all) text.replace(row.begin, row.end - row.begin, row.should_be);
  const std::string_view audit = "from an audit of ";
  const std::size_t begin = text.find(audit) + audit.size(), end = text.find(' ', begin);
  ASSERT_GE(begin, audit.size());
  text.replace(begin, end - begin, std::to_string(report["meshes"].size()));
  std::ofstream(kReadme, std::ios::binary) << text;
}

}  // namespace
}  // namespace limitcheck::cli
