// SPDX-License-Identifier: MIT
// Surfaces with sharp edges: a crease that starts and ends, and where a tessellator misses it [C85]; creases drawn
// adaptively by the engine, with cracks and with the paper's fans.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "bench/reproduction/studio.h"
#include "data/bounding_box.h"
#include "data/generators/named_mesh.h"
#include "verify/evidence/evidence.h"
#include "verify/host/host.h"
#include "verify/subject/registry.h"

namespace limitcheck::bench {

namespace {

using verify::cross, verify::norm, verify::Vector, verify::operator-;

constexpr int kDepth = 4;

void add(fast::DrawList<float>& list, std::int32_t face, const std::array<Vector, 3>& p,
         const std::array<Vector, 3>& n) {
  list.draws.push_back(
      {static_cast<std::int64_t>(list.vertices.size()), 3, 1, face, -1, fast::DrawMode::kTriangles});
  for (std::size_t k = 0; k < 3; ++k)
    list.vertices.push_back(vertex(fast::to_point(p[k]), fast::to_point(n[k])));
}

// A pawn that stands upright, its foot and its collar sharp for ever, a ring between them for two steps and a
// half.
data::ControlMesh creased_pawn() {
  data::ControlMesh mesh = data::named_mesh("pawn:4");
  double top = 0;
  for (const auto& p : mesh.positions) top = std::max(top, p[2]);
  for (auto& p : mesh.positions) p = {p[0], p[2] - top / 2, -p[1]};
  constexpr std::int32_t kAround = 8;
  struct Crease {
    std::int32_t ring;
    float sharpness;
  };
  for (const Crease& crease : {Crease{1, data::kInfiniteSharpness}, Crease{3, 2.5F},
                               Crease{7, data::kInfiniteSharpness}, Crease{8, data::kInfiniteSharpness}})
    for (std::int32_t k = 0; k < kAround; ++k)
      mesh.sharpness.edges.push_back(
          {crease.ring * kAround + k, crease.ring * kAround + (k + 1) % kAround, crease.sharpness});
  return mesh;
}

}  // namespace

fast::DrawList<float> flat_faces(const data::ControlMesh& mesh) {
  fast::DrawList<float> list;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t k = 1; k + 1 < mesh.faces[f].size(); ++k) {
      const std::array<Vector, 3> p{mesh.positions[mesh.faces[f][0]], mesh.positions[mesh.faces[f][k]],
                                    mesh.positions[mesh.faces[f][k + 1]]};
      const Vector area = cross(p[1] - p[0], p[2] - p[0]);
      const double length = norm(area);
      const Vector n{area[0] / length, area[1] / length, area[2] / length};
      add(list, static_cast<std::int32_t>(f), p, {n, n, n});
    }
  return list;
}

Image open_crease() {
  Studio studio(data::named_mesh("open-crease:3"));
  const data::ControlMesh& mesh = studio.mesh();
  // The library's refinement and limits, and the exact points and normals in their place.
  verify::Session session(*lc_subject_opensubdiv_far(), mesh, "precision=double");
  const verify::Tessellation t = session.tessellate(kDepth);
  verify::ReferenceSurface exact(session.mesh(), kDepth, LC_POINTS_LIMIT);
  const auto points = verify::locate(t, exact.lattice());
  exact.prepare(points);

  fast::DrawList<float> surface, missed;
  std::map<std::int64_t, Colour> colour;
  const double most = 1e-3 * data::box_diagonal(mesh);
  for (std::int64_t k = 0; k < t.triangle_count(); ++k) {
    std::array<Vector, 3> p, n;
    double off = 0;
    const std::int32_t face = t.triangle_face()[k];
    for (std::size_t c = 0; c < 3; ++c) {
      const auto v = static_cast<std::int64_t>(t.triangles()[k][c]);
      p[c] = exact.position(points[v]);
      n[c] = exact.normal(exact.sides().of(points[v], face));
      off = std::max(off, norm(t.position(v) - p[c]));
    }
    add(surface, face, p, n);
    colour[static_cast<std::int64_t>(missed.vertices.size())] =
        heat(1 + std::log10(std::max(off, 1e-12) / most) / 4);
    add(missed, face, p, n);
  }
  Lines crease{{}, kRed};
  for (const data::SharpEdge& e : mesh.sharpness.edges)
    crease.segments.push_back({fast::to_point(mesh.positions[e.a]), fast::to_point(mesh.positions[e.b])});
  fast::Camera camera = camera_at(30, 1.05 * data::box_diagonal(mesh));
  return beside({studio.shot(flat_faces(mesh), camera, {.wireframe = true}, {crease}),
                 studio.shot(surface, camera, {}), studio.shot(missed, camera, {.colour = painted(colour)})});
}

Image adaptive_creases() {
  Studio studio(creased_pawn());
  double height = 0;
  for (const auto& p : studio.mesh().positions) height = std::max(height, 2 * p[1]);
  const fast::Camera whole = camera_at(25, 1.7 * height);
  // The collar's lower edge, from a little above.
  fast::Camera close = camera_at(25, .14 * height);
  close.target = {.09 * height, .112 * height, .19 * height};
  close.eye = close.target + close.eye;
  const fast::DepthOptions adaptive{
      .strategy = fast::Strategy::kCombined, .target_pixels = 40, .angle_front = 8, .angle_silhouette = 8};
  const auto shot = [&](const fast::Camera& camera, fast::Repair repair) {
    return studio.shot(studio.frame(adaptive, whole, {.repair = repair}), camera, with_inside());
  };
  return beside(
      {shot(whole, fast::Repair::kFan), shot(close, fast::Repair::kNone), shot(close, fast::Repair::kFan)});
}

}  // namespace limitcheck::bench
