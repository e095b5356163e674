// SPDX-License-Identifier: MIT
// The register of claims names the tests that re-derive its verdicts: each of them must be there.
// What becomes of a claim when its tests pass, fail, break down or are not there. The programs are scripts
// that speak as GoogleTest programs do.
#include <gtest/gtest.h>

#include <fmt/core.h>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "data/test_support/assertions.h"
#include "verify/claims/register.h"

namespace limitcheck::verify {
namespace {

namespace fs = std::filesystem;

std::set<std::string> tests_in_the_sources() {
  std::set<std::string> names;
  const std::regex pattern(R"(TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\))");
  for (const char* folder : {"data", "reference", "fast", "verify"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(LIMITCHECK_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      const std::string text = contents_of(entry.path());
      for (std::sregex_iterator m(text.begin(), text.end(), pattern), end; m != end; ++m)
        names.insert((*m)[1].str() + "." + (*m)[2].str());
    }
  }
  return names;
}

TEST(ClaimRegister, HasItsClaimsEachWithAKnownVerdict) {
  const auto json = nlohmann::json::parse(
      contents_of(fs::path(LIMITCHECK_SOURCE_DIR) / "papers/mueller-havemann-2000/claims.json"));
  ASSERT_EQ(json["claims"].size(), 92U);
  std::set<std::string> ids;
  for (const auto& claim : json["claims"]) {
    EXPECT_TRUE(ids.insert(claim["id"].get<std::string>()).second) << claim["id"];
    EXPECT_TRUE(json["verdicts"].contains(claim["verdict"].get<std::string>())) << claim["id"];
  }
}

TEST(ClaimRegister, NamesOnlyTestsThatExist) {
  const auto json = nlohmann::json::parse(
      contents_of(fs::path(LIMITCHECK_SOURCE_DIR) / "papers/mueller-havemann-2000/claims.json"));
  const std::set<std::string> tests = tests_in_the_sources();
  int checked = 0;
  for (const auto& claim : json["claims"]) {
    if (claim["check"].is_null()) continue;
    ++checked;
    for (const auto& name : claim["check"])
      EXPECT_TRUE(tests.contains(name.get<std::string>())) << claim["id"] << " names " << name;
  }
  constexpr int kFloor = 89;  // of 92: what the coverage of claims must not fall below
  EXPECT_GE(checked, kFloor);
}

// Numbers of claims in the README, wherever it has some: "84 claims", "80 of them re-derived", "48
// confirmed".
TEST(ClaimRegister, AndTheReadmeHaveTheSameNumbers) {
  const fs::path root = LIMITCHECK_SOURCE_DIR;
  const auto json = nlohmann::json::parse(contents_of(root / "papers/mueller-havemann-2000/claims.json"));
  const std::string readme = contents_of(root / "README.md");
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

class RunClaims : public testing::Test {
 protected:
  // A program that lists one test and does `body` when it is run; $report is where to write.
  fs::path program(const std::string& name, const std::string& suite, const std::string& test,
                   const std::string& body) {
    const fs::path path = folder_ / name;
    std::ofstream(path)
        << "#!/bin/sh\nreport=${2#--gtest_output=json:}\nif [ \"$1\" = --gtest_list_tests ]; then echo '"
        << R"({"testsuites":[{"name":")" + suite + R"(","testsuite":[{"name":")" + test + R"("}]}]})"
        << "' > \"$report\"; exit 0; fi\n" + body;
    fs::permissions(path, fs::perms::owner_all);
    return path;
  }
  static std::string reports(const std::string& suite, const std::string& name, const std::string& more) {
    return R"(echo '{"testsuites":[{"testsuite":[{"name":")" + name + R"(","classname":")" + suite +
           R"(","status":"RUN")" + more + R"(}]}]}' > "$report")" + "\n";
  }
  static ClaimResult judge(const Claim& claim, const std::vector<fs::path>& programs) {
    return run_claims({&claim}, programs).at(0);
  }

  const Claim claim_{"C00", "", "", "confirmed", "", "", "", {"Suite.Name"}};
  const TestFolder folder_;
};

TEST_F(RunClaims, HeldOnlyIfEveryTestRanAndPassed) {
  const auto pass = program("pass", "Suite", "Name", reports("Suite", "Name", R"(,"worst":"1e-9")"));
  const ClaimResult r = judge(claim_, {pass});
  EXPECT_EQ(r.outcome, ClaimOutcome::kHeld) << r.message;
  ASSERT_EQ(r.figures.size(), 1U);
  EXPECT_EQ(r.figures[0].second, "1e-9");
  Claim two = claim_;
  two.check.push_back("Suite.Other");
  EXPECT_EQ(judge(two, {pass}).outcome, ClaimOutcome::kNotRun) << "one of two is not there";
}

