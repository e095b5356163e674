// SPDX-License-Identifier: MIT
// OpenSubdiv Far: the whole mesh refined uniformly (PrimvarRefiner::Interpolate level by level), then limit
// positions and tangents (PrimvarRefiner::Limit). Delivered as the library delivers it; the normal is its
// first tangent x its second, one for each vertex, on a sharp edge, too. Catmull-Clark's quads are cut along
// a diagonal. Limit() takes the faces around a vertex for quads without a look: on a mesh of other faces its
// values at depth 0 mean nothing.
#include <opensubdiv/far/primvarRefiner.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "verify/peers/opensubdiv_mesh.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;
namespace Far = OpenSubdiv::Far;

template <class Real>
using Vector = OpenSubdivVector<Real>;

// Where the corners of a refined face lie on its control face, in units of 1 / denominator of the part.
struct RefinedFace {
  std::int32_t control_face, part;
  std::uint32_t denominator;
  std::array<std::array<std::uint32_t, 2>, 4> at;
};

// A vertex of the next level, and where it lies on this level's face in halves of its units.
struct Child {
  int vertex;
  std::array<std::uint32_t, 2> at;
};

class FarSubject {
 public:
  static constexpr std::int32_t kSharp = kOpenSubdivSharp;
  static constexpr bool kTakesAnyEdge = true;  // a fault of its own (verify/peers/findings)

  static lc_capabilities capabilities(Options& options, lc_scheme) {
    const bool wide = options.choice("precision", {"float", "double"}) == 1;
    (void)bare(options);
    return {wide ? LC_FLOAT64 : LC_FLOAT32, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 8, 1, 0, 1};
  }

