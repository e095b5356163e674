// SPDX-License-Identifier: MIT
// What the throughput bench prints last: ratios of rates measured in the same run.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>

namespace limitcheck::bench {

std::string full_name(const std::string& route, const std::string& use, int faces, int depth, int threads);

/// Prints each run, keeps the best rate over its repetitions, and at the end prints the ratios of those that
/// ran, each beside its target on 4000 faces.
class RatioTable : public benchmark::ConsoleReporter {
 public:
  /// best: name of the row-streaming route of the best target.
  RatioTable(std::string best, int all_threads) : best_(std::move(best)), all_threads_(all_threads) {}

  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  double rate(const std::string& counter, const std::string& name) const;  // 0: did not run
  double fastest_peer(const std::string& use, int depth) const;
  void print(const char* what, double a, double b, double least) const;

  std::string best_;
  int all_threads_;
  std::map<std::string, double> rates_;  // by counter and name
};

}  // namespace limitcheck::bench
