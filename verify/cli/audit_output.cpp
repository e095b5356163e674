// SPDX-License-Identifier: MIT
#include "verify/cli/audit_output.h"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "verify/audit/explain.h"
#include "verify/audit/json.h"
#include "verify/audit/junit.h"
#include "verify/audit/waivers.h"

namespace limitcheck::cli {

void add_output_options(CLI::App& command, OutputArguments& a) {
  command
      .add_option(
          "--level", a.level,
          "quick: one tessellation of each mesh; standard: also in other order, place and size, on meshes "
          "of at most 200 faces; thorough: on all")
      ->check(CLI::IsMember({"quick", "standard", "thorough"}))
      ->capture_default_str();
  command.add_option("--junit", a.junit, "Write the results as JUnit XML to FILE")->type_name("FILE");
  command.add_option("--waivers", a.waivers, "JSON file of findings that are known and accepted for a while")
      ->check(CLI::ExistingFile)
      ->type_name("FILE");
  command
      .add_option("--explain", a.explain,
                  "Say what a check means, its bound, and where that comes from; or all")
      ->type_name("CHECK");
}

verify::Level level(const OutputArguments& a) {
  return a.level == "quick"      ? verify::Level::kQuick
         : a.level == "thorough" ? verify::Level::kThorough
                                 : verify::Level::kStandard;
}

bool explained(const OutputArguments& a) {
  if (a.explain.empty()) return false;
  bool found = false;
  std::string known = "all";
  for (const auto& e : verify::explanations()) {
    known += fmt::format(", {}", e.check);
    if (a.explain != "all" && a.explain != e.check) continue;
    fmt::print("{}{}\n  meaning  {}\n  bound    {}\n  from     {}\n", found ? "\n" : "", e.check, e.meaning,
               e.bound, e.source);
    found = true;
  }
  if (!found)
    throw std::invalid_argument(fmt::format("there is no check '{}'; there are: {}", a.explain, known));
  return true;
}

void waive(const OutputArguments& a, const std::vector<verify::AuditSubject>& subjects,
           verify::Report& report) {
  if (a.waivers.empty()) return;
  std::ifstream in(a.waivers, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::map<std::string, std::string> versions;
  for (std::size_t s = 0; s < subjects.size() && s < report.subjects.size(); ++s)
    versions[report.subjects[s]] =
        verify::version_in(subjects[s].subject->description ? subjects[s].subject->description : "");
  const auto today = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  try {
    verify::apply_waivers(report, verify::parse_waivers(text), versions,
                          fmt::format("{:%Y-%m-%d}", fmt::gmtime(today)));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", a.waivers, error.what()));
  }
}

void write_junit(const OutputArguments& a, const verify::Report& report) {
  if (!a.junit.empty()) verify::write_text(a.junit, verify::to_junit(report));
}

}  // namespace limitcheck::cli
