// SPDX-License-Identifier: MIT
// Subjects from libraries that refine a mesh step by step and stop there, with no limit points and no normals; and where
// the vertices of a refined mesh lie on the control mesh, of which they keep no record.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "verify/subject/adapter.h"
#include "verify/subject/face_domain.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// Follows a mesh through steps of Loop's scheme, which split each triangle in four, or of Catmull and Clark's,
/// which split each face of n corners in n quads. All it relies on is that old vertices keep their numbers and
/// new ones are appended: a new vertex on an edge has exactly two old neighbours, the ends of the edge that it
/// divides; and two edges in a row, of which a new face has the middles, have one face between them. The
/// mesh need not be a manifold. No geometry.
class RefinementTracker {
 public:
  explicit RefinementTracker(const lc_mesh& control);

  /// One step to faces of N corners, 3 or 4.
  ///   vertex_count   after it
  ///   faces          after it, in any order, corners in any rotation
  /// O(faces). Throws SubjectError(LC_FAILED) if that is not a split of each face.
  template <std::size_t N>
  void step(std::int64_t vertex_count, const std::vector<std::array<std::uint32_t, N>>& faces);

  /// Every face in triangles around its first corner, and the control face of each.
  std::vector<std::array<std::uint32_t, 3>> triangles() const;
  std::vector<std::int32_t> triangle_face() const;
  /// One place for each vertex: that by which the first or the last face that has it names it.
  enum class Namer { kFirst, kLast };
  std::vector<Place> places(Namer namer = Namer::kFirst) const;

 private:
  using Steps = std::array<std::uint32_t, 2>;  // in units of 1 / denominator
  struct Face {
    std::int32_t control, part;
    std::uint32_t denominator;
    std::vector<std::uint32_t> corners;
    std::vector<Steps> at;  // of a control face that is cut into quads: of each corner on its own part
  };
  struct Parent {
    const Face& face;
    std::size_t corner;
  };
  class Step;

  bool quads_;
  std::int64_t vertex_count_;
  std::vector<Face> faces_;
};

/// LoopMesh and QuadMesh are the library's mesh behind
///   T(const lc_mesh&)                               throws SubjectError if the library refuses it
///   void refine()                                   one step
///   std::int64_t vertex_count() const
///   std::array<double, 3> position(std::int64_t) const
///   std::vector<std::array<std::uint32_t, N>> faces() const    after a step: N is 3 or 4
/// the one refined by Loop's scheme, the other, void if there is none, by Catmull-Clark's. Real is the
/// number type the library keeps its points in.
template <class LoopMesh, class QuadMesh, class Real = double>
class RefiningSubject {
  static constexpr bool kQuads = !std::is_void_v<QuadMesh>;

 public:
  static constexpr std::int32_t kSchemes = LC_DOES_LOOP | (kQuads ? LC_DOES_CATMULL_CLARK : 0);

  static lc_capabilities capabilities(Options&, lc_scheme) {
    constexpr auto precision = std::is_same_v<Real, float> ? LC_FLOAT32 : LC_FLOAT64;
    return {precision, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_REFINED, 8, 0, 0, 1};
  }

  RefiningSubject(const lc_mesh& mesh, Options&) : control_(mesh) {
    if constexpr (kQuads)
      if (mesh.scheme == LC_SCHEME_CATMULL_CLARK) {
        (void)QuadMesh(mesh);
        return;
      }
    (void)LoopMesh(mesh);
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    refuse_too_many_triangles(control_, uniform_depth(request, control_));
    if constexpr (kQuads)
      if (control_.scheme == LC_SCHEME_CATMULL_CLARK) return run<QuadMesh>(request, out);
    run<LoopMesh>(request, out);
  }

 private:
  template <class Mesh>
  void run(const lc_request& request, lc_tessellation& out) const {
    Mesh mesh(control_);
    RefinementTracker tracker(control_);
    for (int level = 0; level < uniform_depth(request, control_); ++level) {
      mesh.refine();
      tracker.step(mesh.vertex_count(), mesh.faces());
    }
    DeliveredArrays all;
    for (const Place& p : tracker.places()) {
      all.positions.push_back(mesh.position(std::ssize(all.positions)));
      all.provenance.push_back({p.face, p.i, p.j, p.denominator});
      all.corner.push_back(p.corner);
    }
    all.triangles = tracker.triangles();
    all.triangle_face = tracker.triangle_face();
    all.hand_over<Real>(request, out, /*with_normals=*/false,
                        /*with_corners=*/control_.scheme == LC_SCHEME_CATMULL_CLARK);
  }

  const lc_mesh control_;
};

}  // namespace limitcheck::verify
