// SPDX-License-Identifier: MIT
// CGAL: Subdivision_method_3's Loop_subdivision and CatmullClark_subdivision on a Surface_mesh, in double. It
// refines; it knows no limit points and no normals. Its weights are Loop's. (Surface_mesh and
// Subdivision_method_3 are GPL-3: what links this target is too.)
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#include "verify/peers/refining_subject.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;

// With refined faces of N corners.
template <std::size_t N>
class CgalMesh {
 public:
  explicit CgalMesh(const lc_mesh& mesh) {
    for (std::int64_t v = 0; v < mesh.vertex_count; ++v) {
      const double* p = mesh.positions + 3 * v;
      mesh_.add_vertex({p[0], p[1], p[2]});
    }
    const std::int32_t* corner = mesh.corners;
    for (std::int64_t f = 0; f < mesh.face_count; ++f) {
      std::vector<Vertex> corners;
      for (std::int32_t k = 0; k < mesh.face_sizes[f]; ++k) corners.push_back(vertex(*corner++));
      if (mesh_.add_face(corners) == Mesh::null_face()) {
        throw SubjectError(LC_INVALID_INPUT, "CGAL does not take face " + std::to_string(f));
      }
    }
  }

  void refine() {
    const auto once = CGAL::parameters::number_of_iterations(1);
    if constexpr (N == 3) {
      CGAL::Subdivision_method_3::Loop_subdivision(mesh_, once);
    } else {
      CGAL::Subdivision_method_3::CatmullClark_subdivision(mesh_, once);
    }
  }
  std::int64_t vertex_count() const { return static_cast<std::int64_t>(mesh_.number_of_vertices()); }
  std::array<double, 3> position(std::int64_t v) const {
    const auto& p = mesh_.point(vertex(v));
    return {p.x(), p.y(), p.z()};
  }
  std::vector<std::array<std::uint32_t, N>> faces() const {
    std::vector<std::array<std::uint32_t, N>> result;
    result.reserve(mesh_.number_of_faces());
    for (const auto face : mesh_.faces()) {
      std::array<std::uint32_t, N> corners{};
      std::size_t k = 0;
      for (const auto v : mesh_.vertices_around_face(mesh_.halfedge(face))) {
        if (k == N)
          throw SubjectError(LC_FAILED, "CGAL made a face with more than " + std::to_string(N) + " corners");
        corners[k++] = v.idx();
      }
      result.push_back(corners);
    }
    return result;
  }

 private:
  using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
  using Vertex = Mesh::Vertex_index;
  static Vertex vertex(std::int64_t v) { return Vertex(static_cast<Mesh::size_type>(v)); }
  Mesh mesh_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_cgal() {
  static const lc_subject subject = make_subject<RefiningSubject<CgalMesh<3>, CgalMesh<4>>>(
      "cgal", "CGAL " CGAL_VERSION_STR
              " Loop_subdivision, CatmullClark_subdivision: refined vertices, no limit points, no normals");
  return &subject;
}
