// SPDX-License-Identifier: MIT
// Section 4.3: what the sliding window computes, stores and hands out. [C18-C20, C43-C55]
#include "fast/window/sliding_window.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "data/shapes.h"
#include "reference/loop/recursion.h"
#include "verify/claims/test_support/figures.h"

namespace limitcheck::fast {

/// A double that counts how often one is stored over another: the honest count beside the window's own.
/// Locals are constructed, arrays are assigned to.
struct Counted {
  double value = 0;
  static inline std::int64_t stores = 0;

  Counted() = default;
  explicit Counted(double v) : value(v) {}
  Counted(const Counted&) = default;
  Counted& operator=(const Counted& other) {
    value = other.value;
    ++stores;
    return *this;
  }
  friend Counted operator+(const Counted& a, const Counted& b) { return Counted(a.value + b.value); }
  friend Counted operator-(const Counted& a, const Counted& b) { return Counted(a.value - b.value); }
  friend Counted operator*(double s, const Counted& a) { return Counted(s * a.value); }
  friend Counted operator*(const Counted& a, const Counted& b) { return Counted(a.value * b.value); }
};

template <>
struct NumberTraits<Counted> {
  using Scalar = double;
  using Wide = double;
  static constexpr double ratio(int p, int q) { return static_cast<double>(p) / q; }
  static double widen(const Counted& v) { return v.value; }
  static Counted narrow(double v) { return Counted(v); }
};

/// Position and du x dv, no fallback: linear numbers have no square roots.
struct CountedSurface {
  using Vertex = SurfaceVertex<Counted>;
  template <class Normal>
  static Vertex vertex(const LimitFrame<Counted>& frame, Normal&&, std::int64_t&) {
    return {frame.position, cross(frame.du, frame.dv)};
  }
};

namespace {

using CountingWindow = SlidingWindow<Counted, CountedSurface, Counting, false>;
using CarryingWindow = SlidingWindow<Counted, CountedSurface, Counting, true>;

struct CountedRun {
  WindowCounts counts;
  std::int64_t stores = 0;  // of numbers
  int corner_valences[4]{};
};

/// One run of `Window` on the pair of half-edge 0.
template <class Window>
CountedRun run(const data::ControlMesh& mesh, int depth) {
  const Adjacency adjacency(mesh);
  const PreparedMesh<Counted, CountedSurface> prepared(adjacency, fast::positions_of<Counted>(mesh));
  Window window(depth, adjacency.max_valence());
  const std::int64_t before = Counted::stores;
  window.run(prepared, 0, depth, [](int, const SurfaceVertex<Counted>*) {});
  CountedRun result{window.probe().counts, Counted::stores - before, {}};
  const std::int32_t twin = adjacency.twin(0);
  int i = 0;
  for (const std::int32_t v : {adjacency.origin(0), adjacency.origin(twin),
                               adjacency.origin(Adjacency::prev(0)), adjacency.origin(Adjacency::prev(twin))})
    result.corner_valences[i++] = adjacency.valence(v);
  return result;
}

std::int64_t power(int base, int exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

constexpr int kValences[] = {6, 12, 50, 200};

TEST(Sec43_Space, IsTheSumOverAllLevelsFromZeroToM) {
  for (const int n_max : kValences) {
    for (int m = 0; m <= 7; ++m) {
      const auto held = static_cast<std::int64_t>(SlidingWindow<float>(m, n_max).allocated_vectors());
      const std::int64_t strips = 4 * (power(2, m) + 1);
      const std::int64_t corrected = 5 * (power(2, m + 1) - 1) + 5 * (m + 1) + 6 * (m + 1) * n_max;
      const std::int64_t printed = 5 * (power(2, m + 1) - 1) + 5 * m + 6 * m * n_max;
      EXPECT_EQ(held, corrected + strips) << "m " << m << " n_max " << n_max;
      EXPECT_EQ(held, 7 * power(2, m + 1) + 5 * m + 4 + 6 * (m + 1) * n_max);
      EXPECT_EQ(held - strips - printed, 5 + 6 * n_max)
          << "the printed form falls short by one level's share";
      EXPECT_NE(held, 7 * power(2, m + 1) - 1 + 5 * m + 6 * m * n_max);
    }
  }
}

TEST(Sec43_Time, TheRowPartIsHalfOfThePrintedSumLessALevel) {
  for (const auto& [name, mesh] : {std::pair{"torus", data::torus(5, 6)},
                                   {"tetrahedron", data::tetrahedron()},
                                   {"bipyramid 20", data::bipyramid(20)},
                                   {"bumpy 200", data::bumpy_sphere(200, 3)}}) {
    for (int m = 0; m <= 7; ++m) {
      const CountedRun r = run<CountingWindow>(mesh, m);
      std::int64_t rows = 0, corners = 0, valence_sum = 0, largest = 0;
      for (const int v : r.corner_valences) valence_sum += v, largest = std::max<std::int64_t>(largest, v);
      for (int l = 1; l <= m; ++l) rows += power(2, l - 1) * 5 * (power(2, l) + 1);
      const double closed =
          10. / 3 * static_cast<double>(power(4, m)) + 5. * static_cast<double>(power(2, m)) - 25. / 3;
      EXPECT_EQ(r.counts.rows, rows) << name << " m " << m;
      EXPECT_NEAR(static_cast<double>(r.counts.rows), closed, 1e-6) << name << " m " << m;
      // At their true valence: the pair's corners stay, every other end of a row has six.
      for (int l = 1; l <= m; ++l) corners += valence_sum + 4 * 6 * (power(2, l - 1) - 1);
      EXPECT_EQ(r.counts.corners, corners) << name << " m " << m;
      const std::int64_t n = std::max<std::int64_t>(largest, 6);
      EXPECT_LE(r.counts.corners, 4 * n * (power(2, m) - 1)) << name << " m " << m;
      // the printed sum, at the same valences, counts twice the work and ten more
      const std::int64_t printed =
          (5 * power(2, 2 * (m + 1)) - 20) / 3 + (5 + 4 * n) * power(2, m + 1) - 4 * n;
      std::int64_t printed_sum = 0;
      for (int l = 0; l <= m; ++l) printed_sum += power(2, l) * (5 * (power(2, l) + 1) + 4 * n);
      EXPECT_EQ(printed, printed_sum) << "its closed form is right (C52)";
      const std::int64_t work_bound = rows + 4 * n * (power(2, m) - 1);
      EXPECT_EQ(printed, 2 * work_bound + 10 + 4 * n) << "what it counts is not (C53)";
      EXPECT_GT(printed, r.counts.rows + r.counts.corners);
    }
  }
}

TEST(Sec43_Time, TheCountedVectorsAreTheStoredVectors) {
  for (int m = 0; m <= 6; ++m) {
    const CountedRun r = run<CountingWindow>(data::torus(5, 6), m);
    // every vector is three numbers; a limit point is two vectors; level 0 is filled with 4 rings, 4 corners,
    // 4 flaps
    EXPECT_EQ(r.stores, 3 * (r.counts.stored() + r.counts.filled + 8 + 2 * r.counts.limit_points))
        << "m " << m;
    EXPECT_EQ(r.counts.filled, 24);
    EXPECT_EQ(r.counts.middle_corners, 12 * (power(2, m) - 1)) << "copies: 6 N in space, 4 N in time";
  }
}

// "Computes vertices anew": three for each triangle, of which a strip sends one; or keeps them all, four times as
// many with each level, where a window holds twice as many.
TEST(Sec4_Recursion, ComputesVerticesAnewAndSendsSingleTriangles) {
  const data::ControlMesh mesh = data::icosahedron();
  const reference::NaiveSubdivider<double> naive(mesh);
  const std::int32_t other = Adjacency(mesh).twin(0) / 3;  // with face 0 the pair of half-edge 0
  for (int m = 1; m <= 6; ++m) {
    std::int64_t sent = 0;
    std::set<std::tuple<std::int32_t, std::int32_t, std::int32_t>> distinct;
    for (const std::int32_t face : {0, other})
      naive.tessellate(static_cast<std::size_t>(face), m, [&](const auto& leaf) {
        sent += 3;
        for (const auto& corner : leaf) distinct.insert({face, corner.i, corner.j});
      });
    const std::int64_t k = power(2, m);
    EXPECT_EQ(sent, 6 * power(4, m));
    EXPECT_EQ(static_cast<std::int64_t>(distinct.size()), (k + 1) * (k + 2)) << "of the two faces apart";
    const double anew = static_cast<double>(sent) / static_cast<double>(distinct.size());
    EXPECT_GT(anew, m == 1 ? 1.9 : 2.9 - 3. / static_cast<double>(k));
    const double strips = static_cast<double>(run<CountingWindow>(mesh, m).counts.strips) *
                          (2 * static_cast<double>(k) + 2) / static_cast<double>(sent);
    if (m == 3 || m == 5) {
      verify::record("{:.2f}", anew, "times_each_vertex_is_computed_at_depth_{}", m);
      verify::record("{:.3f}", strips, "strips_send_of_single_triangles_at_depth_{}", m);
    }
    EXPECT_LT(strips, .51);
    const auto window = [](int depth) {
      return static_cast<double>(SlidingWindow<float>(depth, 6).allocated_vectors());
    };
    EXPECT_LT(window(m + 1) / window(m), 2.01);
    EXPECT_GT(static_cast<double>((2 * k + 1) * (2 * k + 2)) / static_cast<double>((k + 1) * (k + 2)), 2.4);
  }
}

TEST(Sec43_Strips, AreTwoToTheMOfTwiceTwoToTheMTriangles) {
  for (int m = 0; m <= 7; ++m) {
    const CountedRun r = run<CountingWindow>(data::icosahedron(), m);
    EXPECT_EQ(r.counts.strips, power(2, m));
    EXPECT_NE(r.counts.strips, power(2, m) + 1) << "the paper counts the rows";
    const double sent = static_cast<double>(r.counts.strips) * 2 * static_cast<double>(power(2, m) + 1);
    const double naive = 6 * static_cast<double>(power(4, m));
    EXPECT_DOUBLE_EQ(sent / naive,
                     static_cast<double>(power(2, m) + 1) / (3 * static_cast<double>(power(2, m))));
  }
}

TEST(Sec43_LimitPoints, AreEvaluatedTwiceUnlessRowsAreCarriedOver) {
  for (int m = 0; m <= 7; ++m) {
    const std::int64_t k = power(2, m);
    EXPECT_EQ(run<CountingWindow>(data::octahedron(), m).counts.limit_points, 2 * k * (k + 1));
    const CountedRun carried = run<CarryingWindow>(data::octahedron(), m);
    EXPECT_EQ(carried.counts.limit_points, (k + 1) * (k + 1));
    EXPECT_EQ(carried.counts.carried, (k - 1) * (k + 1));
  }
}

// The corrected formulas one after the other: what the pseudo-code does (C53), and that by the number of limit
// points (C54), which is what has to be linear (C55).
TEST(Sec43_Time, IsLinearInTheLimitPointsWithTheFourOutsideTheSquare) {
  for (int m = 0; m <= 7; ++m) {
    const double k = static_cast<double>(power(2, m)), n = (k + 1) * (k + 1), valence = 50;
    double printed_sum = 0, work = 0;
    for (int l = 0; l <= m; ++l) {
      const double row = static_cast<double>(power(2, l));
      printed_sum += row * (5 * (row + 1) + 4 * valence);
      if (l > 0) work += row / 2 * (5 * (row + 1) + 4 * valence);
    }
    const double root = std::sqrt(n);
    EXPECT_NEAR(work, 10. / 3 * n + (4 * valence - 5. / 3) * root - 8 * valence - 10, 1e-6)
        << "C54 with C53's count";
    EXPECT_NEAR(printed_sum, 2 * work + 10 + 4 * valence, 1e-6) << "C53";
    const double as_printed =
        5. / 3 * 16 * (root - 1) * (root - 1) + (5 + 4 * valence) * 2 * (root - 1) - 20. / 3 - 4 * valence;
    EXPECT_NEAR(as_printed - printed_sum, 20 * (root - 1) * (root - 1), 1e-6) << "square of the 4";
    if (m >= 2 && m <= 5) verify::record("{:.1f}", work / n, "work_per_limit_point_at_depth_{}", m);
  }
  // by counting, at true valence: vectors stored per limit point settle down
  const auto per_point = [](int m) {
    const WindowCounts c = run<CountingWindow>(data::torus(5, 6), m).counts;
    return static_cast<double>(c.stored()) / static_cast<double>((power(2, m) + 1) * (power(2, m) + 1));
  };
  EXPECT_NEAR(per_point(7), 10. / 3, .35);
  EXPECT_LT(std::abs(per_point(7) - per_point(6)), std::abs(per_point(4) - per_point(3)));
}

/// The recursion with arguments I and J of the upper or lower call exchanged.
template <bool kUpper, std::size_t I, std::size_t J>
struct Exchanged : NoProbe {
  static void upper(auto&& call, auto*... arguments) { pass<kUpper>(call, arguments...); }
  static void lower(auto&& call, auto*... arguments) { pass<!kUpper>(call, arguments...); }
  template <bool kExchange>
  static void pass(auto&& call, auto*... arguments) {
    auto all = std::make_tuple(arguments...);
    if constexpr (kExchange) std::swap(std::get<I>(all), std::get<J>(all));
    std::apply(call, all);
  }
};

/// Largest difference of any position of a pair, at depth 3, from the printed order.
template <class Probe>
double departure(const data::ControlMesh& mesh) {
  const Adjacency adjacency(mesh);
  const PreparedMesh<double> prepared(adjacency, fast::positions_of<double>(mesh));
  SlidingWindow<double> right(3, adjacency.max_valence());
  SlidingWindow<double, LimitSurface<double>, Probe> other(3, adjacency.max_valence());
  std::vector<SurfaceVertex<double>> expected;
  right.run(prepared, 0, 3,
            [&](int, const auto* strip) { expected.insert(expected.end(), strip, strip + 18); });
  double worst = 0;
  std::size_t i = 0;
  other.run(prepared, 0, 3, [&](int, const auto* strip) {
    for (int q = 0; q < 18; ++q, ++i) {
      const auto d = strip[q].position - expected[i].position;
      worst = std::max(worst, std::sqrt(dot(d, d)));
    }
  });
  return worst;
}

template <bool kUpper, std::size_t Base>
void expect_no_pair_of_arguments_exchangeable(const data::ControlMesh& mesh) {
  const double d[] = {departure<Exchanged<kUpper, Base, Base + 1>>(mesh),
                      departure<Exchanged<kUpper, Base, Base + 2>>(mesh),
                      departure<Exchanged<kUpper, Base, Base + 3>>(mesh),
                      departure<Exchanged<kUpper, Base + 1, Base + 2>>(mesh),
                      departure<Exchanged<kUpper, Base + 1, Base + 3>>(mesh),
                      departure<Exchanged<kUpper, Base + 2, Base + 3>>(mesh)};
  for (const double worst : d)
    EXPECT_GT(worst, 1e-4) << (kUpper ? "upper" : "lower") << " call, from argument " << Base;
}

TEST(Sec43_Pseudocode, NoTwoArgumentsOfEitherCallCanBeExchanged) {
  const data::ControlMesh mesh = data::bumpy_sphere(80, 5);
  EXPECT_EQ(departure<NoProbe>(mesh), 0);
  expect_no_pair_of_arguments_exchangeable<true, 0>(mesh);
  expect_no_pair_of_arguments_exchangeable<false, 0>(mesh);
  expect_no_pair_of_arguments_exchangeable<true, 4>(mesh);
  expect_no_pair_of_arguments_exchangeable<false, 4>(mesh);
}

TEST(Sec431_Valence, FiftyIsNeitherNeededNorALimit) {
  int largest = 0;
  for (const int faces : {200, 800, 2000, 4000})
    for (std::uint64_t seed = 1; seed <= 2; ++seed)
      largest = std::max(largest, Adjacency(data::bumpy_sphere(faces, seed)).max_valence());
  verify::record("{}", largest, "largest_valence_of_bumpy_spheres");
  EXPECT_LE(largest, 50);
  EXPECT_GT(largest, 8);
  EXPECT_EQ(run<CountingWindow>(data::bipyramid(200), 3).counts.strips, 8);
}

}  // namespace
}  // namespace limitcheck::fast
