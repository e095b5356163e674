// SPDX-License-Identifier: MIT
// Runs the program as a user would, in a folder of its own that is deleted afterwards.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "data/test_support/assertions.h"

namespace limitcheck::cli {

struct Outcome {
  int code = -1;  // exit code; -1: killed by a signal
  std::string out, err;
};

/// Lines of a subject in bash: it says what it can do, and has read what it is then asked for.
inline const std::string kTellsWhatItCan =
    "read -r line\necho '{\"limitcheck\": 1, \"status\": \"ok\", \"precision\": \"float64\", \"weights\": "
    "\"loop\", "
    "\"boundary\": \"spline\", \"points\": \"limit\", \"max_depth\": 6, \"normals\": true, "
    "\"per_face_depth\": false, "
    "\"exact_lattice\": true}'\nread -r line || exit 0\n";

class CommandTest : public testing::Test {
 protected:
  /// `limitcheck ARGUMENTS` (quoted for the shell).
  ///   code   the exit code that is expected, if one is; so below
  Outcome run(const std::string& arguments, std::optional<int> code = {}) const {
    return command("'" LIMITCHECK_PROGRAM "' " + arguments, code);
  }
  /// Bash on a script of these lines, in which `limitcheck` is the program.
  Outcome shell(const std::string& script, std::optional<int> code = {}) const {
    write("script.sh", "limitcheck() { \"" LIMITCHECK_PROGRAM "\" \"$@\"; }\n" + script + "\n");
    return command("bash script.sh", code);
  }
  /// `limitcheck ARGUMENTS`, which gets the signal once the shell finds `ready` true.
  ///   sleeper   the seconds that a `sleep` sleeps, which must not be left behind (else the exit code is 9)
  Outcome signalled(const std::string& arguments, const std::string& ready, const std::string& signal,
                    const std::string& sleeper = "-") const {
    return shell("mkdir -p tmp; TMPDIR=$PWD/tmp env --default-signal '" LIMITCHECK_PROGRAM "' " + arguments +
                 " &\nfor k in {1..600}; do " + ready + " && break; sleep 0.05; done\nkill -" + signal +
                 " $!\nwait $!\ncode=$?\nls tmp\nfor k in {1..100}; do grep -aqs 'sle[e]p." + sleeper +
                 "' /proc/[0-9]*/cmdline || exit $code; sleep 0.05; done\nexit 9");
  }
  Outcome command(const std::string& words, std::optional<int> code = {}) const {
    const int status = std::system(
        ("cd '" + folder_.string() + "' && " + words + " > .stdout 2> .stderr < /dev/null").c_str());
    const Outcome o{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(".stdout"), read(".stderr")};
    EXPECT_TRUE(!code || o.code == *code) << words << ": " << o.code << "\n" << o.out << o.err;
    return o;
  }
  /// What a command prints as JSON, or has written to a file.
  nlohmann::json json_of(const std::string& arguments, std::optional<int> code = {}) const {
    const Outcome o = run(arguments, code);
    nlohmann::json json = nlohmann::json::parse(o.out, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << o.out << o.err;
    return json;
  }
  nlohmann::json json_in(const std::filesystem::path& name) const {
    return nlohmann::json::parse(read(name));
  }
  /// Each is refused: exit code 2, a sentence on standard error, nothing on standard output.
  void expect_refused(const std::string& command, const std::vector<std::string>& all_arguments) const {
    for (const std::string& arguments : all_arguments) {
      const Outcome o = run(command + " " + arguments);
      EXPECT_EQ(o.code, 2) << command << " " << arguments;
      EXPECT_NE(o.err, "") << command << " " << arguments;
      EXPECT_EQ(o.out, "") << command << " " << arguments;
    }
  }
  std::string read(const std::filesystem::path& name) const { return contents_of(folder_ / name); }
  void write(const std::filesystem::path& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  const TestFolder test_folder_;
  const std::filesystem::path folder_ = test_folder_.path();
};

}  // namespace limitcheck::cli
