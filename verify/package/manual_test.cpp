// SPDX-License-Identifier: MIT
// The manual page and the completion know what the program's --help knows: no more, no less.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "verify/package/installed_test.h"

namespace limitcheck::cli {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

const fs::path kHere = fs::path(LIMITCHECK_SOURCE_DIR) / "verify/package";

Names all_matches(const std::string& text, const std::regex& what) {
  Names found;
  for (auto m = std::sregex_iterator(text.begin(), text.end(), what); m != std::sregex_iterator(); ++m)
    found.insert((*m)[1]);
  return found;
}

// Option, and its default ("" if there is none).
using Options = std::map<std::string, std::string>;

class Manual : public InstalledTest {
 protected:
  Names commands() const {
    const std::string help = run("--help").out;
    const std::size_t begin = help.find("Subcommands:\n");
    EXPECT_NE(begin, std::string::npos) << help;
    return all_matches(help.substr(begin), std::regex("\n  ([a-z]+) "));
  }
  // From lines like "  --depth INT:INT in [0 - 12]=4" and "  -o OUTPUT, --output OUTPUT".
  Options options_of(const std::string& command) const {
    Options options;
    std::istringstream help(run(command + " --help").out);
    for (std::string line; std::getline(help, line);) {
      if (!line.starts_with("  -")) continue;
      std::string head = line.substr(2, line.find("  ", 2) - 2);
      head = head.substr(0, head.find(" Needs:"));
      std::smatch value;
      const bool has_default = std::regex_search(head, value, std::regex("=([^ =]+)$")) && value[1] != "-";
      for (const std::string& name : all_matches(head, std::regex("(?:^|[ ,])(-[a-z-]+)")))
        if (name != "-h" && name != "--help") options[name] = has_default ? value[1].str() : "";
    }
    return options;
  }
};

// The part of the page on each command, without the escapes of troff.
std::map<std::string, std::string> sections() {
  std::ifstream in(kHere / "limitcheck.1");
  std::map<std::string, std::string> result;
  std::string command;
  for (std::string line; std::getline(in, line);) {
    line = std::regex_replace(line, std::regex(R"(\\f[BIR])"), "");
    line = std::regex_replace(line, std::regex(R"(\\-)"), "-");
    if (line.starts_with(".SS limitcheck ")) command = line.substr(15);
    if (line.starts_with(".SH")) command.clear();
    result[command] += line + "\n";
  }
  return result;
}

// Paragraphs that begin with ".TP" and name options in their first line.
std::map<std::string, std::string> paragraphs(const std::string& section) {
  std::map<std::string, std::string> result;
  Names names;
  bool head = false;
  std::istringstream in(section);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(".")) names.clear();
    for (const std::string& name : names) result[name] += line + " ";
    if (head)
      for (const std::string& name : names = all_matches(line, std::regex("(?:^|, )(-[a-z-]+)")))
        result[name];
    head = line == ".TP";
  }
  return result;
}

TEST_F(Manual, HasEveryCommandOptionAndDefaultAndNoOther) {
  const auto page = sections();
  Names described;
  for (const auto& [command, text] : page)
    if (!command.empty()) described.insert(command);
  EXPECT_EQ(described, commands());

  std::size_t seen = 0;
  for (const std::string& command : commands()) {
    if (command == "bench") continue;  // its commands have a --help each; the page refers to it
    const Options options = options_of(command);
    ASSERT_TRUE(page.contains(command)) << command;
    const auto described_options = paragraphs(page.at(command));
    for (const auto& [name, value] : options) {
      const auto found = described_options.find(name);
      ASSERT_NE(found, described_options.end()) << "limitcheck.1 lacks " << command << " " << name;
      if (!value.empty()) {
        EXPECT_NE(found->second.find("default " + value), std::string::npos)
            << command << " " << name << " has the default " << value << "; the page: " << found->second;
      }
      ++seen;
    }
    for (const auto& [name, text] : described_options)
      EXPECT_TRUE(options.contains(name)) << "limitcheck.1 has " << command << " " << name;
  }
  EXPECT_GT(seen, 60U);
}

class Completion : public InstalledTest {
 protected:
  /// What is offered for the last of these words.
  std::vector<std::string> offers(const std::string& words) const {
    write("complete.bash", "source '" + (kHere / "limitcheck.bash").string() +
                               "'\nCOMP_WORDS=('" LIMITCHECK_PROGRAM "' " + words +
                               ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_limitcheck\n"
                               "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
    const Outcome o = shell("bash -eu complete.bash");
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.err, "");
    std::vector<std::string> list;
    std::istringstream in(o.out);
    for (std::string line; std::getline(in, line);)
      if (!line.empty()) list.push_back(line);
    return list;
  }
};

using Offer = std::vector<std::string>;

TEST_F(Completion, OffersCommandsOptionsChoicesSubjectsAndMeshes) {
  EXPECT_EQ(offers("a"), Offer{"audit"});
  EXPECT_EQ(offers("''").size(), 11U);
  EXPECT_EQ(offers("audit --dep"), (Offer{"--depth", "--depths"}));
  EXPECT_EQ(offers("audit --level ''"), (Offer{"quick", "standard", "thorough"}));
  EXPECT_EQ(offers("tessellate cube --strategy p"), Offer{"project-sphere"});
  EXPECT_EQ(offers("tessellate --color ''"), (Offer{"depth", "kind"}));
  EXPECT_EQ(offers("audit --explain w"), (Offer{"written", "watertight"}));
  EXPECT_EQ(offers("audit naiv"), Offer{"naive"});
  EXPECT_EQ(offers("audit naive oct"), Offer{"octahedron"});
  EXPECT_EQ(offers("eval oct"), Offer{"octahedron"});
  EXPECT_EQ(offers("eval quad-cu"), Offer{"quad-cube"});
  EXPECT_EQ(offers("tessellate cube --scheme ''"), (Offer{"loop", "catmull-clark"}));
  EXPECT_EQ(offers("check cage.obj --triangulate ''"), (Offer{"fan", "shortest-diagonal"}));
  EXPECT_EQ(offers("audit --json ''"), Offer{});  // a file: bash's own
  EXPECT_EQ(offers("-").size(), 3U);
}

}  // namespace
}  // namespace limitcheck::cli
