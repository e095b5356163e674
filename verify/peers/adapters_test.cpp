// SPDX-License-Identifier: MIT
// The adapters of both schemes: each lattice point of each face once, named truly, and the values of the reference
// wherever the library is right. Where it is not, findings.json has it.
#include <gtest/gtest.h>

#include <tbb/global_control.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/bounding_box.h"
#include "data/generators/named_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "reference/surface/surface.h"
#include "verify/peers/test_lattice.h"
#include "verify/row/bounds.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using data::Scheme;
using test::Expected;

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

// Every interior valence class, every boundary situation, faces whose corners are all irregular, faces of any size.
const std::vector<Named>& meshes(Scheme scheme) {
  const auto named = [](std::vector<const char*> names) {
    std::vector<Named> all;
    for (const char* name : names) all.push_back({name, data::named_mesh(name)});
    return all;
  };
  static const std::vector<Named> triangles = named(
      {"tetrahedron", "octahedron", "cube",        "torus",     "triangle",       "strip:5",   "strip:6",
       "wheel:3",     "wheel:3:1",  "wheel:7",     "wheel:7:2", "wheel:49",       "fan:1",     "fan:3",
       "fan:5:1",     "fan:8:2",    "ragged-disc", "holes",     "two-components", "bumpy:200", "bumpy:800"});
  static const std::vector<Named> quads = [&] {
    std::vector<Named> all = named({"quad-cube", "quad-torus:4:3", "octahedron", "dual:bumpy:40",
                                    "quad-wheel:3:1", "quad-wheel:5:1", "quad-wheel:6:1", "quad-wheel:7:7",
                                    "quad-wheel:8:1", "quad-wheel:12:1", "quad-wheel:50:7"});
    for (int k = 1; k <= 6; ++k) all.push_back({"fan " + std::to_string(k), data::quad_fan(k, 1)});
    for (int n = 3; n <= 8; ++n) {
      all.push_back({"prism " + std::to_string(n), data::polygon_prism(n)});
      all.push_back({"polygon " + std::to_string(n), polygon(n)});
    }
    // The largest faces that Embree has.
    all.push_back({"prism 15", data::polygon_prism(15)});
    return all;
  }();
  return scheme == Scheme::kLoop ? triangles : quads;
}

// A point as one face has it.
struct Point {
  const data::ControlMesh& mesh;
  const reference::Topology& topology;  // of the refined mesh, whose first vertices are the control vertices
  std::int32_t face, vertex;
  int depth;

  // The number of faces at a boundary vertex, 0 inside.
  std::size_t boundary_faces(std::int32_t v) const {
    const auto sector = topology.sector(v);
    return sector.closed ? 0 : sector.faces.size();
  }
};

// Where a library is right: findings.json has the rest.
using Where = bool (*)(const Point&);
struct Subject {
  const char *name, *options;
  Where position, normal;
};

bool always(const Point&) {
  return true;
}
bool never(const Point&) {
  return false;
}
bool inside(const Point& p) {
  return p.boundary_faces(p.vertex) == 0;
}
// Beyond three faces its tangents at boundary vertices are those of another rule.
bool for_far_on_triangles(const Point& p) {
  return p.boundary_faces(p.vertex) <= 3;
}
// Limit() is given polygons that are no quads.
bool for_far(const Point& p) {
  return p.depth > 0 || p.mesh.faces.corners().size() == 4 * p.mesh.faces.size();
}
bool for_far_tangents(const Point& p) {
  return for_far(p) && p.boundary_faces(p.vertex) < 3;
}
// Gregory patches have the tangents of regular vertices only.
bool regular(const Point& p) {
  const auto sector = p.topology.sector(p.vertex);
  return sector.faces.size() == (sector.closed ? 4 : 2);
}
bool closed(const Point& p) {
  const auto edges = p.topology.edges();
  return std::none_of(edges.begin(), edges.end(), [](const reference::Edge& e) { return e.on_boundary(); });
}
bool for_embree(const Point& p) {
  const auto corners = p.mesh.faces[static_cast<std::size_t>(p.face)];
  return std::none_of(corners.begin(), corners.end(),
                      [&](std::int32_t v) { return p.boundary_faces(v) == 1; });
}
bool for_embree_tangents(const Point& p) {
  return for_embree(p) && regular(p);
}

