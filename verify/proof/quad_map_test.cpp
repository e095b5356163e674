// SPDX-License-Identifier: MIT
// The sliding window of quads is the reference's linear map, exactly, at every valence: Catmull and Clark's
// weights are rational. [C21]
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "fast/window/quad_edge.h"
#include "fast/window/quad_window.h"
#include "reference/catmull_clark/subdivision_evaluator.h"
#include "reference/number/number_exact.h"
#include "verify/proof/kernel_runs.h"

namespace limitcheck::fast {

template <>
struct NumberTraits<reference::Rational> {
  using Scalar = reference::Rational;
  using Wide = reference::Rational;
  static Scalar ratio(int p, int q) { return Scalar(p, q); }
  static const Scalar& widen(const Scalar& x) { return x; }
  static const Scalar& narrow(const Scalar& x) { return x; }
};

}  // namespace limitcheck::fast

namespace limitcheck::verify {
namespace {

using reference::Rational;

// Control points whose x coordinates are the powers of a number that is larger than twice any numerator in
// question. A point's x then spells its weights as digits: two maps that agree on it are the same map.
std::vector<fast::Vec3<Rational>> spelled(std::size_t count) {
  const Rational base = reference::NumberTraits<Rational>::scale(Rational(1), 160);
  std::vector<fast::Vec3<Rational>> points;
  Rational power(1);
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back({power, Rational(static_cast<int>(i * i % 17)), Rational(static_cast<int>(i))});
    power = power * base;
  }
  return points;
}

void expect_equal(const data::ControlMesh& mesh, int depth, std::int64_t& compared) {
  const fast::QuadMesh quads(mesh);
  ASSERT_EQ(quads.steps, 0);
  const auto points = spelled(mesh.positions.size());
  std::vector<fast::Vec3<Rational>> copies;
  for (std::size_t v = 0; v < quads.positions.size(); ++v)
    copies.push_back(points[quads.uncut.empty() ? v : static_cast<std::size_t>(quads.uncut[v])]);
  using Surface = LinearSurface<Rational>;
  const fast::PreparedQuads<Rational, Surface> prepared(quads, copies);
  std::vector<reference::Vec3<Rational>> positions;
  for (const auto& p : points) positions.push_back({p.x, p.y, p.z});
  const reference::catmull_clark::SubdivisionEvaluator<Rational> exact(mesh.faces, positions, mesh.sharpness);

  const int k = 1 << depth;
  fast::QuadWindow<Rational, Surface> window(depth, quads.adjacency.max_valence());
  fast::QuadEdge<Rational, Surface> edge(depth, quads.adjacency.max_valence());
  std::vector<fast::LimitFrame<Rational>> along(static_cast<std::size_t>(k) + 1);
  const auto compare = [&](int face, int i, int j, const fast::Vec3<Rational>& found) {
    const int corner = i % k != 0 || j % k != 0 ? -1 : j == 0 ? (i == 0 ? 0 : 1) : i == 0 ? 3 : 2;
    if (corner >= 0 && quads.kind(quads.adjacency.corner(face, corner)) == fast::VertexKind::kDart) return;
    const auto u = reference::Parameter::fraction(i, k), v = reference::Parameter::fraction(j, k);
    const auto expected = exact.evaluate(face, 0, u, v, reference::Order::kPosition).position;
    EXPECT_TRUE(found.x == expected.x && found.y == expected.y && found.z == expected.z)
        << "face " << face << " at (" << i << ", " << j << ") / " << k;
    ++compared;
  };
  // Inside a quad all points are regular, and tangents are derivatives but for a factor.
  const auto compare_tangents = [&](int face, int i, int j, const fast::LimitFrame<Rational>& found) {
    const auto u = reference::Parameter::fraction(i, k), v = reference::Parameter::fraction(j, k);
    const auto expected = exact.evaluate(face, 0, u, v, reference::Order::kFirst);
    const Rational factor(k, 12);
    EXPECT_TRUE(factor * found.du.x == expected.d1.x && factor * found.dv.x == expected.d2.x)
        << "face " << face << " at (" << i << ", " << j << ") / " << k;
  };
  for (const int face : {0, 1}) {
    if (face >= quads.adjacency.face_count()) continue;
    window.run(prepared, face, depth, [&](int row, const fast::LimitFrame<Rational>* strip) {
      for (int i = 0; i <= k; ++i) {
        compare(face, i, k - row, strip[2 * i].position);
        if (i > 0 && i < k && row > 0) compare_tangents(face, i, k - row, strip[2 * i]);
        if (row == k - 1) compare(face, i, 0, strip[2 * i + 1].position);
      }
    });
    for (int side = 0; side < 4; ++side) {
      edge.evaluate(prepared, 4 * face + side, depth, along.data());
      for (int t = 0; t <= k; ++t) {
        const int i[] = {t, k, k - t, 0}, j[] = {0, t, k, k - t};
        compare(face, i[side], j[side], along[t].position);
      }
    }
  }
}

TEST(Proof_QuadMap, OfTheWindowIsTheReferencesAtEveryValence) {
  RecordProperty("claim", "C21");
  std::int64_t compared = 0;
  for (const int n : {3, 4, 5, 6, 7, 12}) {
    SCOPED_TRACE("valence " + std::to_string(n));
    expect_equal(data::quad_wheel(n, 1), n == 5 ? 3 : 2, compared);
  }
  expect_equal(data::quad_cube(), 3, compared);
  for (const int faces : {1, 2, 3, 5}) {
    SCOPED_TRACE("boundary vertex of so many faces: " + std::to_string(faces));
    expect_equal(data::quad_fan(faces, 1), 2, compared);
  }
  RecordProperty("points", static_cast<int>(compared));
  EXPECT_GT(compared, 500);
}

// The shares of semi-sharp edges are exact in double here. Darts are left out: the weights of their limits
// are found by iteration.
TEST(Proof_QuadMap, OfTheWindowWithSharpEdgesIsTheReferences) {
  std::int64_t compared = 0;
  for (const float s : {10.f, 1.f, 1.5f, 2.25f, .5f}) {
    SCOPED_TRACE("sharpness " + std::to_string(s));
    data::ControlMesh mesh = data::quad_cube();
    for (const auto& face : {0, 1})
      for (std::size_t k = 0; k < 4; ++k) {
        const data::SharpEdge e{mesh.faces[face][k], mesh.faces[face][(k + 1) % 4], s};
        bool known = false;
        for (const auto& other : mesh.sharpness.edges)
          known = known || (other.a == e.b && other.b == e.a) || (other.a == e.a && other.b == e.b);
        if (!known) mesh.sharpness.edges.push_back(e);
      }
    expect_equal(mesh, 2, compared);
  }
  expect_equal(data::corner(2, false), 2, compared);
  expect_equal(data::corner(3, false), 2, compared);
  // A semi-sharp edge runs into a crease: their vertex is held first and the crease's afterwards.
  data::ControlMesh meeting = data::corner(2, false);
  for (const auto& [a, b] : {std::pair{meeting.faces[0][0], meeting.faces[0][1]},
                             std::pair{meeting.faces[0][0], meeting.faces[0][3]}})
    if (std::none_of(
            meeting.sharpness.edges.begin(), meeting.sharpness.edges.end(),
            [&, from = a, to = b](const auto& e) { return std::minmax(e.a, e.b) == std::minmax(from, to); }))
      meeting.sharpness.edges.push_back({a, b, 1.5f});
  ASSERT_EQ(meeting.sharpness.edges.back().sharpness, 1.5f);
  expect_equal(meeting, 2, compared);
  data::ControlMesh held = data::quad_wheel(5, 2);
  held.sharpness.vertices = {{0, 1.5f}};
  held.sharpness.boundary = data::Boundary::kEdgeAndCorner;
  expect_equal(held, 2, compared);
  EXPECT_GT(compared, 500);
}

}  // namespace
}  // namespace limitcheck::verify
