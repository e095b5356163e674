// SPDX-License-Identifier: MIT
// How deep each control face is subdivided, for which viewer: the heuristics of section 4.1. [mueller2000, 4.1;
// C22-C33, C82]
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <mutex>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "data/error.h"
#include "fast/mesh/adjacency.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/mesh/vec3.h"

namespace limitcheck::fast {

/// A perspective view.
struct Camera {
  Point3 eye{0, 0, 4};
  Point3 target{0, 0, 0};
  Point3 up{0, 1, 0};
  double field_of_view = 45;  // vertical, degrees, in (0, 180)
  int width = 1024;           // viewport, pixels
  int height = 768;
  double near = 0.01;  // nothing is taken to be nearer to the eye than this

  /// Pixels that a length of 1 at distance 1 covers: height / (2 tan(field_of_view / 2)).
  double focal_pixels() const { return height / (2 * std::tan(field_of_view * std::numbers::pi / 360)); }

  /// Throws data::ArgumentError and says which value makes no view: eye equal to target, up along the view,
  /// field of view outside (0, 180), a viewport without pixels, near not positive, anything not finite.
  void validate() const {
    const auto refuse = [](const char* what) { throw data::ArgumentError(std::string("camera: ") + what); };
    if (!is_finite(eye) || !is_finite(target) || !is_finite(up)) refuse("eye, target and up must be finite");
    if (eye == target) refuse("eye and target are the same point");
    if (length(cross(target - eye, up)) == 0) refuse("up points along the view");
    if (!(field_of_view > 0 && field_of_view < 180))
      refuse("the field of view must lie between 0 and 180 degrees");
    if (width <= 0 || height <= 0) refuse("the viewport has no pixels");
    if (!(near > 0) || !std::isfinite(near)) refuse("near must be positive");
  }
};

class Ring;

inline constexpr std::int32_t kCulled = -1;  // the depth of a face that is not displayed
inline constexpr int kDeepest = 10;  // the largest depth that may be asked for: 4^10 triangles per face

/// What decides how deep a face is subdivided.
enum class Strategy {
  kUniform,        // every face `depth`
  kRandom,         // 0 .. depth, independent of each other, from `seed`
  kProjectSphere,  // the size of the face's sphere on the screen, halved per level until it is at most
                   // `target_pixels`
  kCurvature,      // normal cone at the corners
  kCombined,       // the larger of project-sphere and curvature [C82]
  kCustom          // `custom(face)`
};

/// The name on the command line: uniform, random, project-sphere, curvature, combined, custom.
std::string_view name(Strategy strategy);

/// Where the corners of a face look: a corner with limit normal N and limit position L faces away if
/// N . (L - eye) >= 0. On the silhouette some corners face away and others do not.
enum class Facing : std::int8_t { kFront, kSilhouette, kBack };

/// A strategy and its parameters.
struct DepthOptions {
  Strategy strategy = Strategy::kCombined;
  int depth = 3;              // uniform; the largest of random
  std::uint64_t seed = 1;     // random
  double target_pixels = 60;  // project-sphere, > 0
  /// Largest angle between the limit normal at a corner and its facets around it, degrees, in (0, 180],
  /// by the class of the vertex: silhouette if it or a neighbour faces the eye and the other does not, else
  /// front or back. The last is used only if nothing is culled.
  double angle_front = 30, angle_silhouette = 30, angle_back = 30;
  /// Whether faces whose corners all face away get kCulled. Not set: project-sphere, curvature and combined
  /// cull, the others do not.
  std::optional<bool> cull;
  /// Called once per face in face order; what it returns is clamped to -1 .. max_depth.
  std::function<std::int32_t(std::int32_t face)> custom;

  bool culls() const;
};

/// Assigns depths to the faces of a mesh for one view after the other; what does not depend on the view is
/// computed once, when it is first needed. Runs in the caller's oneTBB arena; the result does not depend on the number of threads.
///   Surface   the control faces and the rings of their vertices, by scheme: see below
template <class Surface>
class BasicDepthHeuristics {
 public:
  /// `max_depth`: every depth is clamped to it. Throws data::ArgumentError if it is not in 0 .. kDeepest.
  explicit BasicDepthHeuristics(const Surface& surface, int max_depth = 5);

  int max_depth() const { return max_depth_; }

  /// Takes over the positions of the mesh, which have changed. Not while others ask for depths.
  void points_moved();

