// SPDX-License-Identifier: MIT
// What the throughput bench prints last: ratios of rates measured in the same run.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>

#include "data/scheme.h"

namespace limitcheck::bench {

/// A control mesh by the name that cases carry.
struct Shape {
  std::string name;
  int faces;
};

/// Quads, of whose quads none, half or all are regular; and many.
inline const Shape kQuads{"quads", 4002}, kHalfRegularQuads{"half-regular", 4008},
    kRegularQuads{"regular", 4000}, kManyQuads{"quads", 100'002};

std::string full_name(const std::string& route, const std::string& use, const Shape& shape, int depth,
                      int threads);

/// Prints each run, keeps the best rate over its repetitions, and at the end prints the ratios of those that
/// ran, each beside its target.
class RatioTable : public benchmark::ConsoleReporter {
 public:
  /// best: name of the row-streaming route of the best target.
  RatioTable(data::Scheme scheme, std::string best, int all_threads)
      : scheme_(scheme), best_(std::move(best)), all_threads_(all_threads) {}

  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  double rate(const std::string& counter, const std::string& name) const;  // 0: did not run
  double fastest_peer(const std::string& use, const Shape& shape, int depth) const;
  void print_triangles() const;
  void print_quads() const;
  void print(const char* what, double a, double b, double least) const;

  data::Scheme scheme_;
  std::string best_;
  int all_threads_;
  std::map<std::string, double> rates_;  // by counter and name
};

}  // namespace limitcheck::bench
