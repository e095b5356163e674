// SPDX-License-Identifier: MIT
// The project's pages link to what is there, and the tables and counts in them are the program's.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <string>

#include "data/test_support/assertions.h"
#include "verify/claims/register.h"
#include "verify/host/host.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/mutants/mutants.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

namespace fs = std::filesystem;

std::string page(const std::string& name) {
  return contents_of(fs::path(LIMITCHECK_SOURCE_DIR) / name);
}

// A line's end in a sentence is a space.
void expect_said(const std::string& name, const std::string& words) {
  EXPECT_TRUE(says(std::regex_replace(page(name), std::regex("\\n *"), " "), words)) << name;
}

TEST(Documents, LinkOnlyToWhatIsThere) {
  static const std::regex link("\\]\\(([^)#:\\s]+)[^):]*\\)");
  const fs::path root = LIMITCHECK_SOURCE_DIR;
  int links = 0;
  const auto look = [&](const fs::path& page) {
    const std::string text = contents_of(page);
    for (std::sregex_iterator m(text.begin(), text.end(), link), end; m != end; ++m, ++links)
      EXPECT_TRUE(fs::exists(page.parent_path() / (*m)[1].str()))
          << page.lexically_relative(root) << " links to " << (*m)[1];
  };
  for (const char* page : {"README.md", "CHANGELOG.md"}) look(root / page);
  for (const char* folder : {".github", "bench", "data", "fast", "papers", "reference", "verify"})
    for (auto entry = fs::recursive_directory_iterator(root / folder); entry != fs::end(entry); ++entry) {
      if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
      if (entry->path().extension() == ".md") look(entry->path());
    }
  EXPECT_GT(links, 20);
}

// The version stands in CMakeLists.txt; what forges read must repeat it.
TEST(Documents, TheCitationAndTheChangelogAreOfThisVersion) {
  const std::string citation = page("CITATION.cff"), changelog = page("CHANGELOG.md");
  EXPECT_TRUE(says(citation, "\nversion: " LIMITCHECK_VERSION "\n"));
  static const std::regex cut("\n## " LIMITCHECK_VERSION " — ([0-9-]+)\n");
  std::smatch date;
  ASSERT_TRUE(std::regex_search(changelog, date, cut));
  EXPECT_TRUE(says(citation, "date-released: \"" + date[1].str() + "\""));
}

// Each built-in subject has its place in the table, with the schemes that it says it does.
TEST(Documents, TheTableOfSubjectsSaysWhichSchemesEachDoes) {
  static const std::regex row("\\n\\| (`[^|]*`) \\| (yes|no) \\| (yes|no) \\|"), word("`([^`]+)`");
  const std::string text = page("verify/subject/README.md");
  std::map<std::string, std::string> said;
  for (std::sregex_iterator m(text.begin(), text.end(), row), end; m != end; ++m) {
    const std::string names = (*m)[1];
    for (std::sregex_iterator n(names.begin(), names.end(), word); n != end; ++n)
      said[(*n)[1]] = (*m)[2].str() + " " + (*m)[3].str();
  }
  for (const lc_subject* subject : built_in_subjects()) {
    const std::int32_t schemes = std::max<std::int32_t>(capabilities(*subject).schemes, 0);
    const bool loop = schemes == 0 || (schemes & LC_DOES_LOOP) != 0;
    EXPECT_EQ(said[subject->name], fmt::format("{} {}", loop ? "yes" : "no",
                                               (schemes & LC_DOES_CATMULL_CLARK) != 0 ? "yes" : "no"))
        << subject->name;
  }
}

TEST(Documents, CountTheMutantsTheHabitsAndTheClaimsThatThereAre) {
  expect_said("verify/METHOD.md", fmt::format("on faulty subjects, {} today", mutants().size()));
  const auto rare =
      std::count_if(habits().begin(), habits().end(), [](const Habit& h) { return h.name != "none"; });
  expect_said("verify/METHOD.md", fmt::format("{} subjects with rare but allowed habits", rare));
  const auto& claims = claim_register();
  const auto tested =
      std::count_if(claims.begin(), claims.end(), [](const Claim& c) { return !c.check.empty(); });
  expect_said("README.md", fmt::format("{} claims, {} of them re-derived by tests", claims.size(), tested));
  expect_said("verify/METHOD.md", fmt::format("**{} of the paper's claims**", claims.size() - tested));
}

// The plan says what has written it.
TEST(Documents, SayHowThePlanIsMade) {
  static const std::regex written("Written by `(limitcheck_make_plan \\d+)`");
  const std::string plan = page("data/generators/planned_stars.inc");
  std::smatch m;
  ASSERT_TRUE(std::regex_search(plan, m, written));
  expect_said("verify/METHOD.md", m[1].str() + " > data/generators/planned_stars.inc");
}

}  // namespace
}  // namespace limitcheck::verify
