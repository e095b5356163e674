// SPDX-License-Identifier: MIT
// The prepass and the kernel in exact arithmetic, as linear forms, and in double.
// The kernel of quads in double, where nothing hides behind the rounding of float.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "fast/frame/patch.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/host/number_stream.h"
#include "fast/stream/kernel/kernel.h"
#include "fast/test_support/refined_limits.h"
#include "fast/test_support/shared_points.h"
#include "fast/test_support/test_meshes.h"
#include "fast/test_support/test_numbers.h"
#include "fast/window/quad_window.h"

namespace limitcheck::fast::row_stream {
namespace {

/// A limit point as linear maps of the control points; see NumberStream for which multiples the tangents are.
template <class T>
struct LinearPoint {
  std::array<T, 3> position, slant, across;
};

/// All vertices of the grids in the order of NumberStream::whole.
template <class T>
std::vector<LinearPoint<T>> linear_points(const Adjacency& adjacency,
                                          std::span<const std::array<T, 3>> points,
                                          std::span<const Grid> grids, int depth) {
  const std::size_t side = (std::size_t{1} << depth) + 1, count = grids.size() * side * side;
  std::vector<T> slant(6 * count), across(6 * count);
  NumberStream<LinearNumber<T, 0>>(adjacency, points).whole(grids, depth, slant.data());
  NumberStream<LinearNumber<T, 1>>(adjacency, points).whole(grids, depth, across.data());
  std::vector<LinearPoint<T>> out(count);
  for (std::size_t v = 0; v < count; ++v) {
    const T *a = &slant[6 * v], *b = &across[6 * v];
    out[v] = {{a[0], a[1], a[2]}, {a[3], a[4], a[5]}, {b[3], b[4], b[5]}};
  }
  return out;
}

std::vector<std::array<Rational, 3>> exactly(const data::ControlMesh& mesh) {
  std::vector<std::array<Rational, 3>> points;
  for (const auto& p : mesh.positions) points.push_back({Rational(p[0]), Rational(p[1]), Rational(p[2])});
  return points;
}

std::vector<Grid> grids_of(const Adjacency& adjacency, int depth) {
  return pair_faces(adjacency,
                    std::vector<std::int32_t>(static_cast<std::size_t>(adjacency.face_count()), depth))
      .grids;
}

// Meshes all of whose weights are rational: valences 3, 4, 6, boundary vertices of one to three faces.
std::vector<data::ControlMesh> rational_meshes() {
  return {tetrahedron(),
          shaken(octahedron(), .3, 1),
          shaken(bipyramid(6), .3, 2),
          shaken(bipyramid(3), .3, 3),
          shaken(grid_torus(3, 4), .2, 4),
          shaken(grid_sheet(3, 3), .1, 5),
          shaken(wheel(4, .5), .1, 6),
          shaken(fan(3), .1, 7),
          single_triangle()};
}

double extent(const data::ControlMesh& mesh) {
  double most = 0;
  for (int c = 0; c < 3; ++c) {
    for (const auto& p : mesh.positions)
      for (const auto& q : mesh.positions) most = std::max(most, p[c] - q[c]);
  }
  return most;
}

// Expected: refinement of the whole mesh in double, good to some 1e-15.
TEST(NumberStream, InRationalsIsTheLimitSurfaceWithItsTangents) {
  double worst_position = 0, worst_normal = 0;
  for (const auto& mesh : rational_meshes()) {
    const Adjacency adjacency(mesh);
    const auto points = exactly(mesh);
    for (const int depth : {0, 1, 2, 4}) {
      const auto grids = grids_of(adjacency, depth);
      const auto found = linear_points<Rational>(adjacency, points, grids, depth);
      const RefinedLevels expected = RefinedLevels::loop(mesh, depth);
      const int size = 1 << depth;
      for (std::size_t v = 0; v < found.size(); ++v) {
        const int side = size + 1, inside = static_cast<int>(v) % (side * side);
        const int i = inside % side, j = inside / side;
        const LatticePoint at =
            face_point(grids[v / static_cast<std::size_t>(side * side)], size, i, j, i <= j);
        if (at.face < 0) continue;
        const SurfaceLimit e = expected.limit(at);
        double p[3], a[3], b[3];
        for (std::size_t c = 0; c < 3; ++c) {
          p[c] = static_cast<double>(found[v].position[c]);
          a[c] = static_cast<double>(found[v].slant[c]);
          b[c] = static_cast<double>(found[v].across[c]);
        }
        double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        const double length = std::hypot(n[0], n[1], n[2]);
        for (std::size_t c = 0; c < 3; ++c) {
          worst_position = std::max(worst_position, std::abs(p[c] - static_cast<double>(e.position[c])));
          worst_normal = std::max(worst_normal, std::abs(n[c] / length - static_cast<double>(e.normal[c])));
        }
      }
    }
  }
  EXPECT_LE(worst_position, 1e-14);
  EXPECT_LE(worst_normal, 1e-12);
  RecordProperty("worst_position", std::to_string(worst_position * 1e15) + "e-15");
  RecordProperty("worst_normal", std::to_string(worst_normal * 1e15) + "e-15");
}

// On a plane grid with heights x^2 + 3 x y Loop's surface is that quadratic and a constant: it reproduces
// quadratics up to one. Positions x, y and all derivatives are known exactly.
TEST(NumberStream, TangentsAreTheDocumentedMultiplesOfTheDerivatives) {
  data::ControlMesh mesh = grid_sheet(7, 7);
  for (auto& p : mesh.positions) p[2] = p[0] * p[0] + 3 * p[0] * p[1];
  const Adjacency adjacency(mesh);
  const auto points = exactly(mesh);
  std::size_t seen = 0;
  for (const int depth : {1, 2, 4}) {
    const auto grids = grids_of(adjacency, depth);
    const auto found = linear_points<Rational>(adjacency, points, grids, depth);
    const int size = 1 << depth;
    for (std::size_t p = 0; p < grids.size(); ++p) {
      if (grids[p].singleton()) continue;
      // Corners A, B, D in the plane.
      const std::int32_t ac = 3 * grids[p].face0 + grids[p].edge0;
      const auto& a = mesh.positions[adjacency.origin(ac)];
      const auto& d = mesh.positions[adjacency.origin(Adjacency::prev(ac))];
      const auto& b = mesh.positions[adjacency.origin(Adjacency::prev(adjacency.twin(ac)))];
      bool inside = true;
      for (const auto* corner : {&a, &b, &d})
        for (int c = 0; c < 2; ++c) inside = inside && (*corner)[c] >= 2 && (*corner)[c] <= 5;
      if (!inside) continue;
      for (int j = 0; j <= size; ++j) {
        for (int i = 0; i <= size; ++i) {
          const bool corner = (i == 0 || i == size) && (j == 0 || j == size);
          if (corner) continue;
          const auto& v = found[(p * (size + 1) + j) * (size + 1) + i];
          const Rational s(i, size), t(j, size);
          Rational dx[3], dy[3], at[2];
          for (int c = 0; c < 2; ++c) {
            dx[c] = Rational(b[c] - a[c]), dy[c] = Rational(d[c] - a[c]);
            at[c] = Rational(a[c]) + s * dx[c] + t * dy[c];
            EXPECT_EQ(v.position[c], at[c]);
          }
          const Rational by_x = 2 * at[0] + 3 * at[1], by_y = 3 * at[0];
          dx[2] = by_x * dx[0] + by_y * dx[1];
          dy[2] = by_x * dy[0] + by_y * dy[1];
          const bool column = (i == 0 || i == size) && j > 0 && j < size, diagonal = i == j;
          const Rational unit(1 << (2 * depth));
          for (int c = 0; c < 3; ++c) {
            const Rational u = dx[c], w = dy[c];
            EXPECT_EQ(v.slant[c], unit * (column ? 2 * w - 2 * u : diagonal ? 2 * u + 4 * w : 4 * u + 2 * w));
            EXPECT_EQ(v.across[c], unit * (column     ? -(4 * u + 2 * w)
                                           : diagonal ? 2 * w - 2 * u
                                                      : 2 * u + 4 * w));
          }
          ++seen;
        }
      }
    }
  }
  EXPECT_GT(seen, 1000u);
}

// The map that the kernel applies, found by running it on linear forms once, is the map that it applies.
TEST(NumberStream, OnLinearFormsYieldsTheMapItApplies) {
  for (const auto& mesh : {tetrahedron(), shaken(octahedron(), .3, 1), shaken(grid_sheet(2, 3), .1, 5)}) {
    const Adjacency adjacency(mesh);
    const auto points = exactly(mesh);
    std::vector<std::array<Form, 3>> forms;
    for (std::size_t v = 0; v < points.size(); ++v)
      forms.push_back({Form::point(3 * static_cast<int>(v)), Form::point(3 * static_cast<int>(v) + 1),
                       Form::point(3 * static_cast<int>(v) + 2)});
    const auto apply = [&](const Form& f, int coordinate, const Rational& expected, const Rational& sum) {
      EXPECT_EQ(f.constant, 0);
      Rational value = 0, total = 0;
      for (const auto& [i, w] : f.weights) {
        if (w != 0) {
          EXPECT_EQ(i % 3, coordinate);
        }
        value += w * points[i / 3][i % 3];
        total += w;
      }
      EXPECT_EQ(value, expected);
      EXPECT_EQ(total, sum);
    };
    for (const int depth : {0, 1, 4}) {
      const auto all = grids_of(adjacency, depth);
      const auto grids = std::span(all).first(depth == 4 ? 1 : all.size());
      const auto maps = linear_points<Form>(adjacency, forms, grids, depth);
      const auto values = linear_points<Rational>(adjacency, points, grids, depth);
      for (std::size_t v = 0; v < maps.size(); ++v) {
        for (int c = 0; c < 3; ++c) {
          const auto k = static_cast<std::size_t>(c);
          apply(maps[v].position[k], c, values[v].position[k], 1);
          apply(maps[v].slant[k], c, values[v].slant[k], 0);
          apply(maps[v].across[k], c, values[v].across[k], 0);
        }
      }
    }
  }
}

// Shared points of an edge, evaluated alone, are those of its grid: exactly, also from depth 4 on, where both
// move to local origins.
TEST(NumberStream, EdgesAloneAreThoseOfTheGridExactly) {
  const auto mesh = shaken(octahedron(), .3, 1);
  const Adjacency adjacency(mesh);
  const auto points = exactly(mesh);
  using Number = LinearNumber<Rational, 1>;
  const NumberStream<Number> stream(adjacency, points);
  for (const int depth : {1, 3, 4}) {
    const auto grids = grids_of(adjacency, depth);
    const int side = (1 << depth) + 1;
    std::vector<Rational> whole(6 * static_cast<std::size_t>(side * side)), edge(6 * side);
    stream.whole(std::span(grids).first(1), depth, whole.data());
    const std::int32_t ac = 3 * grids[0].face0 + grids[0].edge0;
    stream.edges({&ac, 1}, depth, edge.data());
    for (int t = 0; t < side; ++t) {
      for (int k = 0; k < 6; ++k) EXPECT_EQ(edge[6 * t + k], whole[6 * (t * side + t) + k]) << t << " " << k;
    }
  }
}

// Of six numbers each: position and a tangent, from runs for either tangent.
struct Tangents {
  std::vector<Rational> first, second;

