// SPDX-License-Identifier: MIT
// What sharp edges do to a surface, whatever its numbers; both schemes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/random_mesh.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/surgery.h"
#include "data/shapes.h"
#include "data/splitmix64.h"
#include "reference/catmull_clark/recursion.h"
#include "reference/loop/recursion.h"
#include "reference/number/number_exact.h"
#include "reference/surface/surface.h"
#include "reference/surface/test_methods.h"

namespace limitcheck::reference {
namespace {

using data::ControlMesh;
namespace cc = catmull_clark;

using Exact = cc::SubdivisionEvaluator<Rational>;
Exact exact(const ControlMesh& mesh) {
  return Exact(mesh.faces, positions_of<Rational>(mesh), mesh.sharpness);
}

// Parameters in the faces, on edges and at corners.
const std::vector<std::array<const char*, 2>>& places() {
  static const std::vector<std::array<const char*, 2>> all{
      {"1/3", "1/4"}, {"0", "1/3"}, {"1", "2/3"}, {"1/5", "0"},   {"7/8", "1"},      {"0", "0"},
      {"1", "0"},     {"1", "1"},   {"0", "1"},   {"1/2", "1/2"}, {"1/300", "1/200"}};
  return all;
}

void expect_same(const SurfacePoint<Rational>& a, const SurfacePoint<Rational>& b, const std::string& what) {
  EXPECT_EQ(a.position, b.position) << what;
  EXPECT_EQ(a.first_exist, b.first_exist) << what;
  EXPECT_TRUE(!a.first_exist || (a.d1 == b.d1 && a.d2 == b.d2)) << what;
  EXPECT_TRUE(!a.second_exist || (a.d11 == b.d11 && a.d12 == b.d12 && a.d22 == b.d22)) << what;
}

void expect_same_surface(const ControlMesh& a, const ControlMesh& b) {
  const Exact left = exact(a), right = exact(b);
  for (int f = 0; f < left.face_count(); ++f)
    for (const auto& [u, v] : places())
      expect_same(left.evaluate(f, 0, Parameter::parse(u), Parameter::parse(v)),
                  right.evaluate(f, 0, Parameter::parse(u), Parameter::parse(v)),
                  "face " + std::to_string(f) + " (" + u + ", " + v + ")");
}

// Each vertex of the crease becomes two; the faces on one side take the copies.
TEST(SharpEdges, AClosedCreaseIsABoundaryOnEitherSide) {
  const ControlMesh creased = data::crease_ring(10);
  ControlMesh cut = creased;
  cut.sharpness = {};
  for (std::size_t f = 0; f < cut.faces.size(); ++f) {
    const auto face = cut.faces[f];
    bool other_side = false;  // of the crease at 0, 6, 12, ..: the side of 5, 11, 17, ..
    for (const std::int32_t v : face) other_side = other_side || v % 6 == 5;
    if (!other_side) continue;
    for (std::int32_t& v : cut.faces[f])
      if (v % 6 == 0) v = static_cast<std::int32_t>(creased.positions.size()) + v / 6;
  }
  for (std::size_t v = 0; v < creased.positions.size(); v += 6) cut.positions.push_back(creased.positions[v]);
  expect_same_surface(creased, cut);
}

TEST(SharpEdges, AlongTheBoundaryChangeNothing) {
  ControlMesh plain = data::quad_fan(3, 5), tagged = plain;
  const Topology topology(plain.positions.size(), plain.faces);
  for (const Edge& e : topology.edges())
    if (e.on_boundary()) tagged.sharpness.edges.push_back({e.a, e.b, 10});
  expect_same_surface(plain, tagged);
  for (auto& e : tagged.sharpness.edges) e.sharpness = 1.5;
  expect_same_surface(plain, tagged);
  for (auto& e : tagged.sharpness.edges) e.sharpness = 0;
  expect_same_surface(plain, tagged);
}

TEST(SharpEdges, OfTenAndMoreAreInfinite) {
  ControlMesh ten = data::crease_ring(10), more = ten;
  for (auto& e : more.sharpness.edges) e.sharpness = std::numeric_limits<float>::infinity();
  expect_same_surface(ten, more);
}

// Of a crease of one sharpness: S(2.3) = 0.7 S(2) + 0.3 S(3), exactly.
TEST(SharpEdges, BetweenWholeSharpnessesTheSurfaceIsLinear) {
  const ControlMesh mesh = data::crease_ring(10);
  const auto surface = [&](const char* sharpness) {
    SharpTags tags;
    for (const auto& e : mesh.sharpness.edges) tags.edges.push_back({e.a, e.b, Parameter::parse(sharpness)});
    return Exact(mesh.faces, positions_of<Rational>(mesh), tags);
  };
  const Exact two = surface("2"), three = surface("3"), between = surface("23/10");
  for (const int f : {0, 5, 6})
    for (const auto& [u, v] : places()) {
      const auto at = [&, &u = u, &v = v](const Exact& s) {
        return s.evaluate(f, 0, Parameter::parse(u), Parameter::parse(v)).position;
      };
      EXPECT_EQ(at(between), at(two) * Rational(7, 10) + at(three) * Rational(3, 10)) << f << " " << u;
      if (f == 0 && v == std::string("0") && u == std::string("1/5")) {
        EXPECT_FALSE(at(two) == at(three));
      }
    }
}

// Faces that begin at another corner, and the mesh seen in a mirror.
TEST(SharpEdges, KnowNeitherFirstCornersNorHandedness) {
  for (const ControlMesh& mesh :
       {data::dart(5, false), data::corner(3, false), data::creased_cube(2), data::dart(4, false),
        data::with_random_sharpness(data::quad_wheel(6, 3), 4),
        data::with_random_sharpness(data::quad_fan(4, 3), 5)}) {
    ControlMesh turned = mesh, mirrored = mesh;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      for (std::size_t k = 0; k < 4; ++k) {
        turned.faces[f][k] = mesh.faces[f][(k + 1) % 4];
        mirrored.faces[f][k] = mesh.faces[f][(4 - k) % 4];
      }
    const Exact a = exact(mesh), b = exact(turned), c = exact(mirrored);
    for (int f = 0; f < a.face_count(); f += 2)
      for (const auto& [u, v] : places()) {
        const Parameter x = Parameter::parse(u), y = Parameter::parse(v);
        const auto p = a.evaluate(f, 0, x, y);
        EXPECT_EQ(p.position, b.evaluate(f, 0, y, Parameter::complement(x, 0.0)).position);
        EXPECT_EQ(p.position, c.evaluate(f, 0, y, x).position);
      }
  }
}

TEST(SharpEdges, OfAnyKindHaveOneSurfaceByBothMethods) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark}) {
      const bool loop = scheme == data::Scheme::kLoop;
      const ControlMesh mesh = data::with_random_sharpness(
          loop ? data::random_mesh(seed, {.faces = 60}) : data::mixed_mesh(seed, {.faces = 60}), seed);
      const Methods<Decimal50> by(mesh, scheme);
      data::SplitMix64 random(7);
      for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        for (int i = 0; i < 2; ++i) {
          const auto& place = places()[random.next() % places().size()];
          Rational u(place[0]), v(place[1]);
          if (loop) {  // from the square onto the triangle
            const Rational l1 = u * (1 - v / 2), l2 = v * (1 - u / 2), sum = l1 + l2;
            u = sum > 1 ? Rational(l1 / sum) : l1;
            v = sum > 1 ? Rational(l2 / sum) : l2;
          }
          const Parameter a = Parameter::parse(u.str()), b = Parameter::parse(v.str());
          const std::size_t corners = mesh.faces[f].size();
          const auto face = static_cast<int>(f);
          const auto corner = static_cast<int>(loop || corners == 4 ? 0 : random.next() % corners);
          expect_same(by.by_steps(face, corner, a, b), by.stam(face, corner, a, b), 9,
                      "seed " + std::to_string(seed) + " face " + std::to_string(f) + " (" + u.str() + ", " +
                          v.str() + ")");
        }
    }
}

