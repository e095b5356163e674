// SPDX-License-Identifier: MIT
// Two methods of different kind, and three precisions, against each other: on every stock shape, at fans of 1
// to 13 faces, at hubs of valence 3 to 200, down to 1e-300 from the vertex.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data/generators/named_mesh.h"
#include "data/shapes.h"
#include "reference/loop/recursion.h"
#include "reference/loop/refine.h"
#include "reference/loop/stam.h"
#include "reference/number/number_exact.h"
#include "reference/point/normal.h"

namespace limitcheck::reference {
namespace {

using Big = Decimal100;

template <class N>
Vec3<Big> big(const Vec3<N>& a) {
  return {Big(a.x), Big(a.y), Big(a.z)};
}
Big length(const Vec3<Big>& a) {
  return sqrt(dot(a, a));
}

/// |got - expected| / |expected|, or the distance itself where expected is tiny in the mesh (coordinates are
/// about 1).
template <class N>
double error(const Vec3<N>& got, const Vec3<Big>& expected) {
  const Big size = sqrt(dot(expected, expected));
  const Vec3<Big> d = big(got) - expected;
  const Big distance = sqrt(dot(d, d));
  return static_cast<Big>(size > 0 ? Big(distance / size) : distance).template convert_to<double>();
}

/// Points of a face: inside, on edges, corners, dyadic, near corners and edges.
std::vector<std::array<Parameter, 2>> points(const std::string& near) {
  const auto p = [](const char* a, const char* b) {
    return std::array{Parameter::parse(a), Parameter::parse(b)};
  };
  const Parameter tiny = Parameter::parse(near);
  std::vector<std::array<Parameter, 2>> result{
      p("1/3", "1/3"),  p("1/4", "1/4"),   p("1/2", "1/2"),    p("1/2", "0"),       p("0", "3/8"),
      p("0.7", "0.3"),  p("1/7", "5/7"),   p("0.03", "0.005"), p("0.985", "0.004"), p("0.001", "0.998"),
      p("1/1024", "0"), p("0", "1/65536"), p("3/4", "1/4"),    p("5/8", "1/8")};
  result.push_back({tiny, Parameter::parse("0")});
  result.push_back({Parameter::parse("0"), tiny});
  result.push_back({tiny, tiny});
  return result;
}

/// Everything of two points.
template <class A>
void expect_same(const SurfacePoint<A>& a, const SurfacePoint<Big>& b, double tolerance, double& worst,
                 const std::string& where) {
  const auto check = [&](const Vec3<A>& x, const Vec3<Big>& y, const char* what, const Big& size) {
    const double e = static_cast<Big>(length(big(x) - y) / size).convert_to<double>();
    worst = std::max(worst, e);
    EXPECT_LE(e, tolerance) << where << ": " << what << " " << x.x << " " << x.y << " " << x.z << " against "
                            << y.x;
  };
  check(a.position, b.position, "position", 1);
  ASSERT_EQ(a.first_exist, b.first_exist) << where;
  ASSERT_EQ(a.second_exist, b.second_exist) << where;
  ASSERT_EQ(a.at_corner, b.at_corner) << where;
  const Big tangent = std::max(length(b.t1), length(b.t2));
  check(a.t1, b.t1, "t1", tangent);
  check(a.t2, b.t2, "t2", tangent);
  const Big first = std::max({length(b.d1), length(b.d2), Big(1e-300)});
  check(a.d1, b.d1, "d1", first);
  check(a.d2, b.d2, "d2", first);
  if (b.second_exist) {
    const Big second = std::max({length(b.d11), length(b.d12), length(b.d22), Big(1e-30)});
    check(a.d11, b.d11, "d11", second);
    check(a.d12, b.d12, "d12", second);
    check(a.d22, b.d22, "d22", second);
  }
  EXPECT_EQ(a.normal_kind, b.normal_kind) << where;
  check(a.normal, b.normal, "normal", 1);
}

std::vector<std::string> shapes() {
  std::vector<std::string> result = data::stock_shapes();
  for (int k = 1; k <= 13; ++k) result.push_back("fan:" + std::to_string(k));
  for (const int k : {18, 24}) result.push_back("fan:" + std::to_string(k));
  for (const int n : {3, 4, 5, 7, 8, 9, 12, 20, 50}) result.push_back("wheel:" + std::to_string(n));
  return result;
}

TEST(Evaluators, StamEqualsSubdivisionOnEveryShapeToNinetyDigits) {
  double worst = 0;
  for (const std::string& name : shapes()) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const StamEvaluator<Big> stam(mesh);
    const SubdivisionEvaluator<Big> subdivision(mesh);
    const int faces = std::min(stam.face_count(), 8);
    for (int i = 0; i < faces; ++i) {
      const int face = i * stam.face_count() / faces;
      for (const auto& [l1, l2] : points("1e-7")) {
        const std::string where =
            name + " face " + std::to_string(face) + " (" + l1.to_string() + ", " + l2.to_string() + ")";
        expect_same(stam.evaluate(face, l1, l2), subdivision.evaluate(face, l1, l2), 1e-80, worst, where);
      }
    }
  }
  RecordProperty("worst", std::to_string(worst));
  std::printf("worst relative difference %.2g\n", worst);
}

TEST(Evaluators, CornersAndTheirSurroundingsAgree) {
  // At every corner of every face, exactly.
  double worst = 0;
  for (const std::string& name : shapes()) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const StamEvaluator<Big> stam(mesh);
    const SubdivisionEvaluator<Big> subdivision(mesh);
    for (int face = 0; face < std::min(stam.face_count(), 40); ++face)
      for (const auto& [a, b] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}) {
        const std::string where =
            name + " face " + std::to_string(face) + " corner " + std::to_string(a) + std::to_string(b);
        expect_same(stam.evaluate(face, a, b), subdivision.evaluate(face, a, b), 1e-80, worst, where);
      }
  }
  std::printf("worst relative difference %.2g\n", worst);
}

