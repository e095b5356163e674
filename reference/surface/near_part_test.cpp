// SPDX-License-Identifier: MIT
// A point near a vertex of very many faces is evaluated on a few of them, and has the digits that all of them give.
#include "reference/surface/near_part.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "reference/surface/certified.h"

namespace limitcheck::reference {
namespace {

/// Numbers of faces that count as many, for as long as it lives.
struct WholeUpTo {
  explicit WholeUpTo(int faces) : before(std::exchange(CertifiedEvaluator::whole_up_to(), faces)) {}
  ~WholeUpTo() { CertifiedEvaluator::whole_up_to() = before; }
  WholeUpTo(const WholeUpTo&) = delete;
  WholeUpTo& operator=(const WholeUpTo&) = delete;
  int before;
};

/// Every coordinate changed, so that no ring is regular.
data::ControlMesh shaken(data::ControlMesh mesh) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c)
      mesh.positions[v][c] += 0x1p-8 * static_cast<double>((7 * v + 3 * c) % 11);
  return mesh;
}
data::ControlMesh polygon(int n) {
  data::ControlMesh mesh;
  std::vector<std::int32_t> face;
  for (int i = 0; i < n; ++i) {
    const double t = 6.283185307179586 * i / n;
    mesh.positions.push_back({std::cos(t), std::sin(t), std::sin(3 * t) / 8});
    face.push_back(i);
  }
  mesh.faces.push_back(face);
  return mesh;
}

/// With triangles at some of its edges, which meet in a point; of all edges they close it.
data::ControlMesh pyramid(int n, int triangles) {
  data::ControlMesh mesh = polygon(n);
  mesh.positions.push_back({.25, .125, -1});
  for (int i = 0; i < triangles; ++i) mesh.faces.push_back({n, (i + 1) % n, i});
  return mesh;
}

struct Case {
  const char* name;
  data::ControlMesh mesh;
  data::Scheme scheme;
  int corner;
};
std::vector<Case> cases(int n) {
  using data::Scheme;
  return {{"bipyramid", shaken(data::bipyramid(n)), Scheme::kLoop, 0},
          {"wheel", shaken(data::wheel(n)), Scheme::kLoop, 0},
          {"quad wheel", shaken(data::quad_wheel(n, 7)), Scheme::kCatmullClark, 0},
          {"bipyramid of polygons", shaken(data::bipyramid(n)), Scheme::kCatmullClark, 1},
          {"polygon", shaken(polygon(n)), Scheme::kCatmullClark, 5},
          {"pyramid", shaken(pyramid(n, n)), Scheme::kCatmullClark, 5},
          {"half a pyramid", shaken(pyramid(n, n / 2)), Scheme::kCatmullClark, n / 2},
          {"prism", shaken(data::polygon_prism(n)), Scheme::kCatmullClark, 5}};
}
/// Near each corner and farther away; those of quads near the middle of the face, too.
std::vector<std::array<const char*, 2>> points(data::Scheme scheme) {
  std::vector<std::array<const char*, 2>> all{{"1/3", "1/3"},       {"0.01", "0.003"}, {"0.998", "0.001"},
                                              {"0.0001", "0.9995"}, {"1e-9", "0"},     {"1/2", "1/4"},
                                              {"0", "1e-30"},       {"0", "0.7"}};
  if (scheme == data::Scheme::kCatmullClark)
    all.insert(all.end(), {{"0.9", "0.8"}, {"0.999", "0.99997"}, {"1", "0.7"}, {"0.99999999", "1"}});
  return all;
}

std::string text(const Enclosure3& e) {
  return e[0].value + ' ' + e[1].value + ' ' + e[2].value + '\n';
}
std::string text(const CertifiedPoint& p) {
  std::string all = text(p.position) + text(p.d1) + text(p.d2) + text(p.normal);
  for (const auto* second : {&p.d11, &p.d12, &p.d22, &p.t1, &p.t2})
    all += *second ? text(**second) : "none\n";
  return all;
}

TEST(NearPart, GivesTheDigitsOfTheWholeMesh) {
  std::size_t smaller = 0;
  for (const Case& c : cases(300)) {
    const CertifiedEvaluator evaluator(c.mesh, c.scheme);
    for (std::size_t face = 0; face < c.mesh.faces.size(); face += 1 + c.mesh.faces.size() / 2) {
      if (static_cast<std::size_t>(c.corner) >= c.mesh.faces[face].size()) continue;
      for (const auto& [u, v] : points(c.scheme)) {
        const auto evaluate = [&, &u = u, &v = v](int most) {
          const WholeUpTo many(most);
          return evaluator.evaluate(static_cast<int>(face), c.corner, Parameter::parse(u),
                                    Parameter::parse(v), 25);
        };
        const CertifiedPoint whole = evaluate(1000), part = evaluate(20);
        EXPECT_EQ(text(part), text(whole)) << c.name << " face " << face << " at " << u << ", " << v;
        smaller += part.faces < whole.faces ? 1 : 0;
      }
    }
  }
  EXPECT_GE(smaller, 30U) << "or nothing was compared";
}

TEST(NearPart, IsAsSmallHoweverManyFacesThereAre) {
  for (const int n : {2000, 20000})
    for (const Case& c : cases(n)) {
      const CertifiedEvaluator evaluator(c.mesh, c.scheme);
      const auto point =
          evaluator.evaluate(0, c.corner, Parameter::parse("1/3"), Parameter::parse("1/3"), 16);
      EXPECT_LE(point.faces, 60U) << c.name << ' ' << n;
    }
}

TEST(NearPart, IsNotForPointsThatHearOfAll) {
  const data::ControlMesh mesh = data::wheel(40);
  const Topology topology(mesh.positions.size(), mesh.faces);
  const auto position = [&](std::int32_t v) { return mesh.positions[static_cast<std::size_t>(v)]; };
  const auto found = [&](const char* u, const char* v, int most) {
    return near_part(topology, position, data::Scheme::kLoop, 0, 0, Parameter::parse(u), Parameter::parse(v),
                     most);
  };
  EXPECT_TRUE(found("1/3", "1/3", 8));
  EXPECT_FALSE(found("1/3", "1/3", 40)) << "there are no more";
  int at_the_vertex = 0;
  for (const auto& [u, v] : {std::pair{"0", "0"}, {"1", "0"}, {"0", "1"}})
    at_the_vertex += found(u, v, 8) ? 0 : 1;
  EXPECT_EQ(at_the_vertex, 1);
  EXPECT_FALSE(found("1e-30", "1e-30", 8)) << "so many steps reach all around";
}

}  // namespace
}  // namespace limitcheck::reference
