// SPDX-License-Identifier: MIT
// Makes the stars of the plan anew: limitcheck_make_plan [SEED] > data/generators/planned_stars.inc
//
// Those that are there stay if they look at a kind of neighbourhood that none before them does. Where kinds are missing
// then, the texts of stars are changed at random, and those that look at most of what is missing for their time are
// added. The same for the same seed.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "data/error.h"
#include "data/generators/star_meshes.h"
#include "data/sharpness_classes.h"
#include "data/splitmix64.h"
#include "verify/audit/default_plan.h"

namespace limitcheck::verify {
namespace {

constexpr int kTries = 1000, kPatience = 20;  // changed stars at a time; how often in vain
constexpr double kCaseCost = 3000;            // of a case beside its points, in points
constexpr double kRelationsCost = 10;         // of all requests of the relations, in requests that are judged
constexpr double kMostCost = 300000;

struct Candidate {
  PlannedCase planned;
  Looked looked = {};
  double cost = 0;
};

class StarPlan {
 public:
  StarPlan(data::Scheme scheme, std::uint64_t seed)
      : scheme_(scheme), random_(seed), prefix_(scheme == data::Scheme::kLoop ? "star:" : "quad-star:") {
    for (const AuditMesh& m : default_plan(Level::kQuick))
      if (m.scheme() == scheme && m.name.find("stars:") == std::string::npos) known_.push_back(look_at(m));
    for (const data::PlannedStars& s : data::planned_stars(scheme == data::Scheme::kLoop))
      if (Candidate c{{prefix_ + s.stars, s.depth, s.depths, s.relations}}; judge(c))
        pool_.push_back(std::move(c));
  }

  // For subjects that do no more than this.
  void complete(std::int32_t ability) {
    Covered now = covered_by(known_, scheme_, ability);
    const auto gain = [&](const Candidate& c) {
      double cells = 0;
      for (std::size_t k = 0; k < now.wanted.size() && (c.looked.needs & ~ability) == 0; ++k)
        cells += now.wanted[k] && !now.looked[k] && c.looked.cells[k] ? 1 : 0;
      return cells / (kCaseCost + c.cost);
    };
    const auto take = [&](const Candidate& c) {
      add_cells(now.looked, c.looked.cells);
      known_.push_back(c.looked);
      cases_.push_back(c.planned);
    };
    for (const Candidate& c : pool_)
      if (gain(c) > 0) take(c);
    const auto misses = [&](std::size_t k) { return now.wanted[k] && !now.looked[k]; };
    std::size_t first = 0;
    for (int failures = 0; failures < kPatience; ++failures) {
      while (first < now.wanted.size() && !misses(first)) ++first;
      if (first == now.wanted.size()) return;
      std::optional<Candidate> best;
      for (int k = 0; k < kTries; ++k)
        if (Candidate c = changed(); judge(c) && gain(c) > (best ? gain(*best) : 0)) best = std::move(c);
      if (!best) continue;
      pool_.push_back(*best);
      take(*best);
      failures = -1;
    }
    for (std::size_t k = first; k < now.wanted.size(); ++k)
      if (misses(k))
        fmt::print(stderr, "not found: {}, ability {}: {}\n", name_of(scheme_), ability,
                   cells(scheme_)[k].name());
  }

  void print() const {
    fmt::print("  static const std::vector<PlannedStars> {}{{\n",
               scheme_ == data::Scheme::kLoop ? "loop" : "quads");
    for (const PlannedCase& c : cases_)
      fmt::print("      {{\"{}\", {}, \"{}\", {}}},\n", c.mesh.substr(prefix_.size()), c.depth, c.depths,
                 c.relations);
    fmt::print("  }};\n");
  }

 private:
  std::uint64_t below(std::uint64_t n) { return random_.next() % n; }

  // What it looks at, and its time; false: it cannot be asked for.
  bool judge(Candidate& c) const try {
    const AuditMesh m = made(c.planned);
    // By Catmull-Clark's scheme and not by Loop's.
    if (m.scheme() != scheme_ || (c.planned.relations && size_for_relations(m.mesh) > kRelationFaces))
      return false;
    c.looked = look_at(m);
    c.cost = static_cast<double>(m.mesh.faces.size());
    for (std::size_t f = 0; f < m.mesh.faces.size() && !m.sample; ++f)
      if (const int depth = m.face_depth.empty() ? m.depth : m.face_depth[f]; depth >= 0)
        c.cost += std::ldexp(static_cast<double>(m.mesh.faces[f].size()) / 4, 2 * depth);
    if (c.planned.relations) c.cost = kRelationsCost * (c.cost + kCaseCost);
    return c.cost <= kMostCost;
  } catch (const data::InputError&) {
    return false;
  }

  // Some stars that are there with a few edges and letters changed, which may be stars no more.
  Candidate changed() {
    std::string tags = ".", letters = ".orvwzy=/-0123456789chst:_";
    for (const auto& c : data::kSharpnessClasses) tags += c.letter;
    letters += tags;
    Candidate c{pool_[below(pool_.size())].planned};
    data::Stars stars = data::parse_stars(c.planned.mesh.substr(prefix_.size()));
    auto& some = stars.stars;
    for (const std::size_t most : {4U, 1U})
      while (some.size() > most && below(3) > 0)
        some.erase(some.begin() + static_cast<std::ptrdiff_t>(below(some.size())));
    for (std::uint64_t changes = below(4); changes > 0; --changes) {
      std::string& spokes = some[below(some.size())].spokes;
      spokes[below(spokes.size())] = tags[below(tags.size())];
    }
    std::string text = stars.text();
    for (std::uint64_t changes = below(4); changes > 0; --changes)
      text.replace(below(text.size()), below(2),
                   below(3) > 0 ? std::string(1, letters[below(letters.size())]) : "");
    c.planned.mesh = prefix_ + text;
    if (below(2) == 0) c.planned.depth = static_cast<int>(below(5));
    if (below(2) == 0) c.planned.depths = below(2) == 0 ? "uniform" : fmt::format("random:{}", below(100));
    if (below(2) == 0) c.planned.relations = below(3) == 0;
    return c;
  }

  data::Scheme scheme_;
  data::SplitMix64 random_;
  std::string prefix_;
  std::vector<Candidate> pool_;
  std::vector<PlannedCase> cases_;
  std::vector<Looked> known_;
};

}  // namespace
}  // namespace limitcheck::verify

int main(int count, char** arguments) {
  using namespace limitcheck;
  const std::uint64_t seed = count > 1 ? std::strtoull(arguments[1], nullptr, 10) : 1;
  fmt::print(
      "// SPDX-License-Identifier: MIT\n// Written by `limitcheck_make_plan {}`, and not to be edited.\n",
      seed);
  for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark}) {
    verify::StarPlan plan(scheme, seed);
    for (const std::int32_t ability : verify::steps_of_ability()) plan.complete(ability);
    plan.print();
  }
}
