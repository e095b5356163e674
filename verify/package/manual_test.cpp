// SPDX-License-Identifier: MIT
// The manual page and the completion, which are made of what the program's --help says.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "data/test_support/assertions.h"
#include "verify/package/installed_test.h"

namespace limitcheck::cli {
namespace {

namespace fs = std::filesystem;
const fs::path kHere = fs::path(LIMITCHECK_SOURCE_DIR) / "verify/package";

class Manual : public InstalledTest {};

TEST_F(Manual, SaysWhatHelpSays) {
  const std::string page = contents_of(LIMITCHECK_BINARY_DIR "/limitcheck.1");
  for (const char* text :
       {"Usage: limitcheck eval [OPTIONS] MESH [FACE]", ".SS limitcheck audit\n.nf\nJudge a tessellator",
        "\n  limitcheck audit ./libmine.so\n", "\n  \\-\\-precision TEXT:{float,double}=double\n",
        "\n  bench   ", ".SH EXIT STATUS\n"})
    EXPECT_TRUE(says(page, text)) << text;
  for (const char* absent : {"worker", "@"}) EXPECT_FALSE(says(page, absent)) << absent;
  // A line that begins with a dot is a request.
  for (std::size_t k = page.find("\n."); k != std::string::npos; k = page.find("\n.", k + 1))
    EXPECT_TRUE(says("\\TSBPInf", page.substr(k + 2, 1))) << page.substr(k, 80);
  const Outcome rendered = shell("groff -ww -z -man '" LIMITCHECK_BINARY_DIR "/limitcheck.1'");
  if (rendered.code != 127) {
    EXPECT_EQ(rendered.code, 0) << rendered.err;
    EXPECT_EQ(rendered.err, "");
  }
}

class Completion : public InstalledTest {
 protected:
  /// What is offered for the last of these words.
  std::vector<std::string> offers(const std::string& words) const {
    write("complete.bash", "source '" + (kHere / "limitcheck.bash").string() +
                               "'\nCOMP_WORDS=('" LIMITCHECK_PROGRAM "' " + words +
                               ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_limitcheck\n"
                               "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
    const Outcome o = shell("bash -eu complete.bash", 0);
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
  EXPECT_EQ(offers("''").size(), 14U);
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

// The other shells ask bash, from where both are installed.
TEST_F(Completion, IsTheSameInFishAndZsh) {
  for (const char* folder :
       {"bash-completion/completions", "fish/vendor_completions.d", "zsh/site-functions"})
    fs::create_directories(folder_ / "share" / folder);
  write("share/bash-completion/completions/limitcheck", contents_of(kHere / "limitcheck.bash"));
  write("share/fish/vendor_completions.d/limitcheck.fish", contents_of(kHere / "limitcheck.fish"));
  write("share/zsh/site-functions/_limitcheck", contents_of(kHere / "_limitcheck"));
  const std::string path = "PATH='" + fs::path(LIMITCHECK_PROGRAM).parent_path().string() + "':$PATH ";
  write("one.fish",
        "source share/fish/vendor_completions.d/limitcheck.fish\ncomplete -C 'limitcheck audit --level '\n");
  write("one.zsh",
        "fpath=($PWD/share/zsh/site-functions $fpath)\nautoload -U _limitcheck\nautoload +X _limitcheck\n"
        "compadd() { print -l -- ${(P)2} }\nwords=(limitcheck audit --level '')\nCURRENT=4\n_limitcheck\n");
  int there = 0;
  for (const char* words : {"fish --no-config one.fish", "zsh -f one.zsh"}) {
    const Outcome o = shell(path + words);
    if (o.code == 127) continue;
    ++there;
    for (const char* level : {"quick", "standard", "thorough"})
      EXPECT_TRUE(says(o.out, level)) << words << o.err;
    EXPECT_EQ(o.err, "") << words;
  }
  if (there == 0) GTEST_SKIP() << "neither shell is here";
}

}  // namespace
}  // namespace limitcheck::cli
