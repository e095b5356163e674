// SPDX-License-Identifier: MIT
// Sections 3 and 3.1: what the scheme accepts, and two misprints taken literally.  [C06, C07, C09, C13, C16]
// Section 2: "it is even possible to let a sharp edge start and end in an otherwise smooth surface". [C85]
#include <gtest/gtest.h>

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "data/generators/named_mesh.h"
#include "data/generators/random_mesh.h"
#include "data/scheme.h"
#include "data/shapes.h"
#include "data/validate.h"
#include "reference/loop/masks.h"
#include "reference/loop/refine.h"
#include "reference/loop/stam.h"
#include "reference/number/number_exact.h"
#include "reference/surface/surface.h"
#include "verify/audit/audit.h"
#include "verify/claims/test_support/figures.h"
#include "verify/evidence/vector.h"
#include "verify/host/host.h"
#include "verify/subject/lattice.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using V = reference::Vec3<double>;

double distance(const V& a, const V& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

TEST(Sec3_ControlMesh, MayBeAnyManifoldWithOrWithoutBoundaryAndNothingElse) {
  for (const std::string& shape : data::stock_shapes()) {
    const auto mesh = data::named_mesh(shape);
    EXPECT_TRUE(data::validate(mesh).empty()) << shape;
    for (const auto* subject : {lc_subject_naive(), lc_subject_sliding_window()}) {
      const auto t = Session(*subject, mesh).tessellate(2);
      EXPECT_EQ(t.triangle_count(), static_cast<std::int64_t>(16 * mesh.faces.size())) << shape;
      EXPECT_TRUE(t.defects().empty());
    }
  }
  // Irregular meshes of any genus, closed and open, in one piece or more, with valences from 3 to 50.
  constexpr int kRandom = 40;
  int open = 0;
  for (std::uint64_t seed = 1; seed <= kRandom; ++seed) {
    data::RandomMeshOptions size{.faces = 60};
    const auto mesh = data::random_mesh(seed, size);
    const auto refined = reference::refine<double>(mesh, 1);
    EXPECT_TRUE(std::all_of(refined.positions().begin(), refined.positions().end(), [](const V& p) {
      return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    })) << seed;
    for (const auto* subject : {lc_subject_naive(), lc_subject_sliding_window()})
      EXPECT_EQ(Session(*subject, mesh).tessellate(1).triangle_count(),
                static_cast<std::int64_t>(4 * mesh.faces.size()))
          << seed;
    // Of a closed mesh every edge has two faces: three halves as many edges as faces.
    std::set<std::pair<std::int32_t, std::int32_t>> edges;
    for (const auto& t : triangles_of(mesh))
      for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    open += 2 * edges.size() > 3 * mesh.faces.size();
  }
  // Catmull-Clark on manifolds of triangles, quads and larger faces, closed and open.
  for (std::uint64_t seed = 1; seed <= kRandom; ++seed) {
    const auto mesh = data::named_mesh(fmt::format("mixed:{}:60", seed));
    ASSERT_TRUE(data::validate(mesh, data::Scheme::kCatmullClark).empty()) << seed;
    const auto t = Session(*lc_subject_naive(), mesh, "", Session::Input::kValid, data::Scheme::kCatmullClark)
                       .tessellate(1);
    EXPECT_EQ(t.triangle_count(), static_cast<std::int64_t>(2 * mesh.faces.corners().size())) << seed;
    EXPECT_TRUE(t.defects().empty()) << seed;
  }
  record("{}", kRandom, "random_manifolds");
  record("{}", open, "of_them_with_boundary");
  EXPECT_GT(open, 0);
  EXPECT_LT(open, kRandom);
  data::ControlMesh fin = data::triangle_pair();  // a third face on the common edge
  const auto& a = triangles_of(fin)[0];
  const auto& b = triangles_of(fin)[1];
  std::vector<std::int32_t> common;
  for (const auto v : a)
    if (std::find(b.begin(), b.end(), v) != b.end()) common.push_back(v);
  fin.positions.push_back({0, 0, 5});
  fin.faces.push_back({common[0], common[1], static_cast<std::int32_t>(fin.positions.size()) - 1});
  EXPECT_FALSE(data::validate(fin).empty());
  EXPECT_THROW(reference::refine<double>(fin, 1), data::ArgumentError);
}

// Runs a subject with each scheme's rules: no point beyond a few roundings of the exact surface, of which it
// knows nothing. (The audit's bounds: verify/row/bounds.h.)
void expect_both_schemes(const lc_subject* subject) {
  struct Case {
    const char* mesh;
    data::Scheme scheme;
  };
  for (const Case& c :
       {Case{"bumpy:60", data::Scheme::kLoop}, Case{"ragged-disc", data::Scheme::kLoop},
        Case{"bumpy:60", data::Scheme::kCatmullClark}, Case{"quad-cube", data::Scheme::kCatmullClark},
        Case{"dual:bumpy:60", data::Scheme::kCatmullClark},
        Case{"mixed:1:60", data::Scheme::kCatmullClark}}) {
    AuditMesh mesh{c.mesh, data::named_mesh(c.mesh)};
    mesh.asked_scheme = c.scheme;
    const std::vector<Result> rows = Auditor(3, 1).run({subject, ""}, mesh);
    EXPECT_GT(rows.size(), 10U);
    for (const Result& r : rows) EXPECT_FALSE(is_bad(r)) << c.mesh << ", " << r.check << ": " << r.message;
  }
}

TEST(Sec4_Recursion, ServesBothSchemesByOtherRules) {
  expect_both_schemes(lc_subject_naive());
}

// Depths, cracks, strips, fans, threads are the same program for both; the window has rows above and below,
// and corners, of either.
TEST(Sec4_SlidingWindow, ServesBothSchemesByOtherRules) {
  expect_both_schemes(lc_subject_sliding_window());
}

TEST(Sec3_SubFaces, ShareNoCornerPositionWithTheirParentUnlessAVertexIsTheMeanOfItsRing) {
  const auto mesh = data::bumpy_sphere(800, 1);
  const auto finer = reference::refine<double>(mesh, 1);
  double nearest = 1e300;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const auto& p = mesh.positions[v];
    nearest = std::min(nearest, distance({p[0], p[1], p[2]}, finer.positions()[v]));
  }
  record("{:.1e}", nearest, "shortest_move");
  EXPECT_GT(nearest, 1e-6);
  // The counterexample: a flat regular sheet, where each vertex inside is the mean of its six neighbours.
  data::ControlMesh flat = data::sheet(4, 4);
  for (auto& p : flat.positions) p[2] = 0;
  const auto refined = reference::refine<double>(flat, 1);
  int stayed = 0;
  for (std::size_t v = 0; v < flat.positions.size(); ++v) {
    const auto& p = flat.positions[v];
    stayed += distance({p[0], p[1], p[2]}, refined.positions()[v]) <= 1e-15;
  }
  EXPECT_GE(stayed, 9) << "all vertices inside";
}