const std::vector<Subject>& subjects(Scheme scheme) {
  static const std::vector<Subject> of_triangles{
      {"naive", "", always, always},
      {"opensubdiv-far", "", always, for_far_on_triangles},
      {"opensubdiv-far", "precision=double", always, for_far_on_triangles},
      {"opensubdiv-bfr", "", never, never},
      {"opensubdiv-bfr", "precision=double,approx-level=4", always, inside},
      {"opensubdiv-far-patches", "", never, never},
      {"opensubdiv-far-patches", "precision=double,level=4,end-cap=bspline", never, never},
      {"opensubdiv-far-patches", "precision=double,level=4,corners=smooth", always, never},
      {"opensubdiv-gl", "level=4", closed, never},
      {"opensubdiv-gl", "path=patches,evaluator=xfb,level=4", closed, never},
      {"cgal", "", always, never},
      {"openmesh", "", always, never},
      {"vtk", "", always, never}};
  static const std::vector<Subject> of_quads{
      {"naive", "", always, always},
      {"opensubdiv-far", "", for_far, for_far_tangents},
      {"opensubdiv-far", "precision=double", for_far, for_far_tangents},
      {"opensubdiv-bfr", "", never, never},
      {"opensubdiv-bfr", "precision=double,approx-level=4", always, regular},
      {"opensubdiv-far-patches", "", never, never},
      {"opensubdiv-far-patches", "precision=double,level=4,corners=smooth", always, regular},
      {"opensubdiv-far-patches", "precision=double,level=4,corners=smooth,evaluate=limit-stencils", always,
       regular},
      {"opensubdiv-gl", "level=4", closed, never},
      {"opensubdiv-gl", "path=patches,evaluator=xfb,level=4", closed, never},
      {"cgal", "", always, never},
      {"openmesh", "", closed, never},
      {"embree", "", for_embree, for_embree_tangents}};
  return scheme == Scheme::kLoop ? of_triangles : of_quads;
}

// Its library may be there, and no driver.
bool answers(const lc_subject& subject) try {
  (void)capabilities(subject, "");
  return true;
} catch (const SubjectError& error) {
  EXPECT_TRUE(std::string_view(subject.name).ends_with("-gl")) << error.what();
  return false;
}

template <class Of>
class Adapters : public testing::Test {
 protected:
  // Of each subject in this build: visit(subject, session).
  template <class Visit>
  static void with_each(const data::ControlMesh& mesh, Visit visit) {
    for (const Subject& subject : subjects(Of::value))
      if (const lc_subject* there = find_subject(subject.name); there != nullptr && answers(*there)) {
        SCOPED_TRACE(std::string(subject.name) + ":" + subject.options);
        Session session(*there, mesh, subject.options, Session::Input::kValid, Of::value);
        visit(subject, session);
      }
  }
};
using Schemes = testing::Types<std::integral_constant<Scheme, Scheme::kLoop>,
                               std::integral_constant<Scheme, Scheme::kCatmullClark>>;
TYPED_TEST_SUITE(Adapters, Schemes);

double largest(const data::ControlMesh& mesh) {
  double most = 0;
  for (const auto& p : mesh.positions)
    for (const double x : p) most = std::max(most, std::abs(x));
  return most;
}

// The largest errors in their bounds.
struct Worst {
  double position = 0, normal = 0;
};
template <Scheme scheme>
void expect_reference(const Subject& subject, const Session& session, const Tessellation& t,
                      const Expected<scheme>& expected, Worst& worst) {
  const lc_capabilities& c = session.capabilities();
  const int depth = expected.refined().depth();
  const double unit = data::box_diagonal(session.mesh());
  const double bound = position_bound(c.precision, depth, largest(session.mesh()), unit);
  // Normals are differences of points 1/8 apart: they lose digits with each step.
  const double turn = c.precision == LC_FLOAT64 ? 1e-9 : normal_bound(c.precision, depth);
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
    EXPECT_FALSE(t.position_unwritten(v));
    const Place p = t.place(v);
    const std::int32_t at = expected.vertex(p);
    const Point point{session.mesh(), expected.refined().topology(), p.face, at, depth};
    const auto judge = [&](double error, double most, double& in_bounds) {
      EXPECT_LE(error, most) << "face " << p.face << " corner " << p.corner << " (" << p.i << ", " << p.j
                             << ")";
      in_bounds = std::max(in_bounds, error / most);
    };
    if (subject.position(point))
      judge(norm(t.position(v) - expected.point(at, c.points)) / unit, bound, worst.position);
    if (t.has_normals() && expected.has_normal(at) && subject.normal(point))
      judge(angle_degrees(t.normal(v), expected.normal(at)), turn, worst.normal);
  }
}

