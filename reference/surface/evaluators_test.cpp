// SPDX-License-Identifier: MIT
// Two methods of different kind, and two precisions, against each other: on every stock shape, at fans of 1
// to 13 faces, at hubs of valence 3 to 200, down to 1e-300 from the vertex.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/shapes.h"
#include "reference/number/number_exact.h"
#include "reference/surface/test_methods.h"

namespace limitcheck::reference {
namespace {

using Big = Decimal100;
using data::ControlMesh, data::Scheme;

/// Points of a face: inside, on edges, corners, dyadic, near corners and edges.
std::vector<std::array<Parameter, 2>> points() {
  const auto p = [](const char* a, const char* b) {
    return std::array{Parameter::parse(a), Parameter::parse(b)};
  };
  return {p("1/3", "1/3"),  p("1/4", "1/4"),   p("1/2", "1/2"),    p("1/2", "0"),       p("0", "3/8"),
          p("0.7", "0.3"),  p("1/7", "5/7"),   p("0.03", "0.005"), p("0.985", "0.004"), p("0.001", "0.998"),
          p("1/1024", "0"), p("0", "1/65536"), p("3/4", "1/4"),    p("5/8", "1/8"),     p("1e-7", "0"),
          p("0", "1e-7"),   p("1e-7", "1e-7"), p("0", "0"),        p("1", "0"),         p("0", "1")};
}

/// Both methods at points of eight faces and at the corners of forty.
void expect_one_surface(const std::string& name, Weights weights) {
  const ControlMesh mesh = data::named_mesh(name);
  const Methods<Big> by(mesh, Scheme::kLoop, weights);
  const int all = static_cast<int>(mesh.faces.size()), faces = std::min(all, 8);
  const auto expect_at = [&](int face, const Parameter& l1, const Parameter& l2) {
    expect_same(by.stam(face, 0, l1, l2), by.by_steps(face, 0, l1, l2), 24,
                name + " face " + std::to_string(face) + " (" + l1.to_string() + ", " + l2.to_string() + ")");
  };
  for (int i = 0; i < faces; ++i)
    for (const auto& [l1, l2] : points()) expect_at(i * all / faces, l1, l2);
  for (int face = 0; face < std::min(all, 40); ++face)
    for (const auto& [l1, l2] : {std::pair{0., 0.}, {1., 0.}, {0., 1.}}) expect_at(face, l1, l2);
}

TEST(Evaluators, StamEqualsSubdivisionOnEveryShape) {
  std::vector<std::string> names = data::stock_shapes();
  for (int k = 1; k <= 13; ++k) names.push_back("fan:" + std::to_string(k));
  for (const int k : {18, 24}) names.push_back("fan:" + std::to_string(k));
  for (const int n : {3, 4, 5, 7, 8, 9, 12, 20, 50}) names.push_back("wheel:" + std::to_string(n));
  for (const std::string& name : names) expect_one_surface(name, Weights::kLoop);
}

// The two families have one surface at valences 3 and 6 and at the boundary, and another elsewhere.
TEST(Evaluators, StamEqualsSubdivisionAndRefinementUnderWarrensWeights) {
  for (const std::string name : {"tetrahedron", "octahedron", "icosahedron", "bipyramid:7", "wheel:3",
                                 "wheel:4", "wheel:5", "wheel:7", "wheel:8", "wheel:50", "fan:4", "holes"}) {
    expect_one_surface(name, Weights::kWarren);
    const ControlMesh mesh = data::named_mesh(name);
    const StamEvaluator<Big> stam(mesh, Weights::kWarren), loop(mesh);
    const auto refined = refine<Big>(mesh, 2, Weights::kWarren);
    const auto limits = refined.limits();
    Big most = 0;
    for (int face = 0; face < std::min(stam.face_count(), 8); ++face)
      for (const auto& [i1, i2] : {std::pair{0, 0}, {4, 0}, {0, 4}, {1, 0}, {1, 2}, {1, 1}}) {
        const auto v = refined.vertex(face, i1, i2);
        const auto p = stam.evaluate(face, i1 / 4., i2 / 4., Derivatives::kFirst);
        EXPECT_LE(magnitude(p.position - limits.positions[v]), Big("1e-90")) << name;
        EXPECT_LE(magnitude(p.normal - limits.normals[v]), Big("1e-90")) << name;
        most = std::max(most, magnitude(p.position - loop.evaluate(face, i1 / 4., i2 / 4.).position));
      }
    const bool same = name == "tetrahedron" || name == "wheel:3" || name == "fan:4" || name == "holes";
    EXPECT_EQ(most < Big("1e-90"), same) << name << ' ' << most;
  }
}

/// In double against a hundred digits, beside vertex 0 of the faces that begin there.
TEST(Evaluators, LoseNoDigitsDownTo1e300FromTheVertex) {
  struct Shape {
    std::string name;
    ControlMesh mesh;
    Scheme scheme;
  };
  std::vector<Shape> shapes;
  for (const char* name :
       {"wheel:3", "wheel:4", "wheel:5", "wheel:7", "wheel:12", "wheel:50", "wheel:200", "fan:1", "fan:2",
        "fan:4", "fan:5", "fan:6", "fan:7", "fan:9", "fan:12", "tetrahedron", "triangle", "octahedron"})
    shapes.push_back({name, data::named_mesh(name), Scheme::kLoop});
  for (const Scheme scheme : {Scheme::kLoop, Scheme::kCatmullClark}) {  // of many faces
    const bool loop = scheme == Scheme::kLoop;
    const ControlMesh wheel = loop ? data::wheel(100) : data::quad_wheel(100, 7),
                      fan = loop ? data::fan(100) : data::quad_fan(100, 11);
    for (const auto& [name, mesh] :
         {std::pair{"wheel of 100", wheel}, {"fan of 100", fan}, {"dart of 100", data::dart(100, loop)}})
      shapes.push_back({name, mesh, scheme});
    for (const auto& [name, mesh] : {std::pair{"cone of 100", wheel}, {"held fan of 100", fan}}) {
      shapes.push_back({name, mesh, scheme});
      shapes.back().mesh.sharpness.vertices.push_back({0, 10});
    }
  }
  double worst = 0, worst_normal = 0;
  for (const auto& [name, mesh, scheme] : shapes) {
    const auto exact = Methods<Big>(mesh, scheme).stam;
    const auto fast = Methods<double>(mesh, scheme).stam;
    int seen = 0;
    for (int face = 0; face < static_cast<int>(mesh.faces.size()) && seen < 4; ++face) {
      if (mesh.faces[static_cast<std::size_t>(face)][0] != 0) continue;
      ++seen;
      for (const double near : {1e-3, 1e-8, 1e-16, 1e-60, 1e-300}) {
        const auto got = fast(face, 0, near, .375 * near);
        const auto want = exact(face, 0, near, .375 * near);
        const auto error = [](const Vec3<double>& a, const Vec3<Big>& b) {
          const Vec3<Big> wide{Big(a.x), Big(a.y), Big(a.z)};
          const Big size = magnitude(b), distance = magnitude(wide - b);
          return Big(size > 0 ? Big(distance / size) : distance).convert_to<double>();
        };
        for (const double e :
             {error(got.position, want.position), error(got.d1, want.d1), error(got.d2, want.d2)}) {
          worst = std::max(worst, e);
          EXPECT_LE(e, StamError::kNearCorner) << name << " at " << near;
        }
        if (got.normal_kind != NormalKind::kRegular || want.normal_kind != NormalKind::kRegular) continue;
        const double n = error(got.normal, want.normal) / std::max(1., got.normal_condition);
        worst_normal = std::max(worst_normal, n);
        EXPECT_LE(n, StamError::kNormal) << name << " at " << near;
      }
    }
    EXPECT_GT(seen, 0) << name;
  }
  std::printf("worst in double: %.2g, normal %.2g\n", worst, worst_normal);
}

}  // namespace
}  // namespace limitcheck::reference
