// SPDX-License-Identifier: MIT
#include "verify/gl/resident_frame.h"

#include <fmt/core.h>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "data/error.h"
#include "verify/gl/compute.h"
#include "verify/gl/context.h"

namespace limitcheck::verify {

namespace {

namespace rs = fast::row_stream;

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
    : engine_(mesh, without_provenance(options), FrameRecorder::triangles(true), &FrameRecorder::quads(true)),
      patches_(of_whole_vertices(form)),
      compact_(form.compact),
      most_bytes_(most_bytes_of_a_buffer()),
      points_(most_bytes_) {}

ResidentFrame::~ResidentFrame() {
  try {
    const CurrentGl gl;
    glDeleteBuffers(1, &vertices_);
  } catch (const std::runtime_error&) {  // a process that has been forked: nothing of it is there
  }
}

void ResidentFrame::forget() {
  patches_.clear();
  points_.clear();
}

std::size_t ResidentFrame::bytes() const {
  return (compact_ ? sizeof(fast::CompactVertex) : sizeof(rs::Vertex)) * patches_.vertices().size();
}

// For the frame that has been planned; what was there stays.
void ResidentFrame::make_room() {
  const std::size_t size = bytes();
  if (size <= room_) return;
  const CurrentGl gl;
  GLuint larger = 0;
  glCreateBuffers(1, &larger);
  glNamedBufferData(larger, static_cast<GLsizeiptr>(size), nullptr, GL_STATIC_DRAW);
  if (room_ > 0) glCopyNamedBufferSubData(vertices_, larger, 0, 0, static_cast<GLsizeiptr>(room_));
  glDeleteBuffers(1, &vertices_);
  vertices_ = larger;
  room_ = size;
  check_gl("a buffer of vertices");
}

// False: there is no room, and the frame is to be planned anew, without what is kept from earlier ones and between.
bool ResidentFrame::give(FrameRecorder& recorder, bool anew) {
  if (bytes() > most_bytes_) {
    if (anew)
      throw std::runtime_error(
          fmt::format("a frame on a GPU: {} vertices are {} bytes, a buffer of {} holds {}",
                      patches_.vertices().size(), bytes(), gl_device(), most_bytes_));
    patches_.clear();
    return false;
  }
  make_room();
  const PlacedVertices placed{vertices_, std::as_const(patches_).vertices().data(), compact_};
  std::vector<float> more;
  std::vector<fast::gpu::Copy> copied = copies(recorder, placed, more);
  points_.give(recorder.batches, recorder.vertices, placed, more, std::move(copied));
  return true;
}

// The vertices that the last frame wrote but for whole grids; what has no name is added to `more`.
std::vector<fast::gpu::Copy> ResidentFrame::copies(const FrameRecorder& recorder,
                                                   const PlacedVertices& placed,
                                                   std::vector<float>& more) const {
  std::vector<fast::VertexRange> grids;
  for (const FrameRecorder::Batch& b : recorder.batches)
    for (const float* place : b.place) {
      const std::int64_t side = rs::side(b.uniforms.depth);
      grids.push_back({placed.number(place), side * side});
    }
  std::sort(grids.begin(), grids.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<fast::gpu::Copy> all;
  const auto number = [&](const fast::Vec3<float>& v) {
    if (const auto named = FrameRecorder::named(v)) return static_cast<std::int32_t>(*named);
    more.insert(more.end(), {v.x, v.y, v.z});
    return static_cast<std::int32_t>(2 * recorder.vertices + static_cast<std::int64_t>(more.size() / 3) - 1);
  };
  std::size_t next = 0;  // grid that does not end before v
  for (const auto& [first, count] : patches_.changed())
    for (std::int64_t v = first; v < first + count; ++v) {
      while (next < grids.size() && grids[next].first + grids[next].count <= v) ++next;
      if (next < grids.size() && grids[next].first <= v) {
        v = grids[next].first + grids[next].count - 1;
      } else {
        const std::int32_t position = number(placed.first[v].position);
        all.push_back({static_cast<std::int32_t>(v), position, number(placed.first[v].normal)});
      }
    }
  return all;
}

void ResidentFrame::run() const {
  points_.run();
}

std::vector<std::byte> ResidentFrame::read() const {
  const CurrentGl gl;
  std::vector<std::byte> all(bytes());
  if (!all.empty()) glGetNamedBufferSubData(vertices_, 0, static_cast<GLsizeiptr>(all.size()), all.data());
  check_gl("row streaming");
  return all;
}

}  // namespace limitcheck::verify