// The recursion face by face and the limits of a refined mesh's vertices, near semi-sharp tags too.
TEST(SharpEdges, TheNaiveRecursionAndRefinedMeshesHaveTheSurfacesPoints) {
  using N = Decimal50;
  std::size_t looked_at = 0, normals = 0;
  const auto compare = [&](const ControlMesh& mesh, data::Scheme scheme, const std::string& what) {
    for (const int depth : {0, 1, 3})
      each_lattice_point<N>(
          mesh, scheme, depth,
          [&](const auto& naive, const auto& limits, std::size_t v, const auto& want) {
            ++looked_at;
            EXPECT_LE(magnitude(naive.position - want.position), N("1e-45")) << what << " depth " << depth;
            EXPECT_LE(magnitude(limits.positions[v] - want.position), N("1e-45"))
                << what << " depth " << depth;
            EXPECT_EQ(naive.normal_kind, want.normal_kind) << what << " depth " << depth;
            if (naive.normal_kind != NormalKind::kRegular || want.normal_kind != NormalKind::kRegular) return;
            ++normals;
            EXPECT_LE(magnitude(naive.normal - want.normal), N("1e-35")) << what << " depth " << depth;
          },
          3);
  };
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::string what = "seed " + std::to_string(seed);
    compare(data::with_random_sharpness(data::random_mesh(seed, {.faces = 40}), seed), data::Scheme::kLoop,
            what + " triangles");
    compare(data::with_random_sharpness(data::mixed_mesh(seed, {.faces = 40}), seed),
            data::Scheme::kCatmullClark, what);
  }
  compare(data::creased_cube(2), data::Scheme::kCatmullClark, "cube");
  compare(data::crease_ring(3), data::Scheme::kCatmullClark, "ring");
  for (const bool triangles : {false, true}) {
    const data::Scheme scheme = triangles ? data::Scheme::kLoop : data::Scheme::kCatmullClark;
    compare(data::dart(5, triangles), scheme, "dart");
    compare(data::corner(3, triangles), scheme, "corner");
  }
  EXPECT_GT(looked_at, 5000U);
  EXPECT_GT(normals, looked_at / 2);
}

