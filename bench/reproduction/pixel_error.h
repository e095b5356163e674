// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "data/control_mesh.h"
#include "fast/camera.h"
#include "fast/sink.h"

namespace limitcheck::bench {

/// How far a tessellation lies from the exact surface on the screen, in pixels: at the middle and the edge
/// middles of triangles that face the viewer, the distance along the exact normal to the surface point of the
/// same parameter, as seen by the viewer. `silhouette` where the surface turns away (normal within 20 degrees
/// of the image plane), `interior` elsewhere: there the offset points at the viewer and shows less.
struct PixelError {
  double silhouette_99 = 0, interior_99 = 0;  // 99 % of the samples are not further away
  double silhouette_worst = 0, interior_worst = 0;
  double mean = 0;  // of all samples
  std::int64_t samples = 0;
};

class PixelErrorMeter {
 public:
  /// depth: the largest that will be measured.
  PixelErrorMeter(const data::ControlMesh& mesh, int depth);
  ~PixelErrorMeter();

  /// frame: with provenance. About `samples` points, evenly taken from its triangles.
  /// Of `kind` only, if given.
  PixelError measure(const fast::DrawList<float>& frame, const fast::Camera& camera, std::int64_t samples,
                     std::optional<fast::Kind> kind = {}) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limitcheck::bench
