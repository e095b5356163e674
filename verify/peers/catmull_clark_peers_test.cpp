// SPDX-License-Identifier: MIT
// The reference's Catmull-Clark against three libraries: refined points of CGAL and OpenSubdiv, limit points
// and normals of OpenSubdiv; and where they are known to differ, by how much.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "reference/catmull_clark/naive.h"
#include "reference/surface/surface.h"
#include "verify/peers/test_far_mesh.h"

namespace limitcheck::verify {
namespace {

using namespace test;

std::vector<std::pair<std::string, data::ControlMesh>> meshes() {
  std::vector<std::pair<std::string, data::ControlMesh>> all{{"cube", data::quad_cube()},
                                                             {"torus", data::quad_torus(6, 5)}};
  for (const int n : {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 50})
    all.emplace_back("wheel " + std::to_string(n), data::quad_wheel(n, 7));
  for (int k = 1; k <= 6; ++k) all.emplace_back("fan " + std::to_string(k), data::quad_fan(k, 11));
  for (int n = 3; n <= 8; ++n) all.emplace_back("prism " + std::to_string(n), data::polygon_prism(n));
  all.emplace_back("dual of bumpy:4000", data::dual(data::named_mesh("bumpy:4000")));
  return all;
}

TEST(CatmullClark_OpenSubdiv, HasTheSameRefinedAndLimitPoints) {
  double worst_refined = 0, worst_limit = 0, worst_normal = 0, worst_boundary = 0;
  for (const auto& [name, mesh] : meshes()) {
    const double unit = largest_of(mesh) * 0x1p-52;
    for (int depth = 1; depth <= 3; ++depth) {
      const FarMesh<Quads> far(mesh, depth);
      const auto limits = far.ours.limits();
      worst_refined = std::max(worst_refined, far.worst / unit);
      for (std::size_t v = 0; v < far.refined.size(); ++v) {
        worst_limit = std::max(worst_limit, magnitude(limits.positions[v] - far.limits[v]) / unit);
        const double turned = degrees(limits.normals[v], far.normals[v]);
        const auto sector = far.ours.topology().sector(static_cast<std::int32_t>(v));
        // Its tangents at boundary vertices of three faces and more belong to another edge rule.
        (sector.closed || sector.faces.size() < 3 ? worst_normal : worst_boundary) =
            std::max(sector.closed || sector.faces.size() < 3 ? worst_normal : worst_boundary, turned);
      }
    }
  }
  std::printf(
      "units of the last place: refined %.2f, limit %.2f; normals %.1e degrees, on the boundary %.2f\n",
      worst_refined, worst_limit, worst_normal, worst_boundary);
  EXPECT_LE(worst_refined, 4);
  EXPECT_LE(worst_limit, 4);
  EXPECT_LE(worst_normal, 1e-9);  // degrees; one rounding turns a unit vector by 6e-15
  EXPECT_GT(worst_boundary, 0.5);
}

// Three ways that share no code: the recursion over single quads, Stam's powers of the subdivision matrix,
// and OpenSubdiv's limit masks after three steps.
TEST(CatmullClark_OpenSubdiv, OurTwoEvaluatorsAndFarAgreeToAFewUlp) {
  constexpr int kDepth = 3;
  double naive_stam = 0, naive_far = 0, stam_far = 0, turned_stam = 0, turned_far = 0;
  for (const auto& [name, mesh] : meshes()) {
    const double unit = largest_of(mesh) * 0x1p-52;
    const FarMesh<Quads> far(mesh, kDepth);
    const reference::Surface stam(mesh, data::Scheme::kCatmullClark);
    const reference::catmull_clark::NaiveSubdivider<double> naive(mesh.faces,
                                                                  reference::positions_of<double>(mesh));
    for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
      const bool quad = mesh.faces[face].size() == 4;
      const double steps = std::ldexp(1, quad ? kDepth : kDepth - 1);
      for (std::size_t corner = 0; corner < (quad ? 1 : mesh.faces[face].size()); ++corner)
        naive.tessellate(face, corner, kDepth, [&](const reference::catmull_clark::LeafQuad<double>& leaf) {
          for (const auto& c : leaf) {
            const auto v = far.ours.vertex(face, corner, c.i, c.j);
            const auto exact = stam.evaluate(static_cast<int>(face), static_cast<int>(corner), c.i / steps,
                                             c.j / steps, reference::Order::kFirst);
            const Vec3<double>& theirs = far.limits[static_cast<std::size_t>(v)];
            naive_stam = std::max(naive_stam, magnitude(c.position - exact.position) / unit);
            naive_far = std::max(naive_far, magnitude(c.position - theirs) / unit);
            stam_far = std::max(stam_far, magnitude(exact.position - theirs) / unit);
            if (c.normal_kind != reference::NormalKind::kRegular) continue;
            turned_stam = std::max(turned_stam, degrees(c.normal, exact.normal));
            const auto sector = far.ours.topology().sector(v);
            if (sector.closed || sector.faces.size() < 3)  // the others: above
              turned_far = std::max(turned_far, degrees(c.normal, far.normals[static_cast<std::size_t>(v)]));
          }
        });
    }
  }
  std::printf(
      "units of the last place: naive and Stam %.2f, naive and Far %.2f, Stam and Far %.2f; normals %.1e, "
      "%.1e degrees\n",
      naive_stam, naive_far, stam_far, turned_stam, turned_far);
  EXPECT_LE(naive_stam, 4);
  EXPECT_LE(naive_far, 4);
  EXPECT_LE(stam_far, 4);
  EXPECT_LE(turned_stam, 1e-9);
  EXPECT_LE(turned_far, 1e-9);
}

TEST(CatmullClark_Cgal, HasTheSameRefinedPoints) {
  using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
  double worst = 0;
  for (const auto& [name, mesh] : meshes()) {
    if (mesh.positions.size() > 1000) continue;
    Mesh theirs;
    std::vector<Mesh::Vertex_index> vertex;
    for (const auto& p : mesh.positions) vertex.push_back(theirs.add_vertex({p[0], p[1], p[2]}));
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      std::vector<Mesh::Vertex_index> corners;
      for (const std::int32_t v : mesh.faces[f]) corners.push_back(vertex[static_cast<std::size_t>(v)]);
      ASSERT_NE(theirs.add_face(corners), Mesh::null_face());
    }
    CGAL::Subdivision_method_3::CatmullClark_subdivision(theirs, CGAL::parameters::number_of_iterations(2));
    Quads ours = reference_of<Quads>(mesh);
    ours.refine(), ours.refine();
    ASSERT_EQ(theirs.number_of_vertices(), ours.positions().size()) << name;
    const double unit = largest_of(mesh) * 0x1p-52;
    std::vector<Vec3<double>> points;
    for (const auto v : theirs.vertices())
      points.push_back({theirs.point(v).x(), theirs.point(v).y(), theirs.point(v).z()});
    std::vector<bool> taken(points.size());
    for (const Vec3<double>& p : ours.positions()) {
      std::size_t nearest = points.size();
      for (std::size_t i = 0; i < points.size(); ++i)
        if (!taken[i] &&
            (nearest == points.size() || magnitude(points[i] - p) < magnitude(points[nearest] - p)))
          nearest = i;
      taken[nearest] = true;
      worst = std::max(worst, magnitude(points[nearest] - p) / unit);
    }
  }
  std::printf("units of the last place: refined %.2f\n", worst);
  EXPECT_LE(worst, 4);
}

}  // namespace
}  // namespace limitcheck::verify
