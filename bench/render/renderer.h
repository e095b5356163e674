// SPDX-License-Identifier: MIT
// Draws tessellations as the paper does: strips and fans from interleaved vertex and normal arrays, Gouraud
// shading, one light.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fast/frame/sink.h"
#include "fast/plan/depth.h"
#include "verify/gl/compute.h"
#include "verify/gl/context.h"

namespace limitcheck::bench {

/// 8-bit RGB, top row first.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Throws std::runtime_error with the file's name; a file that was there before stays as it was then.
void write_png(const std::filesystem::path& path, const Image& image);

/// Side by side, `gap` white columns between them. All of one height.
Image beside(const std::vector<Image>& images, int gap = 16);

using Colour = std::array<float, 3>;

struct Appearance {
  /// Of a strip or fan; without it all are of one colour.
  std::function<Colour(const fast::Draw&)> colour;
  bool wireframe = false;  // edges of the triangles over the surface
  bool backfaces = false;  // seen from behind in red instead of not at all
  bool flat = false;       // every triangle in one shade, by its own normal: dents show that shading hides
};

struct Segment {
  fast::Point3 from, to;
};

/// One picture after the other in memory of its own. Throws
/// std::runtime_error if the graphics library refuses.
class Renderer {
 public:
  /// samples: per pixel, 1 for speed.
  Renderer(int width, int height, int samples);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  std::string name() const { return context_.renderer(); }

  /// Clears to white. The light stands above the viewer's left shoulder; the viewport is the renderer's.
  void begin(const fast::Camera& camera, double depth_range);
  void draw(const fast::DrawList<float>& frame, const Appearance& appearance = {});
  void draw(std::span<const Segment> segments, const Colour& colour);
  /// Waits until everything is drawn.
  void finish();
  Image image();

 private:
  verify::GlContext context_;
  int width_, height_, samples_;
  verify::GlProgram program_;
  unsigned array_ = 0, buffer_ = 0;
  unsigned frame_ = 0, resolved_ = 0;
  std::array<unsigned, 4> attachments_{};
};

}  // namespace limitcheck::bench