  FarSubject(const lc_mesh& mesh, Options& options)
      : mesh_(mesh),
        wide_(capabilities(options, mesh.scheme).precision == LC_FLOAT64),
        bare_(bare(options)),
        refiner_(make_refiner(mesh)) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const int depth = uniform_depth(request, mesh_);
    refuse_too_many_triangles(mesh_, depth);
    const OpenSubdivErrors errors;
    refiner_->Unrefine();
    // Without the full topology of the last level, which is the library's default, Limit() returns and leaves
    // its output as it was.
    Far::TopologyRefiner::UniformOptions uniform(depth);
    uniform.fullTopologyInLastLevel = !bare_;
    refiner_->RefineUniform(uniform);
    errors.check();
    wide_ ? run<double>(request, depth, out) : run<float>(request, depth, out);
    if (!bare_) errors.check();  // with `bare`, what Limit() says is told as what it delivers: nothing
    refiner_->Unrefine();        // half a gigabyte at 4000 faces, depth 5
  }

 private:
  static bool bare(Options& options) { return options.choice("last-level", {"full", "bare"}) == 1; }

  template <class Real>
  void run(const lc_request& request, int depth, lc_tessellation& out) const {
    std::vector<Vector<Real>> points(mesh_.vertex_count);
    for (std::size_t v = 0; v < points.size(); ++v) {
      for (std::size_t c = 0; c < 3; ++c) points[v].x[c] = static_cast<Real>(mesh_.positions[3 * v + c]);
    }
    const Far::PrimvarRefinerReal<Real> primvars(*refiner_);
    for (int level = 1; level <= depth; ++level) {
      std::vector<Vector<Real>> next(refiner_->GetLevel(level).GetNumVertices());
      primvars.Interpolate(level, points, next);
      points.swap(next);
    }

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

    std::int64_t written = 0;
    for (std::int32_t face = 0; face < mesh_.face_count; ++face) begin(face, depth, output, written);
  }

  // All of one control face.
  template <class Real>
  void begin(std::int32_t face, int depth, const Output<Real>& output, std::int64_t& written) const {
    const Far::TopologyLevel& control = refiner_->GetLevel(0);
    const auto corners = control.GetFaceVertices(face);
    if (mesh_.scheme == LC_SCHEME_LOOP) {
      descend(face, 0, depth, {face, 0, 1, {{{0, 0}, {1, 0}, {0, 1}}}}, output, written);
    } else if (corners.size() == 4) {
      descend(face, 0, depth, {face, 0, 1, kSquare}, output, written);
    } else if (depth == 0) {
      for (int k = 0; k < corners.size(); ++k) name(corners[k], {face, k, 1, kSquare}, {0, 0}, output);
      for (int k = 1; k + 1 < corners.size(); ++k)
        write(face, {corners[0], corners[k], corners[k + 1]}, output, written);
    } else {
      const auto edges = control.GetFaceEdges(face);
      const auto children = control.GetFaceChildFaces(face);
      for (int c = 0; c < children.size(); ++c) {
        const auto child_corners = refiner_->GetLevel(1).GetFaceVertices(children[c]);
        int k = 0;  // the corner that it lies at
        while (k < corners.size() && !contains(child_corners, control.GetVertexChildVertex(corners[k]))) ++k;
        if (k == corners.size())
          throw SubjectError(LC_FAILED, "a part of a face that lies at none of its corners");
        const int previous = k == 0 ? corners.size() - 1 : k - 1;
        const std::array<Child, 4> candidates{{{control.GetVertexChildVertex(corners[k]), {0, 0}},
                                               {control.GetEdgeChildVertex(edges[k]), {1, 0}},
                                               {control.GetFaceChildVertex(face), {1, 1}},
                                               {control.GetEdgeChildVertex(edges[previous]), {0, 1}}}};
        descend(children[c], 1, depth, child_of({face, k, 1, {}}, child_corners, candidates), output,
                written);
      }
    }
  }

  // Writes the triangles into which `face` of `level` is divided at `depth`, and the provenance of their
  // corners. A child's corner is the child of a corner, of an edge or of the face of its parent: that says
  // where it lies, whatever the library's order of children is.
  template <class Real>
  void descend(int face, int level, int depth, const RefinedFace& here, const Output<Real>& output,
               std::int64_t& written) const {
    const Far::TopologyLevel& topology = refiner_->GetLevel(level);
    const auto corners = topology.GetFaceVertices(face);
    const auto count = static_cast<std::size_t>(corners.size());
    if (level == depth) {
      for (std::size_t k = 0; k < count; ++k) name(corners[static_cast<int>(k)], here, here.at[k], output);
      write(here.control_face, {corners[0], corners[1], corners[2]}, output, written);
      if (count == 4) write(here.control_face, {corners[0], corners[2], corners[3]}, output, written);
      return;
    }
    const auto edges = topology.GetFaceEdges(face);
    std::array<Child, 9> candidates{};
    const auto middle = [](const auto& a, const auto& b) {
      return std::array<std::uint32_t, 2>{a[0] + b[0], a[1] + b[1]};
    };
    for (std::size_t k = 0; k < count; ++k) {
      const auto& a = here.at[k];
      const auto i = static_cast<int>(k);
      candidates[k] = {topology.GetVertexChildVertex(corners[i]), middle(a, a)};
      candidates[k + count] = {topology.GetEdgeChildVertex(edges[i]), middle(a, here.at[(k + 1) % count])};
    }
    if (count == 4) candidates[8] = {topology.GetFaceChildVertex(face), middle(here.at[0], here.at[2])};
    const auto children = topology.GetFaceChildFaces(face);
    const RefinedFace finer{here.control_face, here.part, 2 * here.denominator, {}};
    for (int c = 0; c < children.size(); ++c) {
      const auto child_corners = refiner_->GetLevel(level + 1).GetFaceVertices(children[c]);
      const std::span known(candidates.data(), count == 4 ? 9 : 6);
      descend(children[c], level + 1, depth, child_of(finer, child_corners, known), output, written);
    }
  }

  static bool contains(const Far::ConstIndexArray& vertices, int vertex) {
    return std::find(vertices.begin(), vertices.end(), vertex) != vertices.end();
  }
  static RefinedFace child_of(RefinedFace child, const Far::ConstIndexArray& corners,
                              std::span<const Child> known) {
    for (int k = 0; k < corners.size(); ++k) {
      const auto match = std::find_if(known.begin(), known.end(),
                                      [&](const Child& candidate) { return candidate.vertex == corners[k]; });
      if (match == known.end())
        throw SubjectError(LC_FAILED, "a refined vertex is the child of no vertex, edge or face of its face");
      child.at[static_cast<std::size_t>(k)] = match->at;
    }
    return child;
  }
  template <class Real>
  static void name(int vertex, const RefinedFace& face, const std::array<std::uint32_t, 2>& at,
                   const Output<Real>& output) {
    output.provenance[vertex] = {face.control_face, at[0], at[1], face.denominator};
    if (output.corner != nullptr) output.corner[vertex] = face.part;
  }
  template <class Real>
  static void write(std::int32_t control_face, const std::array<int, 3>& corners, const Output<Real>& output,
                    std::int64_t& written) {
    for (std::size_t k = 0; k < 3; ++k)
      output.triangles[3 * written + static_cast<std::int64_t>(k)] = static_cast<std::uint32_t>(corners[k]);
    output.triangle_face[written++] = control_face;
  }

  static constexpr std::array<std::array<std::uint32_t, 2>, 4> kSquare{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

  const lc_mesh mesh_;
  const bool wide_, bare_;
  std::unique_ptr<Far::TopologyRefiner> refiner_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_opensubdiv_far() {
  static const lc_subject subject = make_subject<FarSubject>(
      "opensubdiv-far", "OpenSubdiv 3.5 Far: uniform refinement, then the limit masks",
      "precision=float|double (default float), last-level=full|bare (default full; bare is the library's)");
  return &subject;
}
