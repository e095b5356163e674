// SPDX-License-Identifier: MIT
// limitcheck prove: the kernels are the right linear maps, for every geometry of a topology.
#include <fmt/core.h>

#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "verify/cli/commands.h"
#include "verify/cli/progress.h"
#include "verify/proof/proof_report.h"
#include "verify/proof/proof_set.h"

namespace limitcheck::cli {
namespace {

struct Request {
  std::string valences = "3:12", kernel = "all", set = "standard";
  int depth = 6;
  bool json = false, each = false;
};

int number(const std::string& text) {
  std::size_t end = 0;
  int value = 0;
  try {
    value = std::stoi(text, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  if (end == 0 || end != text.size() || value < 3 || value > 20)
    throw std::invalid_argument(fmt::format("--valences: '{}' is not a valence from 3 to 20", text));
  return value;
}

/// "3:12" or "3,4,6"
std::vector<int> valences(const std::string& text) {
  std::vector<int> result;
  if (const auto colon = text.find(':'); colon != std::string::npos) {
    for (int n = number(text.substr(0, colon)); n <= number(text.substr(colon + 1)); ++n) result.push_back(n);
    if (result.empty()) throw std::invalid_argument("--valences: " + text + " holds none");
    return result;
  }
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    result.push_back(number(text.substr(from, comma - from)));
    from = comma + 1;
  }
  std::ranges::sort(result);
  result.erase(std::ranges::unique(result).begin(), result.end());
  return result;
}

bool run(const Request& request) {
  verify::ProofRequest what;
  what.valences = valences(request.valences);
  what.depth = request.depth;
  what.sliding_window = request.kernel != "row-stream";
  what.row_stream = request.kernel != "sliding-window";
  what.size = request.set == "full" ? verify::ProofSize::kFull : verify::ProofSize::kStandard;
  const verify::ProofSet set = verify::proof_set(what);
  Progress progress;
  const auto rows = verify::prove(set.tasks, [&](std::size_t done) {
    progress.show(done, set.tasks.size(),
                  set.tasks[done - 1].group + " " + set.tasks[done - 1].neighbourhood.name);
  });
  progress.clear();
  const verify::ProofReport report(set, rows);
  if (request.json) {
    fmt::print("{}\n", report.json());
  } else {
    fmt::print("{}", report.table(request.each));
  }
  return report.held();
}

}  // namespace

void add_prove(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "prove",
      "Prove that the kernels compute the exact limit surface, whatever the geometry, topology by topology");
  auto request = std::make_shared<Request>();
  command
      ->add_option("--valences", request->valences, "Interior valences of the triples: 3:12, or a list 3,4,6")
      ->capture_default_str();
  command->add_option("--depth", request->depth, "Deepest subdivision")
      ->check(CLI::Range(0, 8))
      ->capture_default_str();
  command->add_option("--kernel", request->kernel, "The kernel")
      ->check(CLI::IsMember({"sliding-window", "row-stream", "all"}))
      ->capture_default_str();
  command->add_option("--set", request->set, "How much: standard takes minutes, full much longer")
      ->check(CLI::IsMember({"standard", "full"}))
      ->capture_default_str();
  command->add_flag("--each", request->each, "A line for every topology, not for every group of them");
  command->add_flag("--json", request->json, "One JSON document with every topology");
  command->callback([request, &exit_code] { exit_code = run(*request) ? kHeld : kFindings; });
}

}  // namespace limitcheck::cli
