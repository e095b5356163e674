// SPDX-License-Identifier: MIT
// `limitcheck audit --checks LIST` and `--rerun REPORT`: which rows are looked at.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "data/error.h"
#include "data/io/whole_content.h"
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
    if (std::find(known.begin(), known.end(), check) == known.end())
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
  if (read_numbers(text, ':', sampling.faces, sampling.seed) == 0 || sampling.faces == 0)
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
    if (std::find(again.subjects.begin(), again.subjects.end(), r.subject) == again.subjects.end())
      again.subjects.push_back(r.subject);
    again.findings.push_back(std::move(r));
  }
  return again;
}

bool Rerun::has(const std::string& subject, const verify::AuditMesh& mesh, std::string_view check) const {
  const verify::Case at{mesh.name, mesh.depth, mesh.depths, mesh.sample ? mesh.sample->text() : ""};
  return std::any_of(findings.begin(), findings.end(), [&](const verify::Result& r) {
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
      asked.list.push_back(open_audit_mesh(r.mesh, options, r.depth, r.depths, parse_sample(r.sample)).mesh);
      asked.list.back().relations = false;
    }
    const auto& relations = verify::relation_rows();
    if (std::find(relations.begin(), relations.end(), r.check) != relations.end())
      asked.list[at->second].relations = true;
  }
  return asked;
}

void refuse_with_shards(const AuditArguments& a) {
  if (a.shard.of().is_whole()) return;
  a.shard.check();
  for (const auto& [option, given] :
       {std::pair{"--baseline", !a.output.baseline.empty()},
        std::pair{"--save-baseline", !a.output.save_baseline.empty()},
        std::pair{"--waivers", !a.output.waivers.empty()}, std::pair{"--require", !a.output.required.empty()},
        std::pair{"--require-coverage", a.output.require_coverage}})
    if (given)
      throw data::ArgumentError(
          fmt::format("{} needs the whole report: it is an option of limitcheck merge", option));
  if (a.must_refuse) throw data::ArgumentError("--must-refuse has no shards");
  if (!a.report.empty()) throw data::ArgumentError("--report needs the whole report, and a shard is a part");
}

void refuse_what_has_no_effect(const CLI::App& command, const AuditArguments& a, bool files) {
  static const std::set<std::string> kOfFiles{"--all-rows", "--color",         "--sarif",   "--markdown",
                                              "--scheme",   "--triangulate",   "--threads", "--json",
                                              "--details",  "--require",       "--junit",   "--waivers",
                                              "--baseline", "--save-baseline", "--html",    "--witnesses"};
  static const std::set<std::string> kNotAgain{
      "SUBJECT",       "MESH",       "--checks",      "--depth",           "--depths",  "--sample",
      "--exhaustive",  "--scheme",   "--triangulate", "--option",          "--program", "--level",
      "--must-refuse", "--baseline", "--shard",       "--require-coverage"};
  for (const CLI::Option* option : command.get_options()) {
    const std::string& name = option->get_name();
    if (option->count() == 0) continue;
    if (name == "--checks" && a.checks.empty()) throw data::ArgumentError("--checks names no check");
    if (files && option->get_group() != kFilesGroup && !kOfFiles.contains(name))
      throw data::ArgumentError(
          fmt::format("{} has no effect on finished tessellations (--tessellation)", name));
    if (!a.rerun.empty() && kNotAgain.contains(name))
      throw data::ArgumentError(
          fmt::format("{} has no effect with --rerun, which looks at what the report says", name));
  }
  if (a.must_refuse && !a.checks.empty())
    throw data::ArgumentError("--checks has no effect with --must-refuse, which looks at one thing alone");
  const std::vector<std::string> left_out = left_out_by(a.checks);
  if (a.output.require_coverage && std::count(left_out.begin(), left_out.end(), "positions") > 0)
    throw data::ArgumentError("--require-coverage needs positions, which --checks leaves out");
}

}  // namespace limitcheck::cli
