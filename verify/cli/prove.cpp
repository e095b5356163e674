// SPDX-License-Identifier: MIT
// limitcheck-prove, a program of its own that limitcheck prove hands over to: the kernels are the right linear maps, for every geometry of a topology.

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "data/error.h"
#include "data/io/whole_content.h"
#include "data/numeral.h"
#include "data/scheme.h"
#include "data/untrusted_json.h"
#include "verify/cli/commands.h"
#include "verify/cli/units.h"
#include "verify/interrupt/interrupt.h"
#include "verify/proof/proof_set.h"
#include "verify/report/json.h"

namespace limitcheck::cli {
namespace {

/// "3:12", "3,4,6" or both.
std::vector<int> valences(const std::string& text) {
  std::set<int> all;
  for (const std::string& word : CLI::detail::split(text, ',')) {
    int first = 0, last = 0;
    const int numbers = data::read_numbers(word, ':', first, last);
    if (numbers == 1) last = first;
    if (numbers == 0 || first < 3 || first > last || last > 20)
      throw data::ArgumentError(
          fmt::format("--valences: '{}' is no valence from 3 to 20, nor FROM:TO", word));
    while (first <= last) all.insert(first++);
  }
  return {all.begin(), all.end()};
}

verify::ProofRequest as_request(const ProveRequest& request) {
  using verify::ProofSize;
  const bool quads = request.scheme == "catmull-clark";
  return {quads ? data::Scheme::kCatmullClark : data::Scheme::kLoop,
          valences(!request.valences.empty() ? request.valences
                   : quads                   ? "3:8"
                                             : "3:12"),
          request.depth,
          request.kernel != "row-stream",
          request.kernel != "sliding-window",
          request.set == "full"     ? ProofSize::kFull
          : request.set == "sample" ? ProofSize::kSample
                                    : ProofSize::kStandard};
}

// Each task of the set is a unit, and behind them the stock shapes are one.
verify::Plan plan_of(const ProveRequest& request, const verify::ProofSet& set) {
  nlohmann::json what{{"version", LIMITCHECK_VERSION}, {"scheme", request.scheme},
                      {"valences", request.valences},  {"depth", request.depth},
                      {"kernel", request.kernel},      {"set", request.set}};
  std::map<std::string, int> groups;
  for (const verify::ProofTask& task : set.tasks) ++groups[task.group];
  what["groups"] = groups;
  return {"limitcheck prove", std::move(what), set.tasks.size() + 1};
}

// The tasks of the journal's shard that it does not know.
void prove_tasks(const verify::ProofSet& set, verify::Journal& journal, Progress& progress) {
  std::vector<verify::ProofTask> tasks;
  std::vector<std::size_t> units;
  for (std::size_t unit = 0; unit < set.tasks.size(); ++unit) {
    if (!journal.plan().has(unit) || journal.recall(unit) != nullptr) continue;
    tasks.push_back(set.tasks[unit]);
    units.push_back(unit);
  }
  (void)verify::prove(
      tasks,
      [&](const verify::ProofProgress& done) {
        if (!done.rows->empty())
          journal.keep(units[static_cast<std::size_t>(done.latest - tasks.data())],
                       verify::list_json(*done.rows));
        progress.show(static_cast<std::size_t>(100 * done.share), 100,
                      fmt::format("proof {} of {}, {} {}", done.tasks, tasks.size(), done.latest->group,
                                  done.latest->neighbourhood.name));
      },
      [] { return verify::interrupted() != 0; });
}

void certify(const verify::ProofSet& set, verify::Journal& journal) {
  const std::size_t unit = journal.plan().units - 1;
  if (!journal.plan().has(unit) || journal.recall(unit) != nullptr || verify::interrupted() != 0) return;
  auto lines = set.certified;
  verify::certify(lines, set.certified_points);
  journal.keep(unit, verify::list_json(lines));
}

int report_proofs(const verify::PartReport& done, const std::string& json, bool each) {
  const nlohmann::json& plan = done.plan.what;
  ProveRequest request;
  plan.at("scheme").get_to(request.scheme), plan.at("valences").get_to(request.valences);
  data::read_value(plan.at("depth"), request.depth), plan.at("kernel").get_to(request.kernel);
  plan.at("set").get_to(request.set);
  const verify::ProofSet set = verify::proof_set(as_request(request));
  if (plan_of(request, set).what != plan)
    throw data::ArgumentError("the parts are of another version of limitcheck");
  std::vector<std::vector<verify::ProofRow>> rows(set.tasks.size());
  std::vector<verify::CertifiedLine> certified;
  for (const auto& [unit, result] : done.results) {
    if (unit == rows.size()) {
      certified = verify::list_of<verify::CertifiedLine>(result);
      continue;
    }
    rows[unit] = verify::list_of<verify::ProofRow>(result);
    for (const verify::ProofRow& row : rows[unit])
      if (row.topology != set.tasks[unit].neighbourhood.name)
        throw data::ArgumentError(fmt::format("unit {} is of {}, and has the proof of {}", unit,
                                              set.tasks[unit].neighbourhood.name, row.topology));
  }
  const verify::ProofReport report(set, rows, std::move(certified));
  if (!done.plan.shard.is_whole()) {
    say("shard {}: {} of {} units, {}\n", done.plan.shard.text(), done.results.size(), done.plan.units,
        report.held() ? "every map is the reference's" : "some proofs FAILED");
    return report.held() ? kHeld : kFindings;
  }
  const std::string text =
      json.empty() ? report.table(each)
                   : attested("{\n  \"program\": \"limitcheck prove\"," + report.json().substr(1), plan);
  if (!json.empty() && json != "-") verify::write_text(json, text);
  say_text(stdout, json.empty() || json == "-" ? text : report.table(each));
  return report.held() && (report.complete() || !done.incomplete.empty()) ? kHeld : kFindings;
}

int prove(const ProveRequest& request) {
  if (!request.parts.empty()) {
    std::vector<verify::PartReport> parts;
    for (const std::string& file : request.parts)
      parts.push_back(verify::read_part(data::io::whole_content(file)));
    return report_proofs(verify::joined(parts), request.shard.json, request.each);
  }
  const verify::ProofSet set = verify::proof_set(as_request(request));
  const auto work = [&](verify::Journal& journal, Progress& progress) {
    prove_tasks(set, journal, progress);
    certify(set, journal);
  };
  return run_units(request.shard, plan_of(request, set), work, [&](const verify::PartReport& done) {
    return report_proofs(done, request.shard.json, request.each);
  });
}

}  // namespace
}  // namespace limitcheck::cli

int main(int argc, char** argv) {
  using namespace limitcheck::cli;
  CLI::App app{"limitcheck: proofs that kernels compute the exact limit surface"};
  show_examples(app);
  int exit_code = kHeld;
  add_prove(app, [&exit_code](const ProveRequest& request) { exit_code = prove(request); });
  return run_program(app, argc, argv, exit_code);
}
