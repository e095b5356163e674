// SPDX-License-Identifier: MIT
// A Catmull-Clark surface with creases, drawn adaptively by the engine: with cracks, and with the paper's
// fans.
#include <algorithm>

#include "bench/reproduction/studio.h"
#include "data/generators/named_mesh.h"

namespace limitcheck::bench {
namespace {

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

Image adaptive_creases() {
  Studio studio(creased_pawn());
  double height = 0;
  for (const auto& p : studio.mesh().positions) height = std::max(height, 2 * p[1]);
  const fast::Camera whole = camera_at(25, 1.7 * height);
  // The collar's lower edge, from a little above.
  fast::Camera close = camera_at(25, .14 * height);
  close.target = {.09 * height, .112 * height, .19 * height};
  close.eye = close.target + close.eye;
  fast::DepthOptions adaptive = strategy(fast::Strategy::kCombined);
  adaptive.target_pixels = 40;
  adaptive.angle_front = adaptive.angle_silhouette = 8;
  const auto shot = [&](const fast::Camera& camera, fast::Repair repair) {
    fast::CrackOptions cracks;
    cracks.repair = repair;
    Appearance appearance = by_depth(true);
    appearance.backfaces = true;  // what shows through a crack is the inside, in red
    return studio.shot(studio.frame(adaptive, whole, cracks), camera, appearance);
  };
  return beside(
      {shot(whole, fast::Repair::kFan), shot(close, fast::Repair::kNone), shot(close, fast::Repair::kFan)});
}

}  // namespace limitcheck::bench