TEST(Evaluators, DerivativesAreThoseOfThePositionsExactly) {
  // The surface is a quartic on every small enough neighbourhood: these differences have no error.
  const Parameter l1 = Parameter::parse("0.29"), l2 = Parameter::parse("0.13");
  const Rational h(1, 1000000);
  const auto shifted = [&](int i, int j) {
    const auto text = [](const Rational& a) { return Parameter::parse(a.str()); };
    return std::array{text(Rational(29, 100) + i * h), text(Rational(13, 100) + j * h)};
  };
  for (const std::string name : {"wheel:7", "fan:5", "torus:4:4", "triangle", "tetrahedron"}) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const auto check = [&](const auto& evaluator) {
      const auto at = [&](int i, int j) {
        const auto p = shifted(i, j);
        return evaluator.evaluate(0, p[0], p[1]);
      };
      const auto first = [&](auto along) {
        return (along(1) - along(-1)) * (Big(2) / Big(3) / Big(h)) -
               (along(2) - along(-2)) * (Big(1) / Big(12) / Big(h));
      };
      const auto s = evaluator.evaluate(0, l1, l2);
      const auto expect = [&](const Vec3<Big>& got, const Vec3<Big>& want, const char* what) {
        EXPECT_LE(length(got - want), Big("1e-80")) << name << " " << what;
      };
      expect(s.d1, first([&](int i) { return at(i, 0).position; }), "d1");
      expect(s.d2, first([&](int j) { return at(0, j).position; }), "d2");
      expect(s.d11, first([&](int i) { return at(i, 0).d1; }), "d11");
      expect(s.d12, first([&](int i) { return at(i, 0).d2; }), "d12");
      expect(s.d12, first([&](int j) { return at(0, j).d1; }), "d21");
      expect(s.d22, first([&](int j) { return at(0, j).d2; }), "d22");
    };
    check(StamEvaluator<Big>(mesh));
    check(SubdivisionEvaluator<Big>(mesh));
  }
}

TEST(Evaluators, TakeDoublesWhoseSumIsRoundedToOne) {
  const data::ControlMesh mesh = data::tetrahedron();
  double worst = 0;  // 0.1 + 0.9 exceeds 1 by 2^-55
  expect_same(StamEvaluator<Big>(mesh).evaluate(0, 0.1, 0.9),
              SubdivisionEvaluator<Big>(mesh).evaluate(0, 0.1, 0.9), 1e-80, worst, "edge");
}

