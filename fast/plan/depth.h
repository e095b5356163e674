// SPDX-License-Identifier: MIT
// How deep each control face is subdivided: the heuristics of section 4.1.                [mueller2000, 4.1;
// C22-C33, C82]
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "fast/mesh/adjacency.h"
#include "fast/mesh/point3.h"
#include "fast/plan/camera.h"

namespace limitcheck::fast {

inline constexpr std::int32_t kCulled = -1;  // the depth of a face that is not displayed
inline constexpr int kDeepest = 10;  // the largest depth that may be asked for: 4^10 triangles per face

/// What decides how deep a face is subdivided.
enum class Strategy {
  kUniform,        // every face `depth`
  kRandom,         // 0 .. depth, independent of each other, from `seed`
  kProjectSphere,  // size of the face's sphere on the screen, halved per level until it is at most
                   // `target_pixels`
  kCurvature,      // normal cone at the three corners
  kCombined,       // the larger of project-sphere and curvature                                       [C82]
  kCustom          // `custom(face)`
};

/// The name on the command line: uniform, random, project-sphere, curvature, combined, custom.
std::string_view name(Strategy strategy);
/// Throws data::ArgumentError and lists the names.
Strategy parse_strategy(std::string_view text);

/// By the limit normals N and limit positions L of the three
/// corners; a corner faces away if N . (L - eye) >= 0.
enum class Facing : std::int8_t { kFront, kSilhouette, kBack };

/// A strategy and its parameters.
struct DepthOptions {
  Strategy strategy = Strategy::kCombined;
  int depth = 3;              // uniform; the largest of random
  std::uint64_t seed = 1;     // random
  double target_pixels = 60;  // project-sphere, > 0
  /// Largest angle between the limit normal at a corner and its incident sub-triangles, degrees, in (0, 180],
  /// by the class of the vertex: silhouette if it or a neighbour faces the eye and the other does not, else
  /// front or back. The last is used only if nothing is culled.
  double angle_front = 30, angle_silhouette = 30, angle_back = 30;
  /// Whether faces whose three corners face away get kCulled. Not set: project-sphere, curvature and combined
  /// cull, the others do not.
  std::optional<bool> cull;
  /// Called once per face in face order; what it returns is clamped to -1 .. max_depth.
  std::function<std::int32_t(std::int32_t face)> custom;

  bool culls() const;
};

/// The view-independent part, computed once per mesh, and the depths of one view. Refers to mesh and
/// adjacency, which must outlive it. Runs in the caller's oneTBB arena; the result does not depend on the
/// number of threads.
class DepthHeuristics {
 public:
  /// `max_depth`: every depth is clamped to it. Throws data::ArgumentError if it is not in 0 .. kDeepest.
  DepthHeuristics(const data::ControlMesh& mesh, const Adjacency& adjacency, int max_depth = 5);

  int max_depth() const { return max_depth_; }

  /// One depth per face, -1 .. max_depth. Throws data::ArgumentError: a camera that makes no view (if the
  /// strategy or culling uses it), a target or angle outside its range, a depth outside 0 .. max_depth, an
  /// empty `custom`.
  std::vector<std::int32_t> depths(const DepthOptions& options, const Camera& camera) const;

  /// One class per face.
  std::vector<Facing> facing(const Camera& camera) const;

  /// Smallest l in 0 .. max_depth with 2 r f / (distance 2^l) <= target_pixels: r the largest distance of a
  /// corner from the face's centroid, f camera.focal_pixels(), distance from the eye to the nearest point of
  /// that sphere, at least camera.near. [decision in claims.md E; C25]
  std::int32_t project_sphere(std::int32_t face, const Camera& camera, double target_pixels) const;

  /// The smallest cosine between the limit normal of vertex
  /// v and the triangles round it after l steps in place.
  double cone_cosine(std::int32_t v, int l) const;
  /// Smallest l in 0 .. max_depth at which all of them lie in the cone: cosine >= cos_angle; else max_depth.
  ///                                                                               [erratum 4; C27, decision
  ///                                                                               in E: C28]
  std::int32_t cone_depth(std::int32_t v, double cos_angle) const;

  const Point3& limit_position(std::int32_t v) const { return limit_[static_cast<std::size_t>(v)]; }
  const Point3& limit_normal(std::int32_t v) const { return normal_[static_cast<std::size_t>(v)]; }
  /// Vertices whose limit normal is not determined by their ring's tangents                            [D12].
  std::int64_t degenerate_normals() const { return degenerate_normals_; }

 private:
  bool faces_away(std::int32_t v, const Camera& camera) const;
  std::vector<std::uint8_t> away(const Camera& camera) const;
  Facing facing(std::int32_t face, std::span<const std::uint8_t> away) const;
  Facing vertex_facing(std::int32_t v, std::span<const std::uint8_t> away) const;
  void prepare_cones() const;

  const data::ControlMesh& mesh_;
  const Adjacency& adjacency_;
  int max_depth_;
  struct Sphere {
    Point3 centre;
    double radius = 0;
  };
  std::vector<Point3> limit_, normal_;  // per vertex
  std::vector<Sphere> spheres_;         // per face, round the centroid
  std::int64_t degenerate_normals_ = 0;
  mutable std::once_flag cones_ready_;
  mutable std::vector<double> cones_;  // max_depth + 1 per vertex: the cosines of levels 0 .. max_depth
};

/// Throws data::ArgumentError with the face if `depth` has not one entry in -1 .. max_depth per face.
void check_depths(std::span<const std::int32_t> depth, int face_count, int max_depth);

}  // namespace limitcheck::fast
