// SPDX-License-Identifier: MIT
// The numbers behind Fig. 11 and Fig. 12: bumpy spheres turned before the viewer, by every strategy.
// [C72-C78]
#include <fmt/core.h>
#include <tbb/info.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include "bench/render/renderer.h"
#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "data/generators/bumpy_sphere.h"
#include "verify/cli/screen.h"

namespace limitcheck::bench {

using Json = nlohmann::ordered_json;

namespace {

/// What the adaptive strategies cull of spheres with so many faces.
Json culled_share(int faces) {
  constexpr int kSpheres = 30;
  double sum = 0, squares = 0;
  for (std::uint64_t seed = 1; seed <= kSpheres; ++seed) {
    const auto mesh = data::bumpy_sphere(faces, seed);
    const fast::Adjacency adjacency(mesh);
    const auto facing = fast::DepthHeuristics(mesh, adjacency).facing(viewer(0));
    const double share =
        static_cast<double>(std::count(facing.begin(), facing.end(), fast::Facing::kBack)) / faces;
    sum += share, squares += share * share;
  }
  const double mean = sum / kSpheres;
  return {{"mean", mean},
          {"deviation", std::sqrt(std::max(0., squares - kSpheres * mean * mean) / (kSpheres - 1))}};
}

}  // namespace

Json sphere_table(bool quick) {
  const int all = tbb::info::default_concurrency();
  const fast::Camera camera = viewer(0);
  Renderer renderer(camera.width, camera.height, 1);
  const auto draw = [&](const fast::Camera& from, const fast::DrawList<float>& frame) {
    renderer.begin(from, 20);
    renderer.draw(frame);
    renderer.finish();
  };

  const double seconds = quick ? .01 : .2;
  const int frames = quick ? 4 : 36;
  const std::vector<int> sizes = quick ? std::vector<int>{200, 800, 2000, 4000}
                                       : std::vector<int>(std::begin(kSphereFaces), std::end(kSphereFaces));
  Json rows = Json::array();
  cli::Progress progress;
  std::size_t done = 0;
  for (const int faces : sizes) {
    const data::ControlMesh mesh = data::bumpy_sphere(faces, kSphereSeed);
    const verify::Judge judge(mesh, truth_depth(faces));
    const Frame window = sliding_window(mesh, 1), window_all = sliding_window(mesh, all);
    const Frame stream = row_stream(mesh, 1), stream_all = row_stream(mesh, all);
    const Json culled = culled_share(faces);
    for (const auto& [name, depth] : strategies()) {
      progress.show(done++, sizes.size() * 7, fmt::format("{} faces, {}", faces, name));
      // Counts must not depend on the machine's speed; those of uniform depth are the same in every frame.
      const bool adaptive = depth.strategy != fast::Strategy::kUniform;
      const Turn counted =
          turn(window, depth, frames, adaptive ? std::numeric_limits<double>::infinity() : seconds,
               Clock::kProcessor);
      Json row{{"faces", faces}, {"strategy", name}};
      row.update(counts(counted));
      row["culled"] = culled;
      row["sliding_window"] = timing(counted);
      row["sliding_window_all_threads"] = timing(turn(window_all, depth, frames, seconds, Clock::kWall));
      row["sliding_window_drawn"] = timing(turn(window, depth, frames, seconds, Clock::kProcessor, draw));
      row["row_stream"] = timing(turn(stream, depth, frames, seconds, Clock::kProcessor));
      row["row_stream_all_threads"] = timing(turn(stream_all, depth, frames, seconds, Clock::kWall));
      row["row_stream_drawn"] = timing(turn(stream, depth, frames, seconds, Clock::kProcessor, draw));
      row["picture"] = picture(judge.see(depth).difference);
      rows.push_back(std::move(row));
    }
  }
  progress.clear();
  return {
      {"renderer", renderer.name()}, {"threads", all},         {"viewport", {camera.width, camera.height}},
      {"seed", kSphereSeed},         {"load", load_average()}, {"rows", std::move(rows)}};
}

}  // namespace limitcheck::bench