// Chaikin's creasing keeps an edge below 1 sharp if both its halves stay so, which the edges at its far end
// decide: whichever face is asked, the vertex at its end goes to the same point.
TEST(SharpEdges, OfAllFacesAroundAVertexAskTheSameEdges) {
  using N = Decimal50;
  ControlMesh quads = data::crease_ring(10);
  quads.sharpness.edges = {{0, 6, 3.5F}, {6, 12, 0.25F}, {12, 18, 3.5F}};
  quads.sharpness.creasing = data::Creasing::kChaikin;
  ControlMesh triangles = quads;
  triangles.faces.clear();
  for (std::size_t f = 0; f < quads.faces.size(); ++f) {
    const auto q = quads.faces[f];
    triangles.faces.push_back({q[0], q[1], q[2]});
    triangles.faces.push_back({q[0], q[2], q[3]});
  }
  const cc::SubdivisionEvaluator<N> of_quads(quads.faces, positions_of<N>(quads), quads.sharpness);
  const SubdivisionEvaluator<N> of_triangles(triangles);
  const auto at_corner = [&](const ControlMesh& mesh, int f, int k) {
    const auto zero = Parameter(0), one = Parameter(1);
    return mesh.faces.are_triangles()
               ? of_triangles.evaluate(f, k == 1 ? one : zero, k == 2 ? one : zero).position
               : of_quads.evaluate(f, 0, k == 1 || k == 2 ? one : zero, k >= 2 ? one : zero).position;
  };
  for (const ControlMesh& mesh : {quads, triangles})
    for (const std::int32_t v : {0, 6, 12, 18}) {
      std::vector<Vec3<N>> seen;
      for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        for (std::size_t k = 0; k < mesh.faces[f].size(); ++k)
          if (mesh.faces[f][k] == v)
            seen.push_back(at_corner(mesh, static_cast<int>(f), static_cast<int>(k)));
      ASSERT_GE(seen.size(), 4U);
      for (const Vec3<N>& p : seen) EXPECT_LE(magnitude(p - seen[0]), N("1e-45")) << "vertex " << v;
    }
}

TEST(SharpEdges, ThatDoNotFitAreRefused) {
  const auto refused = [](const data::Sharpness& sharpness) {
    ControlMesh mesh = data::quad_cube();
    mesh.sharpness = sharpness;
    EXPECT_THROW(Surface(mesh, data::Scheme::kCatmullClark), data::ArgumentError);
  };
  const ControlMesh cube = data::quad_cube();
  const std::int32_t a = cube.faces[0][0], b = cube.faces[0][1], across = cube.faces[0][2];
  ControlMesh good = cube;
  good.sharpness = {.edges = {{a, b, 1}, {b, a, 1}}, .vertices = {{a, 1}}};
  EXPECT_NO_THROW(Surface(good, data::Scheme::kCatmullClark));
  refused({.edges = {{a, across, 1}}, .vertices = {}});
  refused({.edges = {{a, 8, 1}}, .vertices = {}});
  refused({.edges = {{a, b, -1}}, .vertices = {}});
  refused({.edges = {{a, b, std::numeric_limits<float>::quiet_NaN()}}, .vertices = {}});
  refused({.edges = {{a, b, 1}, {b, a, 2}}, .vertices = {}});
  refused({.edges = {}, .vertices = {{8, 1}}});
}

// A point on the last side of a face, whose coordinates are more than 1 by a last bit, where steps are taken
// for a tag nearby: it was refused.
TEST(SharpEdges, DoNotMakeRoundedSidesLieOutside) {
  const ControlMesh mesh = data::dart(3, true);
  const Surface surface(mesh, data::Scheme::kLoop);
  data::SplitMix64 random(1);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int i = 0; i < 2000; ++i) {
      const double l1 = random.unit(), l2 = 1 - l1;
      const auto p = surface.evaluate(static_cast<int>(f), 0, l1, l2),
                 q = surface.evaluate(static_cast<int>(f), 0, l2, l1);
      EXPECT_TRUE(std::isfinite(p.position.x) && std::isfinite(q.position.x)) << f << " " << l1;
    }
  }
  EXPECT_NO_THROW(surface.evaluate(2, 0, 0.72393962371015741, 0.27606037628984265));
}

}  // namespace
}  // namespace limitcheck::reference
