// SPDX-License-Identifier: MIT
#include "verify/gl/resident_points.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "data/error.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/row_stream.h"
#include "verify/gl/compute.h"
#include "verify/gl/context.h"

namespace limitcheck::verify {

namespace {

namespace rs = fast::row_stream;
using fast::gpu::BatchUniforms;
using fast::gpu::Shader;

constexpr std::size_t kLanes = rs::kMaxLanes;  // that lie side by side in what is given
constexpr std::size_t kSides = 4, kEdges = 5;  // of a quad, of a grid

}  // namespace

ResidentPoints::ResidentPoints(const rs::LoopRings& rings, std::span<const fast::Grid> grids, int depth,
                               std::size_t most) {
  const CurrentGl gl;
  begin(depth, std::min(most, grids.size()));
  const auto& placement = rings.placement();
  const bool local = !rings.local().none(depth);
  std::vector<Step> steps{{program(Shader::kTriangleGrids, local), 1, 0, 0, points_}};
  if (local) {
    std::vector<fast::gpu::EdgeEnds> ends;
    for (std::size_t batch = 0; batch < most_ / kLanes; ++batch)
      for (fast::gpu::EdgeEnds e : fast::gpu::edges_of_grids(depth, kLanes)) {
        const auto at = static_cast<std::int32_t>(batch * kLanes) * rs::input_size(depth);
        ends.push_back({at + e.p, e.p_first, at + e.q, e.q_first, at + e.own});
      }
    std::vector<std::int32_t> edge_of(ends.size());
    std::iota(edge_of.begin(), edge_of.end(), 0);
    const Buffer edges = buffer(nullptr, 24 * static_cast<std::size_t>(rs::side(depth)) * ends.size());
    steps[0].reads = edges, steps[0].reads_too = buffer(edge_of.data(), 4 * edge_of.size());
    steps.insert(steps.begin(), {program(Shader::kTriangleEdges, local), kEdges,
                                 buffer(ends.data(), ends.size() * sizeof ends[0]), 0, edges});
  }
  add_parts(grids, rs::input_size(depth), steps, [&](std::span<const fast::Grid> some, float* input) {
    rs::gather(rings, some, depth, kLanes, input);
    return BatchUniforms::of(depth, placement, kLanes);
  });
}

ResidentPoints::ResidentPoints(const rs::QuadRings& rings, std::span<const std::int32_t> faces, int depth,
                               std::size_t most) {
  const CurrentGl gl;
  begin(depth, std::min(most, faces.size()));
  const auto& placement = rings.placement();
  const bool local = !rings.local().none(depth);
  std::vector<Step> steps{{program(Shader::kQuads, local), 1, 0, 0, points_}};
  if (local) {
    const Buffer sides = buffer(nullptr, 24 * static_cast<std::size_t>(rs::side(depth)) * kSides * most_);
    steps[0].reads = sides;
    steps.insert(steps.begin(), {program(Shader::kQuadSides, local), kSides, 0, 0, sides});
  }
  std::vector<std::int32_t> sorted(faces.begin(), faces.end());
  const auto others = std::stable_partition(
      sorted.begin(), sorted.end(), [&](std::int32_t f) { return rings.kind(f) == rs::QuadClass::kRegular; });
  const auto add = [&](std::span<const std::int32_t> some, const std::vector<Step>& its, auto gather) {
    add_parts(some, rs::quad_input_size(depth), its, [&](std::span<const std::int32_t> batch, float* input) {
      return BatchUniforms::of(gather(rings, batch, depth, kLanes, input, rs::Order::kFromA), placement,
                               kLanes, kSides);
    });
  };
  if (others != sorted.begin())
    add({sorted.begin(), others}, {{program(Shader::kQuadPatches, false), 1, 0, 0, points_}},
        rs::gather_patches<float>);
  add({others, sorted.end()}, steps, rs::gather_quads<float>);
}

ResidentPoints::~ResidentPoints() {
  const CurrentGl gl;
  glDeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
  programs_.clear();
}

void ResidentPoints::begin(int depth, std::size_t most) {
  if (depth < 0 || depth > fast::gpu::kMaxDepth)
    throw data::ArgumentError("row streaming on a GPU: depth is 0 to 8");
  depth_ = depth;
  points_of_a_grid_ = static_cast<std::size_t>(rs::side(depth) * rs::side(depth));
  GLint64 bytes = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
  bytes = std::min<GLint64>(bytes, INT32_MAX);  // the shaders count in 32 bits
  constexpr std::size_t kDispatch = 65535;      // work groups in a row that every driver does
  most_ = std::min({most, kDispatch / kEdges, static_cast<std::size_t>(bytes) / (24 * points_of_a_grid_)});
  most_ = std::max((most_ + kLanes - 1) / kLanes * kLanes, kLanes);
  points_ = buffer(nullptr, 24 * points_of_a_grid_ * most_);
}

ResidentPoints::Buffer ResidentPoints::buffer(const void* content, std::size_t bytes) {
  GLuint made = 0;
  glCreateBuffers(1, &made);
  buffers_.push_back(made);
  glNamedBufferData(made, static_cast<GLsizeiptr>(bytes), content, GL_STATIC_DRAW);
  check_gl("a buffer");
  return made;
}

const GlProgram* ResidentPoints::program(Shader shader, bool local) {
  const std::string text = fast::gpu::source(shader, fast::gpu::compiled_for(depth_), local);
  programs_.push_back(
      std::make_unique<GlProgram>(std::vector<GlProgram::Stage>{{GL_COMPUTE_SHADER, text}}, "row streaming"));
  return programs_.back().get();
}

// gather(items of a batch, numbers): fills them, and returns what they have in common.
template <class Item, class Gather>
void ResidentPoints::add_parts(std::span<const Item> items, int input_size, const std::vector<Step>& steps,
                               const Gather& gather) {
  const std::size_t size = static_cast<std::size_t>(input_size) * kLanes;
  for (std::size_t first = 0; first < items.size(); first += most_) {
    const auto here = items.subspan(first, std::min(most_, items.size() - first));
    std::vector<BatchUniforms> batches;
    rs::AlignedFloats input;  // zero: a batch that has no origins of its own does not say so
    input.grow((here.size() + kLanes - 1) / kLanes * size);
    for (std::size_t at = 0; at < here.size(); at += kLanes)
      batches.push_back(
          gather(here.subspan(at, std::min(kLanes, here.size() - at)), input.data() + batches.size() * size));
    Part part{buffer(input.data(), 4 * batches.size() * size), here.size(), {}};
    for (std::size_t k = 0, end = 0; k < batches.size(); k = end) {
      while (end < batches.size() && batches[end] == batches[k]) ++end;
      const std::size_t grids = std::min(end * kLanes, here.size()) - k * kLanes;
      for (const Step& step : steps) {
        BatchUniforms uniforms = batches[k];
        uniforms.first_group = static_cast<std::int32_t>(k * kLanes * step.each);
        part.dispatches.push_back({step, buffer(&uniforms, sizeof uniforms), step.each * grids});
      }
    }
    parts_.push_back(std::move(part));
  }
}

void ResidentPoints::run(const std::function<void(std::span<const float>)>& read) const {
  const CurrentGl gl;
  for (const Part& part : parts_) {
    for (const auto& [step, uniforms, groups] : part.dispatches) {
      glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms);
      GLuint binding = 1;  // as the shaders declare them
      for (const Buffer name : {part.given, step.writes, step.reads, step.reads_too})
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding++, name);
      step.program->use();
      step.program->compute(static_cast<std::int64_t>(groups) * fast::gpu::kLanes);
    }
    if (read != nullptr) {
      std::vector<float> numbers(6 * points_of_a_grid_ * part.grids);
      glGetNamedBufferSubData(points_, 0, static_cast<GLsizeiptr>(4 * numbers.size()), numbers.data());
      read(numbers);
    }
  }
  glFinish();
  check_gl("row streaming");
}

}  // namespace limitcheck::verify
