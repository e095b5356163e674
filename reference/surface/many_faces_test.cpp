// SPDX-License-Identifier: MIT
// Vertices of many faces: their evaluators take steps in place of closed forms, to the same surface.
// What a face costs does not grow with the faces around its vertex.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/shapes.h"
#include "reference/catmull_clark/recursion.h"
#include "reference/catmull_clark/stam.h"
#include "reference/catmull_clark/stam_impl.h"
#include "reference/loop/recursion.h"
#include "reference/loop/recursion_impl.h"
#include "reference/loop/refine_impl.h"
#include "reference/loop/ringed_face.h"
#include "reference/loop/stam.h"
#include "reference/loop/stam_impl.h"
#include "reference/number/number_exact.h"

namespace limitcheck::reference {

/// A double that counts what is done with it.
struct Counted {
  double value = 0;
  static inline long operations = 0;

  Counted() = default;
  explicit Counted(int a) : value(a) {}
  explicit Counted(double a) : value(a) {}
  Counted& operator+=(const Counted& b) { return *this = *this + b; }
  Counted& operator-=(const Counted& b) { return *this = *this - b; }
  Counted& operator*=(const Counted& b) { return *this = *this * b; }
  friend Counted operator+(const Counted& a, const Counted& b) { return did(a.value + b.value); }
  friend Counted operator-(const Counted& a, const Counted& b) { return did(a.value - b.value); }
  friend Counted operator*(const Counted& a, const Counted& b) { return did(a.value * b.value); }
  friend Counted operator/(const Counted& a, const Counted& b) { return did(a.value / b.value); }
  friend bool operator==(const Counted& a, const Counted& b) = default;
  friend bool operator<(const Counted& a, const Counted& b) { return a.value < b.value; }
  friend bool operator>(const Counted& a, const Counted& b) { return a.value > b.value; }

