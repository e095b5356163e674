// SPDX-License-Identifier: MIT
// OpenSubdiv Far's patches: the mesh refined where it is irregular (RefineAdaptive), a PatchTable made of what
// results, and the patch under each lattice point evaluated (PatchMap::FindPatch, EvaluateBasis, for channels
// EvaluateBasisFaceVarying). Beyond the level of isolation irregular faces are covered by end caps, which
// approximate. Or stencils made of the same patches (LimitStencilTable), which are applied to the control mesh.
#include <opensubdiv/far/primvarRefiner.h>

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include "verify/peers/opensubdiv_patches.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;
namespace Far = OpenSubdiv::Far;
using Patches = Far::PatchTableFactory;

template <class Real>
using Vector = OpenSubdivVector<Real>;
template <class Real>
using Value = OpenSubdivValue<Real>;

struct Settings {
  explicit Settings(Options& options)
      : wide(options.choice("precision", {"float", "double"}) == 1),
        stencils(options.choice("evaluate", {"patches", "limit-stencils"}) == 1),
        patches(patch_options(options)) {
    // By default a boundary vertex of one face gets the patch of a sharp corner, which is another surface.
    patches.generateLegacySharpCornerPatches = options.choice("corners", {"legacy", "smooth"}) == 0;
    patches.generateFVarLegacyLinearPatches = options.choice("channels", {"smooth", "linear"}) == 1;
    patches.useInfSharpPatch = options.choice("inf-sharp", {"off", "on"}) == 1;
    patches.useSingleCreasePatch = options.choice("single-crease", {"off", "on"}) == 1;
    wide ? patches.SetPatchPrecision<double>() : patches.SetPatchPrecision<float>();
    wide ? patches.SetFVarPatchPrecision<double>() : patches.SetFVarPatchPrecision<float>();
  }
  bool wide, stencils;
  Patches::Options patches;
};

// The points, or values of the channel, of all levels, then those of the end caps.
template <class Real, class Point>
std::vector<Point> all_points(const OpenSubdivPatches& of, std::vector<Point> points) {
  constexpr bool kPositions = std::is_same_v<Point, Vector<Real>>;
  const auto refined = static_cast<std::size_t>(kPositions ? of.refiner->GetNumVerticesTotal()
                                                           : of.refiner->GetNumFVarValuesTotal());
  const int caps = kPositions ? of.table->GetNumLocalPoints() : of.table->GetNumLocalPointsFaceVarying();
  points.resize(refined + static_cast<std::size_t>(caps));
  const Far::PrimvarRefinerReal<Real> primvars(*of.refiner);
  Point* from = points.data();
  for (int level = 1; level <= of.refiner->GetMaxLevel(); ++level) {
    const Far::TopologyLevel& before = of.refiner->GetLevel(level - 1);
    Point* const to = from + (kPositions ? before.GetNumVertices() : before.GetNumFVarValues());
    kPositions ? primvars.Interpolate(level, from, to) : primvars.InterpolateFaceVarying(level, from, to);
    from = to;
  }
  if (caps > 0)
    (kPositions ? of.table->GetLocalPointStencilTable<Real>()
                : of.table->GetLocalPointFaceVaryingStencilTable<Real>())
        ->UpdateValues(points.data(), points.data() + refined);
  return points;
}

template <class Real>
void copy(const Value<Real>& value, const lc_channel& channel, Real* to) {
  std::copy_n(value.x.begin(), channel.components, to);
}

// The patches over one face after another.
template <class Real>
class FacePatches {
 public:
  FacePatches(const lc_mesh& mesh, const OpenSubdivPatches& surface,
              const std::vector<OpenSubdivPatches>& channels)
      : mesh_(mesh),
        surface_(surface),
        channels_(channels),
        points_(all_points<Real>(surface, opensubdiv_points<Real>(mesh))) {
    for (std::size_t c = 0; c < channels.size(); ++c)
      values_.push_back(all_points<Real>(channels[c], opensubdiv_values<Real>(mesh.channels[c])));
  }

  class Reader {
   public:
    explicit Reader(const FacePatches& patches) : patches_(patches) {}
    void begin(std::int32_t face) { face_ = face; }
    void evaluate(std::int32_t part, const Real* uv, Real* position, Real* du, Real* dv) const {
      const OpenSubdivPatches& surface = patches_.surface_;
      const auto& patch = surface.patch(face_, part, uv);
      Weights w{}, wu{}, wv{};
      surface.table->EvaluateBasis(patch, uv[0], uv[1], w.data(), wu.data(), wv.data());
      const auto control = surface.table->GetPatchVertices(patch);
      std::array<Vector<Real>, 3> sums{};
      for (int k = 0; k < control.size(); ++k) {
        const auto& point = patches_.points_[static_cast<std::size_t>(control[k])];
        const auto weight = static_cast<std::size_t>(k);
        sums[0].AddWithWeight(point, w[weight]);
        sums[1].AddWithWeight(point, wu[weight]);
        sums[2].AddWithWeight(point, wv[weight]);
      }
      for (std::size_t c = 0; c < 3; ++c)
        position[c] = sums[0].x[c], du[c] = sums[1].x[c], dv[c] = sums[2].x[c];
    }
    void channel(std::size_t number, std::int32_t part, const Real* uv, Real* to) const {
      const OpenSubdivPatches& channel = patches_.channels_[number];
      const auto& patch = channel.patch(face_, part, uv);
      Weights w{};
      channel.table->EvaluateBasisFaceVarying(patch, uv[0], uv[1], w.data());
      const auto control = channel.table->GetPatchFVarValues(patch);
      Value<Real> sum{};
      for (int k = 0; k < control.size(); ++k)
        sum.AddWithWeight(patches_.values_[number][static_cast<std::size_t>(control[k])],
                          w[static_cast<std::size_t>(k)]);
      copy(sum, patches_.mesh_.channels[number], to);
    }

