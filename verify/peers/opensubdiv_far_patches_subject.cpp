// SPDX-License-Identifier: MIT
// OpenSubdiv Far's patches: the mesh refined where it is irregular (RefineAdaptive), a PatchTable made of
// what results, and the patch under each lattice point evaluated (PatchMap::FindPatch, EvaluateBasis). Beyond
// the level of isolation irregular faces are covered by end caps, which approximate. Or stencils made of the
// same patches (LimitStencilTable), which are applied to the control mesh.
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTable.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/ptexIndices.h>
#include <opensubdiv/far/stencilTableFactory.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "verify/peers/opensubdiv_mesh.h"
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
  FacePatches(const Far::PatchTable& table, const Far::PatchMap& map, const Far::PtexIndices& ptex,
              const std::vector<Vector<Real>>& points)
      : table_(table), map_(map), ptex_(ptex), points_(points) {}

  void begin(std::int32_t face) { face_ = face; }
  // The parts of a face are its ptex faces.
  void evaluate(std::int32_t part, const Real* uv, Real* position, Real* du, Real* dv) const {
    const auto* patch =
        map_.FindPatch(ptex_.GetFaceId(face_) + part, static_cast<double>(uv[0]), static_cast<double>(uv[1]));
    if (patch == nullptr)
      throw SubjectError(LC_NOT_SUPPORTED, "Far has no patch on face " + std::to_string(face_));
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
  const Far::PtexIndices& ptex_;
  const std::vector<Vector<Real>>& points_;
  std::int32_t face_ = 0;
};

// What the stencils of all points give, handed out in their order.
template <class Real>
class StencilPoints {
 public:
  StencilPoints(const Far::TopologyRefiner& refiner, const Far::PatchTable& table,
                const Far::PtexIndices& ptex, const std::vector<Vector<Real>>& control,
                const FacePatterns& patterns)
      : patterns_(patterns) {
    using Factory = Far::LimitStencilTableFactoryReal<Real>;
    // One location for each point: the table orders its stencils as it is given them, ptex face by ptex face.
    const auto count = static_cast<std::size_t>(patterns.vertices());
    std::vector<Real> s(count), t(count);
    typename Factory::LocationArrayVec locations;
    std::size_t at = 0;
    for (std::int64_t f = 0; f < patterns.faces(); ++f) {
      const FacePattern* const pattern = patterns.of(f).pattern;
      if (pattern == nullptr) continue;
      for (const FaceDomain::Point& p : pattern->points) {
        s[at] = static_cast<Real>(p.i) / static_cast<Real>(pattern->denominator);
        t[at] = static_cast<Real>(p.j) / static_cast<Real>(pattern->denominator);
        auto& location = locations.emplace_back();
        location.ptexIdx = ptex.GetFaceId(static_cast<int>(f)) + p.part;
        location.numLocations = 1;
        location.s = &s[at];
        location.t = &t[at++];
      }
    }
    const OpenSubdivErrors errors;
    const std::unique_ptr<const Far::LimitStencilTableReal<Real>> stencils(
        Factory::Create(refiner, locations, nullptr, &table));
    errors.check();
    // It leaves out, without a word, locations that no patch covers.
    if (stencils == nullptr || static_cast<std::size_t>(stencils->GetNumStencils()) != count)
      throw SubjectError(LC_NOT_SUPPORTED, "Far makes no limit stencil of some points of this mesh");
    position_.resize(count), du_.resize(count), dv_.resize(count);
    stencils->UpdateValues(control.data(), position_.data());
    stencils->UpdateDerivs(control.data(), du_.data(), dv_.data());
  }

  // Where the points of one face after another are read.
  class Reader {
   public:
    explicit Reader(const StencilPoints& points) : points_(points) {}
    void begin(std::int32_t face) {
      next_ = static_cast<std::size_t>(points_.patterns_.of(face).first_vertex);
    }
    void evaluate(std::int32_t, const Real*, Real* position, Real* du, Real* dv) {
      for (std::size_t c = 0; c < 3; ++c) {
        position[c] = points_.position_[next_].x[c];
        du[c] = points_.du_[next_].x[c];
        dv[c] = points_.dv_[next_].x[c];
      }
      ++next_;
    }

   private:
    const StencilPoints& points_;
    std::size_t next_ = 0;
  };

 private:
  const FacePatterns& patterns_;
  std::vector<Vector<Real>> position_, du_, dv_;
};

class FarPatchesSubject {
 public:
  static constexpr std::int32_t kSharp = kOpenSubdivSharp;

