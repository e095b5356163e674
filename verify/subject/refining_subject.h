// SPDX-License-Identifier: MIT
// A subject from a library that refines a mesh step by step and stops there: no limit points, no normals.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "verify/subject/adapter.h"
#include "verify/subject/lattice_tracker.h"

namespace limitcheck::verify {

/// T is the library's mesh behind
///   T(const lc_mesh&)                               throws SubjectError if the library refuses it
///   void refine()                                   one step
///   std::int64_t vertex_count() const
///   std::array<double, 3> position(std::int64_t) const
///   std::vector<std::array<std::uint32_t, 3>> triangles() const
/// Real is the number type it keeps its points in.
template <class T, class Real = double>
class RefiningSubject {
 public:
  static lc_capabilities capabilities(Options&) {
    constexpr auto precision = std::is_same_v<Real, float> ? LC_FLOAT32 : LC_FLOAT64;
    return {precision, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_REFINED, 8, 0, 0, 1};
  }

  RefiningSubject(const lc_mesh& mesh, Options&) : control_(mesh) { (void)T(mesh); }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const int depth = uniform_depth(request, control_);
    refuse_too_many_triangles(control_, depth);
    T mesh(control_);
    LatticeTracker tracker(control_);
    for (int level = 0; level < depth; ++level) {
      mesh.refine();
      tracker.step(mesh.vertex_count(), mesh.triangles());
    }
    const auto triangle_count = static_cast<std::int64_t>(tracker.triangles().size());
    const auto output = allocate_output<Real>(request, out, tracker.vertex_count(), triangle_count, false);
    for (std::int64_t v = 0; v < tracker.vertex_count(); ++v) {
      const auto p = mesh.position(v);
      for (std::size_t c = 0; c < 3; ++c)
        output.positions[3 * static_cast<std::size_t>(v) + c] = static_cast<Real>(p[c]);
    }
    const auto provenance = tracker.provenance();
    std::copy(provenance.begin(), provenance.end(), output.provenance);
    for (std::int64_t t = 0; t < triangle_count; ++t) {
      const auto& corners = tracker.triangles()[t];
      std::copy(corners.begin(), corners.end(), output.triangles + 3 * t);
      output.triangle_face[t] = tracker.triangle_face()[t];
    }
  }

 private:
  const lc_mesh control_;
};

}  // namespace limitcheck::verify
