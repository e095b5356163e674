// SPDX-License-Identifier: MIT
#include "verify/gl/frame_recorder.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

#include "data/error.h"

namespace limitcheck::verify {

namespace rs = fast::row_stream;
using fast::gpu::BatchUniforms;
using fast::gpu::Shader;

namespace {

std::mutex one_at_a_time;
FrameRecorder* current = nullptr;

constexpr auto kName = 0x7fe1d9a5U;  // a NaN that nobody computes
constexpr int kLanes = static_cast<int>(FrameRecorder::kLanes);

fast::Vec3<float> name_of(std::int64_t number) {
  const auto bits = static_cast<std::uint64_t>(number);
  return {std::bit_cast<float>(kName), std::bit_cast<float>(static_cast<std::uint32_t>(bits)),
          std::bit_cast<float>(static_cast<std::uint32_t>(bits >> 32))};
}

FrameRecorder& recorder() {
  if (current == nullptr) throw std::logic_error("kernels of FrameRecorder, and no recorder");
  return *current;
}

int checked(int depth) {
  if (depth > fast::gpu::kMaxDepth) throw data::ArgumentError("row streaming on a GPU: depth is 0 to 8");
  return depth;
}

// Names for rows of vertices from number `first` on: those of a lane to at(lane), and target.row after each row.
void put_names(std::int64_t first, int depth, int rows, const auto& at, const auto& target) {
  const int n = (1 << depth) + 1;
  for (int j = 0; j < rows; ++j) {
    for (int lane = 0; lane < kLanes; ++lane) {
      auto* to = reinterpret_cast<rs::Vertex*>(at(lane) + target.row_offset(j));
      for (int i = 0; i < n; ++i) {
        const std::int64_t number = 2 * (first + (std::int64_t{lane} * rows + j) * n + i);
        to[i] = {name_of(number), name_of(number + 1)};
      }
    }
    if (target.row != nullptr) target.row(target.context, j);
  }
}

}  // namespace

struct RecordingKernels {
  using Placement = rs::BatchPlacement<float>;
  static constexpr const char* kKernel = "recorded";

  static FrameRecorder::Batch of(Shader shader, int depth, const Placement& placement) {
    return {shader, placement.local, false, BatchUniforms::of(checked(depth), placement, kLanes), {}, 0, {}};
  }
  static FrameRecorder::Batch of(Shader shader, const rs::QuadBatch<float>& batch,
                                 const fast::Placement<float>& placement) {
    checked(batch.depth);
    const bool local = shader != Shader::kQuadPatches && batch.local;
    const int sides = shader == Shader::kQuadSides ? 1 : 4;
    return {shader, local, false, BatchUniforms::of(batch, placement, kLanes, sides), {}, 0, {}};
  }
  static void add_placed(FrameRecorder::Batch batch, const float* input, int numbers, float* const* lane) {
    batch.placed = true;
    std::copy_n(lane, kLanes, batch.place.begin());
    recorder().add(std::move(batch), input, numbers, 0);
  }

  static const char* run(float* input, int depth, const Placement& placement, float* /*work*/,
                         const rs::Target<float>& target) {
    const int rows = (1 << depth) + 1;
    const std::int64_t first =
        recorder().add(of(Shader::kTriangleGrids, depth, placement), input, rs::input_size(depth), rows);
    put_names(
        first, depth, rows, [&](int lane) { return target.base + lane * target.lane_stride; }, target);
    return kKernel;
  }
  static void run_edges(const float* input, int depth, const Placement& placement, float* /*work*/,
                        float* out, std::ptrdiff_t lane_stride) {
    const std::int64_t first =
        recorder().add(of(Shader::kTriangleEdges, depth, placement), input, rs::edge_input_size(depth), 1);
    put_names(
        first, depth, 1, [&](int lane) { return out + lane * lane_stride; }, rs::Target<float>{});
  }
  static void run_lines(float* input, int depth, const Placement& placement, float* /*work*/,
                        float* const* lane, fast::Stores /*stores*/) {
    add_placed(of(Shader::kTriangleGrids, depth, placement), input, rs::input_size(depth), lane);
  }
  template <Shader shader>
  static const char* run_quads(const rs::QuadBatch<float>& batch, const fast::Placement<float>& placement,
                               float* /*work*/, const rs::QuadTarget<float>& target) {
    const int rows = shader == Shader::kQuadSides ? 1 : (1 << batch.depth) + 1;
    const std::int64_t first =
        recorder().add(of(shader, batch, placement), batch.input, rs::quad_input_size(batch.depth), rows);
    put_names(
        first, batch.depth, rows, [&](int lane) { return target.lane[lane]; }, target);
    return kKernel;
  }
  template <Shader shader>
  static void quad_lines(const rs::QuadBatch<float>& batch, const fast::Placement<float>& placement,
                         float* /*work*/, float* const* lane, fast::Stores /*stores*/) {
    add_placed(of(shader, batch, placement), batch.input, rs::quad_input_size(batch.depth), lane);
  }
};

const rs::Kernel& FrameRecorder::triangles(bool placed) {
  using Kernels = RecordingKernels;
  static constexpr rs::Kernel rows{Kernels::kKernel,    kLanes, false, &Kernels::run,
                                   &Kernels::run_edges, nullptr};
  static constexpr rs::Kernel lines{Kernels::kKernel,   kLanes, false, &Kernels::run, &Kernels::run_edges,
                                    &Kernels::run_lines};
  return placed ? lines : rows;
}

const rs::QuadKernel& FrameRecorder::quads(bool placed) {
  using Kernels = RecordingKernels;
  static constexpr auto with = [](rs::QuadKernel::Lines* quads, rs::QuadKernel::Lines* patches) {
    return rs::QuadKernel{Kernels::kKernel,
                          kLanes,
                          false,
                          &Kernels::run_quads<Shader::kQuads>,
                          &Kernels::run_quads<Shader::kQuadPatches>,
                          &Kernels::run_quads<Shader::kQuadSides>,
                          quads,
                          patches};
  };
  static constexpr rs::QuadKernel rows = with(nullptr, nullptr);
  static constexpr rs::QuadKernel lines =
      with(&Kernels::quad_lines<Shader::kQuads>, &Kernels::quad_lines<Shader::kQuadPatches>);
  return placed ? lines : rows;
}

FrameRecorder::FrameRecorder() : alone_(one_at_a_time) {
  current = this;
}
FrameRecorder::~FrameRecorder() {
  current = nullptr;
}

std::optional<std::int64_t> FrameRecorder::named(const fast::Vec3<float>& v) {
  if (std::bit_cast<std::uint32_t>(v.x) != kName) return std::nullopt;
  return std::int64_t{std::bit_cast<std::uint32_t>(v.z)} << 32 | std::bit_cast<std::uint32_t>(v.y);
}

std::int64_t FrameRecorder::add(Batch batch, const float* input, int numbers, int rows) {
  batch.input.assign(input, input + static_cast<std::ptrdiff_t>(numbers) * kLanes);
  const std::int64_t side = (std::int64_t{1} << batch.uniforms.depth) + 1;
  const std::lock_guard lock(adding_);
  batch.first = vertices;
  vertices += kLanes * rows * side;
  batches.push_back(std::move(batch));
  return batches.back().first;
}

}  // namespace limitcheck::verify