TEST(Evaluators, TheMapOfAnExtraordinaryCornerPointsAlongTheEdges) {
  // Seen from the corner, a point of the edge 2^-60 away lies in the direction of d1 (d2).
  for (const int n : {3, 5, 7}) {
    const data::ControlMesh mesh = data::wheel(n);
    const StamEvaluator<Big> stam(mesh);
    for (int face = 0; face < stam.face_count(); ++face) {
      if (mesh.faces[face][0] != 0) continue;
      const auto corner = stam.evaluate(face, 0.0, 0.0);
      const Vec3<Big> first = stam.evaluate(face, 0x1p-60, 0.0).position - corner.position;
      const Vec3<Big> second = stam.evaluate(face, 0.0, 0x1p-60).position - corner.position;
      EXPECT_LE(length(unit(first) - unit(corner.t1)), Big("1e-12")) << n;
      EXPECT_LE(length(unit(second) - unit(corner.t2)), Big("1e-12")) << n;
    }
  }
}

/// The first face that has vertex 0 as its corner 0, for every place it can have around vertex 0.
std::vector<int> faces_of_the_hub(const data::ControlMesh& mesh) {
  std::vector<int> faces;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.faces[f][0] == 0) faces.push_back(static_cast<int>(f));
  return faces;
}

// Derivatives of order d grow like (2^d mu)^J towards the corner, mu the largest eigenvalue below 1
// (two_ring.h): of those that exist what is left falls like the next eigenvalue, the others grow at
// this rate.
TEST(Evaluators, DerivativesAtExtraordinaryCornersAreWhatTheyTendToOrDoNotExist) {
  struct Corner {
    const char* mesh;
    bool first, second;
    double first_rate, second_rate;  // per halving of the distance: of what is left, or of the growth
  };
  const auto subdominant = [](int n) { return 3. / 8 + std::cos(2 * std::numbers::pi / n) / 4; };
  const auto sine_mode = [](int k) { return 3. / 8 + std::cos(std::numbers::pi / k) / 4; };
  const Corner corners[] = {{"wheel:3", true, true, 2 * subdominant(3), 4. / 8},
                            {"tetrahedron", true, true, 2 * subdominant(3), 4. / 8},
                            {"wheel:4", true, false, 2 * subdominant(4), 4 * subdominant(4)},
                            {"wheel:5", true, false, 2 * subdominant(5), 4 * subdominant(5)},
                            {"wheel:7", false, false, 2 * subdominant(7), 4 * subdominant(7)},
                            {"wheel:12", false, false, 2 * subdominant(12), 4 * subdominant(12)},
                            {"fan:1", true, true, 2. / 4, 4. / 8},
                            {"fan:2", true, false, 2 * sine_mode(2), 4 * sine_mode(2)},
                            {"fan:4", false, false, 2 * sine_mode(4), 4 * sine_mode(4)},
                            {"fan:7", false, false, 2 * sine_mode(7), 4 * sine_mode(7)}};
  for (const Corner& c : corners) {
    data::ControlMesh mesh = data::named_mesh(c.mesh);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)  // no symmetry, no flat side
      for (std::size_t k = 0; k < 3; ++k)
        mesh.positions[v][k] += 0x1p-6 * static_cast<double>((7 * v + 3 * k) % 11);
    const StamEvaluator<Big> stam(mesh);
    for (const int face : faces_of_the_hub(mesh)) {
      const auto near = [&](int halvings) {
        const double h = std::ldexp(1., -halvings);
        return stam.evaluate(face, h, 0.375 * h);
      };
      const auto at = stam.evaluate(face, 0.0, 0.0), far = near(900), close = near(901);
      EXPECT_EQ(at.first_exist, c.first) << c.mesh;
      EXPECT_EQ(at.second_exist, c.second) << c.mesh;
      const auto follow = [&](const Vec3<Big>& limit, const Vec3<Big>& a, const Vec3<Big>& b, bool exists,
                              double rate, const char* what) {
        if (exists)
          EXPECT_LE(length(b - limit), 1000 * pow(Big(rate), 900) + length(limit) * Big("1e-96"))
              << c.mesh << " face " << face << ' ' << what;
        else
          EXPECT_NEAR(static_cast<Big>(length(b) / length(a)).convert_to<double>(), rate, 1e-9)
              << c.mesh << " face " << face << ' ' << what;
      };
      follow(at.d1, far.d1, close.d1, c.first, c.first_rate, "d1");
      follow(at.d2, far.d2, close.d2, c.first, c.first_rate, "d2");
      follow(at.d11, far.d11, close.d11, c.second, c.second_rate, "d11");
      follow(at.d12, far.d12, close.d12, c.second, c.second_rate, "d12");
      follow(at.d22, far.d22, close.d22, c.second, c.second_rate, "d22");
    }
  }
}

