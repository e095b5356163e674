// SPDX-License-Identifier: MIT
// OpenSubdiv Far: the whole mesh refined uniformly (PrimvarRefiner::Interpolate level by level, or a StencilTable),
// then limit positions and tangents (PrimvarRefiner::Limit); channels by InterpolateFaceVarying and
// LimitFaceVarying. Delivered as the library delivers it; the normal is its first tangent x its second, one for
// each vertex, on a sharp edge, too. Catmull-Clark's quads are cut along a diagonal. Limit() takes the faces around
// a vertex for quads without a look: on a mesh of other faces its values at depth 0 mean nothing.
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTable.h>
#include <opensubdiv/far/stencilTableFactory.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "verify/peers/opensubdiv_mesh.h"
#include "verify/subject/face_domain.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;
namespace Far = OpenSubdiv::Far;

template <class Real>
using Vector = OpenSubdivVector<Real>;

class FarSubject {
 public:
  static constexpr std::int32_t kSharp = kOpenSubdivSharp;
  static constexpr bool kTakesAnyEdge = true;  // a fault of its own (verify/peers/findings)

  static lc_capabilities capabilities(Options& options, lc_scheme) {
    const bool wide = options.choice("precision", {"float", "double"}) == 1;
    (void)bare(options), (void)stencils(options);
    lc_capabilities result{
        wide ? LC_FLOAT64 : LC_FLOAT32, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 8, 1, 0, 1};
    result.channel_rules = kAllChannelRules;
    return result;
  }

