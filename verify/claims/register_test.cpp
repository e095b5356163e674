// SPDX-License-Identifier: MIT
// The register of claims names the tests that re-derive its verdicts: each of them must be there.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::set<std::string> tests_in_the_sources() {
  std::set<std::string> names;
  const std::regex pattern(R"(TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\))");
  for (const char* folder : {"data", "reference", "fast", "verify"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(LIMITCHECK_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      const std::string text = contents(entry.path());
      for (std::sregex_iterator m(text.begin(), text.end(), pattern), end; m != end; ++m)
        names.insert((*m)[1].str() + "." + (*m)[2].str());
    }
  }
  return names;
}

TEST(ClaimRegister, HasEightyFiveClaimsEachWithAKnownVerdict) {
  const auto json = nlohmann::json::parse(
      contents(fs::path(LIMITCHECK_SOURCE_DIR) / "papers/mueller-havemann-2000/claims.json"));
  ASSERT_EQ(json["claims"].size(), 86U);
  std::set<std::string> ids;
  for (const auto& claim : json["claims"]) {
    EXPECT_TRUE(ids.insert(claim["id"].get<std::string>()).second) << claim["id"];
    EXPECT_TRUE(json["verdicts"].contains(claim["verdict"].get<std::string>())) << claim["id"];
  }
}

TEST(ClaimRegister, NamesOnlyTestsThatExist) {
  const auto json = nlohmann::json::parse(
      contents(fs::path(LIMITCHECK_SOURCE_DIR) / "papers/mueller-havemann-2000/claims.json"));
  const std::set<std::string> tests = tests_in_the_sources();
  int checked = 0;
  for (const auto& claim : json["claims"]) {
    if (claim["check"].is_null()) continue;
    ++checked;
    for (const auto& name : claim["check"])
      EXPECT_TRUE(tests.contains(name.get<std::string>())) << claim["id"] << " names " << name;
  }
  constexpr int kFloor = 83;  // of 86: what the coverage of claims must not fall below
  EXPECT_GE(checked, kFloor);
}

// Numbers of claims in the README, wherever it has some: "84 claims", "80 of them re-derived", "48
// confirmed".
TEST(ClaimRegister, AndTheReadmeHaveTheSameNumbers) {
  const fs::path root = LIMITCHECK_SOURCE_DIR;
  const auto json = nlohmann::json::parse(contents(root / "papers/mueller-havemann-2000/claims.json"));
  const std::string readme = contents(root / "README.md");
  const auto all_equal = [&](const std::string& pattern, std::size_t number) {
    const std::regex words(pattern);
    for (std::sregex_iterator m(readme.begin(), readme.end(), words), end; m != end; ++m)
      EXPECT_EQ((*m)[1].str(), std::to_string(number)) << "the README says: " << m->str();
  };
  std::size_t checked = 0;
  std::map<std::string, std::size_t> verdicts;
  for (const auto& claim : json["claims"]) {
    checked += !claim["check"].is_null();
    ++verdicts[claim["verdict"].get<std::string>()];
  }
  all_equal("(\\d+) claims", json["claims"].size());
  all_equal("(\\d+) of them re-derived", checked);
  for (const auto& [verdict, meaning] : json["verdicts"].items()) {
    all_equal("(\\d+) " + verdict, verdicts[verdict]);
    all_equal(verdict + " (\\d+)", verdicts[verdict]);
  }
}

}  // namespace
