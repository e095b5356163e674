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

int run(int argc, char** argv) {
  CLI::App app{
      "limitcheck: is a tessellator of subdivision surfaces right, by how much is it not, and how fast is "
      "it?"};
  app.set_version_flag("--version", "limitcheck " LIMITCHECK_VERSION);
  app.require_subcommand(1);
  app.footer("Exit codes: 0 all held, 1 findings, 2 bad usage or input.");

  int exit_code = kHeld;
  add_audit(app, exit_code);
  add_eval(app, exit_code);
  add_claims(app, exit_code);
  add_generate(app, exit_code);
  add_check(app, exit_code);
  add_repair(app, exit_code);
  add_prove(app, exit_code);
  add_mutants(app, exit_code);
  add_tessellate(app, exit_code);
  add_external(app, exit_code);
  add_worker(app, exit_code);

  try {
    app.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    if (argc < 2) return app.exit(CLI::CallForHelp()), kBadInput;
    if (app.get_subcommands().empty() && argv[1][0] != '-') {
      fmt::print(stderr, "limitcheck: there is no command '{}'\nRun with --help for more information.\n",
                 argv[1]);
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
