// SPDX-License-Identifier: MIT
// OpenMesh refines; it has no limit surface. Normals are the averages of the adjacent triangles'.
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include <vector>

#include "bench/contenders/contender.h"
#include "data/scheme.h"

namespace limitcheck::bench {

namespace {

template <class Mesh, class Subdivider>
class Refinement : public Contender {
 public:
  Refinement(const data::ControlMesh& mesh, int depth)
      : depth_(depth), evaluated_(distinct_points(mesh, depth)) {
    for (const auto& p : mesh.positions)
      mesh_.add_vertex({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    std::vector<OpenMesh::VertexHandle> corners;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      corners.clear();
      for (const std::int32_t v : mesh.faces[f]) corners.emplace_back(v);
      mesh_.add_face(corners);
    }
  }
  void run() override {
    Mesh refined = mesh_;
    Subdivider subdivider;
    subdivider.attach(refined);
    subdivider(static_cast<std::size_t>(depth_));
    subdivider.detach();
    refined.request_face_normals();
    refined.request_vertex_normals();
    refined.update_normals();
  }
  double evaluated() const override { return evaluated_; }

 private:
  Mesh mesh_;
  int depth_;
  double evaluated_;
};

using Triangles = OpenMesh::TriMesh_ArrayKernelT<>;
using Polygons = OpenMesh::PolyMesh_ArrayKernelT<>;
namespace uniform = OpenMesh::Subdivider::Uniform;

}  // namespace

Route openmesh_refinement() {
  return {"openmesh/refinement",
          "OpenMesh LoopT or CatmullClarkT and averaged normals, float: no limit surface",
          700,
          300,
          false,
          [](const auto& mesh, int depth, int) -> std::unique_ptr<Contender> {
            if (data::natural_scheme(mesh) == data::Scheme::kLoop)
              return std::make_unique<Refinement<Triangles, uniform::LoopT<Triangles, float>>>(mesh, depth);
            return std::make_unique<Refinement<Polygons, uniform::CatmullClarkT<Polygons, float>>>(mesh,
                                                                                                   depth);
          }};
}

}  // namespace limitcheck::bench
