// SPDX-License-Identifier: MIT
#include <memory>
#include <optional>
#include <string>

#include "verify/cli/commands.h"
#include "verify/host/in_turns.h"
#include "verify/host/isolation/worker.h"
#include "verify/subject/registry.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::cli {

void add_worker(CLI::App& app, int& exit_code) {
  struct Arguments {
    std::string kind, what;
    bool in_turns = false;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("worker", "Serve one subject to an audit, on standard input and output");
  command->group("");
  command->add_option("KIND", a->kind)->required()->check(CLI::IsMember({"library", "built-in"}));
  command->add_option("WHAT", a->what, "A shared library, or the name of a built-in subject")->required();
  command->add_flag("--in-turns", a->in_turns, "Ask it for other things in between");
  command->callback([a, &exit_code] {
    std::optional<verify::InTurns> turns;
    exit_code = verify::serve([&]() -> const lc_subject& {
      const lc_subject* subject =
          a->kind == "library" ? &verify::load_subject(a->what) : verify::find_subject(a->what);
      if (subject == nullptr)
        throw verify::SubjectError(LC_INVALID_INPUT, "there is no such built-in subject");
      return a->in_turns ? turns.emplace(*subject).subject() : *subject;
    });
  });
}

}  // namespace limitcheck::cli
