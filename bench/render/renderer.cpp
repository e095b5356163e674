// SPDX-License-Identifier: MIT
#include "bench/render/renderer.h"

#include <epoxy/gl.h>
#include <fmt/core.h>
#include <png.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>

#include "data/error.h"
#include "data/io/atomic_file.h"

namespace limitcheck::bench {

namespace {

// Lit at the vertices; the fragment only interpolates.
constexpr const char* kVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colour;
uniform mat4 projection;
uniform vec3 light;
uniform bool lit;
out vec3 front;
out vec3 bare;
out vec3 place;
void main() {
  gl_Position = projection * vec4(position, 1);
  bare = colour;
  place = position;
  front = lit ? colour * (0.22 + 0.78 * max(dot(normal, light), 0)) : colour;
})";
constexpr const char* kFragmentShader = R"(#version 330 core
in vec3 front;
in vec3 bare;
in vec3 place;
uniform vec3 light;
uniform bool both;
uniform bool faceted;
out vec4 pixel;
void main() {
  vec3 own = normalize(cross(dFdx(place), dFdy(place)));
  vec3 shade = faceted ? bare * (0.22 + 0.78 * max(dot(own, light), 0)) : front;
  pixel = vec4(both && !gl_FrontFacing ? vec3(0.75, 0.2, 0.15) : shade, 1);
})";

constexpr Colour kSurface{.72f, .76f, .82f}, kEdge{.08f, .1f, .14f};

Eigen::Vector3d eigen(const fast::Point3& p) {
  return {p.x, p.y, p.z};
}

Eigen::Matrix4f view_projection(const fast::Camera& camera, double aspect, double far) {
  const Eigen::Vector3d back = (eigen(camera.eye) - eigen(camera.target)).normalized();
  const Eigen::Vector3d right = eigen(camera.up).cross(back).normalized(), up = back.cross(right);
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.block<1, 3>(0, 0) = right.transpose();
  view.block<1, 3>(1, 0) = up.transpose();
  view.block<1, 3>(2, 0) = back.transpose();
  view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * eigen(camera.eye);

  const double near = std::max(camera.near, far / 1e4);
  const double scale = 2 * camera.focal_pixels() / camera.height;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  projection(0, 0) = scale / aspect;
  projection(1, 1) = scale;
  projection(2, 2) = -(far + near) / (far - near);
  projection(2, 3) = -2 * far * near / (far - near);
  projection(3, 2) = -1;
  return (projection * view).cast<float>();
}

}  // namespace

Renderer::Renderer(int width, int height, int samples)
    : width_(width),
      height_(height),
      samples_(samples),
      program_({{GL_VERTEX_SHADER, kVertexShader}, {GL_FRAGMENT_SHADER, kFragmentShader}}, "the renderer") {
  program_.use();
  glGenVertexArrays(1, &array_);
  glBindVertexArray(array_);
  glGenBuffers(1, &buffer_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);

  glGenFramebuffers(1, &resolved_);
  glGenFramebuffers(1, &frame_);
  glGenRenderbuffers(4, attachments_.data());
  const auto attach = [&](unsigned frame, unsigned colour, unsigned depth, int count) {
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    for (const auto& [buffer, format, place] : {std::tuple{colour, GL_RGB8, GL_COLOR_ATTACHMENT0},
                                                {depth, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT}}) {
      glBindRenderbuffer(GL_RENDERBUFFER, buffer);
      glRenderbufferStorageMultisample(GL_RENDERBUFFER, count, static_cast<GLenum>(format), width_, height_);
      glFramebufferRenderbuffer(GL_FRAMEBUFFER, static_cast<GLenum>(place), GL_RENDERBUFFER, buffer);
    }
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw std::runtime_error("no picture of that size to draw to");
  };
  attach(resolved_, attachments_[0], attachments_[1], 0);
  attach(frame_, attachments_[2], attachments_[3], samples_ > 1 ? samples_ : 0);
  glViewport(0, 0, width_, height_);
  glEnable(GL_DEPTH_TEST);
}

Renderer::~Renderer() = default;  // everything goes with the context

