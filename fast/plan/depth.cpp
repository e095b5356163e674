// SPDX-License-Identifier: MIT
#include "fast/plan/depth.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

#include "data/splitmix64.h"
#include "fast/plan/quad_depth.h"
#include "fast/rules/ring.h"

namespace limitcheck::fast {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw data::ArgumentError("depth: " + what);
}

// A hash of (seed, face).
std::uint64_t mix(std::uint64_t z) {
  return data::SplitMix64(z).next();
}

bool uses_sphere(Strategy s) {
  return s == Strategy::kProjectSphere || s == Strategy::kCombined;
}
bool uses_cone(Strategy s) {
  return s == Strategy::kCurvature || s == Strategy::kCombined;
}

double checked_cosine(double degrees) {
  if (!(degrees > 0 && degrees <= 180)) refuse("the angle must lie in (0, 180] degrees");
  return std::cos(degrees * std::numbers::pi / 180);
}

// Isolated: a thread that waits here must not pick up a task of the caller that comes back to the same
// call_once.
template <class Body>
void for_each_range(std::size_t count, const Body& body) {
  constexpr std::size_t kGrain = 512;
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain), [&](const auto& range) {
      body(static_cast<std::int32_t>(range.begin()), static_cast<std::int32_t>(range.end()));
    });
  });
}
template <class Body>
void for_each_index(std::size_t count, const Body& body) {
  for_each_range(count, [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t i = first; i < last; ++i) body(i);
  });
}

}  // namespace

void TriangleSurface::gather(Ring& ring, std::int32_t v) const {
  ring.gather(mesh, adjacency, v, kinds[v]);
}

std::string_view name(Strategy strategy) {
  constexpr std::array<std::string_view, 6> kNames{"uniform",   "random",   "project-sphere",
                                                   "curvature", "combined", "custom"};
  return kNames[static_cast<std::size_t>(strategy)];
}

bool DepthOptions::culls() const {
  return cull.value_or(uses_sphere(strategy) || uses_cone(strategy));
}

template <class Surface>
BasicDepthHeuristics<Surface>::BasicDepthHeuristics(const Surface& surface, int max_depth)
    : surface_(surface), max_depth_(max_depth) {
  if (max_depth < 0 || max_depth > kDeepest) {
    refuse("the maximum " + std::to_string(max_depth) + " is not in 0.." + std::to_string(kDeepest));
  }
  points_moved();
}

template <class Surface>
void BasicDepthHeuristics<Surface>::points_moved() {
  make_limits();
  make_spheres();
  std::fill(known_cones_.begin(), known_cones_.end(), std::int8_t{0});
}

template <class Surface>
void BasicDepthHeuristics<Surface>::make_limits() {
  const auto positions = surface_.positions();
  limit_.resize(positions.size());
  normal_.resize(positions.size());
  const double farthest = positions.empty() ? 0 : 2 * Box(positions).size();
  std::atomic<std::int64_t> degenerate_count{0};
  tbb::enumerable_thread_specific<typename Surface::VertexRing> rings;
  for_each_range(positions.size(), [&](std::int32_t first, std::int32_t last) {
    auto& ring = rings.local();
    for (std::int32_t v = first; v < last; ++v) {
      surface_.gather(ring, v);
      bool degenerate = false;
      const SurfaceVertex<double> vertex = ring.limit_vertex(&degenerate, farthest);
      limit_[v] = vertex.position;
      normal_[v] = vertex.normal;
      if (degenerate && ring.faces() > 0) ++degenerate_count;
    }
  });
  degenerate_normals_ = degenerate_count;
}

template <class Surface>
void BasicDepthHeuristics<Surface>::make_spheres() {
  spheres_.resize(surface_.face_count());
  for_each_index(spheres_.size(), [&](std::int32_t f) {
    Point3 sum{};
    int corners = 0;
    surface_.for_each_corner(f, [&](std::int32_t v) { sum = sum + position(v), ++corners; });
    const Point3 centroid = (1. / corners) * sum;
    double square = 0;
    surface_.for_each_corner(f, [&](std::int32_t v) {
      const Point3 spoke = position(v) - centroid;
      square = std::max(square, dot(spoke, spoke));
    });
    spheres_[f] = {centroid, std::sqrt(square)};
  });
}

