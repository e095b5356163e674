// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <memory>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/io/whole_content.h"
#include "verify/audit/json.h"
#include "verify/cli/commands.h"
#include "verify/hunt/hunt_report.h"

namespace limitcheck::cli {

void add_merge(CLI::App& app, int& exit_code) {
  struct Arguments {
    std::vector<std::string> parts;
    std::string output;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("merge", "Join the reports of all parts of a hunt that --shard has made");
  command
      ->add_option("PART", a->parts, "The reports that limitcheck hunt --shard K/N --json FILE has written")
      ->required();
  command->add_option("-o,--output", a->output, "The report of the whole, as a hunt in one piece writes it")
      ->required();
  command->footer(
      "Exit codes: 0 there is no finding, 1 findings, 2 a part is missing, there twice, incomplete or of "
      "another hunt.");
  command->callback([a, &exit_code] {
    std::vector<verify::HuntReport> parts;
    for (const std::string& file : a->parts) try {
        parts.push_back(verify::read_hunt_report(data::io::whole_content(file)));
      } catch (const data::ArgumentError& error) {
        throw data::ArgumentError(fmt::format("{}: {}", file, error.what()));
      }
    const verify::HuntReport whole = verify::merged(parts);
    verify::write_text(a->output, verify::to_json(whole));
    fmt::print("{}", verify::to_text(whole));
    exit_code = verify::new_findings(whole, nullptr).empty() ? kHeld : kFindings;
  });
}

}  // namespace limitcheck::cli
