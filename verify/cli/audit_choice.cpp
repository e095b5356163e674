// SPDX-License-Identifier: MIT
// `limitcheck audit --checks LIST` and `--rerun REPORT`: which rows are looked at.
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "data/error.h"
#include "data/io/whole_content.h"
#include "data/numeral.h"
#include "verify/cli/audit.h"
#include "verify/cli/commands.h"
#include "verify/relations/relations.h"
#include "verify/report/known.h"
#include "verify/row/rows.h"

namespace limitcheck::cli {

std::vector<std::string> left_out_by(const std::string& checks) {
  if (checks.empty()) return {};
  std::vector<std::string> known;
  for (const verify::RowKind& row : verify::row_kinds())
    if (!row.check.starts_with("file-") && !row.check.starts_with("oracle-")) known.emplace_back(row.check);
  std::set<std::string, std::less<>> left_out;
  if (!checks.starts_with('-')) left_out.insert(known.begin(), known.end());
  for (const std::string& word : CLI::detail::split(checks, ',')) {
    const bool without = word.starts_with('-');
    const std::string check(verify::current_name(std::string_view(word).substr(without ? 1 : 0)));
    if (std::ranges::find(known, check) == known.end())
      throw data::ArgumentError(
          fmt::format("--checks: there is no check '{}'; there are: {}", check, fmt::join(known, ", ")));
    // Of a subject that delivers points of the refined mesh, positions are that row.
    for (const std::string& row : {check, check == "positions" ? "refined-positions" : check})
      if (without)
        left_out.insert(row);
      else
        left_out.erase(row);
  }
  left_out.erase("tessellates");  // without it nothing can be judged
  std::erase_if(known, [&](const std::string& check) { return !left_out.contains(check); });
  return known;
}

std::optional<Sampling> parse_sample(const std::string& text) {
  if (text.empty()) return std::nullopt;
  Sampling sampling;
  if (data::read_numbers(text, ':', sampling.faces, sampling.seed) == 0 || sampling.faces == 0)
    throw data::ArgumentError(fmt::format("--sample {}: FACES or FACES:SEED", text));
  return sampling;
}

Rerun findings_of(const std::string& file) {
  Rerun again;
  for (verify::Result& r : verify::reported_rows(data::io::whole_content(file), file)) {
    if (!verify::is_bad(r)) continue;
    if (r.check.starts_with("file-"))
      throw data::ArgumentError(fmt::format(
          "--rerun {}: it is of finished files; audit these again with --baseline {}", file, file));
    if (std::ranges::find(again.subjects, r.subject) == again.subjects.end())
      again.subjects.push_back(r.subject);
    again.findings.push_back(std::move(r));
  }
  return again;
}

bool Rerun::has(const std::string& subject, const verify::AuditMesh& mesh, std::string_view check) const {
  return std::ranges::any_of(findings, [&, at = verify::case_of(mesh)](const verify::Result& r) {
    return r.subject == subject && case_of(r) == at &&
           (r.check == check || check == "tessellates" || (check == "recognised" && r.check == "positions"));
  });
}

AuditedMeshes meshes_again(const Rerun& again) {
  std::map<verify::Case, std::size_t> known;
  AuditedMeshes asked{{}, "what had findings is looked at again"};
  for (const verify::Result& r : again.findings) {
    const auto [at, is_new] = known.try_emplace(case_of(r), asked.list.size());
    if (is_new) {
      data::ReadOptions options;
      options.scheme = r.scheme;
      options.polygons = triangulation(r.triangulated);
      asked.list.push_back(open_audit_mesh(r.mesh, options, r.depth, r.depths, parse_sample(r.sample)).first);
      asked.list.back().relations = false;
    }
    const auto& relations = verify::relation_rows();
    if (std::ranges::find(relations, r.check) != relations.end()) asked.list[at->second].relations = true;
  }
  return asked;
}

void refuse_what_has_no_effect(const CLI::App& command, const AuditArguments& a, bool files) {
  static const std::set<std::string> kOfFiles{"--all-rows", "--color",         "--sarif",   "--markdown",
                                              "--scheme",   "--triangulate",   "--threads", "--json",
                                              "--details",  "--require",       "--junit",   "--waivers",
                                              "--baseline", "--save-baseline", "--html",    "--witnesses"};
  for (const CLI::Option* option : command.get_options())
    if (files && option->count() > 0 && option->get_group() != kFilesGroup &&
        !kOfFiles.contains(option->get_name()))
      throw data::ArgumentError(
          fmt::format("{} has no effect on finished tessellations (--tessellation)", option->get_name()));
  if (a.checks.empty()) refuse(command, {"--checks"}, "names no check");
  if (!a.rerun.empty())
    refuse(command,
           {"SUBJECT", "MESH", "--checks", "--depth", "--depths", "--sample", "--exhaustive", "--scheme",
            "--triangulate", "--option", "--program", "--level", "--must-refuse", "--baseline", "--shard",
            "--require-coverage"},
           "has no effect with --rerun, which looks at what the report says");
  if (!a.shard.of().is_whole()) {
    a.shard.check();
    refuse(command, {"--baseline", "--save-baseline", "--waivers", "--require", "--require-coverage"},
           "needs the whole report: it is an option of limitcheck merge");
    refuse(command, {"--must-refuse"}, "has no shards");
    refuse(command, {"--report"}, "needs the whole report, and a shard is a part");
  }
  if (a.must_refuse)
    refuse(command, {"--checks"}, "has no effect with --must-refuse, which looks at one thing alone");
  if (a.output.require_coverage && std::ranges::count(left_out_by(a.checks), "positions") > 0)
    throw data::ArgumentError("--require-coverage needs positions, which --checks leaves out");
}

}  // namespace limitcheck::cli
