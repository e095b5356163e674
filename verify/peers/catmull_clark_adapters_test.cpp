// SPDX-License-Identifier: MIT
// Catmull-Clark by every subject that does it: each lattice point of each face once, named truly, and the
// values of the reference wherever the library is right. Where it is not, findings.json has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "data/bounding_box.h"
#include "data/generators/bumpy_sphere.h"
#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "verify/peers/test_lattice.h"
#include "verify/row/bounds.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using test::expect_full_lattice;
using Expected = test::Expected<data::Scheme::kCatmullClark>;

struct Named {
  std::string name;
  data::ControlMesh mesh;
};

// One face of n corners alone: boundary vertices of one face.
data::ControlMesh polygon(int n) {
  data::ControlMesh mesh;
  std::vector<std::int32_t> corners;
  for (int k = 0; k < n; ++k) {
    const double turn = 2 * std::numbers::pi * k / n;
    mesh.positions.push_back({std::cos(turn), std::sin(turn), 0.3 * std::cos(2 * turn)});
    corners.push_back(k);
  }
  mesh.faces.push_back(corners);
  return mesh;
}

const std::vector<Named>& meshes() {
  static const std::vector<Named> all = [] {
    std::vector<Named> result{{"quad cube", data::quad_cube()},
                              {"quad torus", data::quad_torus(4, 3)},
                              {"triangles", data::octahedron()},
                              {"dual", data::dual(data::bumpy_sphere(40, 1))}};
    for (const int n : {3, 5, 6, 8, 12})
      result.push_back({"wheel " + std::to_string(n), data::quad_wheel(n, 1)});
    for (int k = 1; k <= 6; ++k) result.push_back({"fan " + std::to_string(k), data::quad_fan(k, 1)});
    for (int n = 3; n <= 8; ++n) {
      result.push_back({"prism " + std::to_string(n), data::polygon_prism(n)});
      result.push_back({"polygon " + std::to_string(n), polygon(n)});
    }
    // The largest faces that Embree has.
    result.push_back({"prism 15", data::polygon_prism(15)});
    return result;
  }();
  return all;
}

// A point as one face has it.
struct Point {
  const data::ControlMesh& mesh;
  const Expected& expected;
  std::int32_t face, vertex;
  int depth;
};

// Where a library is right: findings.json has the rest.
struct Subject {
  const char* name;
  const char* options;
  bool (*position)(const Point&);
  bool (*normal)(const Point&);
};

bool always(const Point&) {
  return true;
}
bool never(const Point&) {
  return false;
}
// Limit() is given polygons that are no quads.
bool for_far(const Point& p) {
  return p.depth > 0 || p.mesh.faces.corners().size() == 4 * p.mesh.faces.size();
}
// Its tangents at boundary vertices of three faces and more.
bool for_far_tangents(const Point& p) {
  return for_far(p) && p.expected.boundary_faces(p.vertex) < 3;
}
// Gregory patches have the tangents of regular vertices only.
bool regular(const Point& p) {
  const auto sector = p.expected.refined().topology().sector(p.vertex);
  return sector.faces.size() == (sector.closed ? 4 : 2);
}
bool closed(const Point& p) {
  for (std::size_t v = 0; v < p.mesh.positions.size(); ++v)
    if (p.expected.boundary_faces(static_cast<std::int32_t>(v)) > 0) return false;
  return true;
}
bool for_embree(const Point& p) {
  const auto corners = p.mesh.faces[static_cast<std::size_t>(p.face)];
  return std::none_of(corners.begin(), corners.end(),
                      [&](std::int32_t v) { return p.expected.boundary_faces(v) == 1; });
}
bool for_embree_tangents(const Point& p) {
  return for_embree(p) && regular(p);
}

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> all{
      {"naive", "", always, always},
      {"opensubdiv-far", "", for_far, for_far_tangents},
      {"opensubdiv-far", "precision=double", for_far, for_far_tangents},
      {"opensubdiv-bfr", "", never, never},
      {"opensubdiv-bfr", "precision=double,approx-level=4", always, regular},
      {"opensubdiv-far-patches", "", never, never},
      {"opensubdiv-far-patches", "precision=double,level=4,corners=smooth", always, regular},
      {"opensubdiv-far-patches", "precision=double,level=4,corners=smooth,evaluate=limit-stencils", always,
       regular},
      {"cgal", "", always, never},
      {"openmesh", "", closed, never},
      {"embree", "", for_embree, for_embree_tangents}};
  return all;
}

TEST(CatmullClarkAdapters, DeliverEachLatticePointOnceAndWhatTheReferenceSays) {
  for (const Subject& subject : subjects()) {
    const std::string label = std::string(subject.name) + ":" + subject.options;
    double worst_position = 0, worst_normal = 0;  // in their bounds
    for (const Named& m : meshes())
      for (int depth = 0; depth <= 3; ++depth) {
        SCOPED_TRACE(label + " on " + m.name + " at depth " + std::to_string(depth));
        Session session(*find_subject(subject.name), m.mesh, subject.options, Session::Input::kValid,
                        data::Scheme::kCatmullClark);
        const lc_capabilities& c = session.capabilities();
        const Tessellation t = session.tessellate(depth);
        EXPECT_TRUE(t.defects().empty());
        EXPECT_TRUE(t.overruns().empty());
        EXPECT_EQ(t.has_normals(), c.normals == 1);
        const Expected expected(session.mesh(), depth);
        expect_full_lattice(expected, t, std::vector<int>(m.mesh.faces.size(), depth));
        if (HasFatalFailure()) return;
        const double unit = data::box_diagonal(session.mesh());
        double magnitude = 0;
        for (const auto& p : session.mesh().positions)
          for (const double x : p) magnitude = std::max(magnitude, std::abs(x));
        for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
          const Place p = t.place(v);
          const std::int32_t at = expected.vertex(p);
          const double off = norm(t.position(v) - expected.point(at, c.points)) / unit;
          const double bound = position_bound(c.precision, depth, magnitude, unit);
          const Point point{session.mesh(), expected, p.face, at, depth};
          if (subject.position(point)) {
            EXPECT_LE(off, bound) << "face " << p.face << " corner " << p.corner << " (" << p.i << ", " << p.j
                                  << ")";
            worst_position = std::max(worst_position, off / bound);
          }
          if (!t.has_normals() || !expected.has_normal(at) || !subject.normal(point)) continue;
          const double turned = angle_degrees(t.normal(v), expected.normal(at));
          EXPECT_LE(turned, normal_bound(c.precision, depth))
              << "face " << p.face << " corner " << p.corner << " (" << p.i << ", " << p.j << ")";
          worst_normal = std::max(worst_normal, turned / normal_bound(c.precision, depth));
        }
      }
    std::printf("%-90s positions %.2g, normals %.2g of their bounds\n", label.c_str(), worst_position,
                worst_normal);
  }
}

}  // namespace
}  // namespace limitcheck::verify
