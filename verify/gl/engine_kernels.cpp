// SPDX-License-Identifier: MIT
#include "verify/gl/engine_kernels.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "data/error.h"
#include "verify/gl/compute.h"
#include "verify/gl/context.h"

namespace limitcheck::verify {

namespace {

namespace rs = fast::row_stream;
using fast::gpu::BatchUniforms;
using fast::gpu::Shader;
using Placement = fast::Placement<float>;
using BatchPlacement = rs::BatchPlacement<float>;

// Grids or edges of a batch, which lie side by side in what is given: as the processor's vectors have them.
constexpr int kBatch = 4;
constexpr const char* kName = "gl";

constexpr std::size_t side(int depth) {
  return (std::size_t{1} << depth) + 1;
}

// As the shaders declare them.
enum Binding : GLuint { kUniforms = 0, kGiven = 1, kPoints = 2, kBorders = 3, kEnds = 3, kEdgeOf = 4 };

// Kept in the context, which lives as long as the process.
using Buffers = std::array<GLuint, 5>;

class Pass {
 public:
  Pass(int depth, bool local, const BatchUniforms& batch, const float* given, int numbers)
      : depth_(depth), local_(local) {
    if (depth > fast::gpu::kMaxDepth) throw data::ArgumentError("row streaming on a GPU: depth is 0 to 8");
    if (kept()[0] == 0) glGenBuffers(static_cast<GLsizei>(kept().size()), kept().data());
    put(GL_UNIFORM_BUFFER, 0, kUniforms, &batch, sizeof batch);
    put(GL_SHADER_STORAGE_BUFFER, 1, kGiven, given, 4 * static_cast<std::size_t>(numbers) * kBatch);
  }
  Pass(int depth, const BatchPlacement& placement, const float* given, int numbers)
      : Pass(depth, placement.local, BatchUniforms::of(depth, placement, kBatch), given, numbers) {}

  template <class T>
  void give(Binding binding, const std::vector<T>& all) {
    put(GL_SHADER_STORAGE_BUFFER, 2, binding, all.data(), sizeof(T) * all.size());
  }
  /// So many work groups, each of which makes so many rows of points. What the last ones made they find at kBorders.
  void run(Shader shader, std::size_t groups, std::size_t rows) {
    const GlProgram& program = engine_program(shader, depth_, local_, fast::gpu::Output::kInOrder);
    program.use();
    if (numbers_ > 0) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kBorders, kept()[3]);
    numbers_ = 6 * groups * rows * side(depth_);
    put(GL_SHADER_STORAGE_BUFFER, times_++ == 0 ? 3 : 4, kPoints, nullptr, 4 * numbers_);
    program.compute(static_cast<std::int64_t>(groups) * fast::gpu::kLanes);
  }
  /// What was made last. Of this thread, until it asks for others.
  std::span<const float> points() const {
    thread_local std::vector<float> here;
    here.resize(numbers_);
    glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(4 * numbers_), here.data());
    check_gl("row streaming");
    return here;
  }

 private:
  static Buffers& kept() {
    static Buffers all{};
    return all;
  }
  static void put(GLenum kind, std::size_t buffer, GLuint binding, const void* from, std::size_t bytes) {
    glBindBufferBase(kind, binding, kept()[buffer]);
    glBufferData(kind, static_cast<GLsizeiptr>(bytes), from, GL_STREAM_DRAW);
  }

  const CurrentGl gl_;  // while it lives nobody else computes
  int depth_;
  bool local_;
  std::size_t numbers_ = 0;
  int times_ = 0;
};

// Row j of a lane to at(lane), and target.row after each.
void deliver(std::span<const float> points, int depth, std::size_t rows, const auto& at, const auto& target) {
  const std::size_t n = side(depth);
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t lane = 0; lane < kBatch; ++lane)
      std::memcpy(at(lane) + target.row_offset(static_cast<int>(j)), &points[6 * n * (lane * rows + j)],
                  24 * n);
    if (target.row != nullptr) target.row(target.context, static_cast<int>(j));
  }
}

