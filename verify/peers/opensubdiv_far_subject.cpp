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
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;
namespace Far = OpenSubdiv::Far;

template <class Real>
using Vector = OpenSubdivVector<Real>;

using Steps = std::array<std::uint32_t, 2>;

Steps sum(const Steps& a, const Steps& b) {
  return {a[0] + b[0], a[1] + b[1]};
}

// Where the corners of a refined face lie on its control face, in units of 1 / denominator of the part.
struct RefinedFace {
  std::int32_t control_face, part;
  std::uint32_t denominator;
  std::array<Steps, 4> at;
};

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

    const std::array<Steps, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}, triangle{{{0, 0}, {1, 0}, {0, 1}}};
    std::vector<Fan> fans;
    for (std::int32_t face = 0; face < mesh_.face_count; ++face)
      descend(face, 0, depth, {face, 0, 1, quads ? square : triangle}, output, fans);
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

  // Writes the triangles into which `face` of `level` is divided at `depth`, and the provenance of their corners.
  template <class Real>
  void descend(int face, int level, int depth, const RefinedFace& here, const Output<Real>& output,
               std::vector<Fan>& fans) const {
    const auto corners = refiner_->GetLevel(level).GetFaceVertices(face);
    if (level < depth) {
      const auto children = refiner_->GetLevel(level).GetFaceChildFaces(face);
      for (int c = 0; c < children.size(); ++c)
        descend(children[c], level + 1, depth, child_of(face, level, here, children[c]), output, fans);
      return;
    }
    const bool parts = has_parts(corners.size());
    for (int k = 0; k < corners.size(); ++k) {
      const Steps at = parts ? Steps{} : here.at[static_cast<std::size_t>(k)];
      output.provenance[corners[k]] = {here.control_face, at[0], at[1], here.denominator};
      if (output.corner != nullptr) output.corner[corners[k]] = parts ? k : here.part;
    }
    for (int k = 1; k + 1 < corners.size(); ++k) {
      std::uint32_t* const triangle = output.triangles + 3 * fans.size();
      for (std::size_t c = 0; const int corner : {corners[0], corners[k], corners[k + 1]})
        triangle[c++] = static_cast<std::uint32_t>(corner);
      output.triangle_face[fans.size()] = here.control_face;
      fans.push_back({face, k});
    }
  }

  // A corner of a child is the child of a corner, of an edge or of the face of its parent: that says where it lies,
  // whatever the library's order of children is.
  RefinedFace child_of(int face, int level, const RefinedFace& here, int child) const {
    const Far::TopologyLevel& topology = refiner_->GetLevel(level);
    const auto corners = topology.GetFaceVertices(face), edges = topology.GetFaceEdges(face);
    const auto own = refiner_->GetLevel(level + 1).GetFaceVertices(child);
    const int n = corners.size();
    const bool parts = has_parts(n);
    int first = 0;  // the corner that a part lies at
    while (parts && first < n && own.FindIndex(topology.GetVertexChildVertex(corners[first])) < 0) ++first;
    if (first == n) throw SubjectError(LC_FAILED, "a part of a face that lies at none of its corners");
    const int next = (first + 1) % n, previous = (first + n - 1) % n;
    // Of a part the corners beside its own are one step away.
    const auto at = [&](int k) {
      if (!parts) return here.at[static_cast<std::size_t>(k)];
      return Steps{k == next ? 1U : 0U, k == previous ? 1U : 0U};
    };
    const auto place = [&](int vertex) {
      for (int k = 0; k < n; ++k) {
        if (vertex == topology.GetVertexChildVertex(corners[k])) return sum(at(k), at(k));
        if (vertex == topology.GetEdgeChildVertex(edges[k])) return sum(at(k), at((k + 1) % n));
      }
      if (vertex == topology.GetFaceChildVertex(face)) return sum(at(next), at(previous));
      throw SubjectError(LC_FAILED, "a refined vertex is the child of no vertex, edge or face of its face");
    };
    RefinedFace finer{here.control_face, parts ? first : here.part, parts ? 1 : 2 * here.denominator, {}};
    for (int k = 0; k < own.size(); ++k) finer.at[static_cast<std::size_t>(k)] = place(own[k]);
    return finer;
  }

  // Whether a face has a part at each of its corners: Catmull-Clark's of other sizes than four.
  bool has_parts(int corners) const { return mesh_.scheme == LC_SCHEME_CATMULL_CLARK && corners != 4; }

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