TEST_F(RunClaims, TellsTheFindingWithTheFiguresOfToday) {
  Claim claim = claim_;
  claim.finding = "Up to {most} %, at least {least}.";
  const auto both =
      program("both", "Suite", "Name", reports("Suite", "Name", R"(,"most":"3.2","least":"2.4")"));
  EXPECT_EQ(judge(claim, {both}).finding, "Up to 3.2 %, at least 2.4.");
  EXPECT_EQ(judge(claim, {}).finding, "") << "what was not run has found nothing";
  const auto one = program("one", "Suite", "Name", reports("Suite", "Name", R"(,"most":"3.2")"));
  const ClaimResult r = judge(claim, {one});
  EXPECT_EQ(r.outcome, ClaimOutcome::kNotHeld) << "a figure that no test records";
  EXPECT_TRUE(says(r.message, "'least'"));
}

TEST_F(RunClaims, NotHeldIfOneFails) {
  const auto fail = program("fail", "Suite", "Name",
                            reports("Suite", "Name", R"(,"failures":[{"failure":"two is three"}])"));
  const ClaimResult r = judge(claim_, {fail});
  EXPECT_EQ(r.outcome, ClaimOutcome::kNotHeld);
  EXPECT_TRUE(says(r.message, "two is three"));
}

TEST_F(RunClaims, NotRunIfAbsentOrBrokenDownOrNothingWritten) {
  EXPECT_EQ(judge(claim_, {}).outcome, ClaimOutcome::kNotRun);
  const auto crash = program("crash", "Suite", "Name", "kill -SEGV $$\n");
  EXPECT_EQ(judge(claim_, {crash}).outcome, ClaimOutcome::kNotRun);
  const auto silent = program("silent", "Suite", "Name", "exit 0\n");
  EXPECT_EQ(judge(claim_, {silent}).outcome, ClaimOutcome::kNotRun);
  const auto other = program("other", "Suite", "Another", reports("Suite", "Another", ""));
  EXPECT_EQ(judge(claim_, {other}).outcome, ClaimOutcome::kNotRun);
  EXPECT_EQ(judge(claim_, {folder_ / "absent"}).outcome, ClaimOutcome::kNotRun);
}

TEST_F(RunClaims, ParameterisedAndTypedTestsAreFoundByTheirPlainName) {
  const auto pass = program("pass", "All/Suite/2", "Name/0", reports("All/Suite/2", "Name/0", ""));
  EXPECT_EQ(judge(claim_, {pass}).outcome, ClaimOutcome::kHeld);
}

TEST_F(RunClaims, WhereNothingCanBeRunItIsNotCheckableAndSaysWhy) {
  const Claim none{"C00", "", "", "not checkable", "", "", "the machines are gone", {}};
  const ClaimResult r = judge(none, {});
  EXPECT_EQ(r.outcome, ClaimOutcome::kNotCheckable);
  EXPECT_EQ(r.message, "the machines are gone");
}

TEST(Register, HasATestOrAReasonForEachOfItsClaims) {
  EXPECT_EQ(claim_register().size(), 92U);
  for (const Claim& c : claim_register()) EXPECT_NE(c.check.empty(), c.why.empty()) << c.id;
}

TEST(Register, CountsItsVerdictsInTheirOwnOrder) {
  std::vector<const Claim*> all;
  for (const Claim& c : claim_register()) all.push_back(&c);
  const auto counts = count_verdicts(all);
  ASSERT_EQ(counts.front().first, "confirmed");
  std::int64_t sum = 0;
  for (const auto& [verdict, count] : counts) sum += count;
  EXPECT_EQ(sum, 92);
  EXPECT_EQ(count_verdicts({}).front().second, 0);
}

// Notes are read by strangers: no shorthand of our own, no formulas in ASCII.
TEST(Register, IsWrittenForReaders) {
  for (const Claim& c : claim_register()) {
    const std::string words = c.statement + " " + c.note + " " + c.finding + " " + c.why;
    for (const char* shorthand : {"MEAS", "N/C", "AMB", "iid", "section D", "section E", "sqrt", "^{", "^2",
                                  "sum_", "2pi", "<=", ">=", "alpha", "gamma"})
      EXPECT_FALSE(says(words, shorthand)) << c.id << " says " << shorthand;
    if (c.verdict == "depends") {
      EXPECT_FALSE(c.finding.empty()) << c.id << ": on what, and by how much?";
    }
  }
}

TEST(Errata, NameEveryMisprint) {
  const std::string text = errata();
  for (const Claim& c : claim_register())
    EXPECT_EQ(text.find(fmt::format("| {} |", c.id)) != std::string::npos,
              c.verdict == "misprint" || c.verdict == "refuted" || c.verdict == "ambiguous" ||
                  c.verdict == "depends" || c.verdict == "admitted by the paper")
        << c.id;
}

}  // namespace
}  // namespace limitcheck::verify
