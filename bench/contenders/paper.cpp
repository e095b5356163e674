// SPDX-License-Identifier: MIT
// In a file of its own: beside the batches of row streaming g++ inlines less of the window, which then takes a sixth more
// instructions.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "bench/contenders/contender.h"
#include "fast/plan/pairing.h"
#include "fast/window/sliding_window.h"
#include "reference/loop/recursion.h"

namespace limitcheck::bench {

namespace {

/// The paper's scheme, one point after the other, strips looked at and forgotten.
class Window : public Contender {
 public:
  Window(const data::ControlMesh& mesh, int depth, int threads)
      : depth_(depth),
        threads_(threads),
        adjacency_(mesh),
        pairs_(fast::pair_faces(adjacency_, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids),
        prepared_(adjacency_, fast::positions_of<float>(mesh)) {}

  void run() override {
    in_parallel(pairs_.size(), threads_, [&](std::size_t first, std::size_t last) {
      auto window = pool_.take([&] { return std::make_unique<Sliding>(depth_, adjacency_.max_valence()); });
      for (std::size_t k = first; k < last; ++k) {
        window->run(prepared_, 3 * pairs_[k].face0 + pairs_[k].edge0, depth_,
                    [](int, const fast::SurfaceVertex<float>* strip) { benchmark::DoNotOptimize(strip); });
      }
      pool_.give(std::move(window));
    });
  }
  double evaluated() const override {
    const auto side = (std::size_t{1} << depth_) + 1;
    return static_cast<double>(pairs_.size() * side * side);
  }

 private:
  using Sliding = fast::SlidingWindow<float, fast::LimitSurface<float>, fast::NoProbe, true>;

  int depth_, threads_;
  fast::Adjacency adjacency_;
  std::vector<fast::Grid> pairs_;
  fast::PreparedMesh<float> prepared_;
  Pool<Sliding> pool_;
};

/// The paper's recursive subdivider, every face by itself, in double.
class Naive : public Contender {
 public:
  Naive(const data::ControlMesh& mesh, int depth, int threads)
      : depth_(depth), threads_(threads), subdivider_(mesh) {}
  void run() override {
    in_parallel(subdivider_.face_count(), threads_, [&](std::size_t first, std::size_t last) {
      for (std::size_t f = first; f < last; ++f)
        subdivider_.tessellate(f, depth_, [](const auto& leaf) { benchmark::DoNotOptimize(&leaf); });
    });
  }
  double evaluated() const override {
    return 3 * static_cast<double>(subdivider_.face_count()) *
           static_cast<double>(std::size_t{1} << 2 * depth_);
  }

 private:
  int depth_, threads_;
  reference::NaiveSubdivider<double> subdivider_;
};

}  // namespace

std::vector<Route> paper_routes() {
  return {{"sliding-window", "the paper's scheme, scalar float, strips overwritten", 35, 0, true,
           maker<Window>()},
          {"naive", "the paper's recursive subdivider, double, triangles forgotten", 1200, 0, true,
           maker<Naive>()}};
}

}  // namespace limitcheck::bench
