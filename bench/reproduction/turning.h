// SPDX-License-Identifier: MIT
// The object turned before the viewer: what frames hold, how long they take and how far they are off.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "bench/reproduction/pixel_error.h"
#include "data/control_mesh.h"
#include "fast/camera.h"
#include "fast/crack.h"
#include "fast/depth.h"
#include "fast/frame.h"

namespace limitcheck::bench {

/// One engine on one mesh: a frame of a strategy seen from somewhere. The mesh must outlive it.
using Frame =
    std::function<fast::FrameStats(const fast::DepthOptions&, const fast::Camera&, fast::DrawList<float>&)>;

/// threads: 0 all.
Frame sliding_window(const data::ControlMesh& mesh, int threads, fast::Repair repair = fast::Repair::kFan);
Frame row_stream(const data::ControlMesh& mesh, int threads);

/// Sums over the frames of a turn.
struct Turn {
  int frames = 0;
  double seconds = 0;  // tessellated and shown
  double shown = 0;    // of these: shown
  fast::FrameStats sum;
};

/// At least one frame; more of them, evenly round, until the time is up.
Turn turn(const Frame& frame, const fast::DepthOptions& depth, int frames, double seconds,
          const std::function<void(const fast::Camera&, const fast::DrawList<float>&)>& shown = {});

/// Means per frame: triangles, strips, fans, pairs, singletons, culled share, limit points.
nlohmann::ordered_json counts(const Turn& turn);
/// Frames per second, and the shares of the stages in the
/// whole time: heuristics, pairing, cracks, window, drawing.
nlohmann::ordered_json timing(const Turn& turn);

/// The errors of three views, 120 degrees apart: the worst of each, and the mean of the means.
PixelError turned_error(const data::ControlMesh& mesh, const PixelErrorMeter& meter,
                        const fast::DepthOptions& depth, fast::Repair repair = fast::Repair::kFan);

}  // namespace limitcheck::bench