const char* run_grids(float* input, int depth, const BatchPlacement& placement, float* /*work*/,
                      const rs::Target<float>& target) {
  const auto points = [&] {
    Pass pass(depth, placement, input, rs::input_size(depth));
    if (placement.local) {
      pass.give(kEnds, fast::gpu::edges_of_grids(depth, kBatch));
      pass.run(Shader::kTriangleEdges, 5 * kBatch, 1);
      std::vector<std::int32_t> edge_of(5 * kBatch);
      std::iota(edge_of.begin(), edge_of.end(), 0);
      pass.give(kEdgeOf, edge_of);
    }
    pass.run(Shader::kTriangleGrids, kBatch, side(depth));
    return pass.points();
  }();
  const auto at = [&](std::size_t lane) {
    return target.base + static_cast<std::ptrdiff_t>(lane) * target.lane_stride;
  };
  deliver(points, depth, side(depth), at, target);
  return kName;
}

void run_edges(const float* input, int depth, const BatchPlacement& placement, float* /*work*/, float* out,
               std::ptrdiff_t lane_stride) {
  Pass pass(depth, placement, input, rs::edge_input_size(depth));
  pass.give(kEnds, fast::gpu::edges_by_themselves(depth, kBatch));
  pass.run(Shader::kTriangleEdges, kBatch, 1);
  const std::span<const float> points = pass.points();
  for (std::size_t e = 0; e < kBatch; ++e, out += lane_stride)
    std::memcpy(out, &points[6 * side(depth) * e], 24 * side(depth));
}

// Quads of any valences, regular ones, and sides alone.
template <Shader shader>
const char* run_quads(const rs::QuadBatch<float>& batch, const Placement& placement, float* /*work*/,
                      const rs::QuadTarget<float>& target) {
  constexpr bool patches = shader == Shader::kQuadPatches, alone = shader == Shader::kQuadSides;
  const bool local = !patches && batch.local;
  const std::size_t rows = alone ? 1 : side(batch.depth);
  const auto points = [&] {
    Pass pass(batch.depth, local, BatchUniforms::of(batch, placement, kBatch, alone ? 1 : 4), batch.input,
              rs::quad_input_size(batch.depth));
    if (local && !alone) pass.run(Shader::kQuadSides, 4 * kBatch, 1);
    pass.run(shader, kBatch, rows);
    return pass.points();
  }();
  deliver(
      points, batch.depth, rows, [&](std::size_t lane) { return target.lane[lane]; }, target);
  return kName;
}

}  // namespace

const GlProgram& engine_program(Shader shader, int depth, bool local, fast::gpu::Output output) {
  using Programs = std::map<std::tuple<Shader, int, bool, fast::gpu::Output>, std::unique_ptr<GlProgram>>;
  static auto* const all = new Programs;  // the driver may be gone when objects of static storage go
  const int most = fast::gpu::compiled_for(depth);
  std::unique_ptr<GlProgram>& program = (*all)[{shader, most, local, output}];
  if (program == nullptr) {
    const std::string text = fast::gpu::source(shader, most, local, output);
    program = std::make_unique<GlProgram>(std::vector<GlProgram::Stage>{{GL_COMPUTE_SHADER, text}}, "row streaming");
  }
  return *program;
}

EngineKernels engine_kernels_by_gl() {
  static const rs::Kernel triangles{kName, kBatch, false, &run_grids, &run_edges, nullptr};
  static const rs::QuadKernel quads{kName,
                                    kBatch,
                                    false,
                                    &run_quads<Shader::kQuads>,
                                    &run_quads<Shader::kQuadPatches>,
                                    &run_quads<Shader::kQuadSides>,
                                    nullptr,
                                    nullptr};
  const CurrentGl there_is_one;
  return {triangles, quads};
}

}  // namespace limitcheck::verify
