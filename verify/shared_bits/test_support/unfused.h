// SPDX-License-Identifier: MIT
// A kernel against the kernel's own text on a number without fused multiply-add, bit by bit.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
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

/// The grids and the edges of a mesh at a depth, by both kernels.
///   origins   whether all have origins of their own, or none; else those for which the mesh wants them
class Compared {
 public:
  Compared(const Kernel& kernel, const std::string& name, int depth, std::optional<bool> origins)
      : kernel_(kernel),
        mesh_(data::named_mesh(name)),
        adjacency_(mesh_),
        depth_(depth),
        placed_(place<float>(mesh_)) {
    if (!origins) return;
    placed_.faces_local_from.clear();
    placed_.local_from = *origins ? 1 : kMaxDepth + 1;
  }

  // Numbers whose bits differ, of how many; and items some part of which has an origin of its own.
  std::int64_t differ = 0, compared = 0, local = 0, items = 0;

  void grids() {
    const auto depths = std::vector<std::int32_t>(mesh_.faces.size(), depth_);
    const std::vector<Grid> all = pair_faces(adjacency_, depths).grids;
    const std::size_t n = (std::size_t{1} << depth_) + 1;
    run(
        all, 6 * n * n, input_size(depth_),
        [&](const auto& rings, std::span<const Grid> some, int lanes, float* input) {
          return gather(rings, some, depth_, lanes, input);
        },
        [&](float* input, const auto& placement, float* out) {
          kernel_.run(input, depth_, placement, nullptr,
                      {out, static_cast<std::ptrdiff_t>(6 * n * n), static_cast<std::ptrdiff_t>(6 * n),
                       nullptr, nullptr});
        },
        [&](float* input, const auto& placement, float* work, float* out) {
          const Target<float> target{out, 0, static_cast<std::ptrdiff_t>(6 * n), nullptr, nullptr};
          generic::Stream<Unfused>(input, depth_, placement, work, {target}).run();
        });
  }
  void edges() {
    std::vector<std::int32_t> all(3 * mesh_.faces.size());
    for (std::size_t h = 0; h < all.size(); ++h) all[h] = static_cast<std::int32_t>(h);
    const auto n = static_cast<std::size_t>(edge_output_size(depth_));
    run(
        all, n, edge_input_size(depth_),
        [&](const auto& rings, std::span<const std::int32_t> some, int lanes, float* input) {
          return gather_edges(rings, some, depth_, lanes, input);
        },
        [&](float* input, const auto& placement, float* out) {
          kernel_.run_edges(input, depth_, placement, nullptr, out, static_cast<std::ptrdiff_t>(n));
        },
        [&](float* input, const auto& placement, float* work, float* out) {
          generic::EdgeStream<Unfused>(depth_, placement, work)
              .scatter(edge_input<float>(input, depth_, 1, placement), generic::LaneRow<Unfused>{out, 0});
        });
  }

 private:
  template <class Item, class Gather, class OnGpu, class Here>
  void run(const std::vector<Item>& list, std::size_t numbers, int input_numbers, Gather&& gather_some,
           OnGpu&& on_gpu, Here&& here) {
    const BasicLoopRings<ScalarNumber<float>> rings(adjacency_, placed_);
    const BasicLoopRings<Unfused> same(adjacency_, placed_);
    const auto lanes = static_cast<std::size_t>(kernel_.lanes);
    std::vector<float> input(static_cast<std::size_t>(input_numbers) * lanes), out(numbers * lanes),
        expected(numbers), work(static_cast<std::size_t>(work_size(depth_)));
    for (std::size_t first = 0; first < list.size(); first += lanes) {
      const auto some = std::span(list).subspan(first, std::min(lanes, list.size() - first));
      on_gpu(input.data(), gather_some(rings, some, kernel_.lanes, input.data()), out.data());
      for (std::size_t k = 0; k < some.size(); ++k) {
        const auto placement = gather_some(same, some.subspan(k, 1), 1, input.data());
        ++items, local += placement.local ? 1 : 0;
        here(input.data(), placement, work.data(), expected.data());
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
