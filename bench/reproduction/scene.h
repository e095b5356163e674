// SPDX-License-Identifier: MIT
// What the paper's timings were taken of: bumpy spheres that turn before a fixed viewer. What frames hold, how long they take
// and how they look.     [mueller2000, 6]
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "fast/plan/crack.h"
#include "fast/plan/depth.h"
#include "fast/window/tessellator.h"
#include "verify/picture/judge.h"

namespace limitcheck::bench {

inline constexpr int kSphereFaces[] = {200, 400, 800, 1200, 1600, 2000, 2400, 2800, 3200, 3600, 4000};
inline constexpr std::uint64_t kSphereSeed = 1;

using verify::viewer;

/// One frame for the viewer, with provenance.
inline fast::DrawList<float> frame_seen(const data::ControlMesh& mesh, const fast::DepthOptions& depth,
                                        const fast::Camera& seen_by = viewer(0)) {
  fast::DrawList<float> frame;
  fast::Tessellator<float>(mesh, {.provenance = true}).frame(depth, seen_by, frame);
  return frame;
}

/// uniform-1 .. uniform-5, project-sphere, combined.
inline std::vector<std::pair<std::string, fast::DepthOptions>> strategies() {
  std::vector<std::pair<std::string, fast::DepthOptions>> list;
  for (int depth = 1; depth <= 5; ++depth)
    list.emplace_back("uniform-" + std::to_string(depth), verify::uniform(depth));
  for (const auto strategy : {fast::Strategy::kProjectSphere, fast::Strategy::kCombined})
    list.emplace_back(fast::name(strategy), verify::adaptive(strategy, 60));
  return list;
}

/// The uniform depth whose picture counts as the surface: the engine draws some millions of triangles of it.
inline int truth_depth(int faces) {
  return faces <= 800 ? 7 : 6;
}

/// A triangle of a frame and how it lies to the exact surface: at its middle, the drawn point's distance from
/// the point of the same parameter, and the interpolated normal's angle to the exact one in degrees.
struct TriangleError {
  const fast::Draw* draw = nullptr;
  std::int32_t triangle = 0;  // of the draw
  double position = 0, normal = 0;
};

/// Calls `with` for every triangle of a frame with provenance, of depths up to 5.
void each_triangle_error(const data::ControlMesh& mesh, const fast::DrawList<float>& frame,
                         const std::function<void(const TriangleError&)>& with);

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