  static lc_capabilities capabilities(Options& options, lc_scheme) {
    const auto precision = Settings(options).wide ? LC_FLOAT64 : LC_FLOAT32;
    return {precision, LC_WEIGHTS_LOOP, boundary_of(options), LC_POINTS_LIMIT, 10, 1, 1, 0};
  }

  FarPatchesSubject(const lc_mesh& mesh, Options& options)
      : mesh_(mesh),
        settings_(options),
        refiner_(make_refiner(mesh, opensubdiv_scheme(mesh), boundary_rule(mesh, options))) {
    const Settings& s = settings_;
    const OpenSubdivErrors errors;
    Patches::Options patches(static_cast<unsigned>(s.level));
    patches.SetEndCapType(s.bspline ? Patches::Options::ENDCAP_BSPLINE_BASIS
                                    : Patches::Options::ENDCAP_GREGORY_BASIS);
    // By default a boundary vertex of one face gets the patch of a sharp corner, which is another surface.
    patches.generateLegacySharpCornerPatches = s.legacy_corners;
    patches.useInfSharpPatch = s.infinite_creases;
    patches.useSingleCreasePatch = s.single_crease;
    s.wide ? patches.SetPatchPrecision<double>() : patches.SetPatchPrecision<float>();
    refiner_->RefineAdaptive(patches.GetRefineAdaptiveOptions());
    table_.reset(Patches::Create(*refiner_, patches));
    errors.check();
    if (table_ == nullptr) throw SubjectError(LC_FAILED, "OpenSubdiv makes no patches of this mesh");
    map_ = std::make_unique<Far::PatchMap>(*table_);
    ptex_ = std::make_unique<Far::PtexIndices>(*refiner_);
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    settings_.wide ? run<double>(request, out) : run<float>(request, out);
  }

 private:
  struct Settings {
    explicit Settings(Options& options)
        : wide(options.choice("precision", {"float", "double"}) == 1),
          bspline(options.choice("end-cap", {"gregory", "bspline"}) == 1),
          legacy_corners(options.choice("corners", {"legacy", "smooth"}) == 0),
          stencils(options.choice("evaluate", {"patches", "limit-stencils"}) == 1),
          infinite_creases(options.choice("inf-sharp", {"off", "on"}) == 1),
          single_crease(options.choice("single-crease", {"off", "on"}) == 1),
          level(options.integer("level", 2, 1, 10)) {}
    bool wide, bspline, legacy_corners, stencils, infinite_creases, single_crease;
    int level;
  };

  template <class Real>
  void run(const lc_request& request, lc_tessellation& out) const {
    const FacePatterns patterns(mesh_, request, opensubdiv_triangle);
    // The points of all levels, then those of the end caps.
    const auto refined = static_cast<std::size_t>(refiner_->GetNumVerticesTotal());
    std::vector<Vector<Real>> points(refined + static_cast<std::size_t>(table_->GetNumLocalPoints()));
    for (std::size_t v = 0; v < static_cast<std::size_t>(mesh_.vertex_count); ++v) {
      for (std::size_t c = 0; c < 3; ++c) points[v].x[c] = static_cast<Real>(mesh_.positions[3 * v + c]);
    }
    if (settings_.stencils) {
      const StencilPoints<Real> made(*refiner_, *table_, *ptex_, points, patterns);
      tessellate_faces<Real>(mesh_, patterns, request, out,
                             [&] { return typename StencilPoints<Real>::Reader(made); });
      return;
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
    tessellate_faces<Real>(mesh_, patterns, request, out,
                           [&] { return FacePatches<Real>(*table_, *map_, *ptex_, points); });
  }

  const lc_mesh mesh_;
  const Settings settings_;
  std::unique_ptr<Far::TopologyRefiner> refiner_;
  std::unique_ptr<Far::PatchTable> table_;
  std::unique_ptr<Far::PatchMap> map_;
  std::unique_ptr<Far::PtexIndices> ptex_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_opensubdiv_far_patches() {
  static const lc_subject subject = make_subject<FarPatchesSubject>(
      "opensubdiv-far-patches", "OpenSubdiv 3.5 Far: adaptive refinement, then a PatchTable evaluated",
      "precision=float|double (default float), level=N of isolation (1 to 10, default 2), "
      "end-cap=gregory|bspline (default gregory), corners=legacy|smooth (default legacy, the library's), "
      "evaluate=patches|limit-stencils (default patches), inf-sharp=on|off and single-crease=on|off: patches "
      "for edges that stay sharp and for creases of one sharpness (default off, the library's), "
      "boundary=edge|none (default edge; none is the library's: closed meshes only)");
  return &subject;
}