TEST(Sec3_LimitSurface, DependsOnTheDiagonalsThatTriangulateTheQuads) {
  // A bumpy grid of 4 x 4 quads, every one cut along the one or the other diagonal.
  const auto grid = [](int diagonal) {
    data::ControlMesh mesh;
    for (int y = 0; y <= 4; ++y)
      for (int x = 0; x <= 4; ++x)
        mesh.positions.push_back({static_cast<double>(x), static_cast<double>(y), (7 * x + 5 * y) % 4 / 4.});
    for (std::int32_t y = 0; y < 4; ++y)
      for (std::int32_t x = 0; x < 4; ++x) {
        const std::int32_t a = 5 * y + x, b = a + 1, c = a + 6, d = a + 5;
        if (diagonal == 0) {
          mesh.faces.push_back({a, b, c}), mesh.faces.push_back({a, c, d});
        } else {
          mesh.faces.push_back({b, c, d}), mesh.faces.push_back({b, d, a});
        }
      }
    return mesh;
  };
  const data::ControlMesh first = grid(0), second = grid(1);
  const reference::StamEvaluator<double> one(first), other(second);
  const auto corner = [](const data::ControlMesh& mesh, const auto& limit, std::int32_t v) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      for (int k = 0; k < 3; ++k)
        if (triangles_of(mesh)[f][k] == v)
          return limit.evaluate(static_cast<int>(f), k == 1, k == 2, reference::Order::kFirst).position;
    return V{};
  };
  double farthest = 0;
  for (std::int32_t v = 0; v < 25; ++v)
    farthest = std::max(farthest, distance(corner(first, one, v), corner(second, other, v)));
  record("{:.3f}", farthest, "largest_distance_of_a_limit_vertex_in_edge_lengths");
  EXPECT_GT(farthest, 0.05);
}