// The two families have one surface at valences 3 and 6 and at the boundary, and another elsewhere.
TEST(Evaluators, StamEqualsSubdivisionAndRefinementUnderWarrensWeights) {
  double worst = 0;
  for (const std::string name : {"tetrahedron", "octahedron", "icosahedron", "bipyramid:7", "wheel:3",
                                 "wheel:4", "wheel:5", "wheel:7", "wheel:8", "wheel:50", "fan:4", "holes"}) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const StamEvaluator<Big> stam(mesh, Weights::kWarren), loop(mesh);
    const SubdivisionEvaluator<Big> subdivision(mesh, Weights::kWarren);
    const auto refined = refine<Big>(mesh, 2, Weights::kWarren);
    const auto limits = refined.limits();
    Big most = 0;
    const int faces = std::min(stam.face_count(), 8);
    for (int i = 0; i < faces; ++i) {
      const int face = i * stam.face_count() / faces;
      for (const auto& [l1, l2] : points("1e-7")) {
        const std::string where =
            name + " face " + std::to_string(face) + " (" + l1.to_string() + ", " + l2.to_string() + ")";
        const auto p = stam.evaluate(face, l1, l2);
        expect_same(p, subdivision.evaluate(face, l1, l2), 1e-80, worst, where);
        most =
            std::max(most, length(p.position - loop.evaluate(face, l1, l2, Derivatives::kPosition).position));
      }
      for (const auto& [i1, i2] : {std::pair{0, 0}, {4, 0}, {0, 4}, {1, 0}, {1, 2}, {1, 1}}) {
        const auto v = refined.vertex(face, i1, i2);
        const auto p = stam.evaluate(face, i1 / 4., i2 / 4., Derivatives::kFirst);
        EXPECT_LE(length(p.position - limits.positions[v]), Big("1e-90")) << name;
        EXPECT_LE(length(p.normal - limits.normals[v]), Big("1e-90")) << name;
      }
    }
    const bool same = name == "tetrahedron" || name == "wheel:3" || name == "fan:4" || name == "holes";
    EXPECT_EQ(most < Big("1e-90"), same) << name << ' ' << most;
  }
  std::printf("worst relative difference %.2g\n", worst);
}

/// A hub and a point 10^-e away from it, in the face's corner 0.
TEST(Evaluators, StamStaysExactDownTo1e300FromTheVertex) {
  double worst50 = 0, worst_double = 0, worst_normal = 0;
  std::string worst_where;
  for (const std::string name :
       {"wheel:3", "wheel:4", "wheel:5", "wheel:7", "wheel:12", "wheel:50", "wheel:200", "fan:1", "fan:2",
        "fan:4", "fan:5", "fan:6", "fan:7", "fan:9", "fan:12", "tetrahedron", "triangle", "octahedron"}) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const StamEvaluator<Big> exact(mesh);
    const StamEvaluator<Decimal50> fifty(mesh);
    const StamEvaluator<double> fast(mesh);
    int face = 0;
    for (int f = 0; f < exact.face_count(); ++f)
      if (mesh.faces[f][0] == 0) face = f;
    for (const double distance : {1e-3, 1e-8, 1e-16, 1e-60, 1e-300}) {
      const double l1 = distance, l2 = 0.375 * distance;
      const auto truth = exact.evaluate(face, l1, l2);
      const std::string where = name + " at " + std::to_string(std::log10(distance));
      expect_same(fifty.evaluate(face, l1, l2), truth, 1e-40, worst50, where);
      const auto d = fast.evaluate(face, l1, l2);
      for (const auto& [got, want] :
           {std::pair{d.position, truth.position}, {d.d1, truth.d1}, {d.d2, truth.d2}}) {
        const double e = error(got, want);
        if (e > worst_double) {
          worst_double = e;
          worst_where = where;
        }
        EXPECT_LE(e, StamError::kNearCorner) << where;
      }
      const double n = error(d.normal, truth.normal);
      worst_normal = std::max(worst_normal, n);
      EXPECT_LE(n, StamError::kNormal) << where;
    }
  }
  std::printf("worst 50-digit %.2g, double %.2g (%s), normal %.2g\n", worst50, worst_double,
              worst_where.c_str(), worst_normal);
}

}  // namespace
}  // namespace limitcheck::reference
