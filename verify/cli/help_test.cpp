// SPDX-License-Identifier: MIT
// --help: examples that run, groups, and lines that fit the screen, as all output does.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

class Help : public CommandTest {
 protected:
  static std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  std::vector<std::string> commands() const {
    std::vector<std::string> names;
    bool there = false;
    for (const std::string& line : lines_of(run("--help", 0).out)) {
      there = there ? line.starts_with("  ") : line == "Subcommands:";
      if (there && line != "Subcommands:") names.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
    return names;
  }
  /// Command lines under "Examples:".
  static std::vector<std::string> examples(const std::string& help) {
    std::vector<std::string> found;
    bool there = false;
    for (const std::string& line : lines_of(help)) {
      if (line == "Examples:") there = true;
      if (there && line.empty()) break;
      if (there && line.starts_with("  limitcheck ")) found.push_back(line.substr(2));
    }
    return found;
  }
  /// Lines that are wider and no commands, which stay whole to be copied.
  static std::string too_wide(const std::string& text, std::size_t width) {
    std::string wide;
    for (const std::string& line : lines_of(text)) {
      const auto seen = static_cast<std::size_t>(std::count_if(
          line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
      const std::size_t begin = line.find_first_not_of(' ');
      if (seen > width && line.find("limitcheck ") != begin) wide += line + "\n";
    }
    return wide;
  }
};

TEST_F(Help, OfEveryCommandHasExamplesAndTheyRun) {
  write("cage.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  write("scan.obj", read("cage.obj"));
  write("points.csv", "0,1/3,1/3\n");
  ASSERT_EQ(run("tessellate cage.obj --depth 2 -o fine.ply").code, 0);
  ASSERT_EQ(
      run("audit naive tetrahedron octahedron --level quick --depth 1 --shard 1/2 --json part1.json").code,
      0);
  ASSERT_EQ(
      run("audit naive tetrahedron octahedron --level quick --depth 1 --shard 2/2 --json part2.json").code,
      0);
  for (const std::string& command : commands()) {
    if (command == "reproduce" || command == "bench" || command == "shader")
      continue;  // programs of their own
    const std::vector<std::string> lines = examples(run(command + " --help", 0).out);
    EXPECT_GE(lines.size(), 2U) << command;
    for (const std::string& line : lines) {
      EXPECT_TRUE(line.starts_with("limitcheck " + command + " ") || line == "limitcheck " + command) << line;
      // A library of the user's; and what takes minutes, or all tests of the claims.
      const bool heavy = line.find("libmine") != std::string::npos || command == "prove" ||
                         command == "mutants" || line == "limitcheck claims" ||
                         line == "limitcheck claims C14";
      if (heavy) continue;
      EXPECT_LE(shell(line).code, 1) << line << "\n" << read(".stderr");
    }
  }
}

TEST_F(Help, FitsScreensOfEightyToTwoHundredColumns) {
  std::vector<std::string> asked{"--help",
                                 "help tags",
                                 "generate --list",
                                 "audit --explain all",
                                 "check octahedron.obj",
                                 "audit naive octahedron --depth 1",
                                 "audit naive octahedron --depth 1 --details",
                                 "audit all octahedron bumpy:20 --depth 2",
                                 "audit all octahedron bumpy:20 --depth 2 --details"};
  for (const std::string& command : commands())
    if (command != "reproduce" && command != "bench" && command != "shader")
      asked.push_back(command + " --help");
  ASSERT_EQ(run("generate octahedron -o octahedron.obj").code, 0);
  for (const std::string& arguments : asked)
    for (const std::size_t width : {80, 120, 200}) {
      if (arguments.starts_with("audit all") && width == 120) continue;
      const Outcome o =
          command("COLUMNS=" + std::to_string(width) + " '" LIMITCHECK_PROGRAM "' " + arguments);
      EXPECT_EQ(too_wide(o.out, width), "") << arguments << " on " << width << " columns";
    }
}

TEST_F(Help, OfAuditPutsEveryOptionUnderATitle) {
  std::string title;
  for (const std::string& line : lines_of(run("audit --help", 0).out)) {
    if (!line.empty() && line[0] != ' ' && line.ends_with(':')) title = line;
    if (!line.starts_with("  -")) continue;
    EXPECT_EQ(title == "Options:", line.starts_with("  -h,--help")) << line;
  }
}

TEST_F(Help, ColourIsAsItIsAskedFor) {
  const std::string audit = "audit naive octahedron --depth 1 --level quick ";
  EXPECT_FALSE(says(run(audit, 0).out, "\033"));
  EXPECT_TRUE(says(run(audit + "--color always", 0).out, "\033[32mheld"));
  EXPECT_FALSE(says(run(audit + "--color never", 0).out, "\033"));
  EXPECT_EQ(run(audit + "--color sometimes").code, 2);
  // A terminal's width is taken, and NO_COLOR respected unless colours are asked for.
  write("audit.sh",
        "stty cols 80\nexport TERM=xterm NO_COLOR=1\n'" LIMITCHECK_PROGRAM "' " + audit + "2> /dev/null\n");
  const std::string shown = command("script -qec 'sh audit.sh' /dev/null", 0).out;
  EXPECT_FALSE(says(shown, "\033"));
  EXPECT_EQ(too_wide(std::regex_replace(shown, std::regex("\r"), ""), 80), "");
}

// What looked at nothing says why.
TEST_F(Help, NothingLookedAtHasThreeReasons) {
  const std::string one = run("audit cgal octahedron --depth 1 --level quick").out;
  EXPECT_TRUE(says(one, "  not asked: determinism, "));
  EXPECT_TRUE(says(one, "  not supported: ")) << "CGAL delivers no normals";
  const std::string two = run("audit all octahedron --depth 1 --level quick").out;
  EXPECT_TRUE(says(two, "not asked"));
  EXPECT_TRUE(says(two, "unsupported"));
}

}  // namespace
}  // namespace limitcheck::cli
