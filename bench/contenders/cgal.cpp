// SPDX-License-Identifier: MIT
// CGAL refines; it has no limit surface. Normals are the averages of the adjacent triangles'. (GPL-3.)
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#include <vector>

#include "bench/contenders/contender.h"
#include "data/scheme.h"

namespace limitcheck::bench {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

class Refinement : public Contender {
 public:
  Refinement(const data::ControlMesh& mesh, int depth)
      : depth_(depth), scheme_(data::natural_scheme(mesh)), evaluated_(distinct_points(mesh, depth)) {
    for (const auto& p : mesh.positions) mesh_.add_vertex({p[0], p[1], p[2]});
    std::vector<Mesh::Vertex_index> corners;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      corners.clear();
      for (const std::int32_t v : mesh.faces[f]) corners.push_back(vertex(v));
      mesh_.add_face(corners);
    }
  }
  void run() override {
    Mesh refined = mesh_;
    const auto steps = CGAL::parameters::number_of_iterations(static_cast<unsigned>(depth_));
    if (scheme_ == data::Scheme::kLoop) {
      CGAL::Subdivision_method_3::Loop_subdivision(refined, steps);
    } else {
      CGAL::Subdivision_method_3::CatmullClark_subdivision(refined, steps);
    }
    const auto normals = refined.add_property_map<Mesh::Vertex_index, Kernel::Vector_3>("v:normal").first;
    CGAL::Polygon_mesh_processing::compute_vertex_normals(refined, normals);
  }
  double evaluated() const override { return evaluated_; }

 private:
  static Mesh::Vertex_index vertex(std::int32_t v) {
    return Mesh::Vertex_index(static_cast<Mesh::size_type>(v));
  }
  Mesh mesh_;
  int depth_;
  data::Scheme scheme_;
  double evaluated_;
};

}  // namespace

Route cgal_refinement() {
  return {"cgal/refinement",
          "CGAL Loop_subdivision or CatmullClark_subdivision and averaged normals, double: no limit surface",
          1500,
          600,
          false,
          maker<Refinement>()};
}

}  // namespace limitcheck::bench
