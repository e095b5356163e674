// SPDX-License-Identifier: MIT
#include "verify/report/columns.h"

#include <gtest/gtest.h>

#include <sstream>

#include "data/test_support/assertions.h"

namespace limitcheck::verify {
namespace {

TEST(Wrapped, LinesAreBrokenAtBlanksUnderTheirSecondColumn) {
  EXPECT_EQ(wrapped("one two three\nfour\n", 8), "one two\nthree\nfour\n");
  EXPECT_EQ(wrapped("one two three\n", 0), "one two three\n");
  EXPECT_EQ(wrapped("  one two\n", 7), "  one\n  two\n");
  EXPECT_EQ(wrapped("--a  one two three four\n", 14), "--a  one two\n     three\n     four\n");
  EXPECT_EQ(wrapped("unbreakable word", 5), "unbreakable\nword") << "no word is broken, nothing is lost";
  EXPECT_EQ(wrapped("a,b,c,d,e", 5), "a,b,\nc,d,e");
  EXPECT_EQ(wrapped("\033[31mred\033[0m or so", 6), "\033[31mred\033[0m or\nso") << "escapes have no width";
  EXPECT_EQ(wrapped("1–3 4–5", 3), "1–3\n4–5") << "nor have the later bytes of a character";
  EXPECT_EQ(wrapped("  limitcheck audit naive\n", 9), "  limitcheck audit naive\n")
      << "a command is copied whole";
  EXPECT_EQ(wrapped("limitcheck 0.2.0: depth\n", 18), "limitcheck 0.2.0:\ndepth\n");
  EXPECT_EQ(wrapped("\n\n", 5), "\n\n");
}

const std::vector<Column> kColumns{
    {"name", 8}, {"count", 7, true, 2}, {"often", 5, true, 1, 1}, {"where", 0, false, 1, 2}};
TableRow row(const std::vector<std::string>& texts, bool weighty) {
  TableRow made{.weighty = weighty};
  for (const std::string& text : texts) made.cells.push_back({text});
  return made;
}
const std::vector<TableRow> kRows{row({"one", "1", "2", "here and there"}, true),
                                  row({"three", "12345", "-", "nowhere"}, false)};

TEST(Table, LosesItsBlanksThenColumnsButNotWhereAWeightyRowIs) {
  const auto shown = [](std::size_t width) { return table(kColumns, kRows, {false, width}, 2); };
  EXPECT_EQ(
      shown(0),
      "  name        count often where\n  one             1     2 here and there\n  three       12345     - "
      "nowhere\n");
  EXPECT_EQ(shown(34),
            "  name  count often where\n  one       1     2 here and there\n  three 12345     - nowhere\n");
  EXPECT_EQ(shown(28), "  name  count where\n  one       1 here and there\n  three 12345 nowhere\n");
  EXPECT_EQ(shown(20), "  name  count\n  one       1\n      here and there\n  three 12345\n");
  for (std::size_t width = 20; width < 60; ++width) {
    std::istringstream lines(shown(width));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), width) << line;
  }
}

TEST(Table, InBlocksHasAllColumns) {
  EXPECT_EQ(table_in_blocks(kColumns, kRows, {false, 24}, 0),
            "name        count often\none             1     2\nthree       12345     -\n\n"
            "name     where\none      here and there\nthree    nowhere\n");
  EXPECT_EQ(table_in_blocks(kColumns, kRows, {}, 2), table(kColumns, kRows, {}, 2));
}

TEST(Table, PaintsCellsAndNotTheirBlanks) {
  TableRow painted = row({"x", "y"}, false);
  painted.cells[0].colour = "31";
  EXPECT_EQ(table({{"a", 4}, {"b", 1}}, {painted}, {.colour = true}, 0), "a    b\n\033[31mx\033[0m    y\n");
}

}  // namespace
}  // namespace limitcheck::verify
