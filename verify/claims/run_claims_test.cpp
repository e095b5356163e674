// SPDX-License-Identifier: MIT
// What becomes of a claim when its tests pass, fail, break down or are not there. The programs are scripts
// that speak as GoogleTest programs do.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "verify/claims/register.h"

namespace limitcheck::verify {
namespace {

namespace fs = std::filesystem;

class RunClaims : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              (std::string("limitcheck-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // A program with the test Suite.Name (as `listed`), which does `body` when run; $report is where to write.
  fs::path program(const std::string& name, const std::string& listed, const std::string& body) {
    const fs::path path = folder_ / name;
    std::ofstream(path) << "#!/bin/sh\nfor a in \"$@\"; do case \"$a\" in\n"
                           "--gtest_list_tests) printf '" +
                               listed +
                               "'; exit 0;;\n"
                               "--gtest_output=json:*) report=${a#--gtest_output=json:};;\nesac; done\n" +
                               body;
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
  fs::path folder_;
};

TEST_F(RunClaims, HeldOnlyIfEveryTestRanAndPassed) {
  const auto pass = program("pass", "Suite.\\n  Name\\n", reports("Suite", "Name", R"(,"worst":"1e-9")"));
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
      program("both", "Suite.\\n  Name\\n", reports("Suite", "Name", R"(,"most":"3.2","least":"2.4")"));
  EXPECT_EQ(judge(claim, {both}).finding, "Up to 3.2 %, at least 2.4.");
  EXPECT_EQ(judge(claim, {}).finding, "") << "what was not run has found nothing";
  const auto one = program("one", "Suite.\\n  Name\\n", reports("Suite", "Name", R"(,"most":"3.2")"));
  const ClaimResult r = judge(claim, {one});
  EXPECT_EQ(r.outcome, ClaimOutcome::kNotHeld) << "a figure that no test records";
  EXPECT_NE(r.message.find("'least'"), std::string::npos) << r.message;
}

TEST_F(RunClaims, NotHeldIfOneFails) {
  const auto fail = program("fail", "Suite.\\n  Name\\n",
                            reports("Suite", "Name", R"(,"failures":[{"failure":"two is three"}])"));
  const ClaimResult r = judge(claim_, {fail});
  EXPECT_EQ(r.outcome, ClaimOutcome::kNotHeld);
  EXPECT_NE(r.message.find("two is three"), std::string::npos);
}

TEST_F(RunClaims, NotRunIfAbsentOrBrokenDownOrNothingWritten) {
  EXPECT_EQ(judge(claim_, {}).outcome, ClaimOutcome::kNotRun);
  const auto crash = program("crash", "Suite.\\n  Name\\n", "kill -SEGV $$\n");
  EXPECT_EQ(judge(claim_, {crash}).outcome, ClaimOutcome::kNotRun);
  const auto silent = program("silent", "Suite.\\n  Name\\n", "exit 0\n");
  EXPECT_EQ(judge(claim_, {silent}).outcome, ClaimOutcome::kNotRun);
  const auto other = program("other", "Suite.\\n  Another\\n", reports("Suite", "Another", ""));
  EXPECT_EQ(judge(claim_, {other}).outcome, ClaimOutcome::kNotRun);
  EXPECT_EQ(judge(claim_, {folder_ / "absent"}).outcome, ClaimOutcome::kNotRun);
}

TEST_F(RunClaims, ParameterisedAndTypedTestsAreFoundByTheirPlainName) {
  const auto pass =
      program("pass", "All/Suite/2.\\n  Name/0  # GetParam() = 1\\n", reports("All/Suite/2", "Name/0", ""));
  EXPECT_EQ(judge(claim_, {pass}).outcome, ClaimOutcome::kHeld);
}

TEST_F(RunClaims, WhereNothingCanBeRunItIsNotCheckableAndSaysWhy) {
  const Claim none{"C00", "", "", "not checkable", "", "", "the machines are gone", {}};
  const ClaimResult r = judge(none, {});
  EXPECT_EQ(r.outcome, ClaimOutcome::kNotCheckable);
  EXPECT_EQ(r.message, "the machines are gone");
}

TEST(Register, HasATestOrAReasonForEachOfItsClaims) {
  EXPECT_EQ(claim_register().size(), 86U);
  for (const Claim& c : claim_register()) EXPECT_NE(c.check.empty(), c.why.empty()) << c.id;
}

TEST(Register, CountsItsVerdictsInTheirOwnOrder) {
  std::vector<const Claim*> all;
  for (const Claim& c : claim_register()) all.push_back(&c);
  const auto counts = count_verdicts(all);
  ASSERT_EQ(counts.front().first, "confirmed");
  std::int64_t sum = 0;
  for (const auto& [verdict, count] : counts) sum += count;
  EXPECT_EQ(sum, 86);
  EXPECT_EQ(count_verdicts({}).front().second, 0);
}

// Notes are read by strangers: no shorthand of our own, no formulas in ASCII.
TEST(Register, IsWrittenForReaders) {
  for (const Claim& c : claim_register()) {
    const std::string words = c.statement + " " + c.note + " " + c.finding + " " + c.why;
    for (const char* shorthand : {"MEAS", "N/C", "AMB", "iid", "section D", "section E", "sqrt", "^{", "^2",
                                  "sum_", "2pi", "<=", ">=", "alpha", "gamma"})
      EXPECT_EQ(words.find(shorthand), std::string::npos) << c.id << " says " << shorthand;
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
                  c.verdict == "depends")
        << c.id;
}

}  // namespace
}  // namespace limitcheck::verify
