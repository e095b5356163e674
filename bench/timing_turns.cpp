// SPDX-License-Identifier: MIT
// Times one case on request, so that two builds, each in a process of its own, can take turns of a few
// milliseconds and share the same conditions on a busy machine.
//   timing_turns          the build, then the names of the cases; they are names of throughput_bench
//   timing_turns --serve  reads "REPETITIONS CASE" lines; answers each with the nanoseconds of processor
//                         time per run, one number per repetition of about two milliseconds, or "? CASE"
//                         if there is no such case
#include <cstdio>
#include <ctime>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "bench/build_identity.h"
#include "bench/contenders/contender.h"
#include "data/generators/bumpy_sphere.h"

namespace {

using namespace limitcheck;

/// Makes ready; what it returns is timed.
using Case = std::function<std::function<void()>()>;

const data::ControlMesh& mesh_of(int faces) {
  static std::map<int, data::ControlMesh> known;
  const auto found = known.find(faces);
  return found != known.end() ? found->second
                              : known.emplace(faces, data::bumpy_sphere(faces, 1)).first->second;
}

std::map<std::string, Case> cases() {
  std::map<std::string, Case> list;
  for (const bench::Route& route : bench::our_routes()) {
    const int faces = route.nanoseconds_per_point < 10 ? 1000 : 200;
    const auto name = [&](const char* use, int depth) {
      return route.name + "/" + use + "/bumpy/faces:" + std::to_string(faces) +
             "/depth:" + std::to_string(depth) + "/threads:1";
    };
    for (const int depth : {3, 5}) {
      list[name("steady", depth)] = [route, faces, depth] {
        std::shared_ptr<bench::Contender> contender = route.make(mesh_of(faces), depth, 1);
        contender->run();  // first-touch allocations
        return [contender] { contender->run(); };
      };
    }
    list[name("scratch", 3)] = [route, faces] {
      return [route, &mesh = mesh_of(faces)] { route.make(mesh, 3, 1)->run(); };
    };
  }
  return list;
}

double processor_nanoseconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

double timed(const std::function<void()>& work, int runs) {
  const double start = processor_nanoseconds();
  for (int k = 0; k < runs; ++k) work();
  return (processor_nanoseconds() - start) / runs;
}

struct Ready {
  std::function<void()> work;
  int runs = 1;  // that take about two milliseconds
};

Ready make_ready(const Case& one) {
  Ready ready{one()};
  const double nanoseconds = timed(ready.work, 1);
  ready.runs = nanoseconds < 2e6 ? static_cast<int>(2e6 / nanoseconds) + 1 : 1;
  return ready;
}

void serve() {
  const auto list = cases();
  std::map<std::string, Ready> ready;
  int repetitions = 0;
  for (std::string name; std::cin >> repetitions && std::getline(std::cin >> std::ws, name);) {
    const auto found = list.find(name);
    if (found == list.end()) {
      std::cout << "? " << name << std::endl;
      continue;
    }
    auto at = ready.find(name);
    if (at == ready.end()) at = ready.emplace(name, make_ready(found->second)).first;
    for (int k = 0; k < repetitions; ++k)
      std::cout << (k > 0 ? " " : "") << timed(at->second.work, at->second.runs);
    std::cout << std::endl;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--serve") {
    serve();
    return 0;
  }
  std::puts(bench::build_identity().c_str());
  for (const auto& [name, make] : cases()) std::puts(name.c_str());
  return 0;
}
