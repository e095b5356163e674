// SPDX-License-Identifier: MIT
// Programs and buffers of OpenGL 4.5, for what computes and draws nothing. A context is current in all of it; every
// function throws std::runtime_error if OpenGL refuses.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace limitcheck::verify {

/// Lines of a shader from here on are no user's: `#line` says which number the next one has.
inline constexpr int kNotOfTheFile = 1'000'000;

/// A program of shaders, made current by use().
class GlProgram {
 public:
  struct Stage {
    GLenum kind;
    std::string text;
  };
  /// Lines below kNotOfTheFile are those of `file`: messages name them. (Mesa passes over the number of a source in
  /// #line.)
  ///   captured  what transform feedback writes, one after the other in one buffer
  GlProgram(const std::vector<Stage>& stages, const std::string& file,
            const std::vector<const char*>& captured = {});
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  void use() const;
  /// Of the program in use; a name that it has not is passed over.
  void set(const char* uniform, std::int32_t value) const;
  GLint place(const char* uniform) const { return glGetUniformLocation(program_, uniform); }
  /// Runs it on so many items in groups of the size that the shader has: item k is
  /// gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x. What it writes is there for all
  /// that comes after it.
  void compute(std::int64_t items) const;
  /// How many lanes one of its groups has in each direction.
  std::array<GLint, 3> group() const;

 private:
  GLuint program_ = 0;
};

/// Memory of the device with a guard zone behind it, in which a pattern shows what is written there. All bytes before
/// it are 0xFF until they are written: a NaN, and no index.
class GuardedBuffer {
 public:
  explicit GuardedBuffer(std::size_t bytes);
  explicit GuardedBuffer(std::span<const std::int32_t> words) : GuardedBuffer(words.size_bytes()) {
    write(words.data(), words.size_bytes());
  }
  ~GuardedBuffer();
  GuardedBuffer(const GuardedBuffer&) = delete;
  GuardedBuffer& operator=(const GuardedBuffer&) = delete;
  GuardedBuffer(GuardedBuffer&& other) noexcept : size_(other.size_), name_(std::exchange(other.name_, 0)) {}

  std::size_t size() const { return size_; }
  GLuint name() const { return name_; }
  void write(const void* bytes, std::size_t count) const {
    glNamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(count), bytes);
  }
  /// As a shader's storage buffer, with its guard zone.
  void bind(GLuint binding) const;
  /// size() bytes, then those of the guard zone up to the last one that is not as it was.
  std::vector<std::byte> read() const;

 private:
  std::size_t size_;
  GLuint name_ = 0;
};

/// Patches to be drawn, the first one's number in the uniform lc_first_patch.
struct GlPatches {
  std::int64_t count, first = 0;
  int points = 1;                 // of each
  std::int64_t first_index = -1;  // among the indices of the bound array of vertices; below 0: no indices
};

/// What transform feedback captured of patches, drawn as triangles: `words` numbers for each vertex. With one point
/// each they are drawn at most `kMostPatches` at a time, with more points fewer: Mesa's llvmpipe numbers the patches of
/// a call anew from 0 after 1024 vertices.
std::vector<std::int32_t> captured_patches(const GlProgram& program, const GlPatches& patches,
                                           std::size_t words);
inline constexpr std::int64_t kMostPatches = 1024;

/// Throws if OpenGL has reported an error since it was asked last.
void check_gl(const char* step);

}  // namespace limitcheck::verify
