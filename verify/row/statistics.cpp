// SPDX-License-Identifier: MIT
#include "verify/row/statistics.h"

#include <algorithm>
#include <cmath>

namespace limitcheck::verify {

Statistics summarise(const std::vector<double>& errors, double bound) {
  Statistics s;
  std::vector<double> finite;
  finite.reserve(errors.size());
  double worst = -1, sum = 0;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const double e = errors[k];
    if (e < 0) continue;
    ++s.of;
    if (!(e <= bound)) ++s.bad;
    if (e > worst) {
      worst = e;
      s.worst_at = static_cast<std::int64_t>(k);
    }
    if (!std::isfinite(e)) continue;
    finite.push_back(e);
    sum += e * e;
  }
  if (worst >= 0 && std::isfinite(worst)) s.worst = worst;
  if (!finite.empty()) {
    s.rms = std::sqrt(sum / static_cast<double>(finite.size()));
    const std::size_t rank = (99 * finite.size() + 99) / 100 - 1;
    std::nth_element(finite.begin(), finite.begin() + static_cast<std::ptrdiff_t>(rank), finite.end());
    s.p99 = finite[rank];
  }
  return s;
}

std::vector<std::int64_t> decades(const std::vector<double>& errors) {
  std::vector<std::int64_t> counts(kDecades, 0);
  for (const double e : errors) {
    if (e < 0 || !std::isfinite(e)) continue;
    const int power = e > 0 ? static_cast<int>(std::floor(std::log10(e))) - kFirstDecade + 1 : 0;
    ++counts[static_cast<std::size_t>(std::clamp(power, 0, kDecades - 1))];
  }
  return counts;
}

void settle(Result& row) {
  row.status = row.bad > 0 ? Status::kFinding : row.of == 0 ? Status::kNotRun : Status::kHeld;
}

void take(Result& row, const Statistics& statistics) {
  row.bad = statistics.bad;
  row.of = statistics.of;
  row.worst = statistics.worst;
  row.rms = statistics.rms;
  row.p99 = statistics.p99;
  settle(row);
}

}  // namespace limitcheck::verify