void Renderer::begin(const fast::Camera& camera, double depth_range) {
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glClearColor(1, 1, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  const Eigen::Matrix4f matrix = view_projection(camera, static_cast<double>(width_) / height_, depth_range);
  glUniformMatrix4fv(program_.place("projection"), 1, GL_FALSE, matrix.data());
  const Eigen::Vector3d back = (eigen(camera.eye) - eigen(camera.target)).normalized();
  const Eigen::Vector3d right = eigen(camera.up).cross(back).normalized();
  const Eigen::Vector3f light = (back + .45 * back.cross(right) - .35 * right).normalized().cast<float>();
  glUniform3fv(program_.place("light"), 1, light.data());
}

void Renderer::draw(const fast::DrawList<float>& frame, const Appearance& appearance) {
  using Vertex = fast::SurfaceVertex<float>;
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(frame.vertices.size() * sizeof(Vertex)),
               frame.vertices.data(), GL_STREAM_DRAW);
  glEnableVertexAttribArray(0);
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), nullptr);
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                        reinterpret_cast<const void*>(offsetof(Vertex, normal)));
  if (appearance.backfaces)
    glDisable(GL_CULL_FACE);
  else
    glEnable(GL_CULL_FACE);
  program_.set("both", appearance.backfaces ? 1 : 0);

  const auto draws = [&](bool coloured) {
    for (const fast::Draw& draw : frame.draws) {
      if (coloured && appearance.colour) {
        const Colour c = appearance.colour(draw);
        glVertexAttrib3fv(2, c.data());
      }
      const GLenum mode = draw.mode == fast::DrawMode::kStrip ? GL_TRIANGLE_STRIP
                          : draw.mode == fast::DrawMode::kFan ? GL_TRIANGLE_FAN
                                                              : GL_TRIANGLES;
      glDrawArrays(mode, static_cast<GLint>(draw.first), draw.count);
    }
  };
  glVertexAttrib3fv(2, kSurface.data());
  program_.set("lit", 1);
  program_.set("faceted", appearance.flat ? 1 : 0);
  if (appearance.wireframe) {  // push the surface back, so that its edges lie before it
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1);
  }
  draws(true);
  program_.set("faceted", 0);
  if (!appearance.wireframe) return;
  glDisable(GL_POLYGON_OFFSET_FILL);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  program_.set("lit", 0);
  program_.set("both", 0);
  glVertexAttrib3fv(2, kEdge.data());
  draws(false);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void Renderer::draw(std::span<const Segment> segments, const Colour& colour) {
  std::vector<float> points;
  for (const Segment& s : segments) {
    for (const fast::Point3& p : {s.from, s.to})
      for (const double x : {p.x, p.y, p.z}) points.push_back(static_cast<float>(x));
  }
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(points.size() * sizeof(float)), points.data(),
               GL_STREAM_DRAW);
  glEnableVertexAttribArray(0);
  glDisableVertexAttribArray(1);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  program_.set("lit", 0);
  program_.set("both", 0);
  glVertexAttrib3fv(2, colour.data());
  glLineWidth(2.5f);  // a core context may refuse it: then they stay thin
  glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(2 * segments.size()));
  glLineWidth(1);
  glGetError();
}

void Renderer::finish() {
  glFinish();
}

Image Renderer::image() {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, frame_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  Image image{width_, height_, {}};
  const auto row = static_cast<std::ptrdiff_t>(3 * width_);
  image.rgb.resize(row * height_);
  glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  for (int y = 0; y < height_ / 2; ++y)  // OpenGL's first row is the lowest
    std::swap_ranges(image.rgb.begin() + row * y, image.rgb.begin() + row * (y + 1),
                     image.rgb.begin() + row * (height_ - 1 - y));
  return image;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  std::vector<char> bytes;
  const auto encode = [&](void* memory) {
    if (png_image_write_to_memory(&png, memory, &size, 0, image.rgb.data(), 0, nullptr) == 0)
      throw std::runtime_error(fmt::format("{}: {}", path.string(), png.message));
  };
  encode(nullptr);
  bytes.resize(size);
  encode(bytes.data());
  data::AtomicFile file(path);
  file.stream().write(bytes.data(), static_cast<std::streamsize>(size));
  file.commit();
}

Image beside(const std::vector<Image>& images, int gap) {
  Image all;
  for (const Image& image : images) {
    if (image.height != images.front().height)
      throw data::ArgumentError("images beside each other need one height");
    all.width += image.width + (all.width > 0 ? gap : 0);
  }
  all.height = images.front().height;
  all.rgb.assign(3 * static_cast<std::size_t>(all.width) * static_cast<std::size_t>(all.height), 255);
  int left = 0;
  for (const Image& image : images) {
    const auto row = static_cast<std::size_t>(3 * image.width);
    for (int y = 0; y < all.height; ++y) {
      std::copy_n(image.rgb.begin() + static_cast<std::ptrdiff_t>(row) * y, row,
                  all.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(all.width) * y + left));
    }
    left += image.width + gap;
  }
  return all;
}

}  // namespace limitcheck::bench
