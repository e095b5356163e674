// SPDX-License-Identifier: MIT
// The rules of the architecture: arrows point down only, the reference and the fast engine have nothing in
// common but the control mesh, and no two types have one name. Read from the sources and from the symbols of
// the libraries.
// The picture in ARCHITECTURE.md is the include graph of the sources.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "data/test_support/assertions.h"

namespace limitcheck {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

// Which folder may include which.
const std::map<std::string, Names>& may_include() {
  static const std::map<std::string, Names> rules{
      {"data", {"data"}},
      {"reference", {"reference", "data"}},
      {"fast", {"fast", "data"}},
      {"verify", {"verify", "reference", "fast", "data"}},
      {"bench", {"bench", "verify", "reference", "fast", "data"}},
  };
  return rules;
}

// Libraries with a licence or a weight that must stay where they are used.
const std::map<std::string, std::vector<std::string>>& allowed_in() {
  static const std::map<std::string, std::vector<std::string>> rules{
      {"CGAL", {"data/generators/", "verify/repair/", "verify/peers/", "verify/watertight/", "bench/"}},
      {"opensubdiv", {"verify/peers/", "verify/claims/introduction_claims_test.cpp", "bench/"}},
      {"OpenMesh", {"verify/peers/", "bench/"}},
      {"embree3", {"verify/peers/", "bench/"}},
  };
  return rules;
}

// What is wrong with the includes of one file; `path` is relative to the project.
std::vector<std::string> violations(const std::string& path, const std::string& text) {
  static const std::regex include("^[ \t]*#[ \t]*include[ \t]*([<\"])([^>\"]+)[>\"]");
  std::vector<std::string> found;
  const std::string folder = path.substr(0, path.find('/'));
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::smatch match;
    if (!std::regex_search(line, match, include)) continue;
    const std::string target = match[2];
    const std::string top = target.substr(0, target.find('/'));
    const auto complain = [&](const std::string& why) {
      found.push_back(path + ":" + std::to_string(number) + ": " + target + " " + why);
    };
    if (may_include().contains(top) && !may_include().at(folder).contains(top))
      complain("is not for " + folder);
    // The examples are projects of their own.
    const bool example =
        path.starts_with("verify/subject/examples/") && target.find('/') == std::string::npos;
    if (match[1] == "\"" && !may_include().contains(top) && !example)
      complain("is not a path from the project root");
    const auto rule = allowed_in().find(top);
    if (rule == allowed_in().end()) continue;
    bool allowed = false;
    for (const std::string& place : rule->second) allowed = allowed || path.starts_with(place);
    if (!allowed) complain("must stay private to its own targets");
  }
  return found;
}

TEST(Architecture, ArrowsPointDownOnly) {
  const fs::path root = LIMITCHECK_SOURCE_DIR;
  std::map<std::string, int> looked_at;
  for (const auto& [folder, rules] : may_include()) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".c") continue;
      ++looked_at[folder];
      for (const std::string& v :
           violations(entry.path().lexically_relative(root), contents_of(entry.path())))
        ADD_FAILURE() << v;
    }
  }
  for (const char* folder : {"data", "reference", "fast", "verify"})
    EXPECT_GT(looked_at[folder], 1) << folder;
}

// A recursive parser ends the process at some depth, and keeps one of two keys: what is read goes through one function.
TEST(Architecture, JsonIsParsedInOnePlace) {
  static const std::regex parse("[jJ]son *:: *(?:parse|accept|sax_parse)\\b");
  const Names allowed{
      "data/untrusted_json.cpp",
      // What was built in, what our test programs have just said, and what the report's parts are.
      "verify/claims/register.cpp", "bench/reproduction/main.cpp"};
  const fs::path root = LIMITCHECK_SOURCE_DIR;
  Names found;
  for (const auto& [folder, rules] : may_include())
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string path = entry.path().lexically_relative(root);
      if ((!path.ends_with(".h") && !path.ends_with(".cpp")) || path.find("test") != std::string::npos)
        continue;
      if (std::regex_search(contents_of(entry.path()), parse)) found.insert(path);
    }
  EXPECT_EQ(found, allowed);
}

TEST(Architecture, TheScannerSeesWhatItIsThereFor) {
  EXPECT_EQ(violations("reference/a.h", "#include \"fast/rules/masks.h\"\n").size(), 1U);
  EXPECT_EQ(violations("reference/a.h", "  #  include <fast/rules/masks.h>\n").size(), 1U);
  EXPECT_EQ(violations("fast/a.cpp", "#include \"reference/loop/masks.h\"\n").size(), 1U);
  EXPECT_EQ(violations("data/a.cpp", "#include \"verify/subject/subject.h\"\n").size(), 1U);
  EXPECT_EQ(violations("verify/a.cpp", "#include \"bench/a.h\"\n").size(), 1U);
  EXPECT_EQ(violations("verify/a.cpp", "#include \"masks.h\"\n").size(), 1U);
  EXPECT_EQ(violations("reference/a.cpp", "#include <CGAL/Surface_mesh.h>\n").size(), 1U);
  EXPECT_EQ(violations("data/io/a.cpp", "#include <CGAL/IO/polygon_soup_io.h>\n").size(), 1U);
  EXPECT_TRUE(
      violations("fast/a.cpp",
                 "#include \"fast/rules/masks.h\"\n#include <vector>\n#include \"data/control_mesh.h\"\n")
          .empty());
  EXPECT_TRUE(violations("verify/watertight/a.cpp", "#include <CGAL/Surface_mesh.h>\n").empty());
}

