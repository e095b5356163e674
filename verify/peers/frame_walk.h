// SPDX-License-Identifier: MIT
// A walk of frames that patches stay in their places on, for subjects that deliver the frame at its end.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "data/splitmix64.h"
#include "fast/frame/patch_mesh.h"
#include "fast/plan/depth.h"

namespace limitcheck::verify {

/// Depths where every fourth face has another one by 1, or is gone, at random.
inline std::vector<std::int32_t> other_depths(std::span<const std::int32_t> depth, data::SplitMix64& random) {
  std::vector<std::int32_t> other(depth.begin(), depth.end());
  for (std::int32_t& d : other) {
    const std::uint64_t what = random.next() % 16;
    if (what < 4) d = what == 0 ? -1 : std::clamp<std::int32_t>(d + (what < 3 ? 1 : -1), -1, fast::kDeepest);
  }
  return other;
}

/// The control points at half their size.
inline std::vector<std::array<double, 3>> halved_points(const data::ControlMesh& mesh) {
  std::vector<std::array<double, 3>> points = mesh.positions;
  for (auto& p : points)
    for (double& x : p) x /= 2;
  return points;
}

/// So many frames at other depths; the control points are elsewhere in the first half of them.
template <class Engine, class Real>
void walk(Engine& engine, const data::ControlMesh& mesh, std::span<const std::int32_t> depth, int frames,
          fast::PatchMesh<Real>& patches) {
  data::SplitMix64 random(static_cast<std::uint64_t>(frames));
  if (frames > 1) engine.move_points(halved_points(mesh));
  for (int frame = 0; frame < frames; ++frame) {
    if (frames > 1 && frame == frames / 2) engine.move_points(mesh.positions);
    engine.frame(other_depths(depth, random), patches);
  }
}

}  // namespace limitcheck::verify
