// SPDX-License-Identifier: MIT
// The picture in ARCHITECTURE.md is the include graph of the sources.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <utility>

namespace {

namespace fs = std::filesystem;
using Arrows = std::map<std::pair<std::string, std::string>, std::string>;  // and an example of each

Arrows drawn(std::istream& page) {
  static const std::regex arrow("^ *([a-z_/]+) --> ([a-z_/]+)$");
  Arrows arrows;
  std::smatch m;
  for (std::string line; std::getline(page, line);)
    if (std::regex_match(line, m, arrow)) arrows[{m[1], m[2]}] = "ARCHITECTURE.md";
  return arrows;
}

// The folder of the picture that a file is part of: data/generators is data, verify/host/isolation is
// verify/host, fast/plan is fast/plan.
std::string node(const std::string& path) {
  static const std::regex folder("^(verify|fast|reference)/[^/]+/");
  std::smatch m;
  if (std::regex_search(path, m, folder)) return path.substr(0, static_cast<std::size_t>(m.length()) - 1);
  return path.substr(0, path.find('/'));
}

std::string top(const std::string& folder) {
  return folder.substr(0, folder.find('/'));
}

// The arrow between two folders. The folders of fast and of reference are told apart among themselves only:
// all other folders see them as one.
std::pair<std::string, std::string> arrow_between(const std::string& from, const std::string& to) {
  const auto seen = [](const std::string& whose, const std::string& other) {
    return top(whose) == "verify" || top(whose) == top(other) ? whose : top(whose);
  };
  return {seen(from, to), seen(to, from)};
}

using Arrow = Arrows::key_type;
using ArrowOf = std::function<Arrow(const std::string& from, const std::string& to)>;  // of two files

Arrow in_the_picture(const std::string& from, const std::string& to) {
  return arrow_between(node(from), node(to));
}

// Between the folders that the files lie in, however deep: a room below another one is a room of its own.
Arrow between_rooms(const std::string& from, const std::string& to) {
  return {from.substr(0, from.rfind('/')), to.substr(0, to.rfind('/'))};
}

// The arrows of one file. A test's own includes do not count.
void add_arrows(const std::string& path, std::istream& text, Arrows& arrows,
                const ArrowOf& arrow_of = in_the_picture) {
  static const std::regex test_file("_test\\.(cpp|h)$|/test_[a-z_]*\\.h$|/test_support/|_test\\.c$");
  static const std::regex include("^ *# *include \"([a-z_]+/[^\"]+)\"");
  if (std::regex_search(path, test_file)) return;
  std::smatch m;
  for (std::string line; std::getline(text, line);) {
    if (!std::regex_search(line, m, include)) continue;
    const Arrow arrow = arrow_of(path, m[1]);
    if (arrow.second != "data" && arrow.first != arrow.second)
      arrows[arrow] = path + " includes " + m[1].str();
  }
}

Arrows included(const ArrowOf& arrow_of = in_the_picture) {
  const fs::path root = LIMITCHECK_SOURCE_DIR;
  Arrows arrows;
  for (const char* folder : {"data", "reference", "fast", "verify", "bench"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".c") continue;
      std::ifstream in(entry.path());
      add_arrows(entry.path().lexically_relative(root), in, arrows, arrow_of);
    }
  }
  return arrows;
}

TEST(Architecture, ThePictureIsTheIncludeGraph) {
  std::ifstream page(fs::path(LIMITCHECK_SOURCE_DIR) / "verify/ARCHITECTURE.md");
  const Arrows picture = drawn(page), sources = included();
  EXPECT_GT(sources.size(), 20U);
  for (const auto& [arrow, example] : sources)
    EXPECT_TRUE(picture.contains(arrow))
        << "not in the picture: " << arrow.first << " --> " << arrow.second << " (" << example << ")";
  for (const auto& [arrow, example] : picture)
    EXPECT_TRUE(sources.contains(arrow))
        << "in the picture, but no source includes: " << arrow.first << " --> " << arrow.second;
}

void expect_no_circle(const Arrows& arrows) {
  std::map<std::string, int> state;  // 1: being visited, 2: done
  const std::function<void(const std::string&)> visit = [&](const std::string& from) {
    state[from] = 1;
    for (const auto& [arrow, example] : arrows) {
      if (arrow.first != from) continue;
      EXPECT_NE(state[arrow.second], 1)
          << from << " --> " << arrow.second << " closes a circle (" << example << ")";
      if (state[arrow.second] == 0) visit(arrow.second);
    }
    state[from] = 2;
  };
  for (const auto& [arrow, example] : arrows)
    if (state[arrow.first] == 0) visit(arrow.first);
}

TEST(Architecture, HasNoCircle) {
  expect_no_circle(included());
}

TEST(Architecture, RoomsHaveNoCircle) {
  const Arrows arrows = included(between_rooms);
  EXPECT_TRUE(arrows.contains({"fast/stream/gather", "fast/stream/kernel"}));
  expect_no_circle(arrows);
}

TEST(Architecture, TheReaderOfIncludesSeesWhatItIsThereFor) {
  const auto count = [](const std::string& path, const std::string& text) {
    std::istringstream in(text);
    Arrows arrows;
    add_arrows(path, in, arrows);
    return arrows.size();
  };
  EXPECT_EQ(count("verify/audit/a.cpp", "#include \"verify/host/isolation/b.h\"\n"), 1U);
  EXPECT_EQ(count("verify/host/isolation/a.cpp", "#include \"verify/host/b.h\"\n"), 0U);
  EXPECT_EQ(count("verify/audit/a_test.cpp", "#include \"fast/b.h\"\n"), 0U);
  EXPECT_EQ(count("fast/a.h", "#include \"data/b.h\"\n#include <vector>\n"), 0U);
  EXPECT_EQ(count("fast/plan/a.h", "#include \"fast/mesh/b.h\"\n#include \"fast/plan/c.h\"\n"), 1U);
  EXPECT_EQ(arrow_between("verify/audit", "fast/plan"),
            (std::pair<std::string, std::string>{"verify/audit", "fast"}));
  EXPECT_EQ(arrow_between("fast/plan", "fast/mesh"),
            (std::pair<std::string, std::string>{"fast/plan", "fast/mesh"}));
}

}  // namespace
