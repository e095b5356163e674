// SPDX-License-Identifier: MIT
// The paper's pictures from our own data.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "bench/reproduction/studio.h"
#include "data/error.h"
#include "fast/plan/depth.h"
#include "reference/loop/refine.h"

namespace limitcheck::bench {

namespace {

/// The ring of a vertex after 0, 1 and 2 steps in place, the normals of its triangles moved to the vertex,
/// and the cone about the limit normal that they have to enter.
Image normal_cone() {
  Studio studio = bumpy(200);
  reference::RefinedMesh<double> refined(studio.mesh());
  const fast::Adjacency adjacency(studio.mesh());
  const fast::DepthHeuristics heuristics(studio.mesh(), adjacency);
  // Of the vertices that need just two steps, the one whose triangles are widest at first, but not folded.
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
    const auto at = [&](std::int32_t w) {
      return fast::Point3{positions[w].x, positions[w].y, positions[w].z};
    };
    const fast::Point3 centre = at(v);
    const auto ring = refined.topology().ring(v);
    double reach = 0;
    for (const std::int32_t w : ring) reach = std::max(reach, length(at(w) - centre));

    fast::DrawList<float> fan;
    std::vector<Segment> cone, normals;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const fast::Point3 a = at(ring[k]), b = at(ring[(k + 1) % ring.size()]);
      fast::Point3 n = cross(a - centre, b - centre);
      n = (1 / length(n)) * n;
      normals.push_back({centre, centre + reach * n});
      for (const fast::Point3& p : {centre, a, b}) fan.vertices.push_back(vertex(p, n));
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
      cone.push_back({last, rim});
      if (k % 4 == 0) cone.push_back({centre, rim});
      last = rim;
    }

    const fast::Camera camera{.eye = centre + 2.3 * reach * (.55 * axis + .8 * side),
                              .target = centre + .25 * reach * axis,
                              .up = axis,
                              .width = kSize,
                              .height = kSize,
                              .near = 1e-3 * reach};
    images.push_back(
        studio.shot(fan, camera, {.wireframe = true, .backfaces = true}, {{cone, kRed}, {normals, kBlue}}));
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

Image two_sizes() {
  const fast::Camera front = camera_at(20, 3.7);
  std::vector<Image> images;
  for (const int faces : {200, 4000}) {
    Studio studio = bumpy(faces);
    images.push_back(studio.shot(studio.frame(strategy(fast::Strategy::kUniform), front), front, {}));
  }
  return beside(images);
}

Image random_depths() {
  Studio studio = bumpy(200);
  const fast::Camera front = camera_at(20, 3.7);
  Appearance turned = by_depth(true);
  turned.backfaces = true;
  const fast::DepthOptions random = strategy(fast::Strategy::kRandom);
  fast::DepthOptions culled = random;
  culled.cull = true;
  return beside({studio.shot(studio.frame(random, front), front, by_depth(true)),
                 studio.shot(studio.frame(culled, front), camera_at(130, 3.7), turned)});
}

Image by_curvature() {
  Studio studio = bumpy(200);
  const fast::Camera front = camera_at(20, 3.7);
  const auto curved = studio.frame(strategy(fast::Strategy::kCurvature), front);
  return beside({studio.shot(curved, front, by_depth(true)),
                 studio.shot(curved, front, by_depth(false), {{limit_normals(studio.mesh()), kRed}})});
}

struct Picture {
  std::string name;
  Image (*draw)();
};
const std::vector<Picture> kPictures{
    {"figure-3", normal_cone},
    {"figure-8", fan_centres},
    {"figure-10", two_sizes},
    {"figure-13", random_depths},
    {"figure-14", by_curvature},
    {"picture-cracks", cracks_and_repair},
    {"picture-crease", adaptive_creases},
    {"picture-error", error_beside_control_mesh},
    {"picture-sharp", open_crease},
};

}  // namespace

std::vector<std::string> picture_names() {
  std::vector<std::string> names;
  for (const Picture& picture : kPictures) names.push_back(picture.name);
  return names;
}

void draw_picture(const std::string& name, const std::filesystem::path& folder) {
  for (const Picture& picture : kPictures)
    if (picture.name == name) {
      Image image = picture.draw();
      // 32 steps of each colour: half the file, for faint bands in the shades.
      for (auto& x : image.rgb) x = static_cast<std::uint8_t>(std::min(255, (x + 4) / 8 * 8));
      return write_png(folder / (name + ".png"), image);
    }
  throw data::ArgumentError("no picture is called " + name);
}

}  // namespace limitcheck::bench
