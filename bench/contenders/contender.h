// SPDX-License-Identifier: MIT
// The routes from a control mesh to limit points that the throughput bench compares, all behind one class.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "data/control_mesh.h"

namespace limitcheck::bench {

/// What the libraries that evaluate points fill.
struct LimitPoint {
  float position[3], normal[3];
};
inline void set_normal(const float* du, const float* dv, LimitPoint& point) {
  const float n[3] = {du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2],
                      du[0] * dv[1] - du[1] * dv[0]};
  const float scale = 1 / std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (int c = 0; c < 3; ++c) point.normal[c] = n[c] * scale;
}

/// One mesh at one depth made ready by the constructor: what can be prepared once is prepared there.
class Contender {
 public:
  virtual ~Contender() = default;
  /// Every point of the mesh: position and unit normal.
  virtual void run() = 0;
  /// Points that run() evaluates. Routes that work face by face or pair by pair evaluate those on borders
  /// more than once.
  virtual double evaluated() const = 0;
};

struct Route {
  std::string name;
  std::string what;  // one line, for the list of routes
  /// Rough figures at depth 5, to leave out cases that would take minutes or too much memory.
  double nanoseconds_per_point;
  double bytes_per_point;
  bool threads;  // can use more than one
  std::function<std::unique_ptr<Contender>(const data::ControlMesh&, int depth, int threads)> make;
  bool on_a_device = false;  // beside the processor, which a forked process does not have
};

/// Makes contenders of one class, which takes a mesh, a depth and, if it can use more than one, threads.
template <class T>
auto maker() {
  return [](const data::ControlMesh& mesh, int depth, [[maybe_unused]] int threads) {
    if constexpr (std::is_constructible_v<T, const data::ControlMesh&, int, int>)
      return std::make_unique<T>(mesh, depth, threads);
    else
      return std::make_unique<T>(mesh, depth);
  };
}

/// Ours: row streaming on every target of this machine and in every output form, the sliding window, the
/// naive subdivider.
std::vector<Route> our_routes();
/// The last two of these alone.
std::vector<Route> paper_routes();
/// The same for meshes of quads: row streaming of Catmull-Clark's surfaces.
std::vector<Route> our_quad_routes();

/// Row streaming of either scheme by OpenGL. Throws std::runtime_error if there is none.
Route row_stream_by_gl();

/// Others', for meshes of triangles (Loop's scheme) or of quads (Catmull-Clark's). Each as fast as the
/// library's own interface lets it be, in float where it can be: no plug-in interface, no provenance.
Route bfr_streaming();
Route bfr_cached_stencils();
/// Bfr streaming of a mesh whose faces have depths of their own, -1: not at all; on one thread.
std::function<void()> bfr_frame(const data::ControlMesh& mesh, std::span<const std::int32_t> depth);
Route far_uniform();
Route far_limit_stencils();
Route cgal_refinement();
Route openmesh_refinement();
/// Of quads alone.
Route embree_interpolation();

/// Distinct points of a closed mesh of triangles or quads, vertices of the control mesh included.
double distinct_points(const data::ControlMesh& mesh, int depth);

/// run(first, last) for pieces of 0 .. count on that many threads; on one thread without any library.
void in_parallel(std::size_t count, int threads,
                 const std::function<void(std::size_t first, std::size_t last)>& run);

/// A workspace for each thread that runs, kept from run to run.
template <class T>
class Pool {
 public:
  template <class Make>
  std::unique_ptr<T> take(const Make& make) {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return make();
    auto last = std::move(free_.back());
    free_.pop_back();
    return last;
  }
  void give(std::unique_ptr<T> item) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(item));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> free_;
};

}  // namespace limitcheck::bench
