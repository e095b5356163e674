// SPDX-License-Identifier: MIT
#include "fast/plan/depth.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <numbers>
#include <string>
#include <utility>

#include "data/error.h"
#include "data/splitmix64.h"
#include "fast/plan/quad_depth.h"
#include "fast/rules/ring.h"

namespace limitcheck::fast {

namespace {

constexpr std::array<std::pair<Strategy, std::string_view>, 6> kNames{
    {{Strategy::kUniform, "uniform"},
     {Strategy::kRandom, "random"},
     {Strategy::kProjectSphere, "project-sphere"},
     {Strategy::kCurvature, "curvature"},
     {Strategy::kCombined, "combined"},
     {Strategy::kCustom, "custom"}}};

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
void for_each_index(std::size_t count, const Body& body) {
  constexpr std::size_t kGrain = 512;
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) body(static_cast<std::int32_t>(i));
    });
  });
}

}  // namespace

void TriangleSurface::gather(Ring& ring, std::int32_t v) const {
  ring.gather(mesh, adjacency, v, kinds[v]);
}

std::string_view name(Strategy strategy) {
  for (const auto& [value, text] : kNames) {
    if (value == strategy) return text;
  }
  return "?";
}

Strategy parse_strategy(std::string_view text) {
  std::string all;
  for (const auto& [value, known] : kNames) {
    if (text == known) return value;
    all += all.empty() ? "" : ", ";
    all += known;
  }
  refuse("unknown strategy '" + std::string(text) + "'; known: " + all);
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
  const std::size_t vertices = surface_.vertex_count();
  limit_.resize(vertices);
  normal_.resize(vertices);
  std::atomic<std::int64_t> degenerate_count{0};
  tbb::enumerable_thread_specific<typename Surface::VertexRing> rings;
  for_each_index(vertices, [&](std::int32_t v) {
    auto& ring = rings.local();
    surface_.gather(ring, v);
    bool degenerate = false;
    limit_[v] = ring.limit_position();
    normal_[v] = ring.limit_normal(&degenerate);
    if (degenerate && ring.faces() > 0) ++degenerate_count;
  });
  degenerate_normals_ = degenerate_count;
  spheres_.resize(surface_.face_count());
  for_each_index(spheres_.size(), [&](std::int32_t f) {
    Point3 sum{};
    int corners = 0;
    surface_.for_each_corner(f, [&](std::int32_t v) { sum = sum + surface_.position(v), ++corners; });
    const Point3 centroid = (1. / corners) * sum;
    double radius = 0;
    surface_.for_each_corner(
        f, [&](std::int32_t v) { radius = std::max(radius, length(surface_.position(v) - centroid)); });
    spheres_[f] = {centroid, radius};
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
  if (surface_.any_neighbour(v, [&](std::int32_t w) { return away[w] != away[v]; }))
    return Facing::kSilhouette;
  return away[v] != 0 ? Facing::kBack : Facing::kFront;
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
                                                           double target_pixels) const {
  return project_sphere(face, camera, camera.focal_pixels(), target_pixels);
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

// The cosines do not depend on the view: one pass over the vertices serves every frame and every angle.
template <class Surface>
void BasicDepthHeuristics<Surface>::prepare_cones() const {
  std::call_once(cones_ready_, [&] {
    const auto levels = static_cast<std::size_t>(max_depth_) + 1;
    cones_.resize(limit_.size() * levels);
    tbb::enumerable_thread_specific<typename Surface::VertexRing> rings;
    for_each_index(limit_.size(), [&](std::int32_t v) {
      auto& ring = rings.local();
      surface_.gather(ring, v);
      for (std::size_t l = 0; l < levels; ++l) {
        if (l > 0) ring.subdivide();
        cones_[static_cast<std::size_t>(v) * levels + l] = ring.cone_cosine(normal_[v]);
      }
    });
  });
}

template <class Surface>
double BasicDepthHeuristics<Surface>::cone_cosine(std::int32_t v, int l) const {
  prepare_cones();
  return cones_[static_cast<std::size_t>(v) * (static_cast<std::size_t>(max_depth_) + 1) +
                static_cast<std::size_t>(l)];
}

template <class Surface>
std::int32_t BasicDepthHeuristics<Surface>::cone_depth(std::int32_t v, double cos_angle) const {
  std::int32_t level = 0;
  while (level < max_depth_ && cone_cosine(v, level) < cos_angle) ++level;
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
    prepare_cones();
    const bool one_angle = cosines[0] == cosines[1] && (cull || cosines[0] == cosines[2]);
    vertex_depth.resize(back.size());
    for_each_index(back.size(), [&](std::int32_t v) {
      if (cull && back[v] != 0) {
        vertex_depth[v] = kCulled;
        return;
      }
      const Facing vertex_class = one_angle ? Facing::kFront : vertex_facing(v, back);
      vertex_depth[v] = cone_depth(v, cosines[static_cast<std::size_t>(vertex_class)]);
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
