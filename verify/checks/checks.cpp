// SPDX-License-Identifier: MIT
#include "verify/checks/checks.h"

#include <fmt/core.h>

#include <algorithm>

#include "verify/interrupt/interrupt.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {

const std::vector<Check>& checks() {
  static const std::vector<Check> all{
      {"written", {"written"}, check_written, false},
      {"finite", {"finite"}, check_finite, false},
      {"positions", {"positions"}, check_positions, true},
      {"normals", {"normals", "normal-length"}, check_normals, true},
      {"normals-against-positions", {"normals-against-positions"}, check_normals_against_positions, true},
      {"orientation", {"orientation"}, check_orientation, true},
      {"coverage", {"coverage"}, check_coverage, false},
      {"shared", {"shared-positions", "shared-normals"}, check_shared, false},
      {"continuity", {"continuity"}, check_continuity, true},
      {"watertight", {"watertight", "t-vertices"}, check_watertight, false},
      {"channels", {"channel-positions", "channel-derivatives", "channel-shared"}, check_channels, false},
  };
  return all;
}

bool has_matter(const Check& check, const data::ControlMesh& mesh) {
  return check.run != check_channels || !mesh.channels.empty();
}

Confirmation confirm(std::vector<double>& error, const std::function<double(std::size_t)>& bound,
                     const std::function<double(std::size_t)>& measure) {
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
    error[v] = measure(v);
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

Confirmation confirm(const Evidence& e, std::vector<double>& error,
                     const std::function<Sides::Id(std::size_t)>& side,
                     const std::function<double(std::size_t)>& bound,
                     const std::function<double(std::size_t, const ExactPoint&)>& measure) {
  return confirm(error, bound, [&](std::size_t v) {
    const ExactPoint* exact = e.reference.certified(side(v));
    return exact != nullptr ? measure(v, *exact) : error[v];
  });
}

std::int64_t judge(const std::vector<double>& error, const std::function<double(std::size_t)>& bound,
                   double ordinary_bound, std::int64_t confirmed, const char* why, Result& row) {
  // Kept apart, because errors with another bound than the row's would distort its worst value and its
  // percentile.
  std::vector<double> ordinary = error;
  IllConditioned ill;
  std::int64_t ill_bad = 0, ill_worst = -1;
  for (std::size_t v = 0; v < error.size(); ++v) {
    if (error[v] < 0 || bound(v) <= ordinary_bound) continue;
    ordinary[v] = -1;
    ++ill.count;
    ill.bound = std::max(ill.bound, bound(v));
    ill.worst = std::max(ill.worst, error[v]);
    ill_bad += !(error[v] <= bound(v));
    if (ill_worst < 0 || error[v] / bound(v) > error[ill_worst] / bound(ill_worst))
      ill_worst = static_cast<std::int64_t>(v);
  }
  Statistics s = summarise(ordinary, ordinary_bound);
  s.of += ill.count;
  s.bad += ill_bad;
  take(row, s);
  const std::int64_t at = confirmed >= 0 ? confirmed : s.worst_at >= 0 ? s.worst_at : ill_worst;
  row.bound = ordinary_bound;
  if (at >= 0) {
    row.worst = error[at];
    row.bound = bound(at);
  }
  if (row.worst && !std::isfinite(*row.worst)) row.worst.reset();
  if (ill.count > 0) {
    row.ill_conditioned = ill;
    say(row, fmt::format("{}: {} points, whose bound goes up to {:.2g} {}s; they are off by up to {:.2g}",
                         why, ill.count, ill.bound, row.unit == "degrees" ? "degree" : row.unit, ill.worst));
  }
  return at;
}

std::int64_t judge_angles(const Evidence& e, std::vector<double>& angle,
                          const std::function<double(std::size_t, const ExactPoint&)>& measure, Result& row) {
  const auto side = [&](std::size_t k) { return e.uses[k].side; };
  const auto bound = [&](std::size_t k) { return e.normal_bound_at(side(k)); };
  const Confirmation confirmation = confirm(e, angle, side, bound, measure);
  const std::int64_t at = judge(angle, bound, normal_bound(e.capabilities.precision, e.reference.steps()),
                                confirmation.worst, "ill-conditioned", row);
  say(row, confirmation.message);
  return at;
}

bool has_normals(const Evidence& e, Result& row, bool of_limits) {
  const bool offers = e.capabilities.normals && (!of_limits || e.capabilities.points == LC_POINTS_LIMIT);
  if (!offers) row.message = "delivers no limit normals";
  if (!offers || !e.tessellation.has_normals()) row.status = offers ? Status::kNotRun : Status::kNotSupported;
  return offers && e.tessellation.has_normals();
}

void say_left_out(Result& row, std::int64_t count, const char* what) {
  row.not_finite += count;
  if (count > 0) say(row, fmt::format("{} {} that are not finite are left out", count, what));
}

}  // namespace limitcheck::verify
