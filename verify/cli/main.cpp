// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <exception>

#include "verify/cli/commands.h"

int main(int argc, char** argv) {
  using namespace limitcheck::cli;
  CLI::App app{
      "limitcheck: is a Loop subdivision tessellator right, by how much is it not, and how fast is it?"};
  app.set_version_flag("--version", "limitcheck " LIMITCHECK_VERSION);
  app.require_subcommand(1);
  app.footer("Exit codes: 0 all held, 1 findings, 2 bad usage or input.");

  int exit_code = kHeld;
  add_audit(app, exit_code);
  add_eval(app, exit_code);
  add_claims(app, exit_code);
  add_generate(app, exit_code);
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
  } catch (const std::exception& error) {
    fmt::print(stderr, "limitcheck: {}\n", error.what());
    return kBadInput;
  }
  return exit_code;
}
