// SPDX-License-Identifier: MIT
// OpenMesh: Subdivider::Uniform::LoopT and CatmullClarkT, in double. It refines; it knows no limit points
// and no normals. Its weights are Loop's, from a table of 50 entries that it reads without looking at the
// valence.
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <type_traits>
#include <vector>

#include "verify/peers/refining_subject.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

// With refined faces of N corners.
template <std::size_t N>
class OpenMeshMesh {
 public:
  explicit OpenMeshMesh(const lc_mesh& mesh) {
    for (std::int64_t v = 0; v < mesh.vertex_count; ++v) {
      const double* p = mesh.positions + 3 * v;
      mesh_.add_vertex({p[0], p[1], p[2]});
    }
    const std::int32_t* corner = mesh.corners;
    for (std::int64_t f = 0; f < mesh.face_count; ++f) {
      std::vector<OpenMesh::VertexHandle> corners;
      for (std::int32_t k = 0; k < mesh.face_sizes[f]; ++k) corners.push_back(vertex(*corner++));
      if (!mesh_.add_face(corners).is_valid()) {
        throw SubjectError(LC_INVALID_INPUT, "OpenMesh drops face " + std::to_string(f));
      }
    }
    // LoopT::smooth() reads weights_[valence] of a 50-entry table: undefined
    // behaviour from valence 50 on. Its results there mean nothing and the
    // run must go on, so the mesh is refused here, in the library's place.
    for (const auto v : mesh_.vertices()) {
      if (N == 3 && !mesh_.is_boundary(v) && mesh_.valence(v) >= 50) {
        throw SubjectError(LC_INVALID_INPUT, "vertex " + std::to_string(v.idx()) + " has valence " +
                                                 std::to_string(mesh_.valence(v)) +
                                                 ": OpenMesh's LoopT reads beyond its table of 50 weights");
      }
    }
  }

  void refine() {
    Subdivider subdivider;
    subdivider.attach(mesh_);
    subdivider(1);
    subdivider.detach();
  }
  std::int64_t vertex_count() const { return static_cast<std::int64_t>(mesh_.n_vertices()); }
  std::array<double, 3> position(std::int64_t v) const {
    const auto& p = mesh_.point(vertex(v));
    return {p[0], p[1], p[2]};
  }
  std::vector<std::array<std::uint32_t, N>> faces() const {
    std::vector<std::array<std::uint32_t, N>> result;
    result.reserve(mesh_.n_faces());
    for (const auto face : mesh_.faces()) {
      auto& corners = result.emplace_back();
      std::size_t k = 0;
      for (auto v = mesh_.cfv_ccwbegin(face); v.is_valid() && k < N; ++v) {
        corners[k++] = static_cast<std::uint32_t>(v->idx());
      }
    }
    return result;
  }

 private:
  using Triangles = OpenMesh::TriMesh_ArrayKernelT<Traits>;
  using Polygons = OpenMesh::PolyMesh_ArrayKernelT<Traits>;
  using Mesh = std::conditional_t<N == 3, Triangles, Polygons>;
  using Subdivider = std::conditional_t<N == 3, OpenMesh::Subdivider::Uniform::LoopT<Triangles, double>,
                                        OpenMesh::Subdivider::Uniform::CatmullClarkT<Polygons, double>>;
  static OpenMesh::VertexHandle vertex(std::int64_t v) { return OpenMesh::VertexHandle(static_cast<int>(v)); }
  Mesh mesh_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_openmesh() {
  static const lc_subject subject = make_subject<RefiningSubject<OpenMeshMesh<3>, OpenMeshMesh<4>>>(
      "openmesh", "OpenMesh 9 LoopT, CatmullClarkT: refined vertices, no limit points, no normals");
  return &subject;
}
