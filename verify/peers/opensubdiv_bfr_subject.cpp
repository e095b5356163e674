// SPDX-License-Identifier: MIT
// OpenSubdiv Bfr: each face by itself, its limit surface made (InitVertexSurface), evaluated point by
// point, and forgotten: the streaming use, nearest to what the paper does. The points are those of the
// library's uniform Tessellation of a triangle; on Catmull-Clark's faces ours, because the library's of a
// pentagon are not those of its refinement.
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

#include <memory>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <vector>

#include "verify/peers/opensubdiv_mesh.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;
namespace Bfr = OpenSubdiv::Bfr;

using Cache = Bfr::SurfaceFactoryCacheThreaded<std::shared_mutex, std::shared_lock<std::shared_mutex>,
                                               std::unique_lock<std::shared_mutex>>;
using Factory = Bfr::RefinerSurfaceFactory<Cache>;

// The surface of one face after another.
template <class Real>
class FaceSurface {
 public:
  FaceSurface(const Factory& factory, const std::vector<Real>& control)
      : factory_(factory), control_(control) {}

  void begin(std::int32_t face) {
    const OpenSubdivErrors errors;
    if (!factory_.InitVertexSurface(face, &surface_))
      throw SubjectError(LC_NOT_SUPPORTED, "Bfr has no limit surface for face " + std::to_string(face));
    errors.check();
    points_.resize(3 * static_cast<std::size_t>(surface_.GetNumPatchPoints()));
    surface_.PreparePatchPoints(control_.data(), 3, points_.data(), 3);
  }
  // Catmull-Clark's faces of other sizes than four have the parts as sub-faces, turned as ours.
  void evaluate(std::int32_t part, const Real* uv, Real* position, Real* du, Real* dv) const {
    const Bfr::Parameterization face = surface_.GetParameterization();
    Real of_face[2] = {uv[0], uv[1]};
    if (face.HasSubFaces()) face.ConvertNormalizedSubFaceToCoord(part, uv, of_face);
    surface_.Evaluate(of_face, points_.data(), 3, position, du, dv);
  }

 private:
  const Factory& factory_;
  const std::vector<Real>& control_;
  Bfr::Surface<Real> surface_;
  std::vector<Real> points_;
};

class BfrSubject {
 public:
  static constexpr std::int32_t kSharp = kOpenSubdivSharp;

  static lc_capabilities capabilities(Options& options, lc_scheme) {
    const bool wide = options.choice("precision", {"float", "double"}) == 1;
    (void)approx_level(options);
    return {
        wide ? LC_FLOAT64 : LC_FLOAT32, LC_WEIGHTS_LOOP, boundary_of(options), LC_POINTS_LIMIT, 10, 1, 1, 0};
  }

  BfrSubject(const lc_mesh& mesh, Options& options)
      : mesh_(mesh),
        wide_(capabilities(options, mesh.scheme).precision == LC_FLOAT64),
        refiner_(make_refiner(mesh, opensubdiv_scheme(mesh), boundary_rule(mesh, options))) {
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
    const std::vector<Real> control(mesh_.positions, mesh_.positions + 3 * mesh_.vertex_count);
    const FacePatterns patterns(mesh_, request, opensubdiv_triangle);
    tessellate_faces<Real>(mesh_, patterns, request, out,
                           [&] { return FaceSurface<Real>(*factory_, control); });
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
      "precision=float|double (default float), approx-level=N (default the library's, 2), "
      "boundary=edge|none (default edge; none is the library's: closed meshes only)");
  return &subject;
}