TYPED_TEST(Adapters, DeliverEachLatticePointOnceAndWhatTheReferenceSays) {
  constexpr Scheme kScheme = TypeParam::value;
  std::map<std::string, Worst> worst;
  for (const Named& m : meshes(kScheme))
    for (int depth = 0; depth <= 3; ++depth)
      this->with_each(m.mesh, [&](const Subject& subject, Session& session) {
        SCOPED_TRACE(m.name + " at depth " + std::to_string(depth));
        const Tessellation t = session.tessellate(depth);
        EXPECT_TRUE(t.defects().empty());
        EXPECT_TRUE(t.overruns().empty());
        EXPECT_EQ(t.has_normals(), session.capabilities().normals == 1);
        const Expected<kScheme> expected(session.mesh(), depth);
        expect_full_lattice(expected, t, std::vector<int>(m.mesh.faces.size(), depth));
        if (session.capabilities().per_face_depth == 0) {
          EXPECT_EQ(t.vertex_count(), std::ssize(expected.refined().positions())) << "each point is shared";
        }
        if (!this->HasFatalFailure()) expect_reference(subject, session, t, expected, worst[session.label()]);
      });
  for (const auto& [label, most] : worst)
    std::printf("%-90s positions %.2g, normals %.2g of their bounds\n", label.c_str(), most.position,
                most.normal);
}

TYPED_TEST(Adapters, TakeADepthForEachFaceWhereTheySaySo) {
  constexpr Scheme kScheme = TypeParam::value;
  const auto mesh = data::named_mesh("octahedron");
  const std::vector<std::int32_t> depth{0, 3, -1, 1, 2, -1, 3, 0};
  this->with_each(mesh, [&](const Subject&, Session& session) {
    if (session.capabilities().per_face_depth != 0)
      expect_full_lattice(Expected<kScheme>(mesh, 3), session.tessellate(depth), depth);
  });
}

// Two ways of the reference that share no code: what subjects are held to above, and Stam's.
TYPED_TEST(Adapters, AreHeldToWhatStamsEvaluatorSaysToo) {
  constexpr Scheme kScheme = TypeParam::value;
  constexpr int kDepth = 3;
  double apart = 0, turned = 0;  // in units of the last place; in degrees
  for (const Named& m : meshes(kScheme)) {
    const Expected<kScheme> expected(m.mesh, kDepth);
    const reference::Surface stam(m.mesh, kScheme);
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(m.mesh.faces.size()); ++f)
      for (const auto& [v, p] : expected.lattice(f, expected.steps())) {
        const auto n = static_cast<double>(expected.domain(f).denominator(expected.steps()));
        const auto exact = stam.evaluate(f, p.part, static_cast<double>(p.i) / n,
                                         static_cast<double>(p.j) / n, reference::Order::kFirst);
        apart = std::max(apart, norm(vector_of(exact.position) - expected.point(v, LC_POINTS_LIMIT)) /
                                    (largest(m.mesh) * 0x1p-52));
        if (expected.has_normal(v))
          turned = std::max(turned, angle_degrees(vector_of(exact.normal), expected.normal(v)));
      }
  }
  EXPECT_LE(apart, 4);
  EXPECT_LE(turned, 1e-9);
}

TYPED_TEST(Adapters, DoNotDependOnTheNumberOfThreads) {
  const auto bytes = [](const Tessellation& t) {
    std::string all;
    const auto append = [&](const auto& array) {
      all.append(reinterpret_cast<const char*>(array.data()), array.size_bytes());
    };
    append(t.positions_f32()), append(t.positions_f64()), append(t.normals_f32()), append(t.normals_f64());
    append(t.provenance()), append(t.corners()), append(t.triangles()), append(t.triangle_face());
    return all;
  };
  // Whatever this machine has.
  const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
  const bool loop = TypeParam::value == Scheme::kLoop;
  this->with_each(data::named_mesh(loop ? "bumpy:4000" : "dual:bumpy:800"),
                  [&](const Subject&, Session& session) {
                    const std::string one = bytes(session.tessellate(2, 1));
                    EXPECT_EQ(one, bytes(session.tessellate(2, 4)));
                    EXPECT_EQ(one, bytes(session.tessellate(2, 1))) << "asked again";
                  });
}

}  // namespace
}  // namespace limitcheck::verify