  FarSubject(const lc_mesh& mesh, Options& options)
      : mesh_(mesh),
        wide_(capabilities(options, mesh.scheme).precision == LC_FLOAT64),
        bare_(bare(options)),
        stencils_(stencils(options)),
        refiner_(make_refiner(with_channel(mesh, kNoChannel))) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const int depth = uniform_depth(request, mesh_);
    refuse_too_many_triangles(mesh_, depth);
    const OpenSubdivErrors errors;
    refiner_->Unrefine();
    refine(*refiner_, depth);
    errors.check();
    wide_ ? run<double>(errors, request, depth, out) : run<float>(errors, request, depth, out);
    if (!bare_) errors.check();  // with `bare`, what Limit() says is told as what it delivers: nothing
    refiner_->Unrefine();        // half a gigabyte at 4000 faces, depth 5
  }

 private:
  static bool bare(Options& options) { return options.choice("last-level", {"full", "bare"}) == 1; }
  static bool stencils(Options& options) { return options.choice("evaluate", {"levels", "stencils"}) == 1; }

  // Without the full topology of the last level, which is the library's default, Limit() returns and leaves its
  // output as it was.
  void refine(Far::TopologyRefiner& refiner, int depth) const {
    Far::TopologyRefiner::UniformOptions uniform(depth);
    uniform.fullTopologyInLastLevel = !bare_;
    refiner.RefineUniform(uniform);
  }

  template <class Real>
  void run(const OpenSubdivErrors& errors, const lc_request& request, int depth, lc_tessellation& out) const {
    const Far::PrimvarRefinerReal<Real> primvars(*refiner_);
    const auto points = refined<Real>(*refiner_, opensubdiv_points<Real>(mesh_), depth);
    const Far::TopologyLevel& last = refiner_->GetLevel(depth);
    const bool quads = mesh_.scheme == LC_SCHEME_CATMULL_CLARK;
    std::int64_t triangles = 0;
    for (int f = 0; f < last.GetNumFaces(); ++f) triangles += last.GetFaceVertices(f).size() - 2;
    const auto output =
        allocate_output<Real>(request, out, last.GetNumVertices(), triangles, /*normals=*/true,
                              /*corners=*/quads);
    auto* limit = reinterpret_cast<Vector<Real>*>(output.positions);
    std::vector<Vector<Real>> tangent1(points.size());
    std::vector<Vector<Real>> tangent2(points.size());
    primvars.Limit(points, limit, tangent1, tangent2);
    for (std::size_t v = 0; v < points.size(); ++v) {
      const auto& a = tangent1[v].x;
      const auto& b = tangent2[v].x;
      const std::array<Real, 3> n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                  a[0] * b[1] - a[1] * b[0]};
      const Real length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      for (std::size_t c = 0; c < 3; ++c) output.normals[3 * v + c] = n[c] / length;
    }

    // A vertex is named by the last face that has it.
    const FacePlaces places = places_of_faces(depth);
    std::vector<Fan> fans;
    for (int f = 0; f < last.GetNumFaces(); ++f) {
      const auto corners = last.GetFaceVertices(f);
      const std::vector<Place>& at = places[static_cast<std::size_t>(f)];
      for (std::size_t k = 0; k < at.size(); ++k) {
        const int v = corners[static_cast<int>(k)];
        output.provenance[v] = {at[k].face, at[k].i, at[k].j, at[k].denominator};
        if (quads) output.corner[v] = at[k].corner;
      }
      for (int k = 1; k + 1 < corners.size(); ++k) {
        output.triangle_face[fans.size()] = at[0].face;
        std::uint32_t* const triangle = output.triangles + 3 * fans.size();
        for (std::size_t c = 0; const int corner : {corners[0], corners[k], corners[k + 1]})
          triangle[c++] = static_cast<std::uint32_t>(corner);
        fans.push_back({f, k});
      }
    }
    if (mesh_.channel_count == 0) return;
    if (!bare_) errors.check();  // the refiners of channels listen themselves
    put_channels<Real>(request, depth, fans, out);
  }

  // A triangle of a refined face: its corners 0, k and k + 1.
  struct Fan {
    int face, k;
  };

  // Points, or values of the refiner's channel, of the last level: level by level, or by stencils that skip the
  // levels between.
  template <class Real, class Point>
  std::vector<Point> refined(const Far::TopologyRefiner& refiner, std::vector<Point> points,
                             int depth) const {
    constexpr bool kPositions = std::is_same_v<Point, Vector<Real>>;
    const auto room = [&](int at) {
      const Far::TopologyLevel& level = refiner.GetLevel(at);
      return std::vector<Point>(
          static_cast<std::size_t>(kPositions ? level.GetNumVertices() : level.GetNumFVarValues(0)));
    };
    if (stencils_ && depth > 0) {
      using Factory = Far::StencilTableFactoryReal<Real>;
      typename Factory::Options options;
      options.interpolationMode =
          kPositions ? Factory::INTERPOLATE_VERTEX : Factory::INTERPOLATE_FACE_VARYING;
      options.generateIntermediateLevels = false;
      const std::unique_ptr<const Far::StencilTableReal<Real>> table(Factory::Create(refiner, options));
      std::vector<Point> last = room(depth);
      if (table == nullptr || table->GetNumStencils() != static_cast<int>(last.size()))
        throw SubjectError(LC_FAILED, "Far makes no stencil of some point");
      table->UpdateValues(points.data(), last.data());
      return last;
    }
    const Far::PrimvarRefinerReal<Real> primvars(refiner);
    for (int level = 1; level <= depth; ++level) {
      std::vector<Point> next = room(level);
      kPositions ? primvars.Interpolate(level, points, next)
                 : primvars.InterpolateFaceVarying(level, points, next);
      points.swap(next);
    }
    return points;
  }

  template <class Real>
  void put_channels(const lc_request& request, int depth, const std::vector<Fan>& fans,
                    lc_tessellation& out) const {
    auto* to = allocate_channels<Real>(request, mesh_, out);
    for (std::int64_t c = 0; c < mesh_.channel_count; ++c) {
      const lc_channel& channel = mesh_.channels[c];
      const auto refiner = make_refiner(with_channel(mesh_, c));
      refine(*refiner, depth);
      const auto values = refined<Real>(*refiner, opensubdiv_values<Real>(channel), depth);
      std::vector<OpenSubdivValue<Real>> limit(values.size());
      Far::PrimvarRefinerReal<Real>(*refiner).LimitFaceVarying(values, limit);
      for (const auto& [face, k] : fans) {
        const auto indices = refiner->GetLevel(depth).GetFaceFVarValues(face);
        for (const int corner : {0, k, k + 1})
          to =
              std::copy_n(limit[static_cast<std::size_t>(indices[corner])].x.begin(), channel.components, to);
      }
    }
  }

  // Of each face of a level where its corners lie on the control face.
  using FacePlaces = std::vector<std::vector<Place>>;
  FacePlaces places_of_faces(int depth) const {
    const bool quads = mesh_.scheme == LC_SCHEME_CATMULL_CLARK;
    const std::vector<Place> triangle{{0, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
    const std::vector<Place> quad{{0, 0, 0, 1}, {0, 1, 0, 1}, {0, 1, 1, 1}, {0, 0, 1, 1}};
    const auto on_face = [](std::vector<Place> corners, std::int32_t face, std::int32_t part) {
      for (Place& p : corners) p.face = face, p.corner = part;
      return corners;
    };
    FacePlaces places;
    for (std::int32_t f = 0; f < mesh_.face_count; ++f) {
      const std::int32_t size = mesh_.face_sizes[f];
      places.push_back(on_face(quads ? quad : triangle, f, 0));
      if (quads && size != 4) places.back().clear();
      for (std::int32_t k = 0; quads && size != 4 && k < size; ++k) places.back().push_back({f, 0, 0, 1, k});
    }
    for (int step = 0; step < depth; ++step) {
      const Far::TopologyLevel &before = refiner_->GetLevel(step), &level = refiner_->GetLevel(step + 1);
      FacePlaces next(static_cast<std::size_t>(level.GetNumFaces()));
      for (int f = 0; f < before.GetNumFaces(); ++f) {
        const auto vertices = before.GetFaceVertices(f), edges = before.GetFaceEdges(f);
        const auto children = before.GetFaceChildFaces(f);
        const std::vector<Place>& of = places[static_cast<std::size_t>(f)];
        const bool is_cut =
            quads && of.size() != 4;  // a face of other corners is cut into quads, one at each
        for (int part = 0; part < children.size(); ++part) {
          auto& child = next[static_cast<std::size_t>(children[part])];
          if (is_cut) {
            child = on_face(quad, f, part);
            continue;
          }
          const auto middle = [&](std::size_t a, std::size_t b) {
            const Place &p = of[a % of.size()], &q = of[b % of.size()];
            return Place{p.face, p.i + q.i, p.j + q.j, 2 * p.denominator, p.corner};
          };
          for (const int v : level.GetFaceVertices(children[part])) {
            child.push_back(middle(0, 2));
            for (std::size_t k = 0; k < of.size(); ++k) {
              if (v == before.GetVertexChildVertex(vertices[static_cast<int>(k)]))
                child.back() = middle(k, k);
              if (v == before.GetEdgeChildVertex(edges[static_cast<int>(k)])) child.back() = middle(k, k + 1);
            }
          }
        }
      }
      places = std::move(next);
    }
    return places;
  }

  const lc_mesh mesh_;
  const bool wide_, bare_, stencils_;
  std::unique_ptr<Far::TopologyRefiner> refiner_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_opensubdiv_far() {
  static const lc_subject subject = make_subject<FarSubject>(
      "opensubdiv-far", "OpenSubdiv 3.5 Far: uniform refinement, then the limit masks",
      "precision=float|double (default float), last-level=full|bare (default full; bare is the library's), "
      "evaluate=levels|stencils: each level from the one before, or the last from the control mesh "
      "(StencilTable; default levels)");
  return &subject;
}
