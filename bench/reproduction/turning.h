// SPDX-License-Identifier: MIT
// The object turned before the viewer: what frames hold, how long they take and how they look.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "data/control_mesh.h"
#include "fast/plan/crack.h"
#include "fast/plan/depth.h"
#include "fast/window/tessellator.h"
#include "verify/picture/judge.h"

namespace limitcheck::bench {

/// One engine on one mesh: a frame of a strategy seen from somewhere. The mesh must outlive it.
using Frame =
    std::function<fast::FrameStats(const fast::DepthOptions&, const fast::Camera&, fast::DrawList<float>&)>;

/// threads: 0 all.
Frame sliding_window(const data::ControlMesh& mesh, int threads, fast::Repair repair = fast::Repair::kFan);
Frame row_stream(const data::ControlMesh& mesh, int threads);

/// What passes: processor time of this process, which other programs on the machine do not add to; or time on
/// the wall, for several threads at once.
enum class Clock { kProcessor, kWall };
/// Since some moment in the past.
double seconds_of(Clock clock);

/// Some frames, each taken several times.
struct Turn {
  int frames = 0;
  double seconds = 0;      // tessellated and shown, of each frame the least time of its repetitions
  double spread = 1;       // the slowest repetition of all frames over the fastest
  double shown_share = 0;  // of the time: shown
  fast::FrameStats sum;    // of one repetition
};

/// At least one frame; more of them, evenly round, until the time is up; then all of them again.
Turn turn(const Frame& frame, const fast::DepthOptions& depth, int frames, double seconds, Clock clock,
          const std::function<void(const fast::Camera&, const fast::DrawList<float>&)>& shown = {});

/// Means per frame: triangles, strips, fans, pairs, singletons, culled share, limit points.
nlohmann::ordered_json counts(const Turn& turn);
/// Frames per second, the spread, and the shares of the stages in the whole time: heuristics, pairing,
/// cracks, window, drawing.
nlohmann::ordered_json timing(const Turn& turn);
/// How a strategy looks: mean, median, percentile_99, share, missing, extra; see verify::Difference.
nlohmann::ordered_json picture(const verify::Difference& difference);

}  // namespace limitcheck::bench
