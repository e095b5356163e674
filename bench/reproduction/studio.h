// SPDX-License-Identifier: MIT
// Where the pictures are taken: cameras, colours and frames.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "bench/render/renderer.h"
#include "bench/reproduction/scene.h"
#include "data/generators/bumpy_sphere.h"
#include "data/scheme.h"
#include "fast/window/tessellator.h"

namespace limitcheck::bench {

inline constexpr int kSize = 640;

/// Looks at the origin from so many degrees round it and from a little above.
inline fast::Camera camera_at(double degrees, double distance) {
  const double angle = degrees * std::numbers::pi / 180;
  return {.eye = {distance * std::sin(angle), .35 * distance, distance * std::cos(angle)},
          .field_of_view = 40,
          .width = kSize,
          .height = kSize};
}

/// Light for shallow, dark for deep; readable without colour vision.
inline Colour depth_colour(int depth) {
  constexpr Colour scale[] = {{.99f, .91f, .15f}, {.56f, .84f, .27f}, {.13f, .66f, .52f},
                              {.17f, .45f, .56f}, {.25f, .27f, .53f}, {.27f, .0f, .33f}};
  return scale[std::min(depth, 5)];
}

/// Dark to light, readable without colour vision; from 0 to 1.
inline Colour heat(double t) {
  constexpr std::array<Colour, 5> stops{
      {{.27f, 0, .33f}, {.23f, .32f, .55f}, {.13f, .57f, .55f}, {.37f, .79f, .38f}, {.99f, .91f, .15f}}};
  const double x = std::clamp(t, 0., 1.) * (stops.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(x), stops.size() - 2);
  Colour c{};
  for (std::size_t j = 0; j < 3; ++j)
    c[j] = stops[k][j] + static_cast<float>(x - static_cast<double>(k)) * (stops[k + 1][j] - stops[k][j]);
  return c;
}

inline fast::SurfaceVertex<float> vertex(const fast::Point3& position, const fast::Point3& normal) {
  const auto narrow = [](const fast::Point3& p) {
    return fast::Vec3<float>{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  };
  return {narrow(position), narrow(normal)};
}

struct Lines {
  std::vector<Segment> segments;
  Colour colour;
};
inline constexpr Colour kRed{.8f, .1f, .1f}, kBlue{.05f, .2f, .75f};

/// A mesh, its frames and their pictures.
class Studio {
 public:
  explicit Studio(data::ControlMesh mesh) : mesh_(std::move(mesh)) {}

  fast::DrawList<float> frame(const fast::DepthOptions& depth, const fast::Camera& seen_by,
                              const fast::CrackOptions& cracks = {}) const {
    fast::DrawList<float> out;
    fast::Tessellator<float>(mesh_, {.cracks = cracks, .scheme = data::natural_scheme(mesh_)})
        .frame(depth, seen_by, out);
    return out;
  }
  Image shot(const fast::DrawList<float>& frame, const fast::Camera& camera, const Appearance& appearance,
             const std::vector<Lines>& lines = {}) {
    static Renderer renderer(kSize, kSize, 4);
    renderer.begin(camera, 20);
    renderer.draw(frame, appearance);
    for (const Lines& some : lines) renderer.draw(some.segments, some.colour);
    return renderer.image();
  }
  const data::ControlMesh& mesh() const { return mesh_; }

 private:
  data::ControlMesh mesh_;
};

/// Strips by depth, fans in orange.
inline Appearance by_depth(bool wireframe) {
  const auto colour = [](const fast::Draw& draw) {
    return draw.kind == fast::Kind::kFan ? Colour{.85f, .45f, .1f} : depth_colour(draw.depth);
  };
  return {.colour = colour, .wireframe = wireframe};
}
/// The same, and what shows through a crack, the inside, in red.
inline Appearance with_inside() {
  Appearance a = by_depth(true);
  a.backfaces = true;
  return a;
}
/// By the first vertex of a draw.
inline auto painted(const std::map<std::int64_t, Colour>& colours) {
  return [&colours](const fast::Draw& draw) { return colours.at(draw.first); };
}

inline fast::DepthOptions strategy(fast::Strategy name) {
  return {.strategy = name, .depth = 4};
}

inline Studio bumpy(int faces) {
  return Studio(data::bumpy_sphere(faces, kSphereSeed));
}

/// The control mesh itself, its faces cut into triangles from their first corner, each with a normal of its own.
fast::DrawList<float> flat_faces(const data::ControlMesh& mesh);

/// Depths 1 and 4 side by side, near and from the side: the cracks that they leave, and what becomes of them.
Image cracks_and_repair();
/// One fan, every triangle in one shade: its centre on the flat triangle, and on the limit surface.
Image fan_centres();
/// A control mesh with a crease that starts and ends, its surface, and how far OpenSubdiv's limit points are
/// off.
Image open_crease();
/// A creased Catmull-Clark surface with depths by the combined strategy: whole, near with cracks, near
/// without.
Image adaptive_creases();
/// A control mesh, and its coarse tessellation coloured by how far each triangle is off the surface.
Image error_beside_control_mesh();

}  // namespace limitcheck::bench
