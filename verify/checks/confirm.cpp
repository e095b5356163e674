// SPDX-License-Identifier: MIT
#include "verify/checks/confirm.h"

#include <fmt/core.h>

#include <algorithm>

#include "verify/interrupt/interrupt.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {

Confirmation confirm(const Evidence& e, std::vector<double>& error,
                     const std::function<Sides::Id(std::size_t)>& side,
                     const std::function<double(std::size_t)>& bound,
                     const std::function<double(std::size_t, const ExactPoint&)>& measure) {
  struct Suspect {
    double excess;
    std::size_t at;
  };
  std::vector<Suspect> suspects;
  for (std::size_t v = 0; v < error.size(); ++v)
    if (error[v] >= 0 && !(error[v] <= bound(v))) suspects.push_back({error[v] / bound(v), v});
  std::stable_sort(suspects.begin(), suspects.end(),
                   [](const Suspect& a, const Suspect& b) { return a.excess > b.excess; });

  Confirmation c;
  for (const auto& [excess, v] : suspects) {
    if (c.worst >= 0 && c.acquitted == 0) break;
    if (c.worst >= 0 && c.looked >= kMostCertified) {
      ++c.left;
      error[v] = -1;
      continue;
    }
    end_if_interrupted();
    ++c.looked;
    const ExactPoint* exact = e.reference.certified().at(side(v));
    if (exact != nullptr) error[v] = measure(v, *exact);
    if (error[v] < 0 || error[v] <= bound(v))
      ++c.acquitted;
    else if (c.worst < 0)
      c.worst = static_cast<std::int64_t>(v);
  }
  if (c.acquitted > 0) {
    c.message = fmt::format(
        "the reference in double has {} points beyond the bound; of {} put before certified numbers, {} are "
        "not",
        suspects.size(), c.looked, c.acquitted);
    if (c.left > 0) c.message += fmt::format(", and the other {} are not judged", c.left);
  }
  return c;
}

std::int64_t judge_angles(const Evidence& e, std::vector<double>& angle,
                          const std::function<double(std::size_t, const ExactPoint&)>& measure, Result& row) {
  const double ordinary_bound = normal_bound(e.capabilities.precision, e.reference.steps());
  const auto side = [&](std::size_t k) { return e.uses[k].side; };
  const auto bound = [&](std::size_t k) { return e.normal_bound_at(side(k)); };
  const Confirmation confirmation = confirm(e, angle, side, bound, measure);

  // Kept apart, because errors with another bound than the row's would distort its worst value and its
  // percentile.
  std::vector<double> ordinary = angle;
  IllConditioned ill;
  std::int64_t ill_bad = 0, ill_worst = -1;
  for (std::size_t v = 0; v < angle.size(); ++v) {
    if (angle[v] < 0 || bound(v) <= ordinary_bound) continue;
    ordinary[v] = -1;
    ++ill.count;
    ill.bound = std::max(ill.bound, bound(v));
    ill.worst = std::max(ill.worst, angle[v]);
    ill_bad += !(angle[v] <= bound(v));
    if (ill_worst < 0 || angle[v] / bound(v) > angle[ill_worst] / bound(ill_worst))
      ill_worst = static_cast<std::int64_t>(v);
  }
  Statistics s = summarise(ordinary, ordinary_bound);
  s.of += ill.count;
  s.bad += ill_bad;
  take(row, s);
  const std::int64_t at = confirmation.worst >= 0 ? confirmation.worst
                          : s.worst_at >= 0       ? s.worst_at
                                                  : ill_worst;
  row.bound = ordinary_bound;
  if (at >= 0) {
    row.worst = angle[at];
    row.bound = bound(at);
  }
  if (row.worst && !std::isfinite(*row.worst)) row.worst.reset();
  if (ill.count > 0) {
    row.ill_conditioned = ill;
    say(row, fmt::format(
                 "ill-conditioned: {} points, whose bound goes up to {:.2g} degrees; they are off by up to "
                 "{:.2g}",
                 ill.count, ill.bound, ill.worst));
  }
  say(row, confirmation.message);
  return at;
}

void say(Result& row, const std::string& sentence) {
  if (sentence.empty()) return;
  row.message += (row.message.empty() ? "" : "; ") + sentence;
}

void say_left_out(Result& row, std::int64_t count, const char* what) {
  if (count > 0) say(row, fmt::format("{} {} that are not finite are left out", count, what));
}

}  // namespace limitcheck::verify
