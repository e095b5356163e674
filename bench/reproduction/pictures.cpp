// SPDX-License-Identifier: MIT
// The paper's pictures from our own data.
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "bench/render/renderer.h"
#include "bench/reproduction/reproduction.h"
#include "data/generators/bumpy_sphere.h"
#include "data/shapes.h"
#include "fast/depth.h"
#include "fast/frame.h"
#include "reference/refine.h"

namespace limitcheck::bench {

namespace {

constexpr int kSize = 800;

fast::Camera camera_at(double degrees, double distance) {
  fast::Camera camera;
  const double angle = degrees * std::numbers::pi / 180;
  camera.eye = {distance * std::sin(angle), .35 * distance, distance * std::cos(angle)};
  camera.field_of_view = 40;
  camera.width = camera.height = kSize;
  return camera;
}

/// Light for shallow, dark for deep; readable without colour vision.
Colour depth_colour(int depth) {
  constexpr Colour scale[] = {{.99f, .91f, .15f}, {.56f, .84f, .27f}, {.13f, .66f, .52f},
                              {.17f, .45f, .56f}, {.25f, .27f, .53f}, {.27f, .0f, .33f}};
  return scale[std::min(depth, 5)];
}

class Studio {
 public:
  explicit Studio(data::ControlMesh mesh) : mesh_(std::move(mesh)) {}

  fast::DrawList<float> frame(const fast::DepthOptions& depth, const fast::Camera& seen_by,
                              const fast::CrackOptions& cracks = {}) const {
    fast::TessellatorOptions options;
    options.cracks = cracks;
    fast::Tessellator<float> tessellator(mesh_, options);
    fast::DrawList<float> out;
    tessellator.frame(depth, seen_by, out);
    return out;
  }
  Image shot(const fast::DrawList<float>& frame, const fast::Camera& camera, const Appearance& appearance,
             std::span<const Segment> lines = {}) {
    static Renderer renderer(kSize, kSize, 4);
    renderer.begin(camera, 20);
    renderer.draw(frame, appearance);
    if (!lines.empty()) renderer.draw(lines, {.75f, .1f, .1f});
    return renderer.image();
  }
  const data::ControlMesh& mesh() const { return mesh_; }

 private:
  data::ControlMesh mesh_;
};

Appearance by_depth(bool wireframe) {
  Appearance a;
  a.colour = [](const fast::Draw& draw) {
    return draw.kind == fast::Kind::kFan ? Colour{.85f, .45f, .1f} : depth_colour(draw.depth);
  };
  a.wireframe = wireframe;
  return a;
}

fast::DepthOptions strategy(fast::Strategy name, int depth = 4) {
  fast::DepthOptions options;
  options.strategy = name;
  options.depth = depth;
  return options;
}

fast::Point3 point(const reference::Vec3<double>& p) {
  return {p.x, p.y, p.z};
}

/// The ring of a vertex after 0, 1 and 2 steps in place, a normal on each of its triangles, and the cone
/// about the limit normal that they have to enter.
Image normal_cone(Studio& studio) {
  reference::RefinedMesh<double> refined(studio.mesh());
  const fast::Adjacency adjacency(studio.mesh());
  const fast::DepthHeuristics heuristics(studio.mesh(), adjacency);
  // Of those that need just two steps the one that begins with its triangles widest, but not folded.
  std::int32_t v = 0;
  double widest = 1;
  for (std::int32_t w = 0; w < adjacency.vertex_count(); ++w) {
    const double first = heuristics.cone_cosine(w, 0);
    if (heuristics.cone_depth(w, std::cos(std::numbers::pi / 6)) == 2 && first > .3 && first < widest)
      v = w, widest = first;
  }
  const fast::Point3 axis = heuristics.limit_normal(v);
  const fast::Point3 side = [&] {
    const fast::Point3 s = cross(axis, std::abs(axis.x) < .7 ? fast::Point3{1, 0, 0} : fast::Point3{0, 1, 0});
    return (1 / length(s)) * s;
  }();
  const fast::Point3 other = cross(axis, side);

  std::vector<Image> images;
  for (int level = 0; level <= 2; ++level) {
    const auto& positions = refined.positions();
    const auto at = [&](std::int32_t w) { return point(positions[static_cast<std::size_t>(w)]); };
    const fast::Point3 centre = at(v);
    const auto ring = refined.topology().ring(v);
    double reach = 0;
    for (const std::int32_t w : ring) reach = std::max(reach, length(at(w) - centre));

    fast::DrawList<float> fan;
    std::vector<Segment> lines;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const fast::Point3 a = at(ring[k]), b = at(ring[(k + 1) % ring.size()]);
      fast::Point3 n = cross(a - centre, b - centre);
      n = (1 / length(n)) * n;
      const fast::Point3 middle = (1. / 3) * (centre + a + b);
      lines.push_back({middle, middle + .5 * reach * n});
      for (const fast::Point3& p : {centre, a, b}) {
        fan.vertices.push_back({{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)},
                                {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)}});
      }
    }
    fan.draws.push_back(
        {0, static_cast<std::int32_t>(fan.vertices.size()), 0, 0, 0, fast::DrawMode::kTriangles});
    // The cone of 30 degrees, its tip at the vertex.
    constexpr int kRays = 24;
    const double height = .9 * reach, radius = height * std::tan(std::numbers::pi / 6);
    fast::Point3 last = centre + height * axis + radius * side;
    for (int k = 1; k <= kRays; ++k) {
      const double angle = 2 * std::numbers::pi * k / kRays;
      const fast::Point3 rim =
          centre + height * axis + radius * (std::cos(angle) * side + std::sin(angle) * other);
      lines.push_back({last, rim});
      if (k % 4 == 0) lines.push_back({centre, rim});
      last = rim;
    }

