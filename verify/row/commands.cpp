// SPDX-License-Identifier: MIT
#include "verify/row/commands.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>
#include <vector>

#include "verify/subject/shell_word.h"

namespace limitcheck::verify {
namespace {

bool uniform(const Result& r) {
  return r.depths.empty() || r.depths == "uniform";
}

// So that the mesh is opened again as it was: a mesh of triangles is taken for Loop's unless it is said
// otherwise.
std::string mesh_options(const Result& result) {
  std::string text;
  if (result.scheme != data::Scheme::kLoop) text += fmt::format(" --scheme {}", data::name_of(result.scheme));
  if (!result.triangulated.empty()) text += fmt::format(" --triangulate {}", result.triangulated);
  return text;
}

std::string depth_options(const Result& result) {
  if (result.depths.empty() || result.depths == "uniform") return "";
  return fmt::format(" --depths {}", shell_word(result.depths));
}

bool names_a_point(const Result& result) {
  return result.witness && result.witness->face >= 0 && !result.witness->l1.empty();
}

}  // namespace

std::string case_name(const Report& report, const Result& r) {
  if (report.depths != "plan") return r.mesh;
  return fmt::format("{} ({}{}{})", r.mesh, uniform(r) ? fmt::format("depth {}", r.depth) : r.depths,
                     r.sample.empty() ? "" : ", sample ", r.sample);
}

std::string depths_in_short(std::span<const Result* const> results) {
  std::set<int> depths;
  bool unequal = false;
  for (const Result* r : results) {
    if (!looked_at(*r)) continue;
    if (uniform(*r))
      depths.insert(r->depth);
    else
      unequal = true;
  }
  std::vector<std::string> runs;
  for (auto first = depths.begin(); first != depths.end();) {
    auto last = first;
    while (std::next(last) != depths.end() && *std::next(last) == *last + 1) ++last;
    runs.push_back(first == last ? fmt::format("{}", *first) : fmt::format("{}-{}", *first, *last));
    first = std::next(last);
  }
  return fmt::format("{}{}", fmt::join(runs, " "), unequal ? "*" : "");
}

std::string depths_in_full(const Report& report, const std::string& subject) {
  std::set<int> depths;
  std::vector<std::string> unequal;
  for (const Result& r : report.results) {
    if (r.subject != subject || !looked_at(r)) continue;
    if (uniform(r))
      depths.insert(r.depth);
    else if (std::ranges::find(unequal, r.depths) == unequal.end())
      unequal.push_back(r.depths);
  }
  return fmt::format("{}{}{}", fmt::join(depths, " "),
                     unequal.empty() ? "" : "; *: ", fmt::join(unequal, ", "));
}

std::string eval_command(const Result& result) {
  static const std::set<std::string_view> kOfLimit{"positions",      "normals",       "finite",
                                                   "file-positions", "file-distance", "file-normals"};
  if (!names_a_point(result)) return "";
  const std::string& channel = result.witness->channel;
  if (channel.empty() && !kOfLimit.contains(result.check)) return "";
  return fmt::format("limitcheck eval {} {} {} {}{}{}{}{}", shell_word(result.mesh), result.witness->where(),
                     result.witness->l1, result.witness->l2,
                     channel.empty() ? ""
                                     : fmt::format(" --channel {} --channel-rule {}", shell_word(channel),
                                                   result.witness->rule),
                     mesh_options(result), result.precision == LC_FLOAT32 ? " --precision float" : "",
                     result.weights == reference::Weights::kWarren ? " --weights warren" : "");
}

std::string difference_command(const Result& result) {
  static const std::set<std::string_view> kOfPoints{
      "positions", "refined-positions", "normals",       "normal-length",
      "finite",    "shared-positions",  "shared-normals"};
  if (!names_a_point(result) || !kOfPoints.contains(result.check)) return "";
  return fmt::format("limitcheck eval --subject {} {} {} {} {} --depth {}{}{}", shell_word(result.subject),
                     shell_word(result.mesh), result.witness->where(), result.witness->l1, result.witness->l2,
                     result.depth, depth_options(result), mesh_options(result));
}

std::string audit_command(const Result& result, const std::string& level) {
  if (result.check.starts_with("file-"))
    return fmt::format("limitcheck audit --control {} --tessellation {}", shell_word(result.mesh),
                       shell_word(result.subject)) +
           mesh_options(result) + result.file_options;
  std::string command = fmt::format("limitcheck audit {} {} --depth {}", shell_word(result.subject),
                                    shell_word(result.mesh), result.depth) +
                        mesh_options(result);
  if (level != "standard") command += fmt::format(" --level {}", level);
  command += depth_options(result);
  if (!result.sample.empty()) command += " --sample " + result.sample;
  return command;
}

}  // namespace limitcheck::verify