  /// One depth per face, -1 .. max_depth. Throws data::ArgumentError: a camera that makes no view (if the
  /// strategy or culling uses it), a target or angle outside its range, a depth outside 0 .. max_depth, an
  /// empty `custom`.
  std::vector<std::int32_t> depths(const DepthOptions& options, const Camera& camera) const;

  /// One class per face.
  std::vector<Facing> facing(const Camera& camera) const;

  /// The smallest cosine between the limit normal of vertex v and the normals of the facets round it after
  /// l subdivision steps.
  double cone_cosine(std::int32_t v, int l) const;
  /// The smallest l in 0 .. max_depth with cone_cosine(v, l) >= cos_angle; max_depth if there is none.
  /// [erratum 4; C27, decision in E: C28]
  std::int32_t cone_depth(std::int32_t v, double cos_angle) const;

  const Point3& limit_position(std::int32_t v) const { return limit_[v]; }
  const Point3& limit_normal(std::int32_t v) const { return normal_[v]; }
  /// The number of vertices whose limit normal is not determined by their ring's tangents. [D12]
  std::int64_t degenerate_normals() const { return degenerate_normals_; }

 private:
  bool faces_away(std::int32_t v, const Camera& camera) const;
  std::vector<std::uint8_t> away(const Camera& camera) const;
  Facing facing(std::int32_t face, std::span<const std::uint8_t> away) const;
  /// The smallest l in 0 .. max_depth with 2 r f / (distance 2^l) <= target_pixels, max_depth if there is
  /// none: r is the largest distance of a corner from the face's centroid, f is camera.focal_pixels(), and
  /// distance goes from the eye to the nearest point of that sphere and is at least camera.near. [decision in
  /// claims.md E; C25]
  std::int32_t project_sphere(std::int32_t face, const Camera& camera, double focal_pixels,
                              double target_pixels) const;
  Facing vertex_facing(std::int32_t v, std::span<const std::uint8_t> away) const;
  Point3 position(std::int32_t v) const { return to_point(surface_.positions()[v]); }
  void make_limits();
  void make_spheres();
  void make_room_for_cones() const;
  std::int32_t cone_depth(std::int32_t v, double cos_angle, typename Surface::VertexRing& ring) const;
  double cone_cosine(std::int32_t v, int l, typename Surface::VertexRing& ring, int& ring_level) const;

  Surface surface_;
  int max_depth_;
  struct Sphere {
    Point3 centre;
    double radius = 0;
  };
  std::vector<Point3> limit_, normal_;  // per vertex
  std::vector<Sphere> spheres_;         // per face, round the centroid
  std::int64_t degenerate_normals_ = 0;
  // Cosines do not depend on the view: each is computed when a frame first asks for it.
  mutable std::mutex cones_in_use_;
  mutable std::vector<double> cones_;             // max_depth + 1 per vertex: those of levels 0 .. max_depth
  mutable std::vector<std::int8_t> known_cones_;  // per vertex: of how many levels, from 0 on
};

/// Loop's control faces and rings.
struct TriangleSurface {
  using VertexRing = Ring;

  const data::ControlMesh& mesh;
  const Adjacency& adjacency;
  VertexKinds kinds = {};

  std::size_t face_count() const { return mesh.faces.size(); }
  std::span<const std::array<double, 3>> positions() const { return mesh.positions; }
  template <class Visit>
  void for_each_corner(std::int32_t f, Visit&& visit) const {
    for (int k = 0; k < 3; ++k) visit(adjacency.corner(f, k));
  }
  void gather(Ring& ring, std::int32_t v) const;
};

/// Of Loop's scheme. Keeps references to mesh, adjacency and kinds, which must outlive it. The mesh has a
/// position for each vertex of the adjacency.
class DepthHeuristics : public BasicDepthHeuristics<TriangleSurface> {
 public:
  DepthHeuristics(const data::ControlMesh& mesh, const Adjacency& adjacency, int max_depth = 5,
                  VertexKinds kinds = {})
      : BasicDepthHeuristics(TriangleSurface{mesh, adjacency, kinds}, max_depth) {}
  DepthHeuristics(data::ControlMesh&&, const Adjacency&, int = 5) = delete;
  DepthHeuristics(const data::ControlMesh&, Adjacency&&, int = 5) = delete;
};

extern template class BasicDepthHeuristics<TriangleSurface>;

/// Throws data::ArgumentError with the face if `depth` has not one entry in -1 .. max_depth per face.
void check_depths(std::span<const std::int32_t> depth, int face_count, int max_depth);

}  // namespace limitcheck::fast
