// SPDX-License-Identifier: MIT
// Rings after many steps, by their eigenvalues, against as many steps.
#include <gtest/gtest.h>

#include "reference/loop/stepped_ring.h"
#include "reference/loop/two_ring.h"
#include "reference/number/number_exact.h"

namespace limitcheck::reference {
namespace {

using N = Decimal50;

/// The subdivision matrix of a two-ring, from the masks: points c, r_0.., q_0.., p_0.. .
struct Matrix {
  int count;
  bool boundary;
  int rings = boundary ? count + 1 : count;
  int size() const { return 1 + 2 * rings + count; }
  int r(int i) const { return 1 + (i + rings) % rings; }
  int q(int i) const { return 1 + rings + (i + count) % count; }
  int p(int i) const { return 1 + rings + count + (i + rings) % rings; }

  /// One step of one coordinate.
  template <class M>
  std::vector<M> step(const std::vector<M>& x) const {
    std::vector<M> y(x.size());
    const auto at = [&](int i) { return x[i]; };
    const auto set = [&](int i, const M& value) { y[i] = value; };
    M sum(0);
    for (int i = 0; i < count; ++i) sum = sum + at(r(i));
    const M a = loop_a<M>(std::max(count, 3));
    set(0, boundary ? M((6 * at(0) + at(r(0)) + at(r(count))) / 8) : M((1 - a) * at(0) + a * sum / count));
    for (int i = 0; i < rings; ++i) {
      const bool end = boundary && (i == 0 || i == count);
      set(r(i),
          end ? M((at(0) + at(r(i))) / 2) : M((3 * (at(0) + at(r(i))) + at(r(i - 1)) + at(r(i + 1))) / 8));
      set(p(i),
          end ? M((6 * at(r(i)) + at(0) + at(p(i))) / 8)
              : M((10 * at(r(i)) + at(0) + at(r(i - 1)) + at(r(i + 1)) + at(q(i)) + at(q(i - 1)) + at(p(i))) /
                  16));
    }
    for (int i = 0; i < count; ++i) set(q(i), M((3 * (at(r(i)) + at(r(i + 1))) + at(0) + at(q(i))) / 8));
    return y;
  }
};

/// The largest error of a ring after many steps, relative to its slowest mode.
template <class Ring>
double worst_after_steps(const Ring& ring, const Matrix& m, std::vector<N> x) {
  double worst = 0;
  for (int step = 0; step <= 60; ++step, x = m.step(x)) {
    if (step >= 12 && step != 39 && step != 40 && step != 60) continue;
    for (int i = 0; i < m.count; ++i) {
      const RingPoints<N> s = ring.face_points(i, step);
      const auto linear = ring.linear_part(i);
      const Vec3<N>&g1 = linear.to_first, &g2 = linear.to_second;
      const N shrink = power(N(1) / 2, step), growth = power(N(ring.growth()), step);
      // Position of a lattice point (a, b) of the face: limit + linear part + what is left.
      const N scale = std::max(growth, shrink);
      const auto check = [&](const Vec3<N>& part, int a, int b, int index, const char* what) {
        const N got = ring.limit().x + (g1.x * a + g2.x * b) * shrink + (part.x - s.c_to_limit.x) * growth;
        const double e = static_cast<N>(abs(got - x[index]) / scale).convert_to<double>();
        worst = std::max(worst, e);
        EXPECT_LE(e, 1e-30) << m.count << (m.boundary ? " boundary " : " interior ") << "step " << step
                            << " face " << i << " " << what;
      };
      check(s.c, 0, 0, 0, "c");
      check(s.r[2], 1, 0, m.r(i), "r_i");
      check(s.r[3], 0, 1, m.r(i + 1), "r_i+1");
      if (!s.first_edge_on_boundary) check(s.r[1], 1, -1, m.r(i - 1), "r_i-1");
      if (!s.last_edge_on_boundary) check(s.r[4], -1, 1, m.r(i + 2), "r_i+2");
      check(s.q[1], 1, 1, m.q(i), "q_i");
      check(s.p[0], 2, 0, m.p(i), "p_i");
      check(s.p[1], 0, 2, m.p(i + 1), "p_i+1");
    }
  }
  return worst;
}

TEST(TwoRing_Powers, EqualRepeatedSubdivisionOfTheWholeTwoRing) {
  double worst = 0;
  for (const bool boundary : {false, true})
    for (const int count : {1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 18, 30}) {
      if (!boundary && count < 3) continue;
      const Matrix m{count, boundary};
      std::vector<N> x;
      for (int i = 0; i < m.size(); ++i) x.push_back(N((i * 37 + 11) % 97 - 48) / 31);
      const auto vec = [&](int i) { return Vec3<N>{x[i], N(0), N(0)}; };
      std::vector<Vec3<N>> r, q, p;
      for (int i = 0; i < m.rings; ++i) r.push_back(vec(m.r(i))), p.push_back(vec(m.p(i)));
      for (int i = 0; i < count; ++i) q.push_back(vec(m.q(i)));
      if (boundary) {
        const SteppedRingKind<N> kind(count, false, VertexState::kOrdinary, Weights::kLoop);
        worst = std::max(worst, worst_after_steps(SteppedRing<N>(kind, vec(0), r, q, p), m, x));
      } else {
        const TwoRingModes<N> modes(count, Weights::kLoop);
        worst = std::max(worst, worst_after_steps(TwoRing<N>(modes, vec(0), r, q, p), m, x));
      }
    }
  RecordProperty("worst", std::to_string(worst));
}

}  // namespace
}  // namespace limitcheck::reference
