// SPDX-License-Identifier: MIT
// One small piece of work, once, for callgrind to count the instructions of; nothing before or after it is
// counted.
//   valgrind --tool=callgrind --collect-atstart=no instruction_case CASE
// Without an argument: the build, then the names of the cases. Callgrind knows no AVX-512, so AVX2 is the
// widest target.
#include <valgrind/callgrind.h>

#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bench/build_identity.h"
#include "bench/contenders/contender.h"
#include "data/generators/bumpy_sphere.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "fast/stream/kernel/targets.h"
#include "fast/stream/stream_tessellator.h"
#include "fast/window/tessellator.h"

namespace {

using namespace limitcheck;

/// What is counted; whoever makes it makes ready beforehand.
using Case = std::function<void()>;

/// By a thread, which has a heap of its own: the hull's library draws by the clock, the mesh is the same, but
/// what lies free where would not be, and with it the instructions of every later allocation.
data::ControlMesh made_apart() {
  std::optional<data::ControlMesh> mesh;
  std::thread([&] { mesh = data::bumpy_sphere(200, 1); }).join();
  return *mesh;  // a copy of ours
}

std::map<std::string, std::function<Case()>> cases() {
  static const data::ControlMesh mesh = made_apart();
  std::map<std::string, std::function<Case()>> list;
  for (const bench::Route& route : bench::our_routes()) {
    if (route.name.find("avx512") != std::string::npos) continue;
    list["set-up/" + route.name] = [route] { return Case{[route] { route.make(mesh, 3, 1); }}; };
    for (const int depth : {3, 5}) {
      if (route.nanoseconds_per_point > 50 && depth > 3) continue;
      list[route.name + "/depth:" + std::to_string(depth)] = [route, depth] {
        std::shared_ptr<bench::Contender> contender = route.make(mesh, depth, 1);
        contender->run();  // first-touch allocations
        return Case{[contender] { contender->run(); }};
      };
    }
  }
  // Quads: around vertices of valences 3, 4 and 12; and with a crease that fades.
  // Made in these cases alone: the allocations of the others are counted, and depend on what came before.
  const auto quads = [] { return data::pawn(12); };
  for (const bench::Route& route : bench::our_quad_routes()) {
    if (route.name.find("avx512") != std::string::npos) continue;
    list["set-up/quads/" + route.name] = [route, quads] {
      return Case{[route, mesh = quads()] { route.make(mesh, 3, 1); }};
    };
    for (const int depth : {3, 5}) {
      if (route.nanoseconds_per_point > 50 && depth > 3) continue;
      list["quads/" + route.name + "/depth:" + std::to_string(depth)] = [route, quads, depth] {
        std::shared_ptr<bench::Contender> contender = route.make(quads(), depth, 1);
        contender->run();
        return Case{[contender] { contender->run(); }};
      };
    }
    if (route.name == "row-stream/avx2")
      list["quads/semi-sharp/" + route.name] = [route] {
        std::shared_ptr<bench::Contender> contender = route.make(data::crease_ring(2, 5), 3, 1);
        contender->run();
        return Case{[contender] { contender->run(); }};
      };
  }
  // Frames at unequal depths: as a draw list, as patches, and as patches of which few have changed.
  const auto engine = [] {
    fast::TessellatorOptions options;
    options.threads = 1;
    return std::make_shared<fast::row_stream::StreamTessellator>(mesh, options,
                                                                 *fast::row_stream::find_kernel("avx2"));
  };
  const auto depths = [](std::size_t deeper) {
    std::vector<std::int32_t> depth;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) depth.push_back(static_cast<std::int32_t>(f * 7 % 5));
    for (std::size_t f = 0; f < deeper; ++f) ++depth[40 * f];
    return depth;
  };
  const auto frames = [=](const auto& out) {
    const auto by = engine();
    by->frame(depths(4), *out);
    by->frame(depths(0), *out);
    return Case{[=, depth = depths(4)] { by->frame(depth, *out); }};
  };
  list["frame/row-stream/random-depths"] = [=] { return frames(std::make_shared<fast::DrawList<float>>()); };
  for (const auto& [form, options] : {std::pair{"patches", fast::PatchOptions{}},
                                      std::pair{"patches-kept", fast::PatchOptions{.incremental = true}},
                                      std::pair{"patches-compact", fast::PatchOptions{.compact = true}}})
    list[std::string("frame/row-stream/") + form] = [=, with = options] {
      return frames(std::make_shared<fast::PatchMesh<float>>(with));
    };
  // Control points that move before the frame, whose depths do not need cones, or do.
  for (const fast::Strategy strategy : {fast::Strategy::kProjectSphere, fast::Strategy::kCombined}) {
    list["frame/row-stream/deforming-" + std::string(fast::name(strategy))] = [=] {
      fast::DepthOptions depth;
      depth.strategy = strategy;
      const auto out = std::make_shared<fast::PatchMesh<float>>();
      const auto by = engine();
      auto moved = mesh.positions;
      for (auto& p : moved) p[0] *= 1.01;
      by->move_points(moved), by->frame(depth, fast::Camera{}, *out);
      return Case{[=] { by->move_points(mesh.positions), by->frame(depth, fast::Camera{}, *out); }};
    };
  }
  return list;
}

}  // namespace

int main(int argc, char** argv) {
  const auto list = cases();
  if (argc < 2) {
    std::puts(bench::build_identity().c_str());
    for (const auto& [name, make] : list) std::puts(name.c_str());
    return 0;
  }
  const auto found = list.find(argv[1]);
  if (found == list.end()) {
    std::fprintf(stderr, "instruction_case: there is no case '%s'\n", argv[1]);
    return 2;
  }
  const Case work = found->second();
  CALLGRIND_TOGGLE_COLLECT;
  work();
  CALLGRIND_TOGGLE_COLLECT;
  return 0;
}