// Literal reading of "all indices modulo n" with the ring numbered 1..n and the centre 0: v_n becomes v_0.
TEST(Sec31_Indices, ModuloNWouldMapTheLastNeighbourToTheCentre) {
  for (const int n : {3, 4, 5, 6, 7, 20}) {
    const auto mesh = data::wheel(n, 3);
    const reference::Topology topology(mesh.positions.size(), mesh.faces);
    const auto finer = reference::refine<double>(mesh, 1);
    std::vector<V> v{{mesh.positions[0][0], mesh.positions[0][1], mesh.positions[0][2]}};  // v_0, v_1 .. v_n
    for (const std::int32_t r : topology.ring(0)) {
      const auto& p = mesh.positions[r];
      v.push_back({p[0], p[1], p[2]});
    }
    const auto edge_point = [&](int i, auto wrap) {  // equation (2) for the edge v_0 v_i
      return reference::interior_edge_point(v[0], v[wrap(i)], v[wrap(i - 1)], v[wrap(i + 1)]);
    };
    const auto literal = [n](int i) { return static_cast<std::size_t>((i + n) % n); };
    const auto meant = [n](int i) { return static_cast<std::size_t>((i - 1 + n) % n + 1); };
    for (int i = 1; i <= n; ++i) {
      const auto e = static_cast<std::size_t>(topology.sector(0).edges[i - 1]);
      const V& truth = finer.positions()[mesh.positions.size() + e];
      EXPECT_LE(distance(edge_point(i, meant), truth), 1e-15) << n << " " << i;
      const double off = distance(edge_point(i, literal), truth);
      if (i == n || i == 1 || i == n - 1) {
        EXPECT_GT(off, 0.01) << "edge " << i << " of " << n << " uses v_n";
      } else {
        EXPECT_LE(off, 1e-15);
      }
    }
  }
}

