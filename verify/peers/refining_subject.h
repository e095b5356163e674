// SPDX-License-Identifier: MIT
// Subjects from libraries that refine a mesh step by step and stop there, with no limit points and no normals. They keep
// no record of where vertices lie on the control mesh: the host finds it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "verify/subject/adapter.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

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
    lc_capabilities result{precision, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_REFINED, 8, 0, 0, 1};
    result.no_provenance = 1;
    return result;
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
    const int depth = uniform_depth(request, control_);
    for (int level = 0; level < depth; ++level) mesh.refine();
    DeliveredArrays all;
    for (std::int64_t v = 0; v < mesh.vertex_count(); ++v) all.positions.push_back(mesh.position(v));
    const auto add_fan = [&all](const auto& corners) {
      for (std::size_t k = 2; k < corners.size(); ++k)
        all.triangles.push_back({static_cast<std::uint32_t>(corners[0]),
                                 static_cast<std::uint32_t>(corners[k - 1]),
                                 static_cast<std::uint32_t>(corners[k])});
    };
    const std::int32_t* corner = control_.corners;
    for (std::int64_t f = 0; depth == 0 && f < control_.face_count; corner += control_.face_sizes[f++])
      add_fan(std::span(corner, static_cast<std::size_t>(control_.face_sizes[f])));
    if (depth > 0)
      for (const auto& face : mesh.faces()) add_fan(face);
    all.hand_over<Real>(request, out, /*with_normals=*/false, /*with_corners=*/false);
  }

  const lc_mesh control_;
};

}  // namespace limitcheck::verify
