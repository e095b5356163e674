// SPDX-License-Identifier: MIT
// Commands that are separate programs: they need libraries that limitcheck does without, or run limitcheck
// itself.
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "verify/cli/commands.h"

namespace limitcheck::cli {

namespace {

namespace fs = std::filesystem;

/// limitcheck-NAME beside this program, in bench/ of a
/// build tree, or where it is installed. Empty: not built.
fs::path find_program(const std::string& name) {
  std::error_code ignored;
  const fs::path here = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const char* folder : {".", "bench", "../libexec/limitcheck"}) {
    fs::path path = here / folder / ("limitcheck-" + name);
    if (access(path.c_str(), X_OK) == 0) return path;
  }
  return {};
}

// Returns only if it fails.
void become(const fs::path& path, const std::vector<std::string>& arguments) {
  std::string program = path.string();
  std::vector<std::string> copies = arguments;
  std::vector<char*> list{program.data()};
  for (std::string& argument : copies) list.push_back(argument.data());
  list.push_back(nullptr);
  execv(program.c_str(), list.data());
  fmt::print(stderr, "limitcheck: {}: {}\n", program, std::strerror(errno));
}

void add(CLI::App& app, int& exit_code, const std::string& name, const std::string& description) {
  CLI::App* command = app.add_subcommand(name, description);
  command->set_help_flag();  // the program has its own
  command->prefix_command();
  command->callback([command, name, &exit_code] {
    exit_code = kBadInput;
    const fs::path path = find_program(name);
    if (path.empty()) {
      fmt::print(stderr, "limitcheck: '{}' is not built; configure with -DLIMITCHECK_BENCH=ON\n", name);
    } else {
      become(path, command->remaining());
    }
  });
}

}  // namespace

void add_external(CLI::App& app, int& exit_code) {
  add(app, exit_code, "reproduce",
      "Reproduce the paper: claims, tables, figures, and one page that shows them");
  add(app, exit_code, "bench", "Performance tracking: measure, compare, hold exact costs, draw the trend");
}

}  // namespace limitcheck::cli
