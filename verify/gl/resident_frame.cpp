// SPDX-License-Identifier: MIT
#include "verify/gl/resident_frame.h"

#include <fmt/core.h>
#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "data/error.h"
#include "fast/stream/row_stream.h"
#include "verify/gl/compute.h"
#include "verify/gl/context.h"
#include "verify/gl/engine_kernels.h"

namespace limitcheck::verify {

namespace {

namespace rs = fast::row_stream;
using Batch = FrameRecorder::Batch;
using fast::gpu::BatchUniforms;
using fast::gpu::EdgeEnds;
using fast::gpu::Output;
using fast::gpu::Shader;

constexpr std::size_t kLanes = FrameRecorder::kLanes;
constexpr std::size_t kSides = 4, kEdges = 5;  // of a quad, of a grid
constexpr std::size_t kMostGroups = 65535;     // in a row that every driver does

// Batches that have one of these go to the same programs.
auto kind(const Batch& b) {
  return std::tuple(b.shader, b.uniforms.depth, b.local, b.placed);
}
bool goes_before(const Batch& a, const Batch& b) {
  return kind(a) != kind(b) ? kind(a) < kind(b) : a.uniforms < b.uniforms;
}

template <class T>
std::size_t bytes_of(const std::vector<T>& all) {
  return all.size() * sizeof all[0];
}

fast::TessellatorOptions without_provenance(const fast::TessellatorOptions& options) {
  if (options.provenance) throw data::ArgumentError("a frame on a GPU: vertices have no provenance");
  return options;
}
fast::PatchOptions of_whole_vertices(fast::PatchOptions form) {
  form.compact = false;
  return form;
}

}  // namespace

ResidentFrame::ResidentFrame(const data::ControlMesh& mesh, const fast::TessellatorOptions& options,
                             const fast::PatchOptions& form)
    : engine_(mesh, without_provenance(options), FrameRecorder::triangles(), &FrameRecorder::quads()),
      patches_(of_whole_vertices(form)),
      compact_(form.compact) {
  const CurrentGl gl;
  GLint64 bytes = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
  // The shaders count numbers in 32 bits.
  most_bytes_ = std::min(static_cast<std::size_t>(bytes), 4 * static_cast<std::size_t>(INT32_MAX));
}

ResidentFrame::~ResidentFrame() {
  const CurrentGl gl;
  forget();
  glDeleteBuffers(1, &vertices_);
}

std::size_t ResidentFrame::vertex_bytes() const {
  return compact_ ? sizeof(fast::CompactVertex) : sizeof(rs::Vertex);
}

void ResidentFrame::forget() {
  glDeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
  buffers_.clear();
  dispatches_.clear();
}

ResidentFrame::Buffer ResidentFrame::buffer(const void* content, std::size_t bytes) {
  GLuint made = 0;
  glCreateBuffers(1, &made);
  buffers_.push_back(made);
  glNamedBufferData(made, static_cast<GLsizeiptr>(bytes), content, GL_STATIC_DRAW);
  check_gl("a buffer");
  return made;
}

// For the frame that has been planned; what was there stays.
void ResidentFrame::make_room() {
  const std::size_t bytes = vertex_bytes() * vertex_count();
  if (bytes > most_bytes_)
    throw std::runtime_error(fmt::format("a frame on a GPU: {} vertices are {} bytes, buffers of {} hold {}",
                                         vertex_count(), bytes, gl_device(), most_bytes_));
  if (bytes <= room_) return;
  GLuint larger = 0;
  glCreateBuffers(1, &larger);
  glNamedBufferData(larger, static_cast<GLsizeiptr>(bytes), nullptr, GL_STATIC_DRAW);
  if (room_ > 0) glCopyNamedBufferSubData(vertices_, larger, 0, 0, static_cast<GLsizeiptr>(room_));
  glDeleteBuffers(1, &vertices_);
  vertices_ = larger;
  room_ = bytes;
  check_gl("a buffer of vertices");
}

void ResidentFrame::give(FrameRecorder& recorder) {
  const CurrentGl gl;
  forget();
  make_room();
  std::vector<float> given;
  std::vector<fast::gpu::Copy> copied = copies(recorder, given);
  const std::size_t scratch_bytes = 24 * static_cast<std::size_t>(recorder.vertices);
  if (scratch_bytes + bytes_of(given) > most_bytes_)
    throw std::runtime_error("a frame on a GPU: its repaired faces are more than a buffer holds");
  const Buffer scratch = buffer(nullptr, scratch_bytes + bytes_of(given));
  glNamedBufferSubData(scratch, static_cast<GLintptr>(scratch_bytes), static_cast<GLsizeiptr>(bytes_of(given)),
                       given.data());
  auto& all = recorder.batches;
  std::sort(all.begin(), all.end(), goes_before);
  for (std::size_t first = 0, end; first < all.size(); first = end) {
    const Batch& front = all[first];
    const std::size_t made = 24 * static_cast<std::size_t>(rs::side(front.uniforms.depth)) * kEdges * kLanes;
    const std::size_t most =
        std::max<std::size_t>(1, std::min({kMostGroups / (kEdges * kLanes), most_bytes_ / made,
                                           most_bytes_ / (4 * front.input.size())}));
    for (end = first; end < all.size() && end - first < most && kind(all[end]) == kind(front);) ++end;
    add({all.data() + first, end - first}, scratch);
  }
  if (copied.empty()) return;
  while (copied.size() % fast::gpu::kLanes != 0) copied.push_back(copied.back());
  const GlProgram& program =
      engine_program(Shader::kCopies, 0, false, compact_ ? Output::kPlacedCompact : Output::kPlaced);
  add_run({&program, 0, scratch, vertices_, buffer(copied.data(), bytes_of(copied)), 0, 0, 0}, {}, 0,
          copied.size() / fast::gpu::kLanes);
}

// The vertices that the last frame wrote but for whole grids; those that have no names are added to `given`.
std::vector<fast::gpu::Copy> ResidentFrame::copies(const FrameRecorder& recorder,
                                                   std::vector<float>& given) const {
  const std::span<const rs::Vertex> vertices = patches_.vertices();
  const auto number_of = [&](const float* place) {
    return reinterpret_cast<const rs::Vertex*>(place) - vertices.data();
  };
  std::vector<fast::VertexRange> grids;
  for (const Batch& b : recorder.batches)
    for (std::size_t k = 0; b.placed && k < kLanes; ++k) {
      const std::int64_t side = rs::side(b.uniforms.depth);
      grids.push_back({number_of(b.place[k]), side * side});
    }
  std::sort(grids.begin(), grids.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<fast::gpu::Copy> all;
  const auto number = [&](const fast::Vec3<float>& v) {
    if (const auto named = FrameRecorder::named(v)) return static_cast<std::int32_t>(*named);
    given.insert(given.end(), {v.x, v.y, v.z});
    return static_cast<std::int32_t>(2 * recorder.vertices + static_cast<std::int64_t>(given.size() / 3) - 1);
  };
  std::size_t next = 0;  // grid that does not end before v
  for (const auto& [first, count] : patches_.changed())
    for (std::int64_t v = first; v < first + count; ++v) {
      while (next < grids.size() && grids[next].first + grids[next].count <= v) ++next;
      if (next < grids.size() && grids[next].first <= v) {
        v = grids[next].first + grids[next].count - 1;
      } else {
        const std::int32_t position = number(vertices[v].position);
        all.push_back({static_cast<std::int32_t>(v), position, number(vertices[v].normal)});
      }
    }
  return all;
}

// Batches of one kind that lie side by side in what is given.
void ResidentFrame::add(std::span<const Batch> alike, Buffer scratch) {
  const Batch& front = alike.front();
  const int depth = front.uniforms.depth;
  const auto side = static_cast<std::size_t>(rs::side(depth));
  const bool alone = front.shader == Shader::kTriangleEdges || front.shader == Shader::kQuadSides;
  const std::size_t made = alone ? side : side * side;  // vertices, by each lane
  std::vector<float> input;
  std::vector<std::int32_t> places;
  for (const Batch& b : alike) {
    input.insert(input.end(), b.input.begin(), b.input.end());
    for (std::size_t k = 0; k < kLanes; ++k)
      places.push_back(static_cast<std::int32_t>(
          b.placed ? reinterpret_cast<const rs::Vertex*>(b.place[k]) - patches_.vertices().data()
                   : b.first + static_cast<std::int64_t>(k * made)));
  }
  const Output output = !front.placed || !compact_ ? Output::kPlaced : Output::kPlacedCompact;
  const Buffer given = buffer(input.data(), bytes_of(input));
  Dispatch main{&engine_program(front.shader, depth, front.local, output),
                0,
                given,
                front.placed ? vertices_ : scratch,
                0,
                0,
                buffer(places.data(), bytes_of(places)),
                0};
  // Edges of triangles, by themselves or of each grid; sides of quads.
  std::vector<EdgeEnds> ends;
  const bool triangles = front.shader == Shader::kTriangleEdges || front.shader == Shader::kTriangleGrids;
  for (std::size_t k = 0; triangles && k < alike.size(); ++k) {
    const auto at = static_cast<std::int32_t>(k * front.input.size());
    for (const EdgeEnds& e : alone ? fast::gpu::edges_by_themselves(depth, kLanes)
                                   : fast::gpu::edges_of_grids(depth, kLanes))
      ends.push_back({at + e.p, e.p_first, at + e.q, e.q_first, at + e.own});
  }
  const Buffer end_buffer = triangles && (alone || front.local) ? buffer(ends.data(), bytes_of(ends)) : 0;
  const std::size_t each = alone || !front.local ? 0 : triangles ? kEdges : kSides;  // lines of a grid or quad
  Dispatch lines{};
  if (alone) main.reads = end_buffer;
  if (each > 0) {
    main.reads = buffer(nullptr, 24 * side * each * kLanes * alike.size());
    lines = {&engine_program(triangles ? Shader::kTriangleEdges : Shader::kQuadSides, depth, true,
                             Output::kInOrder),
             0, given, main.reads, end_buffer, 0, 0, 0};
    std::vector<std::int32_t> edge_of(ends.size());
    std::iota(edge_of.begin(), edge_of.end(), 0);
    if (triangles) main.reads_too = buffer(edge_of.data(), bytes_of(edge_of));
  }
  for (std::size_t k = 0, end = 0; k < alike.size(); k = end) {
    while (end < alike.size() && alike[end].uniforms == alike[k].uniforms) ++end;
    const auto add_step = [&](const Dispatch& step, std::size_t groups) {
      add_run(step, alike[k].uniforms, k * kLanes * groups, (end - k) * kLanes * groups);
    };
    if (each > 0) add_step(lines, each);
    add_step(main, 1);
  }
}

void ResidentFrame::add_run(Dispatch dispatch, BatchUniforms uniforms, std::size_t first, std::size_t groups) {
  for (std::size_t at = 0; at < groups; at += kMostGroups) {
    uniforms.first_group = static_cast<std::int32_t>(first + at);
    dispatch.uniforms = buffer(&uniforms, sizeof uniforms);
    dispatch.groups = std::min(groups - at, kMostGroups);
    dispatches_.push_back(dispatch);
  }
}

void ResidentFrame::run() const {
  const CurrentGl gl;
  for (const Dispatch& d : dispatches_) {
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, d.uniforms);
    GLuint binding = 1;  // as the shaders declare them
    for (const Buffer name : {d.given, d.writes, d.reads, d.reads_too, d.places})
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding++, name);
    d.program->use();
    d.program->compute(static_cast<std::int64_t>(d.groups) * fast::gpu::kLanes);
  }
  glFinish();
  check_gl("row streaming");
}

std::vector<std::byte> ResidentFrame::read() const {
  const CurrentGl gl;
  std::vector<std::byte> bytes(vertex_bytes() * vertex_count());
  if (bytes.empty()) return bytes;
  glGetNamedBufferSubData(vertices_, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
  check_gl("row streaming");
  return bytes;
}

}  // namespace limitcheck::verify