// The denominators of (4) and (5): exactly zero; in floating point whatever rounding leaves.
TEST(Eq4And5_Denominators, AreZeroAndTheirRoundingFlipsTheNormalAtRegularVertices) {
  using Number = reference::Decimal50;
  int exactly_zero = 0, opposite = 0;
  for (long n = 3; n <= 50; ++n) {
    Number sum1(0), sum2(0);
    double d1 = 0, d2 = 0;
    for (long i = 1; i <= n; ++i) {
      sum1 = sum1 + reference::NumberTraits<Number>::cos_pi(2 * i, n);
      sum2 = sum2 + reference::NumberTraits<Number>::cos_pi(2 * (i - 1), n);
      d1 += std::cos(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
      d2 += std::cos(2 * std::numbers::pi * static_cast<double>(i - 1) / static_cast<double>(n));
    }
    EXPECT_LE(std::abs(reference::NumberTraits<Number>::approximate(sum1)), 1e-47) << n;
    EXPECT_LE(std::abs(reference::NumberTraits<Number>::approximate(sum2)), 1e-47) << n;
    EXPECT_LE(std::max(std::abs(d1), std::abs(d2)), 1e-13) << n;
    exactly_zero += d1 == 0 || d2 == 0;
    opposite += d1 * d2 < 0;
    if (n == 6) {
      EXPECT_LT(d1 * d2, 0) << "u1 x u2 divided by both: the normal points inside";
    }
  }
  record("{}", exactly_zero, "valences_3_to_50_with_a_denominator_exactly_zero");
  record("{}", opposite, "valences_3_to_50_with_flipped_normal");
  EXPECT_GT(opposite, 0);
}

// The surface along a control edge, as the faces on both sides of it see it.
class EdgeOfSurface {
 public:
  EdgeOfSurface(const Lattice& lattice, const reference::Surface& surface, const Lattice::Edge& edge)
      : lattice_(lattice), surface_(surface), edge_(edge) {}

  struct Both {
    double gap, degrees;  // between the positions, and between the normals
    bool regular;         // either side has a normal
  };
  /// The part `along` of the way from the edge's smaller vertex.
  Both at(double along) const {
    const auto a = side(0, along), b = side(1, along);
    const auto regular = [](const auto& p) { return p.normal_kind == reference::NormalKind::kRegular; };
    return {norm(vector_of(a.position) - vector_of(b.position)),
            angle_degrees(vector_of(a.normal), vector_of(b.normal)), regular(a) && regular(b)};
  }

 private:
  reference::SurfacePoint<double> side(std::size_t k, double along) const {
    // Integers far finer than any point that is asked for.
    constexpr std::int64_t kWhole = std::int64_t{1} << 40;
    const std::int32_t face = edge_.face[k];
    const bool forwards = lattice_.vertex(face, edge_.corner[k]) == edge_.a;
    const auto steps = static_cast<std::int64_t>(along * static_cast<double>(kWhole));
    const FaceDomain domain = lattice_.domain(face);
    const auto p = domain.on_side(edge_.corner[k], forwards ? steps : kWhole - steps, kWhole);
    const auto whole = static_cast<double>(domain.denominator(kWhole));
    return surface_.evaluate(face, p.part, static_cast<double>(p.i) / whole, static_cast<double>(p.j) / whole,
                             reference::Order::kFirst);
  }

  const Lattice& lattice_;
  const reference::Surface& surface_;
  const Lattice::Edge& edge_;
};

// Returns the largest angle between the sides, in degrees.
double look_at_all_edges(const data::ControlMesh& mesh) {
  const Lattice lattice(mesh, 0);
  const reference::Surface surface(mesh, lattice.scheme());
  std::map<std::int32_t, int> sharp_edges_at;
  const auto is_sharp = [&](const Lattice::Edge& e) {
    return std::any_of(
        mesh.sharpness.edges.begin(), mesh.sharpness.edges.end(),
        [&](const data::SharpEdge& s) { return e.a == std::min(s.a, s.b) && e.b == std::max(s.a, s.b); });
  };
  for (const Lattice::Edge& e : lattice.edges())
    if (is_sharp(e)) ++sharp_edges_at[e.a], ++sharp_edges_at[e.b];
  const auto ends = std::count_if(sharp_edges_at.begin(), sharp_edges_at.end(),
                                  [](const auto& entry) { return entry.second == 1; });
  EXPECT_EQ(ends, 2);

  double sharpest = 0, bluntest = 180, smooth = 0, gap = 0;
  for (const Lattice::Edge& edge : lattice.edges()) {
    const EdgeOfSurface here(lattice, surface, edge);
    const bool sharp = is_sharp(edge);
    for (int i = 0; i <= 16; ++i) {
      const auto both = here.at(i / 16.);
      gap = std::max(gap, both.gap);
      const bool inside = i > 0 && i < 16;
      EXPECT_TRUE(both.regular);
      if (sharp && inside) {
        sharpest = std::max(sharpest, both.degrees);
        bluntest = std::min(bluntest, both.degrees);
      } else if (!sharp && inside) {
        smooth = std::max(smooth, both.degrees);
      }
    }
    // Where the crease ends, its sides turn into one tangent plane.
    for (const bool last : {false, true}) {
      if (!sharp || sharp_edges_at[last ? edge.b : edge.a] != 1) continue;
      const auto angle = [&](double distance) { return here.at(last ? 1 - distance : distance).degrees; };
      EXPECT_LE(angle(0), 1e-7);
      EXPECT_LT(angle(0x1p-20), angle(0x1p-10));
      EXPECT_LT(angle(0x1p-10), angle(0x1p-2));
    }
  }
  EXPECT_GT(sharpest, 10);
  EXPECT_GT(bluntest, 1e-3) << "sharp all along";
  EXPECT_LE(smooth, 1e-7) << "smooth everywhere else";
  EXPECT_LE(gap, 1e-14) << "and in one piece";
  return sharpest;
}

TEST(Sec2_SharpEdges, StartAndEndInAnOtherwiseSmoothSurface) {
  const double triangles = look_at_all_edges(data::named_mesh("bumpy-crease:200"));
  const double quads = look_at_all_edges(data::named_mesh("open-crease"));
  record("{:.0f}", triangles, "degrees_between_the_sides_loop");
  record("{:.0f}", quads, "degrees_between_the_sides_catmull_clark");
}

}  // namespace
}  // namespace limitcheck::verify
