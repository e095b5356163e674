// SPDX-License-Identifier: MIT
#include "bench/ratio_table.h"

#include <algorithm>
#include <cstdio>

namespace limitcheck::bench {

namespace {

constexpr int kFaces = 4000;

std::string steady(const std::string& route, int depth, int faces = kFaces, int threads = 1) {
  return full_name(route, "steady", faces, depth, threads);
}

}  // namespace

std::string full_name(const std::string& route, const std::string& use, int faces, int depth, int threads) {
  return route + "/" + use + "/bumpy/faces:" + std::to_string(faces) + "/depth:" + std::to_string(depth) +
         "/threads:" + std::to_string(threads);
}

void RatioTable::ReportRuns(const std::vector<Run>& runs) {
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
    for (const auto& [counter, value] : run.counters) {
      double& best = rates_[counter + " " + run.run_name.function_name];
      best = std::max(best, static_cast<double>(value));
    }
    if (const auto peak = run.counters.find("peak"); peak != run.counters.end())
      rates_["time " + run.run_name.function_name] = run.GetAdjustedRealTime();
  }
}

double RatioTable::rate(const std::string& counter, const std::string& name) const {
  const auto found = rates_.find(counter + " " + name);
  return found == rates_.end() ? 0 : found->second;
}

double RatioTable::fastest_peer(const std::string& use, int depth) const {
  double best = 0;
  for (const char* peer : {"bfr/streaming", "bfr/cached-stencils", "far/uniform", "far/limit-stencils",
                           "cgal/refinement", "openmesh/refinement"})
    best = std::max(best, rate("points/s", full_name(peer, use, kFaces, depth, 1)));
  return best;
}

void RatioTable::print(const char* what, double a, double b, double least) const {
  if (a == 0 || b == 0) return;
  std::printf("  %-58s %8.2f", what, a / b);
  if (least > 0) std::printf("   (%g)", least);
  std::printf("\n");
}

void RatioTable::Finalize() {
  ConsoleReporter::Finalize();
  const std::string rows = best_, p = "points/s", w = "written/s";
  std::printf(
      "\nratios of rates, best of all repetitions (and the least wanted); one thread, 4000 faces unless "
      "said\n");
  print("depth 5, rows / Bfr cached stencils", rate(p, steady(rows, 5)),
        rate(p, steady("bfr/cached-stencils", 5)), 40);
  print("depth 5, rows / Bfr streaming", rate(p, steady(rows, 5)), rate(p, steady("bfr/streaming", 5)), 120);
  print("depth 3, rows / Bfr cached stencils", rate(p, steady(rows, 3)),
        rate(p, steady("bfr/cached-stencils", 3)), 20);
  print("depth 5, rows / scalar sliding window", rate(p, steady(rows, 5)),
        rate(p, steady("sliding-window", 5)), 20);
  print("depth 5, rows / fastest peer", rate(p, steady(rows, 5)), fastest_peer("steady", 5), 0);
  print("depth 5, scalar sliding window / Bfr streaming", rate(p, steady("sliding-window", 5)),
        rate(p, steady("bfr/streaming", 5)), 6);
  print("depth 5, scalar sliding window / naive", rate(p, steady("sliding-window", 5)),
        rate(p, steady("naive", 5)), 0);
  print("depth 5, rows / write-only in 1 MB, bytes", rate(w, steady(rows, 5)), rate(w, "write-only/cached"),
        .45);
  print("depth 5, rows / write-only in 16 KB, bytes", rate(w, steady(rows, 5)),
        rate(w, "write-only/first-level"), 0);
  for (const char* form : {"row-stream/whole-pairs", "row-stream/streamed", "row-stream/compact"}) {
    print(("depth 5, " + std::string(form) + " / write-only to memory, bytes").c_str(),
          rate(w, steady(form, 5)), rate(w, "write-only/memory"),
          std::string(form) == "row-stream/streamed" ? .5 : 0);
  }
  print("depth 3, rows from scratch / fastest peer from scratch",
        rate(p, full_name(rows, "scratch", kFaces, 3, 1)), fastest_peer("scratch", 3), 15);
  print("depth 5, rows from scratch / fastest peer from scratch",
        rate(p, full_name(rows, "scratch", kFaces, 5, 1)), fastest_peer("scratch", 5), 0);
  print("100 000 faces, depth 5, all threads / one", rate(p, steady(rows, 5, 100'000, all_threads_)),
        rate(p, steady(rows, 5, 100'000)), 1.85);
  std::printf("\n");
}

}  // namespace limitcheck::bench
