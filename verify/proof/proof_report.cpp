// SPDX-License-Identifier: MIT
#include "verify/proof/proof_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "verify/row/fields.h"

namespace limitcheck::verify {
namespace {

/// What a line of the table adds up.
struct Line {
  std::string group, kernel, arithmetic;
  std::int64_t topologies = 0, equal = 0, points = 0;
  double seconds = 0;
  int first_depth = std::numeric_limits<int>::max(), last_depth = 0;
  double digits = std::numeric_limits<double>::infinity();
  std::optional<BoundProof> bound;
  std::optional<CostProof> cost;

  void add(const ProofRow& row) {
    ++topologies;
    equal += row.map.equal ? 1 : 0;
    points += row.points;
    seconds += row.seconds;
    first_depth = std::min(first_depth, row.first_depth);
    last_depth = std::max(last_depth, row.last_depth);
    digits = std::min(digits, row.map.digits);
    if (row.cost && (!cost || row.cost->flops > cost->flops)) cost = row.cost;
    if (row.bound && bound)
      bound->add(*row.bound);
    else if (row.bound)
      bound = row.bound;
  }

  std::string map() const {
    if (equal < topologies) return fmt::format("{} DIFFER", topologies - equal);
    if (arithmetic == "digits") return fmt::format("{:.1f} digits", digits);
    return arithmetic == "exact" ? "exact" : "exact mod p q";
  }
};

std::string range(int first, int last) {
  return first == last ? fmt::format("{}", last) : fmt::format("{}-{}", first, last);
}

std::string describe(const MapWitness& w) {
  const std::string point = w.control_point < 0   ? ""
                            : w.control_point < 4 ? fmt::format(", control point {} (corner {})",
                                                                w.control_point, "ABCD"[w.control_point])
                                                  : fmt::format(", control point {}", w.control_point);
  return fmt::format("{}: {}{} is {}, should be {}", w.point, w.quantity, point, w.found, w.expected);
}

std::string describe(const ShippedProof& p) {
  if (!p.unlike.empty()) return fmt::format("{} has other bits than the scalar code", p.unlike);
  return fmt::format("an error of {:.3f} times its bound in a position, {:.3f} in a normal", p.position_share,
                     p.normal_share);
}

}  // namespace

/// The structured bindings name all members: with a new one this does not compile until it is written, too.
static void visit_fields(Is<MapWitness> auto& w, auto&& visit) {
  auto& [point, quantity, control_point, found, expected] = w;
  visit_each(visit, point, quantity, control_point, found, expected);
}
static void visit_fields(Is<MapProof> auto& m, auto&& visit) {
  auto& [equal, arithmetic, digits, witness] = m;
  visit_each(visit, equal, arithmetic, digits, witness);
}
static void visit_fields(Is<BoundProof> auto& b, auto&& visit) {
  auto& [first, last, position, position_worst, tangent, tangent_worst, normal, product, share, alike,
         shipped] = b;
  auto& [position_share, normal_share, targets, unlike] = shipped;
  visit_each(visit, first, last, position, position_worst, tangent, tangent_worst, normal, product, share,
             alike, position_share, normal_share, targets, unlike);
}
static void visit_fields(Is<CostProof> auto& c, auto&& visit) {
  auto& [flops, vectors] = c;
  visit_each(visit, flops, vectors);
}
static void visit_fields(Is<ProofRow> auto& r, auto&& visit) {
  auto& [topology, kernel, first, last, points, seconds, map, bound, cost] = r;
  visit_each(visit, topology, kernel, first, last, points, seconds, map, bound, cost);
}
static void visit_fields(Is<CertifiedLine> auto& l, auto&& visit) {
  auto& [mesh, kernel, depth, errors] = l;
  auto& [points, position, normal, radius, face, l1, l2, corner, unit, condition, placing] = errors;
  visit_each(visit, mesh, kernel, depth, points, position, normal, radius, face, l1, l2, corner, unit,
             condition, placing);
}

bool ProofReport::held() const {
  return std::ranges::all_of(rows_,
                             [](const auto& rows) {
                               return std::ranges::all_of(rows, [](const ProofRow& row) {
                                 return row.map.equal && (!row.bound || row.bound->held());
                               });
                             }) &&
         std::ranges::all_of(certified_, [&](const CertifiedLine& line) {
           const auto proved = proved_of(line);
           return !proved || proved->hold(line.errors);
         });
}

bool ProofReport::has_all_rows() const {
  return std::ranges::none_of(rows_, [](const auto& rows) { return rows.empty(); });
}

bool ProofReport::complete() const {
  return has_all_rows() &&
         std::ranges::equal(certified_, set_.certified, [](const CertifiedLine& a, const CertifiedLine& b) {
           return a.mesh == b.mesh && a.kernel == b.kernel && a.depth == b.depth && a.errors.points > 0;
         });
}

std::optional<ProvedBounds> ProofReport::proved_of(const CertifiedLine& line) const {
  if (!has_all_rows()) return std::nullopt;
  ProvedBounds proved;
  for (const auto& rows : rows_) {
    for (const ProofRow& row : rows) {
      if (!row.bound || row.kernel.starts_with("row-stream") != (line.kernel == "row-stream")) continue;
      proved.position = std::max(proved.position, row.bound->position_bound);
      proved.product = std::max(proved.product, row.bound->product_bound);
    }
  }
  return proved;
}

std::string ProofReport::table(bool each) const {
  std::vector<Line> lines;
  std::map<std::string, std::size_t> index;
  std::string failures;
  std::int64_t points = 0;
  double seconds = 0;
  Line overall;
  for (std::size_t t = 0; t < rows_.size(); ++t) {
    const std::string& group = set_.tasks[t].group;
    for (const ProofRow& row : rows_[t]) {
      const std::string name = each ? row.topology : group;
      const auto [at, fresh] = index.emplace(
          fmt::format("{}/{}/{}/{}", group, name, row.kernel, row.map.arithmetic), lines.size());
      if (fresh) lines.push_back({name, row.kernel, row.map.arithmetic});
      lines[at->second].add(row);
      points += row.points;
      seconds += row.seconds;
      const auto fail = [&](const char* what, const std::string& how) {
        failures += fmt::format("{:<8} {} {} {}{}\n", what, group, row.topology, row.kernel, how);
      };
      if (row.bound) {
        overall.add(row);
        const BoundProof& bound = *row.bound;
        if (bound.share > 1)
          fail("EXCEEDED", fmt::format(": an error of {:.3f} times its bound", bound.share));
        if (!bound.alike) fail("UNLIKE", ": x, y and z are not rounded alike");
        if (!bound.shipped.held()) fail("SHIPPED", ": " + describe(bound.shipped));
      }
      if (row.map.witness) fail("DIFFERS", "\n         " + describe(*row.map.witness));
    }
  }
  for (const CertifiedLine& line : certified_) {
    const auto proved = proved_of(line);
    if (proved && !proved->hold(line.errors))
      failures += fmt::format(
          "EXCEEDED certified {} {}: position {:.2e} of the diagonal, bound {:.2e}; normal {:.3g} degrees, "
          "bound {:.3g}\n",
          line.mesh, line.kernel, line.errors.position, proved->position_of(line.errors), line.errors.normal,
          proved->normal_of(line.errors));
  }
  std::size_t width = 10;
  for (const Line& line : lines) width = std::max(width, line.group.size());
  std::string text =
      fmt::format("{:<{}}  {:<15}  {:>10}  {:>6}  {:>9}  {:<13}  {:>6}  {:>9}  {:>9}  {:>6}  {:>6}  {:>7}\n",
                  each ? "A B C D" : "topologies", width, "kernel", "topologies", "depths", "points", "map",
                  "depths", "bound", "worst", "slack", "flops", "CPU s");
  for (const Line& line : lines) {
    text += fmt::format("{:<{}}  {:<15}  {:>10}  {:>6}  {:>9}  {:<13}", line.group, width, line.kernel,
                        line.topologies, range(line.first_depth, line.last_depth), line.points, line.map());
    text += line.bound ? fmt::format("  {:>6}  {:>9.2e}  {:>9.2e}  {:>6.1f}",
                                     range(line.bound->first_depth, line.bound->last_depth),
                                     line.bound->position_bound, line.bound->position_worst,
                                     line.bound->position_bound / line.bound->position_worst)
                       : fmt::format("{:38}", "");
    text += line.cost ? fmt::format("  {:>6.1f}", line.cost->flops) : fmt::format("{:8}", "");
    text += fmt::format("  {:>7.1f}\n", line.seconds);
  }
  text += failures;
  if (!set_.impossible.empty())
    text +=
        fmt::format("No face of a manifold mesh has the valences {}.\n", fmt::join(set_.impossible, ", "));
  text += fmt::format("{}: {} limit points, {:.0f} s of processor time.\n",
                      held() ? "Every map is the reference's" : "Some proofs FAILED", points, seconds);
  if (set_.scheme == data::Scheme::kCatmullClark)
    text +=
        "Exact and modulo p and q: all positions, and all tangents but those of control vertices that are "
        "not regular, which need roots and are compared in the lines with digits.\n";
  if (held())
    text +=
        "The weights of x are equal one by one. y and z, of random numbers, agree with the weights of x; a "
        "difference would go unnoticed with a chance of 2^-60.\n";
  if (const auto left = std::ranges::count_if(rows_, [](const auto& r) { return r.empty(); }); left > 0)
    text += fmt::format("STOPPED: {} of {} proofs were not done; the table says nothing of them.\n", left,
                        rows_.size());
  if (has_all_rows() && !complete())
    text += "STOPPED: not all stock shapes were compared with the true surface; nothing is said of it.\n";
  if (overall.bound) {
    const BoundProof& bound = *overall.bound;
    text += fmt::format(
        "For every control mesh of these topologies in the unit box, at the depths beside the bound, float x "
        "coordinates are right to {:.2e}; the worst error found is {:.2e}. Where y and z have the values of "
        "x they get the bits of x.\n",
        bound.position_bound, bound.position_worst);
    const ShippedProof& shipped = bound.shipped;
    text += fmt::format(
        "As they ship, with unit normals, the kernels reach {:.2f} of the bound of a position and {:.2f} of "
        "a "
        "normal's{}.\n",
        shipped.position_share, shipped.normal_share,
        shipped.targets.empty() || !shipped.unlike.empty()
            ? ""
            : fmt::format("; row streaming has the same bits on {}", shipped.targets));
  }
  for (const char* kernel : {"sliding-window", "row-stream"}) {
    const CertifiedLine* worst = nullptr;
    std::int64_t looked_at = 0;
    for (const CertifiedLine& line : certified_) {
      if (line.kernel != kernel) continue;
      looked_at += line.errors.points;
      if (worst == nullptr || line.errors.position > worst->errors.position) worst = &line;
    }
    if (worst == nullptr) continue;
    text += fmt::format(
        "Certified: at {} points of the stock shapes {} is within {:.2e} of the diagonal of the true surface "
        "({}, depth {}",
        looked_at, kernel, worst->errors.position, worst->mesh, worst->depth);
    const auto proved = proved_of(*worst);
    text += proved ? fmt::format("; bound {:.2e}).\n", proved->position_of(worst->errors)) : ").\n";
  }
  return text;
}

std::string ProofReport::json() const {
  using Ordered = nlohmann::ordered_json;
  Ordered rows = Ordered::array();
  for (std::size_t t = 0; t < rows_.size(); ++t) {
    for (const ProofRow& row : rows_[t]) {
      Ordered j;
      j["group"] = set_.tasks[t].group;
      j["topology"] = row.topology;
      j["kernel"] = row.kernel;
      j["depths"] = {row.first_depth, row.last_depth};
      j["points"] = row.points;
      j["seconds"] = row.seconds;
      j["map"] = row.map.equal ? "equal" : "differs";
      j["arithmetic"] = row.map.arithmetic;
      j["digits"] = std::isfinite(row.map.digits) ? Ordered(row.map.digits) : nullptr;
      if (row.map.witness) {
        const MapWitness& w = *row.map.witness;
        j["witness"] = {{"point", w.point},
                        {"quantity", w.quantity},
                        {"control_point", w.control_point},
                        {"found", w.found},
                        {"expected", w.expected}};
      }
      if (row.bound) {
        const BoundProof& bound = *row.bound;
        j.update({{"bound", bound.position_bound},
                  {"worst", bound.position_worst},
                  {"tangent_bound", bound.tangent_bound},
                  {"tangent_worst", bound.tangent_worst},
                  {"normal_bound", bound.normal_bound},
                  {"bound_depths", {bound.first_depth, bound.last_depth}},
                  {"worst_share", bound.share},
                  {"product_bound", bound.product_bound},
                  {"shipped_position_share", bound.shipped.position_share},
                  {"shipped_normal_share", bound.shipped.normal_share},
                  {"targets", bound.shipped.targets},
                  {"unlike", bound.shipped.unlike}});
      }
      if (row.cost) {
        j["flops_per_point"] = row.cost->flops;
        j["vectors_per_point"] = row.cost->vectors;
      }
      rows.push_back(std::move(j));
    }
  }
  Ordered certified = Ordered::array();
  for (const CertifiedLine& line : certified_) {
    const auto proved = proved_of(line);
    certified.push_back({{"mesh", line.mesh},
                         {"kernel", line.kernel},
                         {"depth", line.depth},
                         {"points", line.errors.points},
                         {"position", line.errors.position},
                         {"normal", line.errors.normal},
                         {"position_bound", proved ? Ordered(proved->position_of(line.errors)) : Ordered()},
                         {"normal_bound", proved ? Ordered(proved->normal_of(line.errors)) : Ordered()}});
  }
  return Ordered{{"scheme", name_of(set_.scheme)}, {"held", held()},
                 {"complete", complete()},         {"rows", rows},
                 {"impossible", set_.impossible},  {"certified", certified}}
      .dump(2);
}

template <class T>
nlohmann::json list_json(const std::vector<T>& values) {
  return kept(values);
}
template nlohmann::json list_json(const std::vector<ProofRow>&);
template nlohmann::json list_json(const std::vector<CertifiedLine>&);

template <class T>
std::vector<T> list_of(const nlohmann::json& json) {
  std::vector<T> list;
  read(json, list);
  return list;
}
template std::vector<ProofRow> list_of<ProofRow>(const nlohmann::json&);
template std::vector<CertifiedLine> list_of<CertifiedLine>(const nlohmann::json&);

}  // namespace limitcheck::verify
