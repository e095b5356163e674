// SPDX-License-Identifier: MIT
// The closed-form eigenstructure against Eigen's dense eigenvalue solver, and rings after many steps against
// repeated multiplication.
#include <gtest/gtest.h>

#include <Eigen/Dense>

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

  Eigen::MatrixXd dense() const {
    Eigen::MatrixXd s(size(), size());
    for (int j = 0; j < size(); ++j) {
      std::vector<double> unit(static_cast<std::size_t>(size()));
      unit[j] = 1;
      const auto column = step(unit);
      for (int i = 0; i < size(); ++i) s(i, j) = column[i];
    }
    return s;
  }
};

std::vector<double> closed_form(const Matrix& m) {
  std::vector<double> values{1};
  const int modes = m.boundary ? m.count : m.count - 1;
  if (m.boundary)
    values.insert(values.end(), {0.5, 0.25, 0.125, 0.125});
  else
    values.push_back(5.0 / 8 - loop_a<double>(m.count));
  for (int f = 1; m.boundary ? f < modes : f <= modes; ++f)
    values.push_back(3.0 / 8 + NumberTraits<double>::cos_pi(m.boundary ? f : 2 * f, m.count) / 4);
  values.insert(values.end(), static_cast<std::size_t>(m.count), 1.0 / 8);
  values.insert(values.end(), static_cast<std::size_t>(m.boundary ? m.count - 1 : m.count), 1.0 / 16);
  std::sort(values.begin(), values.end());
  return values;
}

TEST(TwoRing_Eigenvalues, AreThoseOfTheDenseMatrix) {
  double worst = 0;
  for (const bool boundary : {false, true})
    for (int count = boundary ? 1 : 3; count <= 13; ++count) {
      const Matrix m{count, boundary};
      const Eigen::EigenSolver<Eigen::MatrixXd> solver(m.dense());
      std::vector<double> got;
      for (const auto& value : solver.eigenvalues()) got.push_back(value.real());
      std::sort(got.begin(), got.end());
      const auto expected = closed_form(m);
      ASSERT_EQ(got.size(), expected.size());
      for (std::size_t i = 0; i < got.size(); ++i) {
        worst = std::max(worst, std::abs(got[i] - expected[i]));
        EXPECT_NEAR(got[i], expected[i], 1e-6)
            << count << (boundary ? " boundary" : " interior");  // sqrt(eps) at Jordan blocks
      }
    }
  RecordProperty("worst", std::to_string(worst));
}

/// Dimension of the eigenspace.
int geometric(const Matrix& m, double eigenvalue) {
  Eigen::FullPivLU<Eigen::MatrixXd> lu(m.dense() -
                                       eigenvalue * Eigen::MatrixXd::Identity(m.size(), m.size()));
  lu.setThreshold(1e-10);
  return m.size() - static_cast<int>(lu.rank());
}

TEST(TwoRing_JordanBlocks, AreAtValenceThreeAndAtMultiplesOfSixBoundaryFaces) {
  // D8: the full two-ring of valence 3 has 1/16 four times, with three eigenvectors.
  EXPECT_EQ(geometric({3, false}, 1.0 / 16), 3);
  for (int n = 4; n <= 12; ++n) EXPECT_EQ(geometric({n, false}, 1.0 / 16), n) << n;
  // Boundary: 1/2 is double where K is a multiple of 3, defective where it is one of 6.
  for (int k = 1; k <= 24; ++k)
    EXPECT_EQ(geometric({k, true}, 0.5), k % 6 == 0 ? 1 : k % 3 == 0 ? 2 : 1) << k;
}

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

TEST(TwoRing_BlockPower, HandlesEqualArgumentsAsAJordanBlockDoes) {
  const N x = N(1) / 16, y = N(1) / 8;
  const BlockPower<N> b(x, y, x, 9);
  EXPECT_EQ(b.xz, 9 * power(x, 8));
  EXPECT_LT(abs(b.xy - (power(x, 9) - power(y, 9)) / (x - y)), N("1e-50"));
  const BlockPower<N> zero(x, y, x, 0), one(x, y, x, 1);
  EXPECT_EQ(zero.xy, N(0));
  EXPECT_EQ(one.xy, N(1));
  EXPECT_EQ(one.xyz, N(0));
}

}  // namespace
}  // namespace limitcheck::reference
