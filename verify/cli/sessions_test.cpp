// SPDX-License-Identifier: MIT
// What users do, as scripts: each function of verify/cli/sessions, in which exit codes, arguments and words are tables, and
// the stories of verify/cli/stories from their beginning to their end.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

const std::string kHere = LIMITCHECK_SOURCE_DIR "/verify/cli/";

// "audit_AuditEndsWithZeroWhenAllHeld": a file of sessions, and a function in it.
std::vector<std::string> sessions() {
  std::vector<std::string> all;
  const std::regex name("\n([A-Z][A-Za-z0-9]*)\\(\\) \\{");
  for (const auto& file : std::filesystem::directory_iterator(kHere + "sessions")) {
    const std::string text = contents_of(file.path());
    for (std::sregex_iterator m(text.begin(), text.end(), name), end; m != end; ++m)
      all.push_back(file.path().stem().string() + "_" + (*m)[1].str());
  }
  std::sort(all.begin(), all.end());
  return all;
}

#ifdef LIMITCHECK_SANITIZED
const std::string kSanitized = "yes";
#else
const std::string kSanitized;
#endif

class Scripts : public CommandTest, public testing::WithParamInterface<std::string> {
 protected:
  void run_script(const std::string& lines) const {
    const Outcome o = shell("export -f limitcheck\nexport PROGRAM='" LIMITCHECK_PROGRAM
                            "' SOURCE='" LIMITCHECK_SOURCE_DIR "' SANITIZED=" +
                            kSanitized + "\n" + lines);
    EXPECT_EQ(o.code, 0) << o.out << o.err;
  }
};
using Session = Scripts;
using Story = Scripts;
std::string name_of(const testing::TestParamInfo<std::string>& of) {
  return of.param;
}

TEST_P(Session, Holds) {
  const std::string name = GetParam(), file = name.substr(0, name.find('_'));
  run_script("session=" + name + "\nsource '" + kHere + "sessions/expect.sh'\nsource '" + kHere +
             "sessions/" + file + ".sh'\n" + name.substr(file.size() + 1) + "\nexit $failures");
}
INSTANTIATE_TEST_SUITE_P(OfAUser, Session, testing::ValuesIn(sessions()), name_of);

TEST_P(Story, Ends) {
  run_script("bash '" + kHere + "stories/" + GetParam() + ".sh'");
}
INSTANTIATE_TEST_SUITE_P(OfAUser, Story, testing::Values("artist", "ci", "files"), name_of);

}  // namespace
}  // namespace limitcheck::cli
