// SPDX-License-Identifier: MIT
#include "verify/proof/proof_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

namespace limitcheck::verify {
namespace {

/// What a line of the table adds up.
struct Line {
  std::string group, kernel, arithmetic;
  std::int64_t topologies = 0, equal = 0, points = 0;
  int first_depth = std::numeric_limits<int>::max(), last_depth = 0;
  double digits = std::numeric_limits<double>::infinity();
  std::optional<BoundProof> bound;

  void add(const ProofRow& row) {
    ++topologies;
    equal += row.map.equal ? 1 : 0;
    points += row.points;
    first_depth = std::min(first_depth, row.first_depth);
    last_depth = std::max(last_depth, row.last_depth);
    digits = std::min(digits, row.map.digits);
    if (!row.bound) return;
    if (!bound) bound.emplace();
    bound->position_bound = std::max(bound->position_bound, row.bound->position_bound);
    bound->position_worst = std::max(bound->position_worst, row.bound->position_worst);
    bound->tangent_bound = std::max(bound->tangent_bound, row.bound->tangent_bound);
    bound->tangent_worst = std::max(bound->tangent_worst, row.bound->tangent_worst);
    bound->share = std::max(bound->share, row.bound->share);
    bound->last_depth = std::max(bound->last_depth, row.bound->last_depth);
  }

  std::string map() const {
    if (equal < topologies) return fmt::format("{} DIFFER", topologies - equal);
    if (arithmetic == "digits") return fmt::format("{:.1f} digits", digits);
    return arithmetic == "exact" ? "exact" : "exact mod p q";
  }
};

std::string describe(const Witness& w) {
  const std::string point = w.control_point < 0   ? ""
                            : w.control_point < 4 ? fmt::format(", control point {} (corner {})",
                                                                w.control_point, "ABCD"[w.control_point])
                                                  : fmt::format(", control point {}", w.control_point);
  return fmt::format("{}: {}{} is {}, should be {}", w.point, w.quantity, point, w.found, w.expected);
}

}  // namespace

bool ProofReport::held() const {
  return std::ranges::all_of(rows_, [](const auto& rows) {
    return std::ranges::all_of(
        rows, [](const ProofRow& row) { return row.map.equal && (!row.bound || row.bound->share <= 1); });
  });
}

std::string ProofReport::table(bool each) const {
  std::vector<Line> lines;
  std::map<std::string, std::size_t> index;
  std::string failures;
  std::int64_t points = 0;
  for (std::size_t t = 0; t < rows_.size(); ++t) {
    const std::string& group = set_.tasks[t].group;
    for (const ProofRow& row : rows_[t]) {
      const std::string name = each ? row.topology : group;
      const auto [at, fresh] = index.emplace(
          fmt::format("{}/{}/{}/{}", group, name, row.kernel, row.map.arithmetic), lines.size());
      if (fresh) {
        lines.emplace_back();
        lines.back().group = name;
        lines.back().kernel = row.kernel;
        lines.back().arithmetic = row.map.arithmetic;
      }
      lines[at->second].add(row);
      points += row.points;
      if (row.map.witness)
        failures += fmt::format("DIFFERS  {} {} {}\n         {}\n", group, row.topology, row.kernel,
                                describe(*row.map.witness));
    }
  }
  std::size_t width = 10;
  for (const Line& line : lines) width = std::max(width, line.group.size());
  std::string text = fmt::format("{:<{}}  {:<15}  {:>10}  {:>6}  {:>9}  {:<13}  {:>9}  {:>9}  {:>6}\n",
                                 each ? "A B C D" : "topologies", width, "kernel", "topologies", "depths",
                                 "points", "map", "bound", "worst", "slack");
  for (const Line& line : lines) {
    text += fmt::format(
        "{:<{}}  {:<15}  {:>10}  {:>6}  {:>9}  {:<13}", line.group, width, line.kernel, line.topologies,
        line.first_depth == line.last_depth ? fmt::format("{}", line.last_depth)
                                            : fmt::format("{}-{}", line.first_depth, line.last_depth),
        line.points, line.map());
    if (line.bound)
      text +=
          fmt::format("  {:>9.2e}  {:>9.2e}  {:>6.1f}", line.bound->position_bound,
                      line.bound->position_worst, line.bound->position_bound / line.bound->position_worst);
    text += '\n';
  }
  text += failures;
  if (!set_.impossible.empty())
    text +=
        fmt::format("No face of a manifold mesh has the valences {}.\n", fmt::join(set_.impossible, ", "));
  text += fmt::format("{}: {} limit points.\n", held() ? "Every map is the reference's" : "Some maps DIFFER",
                      points);
  return text;
}

std::string ProofReport::json() const {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t t = 0; t < rows_.size(); ++t) {
    for (const ProofRow& row : rows_[t]) {
      nlohmann::ordered_json j;
      j["group"] = set_.tasks[t].group;
      j["topology"] = row.topology;
      j["kernel"] = row.kernel;
      j["depths"] = {row.first_depth, row.last_depth};
      j["points"] = row.points;
      j["map"] = row.map.equal ? "equal" : "differs";
      j["arithmetic"] = row.map.arithmetic;
      j["digits"] = std::isfinite(row.map.digits) ? nlohmann::ordered_json(row.map.digits) : nullptr;
      if (row.map.witness) {
        const Witness& w = *row.map.witness;
        j["witness"] = {{"point", w.point},
                        {"quantity", w.quantity},
                        {"control_point", w.control_point},
                        {"found", w.found},
                        {"expected", w.expected}};
      }
      if (row.bound) {
        j["bound"] = row.bound->position_bound;
        j["worst"] = row.bound->position_worst;
        j["tangent_bound"] = row.bound->tangent_bound;
        j["tangent_worst"] = row.bound->tangent_worst;
        j["bound_depth"] = row.bound->last_depth;
        j["worst_share"] = row.bound->share;
      }
      rows.push_back(std::move(j));
    }
  }
  const nlohmann::ordered_json document = {{"held", held()}, {"rows", rows}, {"impossible", set_.impossible}};
  return document.dump(2);
}

}  // namespace limitcheck::verify
