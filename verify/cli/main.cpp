// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "verify/cli/commands.h"

namespace limitcheck::cli {
namespace {

// A standard stream that the caller has closed would become the next file that is opened, and what is meant
// for the one would land in the other. Opened the wrong way round, so that its use is still an error.
void occupy_standard_streams() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(fd, F_GETFD) < 0) (void)open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

// If there is no standard error either, nothing can be reported.
void complain(const std::string& text) {
  std::fputs(fmt::format("limitcheck: {}\n", text).c_str(), stderr);
}

// What the buffer of standard output still holds may fail to be written: then nothing was held or found.
int after_output(int exit_code) {
  if (exit_code == kBadInput) return exit_code;  // it has been said
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  complain(fmt::format("standard output cannot be written{}{}", errno != 0 ? ": " : "",
                       errno != 0 ? std::strerror(errno) : ""));
  return kBadInput;
}

// What to do next, for a word that is no command.
std::string what_was_meant(const std::string& word) {
  if (word.find('.') == std::string::npos && word.find('/') == std::string::npos)
    return "Run with --help for more information.\n";
  return fmt::format(
      "To look at a mesh:             limitcheck check {0}\n"
      "To audit all tessellators:     limitcheck audit {0}\n"
      "To audit one of them:          limitcheck audit row-stream {0}\n"
      "To tessellate it:              limitcheck tessellate {0} -o fine.obj\n"
      "Run with --help for more information.\n",
      word);
}

int run(int argc, char** argv) {
  CLI::App app{
      "limitcheck: is a tessellator of subdivision surfaces right, by how much is it not, and how fast is "
      "it?"};
  app.set_version_flag("--version", "limitcheck " LIMITCHECK_VERSION);
  app.require_subcommand(1);
  app.footer(
      "First steps: limitcheck check mesh.obj; limitcheck audit mesh.obj; limitcheck COMMAND --help. "
      "Documentation: README.md, verify/subject/README.md, or share/doc/limitcheck where it is installed.\n"
      "Exit codes: 0 all held, 1 findings, 2 bad usage or input.");

  int exit_code = kHeld;
  add_audit(app, exit_code);
  add_hunt(app, exit_code);
  add_merge(app, exit_code);
  add_eval(app, exit_code);
  add_claims(app, exit_code);
  add_generate(app, exit_code);
  add_check(app, exit_code);
  add_repair(app, exit_code);
  add_prove(app, exit_code);
  add_mutants(app, exit_code);
  add_tessellate(app, exit_code);
  add_external(app, exit_code);
  add_manual(app, exit_code);
  add_worker(app, exit_code);

  // `limitcheck help COMMAND` is `limitcheck COMMAND --help`.
  std::vector<const char*> words(argv, argv + argc);
  if (argc > 1 && std::string_view(argv[1]) == "help") {
    words.erase(words.begin() + 1);
    words.push_back("--help");
  }
  try {
    app.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::RequiredError& error) {
    if (argc < 2) return app.exit(CLI::CallForHelp()), kBadInput;
    if (app.get_subcommands().empty() && argv[1][0] != '-') {
      fmt::print(stderr, "limitcheck: there is no command '{}'\n{}", argv[1], what_was_meant(argv[1]));
      return kBadInput;
    }
    app.exit(error);
    return kBadInput;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kHeld : kBadInput;
  } catch (const std::bad_alloc&) {
    std::fputs("limitcheck: out of memory\n", stderr);
    return kBadInput;
  } catch (const std::exception& error) {
    complain(error.what());
    return kBadInput;
  }
  return exit_code;
}

}  // namespace
}  // namespace limitcheck::cli

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing, not an end in the middle
  limitcheck::cli::occupy_standard_streams();
  return limitcheck::cli::after_output(limitcheck::cli::run(argc, argv));
}
