// SPDX-License-Identifier: MIT
// A kernel against the kernel's own text on a number without fused multiply-add, bit by bit.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "data/generators/named_mesh.h"
#include "fast/plan/pairing.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/gather/rings_impl.h"
#include "fast/stream/kernel/kernel.h"
#include "fast/stream/kernel/targets.h"

namespace limitcheck::fast::row_stream {

struct Unfused : ScalarNumber<float> {
  static constexpr bool kNeverFused =
      true;  // limits inside quads as at small depths: the shaders know no other way
  static float fma(float a, float b, float c) { return a * b + c; }
  static float fms(float a, float b, float c) { return a * b - c; }
  static float fnma(float a, float b, float c) { return c - a * b; }
};

/// The grids and the edges of a mesh at a depth, with local origins or without, by both kernels.
class Compared {
 public:
  Compared(const Kernel& kernel, const std::string& name, int depth, bool local)
      : kernel_(kernel),
        mesh_(data::named_mesh(name)),
        adjacency_(mesh_),
        depth_(depth),
        placed_(place<float>(mesh_)) {
    placed_.placement.local_from = local ? 1 : kMaxDepth + 1;
  }

  // Numbers whose bits differ, of how many.
  std::int64_t differ = 0, compared = 0;

  void grids() {
    const auto depths = std::vector<std::int32_t>(mesh_.faces.size(), depth_);
    const std::vector<Grid> all = pair_faces(adjacency_, depths).grids;
    const std::size_t n = (std::size_t{1} << depth_) + 1;
    run(
        all, 6 * n * n, input_size(depth_),
        [&](const auto& rings, std::span<const Grid> some, int lanes, float* input) {
          gather(rings, some, depth_, lanes, input);
        },
        [&](float* input, float* out) {
          kernel_.run(input, depth_, placed_.placement, nullptr,
                      {out, static_cast<std::ptrdiff_t>(6 * n * n), static_cast<std::ptrdiff_t>(6 * n),
                       nullptr, nullptr});
        },
        [&](float* input, float* work, float* out) {
          const Target<float> target{out, 0, static_cast<std::ptrdiff_t>(6 * n), nullptr, nullptr};
          generic::Stream<Unfused>(input, depth_, placed_.placement, work, {target}).run();
        });
  }
  void edges() {
    std::vector<std::int32_t> all(3 * mesh_.faces.size());
    for (std::size_t h = 0; h < all.size(); ++h) all[h] = static_cast<std::int32_t>(h);
    const auto n = static_cast<std::size_t>(edge_output_size(depth_));
    run(
        all, n, edge_input_size(depth_),
        [&](const auto& rings, std::span<const std::int32_t> some, int lanes, float* input) {
          gather_edges(rings, some, depth_, lanes, input);
        },
        [&](float* input, float* out) {
          kernel_.run_edges(input, depth_, placed_.placement, nullptr, out, static_cast<std::ptrdiff_t>(n));
        },
        [&](float* input, float* work, float* out) {
          generic::EdgeStream<Unfused> strip(depth_, placed_.placement, work);
          strip.scatter(input, 0, input + edge_block_size(depth_), 0, generic::LaneRow<Unfused>{out, 0});
        });
  }

 private:
  template <class Item, class Gather, class OnGpu, class Here>
  void run(const std::vector<Item>& items, std::size_t numbers, int input_numbers, Gather&& gather_some,
           OnGpu&& on_gpu, Here&& here) {
    const BasicLoopRings<ScalarNumber<float>> rings(adjacency_, placed_);
    const BasicLoopRings<Unfused> same(adjacency_, placed_);
    const auto lanes = static_cast<std::size_t>(kernel_.lanes);
    std::vector<float> input(static_cast<std::size_t>(input_numbers) * lanes), out(numbers * lanes),
        expected(numbers), work(static_cast<std::size_t>(work_size(depth_)));
    for (std::size_t first = 0; first < items.size(); first += lanes) {
      const auto some = std::span(items).subspan(first, std::min(lanes, items.size() - first));
      gather_some(rings, some, kernel_.lanes, input.data());
      on_gpu(input.data(), out.data());
      for (std::size_t k = 0; k < some.size(); ++k) {
        gather_some(same, some.subspan(k, 1), 1, input.data());
        here(input.data(), work.data(), expected.data());
        for (std::size_t i = 0; i < numbers; ++i, ++compared)
          differ += std::memcmp(&out[k * numbers + i], &expected[i], sizeof(float)) != 0 ? 1 : 0;
      }
    }
  }

  const Kernel& kernel_;
  data::ControlMesh mesh_;
  Adjacency adjacency_;
  int depth_;
  PlacedPoints<float> placed_;
};

}  // namespace limitcheck::fast::row_stream
