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
#include "reference/catmull_clark/stam_impl.h"
#include "reference/loop/recursion_impl.h"
#include "reference/loop/refine_impl.h"
#include "reference/loop/ringed_face.h"
#include "reference/loop/stam_impl.h"
#include "reference/number/number_exact.h"
#include "reference/surface/test_methods.h"

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

std::vector<Shape> shapes(int n, data::Scheme scheme) {
  const bool loop = scheme == data::Scheme::kLoop;
  const ControlMesh wheel = loop ? data::wheel(n) : data::quad_wheel(n, 7),
                    fan = loop ? data::fan(n) : data::quad_fan(n, 11);
  return {{"wheel", wheel},
          {"fan", fan},
          {"dart", data::dart(n, loop)},
          {"cone", held(wheel, hub(wheel))},
          {"held fan", held(fan, hub(fan))}};
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

/// All around the hub in steps, and the faces at both ends; at 1/5000 subdivision takes 13 steps.
TEST(ManyFaces, HaveTheSurfaceOfSubdivision) {
  const std::array<Rational, 2> places[] = {{0, 0},
                                            {Rational(1, 3), Rational(1, 4)},
                                            {Rational(1, 5), 0},
                                            {Rational(1, 300), Rational(1, 200)},
                                            {0, Rational(1, 5000)}};
  for (const int n : {kManyFaces - 1, kManyFaces, 90})
    for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark})
      for (const Shape& s : shapes(n, scheme)) {
        const Methods<Decimal50> by(s.mesh, scheme);
        const std::int32_t centre = hub(s.mesh);
        std::vector<std::size_t> around;
        for (std::size_t f = 0; f < s.mesh.faces.size(); ++f)
          if (std::ranges::count(s.mesh.faces[f], centre) > 0) around.push_back(f);
        for (std::size_t i = 0; i < around.size(); i += i < 2 || i + 4 > around.size() ? 1 : 7)
          for (const auto& [x, y] : places) {
            const auto corners = s.mesh.faces[around[i]];
            const auto k = static_cast<std::size_t>(std::ranges::find(corners, centre) - corners.begin());
            const auto [u, v] = seen_from(k, corners.size(), x, y);
            const auto face = static_cast<int>(around[i]);
            expect_same(by.stam(face, 0, u, v), by.by_steps(face, 0, u, v), 13,
                        s.name + " face " + std::to_string(face) + " " + x.str() + " " + y.str());
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
      EXPECT_EQ(alone, together) << f;
    }
  }
}

TEST(ManyFacesOfLoop, CostNoMoreEachThanFewer) {
  expect_linear(shapes(250, data::Scheme::kLoop), shapes(1000, data::Scheme::kLoop),
                [](const ControlMesh& mesh) {
                  return [e = std::make_shared<StamEvaluator<Counted>>(mesh)](int f, double a, double b) {
                    (void)e->evaluate(f, a, b);
                  };
                });
}

TEST(ManyFacesOfLoop, CostTheNaiveSubdividerNoMoreEachThanFewer) {
  const auto wheel = [](int n) { return std::vector<Shape>{shapes(n, data::Scheme::kLoop)[0]}; };
  expect_linear(wheel(250), wheel(1000), [](const ControlMesh& mesh) {
    return [e = std::make_shared<NaiveSubdivider<Counted>>(mesh)](int f, double, double) {
      e->tessellate(static_cast<std::size_t>(f), 1, [](const auto&) {});
    };
  });
}

TEST(ManyFacesOfCatmullClark, CostNoMoreEachThanFewer) {
  expect_linear(shapes(250, data::Scheme::kCatmullClark), shapes(1000, data::Scheme::kCatmullClark),
                [](const ControlMesh& mesh) {
                  return [e = std::make_shared<cc::StamEvaluator<Counted>>(
                              mesh.faces, positions_of<Counted>(mesh), mesh.sharpness)](
                             int f, double a, double b) { (void)e->evaluate(f, 0, a, b); };
                });
}

}  // namespace
}  // namespace limitcheck::reference
