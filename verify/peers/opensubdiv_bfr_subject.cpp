// SPDX-License-Identifier: MIT
// OpenSubdiv Bfr: each face by itself, its limit surface made (InitVertexSurface, for channels
// InitFaceVaryingSurface), evaluated point by point, and forgotten: the streaming use, nearest to what the
// paper does. The points are those of the library's uniform Tessellation of a triangle; on Catmull-Clark's
// faces ours, because the library's of a pentagon are not those of its refinement.
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

#include <array>
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
  // Points or values of the control mesh, and their coordinates.
  struct Control {
    const Factory& factory;
    int size;
    std::vector<Real> values;
  };

  //   control   of the mesh, and of each channel
  explicit FaceSurface(const std::vector<Control>& control)
      : control_(control), surfaces_(control.size()), points_(control.size()) {}

  void begin(std::int32_t face) {
    const OpenSubdivErrors errors;
    for (std::size_t k = 0; k < control_.size(); ++k) {
      Bfr::Surface<Real>& surface = surfaces_[k];
      if (!(k == 0 ? control_[k].factory.InitVertexSurface(face, &surface)
                   : control_[k].factory.InitFaceVaryingSurface(face, &surface, 0)))
        throw SubjectError(LC_NOT_SUPPORTED, "Bfr has no limit surface for face " + std::to_string(face));
      errors.check();
      const int size = control_[k].size;
      points_[k].resize(static_cast<std::size_t>(size) *
                        static_cast<std::size_t>(surface.GetNumPatchPoints()));
      surface.PreparePatchPoints(control_[k].values.data(), size, points_[k].data(), size);
    }
  }
  // Catmull-Clark's faces of other sizes than four have the parts as sub-faces, turned as ours.
  void evaluate(std::int32_t part, const Real* uv, Real* position, Real* du, Real* dv) const {
    surfaces_[0].Evaluate(at(part, uv).data(), points_[0].data(), 3, position, du, dv);
  }
  void channel(std::size_t c, std::int32_t part, const Real* uv, Real* value) const {
    surfaces_[c + 1].Evaluate(at(part, uv).data(), points_[c + 1].data(), control_[c + 1].size, value);
  }

 private:
  std::array<Real, 2> at(std::int32_t part, const Real* uv) const {
    const Bfr::Parameterization face = surfaces_[0].GetParameterization();
    std::array<Real, 2> of_face{uv[0], uv[1]};
    if (face.HasSubFaces()) face.ConvertNormalizedSubFaceToCoord(part, uv, of_face.data());
    return of_face;
  }

  const std::vector<Control>& control_;
  std::vector<Bfr::Surface<Real>> surfaces_;
  std::vector<std::vector<Real>> points_;
};

class BfrSubject {
 public:
  static constexpr std::int32_t kSharp = kOpenSubdivSharp;

  static lc_capabilities capabilities(Options& options, lc_scheme) {
    const bool wide = options.choice("precision", {"float", "double"}) == 1;
    (void)approx_level(options);
    lc_capabilities result{
        wide ? LC_FLOAT64 : LC_FLOAT32, LC_WEIGHTS_LOOP, boundary_of(options), LC_POINTS_LIMIT, 10, 1, 1, 0};
    result.channel_rules = kAllChannelRules;
    return result;
  }

  BfrSubject(const lc_mesh& mesh, Options& options)
      : mesh_(mesh), wide_(capabilities(options, mesh.scheme).precision == LC_FLOAT64) {
    Factory::Options level;
    if (const int given = approx_level(options); given >= 0)
      level.SetApproxLevelSmooth(given).SetApproxLevelSharp(given);
    for (std::int64_t c = kNoChannel; c < mesh.channel_count; ++c) {
      refiners_.push_back(
          make_refiner(with_channel(mesh, c), opensubdiv_scheme(mesh), boundary_rule(mesh, options)));
      factories_.push_back(std::make_unique<Factory>(*refiners_.back(), level));
    }
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    wide_ ? run<double>(request, out) : run<float>(request, out);
  }

 private:
  // -1: as the library has it.
  static int approx_level(Options& options) { return options.integer("approx-level", -1, 0, 15); }

  template <class Real>
  void run(const lc_request& request, lc_tessellation& out) const {
    std::vector<typename FaceSurface<Real>::Control> control;
    control.push_back({*factories_[0], 3, {mesh_.positions, mesh_.positions + 3 * mesh_.vertex_count}});
    for (std::size_t k = 1; k < factories_.size(); ++k) {
      const lc_channel& c = mesh_.channels[k - 1];
      control.push_back({*factories_[k], c.components, {c.values, c.values + c.components * c.value_count}});
    }
    const FacePatterns patterns(mesh_, request, opensubdiv_triangle);
    tessellate_faces<Real>(mesh_, patterns, request, out, [&] { return FaceSurface<Real>(control); });
  }

  const lc_mesh mesh_;
  const bool wide_;
  // Of the surface, and of each channel.
  std::vector<std::unique_ptr<OpenSubdiv::Far::TopologyRefiner>> refiners_;
  std::vector<std::unique_ptr<Factory>> factories_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_opensubdiv_bfr() {
  static const lc_subject subject = make_subject<BfrSubject>(
      "opensubdiv-bfr", "OpenSubdiv 3.5 Bfr: the limit surface of each face, evaluated",
      "precision=float|double (default float), approx-level=N (default the library's, 2), "
      "boundary=edge|none (default edge; none is the library's: closed meshes only)");
  return &subject;
}
