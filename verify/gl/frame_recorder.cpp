// SPDX-License-Identifier: MIT
#include "verify/gl/frame_recorder.h"

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
template <int lanes>
void put_names(std::int64_t first, int depth, int rows, const auto& at, const auto& target) {
  const int n = (1 << depth) + 1;
  for (int j = 0; j < rows; ++j) {
    for (int lane = 0; lane < lanes; ++lane) {
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

// Batches that are not whole have lanes that repeat others, so there are few where nothing is gained by many.
template <bool placed>
struct RecordingKernels {
  static constexpr int kLanes = placed ? rs::kMaxLanes : 4;
  using Placement = rs::BatchPlacement<float>;
  static constexpr const char* kKernel = "recorded";

  static FrameRecorder::Batch of(Shader shader, int depth, const Placement& placement) {
    return {shader, placement.local, BatchUniforms::of(checked(depth), placement, kLanes)};
  }
  static FrameRecorder::Batch of(Shader shader, const rs::QuadBatch<float>& batch,
                                 const fast::Placement<float>& placement) {
    checked(batch.depth);
    const bool local = shader != Shader::kQuadPatches && batch.local;
    const int sides = shader == Shader::kQuadSides ? 1 : 4;
    return {shader, local, BatchUniforms::of(batch, placement, kLanes, sides)};
  }
  static void add_placed(FrameRecorder::Batch batch, const float* input, int numbers, float* const* lane) {
    batch.place.assign(lane, lane + kLanes);
    recorder().add(std::move(batch), input, numbers, 0);
  }

  static const char* run(float* input, int depth, const Placement& placement, float* /*work*/,
                         const rs::Target<float>& target) {
    const int rows = (1 << depth) + 1;
    const std::int64_t first =
        recorder().add(of(Shader::kTriangleGrids, depth, placement), input, rs::input_size(depth), rows);
    put_names<kLanes>(
        first, depth, rows, [&](int lane) { return target.base + lane * target.lane_stride; }, target);
    return kKernel;
  }
  static void run_edges(const float* input, int depth, const Placement& placement, float* /*work*/,
                        float* out, std::ptrdiff_t lane_stride) {
    const std::int64_t first =
        recorder().add(of(Shader::kTriangleEdges, depth, placement), input, rs::edge_input_size(depth), 1);
    put_names<kLanes>(
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
    put_names<kLanes>(
        first, batch.depth, rows, [&](int lane) { return target.lane[lane]; }, target);
    return kKernel;
  }
  template <Shader shader>
  static void quad_lines(const rs::QuadBatch<float>& batch, const fast::Placement<float>& placement,
                         float* /*work*/, float* const* lane, fast::Stores /*stores*/) {
    add_placed(of(shader, batch, placement), batch.input, rs::quad_input_size(batch.depth), lane);
  }
};

namespace {

template <bool placed>
constexpr rs::Kernel kTriangles = [] {
  using Kernels = RecordingKernels<placed>;
  return rs::Kernel{Kernels::kKernel, Kernels::kLanes,     false,
                    &Kernels::run,    &Kernels::run_edges, placed ? &Kernels::run_lines : nullptr};
}();

template <bool placed>
constexpr rs::QuadKernel kQuads = [] {
  using Kernels = RecordingKernels<placed>;
  return rs::QuadKernel{Kernels::kKernel,
                        Kernels::kLanes,
                        false,
                        &Kernels::template run_quads<Shader::kQuads>,
                        &Kernels::template run_quads<Shader::kQuadPatches>,
                        &Kernels::template run_quads<Shader::kQuadSides>,
                        placed ? &Kernels::template quad_lines<Shader::kQuads> : nullptr,
                        placed ? &Kernels::template quad_lines<Shader::kQuadPatches> : nullptr};
}();

}  // namespace

const rs::Kernel& FrameRecorder::triangles(bool placed) {
  return placed ? kTriangles<true> : kTriangles<false>;
}
const rs::QuadKernel& FrameRecorder::quads(bool placed) {
  return placed ? kQuads<true> : kQuads<false>;
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
  const auto lanes = static_cast<std::ptrdiff_t>(batch.lanes());
  batch.input.assign(input, input + numbers * lanes);
  const std::int64_t side = (std::int64_t{1} << batch.uniforms.depth) + 1;
  const std::lock_guard lock(adding_);
  batch.first = vertices;
  vertices += lanes * rows * side;
  batches.push_back(std::move(batch));
  return batches.back().first;
}

}  // namespace limitcheck::verify
