// SPDX-License-Identifier: MIT
#include "bench/ratio_table.h"

#include <algorithm>
#include <cstdio>

namespace limitcheck::bench {

namespace {

const Shape kBumpy{"bumpy", 4000}, kManyFaces{"bumpy", 100'000};

std::string steady(const std::string& route, int depth, const Shape& shape = kBumpy, int threads = 1) {
  return full_name(route, "steady", shape, depth, threads);
}

}  // namespace

std::string full_name(const std::string& route, const std::string& use, const Shape& shape, int depth,
                      int threads) {
  return route + "/" + use + "/" + shape.name + "/faces:" + std::to_string(shape.faces) +
         "/depth:" + std::to_string(depth) + "/threads:" + std::to_string(threads);
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

double RatioTable::fastest_peer(const std::string& use, const Shape& shape, int depth) const {
  double best = 0;
  for (const char* peer : {"bfr/streaming", "bfr/cached-stencils", "far/uniform", "far/limit-stencils",
                           "cgal/refinement", "openmesh/refinement"})
    best = std::max(best, rate("points/s", full_name(peer, use, shape, depth, 1)));
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
  std::printf("\nratios of rates, best of all repetitions (and the least wanted); one thread unless said\n");
  if (scheme_ == data::Scheme::kLoop) {
    print_triangles();
  } else {
    print_quads();
  }
  std::printf("\n");
}

void RatioTable::print_quads() const {
  struct Wanted {
    Shape shape;
    double depth_3, depth_5;
  };
  const Wanted all[] = {{kQuads, 24, 50}, {kHalfRegularQuads, 0, 55}, {kRegularQuads, 0, 0}};
  const std::string p = "points/s";
  for (const auto& [shape, depth_3, depth_5] : all) {
    for (const int depth : {3, 5}) {
      const auto say = [&, &named = shape.name](const std::string& what) {
        return named + ", depth " + std::to_string(depth) + ", " + what;
      };
      const double rows = rate(p, steady(best_, depth, shape));
      const double streamed = rate(p, steady("row-stream/streamed", depth, shape));
      const double stencils = rate(p, steady("bfr/cached-stencils", depth, shape));
      const double least = depth == 3 ? depth_3 : depth_5;
      print(say("rows / Bfr cached stencils").c_str(), rows, stencils, least);
      print(say("streamed / Bfr cached stencils").c_str(), streamed, stencils, 0);
      print(say("rows / Bfr streaming").c_str(), rows, rate(p, steady("bfr/streaming", depth, shape)), 0);
      print(say("rows / fastest peer").c_str(), rows, fastest_peer("steady", shape, depth), 0);
      print(say("rows from scratch / fastest peer from scratch").c_str(),
            rate(p, full_name(best_, "scratch", shape, depth, 1)), fastest_peer("scratch", shape, depth), 0);
    }
  }
  print("100 000 quads, depth 5, all threads / one", rate(p, steady(best_, 5, kManyQuads, all_threads_)),
        rate(p, steady(best_, 5, kManyQuads)), 1.85);
}

void RatioTable::print_triangles() const {
  const std::string rows = best_, p = "points/s", w = "written/s";
  print("depth 5, rows / Bfr cached stencils", rate(p, steady(rows, 5)),
        rate(p, steady("bfr/cached-stencils", 5)), 40);
  print("depth 5, rows / Bfr streaming", rate(p, steady(rows, 5)), rate(p, steady("bfr/streaming", 5)), 120);
  print("depth 3, rows / Bfr cached stencils", rate(p, steady(rows, 3)),
        rate(p, steady("bfr/cached-stencils", 3)), 20);
  print("depth 5, rows / scalar sliding window", rate(p, steady(rows, 5)),
        rate(p, steady("sliding-window", 5)), 20);
  print("depth 5, rows / fastest peer", rate(p, steady(rows, 5)), fastest_peer("steady", kBumpy, 5), 0);
  print("depth 5, scalar sliding window / Bfr streaming", rate(p, steady("sliding-window", 5)),
        rate(p, steady("bfr/streaming", 5)), 6);
  print("depth 5, scalar sliding window / naive", rate(p, steady("sliding-window", 5)),
        rate(p, steady("naive", 5)), 0);
  print("depth 5, rows / write-only in 1 MB, bytes", rate(w, steady(rows, 5)), rate(w, "write-only/cached"),
        .45);
  print("depth 5, rows / write-only in 16 KB, bytes", rate(w, steady(rows, 5)),
        rate(w, "write-only/first-level"), 0);
  for (const char* form : {"row-stream/whole-pairs", "row-stream/streamed"}) {
    print(("depth 5, " + std::string(form) + " / write-only to memory, bytes").c_str(),
          rate(w, steady(form, 5)), rate(w, "write-only/memory"),
          std::string(form) == "row-stream/streamed" ? .5 : 0);
  }
  print("depth 3, rows from scratch / fastest peer from scratch",
        rate(p, full_name(rows, "scratch", kBumpy, 3, 1)), fastest_peer("scratch", kBumpy, 3), 15);
  print("depth 5, rows from scratch / fastest peer from scratch",
        rate(p, full_name(rows, "scratch", kBumpy, 5, 1)), fastest_peer("scratch", kBumpy, 5), 0);
  print("100 000 faces, depth 5, all threads / one", rate(p, steady(rows, 5, kManyFaces, all_threads_)),
        rate(p, steady(rows, 5, kManyFaces)), 1.85);
}

}  // namespace limitcheck::bench