  /// Whether point i has the position and the tangent plane, with its side, that point k of the others has.
  bool agrees(std::size_t i, const Tangents& other, std::size_t k) const {
    const auto normal = [](const Tangents& t, std::size_t at, std::size_t c) {
      const Rational *a = &t.first[6 * at + 3], *b = &t.second[6 * at + 3];
      return a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
    };
    Rational along = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      if (first[6 * i + c] != other.first[6 * k + c]) return false;
      const std::size_t d = (c + 1) % 3;
      if (normal(*this, i, c) * normal(other, k, d) != normal(*this, i, d) * normal(other, k, c))
        return false;
      along += normal(*this, i, c) * normal(other, k, c);
    }
    return along > 0;
  }
};

// Regular edges and pairs as polynomials against the steps of subdivision, beside irregular ones and alone.
TEST(NumberStream, ByPolynomialsIsTheSameSurfaceExactly) {
  const auto mesh = shaken(grid_sheet(6, 6), .1, 4);  // regular inside
  const Adjacency adjacency(mesh);
  const auto points = exactly(mesh);
  const NumberStream<LinearNumber<Rational, 0>> first(adjacency, points);
  const NumberStream<LinearNumber<Rational, 1>> second(adjacency, points);
  int patches = 0, edges = 0, others = 0;
  for (const int depth : {4, 5}) {
    const std::size_t n = (std::size_t{1} << depth) + 1;
    const auto evaluated = [&](std::size_t count, const auto& run) {
      Tangents both{std::vector<Rational>(6 * count), std::vector<Rational>(6 * count)};
      run(first, both.first.data()), run(second, both.second.data());
      return both;
    };
    auto grids = grids_of(adjacency, depth);
    if (depth == 5) grids.resize(grids.size() / 8);
    for (const Grid& grid : grids) {
      const auto streamed = evaluated(n * n, [&](const auto& s, Rational* out) {
        s.whole({&grid, 1}, depth, out);
      });
      const auto with_edges = evaluated(n * n, [&](const auto& s, Rational* out) {
        s.whole({&grid, 1}, depth, out, Edges::kRegularByPolynomials);
      });
      for (std::size_t k = 0; k < n * n; ++k)
        EXPECT_TRUE((grid.singleton() && k % n > k / n) || with_edges.agrees(k, streamed, k))
            << depth << " " << k;
      edges += with_edges.second == streamed.second ? 0 : 1;
      if (regular_edges(first.rings(), grid, depth) != kAllEdges) {
        ++others;
        continue;
      }
      ++patches;
      for (const Order order : {Order::kFromA, Order::kFromC}) {
        const auto patch =
            evaluated(n * n, [&](const auto& s, Rational* out) { s.patch(grid, depth, out, order); });
        for (std::size_t k = 0; k < n * n; ++k)
          EXPECT_TRUE(patch.agrees(order == Order::kFromA ? k : n * n - 1 - k, streamed, k))
              << depth << " " << k;
      }
    }
    for (std::int32_t h = 0; h < (depth == 5 ? 9 : 3 * adjacency.face_count()); ++h) {
      const auto line = [&](Edges by) {
        return evaluated(n, [&](const auto& s, Rational* out) { s.edges({&h, 1}, depth, out, by); });
      };
      const auto streamed = line(Edges::kAllStreamed), regular = line(Edges::kRegularByPolynomials);
      for (std::size_t k = 0; k < n; ++k) EXPECT_TRUE(regular.agrees(k, streamed, k)) << depth << " " << h;
    }
  }
  EXPECT_GT(patches, 0);
  EXPECT_GT(others, 0);
  EXPECT_GT(edges, patches);
}

TEST(DoubleStream, IsWithinFiveTimesTenToTheMinusSixteenOfTheExactLimit) {
  double worst = 0, worst_normal = 0;
  for (const auto& mesh : rational_meshes()) {
    const Adjacency adjacency(mesh);
    const auto points = exactly(mesh);
    for (const int depth : {0, 3, 5}) {
      auto grids = grids_of(adjacency, depth);
      grids.resize(std::min<std::size_t>(grids.size(), 4));
      const auto expected = linear_points<Rational>(adjacency, points, grids, depth);
      std::vector<double> found(6 * expected.size());
      DoubleStream(mesh, adjacency).whole(grids, depth, found.data());
      for (std::size_t v = 0; v < expected.size(); ++v) {
        const int side = (1 << depth) + 1, inside = static_cast<int>(v) % (side * side);
        if (grids[v / static_cast<std::size_t>(side * side)].singleton() && inside % side > inside / side)
          continue;
        std::array<double, 3> a, b;
        for (std::size_t c = 0; c < 3; ++c) {
          const Rational error = Rational(found[6 * v + c]) - expected[v].position[c];
          worst = std::max(worst, std::abs(static_cast<double>(error)) / extent(mesh));
          a[c] = static_cast<double>(expected[v].slant[c]), b[c] = static_cast<double>(expected[v].across[c]);
        }
        const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        for (std::size_t c = 0; c < 3; ++c)
          worst_normal =
              std::max(worst_normal, std::abs(n[c] / std::hypot(n[0], n[1], n[2]) - found[6 * v + 3 + c]));
      }
    }
  }
  EXPECT_LE(worst, 5e-16);
  EXPECT_LE(worst_normal, 1e-12);
  RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
  RecordProperty("worst_normal", std::to_string(worst_normal * 1e15) + "e-15");
}

TEST(NumberStream, RefusesWhatItCannotDo) {
  const auto mesh = tetrahedron();
  const Adjacency adjacency(mesh);
  const auto points = exactly(mesh);
  using Number = LinearNumber<Rational, 0>;
  EXPECT_THROW(NumberStream<Number>(adjacency, std::span(points).first(3)), data::ArgumentError);
  double out[6];
  EXPECT_THROW(DoubleStream(mesh, adjacency).whole({}, 11, out), data::ArgumentError);
  EXPECT_THROW(DoubleStream(mesh, adjacency).edges({}, -1, out), data::ArgumentError);
}

using Number = ScalarNumber<double>;

// Position and normal of all points of a quad, row by row: streamed, or as a polynomial.
std::vector<double> evaluate(const BasicQuadRings<double>& rings, std::int32_t face, int depth,
                             bool as_patch) {
  const std::ptrdiff_t n = (1 << depth) + 1;
  std::vector<double> out(static_cast<std::size_t>(6 * n * n)), input(quad_input_size(depth)),
      work(quad_work_size(depth));
  double* lane = out.data();
  const QuadTarget<double> target{&lane, 6 * n, nullptr, nullptr};
  if (as_patch) {
    const auto batch = gather_patches<double>(rings, {&face, 1}, depth, 1, input.data());
    generic::QuadPatch<Number>(batch, rings.placement(), work.data(), {target}).run();
  } else {
    const auto batch = gather_quads<double>(rings, {&face, 1}, depth, 1, input.data());
    generic::QuadStream<Number>(batch, rings.placement(), work.data(), {target}).run();
  }
  return out;
}

TEST(QuadNumbers, AreThoseOfTheWindowToFourteenDigits) {
  double worst_position = 0, worst_normal = 0;
  const std::vector<data::ControlMesh> meshes{
      data::quad_cube(),       data::quad_torus(6, 5), data::pawn(7),
      data::quad_wheel(12, 1), data::quad_fan(3, 2),   data::dart(5, false),
      data::corner(3, false),  data::creased_cube(10), data::polygon_prism(5)};
  for (const auto& mesh : meshes) {
    const QuadMesh quads(mesh);
    std::vector<Vec3<double>> positions;
    for (const auto& p : quads.positions) positions.push_back({p[0], p[1], p[2]});
    const PreparedQuads<double> prepared(quads, positions);
    const BasicQuadRings<double> rings(quads);
    for (int depth = 0; depth <= 6; ++depth) {
      const int n = (1 << depth) + 1;
      QuadWindow<double> window(depth, quads.adjacency.max_valence());
      const auto faces = std::min(quads.adjacency.face_count(), 40);
      for (std::int32_t f = 0; f < faces; ++f) {
        for (const bool as_patch : {false, true}) {
          if (as_patch && rings.kind(f) != QuadClass::kRegular) continue;
          const auto got = evaluate(rings, f, depth, as_patch);
          window.run(prepared, f, depth, [&](int row, const SurfaceVertex<double>* strip) {
            for (int q = 0; q < 2 * n; ++q) {
              const double* v = got.data() + 6 * ((n - 1 - row - q % 2) * n + q / 2);
              const auto& [p, w] = strip[q];
              const std::array want{p.x, p.y, p.z, w.x, w.y, w.z};
              for (int c = 0; c < 6; ++c) {
                double& worst = c < 3 ? worst_position : worst_normal;
                worst = std::max(worst, std::abs(v[c] - want[c]));
              }
            }
          });
        }
      }
    }
  }
  EXPECT_LE(worst_position, 1e-14);  // measured: 1.4e-15
  EXPECT_LE(worst_normal, 2e-12);    // measured: 1.7e-13
  RecordProperty("worst_position", std::to_string(worst_position * 1e15) + "e-15");
  RecordProperty("worst_normal", std::to_string(worst_normal * 1e12) + "e-12");
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
