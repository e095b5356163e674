// SPDX-License-Identifier: MIT
// OpenSubdiv Bfr: each face by itself, its limit surface made (InitVertexSurface), its uniform Tessellation
// evaluated point by point, and forgotten: the streaming use, nearest to what the paper does.
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

#include <memory>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <vector>

#include "verify/subject/opensubdiv_faces.h"
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
      throw SubjectError(LC_FAILED, "Bfr has no limit surface for face " + std::to_string(face));
    errors.check();
    points_.resize(3 * static_cast<std::size_t>(surface_.GetNumPatchPoints()));
    surface_.PreparePatchPoints(control_.data(), 3, points_.data(), 3);
  }
  void evaluate(const Real* uv, Real* position, Real* du, Real* dv) const {
    surface_.Evaluate(uv, points_.data(), 3, position, du, dv);
  }

 private:
  const Factory& factory_;
  const std::vector<Real>& control_;
  Bfr::Surface<Real> surface_;
  std::vector<Real> points_;
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
    const std::vector<Real> control(mesh_.positions, mesh_.positions + 3 * mesh_.vertex_count);
    tessellate_faces<Real>(mesh_, request, out, [&] { return FaceSurface<Real>(*factory_, control); });
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
