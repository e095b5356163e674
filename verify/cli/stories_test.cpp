// SPDX-License-Identifier: MIT
// What users do from the beginning to the end, as scripts: verify/cli/stories.
#include <gtest/gtest.h>

#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

class Story : public CommandTest, public testing::WithParamInterface<const char*> {};

TEST_P(Story, Ends) {
  const std::string script = LIMITCHECK_SOURCE_DIR "/verify/cli/stories/" + std::string(GetParam()) + ".sh";
  const Outcome o = shell("export -f limitcheck\nbash '" + script + "'");
  EXPECT_EQ(o.code, 0) << o.out << o.err;
}

INSTANTIATE_TEST_SUITE_P(OfAUser, Story, testing::Values("files", "ci", "artist"));

}  // namespace
}  // namespace limitcheck::cli
