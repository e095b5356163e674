// SPDX-License-Identifier: MIT
#include "verify/cli/screen.h"

#include <gtest/gtest.h>

#include <string>

#include "data/test_support/assertions.h"

namespace limitcheck::cli {
namespace {

using namespace std::chrono_literals;

// What a log has of three steps.
std::string log_of(std::chrono::milliseconds between) {
  std::FILE* const log = std::tmpfile();
  {
    Progress progress(between);
    progress.to(log);
    for (std::size_t done = 0; done <= 2; ++done) progress.show(done, 2, "a\033[31mb");
  }
  std::string text(1000, '\0');
  std::rewind(log);
  text.resize(std::fread(text.data(), 1, text.size(), log));
  std::fclose(log);
  return text;
}

// ctest has no terminal.
TEST(Progress, IsALineNowAndThenWhereThereIsNoTerminalWithoutForeignControlCharacters) {
  EXPECT_EQ(log_of(1h), "") << "too early for a line";
  const std::string text = log_of(0ms);
  EXPECT_FALSE(says(text, "\033"));
  EXPECT_EQ(text.find("limitcheck: 0/2: a"), 0U) << text;
  EXPECT_TRUE(says(text, "limitcheck: 1/2, 0 s left: a"));
  EXPECT_EQ(text.back(), '\n');
}

}  // namespace
}  // namespace limitcheck::cli