// Types that a file defines in a named namespace, with their namespaces; clang-format indents no namespace.
Names types_of(const std::string& text) {
  static const std::regex opens("^(?:inline )?namespace ?([A-Za-z_:]*) ?\\{[^}]*$");
  static const std::regex closes("^\\}  // namespace.*");
  static const std::regex type(
      "^(?:struct|class|union|enum(?: class| struct)?) (?:alignas\\([^)]*\\) )?([A-Za-z_0-9]+)"
      "(?![A-Za-z_0-9<]|::)(?:[^;]*|[^;{]*\\{.*)$");
  std::vector<std::string> open;
  Names found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, opens)) {
      open.push_back(match[1]);
    } else if (std::regex_match(line, closes) && !open.empty()) {
      open.pop_back();
    } else if (std::regex_match(line, match, type)) {
      std::string name;
      bool unnamed = false;
      for (const std::string& space : open) {
        unnamed = unnamed || space.empty();
        name += space + "::";
      }
      if (!unnamed && !open.empty()) found.insert(name + match[1].str());
    }
  }
  return found;
}

// Two types of one name in two files of one program are undefined behaviour that no linker reports: the
// functions of one run on objects of the other.
TEST(Architecture, NoTypeIsDefinedTwice) {
  std::map<std::string, std::string> defined_in;
  for (const auto& [folder, rules] : may_include())
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(LIMITCHECK_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      const std::string path = entry.path().lexically_relative(LIMITCHECK_SOURCE_DIR);
      for (const std::string& type : types_of(contents_of(entry.path()))) {
        const auto [other, is_new] = defined_in.emplace(type, path);
        EXPECT_TRUE(is_new) << type << " is defined in " << other->second << " and in " << path;
      }
    }
  EXPECT_GT(defined_in.size(), 200U);
}

TEST(Architecture, TheScannerOfTypesKnowsNamespacesAndDefinitions) {
  EXPECT_EQ(
      types_of("namespace a::b {\nstruct S {\n};\nenum class E : int { kOne };\n}  // namespace a::b\n"),
      (Names{"a::b::S", "a::b::E"}));
  EXPECT_EQ(types_of("namespace a {\ntemplate <class T>\nclass C : public B<T> {\n};\nclass D final\n    : "
                     "public B {};\n}  // namespace a\n"),
            (Names{"a::C", "a::D"}));
  EXPECT_TRUE(
      types_of("namespace a {\nnamespace {\nstruct S {};\n}  // namespace\n}  // namespace a\n").empty());
  EXPECT_TRUE(types_of("namespace a {\nstruct S;\nstruct S::Impl {\n};\ntemplate <>\nstruct T<int> {};\n}  "
                       "// namespace a\n")
                  .empty());
}

// Names of a static library that other objects can see, demangled; `defined` or mentioned at all.
Names symbols(const std::string& library, bool defined) {
  const std::string command = "nm -C --extern-only --format=just-symbols " +
                              std::string(defined ? "--defined-only " : "") + "'" + library + "' 2>/dev/null";
  Names names;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) return names;
  std::string line;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) {
    if (c != '\n') {
      line += static_cast<char>(c);
      continue;
    }
    names.insert(line);
    line.clear();
  }
  return names;
}

// A name of this project that is not data's: a function or object of reference, fast or verify, or an
// instance of a standard template with one of their types.
bool is_own(const std::string& name) {
  static const std::regex own("limitcheck::(?!data::)");
  return std::regex_search(name, own);
}

TEST(Architecture, ReferenceAndFastHaveNoSymbolInCommon) {
  const Names reference = symbols(LIMITCHECK_LIBREFERENCE, true), fast = symbols(LIMITCHECK_LIBFAST, true);
  int own_reference = 0, own_fast = 0;
  for (const std::string& name : reference) {
    own_reference += is_own(name);
    EXPECT_FALSE(is_own(name) && fast.contains(name)) << name;
  }
  for (const std::string& name : fast) own_fast += is_own(name);
  EXPECT_GT(own_reference, 10);
  EXPECT_GT(own_fast, 10);
}

TEST(Architecture, NeitherOfThemSoMuchAsMentionsTheOther) {
  for (const std::string& name : symbols(LIMITCHECK_LIBREFERENCE, false))
    EXPECT_FALSE(says(name, "limitcheck::fast"));
  for (const std::string& name : symbols(LIMITCHECK_LIBFAST, false))
    EXPECT_FALSE(says(name, "limitcheck::reference"));
}

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
}  // namespace limitcheck