   private:
    using Weights = std::array<Real, 20>;  // as many control points as a patch has at most
    const FacePatches& patches_;
    std::int32_t face_ = 0;
  };

 private:
  const lc_mesh& mesh_;
  const OpenSubdivPatches& surface_;
  const std::vector<OpenSubdivPatches>& channels_;
  const std::vector<Vector<Real>> points_;
  std::vector<std::vector<Value<Real>>> values_;
};

// What the stencils of all points give, handed out in their order.
template <class Real>
class StencilPoints {
 public:
  StencilPoints(const lc_mesh& mesh, const OpenSubdivPatches& surface,
                const std::vector<OpenSubdivPatches>& channels, const FacePatterns& patterns)
      : mesh_(mesh), patterns_(patterns) {
    const auto count = static_cast<std::size_t>(patterns.vertices());
    position_.resize(count), du_.resize(count), dv_.resize(count);
    const auto control = opensubdiv_points<Real>(mesh);
    const auto stencils = surface.limit_stencils<Real>(patterns);
    stencils->UpdateValues(control.data(), position_.data());
    stencils->UpdateDerivs(control.data(), du_.data(), dv_.data());
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const auto values = opensubdiv_values<Real>(mesh.channels[c]);
      channels[c]
          .limit_stencils<Real>(patterns, /*of_channel=*/true)
          ->UpdateValues(values.data(), values_.emplace_back(count).data());
    }
  }

  // Where the points of one face after another are read.
  class Reader : public PointsInOrder<Real> {
   public:
    explicit Reader(const StencilPoints& points)
        : PointsInOrder<Real>(points.patterns_,
                              {numbers(points.position_), numbers(points.du_), numbers(points.dv_)}),
          points_(points) {}
    void channel(std::size_t c, std::int32_t, const Real*, Real* to) const {
      copy(points_.values_[c][this->last()], points_.mesh_.channels[c], to);
    }

   private:
    static const Real* numbers(const std::vector<Vector<Real>>& of) {
      return reinterpret_cast<const Real*>(of.data());
    }
    const StencilPoints& points_;
  };

 private:
  const lc_mesh& mesh_;
  const FacePatterns& patterns_;
  std::vector<Vector<Real>> position_, du_, dv_;
  std::vector<std::vector<Value<Real>>> values_;
};

class FarPatchesSubject {
 public:
  static constexpr std::int32_t kSharp = kOpenSubdivSharp;

  static lc_capabilities capabilities(Options& options, lc_scheme) {
    const auto precision = Settings(options).wide ? LC_FLOAT64 : LC_FLOAT32;
    lc_capabilities result{precision, LC_WEIGHTS_LOOP, boundary_of(options), LC_POINTS_LIMIT, 10, 1, 1, 0};
    result.channel_rules = kAllChannelRules;
    return result;
  }

  // Channels have patches of their own: where they are refined, too, those of the surface would be others.
  FarPatchesSubject(const lc_mesh& mesh, Options& options)
      : mesh_(mesh),
        settings_(options),
        surface_(with_channel(mesh, kNoChannel), boundary_rule(mesh, options), settings_.patches) {
    for (std::int64_t c = 0; c < mesh.channel_count; ++c)
      channels_.emplace_back(with_channel(mesh, c), boundary_rule(mesh, options), settings_.patches);
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    settings_.wide ? run<double>(request, out) : run<float>(request, out);
  }

 private:
  template <class Real>
  void run(const lc_request& request, lc_tessellation& out) const {
    const FacePatterns patterns(mesh_, request, opensubdiv_triangle);
    const auto put = [&](const auto& made) {
      tessellate_faces<Real>(mesh_, patterns, request, out,
                             [&] { return typename std::decay_t<decltype(made)>::Reader(made); });
    };
    settings_.stencils ? put(StencilPoints<Real>(mesh_, surface_, channels_, patterns))
                       : put(FacePatches<Real>(mesh_, surface_, channels_));
  }

  const lc_mesh mesh_;
  const Settings settings_;
  const OpenSubdivPatches surface_;
  std::vector<OpenSubdivPatches> channels_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_opensubdiv_far_patches() {
  static const lc_subject subject = make_subject<FarPatchesSubject>(
      "opensubdiv-far-patches", "OpenSubdiv 3.5 Far: adaptive refinement, then a PatchTable evaluated",
      "precision=float|double (default float), level=N of isolation (1 to 10, default 2), "
      "end-cap=gregory|bspline (default gregory), corners=legacy|smooth (default legacy, the library's), "
      "channels=smooth|linear: their patches (default smooth; linear is the library's), "
      "evaluate=patches|limit-stencils (default patches), inf-sharp=on|off and single-crease=on|off: patches "
      "for edges that stay sharp and for creases of one sharpness (default off, the library's), "
      "boundary=edge|none (default edge; none is the library's: closed meshes only)");
  return &subject;
}
