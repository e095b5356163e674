// SPDX-License-Identifier: MIT
#include "verify/gl/recorded_points.h"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "fast/stream/row_stream.h"
#include "verify/gl/compute.h"
#include "verify/gl/context.h"

namespace limitcheck::verify {

namespace {

namespace rs = fast::row_stream;
using Batch = FrameRecorder::Batch;
using fast::gpu::BatchUniforms;
using fast::gpu::EdgeEnds;
using fast::gpu::Output;
using fast::gpu::Shader;

constexpr std::size_t kSides = 4, kEdges = 5;  // of a quad, of a grid
constexpr std::size_t kMostGroups = 65535;     // in a row that every driver does

// A shader of the engine, compiled when it is first asked for; in the context that is current, which lives as long as the
// process.
const GlProgram& program(Shader shader, int depth, bool local, Output output) {
  using Programs = std::map<std::tuple<Shader, int, bool, Output>, std::unique_ptr<GlProgram>>;
  static auto* const all = new Programs;  // the driver may be gone when objects of static storage go
  const int most = fast::gpu::compiled_for(depth);
  std::unique_ptr<GlProgram>& kept = (*all)[{shader, most, local, output}];
  if (kept == nullptr) {
    const std::string text = fast::gpu::source(shader, most, local, output);
    kept = std::make_unique<GlProgram>(std::vector<GlProgram::Stage>{{GL_COMPUTE_SHADER, text}},
                                       "row streaming");
  }
  return *kept;
}

// Batches that have one of these go to the same programs.
auto kind(const Batch& b) {
  return std::tuple(b.shader, b.uniforms.depth, b.local, b.placed());
}
bool goes_before(const Batch& a, const Batch& b) {
  return kind(a) != kind(b) ? kind(a) < kind(b) : a.uniforms < b.uniforms;
}

template <class T>
std::size_t bytes_of(const std::vector<T>& all) {
  return all.size() * sizeof all[0];
}

}  // namespace

std::size_t most_bytes_of_a_buffer() {
  const CurrentGl gl;
  GLint64 bytes = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
  // The shaders count numbers in 32 bits.
  return std::min(static_cast<std::size_t>(bytes), 4 * static_cast<std::size_t>(INT32_MAX));
}

RecordedPoints::~RecordedPoints() {
  try {
    clear();
  } catch (const std::runtime_error&) {  // a process that has been forked: nothing of it is there
  }
}

void RecordedPoints::clear() {
  const CurrentGl gl;
  forget();
}

void RecordedPoints::forget() {
  glDeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
  buffers_.clear();
  dispatches_.clear();
}

RecordedPoints::Buffer RecordedPoints::buffer(const void* content, std::size_t bytes) {
  GLuint made = 0;
  glCreateBuffers(1, &made);
  buffers_.push_back(made);
  glNamedBufferData(made, static_cast<GLsizeiptr>(bytes), content, GL_STATIC_DRAW);
  check_gl("a buffer");
  return made;
}

void RecordedPoints::give(std::span<Batch> batches, std::int64_t named, const PlacedVertices& placed,
                          std::span<const float> more, std::vector<fast::gpu::Copy> copies) {
  const std::size_t own = 24 * static_cast<std::size_t>(named);
  if (own + more.size_bytes() > most_bytes_)
    throw std::runtime_error("a frame on a GPU: its repaired faces have more vertices than a buffer holds");
  const CurrentGl gl;
  forget();
  placed_ = placed;
  scratch_ = buffer(nullptr, own + more.size_bytes());
  glNamedBufferSubData(scratch_, static_cast<GLintptr>(own), static_cast<GLsizeiptr>(more.size_bytes()),
                       more.data());
  first_ = batches.empty() ? 0 : batches.front().first;
  std::sort(batches.begin(), batches.end(), goes_before);
  for (std::size_t first = 0, end; first < batches.size(); first = end) {
    const Batch& front = batches[first];
    const std::size_t made =
        24 * static_cast<std::size_t>(rs::side(front.uniforms.depth)) * kEdges * front.lanes();
    const std::size_t most =
        std::max<std::size_t>(1, std::min({kMostGroups / (kEdges * front.lanes()), most_bytes_ / made,
                                           most_bytes_ / (4 * front.input.size())}));
    for (end = first; end < batches.size() && end - first < most && kind(batches[end]) == kind(front);) ++end;
    add(batches.subspan(first, end - first));
  }
  if (copies.empty()) return;
  while (copies.size() % fast::gpu::kLanes != 0) copies.push_back(copies.back());
  const GlProgram& copy =
      program(Shader::kCopies, 0, false, placed.compact ? Output::kPlacedCompact : Output::kPlaced);
  add_run({&copy, 0, scratch_, placed.buffer, buffer(copies.data(), bytes_of(copies)), 0, 0, 0}, {}, 0,
          copies.size() / fast::gpu::kLanes);
}

// Batches of one kind that lie side by side in what is given.
void RecordedPoints::add(std::span<const Batch> alike) {
  const Batch& front = alike.front();
  const int depth = front.uniforms.depth;
  const std::size_t lanes = front.lanes(), side = static_cast<std::size_t>(rs::side(depth));
  const bool alone = front.shader == Shader::kTriangleEdges || front.shader == Shader::kQuadSides;
  const std::size_t made = alone ? side : side * side;  // vertices, by each lane
  std::vector<float> input;
  std::vector<std::int32_t> places;
  for (const Batch& b : alike) {
    input.insert(input.end(), b.input.begin(), b.input.end());
    for (std::size_t k = 0; k < lanes; ++k)
      places.push_back(static_cast<std::int32_t>(
          b.placed() ? placed_.number(b.place[k]) : b.first - first_ + static_cast<std::int64_t>(k * made)));
  }
  const Output output = !front.placed() || !placed_.compact ? Output::kPlaced : Output::kPlacedCompact;
  const Buffer given = buffer(input.data(), bytes_of(input));
  Dispatch main{&program(front.shader, depth, front.local, output),
                0,
                given,
                front.placed() ? placed_.buffer : scratch_,
                0,
                0,
                buffer(places.data(), bytes_of(places)),
                0};
  // Edges of triangles, by themselves or of each grid; sides of quads.
  std::vector<EdgeEnds> ends;
  const bool triangles = front.shader == Shader::kTriangleEdges || front.shader == Shader::kTriangleGrids;
  for (std::size_t k = 0; triangles && k < alike.size(); ++k) {
    const auto at = static_cast<std::int32_t>(k * front.input.size());
    for (const EdgeEnds& e : alone ? fast::gpu::edges_by_themselves(depth, front.uniforms.given_stride)
                                   : fast::gpu::edges_of_grids(depth, front.uniforms.given_stride))
      ends.push_back({at + e.p, e.p_first, at + e.q, e.q_first, at + e.own});
  }
  const Buffer end_buffer = triangles && (alone || front.local) ? buffer(ends.data(), bytes_of(ends)) : 0;
  const std::size_t each = alone || !front.local ? 0
                           : triangles           ? kEdges
                                                 : kSides;  // lines of a grid or quad
  Dispatch lines{};
  if (alone) main.reads = end_buffer;
  if (each > 0) {
    main.reads = buffer(nullptr, 24 * side * each * lanes * alike.size());
    lines = {&program(triangles ? Shader::kTriangleEdges : Shader::kQuadSides, depth, true, Output::kInOrder),
             0,
             given,
             main.reads,
             end_buffer,
             0,
             0,
             0};
    std::vector<std::int32_t> edge_of(ends.size());
    std::iota(edge_of.begin(), edge_of.end(), 0);
    if (triangles) main.reads_too = buffer(edge_of.data(), bytes_of(edge_of));
  }
  for (std::size_t k = 0, end = 0; k < alike.size(); k = end) {
    while (end < alike.size() && alike[end].uniforms == alike[k].uniforms) ++end;
    const auto add_step = [&](const Dispatch& step, std::size_t groups) {
      add_run(step, alike[k].uniforms, k * lanes * groups, (end - k) * lanes * groups);
    };
    if (each > 0) add_step(lines, each);
    add_step(main, 1);
  }
}

void RecordedPoints::add_run(Dispatch dispatch, BatchUniforms uniforms, std::size_t first,
                             std::size_t groups) {
  for (std::size_t at = 0; at < groups; at += kMostGroups) {
    uniforms.first_group = static_cast<std::int32_t>(first + at);
    dispatch.uniforms = buffer(&uniforms, sizeof uniforms);
    dispatch.groups = std::min(groups - at, kMostGroups);
    dispatches_.push_back(dispatch);
  }
}

void RecordedPoints::run() const {
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

void RecordedPoints::read(std::span<float> numbers) const {
  const CurrentGl gl;
  if (!numbers.empty())
    glGetNamedBufferSubData(scratch_, 0, static_cast<GLsizeiptr>(numbers.size_bytes()), numbers.data());
  check_gl("row streaming");
}

std::vector<float> points_by_gl(FrameRecorder& recorder, std::size_t most_bytes) {
  for (const Batch& b : recorder.batches)
    if (b.placed()) throw std::logic_error("points by OpenGL: the grids of an engine's frame are placed");
  std::vector<float> points(6 * static_cast<std::size_t>(recorder.vertices));
  const auto most = static_cast<std::int64_t>(most_bytes / 24);
  const std::span<Batch> all(recorder.batches);
  const auto begins = [&](std::size_t k) { return k < all.size() ? all[k].first : recorder.vertices; };
  RecordedPoints part(most_bytes);
  for (std::size_t first = 0, end; first < all.size(); first = end) {
    const std::int64_t from = begins(first);
    for (end = first + 1; end < all.size() && begins(end + 1) - from <= most;) ++end;
    const std::int64_t count = begins(end) - from;  // before they are sorted
    part.give(all.subspan(first, end - first), count);
    part.run();
    part.read(
        std::span(points).subspan(6 * static_cast<std::size_t>(from), 6 * static_cast<std::size_t>(count)));
  }
  return points;
}

void put_points(const std::vector<float>& points, std::span<rs::Vertex> vertices) {
  const auto put = [&](fast::Vec3<float>& v) {
    const auto number = FrameRecorder::named(v);
    if (!number) return;
    const float* from = points.data() + 3 * *number;
    v = {from[0], from[1], from[2]};
  };
  for (rs::Vertex& vertex : vertices) put(vertex.position), put(vertex.normal);
}

}  // namespace limitcheck::verify
