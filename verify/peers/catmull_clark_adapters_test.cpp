// SPDX-License-Identifier: MIT
// Catmull-Clark by every subject that does it: each lattice point of each face once, named truly, and the
// values of the reference wherever the library is right. Where it is not, findings.json has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data/bounding_box.h"
#include "data/generators/bumpy_sphere.h"
#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "reference/catmull_clark/refined_mesh.h"
#include "reference/loop/refine.h"
#include "verify/evidence/vector.h"
#include "verify/host/host.h"
#include "verify/row/bounds.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using Refined = reference::catmull_clark::RefinedMesh<double>;

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

// The reference's values and names at one depth: each point of the mesh is a vertex of the refined one.
class Expected {
 public:
  Expected(const data::ControlMesh& mesh, int depth)
      : mesh_(mesh), refined_(mesh.faces, reference::positions_of<double>(mesh)), depth_(depth) {
    for (int step = 0; step < depth; ++step) refined_.refine();
    limits_ = refined_.limits();
  }
  FaceDomain domain(std::int32_t face) const {
    return {data::Scheme::kCatmullClark,
            static_cast<int>(mesh_.faces[static_cast<std::size_t>(face)].size())};
  }
  std::int64_t steps() const { return std::int64_t{1} << depth_; }
  std::int32_t vertex(std::int32_t face, FaceDomain::Point p) const {
    if (const auto corner = domain(face).corner_at(p, steps()))
      return mesh_.faces[static_cast<std::size_t>(face)][static_cast<std::size_t>(*corner)];
    return refined_.vertex(static_cast<std::size_t>(face), static_cast<std::size_t>(p.part),
                           static_cast<int>(p.i), static_cast<int>(p.j));
  }
  // Every lattice point of a face by the vertex that it is. At depth 0 a face that is no quad has its
  // corners.
  std::map<std::int32_t, FaceDomain::Point> lattice(std::int32_t face) const {
    std::map<std::int32_t, FaceDomain::Point> result;
    const FaceDomain d = domain(face);
    if (depth_ == 0 && d.parts() > 1) {
      for (int k = 0; k < d.corners(); ++k)
        result.emplace(vertex(face, {0, 0, k}), FaceDomain::Point{0, 0, k});
    } else {
      d.for_each_point(steps(), [&](FaceDomain::Point p) { result.emplace(vertex(face, p), p); });
    }
    return result;
  }
  Vector point(std::int32_t v, lc_points points) const {
    const auto i = static_cast<std::size_t>(v);
    return vector_of(points == LC_POINTS_LIMIT ? limits_.positions[i] : refined_.positions()[i]);
  }
  Vector normal(std::int32_t v) const { return vector_of(limits_.normals[static_cast<std::size_t>(v)]); }
  bool has_normal(std::int32_t v) const {
    return limits_.kinds[static_cast<std::size_t>(v)] == reference::NormalKind::kRegular;
  }
  // Faces at a boundary vertex, 0 inside.
  std::size_t boundary_faces(std::int32_t v) const {
    const auto sector = refined_.topology().sector(v);
    return sector.closed ? 0 : sector.faces.size();
  }
  // Inside with four faces, or on the boundary with two.
  bool regular(std::int32_t v) const {
    const auto sector = refined_.topology().sector(v);
    return sector.faces.size() == (sector.closed ? 4 : 2);
  }
  // Whether a control face has a boundary vertex of one face.
  bool ends(std::int32_t face) const {
    for (const std::int32_t v : mesh_.faces[static_cast<std::size_t>(face)])
      if (boundary_faces(v) == 1) return true;
    return false;
  }
  bool quads_only() const {
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
      if (mesh_.faces[f].size() != 4) return false;
    return true;
  }
  bool closed() const {
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v)
      if (boundary_faces(static_cast<std::int32_t>(v)) > 0) return false;
    return true;
  }

 private:
  const data::ControlMesh& mesh_;
  Refined refined_;
  Refined::Limits limits_;
  int depth_;
};

// Each face is tiled by its lattice: each point is one vertex, each triangle half a quad, counter-clockwise,
// each edge in each direction once.
void expect_full_lattice(const Expected& expected, const Tessellation& t, int depth, std::size_t faces) {
  std::vector<std::map<std::int32_t, std::int64_t>> found(faces);  // vertices of the subject by point
  std::vector<std::set<std::pair<std::int32_t, std::int32_t>>> edges(faces);
  std::vector<std::int64_t> triangles(faces);
  std::vector<std::map<std::int32_t, FaceDomain::Point>> lattice;
  for (std::size_t f = 0; f < faces; ++f) lattice.push_back(expected.lattice(static_cast<std::int32_t>(f)));
  for (std::int64_t k = 0; k < t.triangle_count(); ++k) {
    ASSERT_TRUE(t.triangle_ok(k));
    const std::int32_t face = t.triangle_face()[static_cast<std::size_t>(k)];
    const auto f = static_cast<std::size_t>(face);
    ++triangles[f];
    std::array<FaceDomain::Point, 3> at{};
    std::array<std::int32_t, 3> id{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int64_t v = t.triangles()[static_cast<std::size_t>(k)][c];
      ASSERT_TRUE(t.provenance_ok(v));
      const Place p = t.place(v);
      const FaceDomain there = expected.domain(p.face);
      EXPECT_EQ(p.denominator, std::max<std::int64_t>(1, there.denominator(expected.steps())));
      id[c] = expected.vertex(p.face, point_of(p));
      const auto here = lattice[f].find(id[c]);
      ASSERT_NE(here, lattice[f].end()) << "triangle " << k << " is not on face " << face;
      at[c] = here->second;
      EXPECT_EQ(found[f].try_emplace(id[c], v).first->second, v)
          << "two vertices at a point of face " << face;
    }
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_TRUE(edges[f].emplace(id[c], id[(c + 1) % 3]).second) << "face " << face;
    if (depth > 0 || expected.domain(face).parts() == 1) {
      EXPECT_EQ(expected.domain(face).area(at, expected.steps()), 1) << "triangle " << k;
    }
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const FaceDomain d = expected.domain(static_cast<std::int32_t>(f));
    EXPECT_EQ(found[f].size(), lattice[f].size()) << "face " << f;
    const std::int64_t n = d.denominator(expected.steps());
    EXPECT_EQ(triangles[f], n == 0 ? d.corners() - 2 : 2 * n * n * d.parts()) << "face " << f;
  }
}

// A point as one face has it.
struct Point {
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
  return p.depth > 0 || p.expected.quads_only();
}
// Its tangents at boundary vertices of three faces and more.
bool for_far_tangents(const Point& p) {
  return for_far(p) && p.expected.boundary_faces(p.vertex) < 3;
}
// Gregory patches have the tangents of regular vertices only.
bool regular(const Point& p) {
  return p.expected.regular(p.vertex);
}
bool closed(const Point& p) {
  return p.expected.closed();
}
bool for_embree(const Point& p) {
  return !p.expected.ends(p.face);
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
        expect_full_lattice(expected, t, depth, m.mesh.faces.size());
        if (HasFatalFailure()) return;
        const double unit = data::box_diagonal(session.mesh());
        double magnitude = 0;
        for (const auto& p : session.mesh().positions)
          for (const double x : p) magnitude = std::max(magnitude, std::abs(x));
        for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
          const Place p = t.place(v);
          const std::int32_t at = expected.vertex(p.face, point_of(p));
          const double off = norm(t.position(v) - expected.point(at, c.points)) / unit;
          const double bound = position_bound(c.precision, depth, magnitude, unit);
          const Point point{expected, p.face, at, depth};
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
