// SPDX-License-Identifier: MIT
// A rasteriser that needs no graphics driver and gives the same picture on every machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fast/frame/sink.h"
#include "fast/plan/depth.h"

namespace limitcheck::verify {

/// The shade that each pixel shows, in 0 .. 255, not rounded; kNothing where no surface is. Top row first.
struct Picture {
  static constexpr float kNothing = -1;

  int width = 0, height = 0;
  std::vector<float> shade;

  float at(int x, int y) const {
    return shade[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// Draws triangles with a depth buffer, one sample in the middle of each pixel, grey, one light above the
/// viewer's left shoulder: shade = 255 (0.22 + 0.78 max(0, normal . light)) with the normal interpolated
/// between the corners. Triangles seen from behind are left out, as graphics libraries do with closed
/// surfaces.
///   corners    rounded to 1/4096 pixel; a pixel whose middle lies on an edge that two triangles share
///              belongs to one of them (top-left rule), so that a mesh without cracks leaves no pixel out
///   order      of two surfaces at equal distance the one drawn first is seen
///   throws     data::ArgumentError: a camera that makes no view; a vertex that is not before its near
///              plane, or so far to the side that its rounded coordinates leave 32 bits
class Canvas : public fast::DrawSink<float> {
 public:
  explicit Canvas(const fast::Camera& camera);

  void draw(const fast::Draw& draw, std::span<const fast::SurfaceVertex<float>> vertices,
            std::span<const fast::LatticePoint> provenance) override;
  void triangle(const fast::SurfaceVertex<float>& a, const fast::SurfaceVertex<float>& b,
                const fast::SurfaceVertex<float>& c);

  const Picture& picture() const { return picture_; }

 private:
  /// A vertex on the screen: x to the right and y downwards in 1/4096 pixel; 1 / distance along the view;
  /// normal times that.
  struct ScreenVertex {
    std::int64_t x = 0, y = 0;
    double inverse = 0;
    fast::Point3 normal;
  };
  ScreenVertex project(const fast::SurfaceVertex<float>& vertex) const;
  void fill(const std::array<ScreenVertex, 3>& corners);

  fast::Camera camera_;
  fast::Point3 right_, up_, back_, light_;
  double focal_;
  Picture picture_;
  std::vector<double> inverse_;        // of the distance of what each pixel shows; 0: nothing
  std::vector<ScreenVertex> corners_;  // of the draw in work
};

}  // namespace limitcheck::verify
