// SPDX-License-Identifier: MIT
// A kernel of quads against the kernel's own text on a number without fused multiply-add, bit by bit.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "data/generators/named_mesh.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/kernel/targets.h"
#include "verify/shared_bits/test_support/unfused.h"

namespace limitcheck::fast::row_stream {

/// Quads, regular quads and sides of a mesh at a depth, of many some, with local origins or without, by both kernels.
class ComparedQuads {
 public:
  ComparedQuads(const QuadKernel& kernel, const std::string& name, int depth, bool local)
      : kernel_(kernel),
        mesh_(data::named_mesh(name)),
        rings_(mesh_),
        depth_(depth),
        placement_(rings_.placement()) {
    placement_.local_from = local ? 1 : kMaxDepth + 1;
    const std::int32_t quads = mesh_.adjacency.face_count();
    std::vector<std::int32_t> regular, any, sides;
    for (std::int32_t f = 0; f < quads; f += 1 + quads / 12) {
      if (rings_.kind(f) == QuadClass::kRegular) regular.push_back(f);
      if (rings_.kind(f) != QuadClass::kSemiSharp) any.push_back(f);
    }
    for (std::int32_t h = 0; h < 4 * quads; h += 1 + quads / 6)
      if (!rings_.touches_semi_sharp(h)) sides.push_back(h);
    compare<generic::QuadPatch<Unfused>>(regular, side(), kernel.patches, gather_patches<float>,
                                         [](auto& engine) { engine.run(); });
    compare<generic::QuadStream<Unfused>>(any, side(), kernel.quads, gather_quads<float>,
                                          [](auto& engine) { engine.run(); });
    compare<generic::QuadStream<Unfused>>(
        sides, 1, kernel.sides,
        [](const auto& rings, auto some, int d, int lanes, float* to, Order) {
          return gather_sides<float>(rings, some, d, lanes, to);
        },
        [](auto& engine) { engine.run_side(); });
  }

  // Numbers whose bits differ, of how many.
  std::int64_t differ = 0, compared = 0;

 private:
  std::size_t side() const { return (std::size_t{1} << depth_) + 1; }

  template <class Engine, class Gather, class Run>
  void compare(const std::vector<std::int32_t>& items, std::size_t rows, QuadKernel::Run* there,
               const Gather& gather_some, const Run& here) {
    const auto lanes = static_cast<std::size_t>(kernel_.lanes);
    const std::size_t numbers = 6 * rows * side();
    const auto stride = static_cast<std::ptrdiff_t>(6 * side());
    std::vector<float> work(static_cast<std::size_t>(quad_work_size(depth_))),
        input(static_cast<std::size_t>(quad_input_size(depth_)) * lanes + 16), out(numbers * lanes),
        expected(numbers);
    for (std::size_t first = 0; first < items.size(); first += lanes) {
      const auto some = std::span(items).subspan(first, std::min(lanes, items.size() - first));
      std::array<float*, kMaxLanes> lane{};
      for (std::size_t k = 0; k < lanes; ++k) lane[k] = out.data() + numbers * std::min(k, some.size() - 1);
      there(gather_some(rings_, some, depth_, kernel_.lanes, input.data(), Order::kFromA), placement_,
            work.data(), {lane.data(), stride, nullptr, nullptr});
      for (std::size_t k = 0; k < some.size(); ++k) {
        float* to = expected.data();
        Engine engine(gather_some(rings_, some.subspan(k, 1), depth_, 1, input.data(), Order::kFromA),
                      placement_, work.data(), {QuadTarget<float>{&to, stride, nullptr, nullptr}});
        here(engine);
        for (std::size_t i = 0; i < numbers; ++i, ++compared)
          differ += std::memcmp(lane[k] + i, &expected[i], sizeof(float)) != 0 ? 1 : 0;
      }
    }
  }

  const QuadKernel& kernel_;
  QuadMesh mesh_;
  QuadRings rings_;
  int depth_;
  KernelPlacement<float> placement_;
};

}  // namespace limitcheck::fast::row_stream
