// SPDX-License-Identifier: MIT
// OpenMesh refines; it has no limit surface. Normals are the averages of the adjacent triangles'.
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include "bench/contenders/contender.h"

namespace limitcheck::bench {

namespace {

class Refinement : public Contender {
 public:
  Refinement(const data::ControlMesh& mesh, int depth)
      : depth_(depth), evaluated_(distinct_points(mesh, depth)) {
    for (const auto& p : mesh.positions)
      mesh_.add_vertex({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    for (const auto& t : triangles_of(mesh)) mesh_.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  }
  void run() override {
    Mesh refined = mesh_;
    OpenMesh::Subdivider::Uniform::LoopT<Mesh, float> loop;
    loop.attach(refined);
    loop(static_cast<std::size_t>(depth_));
    loop.detach();
    refined.request_face_normals();
    refined.request_vertex_normals();
    refined.update_normals();
  }
  double evaluated() const override { return evaluated_; }

 private:
  using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
  static OpenMesh::VertexHandle vertex(std::int32_t v) { return OpenMesh::VertexHandle(v); }
  Mesh mesh_;
  int depth_;
  double evaluated_;
};

}  // namespace

Route openmesh_refinement() {
  return {"openmesh/refinement",
          "OpenMesh LoopT and averaged normals, float: no limit surface",
          700,
          300,
          false,
          [](const auto& mesh, int depth, int) { return std::make_unique<Refinement>(mesh, depth); }};
}

}  // namespace limitcheck::bench