    fast::Camera camera;
    camera.target = centre + .25 * reach * axis;
    camera.eye = centre + 2.3 * reach * (.55 * axis + .8 * side);
    camera.up = axis;
    camera.near = 1e-3 * reach;
    camera.width = camera.height = kSize;
    Appearance appearance;
    appearance.wireframe = appearance.backfaces = true;
    images.push_back(studio.shot(fan, camera, appearance, lines));
    refined.refine();
  }
  return beside(images);
}

/// The limit normals of the control vertices that the depths by curvature were decided with.
std::vector<Segment> limit_normals(const data::ControlMesh& mesh) {
  const fast::Adjacency adjacency(mesh);
  const fast::DepthHeuristics heuristics(mesh, adjacency);
  std::vector<Segment> lines;
  for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
    const fast::Point3 p = heuristics.limit_position(v);
    lines.push_back({p, p + .12 * heuristics.limit_normal(v)});
  }
  return lines;
}

}  // namespace

void draw_pictures(const std::filesystem::path& folder) {
  const auto save = [&](const char* name, const Image& image) {
    write_png(folder / name, image);
    fmt::print("{}\n", (folder / name).string());
  };
  const fast::Camera front = camera_at(20, 3.7);
  Studio small(data::bumpy_sphere(200, 1)), large(data::bumpy_sphere(4000, 1));
  save("figure-3.png", normal_cone(small));

  // Near enough to see the cracks; unlit lines between the triangles would hide them.
  const fast::DepthOptions random = strategy(fast::Strategy::kRandom);
  fast::Camera close = camera_at(32, 1.9);
  close.target = {.35, .1, .6};
  fast::CrackOptions none, flat;
  none.repair = fast::Repair::kNone;
  flat.centre = fast::FanCentre::kFlatLimit;
  save("figure-6.png", small.shot(small.frame(random, close, none), close, by_depth(true)));
  save("figure-7.png", small.shot(small.frame(random, close), close, by_depth(true)));

  Studio round(data::icosahedron());
  const fast::DepthOptions coarse = strategy(fast::Strategy::kRandom, 3);
  const fast::Camera whole = camera_at(20, 5.2);
  save("figure-8.png", beside({round.shot(round.frame(coarse, whole, flat), whole, by_depth(true)),
                               round.shot(round.frame(coarse, whole), whole, by_depth(true))}));

  const fast::DepthOptions fine = strategy(fast::Strategy::kUniform);
  save("figure-10.png", beside({small.shot(small.frame(fine, front), front, {}),
                                large.shot(large.frame(fine, front), front, {})}));

  Appearance turned = by_depth(true);
  turned.backfaces = true;
  fast::DepthOptions culled = random;
  culled.cull = true;
  save("figure-13.png", beside({small.shot(small.frame(random, front), front, by_depth(true)),
                                small.shot(small.frame(culled, front), camera_at(130, 3.7), turned)}));

  const auto curved = small.frame(strategy(fast::Strategy::kCurvature), front);
  save("figure-14.png", beside({small.shot(curved, front, by_depth(true)),
                                small.shot(curved, front, by_depth(false), limit_normals(small.mesh()))}));
}

}  // namespace limitcheck::bench
