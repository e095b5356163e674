// SPDX-License-Identifier: MIT
#include "verify/gl/compute.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <string_view>

#include "verify/gl/guard_zone.h"

namespace limitcheck::verify {

namespace {

// "0:12(5): error: .." of Mesa and "0(12) : error .." of NVIDIA as "FILE:12: error: ..": a text without line ends, of
// the first messages.
std::string readable(std::string_view log, const std::string& file) {
  std::string text;
  for (int count = 0; !log.empty() && count < 4;) {
    std::string_view line = log.substr(0, log.find_first_of("\n\r"));
    log.remove_prefix(std::min(log.size(), line.size() + 1));
    if (line.empty()) continue;
    int source = 0, number = 0;
    const char* const end = line.data() + line.size();
    const auto first = std::from_chars(line.data(), end, source);
    const auto second = first.ptr != end ? std::from_chars(first.ptr + 1, end, number) : first;
    text += count++ > 0 ? "; " : "";
    if (first.ec == std::errc{} && second.ec == std::errc{} && number > 0) {
      const std::size_t rest = line.find_first_not_of("0123456789():, ", 0);
      text += number < kNotOfTheFile ? fmt::format("{}:{}: ", file, number) : "behind or before it: ";
      line.remove_prefix(std::min(rest, line.size()));
    }
    text += line;
  }
  return text;
}

}  // namespace

void check_gl(const char* step) {
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    throw std::runtime_error(fmt::format("{}: OpenGL error {:#x}", step, error));
}

GlProgram::GlProgram(const std::vector<Stage>& stages, const std::string& file,
                     const std::vector<const char*>& captured)
    : program_(glCreateProgram()) {
  const auto log_of = [&](GLuint object, auto get_length, auto get_log) {
    GLint length = 0;
    get_length(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    get_log(object, length, nullptr, log.data());
    return readable(log.c_str(), file);
  };
  std::string refusal;
  for (const Stage& stage : stages) {
    const GLuint shader = glCreateShader(stage.kind);
    const char* const text = stage.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint done = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done == GL_FALSE && refusal.empty())
      refusal = "does not compile: " + log_of(shader, glGetShaderiv, glGetShaderInfoLog);
    glAttachShader(program_, shader);
    glDeleteShader(shader);
  }
  if (refusal.empty()) {
    if (!captured.empty())
      glTransformFeedbackVaryings(program_, static_cast<GLsizei>(captured.size()), captured.data(),
                                  GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program_);
    GLint done = 0;
    glGetProgramiv(program_, GL_LINK_STATUS, &done);
    if (done == GL_FALSE) refusal = "does not link: " + log_of(program_, glGetProgramiv, glGetProgramInfoLog);
  }
  if (refusal.empty()) return;
  glDeleteProgram(program_);
  throw std::runtime_error(refusal);
}

GlProgram::~GlProgram() {
  glDeleteProgram(program_);
}

void GlProgram::use() const {
  glUseProgram(program_);
}

void GlProgram::set(const char* uniform, std::int32_t value) const {
  glUniform1i(place(uniform), value);
}

std::array<GLint, 3> GlProgram::group() const {
  std::array<GLint, 3> size{};
  glGetProgramiv(program_, GL_COMPUTE_WORK_GROUP_SIZE, size.data());
  return size;
}

void GlProgram::compute(std::int64_t items) const {
  constexpr std::int64_t kMost = 65535;  // groups in a row that every driver does
  const std::int64_t across = group()[0], groups = (items + across - 1) / across,
                     rows = (groups + kMost - 1) / kMost;
  if (items > 0)
    glDispatchCompute(static_cast<GLuint>(std::min(groups, kMost)), static_cast<GLuint>(rows), 1);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  check_gl("glDispatchCompute");
}

GuardedBuffer::GuardedBuffer(std::size_t bytes) : size_(bytes) {
  std::vector<std::byte> content(bytes, std::byte{0xFF});
  add_guard(content);
  glCreateBuffers(1, &name_);
  glNamedBufferData(name_, static_cast<GLsizeiptr>(content.size()), content.data(), GL_DYNAMIC_COPY);
  check_gl("a buffer");
}

GuardedBuffer::~GuardedBuffer() {
  glDeleteBuffers(1, &name_);  // none if it is 0
}

void GuardedBuffer::bind(GLuint binding) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_);
  check_gl("glBindBufferBase");
}

std::vector<std::byte> GuardedBuffer::read() const {
  std::vector<std::byte> content(size_ + kDeviceGuard);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  glFinish();
  glGetNamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(content.size()), content.data());
  check_gl("glGetNamedBufferSubData");
  cut_guard(content, size_);
  return content;
}

std::vector<std::int32_t> captured_patches(const GlProgram& program, const GlPatches& patches,
                                           std::size_t words) {
  std::vector<std::int32_t> all;
  GLuint buffer = 0;
  std::array<GLuint, 2> query{};
  glCreateBuffers(1, &buffer);
  glCreateQueries(GL_PRIMITIVES_GENERATED, 1, query.data());
  glCreateQueries(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, 1, query.data() + 1);
  glEnable(GL_RASTERIZER_DISCARD);
  glPatchParameteri(GL_PATCH_VERTICES, patches.points);
  program.use();
  std::size_t room = 0;  // bytes
  const std::int64_t most = kMostPatches / patches.points;
  for (std::int64_t first = 0; first < patches.count; first += most) {
    program.set("lc_first_patch", static_cast<std::int32_t>(patches.first + first));
    const auto drawn = static_cast<GLsizei>(patches.points * std::min(most, patches.count - first));
    std::array<GLuint, 2> primitives{1, 0};
    while (primitives[0] > primitives[1]) {  // how many there are the shader decides
      room = std::max(room, static_cast<std::size_t>(primitives[0]) * 3 * words * sizeof(std::int32_t));
      glNamedBufferData(buffer, static_cast<GLsizeiptr>(room), nullptr, GL_STREAM_READ);
      glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
      glBeginQuery(GL_PRIMITIVES_GENERATED, query[0]);
      glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, query[1]);
      glBeginTransformFeedback(GL_TRIANGLES);
      if (patches.first_index < 0)
        glDrawArrays(GL_PATCHES, 0, drawn);
      else
        glDrawElements(
            GL_PATCHES, drawn, GL_UNSIGNED_INT,
            reinterpret_cast<const void*>(sizeof(GLuint) * (patches.first_index + first * patches.points)));
      glEndTransformFeedback();
      glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
      glEndQuery(GL_PRIMITIVES_GENERATED);
      for (std::size_t k = 0; k < 2; ++k) glGetQueryObjectuiv(query[k], GL_QUERY_RESULT, &primitives[k]);
      check_gl("transform feedback of patches");
    }
    const std::size_t before = all.size(), more = std::size_t{3} * primitives[1] * words;
    all.resize(before + more);
    if (more > 0)
      glGetNamedBufferSubData(buffer, 0, static_cast<GLsizeiptr>(more * sizeof all[0]), all.data() + before);
  }
  glDisable(GL_RASTERIZER_DISCARD);
  glDeleteQueries(2, query.data());
  glDeleteBuffers(1, &buffer);
  check_gl("transform feedback of patches");
  return all;
}

}  // namespace limitcheck::verify
