// SPDX-License-Identifier: MIT
// The way of a new user: installs the build to a prefix in the test's own folder, and builds projects against
// it.
#pragma once

#include "verify/cli/command_test.h"

namespace limitcheck::cli {

class InstalledTest : public CommandTest {
 protected:
  /// A command of the shell, in the test's own folder.
  Outcome shell(const std::string& words, std::optional<int> code = {}) const {
    return command("{ " + words + " ; }", code);
  }
  void install() const {
    shell("'" LIMITCHECK_CMAKE "' --install '" LIMITCHECK_BINARY_DIR "' --prefix prefix", 0);
  }
  /// Configures the project in `source` against the prefix.
  Outcome configure(const std::filesystem::path& source, const std::string& to,
                    const std::string& options = "") const {
    return shell("'" LIMITCHECK_CMAKE "' -G Ninja -S '" + source.string() + "' -B " + to +
                 " -DCMAKE_PREFIX_PATH=\"$PWD/prefix\" " LIMITCHECK_COMPILERS " " + options);
  }
  void build(const std::filesystem::path& source, const std::string& to,
             const std::string& options = "") const {
    const Outcome o = configure(source, to, options);
    ASSERT_EQ(o.code, 0) << o.out << o.err;
    shell("'" LIMITCHECK_CMAKE "' --build " + to, 0);
  }
};

}  // namespace limitcheck::cli
