// SPDX-License-Identifier: MIT

#include "verify/cli/commands.h"
#include "verify/cli/units.h"
#include "verify/host/isolation/worker.h"
#include "verify/subject/registry.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::cli {
namespace {

// A command that is a separate program: it needs libraries that limitcheck does without, or runs limitcheck itself.
void add_external(CLI::App& app, int& exit_code, const std::string& name, const std::string& description) {
  CLI::App* command = app.add_subcommand(name, description);
  command->set_help_flag();  // the program has its own
  command->prefix_command();
  command->callback([command, name, &exit_code] { exit_code = hand_over(name, command->remaining()); });
}

const lc_subject& built_in(const std::string& name) {
  if (const lc_subject* subject = verify::find_subject(name)) return *subject;
  throw verify::SubjectError(LC_INVALID_INPUT, "there is no such built-in subject");
}

int run(int argc, char** argv) {
  CLI::App app{
      "limitcheck: is a tessellator of subdivision surfaces right, by how much is it not, and how fast is "
      "it?"};
  show_examples(app);
  app.footer(
      "Documentation: README.md, verify/subject/README.md, or share/doc/limitcheck where it is installed.\n"
      "Exit codes: 0 all held, 1 findings, 2 bad usage or input, 141 where nobody reads standard output any "
      "more.");

  int exit_code = kHeld;
  add_audit(app, exit_code);
  add_hunt(app, exit_code);
  add_merge(app, exit_code);
  add_eval(app, exit_code);
  add_claims(app, exit_code);
  add_generate(app, exit_code);
  add_check(app, exit_code);
  add_repair(app, exit_code);
  add_prove(app, [&exit_code](const ProveRequest&) { exit_code = hand_over("prove"); });
  add_mutants(app, exit_code);
  add_tessellate(app, exit_code);
  add_external(app, exit_code, "reproduce",
               "Reproduce the paper: claims, tables, figures, and one page that shows them");
  add_external(app, exit_code, "bench",
               "Performance tracking: measure, compare, hold exact costs, draw the trend");
  add_external(app, exit_code, "shader", "A GLSL file of `audit --shader` as GLSL for Vulkan");

  return run_program(app, argc, argv, exit_code);
}

}  // namespace
}  // namespace limitcheck::cli

int main(int argc, char** argv) {
  // The process that isolated subjects run in.
  if (argc > 1 && std::string_view(argv[1]) == "worker")
    return limitcheck::verify::serve(argc, argv, "built-in", limitcheck::cli::built_in);
  return limitcheck::cli::run(argc, argv);
}
