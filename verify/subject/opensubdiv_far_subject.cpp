// SPDX-License-Identifier: MIT
// OpenSubdiv Far: the whole mesh refined uniformly (PrimvarRefiner::Interpolate level by level), then limit
// positions and tangents (PrimvarRefiner::Limit). Delivered as the library delivers it; the normal is its
// first tangent x its second.
#include <opensubdiv/far/primvarRefiner.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "verify/subject/opensubdiv_mesh.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;
namespace Far = OpenSubdiv::Far;

template <class Real>
using Vector = OpenSubdivVector<Real>;

// Where the three corners of a refined face lie on its control face, in units of 2^-level.
struct Lattice {
  std::array<std::array<std::uint32_t, 2>, 3> corner;
};

class FarSubject {
 public:
  static lc_capabilities capabilities(Options& options) {
    const bool wide = options.choice("precision", {"float", "double"}) == 1;
    (void)bare(options);
    return {wide ? LC_FLOAT64 : LC_FLOAT32, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 8, 1, 0, 1};
  }

  FarSubject(const lc_mesh& mesh, Options& options)
      : mesh_(mesh),
        wide_(capabilities(options).precision == LC_FLOAT64),
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
    const auto output =
        allocate_output<Real>(request, out, last.GetNumVertices(), last.GetNumFaces(), /*normals=*/true);
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
    for (std::int32_t face = 0; face < mesh_.triangle_count; ++face) {
      descend(face, 0, depth, face, {{{{0, 0}, {1, 0}, {0, 1}}}}, output, written);
    }
  }

  // Writes the triangles into which `face` of `level` is divided at `depth`, and the provenance of their
  // corners. A child's corner is the child of a corner or of an edge of its parent: that says where it lies,
  // whatever the library's order of children is.
  template <class Real>
  void descend(std::int32_t control_face, int level, int depth, int face, const Lattice& at,
               const Output<Real>& output, std::int64_t& written) const {
    const Far::TopologyLevel& here = refiner_->GetLevel(level);
    const auto corners = here.GetFaceVertices(face);
    if (level == depth) {
      for (int k = 0; k < 3; ++k) {
        const auto& [i, j] = at.corner[k];
        output.triangles[3 * written + k] = static_cast<std::uint32_t>(corners[k]);
        output.provenance[corners[k]] = {control_face, i, j, std::uint32_t{1} << depth};
      }
      output.triangle_face[written++] = control_face;
      return;
    }
    const auto edges = here.GetFaceEdges(face);
    std::array<int, 6> candidates{};
    std::array<std::array<std::uint32_t, 2>, 6> places{};
    for (int k = 0; k < 3; ++k) {
      const auto& a = at.corner[k];
      const auto& b = at.corner[(k + 1) % 3];
      candidates[k] = here.GetVertexChildVertex(corners[k]);
      places[k] = {2 * a[0], 2 * a[1]};
      candidates[k + 3] = here.GetEdgeChildVertex(edges[k]);
      places[k + 3] = {a[0] + b[0], a[1] + b[1]};
    }
    const auto children = here.GetFaceChildFaces(face);
    for (int c = 0; c < children.size(); ++c) {
      const auto child_corners = refiner_->GetLevel(level + 1).GetFaceVertices(children[c]);
      Lattice child{};
      for (int k = 0; k < 3; ++k) {
        std::size_t match = 0;
        while (match < 6 && candidates[match] != child_corners[k]) ++match;
        if (match == 6)
          throw SubjectError(LC_FAILED, "a refined vertex is the child of no vertex or edge of its face");
        child.corner[k] = places[match];
      }
      descend(control_face, level + 1, depth, children[c], child, output, written);
    }
  }

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
