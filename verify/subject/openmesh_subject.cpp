// SPDX-License-Identifier: MIT
// OpenMesh: Subdivider::Uniform::LoopT, in double. It refines; it knows no limit points and no normals. Its
// weights are Loop's, from a table of 50 entries that it reads without looking at the valence.
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <algorithm>

#include "verify/subject/refining_subject.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

class OpenMeshMesh {
 public:
  explicit OpenMeshMesh(const lc_mesh& mesh) {
    for (std::int64_t v = 0; v < mesh.vertex_count; ++v) {
      const double* p = mesh.positions + 3 * v;
      mesh_.add_vertex({p[0], p[1], p[2]});
    }
    for (std::int64_t f = 0; f < mesh.triangle_count; ++f) {
      const std::int32_t* t = mesh.triangles + 3 * f;
      if (!mesh_.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])).is_valid()) {
        throw SubjectError(LC_INVALID_INPUT, "OpenMesh drops face " + std::to_string(f));
      }
    }
    // LoopT::smooth() reads weights_[valence] of a 50-entry table: undefined
    // behaviour from valence 50 on. Its results there mean nothing and the
    // run must go on, so the mesh is refused here, in the library's place.
    for (const auto v : mesh_.vertices()) {
      if (!mesh_.is_boundary(v) && mesh_.valence(v) >= 50) {
        throw SubjectError(LC_INVALID_INPUT, "vertex " + std::to_string(v.idx()) + " has valence " +
                                                 std::to_string(mesh_.valence(v)) +
                                                 ": OpenMesh's LoopT reads beyond its table of 50 weights");
      }
    }
  }

  void refine() {
    OpenMesh::Subdivider::Uniform::LoopT<Mesh, double> loop;
    loop.attach(mesh_);
    loop(1);
    loop.detach();
  }
  std::int64_t vertex_count() const { return static_cast<std::int64_t>(mesh_.n_vertices()); }
  std::array<double, 3> position(std::int64_t v) const {
    const auto& p = mesh_.point(vertex(v));
    return {p[0], p[1], p[2]};
  }
  std::vector<std::array<std::uint32_t, 3>> triangles() const {
    std::vector<std::array<std::uint32_t, 3>> result;
    result.reserve(mesh_.n_faces());
    for (const auto face : mesh_.faces()) {
      auto& corners = result.emplace_back();
      std::size_t k = 0;
      for (auto v = mesh_.cfv_ccwbegin(face); v.is_valid() && k < 3; ++v) {
        corners[k++] = static_cast<std::uint32_t>(v->idx());
      }
    }
    return result;
  }

 private:
  using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
  static OpenMesh::VertexHandle vertex(std::int64_t v) { return OpenMesh::VertexHandle(static_cast<int>(v)); }
  Mesh mesh_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_openmesh() {
  static const lc_subject subject = make_subject<RefiningSubject<OpenMeshMesh>>(
      "openmesh", "OpenMesh 9 LoopT: refined vertices, no limit points, no normals");
  return &subject;
}
