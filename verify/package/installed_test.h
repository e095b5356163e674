// SPDX-License-Identifier: MIT
// The way of a new user: installs the build to a prefix in the test's own folder, and builds projects against
// it.
#pragma once

#include "verify/cli/command_test.h"

namespace limitcheck::cli {

class InstalledTest : public CommandTest {
 protected:
  /// A command of the shell, in the test's own folder.
  Outcome shell(const std::string& command) const {
    const std::string all =
        "cd '" + folder_.string() + "' && { " + command + " ; } > .stdout 2> .stderr < /dev/null";
    const int status = std::system(all.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(".stdout"), read(".stderr")};
  }
  void install() const {
    const Outcome o = shell("'" LIMITCHECK_CMAKE "' --install '" LIMITCHECK_BINARY_DIR "' --prefix prefix");
    ASSERT_EQ(o.code, 0) << o.out << o.err;
  }
  /// Configures the project in `source` against the prefix.
  Outcome configure(const std::filesystem::path& source, const std::string& to,
                    const std::string& options = "") const {
    return shell("'" LIMITCHECK_CMAKE "' -G Ninja -S '" + source.string() + "' -B " + to +
                 " -DCMAKE_PREFIX_PATH=\"$PWD/prefix\" " LIMITCHECK_COMPILERS " " + options);
  }
  void build(const std::filesystem::path& source, const std::string& to,
             const std::string& options = "") const {
    Outcome o = configure(source, to, options);
    ASSERT_EQ(o.code, 0) << o.out << o.err;
    o = shell("'" LIMITCHECK_CMAKE "' --build " + to);
    ASSERT_EQ(o.code, 0) << o.out << o.err;
  }
};

}  // namespace limitcheck::cli
