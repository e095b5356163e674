// SPDX-License-Identifier: MIT
// Meshes with a vertex of many faces, for tests; and a number that counts what is done with it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/shapes.h"
#include "reference/number/number.h"
#include "reference/number/number_exact.h"
#include "reference/number/vec3.h"

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

namespace test {

using data::ControlMesh;

inline ControlMesh held(ControlMesh mesh, std::int32_t vertex) {
  mesh.sharpness.vertices.push_back({vertex, 10});
  return mesh;
}

/// The vertex of the most faces.
inline std::int32_t hub(const ControlMesh& mesh) {
  std::vector<int> faces(mesh.positions.size());
  for (const std::int32_t v : mesh.faces.corners()) ++faces[static_cast<std::size_t>(v)];
  return static_cast<std::int32_t>(std::max_element(faces.begin(), faces.end()) - faces.begin());
}

struct Shape {
  std::string name;
  ControlMesh mesh;
};

inline std::vector<Shape> triangles(int n) {
  const ControlMesh wheel = data::wheel(n), fan = data::fan(n);
  return {{"wheel", wheel},
          {"fan", fan},
          {"dart", data::dart(n, true)},
          {"cone", held(wheel, hub(wheel))},
          {"held fan", held(fan, hub(fan))}};
}
inline std::vector<Shape> quads(int n) {
  const ControlMesh wheel = data::quad_wheel(n, 7), fan = data::quad_fan(n, 11);
  return {{"quad wheel", wheel},
          {"quad fan", fan},
          {"quad dart", data::dart(n, false)},
          {"quad cone", held(wheel, hub(wheel))},
          {"held quad fan", held(fan, hub(fan))}};
}

template <class N>
std::vector<Vec3<N>> positions(const ControlMesh& mesh) {
  std::vector<Vec3<N>> result;
  for (const auto& p : mesh.positions)
    result.push_back({NumberTraits<N>::from_double(p[0]), NumberTraits<N>::from_double(p[1]),
                      NumberTraits<N>::from_double(p[2])});
  return result;
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

}  // namespace test
}  // namespace limitcheck::reference
