// SPDX-License-Identifier: MIT
// OpenSubdiv Far's patches: the mesh refined where it is irregular (RefineAdaptive), a PatchTable made of
// what results, and the patch under each lattice point evaluated (PatchMap::FindPatch, EvaluateBasis). Beyond
// the level of isolation irregular faces are covered by end caps, which approximate.
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTable.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>

#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "verify/subject/opensubdiv_faces.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;
namespace Far = OpenSubdiv::Far;
using Patches = Far::PatchTableFactory;

template <class Real>
using Vector = OpenSubdivVector<Real>;

// The patches over one face after another.
template <class Real>
class FacePatches {
 public:
  FacePatches(const Far::PatchTable& table, const Far::PatchMap& map, const std::vector<Vector<Real>>& points)
      : table_(table), map_(map), points_(points) {}

  void begin(std::int32_t face) { face_ = face; }
  void evaluate(const Real* uv, Real* position, Real* du, Real* dv) const {
    const auto* patch = map_.FindPatch(face_, static_cast<double>(uv[0]), static_cast<double>(uv[1]));
    if (patch == nullptr) throw SubjectError(LC_FAILED, "Far has no patch on face " + std::to_string(face_));
    constexpr std::size_t kMost = 20;  // control points of a patch
    std::array<Real, kMost> w{}, wu{}, wv{};
    table_.EvaluateBasis(*patch, uv[0], uv[1], w.data(), wu.data(), wv.data());
    const auto control = table_.GetPatchVertices(*patch);
    for (std::size_t c = 0; c < 3; ++c) position[c] = du[c] = dv[c] = 0;
    for (int k = 0; k < control.size(); ++k) {
      const auto& p = points_[control[k]].x;
      const auto weight = static_cast<std::size_t>(k);
      for (std::size_t c = 0; c < 3; ++c) {
        position[c] += w[weight] * p[c];
        du[c] += wu[weight] * p[c];
        dv[c] += wv[weight] * p[c];
      }
    }
  }

 private:
  const Far::PatchTable& table_;
  const Far::PatchMap& map_;
  const std::vector<Vector<Real>>& points_;
  std::int32_t face_ = 0;
};

class FarPatchesSubject {
 public:
  static lc_capabilities capabilities(Options& options) {
    const Settings s = settings(options);
    return {
        s.wide ? LC_FLOAT64 : LC_FLOAT32, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 10, 1, 1, 0};
  }

  FarPatchesSubject(const lc_mesh& mesh, Options& options)
      : mesh_(mesh), wide_(settings(options).wide), refiner_(make_refiner(mesh)) {
    const Settings s = settings(options);
    const OpenSubdivErrors errors;
    Patches::Options patches(static_cast<unsigned>(s.level));
    patches.SetEndCapType(s.bspline ? Patches::Options::ENDCAP_BSPLINE_BASIS
                                    : Patches::Options::ENDCAP_GREGORY_BASIS);
    // By default a boundary vertex of one face gets the patch of a sharp corner, which is another surface.
    patches.generateLegacySharpCornerPatches = s.legacy_corners;
    wide_ ? patches.SetPatchPrecision<double>() : patches.SetPatchPrecision<float>();
    refiner_->RefineAdaptive(patches.GetRefineAdaptiveOptions());
    table_.reset(Patches::Create(*refiner_, patches));
    errors.check();
    if (table_ == nullptr) throw SubjectError(LC_FAILED, "OpenSubdiv makes no patches of this mesh");
    map_ = std::make_unique<Far::PatchMap>(*table_);
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    wide_ ? run<double>(request, out) : run<float>(request, out);
  }

 private:
  struct Settings {
    bool wide, bspline, legacy_corners;
    int level;
  };
  static Settings settings(Options& options) {
    const bool wide = options.choice("precision", {"float", "double"}) == 1;
    const bool bspline = options.choice("end-cap", {"gregory", "bspline"}) == 1;
    const bool legacy_corners = options.choice("corners", {"legacy", "smooth"}) == 0;
    return {wide, bspline, legacy_corners, options.integer("level", 2, 1, 10)};
  }

  template <class Real>
  void run(const lc_request& request, lc_tessellation& out) const {
    // The points of all levels, then those of the end caps.
    const auto refined = static_cast<std::size_t>(refiner_->GetNumVerticesTotal());
    std::vector<Vector<Real>> points(refined + static_cast<std::size_t>(table_->GetNumLocalPoints()));
    for (std::size_t v = 0; v < static_cast<std::size_t>(mesh_.vertex_count); ++v) {
      for (std::size_t c = 0; c < 3; ++c) points[v].x[c] = static_cast<Real>(mesh_.positions[3 * v + c]);
    }
    const Far::PrimvarRefinerReal<Real> primvars(*refiner_);
    const Vector<Real>* from = points.data();
    for (int level = 1; level <= refiner_->GetMaxLevel(); ++level) {
      Vector<Real>* to =
          points.data() + (from - points.data()) + refiner_->GetLevel(level - 1).GetNumVertices();
      primvars.Interpolate(level, from, to);
      from = to;
    }
    if (table_->GetNumLocalPoints() > 0)
      table_->GetLocalPointStencilTable<Real>()->UpdateValues(points.data(), points.data() + refined);
    tessellate_faces<Real>(mesh_, request, out, [&] { return FacePatches<Real>(*table_, *map_, points); });
  }

  const lc_mesh mesh_;
  const bool wide_;
  std::unique_ptr<Far::TopologyRefiner> refiner_;
  std::unique_ptr<Far::PatchTable> table_;
  std::unique_ptr<Far::PatchMap> map_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_opensubdiv_far_patches() {
  static const lc_subject subject = make_subject<FarPatchesSubject>(
      "opensubdiv-far-patches", "OpenSubdiv 3.5 Far: adaptive refinement, then a PatchTable evaluated",
      "precision=float|double (default float), level=N of isolation (1 to 10, default 2), "
      "end-cap=gregory|bspline (default gregory), corners=legacy|smooth (default legacy, the library's)");
  return &subject;
}