template <class Surface>
bool BasicDepthHeuristics<Surface>::faces_away(std::int32_t v, const Camera& camera) const {
  return dot(normal_[v], limit_[v] - camera.eye) >= 0;
}

template <class Surface>
std::vector<std::uint8_t> BasicDepthHeuristics<Surface>::away(const Camera& camera) const {
  std::vector<std::uint8_t> result(limit_.size());
  for_each_index(result.size(), [&](std::int32_t v) { result[v] = faces_away(v, camera); });
  return result;
}

template <class Surface>
Facing BasicDepthHeuristics<Surface>::facing(std::int32_t face, std::span<const std::uint8_t> away) const {
  bool any = false, all = true;
  surface_.for_each_corner(face, [&](std::int32_t v) {
    any = any || away[v] != 0;
    all = all && away[v] != 0;
  });
  return all ? Facing::kBack : any ? Facing::kSilhouette : Facing::kFront;
}

// A vertex is on the silhouette if a neighbour is on the other side.
template <class Surface>
Facing BasicDepthHeuristics<Surface>::vertex_facing(std::int32_t v,
                                                    std::span<const std::uint8_t> away) const {
  bool other = false;
  surface_.adjacency.for_each_neighbour(v, [&](std::int32_t w) { other = other || away[w] != away[v]; });
  return other ? Facing::kSilhouette : away[v] != 0 ? Facing::kBack : Facing::kFront;
}

template <class Surface>
std::vector<Facing> BasicDepthHeuristics<Surface>::facing(const Camera& camera) const {
  camera.validate();
  const std::vector<std::uint8_t> back = away(camera);
  std::vector<Facing> result(surface_.face_count());
  for_each_index(result.size(), [&](std::int32_t f) { result[f] = facing(f, back); });
  return result;
}

template <class Surface>
std::int32_t BasicDepthHeuristics<Surface>::project_sphere(std::int32_t face, const Camera& camera,
                                                           double focal_pixels, double target_pixels) const {
  const auto& [centroid, radius] = spheres_[face];
  const double distance = std::max(length(camera.eye - centroid) - radius, camera.near);
  double pixels = 2 * radius * focal_pixels / distance;
  std::int32_t level = 0;
  for (; level < max_depth_ && pixels > target_pixels; ++level) pixels /= 2;  // edges halve with each level
  return level;
}

template <class Surface>
void BasicDepthHeuristics<Surface>::make_room_for_cones() const {
  cones_.resize((static_cast<std::size_t>(max_depth_) + 1) * limit_.size());
  known_cones_.resize(limit_.size());
}

template <class Surface>
double BasicDepthHeuristics<Surface>::cone_cosine(std::int32_t v, int l) const {
  const std::lock_guard lock(cones_in_use_);
  make_room_for_cones();
  typename Surface::VertexRing ring;
  int ring_level = -1;
  return cone_cosine(v, l, ring, ring_level);
}

// `ring_level`: of the ring, if it is that of v; else -1.
template <class Surface>
double BasicDepthHeuristics<Surface>::cone_cosine(std::int32_t v, int l, typename Surface::VertexRing& ring,
                                                  int& ring_level) const {
  const auto levels = static_cast<std::size_t>(max_depth_) + 1;
  double* cosines = cones_.data() + levels * static_cast<std::size_t>(v);
  for (std::int8_t& known = known_cones_[v]; known <= l; ++known) {
    if (ring_level < 0) surface_.gather(ring, v), ring_level = 0;
    for (; ring_level < known; ++ring_level) ring.subdivide();
    cosines[known] = ring.cone_cosine(normal_[v]);
  }
  return cosines[l];
}

template <class Surface>
std::int32_t BasicDepthHeuristics<Surface>::cone_depth(std::int32_t v, double cos_angle) const {
  const std::lock_guard lock(cones_in_use_);
  make_room_for_cones();
  typename Surface::VertexRing ring;
  return cone_depth(v, cos_angle, ring);
}

