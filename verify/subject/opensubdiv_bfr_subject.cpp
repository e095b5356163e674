// SPDX-License-Identifier: MIT
// OpenSubdiv Bfr: each face by itself, its limit surface made (InitVertexSurface), its uniform Tessellation
// evaluated point by point, and forgotten: the streaming use, nearest to what the paper does. Faces share no
// vertices. The normal is d/du x d/dv as evaluated, NaN where the library's derivatives are parallel or zero.
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/bfr/tessellation.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <vector>

#include "verify/subject/faces_in_parallel.h"
#include "verify/subject/opensubdiv_mesh.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;
namespace Bfr = OpenSubdiv::Bfr;

using Cache = Bfr::SurfaceFactoryCacheThreaded<std::shared_mutex, std::shared_lock<std::shared_mutex>,
                                               std::unique_lock<std::shared_mutex>>;
using Factory = Bfr::RefinerSurfaceFactory<Cache>;

// The library's tessellation of a triangle at one depth.
template <class Real>
struct Pattern {
  explicit Pattern(int depth) : denominator(std::uint32_t{1} << depth) {
    const Bfr::Parameterization triangle(OpenSubdiv::Sdc::SCHEME_LOOP, 3);
    const Bfr::Tessellation tessellation(triangle, 1 << depth);
    coords.resize(2 * static_cast<std::size_t>(tessellation.GetNumCoords()));
    facets.resize(3 * static_cast<std::size_t>(tessellation.GetNumFacets()));
    tessellation.GetCoords(coords.data());
    tessellation.GetFacets(facets.data());
    // (u, v) is (l1, l2): the corners of the face are (0, 0), (1, 0), (0, 1).
    for (const Real coordinate : coords) {
      const Real scaled = coordinate * static_cast<Real>(denominator);
      lattice.push_back(static_cast<std::uint32_t>(std::lround(scaled)));
      if (static_cast<Real>(lattice.back()) != scaled)
        throw SubjectError(LC_FAILED, "Bfr leaves the dyadic lattice");
    }
  }
  std::uint32_t denominator;
  std::vector<Real> coords;            // u, v
  std::vector<std::uint32_t> lattice;  // i, j
  std::vector<int> facets;
};

class BfrSubject {
 public:
  static lc_capabilities capabilities(Options& options) {
    const bool wide = options.choice("precision", {"float", "double"}) == 1;
    (void)approx_level(options);
    return {
        wide ? LC_FLOAT64 : LC_FLOAT32, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 10, 1, 1, 0};
  }

  BfrSubject(const lc_mesh& mesh, Options& options)
      : mesh_(mesh), wide_(capabilities(options).precision == LC_FLOAT64), refiner_(make_refiner(mesh)) {
    Factory::Options level;
    if (const int given = approx_level(options); given >= 0)
      level.SetApproxLevelSmooth(given).SetApproxLevelSharp(given);
    factory_ = std::make_unique<Factory>(*refiner_, level);
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    wide_ ? run<double>(request, out) : run<float>(request, out);
  }

 private:
  // -1: as the library has it.
  static int approx_level(Options& options) { return options.integer("approx-level", -1, 0, 15); }

  template <class Real>
  void run(const lc_request& request, lc_tessellation& out) const {
    const auto faces = mesh_.triangle_count;
    std::map<int, Pattern<Real>> patterns;
    std::vector<std::int64_t> first_vertex(static_cast<std::size_t>(faces) + 1);
    std::vector<std::int64_t> first_triangle(static_cast<std::size_t>(faces) + 1);
    for (std::int64_t f = 0; f < faces; ++f) {
      const int depth = request.face_depth[f];
      const auto k = static_cast<std::size_t>(f);
      first_vertex[k + 1] = first_vertex[k];
      first_triangle[k + 1] = first_triangle[k];
      if (depth < 0) continue;
      const Pattern<Real>& pattern = patterns.try_emplace(depth, depth).first->second;
      first_vertex[k + 1] += static_cast<std::int64_t>(pattern.coords.size() / 2);
      first_triangle[k + 1] += static_cast<std::int64_t>(pattern.facets.size() / 3);
    }
    const auto output = allocate_output<Real>(request, out, first_vertex.back(), first_triangle.back(), true);
    const std::vector<Real> control(mesh_.positions, mesh_.positions + 3 * mesh_.vertex_count);

    faces_in_parallel(faces, request.threads, [&](std::int64_t begin, std::int64_t end) {
      Bfr::Surface<Real> surface;
      std::vector<Real> patch_points;
      for (std::int64_t f = begin; f < end; ++f) {
        if (request.face_depth[f] < 0) continue;
        const OpenSubdivErrors errors;
        if (!factory_->InitVertexSurface(static_cast<int>(f), &surface)) {
          throw SubjectError(LC_FAILED, "Bfr has no limit surface for face " + std::to_string(f));
        }
        errors.check();
        patch_points.resize(3 * static_cast<std::size_t>(surface.GetNumPatchPoints()));
        surface.PreparePatchPoints(control.data(), 3, patch_points.data(), 3);
        const auto k = static_cast<std::size_t>(f);
        write_face(static_cast<std::int32_t>(f), patterns.at(request.face_depth[f]), surface, patch_points,
                   output, first_vertex[k], first_triangle[k]);
      }
    });
  }

  template <class Real>
  static void write_face(std::int32_t face, const Pattern<Real>& pattern, const Bfr::Surface<Real>& surface,
                         const std::vector<Real>& patch_points, const Output<Real>& output,
                         std::int64_t vertex, std::int64_t triangle) {
    const auto first = static_cast<std::uint32_t>(vertex);
    for (std::size_t p = 0; p < pattern.coords.size(); p += 2, ++vertex) {
      Real du[3], dv[3];
      surface.Evaluate(&pattern.coords[p], patch_points.data(), 3, output.positions + 3 * vertex, du, dv);
      const Real n[3] = {du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2],
                         du[0] * dv[1] - du[1] * dv[0]};
      const Real length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      for (int c = 0; c < 3; ++c) output.normals[3 * vertex + c] = n[c] / length;
      output.provenance[vertex] = {face, pattern.lattice[p], pattern.lattice[p + 1], pattern.denominator};
    }
    for (std::size_t t = 0; t < pattern.facets.size(); t += 3, ++triangle) {
      for (std::size_t c = 0; c < 3; ++c) {
        output.triangles[3 * triangle + static_cast<std::int64_t>(c)] =
            first + static_cast<std::uint32_t>(pattern.facets[t + c]);
      }
      output.triangle_face[triangle] = face;
    }
  }

  const lc_mesh mesh_;
  const bool wide_;
  std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner_;
  std::unique_ptr<Factory> factory_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_opensubdiv_bfr() {
  static const lc_subject subject = make_subject<BfrSubject>(
      "opensubdiv-bfr", "OpenSubdiv 3.5 Bfr: the limit surface of each face, evaluated",
      "precision=float|double (default float), approx-level=N (default the library's, 2)");
  return &subject;
}