  static Counted did(double a) {
    ++operations;
    return Counted(a);
  }
};

template <>
struct NumberTraits<Counted> {
  using T = NumberTraits<double>;
  static Counted cos_pi(long p, long q) { return Counted::did(T::cos_pi(p, q)); }
  static Counted sqrt(const Counted& a) { return Counted::did(T::sqrt(a.value)); }
  static Counted cos(const Counted& a) { return Counted::did(T::cos(a.value)); }
  static Counted sin(const Counted& a) { return Counted::did(T::sin(a.value)); }
  static long exponent(const Counted& a) { return T::exponent(a.value); }
  static Counted scale(const Counted& a, long e) { return Counted(T::scale(a.value, e)); }
  static constexpr double kNormalThreshold = T::kNormalThreshold;
  static constexpr double kRounding = T::kRounding;
  static long precision() { return 53; }
  static Counted from_double(double a) { return Counted(a); }
  static Counted from_rational(const Rational& a) { return Counted(a.convert_to<double>()); }
  static double approximate(const Counted& a) { return a.value; }
};

namespace {

using data::ControlMesh;
namespace cc = catmull_clark;

ControlMesh held(ControlMesh mesh, std::int32_t vertex) {
  mesh.sharpness.vertices.push_back({vertex, 10});
  return mesh;
}

/// The vertex of the most faces.
std::int32_t hub(const ControlMesh& mesh) {
  std::vector<int> faces(mesh.positions.size());
  for (const std::int32_t v : mesh.faces.corners()) ++faces[static_cast<std::size_t>(v)];
  return static_cast<std::int32_t>(std::max_element(faces.begin(), faces.end()) - faces.begin());
}

struct Shape {
  std::string name;
  ControlMesh mesh;
};

std::vector<Shape> triangles(int n) {
  const ControlMesh wheel = data::wheel(n), fan = data::fan(n);
  return {{"wheel", wheel},
          {"fan", fan},
          {"dart", data::dart(n, true)},
          {"cone", held(wheel, hub(wheel))},
          {"held fan", held(fan, hub(fan))}};
}
std::vector<Shape> quads(int n) {
  const ControlMesh wheel = data::quad_wheel(n, 7), fan = data::quad_fan(n, 11);
  return {{"quad wheel", wheel},
          {"quad fan", fan},
          {"quad dart", data::dart(n, false)},
          {"quad cone", held(wheel, hub(wheel))},
          {"held quad fan", held(fan, hub(fan))}};
}

/// Operations for the evaluator itself and five points of each face.
template <class Make>
long operations(const ControlMesh& mesh, const Make& make) {
  Counted::operations = 0;
  const auto evaluator = make(mesh);
  for (int f = 0; f < static_cast<int>(mesh.faces.size()); ++f)
    for (const auto& [a, b] : {std::pair{0., 0.}, {1., 0.}, {0., 1.}, {.03, .04}, {.3, .4}})
      evaluator(f, a, b);
  return Counted::operations;
}

/// Four times as many faces cost four times as much. Not at darts, which hear of all.
template <class Make>
void expect_linear(const std::vector<Shape>& few, const std::vector<Shape>& many, const Make& make) {
  for (std::size_t i = 0; i < few.size(); ++i) {
    if (few[i].name.ends_with("dart")) continue;
    const auto per_face = [&](const ControlMesh& mesh) {
      return static_cast<double>(operations(mesh, make)) / static_cast<double>(mesh.faces.size());
    };
    EXPECT_LT(per_face(many[i].mesh), 1.1 * per_face(few[i].mesh)) << few[i].name;
  }
}

/// Where closed forms end (loop/stepped_ring.h, catmull_clark/two_ring.h).
constexpr int kManyFaces = 65;

/// Parameters of a face seen from its corner k, from the corner itself to the middle.
struct Place {
  const char *along, *across;
};
constexpr Place kPlaces[] = {{"0", "0"}, {"1/3", "1/4"}, {"1/5", "0"}, {"1/300", "1/200"}, {"0", "1/5000"}};

/// (l1, l2) or (u, v) of a place at corner k.
std::array<Parameter, 2> at(const Place& place, std::size_t k, std::size_t corners) {
  const Rational x(place.along), y(place.across);
  std::array<Rational, 2> p{x, y};
  if (corners == 3)
    p = k == 0   ? std::array{x, y}
        : k == 1 ? std::array{Rational(1 - x - y), x}
                 : std::array{y, Rational(1 - x - y)};
  else if (k != 0)
    p = k == 1   ? std::array{Rational(1 - y), x}
        : k == 2 ? std::array{Rational(1 - x), Rational(1 - y)}
                 : std::array{y, Rational(1 - x)};
  return {Parameter::parse(p[0].str()), Parameter::parse(p[1].str())};
}

/// All around the hub in steps, and the faces at both ends: what the two evaluators say, in fifty digits. At
/// 1/5000 subdivision takes 13 steps, and differences of order d between points 2^-13 apart lose 4 d digits.
template <class Stam, class Subdivision>
void expect_same(const Stam& stam, const Subdivision& subdivision, const Shape& shape) {
  using N = Decimal50;
  const std::int32_t centre = hub(shape.mesh);
  std::vector<std::size_t> around;
  for (std::size_t f = 0; f < shape.mesh.faces.size(); ++f)
    if (std::ranges::count(shape.mesh.faces[f], centre) > 0) around.push_back(f);
  for (std::size_t i = 0; i < around.size(); i += i < 2 || i + 4 > around.size() ? 1 : 7) {
    const auto corners = shape.mesh.faces[around[i]];
    const auto k = static_cast<std::size_t>(std::ranges::find(corners, centre) - corners.begin());
    for (const Place& place : kPlaces) {
      const auto [u, v] = at(place, k, corners.size());
      const SurfacePoint<N> p = stam(static_cast<int>(around[i]), u, v),
                            q = subdivision(static_cast<int>(around[i]), u, v);
      const auto compare = [&](const Vec3<N>& a, const Vec3<N>& b, const char* what, const N& bound) {
        EXPECT_LE(magnitude(a - b), bound * (N(1) + magnitude(b)))
            << shape.name << " face " << around[i] << " (" << place.along << ", " << place.across << ") "
            << what;
      };
      compare(p.position, q.position, "position", N("1e-47"));
      EXPECT_EQ(p.normal_kind, q.normal_kind) << shape.name << " " << place.along;
      EXPECT_EQ(p.first_exist, q.first_exist);
      EXPECT_EQ(p.second_exist, q.second_exist);
      if (p.normal_kind == NormalKind::kRegular) compare(p.normal, q.normal, "normal", N("1e-40"));
      if (p.first_exist) compare(p.d1, q.d1, "d1", N("1e-43")), compare(p.d2, q.d2, "d2", N("1e-43"));
      if (p.second_exist)
        compare(p.d11, q.d11, "d11", N("1e-39")), compare(p.d12, q.d12, "d12", N("1e-39")),
            compare(p.d22, q.d22, "d22", N("1e-39"));
    }
  }
}

TEST(ManyFaces, HaveTheSurfaceOfSubdivision) {
  using N = Decimal50;
  for (const int n : {kManyFaces - 1, kManyFaces, 90}) {
    for (const Shape& s : triangles(n)) {
      const StamEvaluator<N> stam(s.mesh);
      const SubdivisionEvaluator<N> subdivision(s.mesh);
      expect_same([&](int f, const auto& a, const auto& b) { return stam.evaluate(f, a, b); },
                  [&](int f, const auto& a, const auto& b) { return subdivision.evaluate(f, a, b); }, s);
    }
    for (const Shape& s : quads(n)) {
      const cc::StamEvaluator<N> stam(s.mesh.faces, positions_of<N>(s.mesh), s.mesh.sharpness);
      const cc::SubdivisionEvaluator<N> subdivision(s.mesh.faces, positions_of<N>(s.mesh), s.mesh.sharpness);
      expect_same([&](int f, const auto& a, const auto& b) { return stam.evaluate(f, 0, a, b); },
                  [&](int f, const auto& a, const auto& b) { return subdivision.evaluate(f, 0, a, b); }, s);
    }
  }
}

/// Around a vertex of many faces the naive subdivider works out a ring once for all of them. Each by itself:
void subdivide_alone(const RingedFace<Vec3<double>>& face, int depth, std::vector<Vec3<double>>& out) {
  if (depth == 0) {
    for (const auto& c : face.corner) {
      const auto limit = vertex_limit<double>(c.point, c.span(), c.on_boundary);
      out.insert(out.end(), {limit.position, limit.normal.direction});
    }
    return;
  }
  const SubdividedFace<double> next(face);
  for (int k = 0; k < 4; ++k) subdivide_alone(next.subface(k), depth - 1, out);
}

TEST(ManyFaces, HaveTheBitsThatTheNaiveSubdividerGivesEachByItself) {
  for (const data::ControlMesh& mesh : {data::bipyramid(300), data::wheel(250)}) {
    const NaiveSubdivider<double> naive(mesh);
    const Topology topology(mesh.positions.size(), mesh.faces);
    for (std::size_t f = 0; f < naive.face_count(); f += 17) {
      std::vector<Vec3<double>> alone, together;
      subdivide_alone(gather_triangle<double>(topology, positions_of<double>(mesh), f), 3, alone);
      naive.tessellate(f, 3, [&](const LeafTriangle<double>& leaf) {
        for (const auto& c : leaf) together.insert(together.end(), {c.position, c.normal});
      });
      ASSERT_EQ(alone.size(), together.size());
      for (std::size_t k = 0; k < alone.size(); ++k)
        ASSERT_TRUE(alone[k].x == together[k].x && alone[k].y == together[k].y && alone[k].z == together[k].z)
            << f << ' ' << k;
    }
  }
}

/// In double against a hundred digits, down to 1e-300 from the vertex.
TEST(ManyFaces, LoseNoDigitsTowardsTheVertex) {
  using N = Decimal100;
  const auto expect_near = [](const Vec3<double>& a, const Vec3<N>& b, const std::string& what) {
    const N size = std::max(magnitude(b), N("1e-300"));
    const Vec3<N> wide{N(a.x), N(a.y), N(a.z)};
    const auto error = N(magnitude(wide - b) / size).convert_to<double>();
    EXPECT_LE(error, StamError::kNearCorner) << what;
  };
  const auto compare = [&](const SurfacePoint<double>& p, const SurfacePoint<N>& q, const std::string& what) {
    expect_near(p.position, q.position, what + " position");
    expect_near(p.d1, q.d1, what + " d1");
    expect_near(p.d2, q.d2, what + " d2");
    if (q.normal_kind == NormalKind::kRegular && p.normal_kind == NormalKind::kRegular &&
        q.normal_condition < 1e6)
      expect_near(p.normal, q.normal, what + " normal");
  };
  for (const double near : {1e-3, 1e-30, 1e-300}) {
    for (const Shape& s : triangles(100)) {
      const StamEvaluator<double> rounded(s.mesh);
      const StamEvaluator<N> exact(s.mesh);
      const std::int32_t centre = hub(s.mesh);
      for (int f = 0; f < 4; ++f)
        if (s.mesh.faces[static_cast<std::size_t>(f)][0] == centre)
          compare(rounded.evaluate(f, near, near / 3), exact.evaluate(f, near, near / 3), s.name);
    }
    for (const Shape& s : quads(100)) {
      const cc::StamEvaluator<double> rounded(s.mesh.faces, positions_of<double>(s.mesh), s.mesh.sharpness);
      const cc::StamEvaluator<N> exact(s.mesh.faces, positions_of<N>(s.mesh), s.mesh.sharpness);
      const std::int32_t centre = hub(s.mesh);
      for (int f = 0; f < 4; ++f)
        if (s.mesh.faces[static_cast<std::size_t>(f)][0] == centre)
          compare(rounded.evaluate(f, 0, near, near / 3), exact.evaluate(f, 0, near, near / 3), s.name);
    }
  }
}

TEST(ManyFacesOfLoop, CostNoMoreEachThanFewer) {
  expect_linear(triangles(250), triangles(1000), [](const ControlMesh& mesh) {
    return [e = std::make_shared<StamEvaluator<Counted>>(mesh)](int f, double a, double b) {
      (void)e->evaluate(f, a, b);
    };
  });
}

TEST(ManyFacesOfLoop, CostTheNaiveSubdividerNoMoreEachThanFewer) {
  const auto wheel = [](int n) { return std::vector<Shape>{triangles(n)[0]}; };
  expect_linear(wheel(250), wheel(1000), [](const ControlMesh& mesh) {
    return [e = std::make_shared<NaiveSubdivider<Counted>>(mesh)](int f, double, double) {
      e->tessellate(static_cast<std::size_t>(f), 1, [](const auto&) {});
    };
  });
}

TEST(ManyFacesOfCatmullClark, CostNoMoreEachThanFewer) {
  expect_linear(quads(250), quads(1000), [](const ControlMesh& mesh) {
    return [e = std::make_shared<cc::StamEvaluator<Counted>>(mesh.faces, positions_of<Counted>(mesh),
                                                             mesh.sharpness)](int f, double a, double b) {
      (void)e->evaluate(f, 0, a, b);
    };
  });
}

}  // namespace
}  // namespace limitcheck::reference