template <class Surface>
std::int32_t BasicDepthHeuristics<Surface>::cone_depth(std::int32_t v, double cos_angle,
                                                       typename Surface::VertexRing& ring) const {
  std::int32_t level = 0;
  int ring_level = -1;
  while (level < max_depth_ && cone_cosine(v, level, ring, ring_level) < cos_angle) ++level;
  return level;
}

template <class Surface>
std::vector<std::int32_t> BasicDepthHeuristics<Surface>::depths(const DepthOptions& options,
                                                                const Camera& camera) const {
  const bool sphere = uses_sphere(options.strategy), cone = uses_cone(options.strategy),
             cull = options.culls();
  const bool uses_depth = options.strategy == Strategy::kUniform || options.strategy == Strategy::kRandom;
  if (uses_depth && (options.depth < 0 || options.depth > max_depth_)) {
    refuse(std::to_string(options.depth) + " is not in 0.." + std::to_string(max_depth_));
  }
  if (sphere && !(options.target_pixels > 0)) refuse("the target must be more than 0 pixels");
  if (options.strategy == Strategy::kCustom && !options.custom) refuse("the custom strategy has no function");
  if (sphere || cone || cull) camera.validate();
  const std::array<double, 3> cosines{checked_cosine(options.angle_front),
                                      checked_cosine(options.angle_silhouette),
                                      checked_cosine(options.angle_back)};

  std::vector<std::int32_t> result(surface_.face_count(), options.depth);
  if (options.strategy == Strategy::kRandom) {
    const std::uint64_t values = static_cast<std::uint64_t>(options.depth) + 1;
    for_each_index(result.size(), [&](std::int32_t f) {
      const std::uint64_t bits = mix(mix(options.seed) + static_cast<std::uint64_t>(f)) >> 32;
      result[f] = static_cast<std::int32_t>((bits * values) >> 32);
    });
  } else if (options.strategy == Strategy::kCustom) {
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(result.size()); ++f) {
      result[f] = std::clamp(options.custom(f), kCulled, static_cast<std::int32_t>(max_depth_));
    }
  }
  if (!sphere && !cone && !cull) return result;

  const std::vector<std::uint8_t> back = away(camera);
  std::vector<std::int32_t> vertex_depth;
  if (cone) {
    const std::lock_guard lock(cones_in_use_);
    make_room_for_cones();
    tbb::enumerable_thread_specific<typename Surface::VertexRing> rings;
    const bool one_angle = cosines[0] == cosines[1] && (cull || cosines[0] == cosines[2]);
    vertex_depth.resize(back.size());
    for_each_index(back.size(), [&](std::int32_t v) {
      if (cull && back[v] != 0) {
        vertex_depth[v] = kCulled;
        return;
      }
      const Facing vertex_class = one_angle ? Facing::kFront : vertex_facing(v, back);
      vertex_depth[v] = cone_depth(v, cosines[static_cast<std::size_t>(vertex_class)], rings.local());
    });
  }
  const double focal_pixels = sphere ? camera.focal_pixels() : 0;
  for_each_index(result.size(), [&](std::int32_t f) {
    if (cull && facing(f, back) == Facing::kBack) {
      result[f] = kCulled;
      return;
    }
    if (sphere) result[f] = project_sphere(f, camera, focal_pixels, options.target_pixels);
    if (cone) {
      std::int32_t corners = kCulled;
      surface_.for_each_corner(f, [&](std::int32_t v) { corners = std::max(corners, vertex_depth[v]); });
      result[f] = sphere ? std::max(result[f], corners) : corners;
    }
  });
  return result;
}

void check_depths(std::span<const std::int32_t> depth, int face_count, int max_depth) {
  if (depth.size() != static_cast<std::size_t>(face_count)) {
    refuse(std::to_string(depth.size()) + " depths for " + std::to_string(face_count) + " faces");
  }
  for (std::size_t f = 0; f < depth.size(); ++f) {
    if (depth[f] < kCulled || depth[f] > max_depth) {
      refuse("face " + std::to_string(f) + ": " + std::to_string(depth[f]) + " is not in -1.." +
             std::to_string(max_depth));
    }
  }
}

template class BasicDepthHeuristics<TriangleSurface>;
template class BasicDepthHeuristics<QuadSurface>;

}  // namespace limitcheck::fast
