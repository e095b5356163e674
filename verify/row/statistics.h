// SPDX-License-Identifier: MIT
// What a row measures: errors, and the time that it took to look.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "verify/row/result.h"

namespace limitcheck::verify {

/// Of a list of errors >= 0. An infinite entry is something that could not be measured (a NaN where a number
/// should be): it is bad and it is the worst, but rms and p99 run over the finite entries. Negative entries
/// were not looked at and are left out altogether.
struct Statistics {
  std::int64_t of = 0, bad = 0;  // looked at; not within the bound
  std::int64_t worst_at = -1;    // index of the first largest entry, -1 if nothing was looked at
  std::optional<double> worst;   // empty if infinite
  std::optional<double> rms, p99;
};

/// Summed in order, so that the result does not depend on threads. p99: the smallest entry that at least 99 %
/// of the finite entries do not exceed.
Statistics summarise(const std::vector<double>& errors, double bound);

/// How many of the entries >= 0 lie in each power of ten: the first below 1e-17, the last at 100 and more;
/// what is not finite is left out.
inline constexpr int kDecades = 21, kFirstDecade = -17;
std::vector<std::int64_t> decades(const std::vector<double>& errors);

/// The status of a row by its counts: not run if nothing was looked at.
void settle(Result& row);

/// Counts, worst, rms and p99 into a row, and its status: not run if nothing was looked at.
void take(Result& row, const Statistics& statistics);

/// A tessellation with the error of each of its vertices, as the page of a report colours it.
struct VertexErrors {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<double> distance,
      angle;  // of each vertex, in diagonals and in degrees; negative: not looked at
  double distance_bound = 0, angle_bound = 0;
};

/// Seconds since it was made.
class Clock {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace limitcheck::verify
