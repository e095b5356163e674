// SPDX-License-Identifier: MIT
// A kernel of quads against the kernel's own text on a number without fused multiply-add, bit by bit.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/generators/named_mesh.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/kernel/targets.h"
#include "verify/shared_bits/test_support/unfused.h"

namespace limitcheck::fast::row_stream {

/// Quads, regular quads and sides of a mesh at a depth, of many some, by both kernels.
///   origins   whether all have origins of their own, or none; else those for which the mesh wants them
class ComparedQuads {
 public:
  ComparedQuads(const QuadKernel& kernel, const std::string& name, int depth, std::optional<bool> origins)
      : kernel_(kernel), mesh_(data::named_mesh(name)), rings_(mesh_), depth_(depth), local_(origins) {
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

  // Numbers whose bits differ, of how many; and items some part of which has an origin of its own.
  std::int64_t differ = 0, compared = 0, local = 0, items = 0;

 private:
  std::size_t side() const { return (std::size_t{1} << depth_) + 1; }

  QuadBatch<float> batch_of(const auto& gather_some, std::span<const std::int32_t> some, int lanes,
                            float* input) const {
    const QuadBatch<float> batch = gather_some(rings_, some, depth_, lanes, input, Order::kFromA);
    return local_ ? with_origins(batch, *local_, lanes) : batch;
  }

  template <class Engine, class Gather, class Run>
  void compare(const std::vector<std::int32_t>& list, std::size_t rows, QuadKernel::Run* there,
               const Gather& gather_some, const Run& here) {
    const auto lanes = static_cast<std::size_t>(kernel_.lanes);
    const std::size_t numbers = 6 * rows * side();
    const auto stride = static_cast<std::ptrdiff_t>(6 * side());
    std::vector<float> work(static_cast<std::size_t>(quad_work_size(depth_))),
        input(static_cast<std::size_t>(quad_input_size(depth_)) * lanes + 16), out(numbers * lanes),
        expected(numbers);
    for (std::size_t first = 0; first < list.size(); first += lanes) {
      const auto some = std::span(list).subspan(first, std::min(lanes, list.size() - first));
      std::array<float*, kMaxLanes> lane{};
      for (std::size_t k = 0; k < lanes; ++k) lane[k] = out.data() + numbers * std::min(k, some.size() - 1);
      there(batch_of(gather_some, some, kernel_.lanes, input.data()), rings_.placement(), work.data(),
            {lane.data(), stride, nullptr, nullptr});
      for (std::size_t k = 0; k < some.size(); ++k) {
        float* to = expected.data();
        const QuadBatch<float> batch = batch_of(gather_some, some.subspan(k, 1), 1, input.data());
        ++items, local += batch.local ? 1 : 0;
        Engine engine(batch, rings_.placement(), work.data(),
                      {QuadTarget<float>{&to, stride, nullptr, nullptr}});
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
  std::optional<bool> local_;
};

}  // namespace limitcheck::fast::row_stream
