// SPDX-License-Identifier: MIT
// Each mask against the definition it follows from: limits and tangents are left eigenvectors of the
// subdivision rules, the basis is what subdivision of a regular patch converges to. Exact rationals where the
// weights are rational.
#include <gtest/gtest.h>

#include "reference/loop/basis.h"
#include "reference/loop/ringed_face.h"
#include "reference/loop/vertex_limit.h"
#include "reference/number/number_exact.h"

namespace limitcheck::reference {
namespace {

using N = Decimal50;

/// Scattered but fixed points.
template <class M>
Vec3<M> scattered(int i) {
  const auto c = [&](int a, int b) { return M((i * a + b) % 97 - 48) / M(31); };
  return {c(37, 5), c(53, 11), c(71, 29)};
}
template <class M>
std::vector<Vec3<M>> scattered_ring(int n) {
  std::vector<Vec3<M>> ring;
  for (int i = 1; i <= n; ++i) ring.push_back(scattered<M>(i));
  return ring;
}
double distance(const Vec3<N>& a, const Vec3<N>& b) {
  return static_cast<N>(sqrt(dot(a - b, a - b))).convert_to<double>();
}

TEST(Sec31_VertexWeight, HasTheKnownValues) {
  EXPECT_EQ(loop_a<Rational>(3), Rational(9, 16));
  EXPECT_EQ(loop_a<Rational>(4), Rational(31, 64));
  EXPECT_EQ(loop_a<Rational>(6), Rational(3, 8));
  EXPECT_LT(abs(loop_a<N>(1000000) - N(15) / 64), N("1e-10"));
  const N fifth = (sqrt(N(5)) - 1) / 4;  // cos(2 pi / 5)
  EXPECT_LT(abs(loop_a<N>(5) - (N(5) / 8 - (3 + 2 * fifth) * (3 + 2 * fifth) / 64)), N("1e-48"));
}

// A neighbour has beta = 3 / (8 n), or 3/16 at n = 3; the limit mask has 1 / (n + 3 / (8 beta)) for each: 1/5
// at n = 3, 1/(2 n) elsewhere.
TEST(WarrensWeights, HaveTheKnownValues) {
  for (const int n : {3, 4, 5, 6, 7, 12}) {
    const Rational beta = n == 3 ? Rational(3, 16) : Rational(3, 8 * n);
    EXPECT_EQ(ring_weight<Rational>(n, Weights::kWarren), n * beta) << n;
    std::vector<Vec3<Rational>> ring(static_cast<std::size_t>(n));
    ring[1].x = 1;
    EXPECT_EQ(interior_limit<Rational>({}, ring, Weights::kWarren).x,
              n == 3 ? Rational(1, 5) : Rational(1, 2 * n))
        << n;
    EXPECT_EQ(interior_vertex_point<Rational>({}, ring, Weights::kWarren).x, beta) << n;
  }
  for (const int n : {3, 6})
    EXPECT_EQ(ring_weight<Rational>(n, Weights::kWarren), ring_weight<Rational>(n, Weights::kLoop));
  EXPECT_EQ(ring_weight<Rational>(4, Weights::kLoop), Rational(31, 64));
}

TEST(Sec31_Masks, ReproduceTheRegularLatticeExactly) {
  // On a regular lattice Loop's scheme halves linear functions and keeps the cubic boundary rule's line.
  std::vector<Vec3<Rational>> ring{{1, 0, 3}, {0, 1, -2}, {-1, 1, -5}, {-1, 0, -3}, {0, -1, 2}, {1, -1, 5}};
  Vec3<Rational> v{0, 0, 0};
  const auto before = ring;
  subdivide_ring(v, ring, false);
  EXPECT_EQ(v, (Vec3<Rational>{0, 0, 0}));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(ring[i], before[i] * Rational(1, 2));
}

TEST(Eq3_LimitMask, IsUnchangedByASubdivisionStepAtEveryValence) {
  for (const int n : {3, 4, 5, 6, 7, 8, 12, 50, 200}) {
    auto ring = scattered_ring<N>(n);
    Vec3<N> v = scattered<N>(0);
    const auto before = interior_limit<N>(v, ring);
    subdivide_ring(v, ring, false);
    EXPECT_LT(distance(before, interior_limit<N>(v, ring)), 1e-47) << n;
  }
}

TEST(Eq4And5_TangentMasks, ScaleByTheSubdominantEigenvalue) {
  for (const int n : {3, 4, 5, 6, 7, 8, 12, 50, 200}) {
    auto ring = scattered_ring<N>(n);
    Vec3<N> v = scattered<N>(0);
    const auto before = interior_tangents<N>(v, ring);
    subdivide_ring(v, ring, false);
    const auto after = interior_tangents<N>(v, ring);
    const N lambda = N(3) / 8 + NumberTraits<N>::cos_pi(2, n) / 4;
    EXPECT_LT(distance(before.first * lambda, after.first), 1e-45) << n;
    EXPECT_LT(distance(before.second * lambda, after.second), 1e-45) << n;
  }
}

TEST(D2_BoundaryTangents, AreLeftEigenvectorsOfTheOrdinaryRule) {
  for (int k = 1; k <= 24; ++k) {
    auto ring = scattered_ring<N>(k + 1);
    Vec3<N> v = scattered<N>(0);
    const auto before = boundary_tangents<N>(v, ring);
    subdivide_ring(v, ring, true);
    const auto after = boundary_tangents<N>(v, ring);
    const N across = k == 1 ? N(1) / 4 : N(N(3) / 8 + NumberTraits<N>::cos_pi(1, k) / 4);
    EXPECT_LT(distance(before.first * (N(1) / 2), after.first), 1e-45) << k;
    EXPECT_LT(distance(before.second * across, after.second), 1e-45) << k;
  }
}

TEST(D2_BoundaryTangents, PointAlongAndIntoAHalfDisc) {
  for (int k = 2; k <= 8; ++k) {
    std::vector<Vec3<N>> ring;
    for (int i = 0; i <= k; ++i) ring.push_back({NumberTraits<N>::cos_pi(i, k), sin_pi<N>(i, k), N(0)});
    const auto limit = vertex_limit<N>({N(0), N(0), N(0)}, ring, true);
    EXPECT_LT(distance(limit.normal.direction, {N(0), N(0), N(1)}), 1e-45) << k;
    EXPECT_GT(limit.tangents.second.y, N(0)) << k;
    EXPECT_EQ(limit.normal.kind, k >= 6 ? NormalKind::kNoTangentPlane : NormalKind::kRegular) << k;
  }
}

/// The face (4, 7, 8) of a regular patch with unit point `which` at x = 1.
RingedFace<Vec3<Rational>> regular_face(std::size_t which) {
  std::array<Vec3<Rational>, 13> p{};
  p[which].x = 1;
  RingedFace<Vec3<Rational>> face;
  const int rings[3][7] = {{4, 7, 8, 5, 2, 1, 3}, {7, 8, 4, 3, 6, 10, 11}, {8, 4, 7, 11, 12, 9, 5}};
  for (std::size_t k = 0; k < 3; ++k) {
    face.corner[k].point = p[rings[k][0]];
    for (std::size_t i = 1; i < 7; ++i) face.corner[k].ring.push_back(p[rings[k][i]]);
  }
  return face;
}

/// Depth-first over the sub-faces: limit positions at all corners against the basis function.
void compare(const RingedFace<Vec3<Rational>>& face, int depth,
             const std::array<std::array<Rational, 2>, 3>& at, std::size_t which) {
  if (depth == 0) {
    for (std::size_t k = 0; k < 3; ++k) {
      Basis<Rational> basis;
      evaluate_basis(basis, at[k][0], at[k][1], Derivatives::kPosition);
      EXPECT_EQ(interior_limit<Rational>(face.corner[k].point, face.corner[k].span()).x,
                basis.value[which - 1])
          << "b" << which << " at " << at[k][0] << ", " << at[k][1];
    }
    return;
  }
  const SubdividedFace<Rational> next(face);
  std::array<std::array<Rational, 2>, 3> middle;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t m = 0; m < 2; ++m) middle[k][m] = (at[k][m] + at[(k + 1) % 3][m]) / 2;
  for (std::size_t k = 0; k < 3; ++k)
    compare(next.subface(static_cast<int>(k)), depth - 1, {at[k], middle[k], middle[(k + 2) % 3]}, which);
  compare(next.subface(3), depth - 1, middle, which);
}

TEST(AppendixA, IsWhatSubdivisionConvergesToExactly) {
  for (std::size_t which = 1; which <= 12; ++which)
    compare(regular_face(which), 3, {{{0, 0}, {1, 0}, {0, 1}}}, which);
}

TEST(AppendixA, DerivativesAreThoseOfTheValuesExactly) {
  // A polynomial of degree 4 equals its Taylor polynomial; central differences of step h are off by f'''' h^2
  // only, and the combination with step 2h removes that.
  const Rational a(2, 7), b(3, 11), h(1, 10);
  const auto value = [&](const Rational& x, const Rational& y) {
    Basis<Rational> basis;
    evaluate_basis(basis, x, y, Derivatives::kPosition);
    return basis.value;
  };
  Basis<Rational> basis;
  evaluate_basis(basis, a, b, Derivatives::kSecond);
  const auto first = [&](auto at, std::size_t i) {
    return Rational((8 * (at(h)[i] - at(-h)[i]) - (at(2 * h)[i] - at(-2 * h)[i])) / (12 * h));
  };
  const auto second = [&](auto at, std::size_t i) {
    return Rational((16 * (at(h)[i] + at(-h)[i]) - (at(2 * h)[i] + at(-2 * h)[i]) - 30 * at(Rational(0))[i]) /
                    (12 * h * h));
  };
  const auto along_a = [&](const Rational& t) { return value(a + t, b); };
  const auto along_b = [&](const Rational& t) { return value(a, b + t); };
  const auto along_both = [&](const Rational& t) { return value(a + t, b + t); };
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(basis.da[i], first(along_a, i));
    EXPECT_EQ(basis.db[i], first(along_b, i));
    EXPECT_EQ(basis.daa[i], second(along_a, i));
    EXPECT_EQ(basis.dbb[i], second(along_b, i));
    EXPECT_EQ(Rational(basis.daa[i] + 2 * basis.dab[i] + basis.dbb[i]), second(along_both, i));
  }
}

TEST(Sec5_CentreWeights, AreTheBasisAtOneThird) {
  Basis<Rational> basis;
  evaluate_basis(basis, Rational(1, 3), Rational(1, 3), Derivatives::kPosition);
  const Rational quarter(1, 4), seven_halves(7, 2);
  const std::array<Rational, 12> paper{quarter, quarter, seven_halves, 23,      seven_halves, quarter,
                                       23,      23,      quarter,      quarter, seven_halves, quarter};
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(basis.value[i], paper[i] / 81) << "b" << i + 1;
}

TEST(D12_Normals, AreFiniteUnitVectorsWhateverTheRing) {
  const auto check = [](const std::vector<Vec3<double>>& ring, bool boundary, NormalKind kind,
                        const char* what) {
    const auto limit = vertex_limit<double>({0, 0, 0}, ring, boundary);
    EXPECT_EQ(limit.normal.kind, kind) << what;
    EXPECT_NEAR(dot(limit.normal.direction, limit.normal.direction), 1, 1e-15) << what;
  };
  const std::vector<Vec3<double>> coincident(5),
      collinear{{1, 0, 0}, {2, 0, 0}, {-1, 0, 0}, {3, 0, 0}, {-2, 0, 0}};
  std::vector<Vec3<double>> twice;  // winds round twice: no first harmonic, but facets that face up
  for (int i = 0; i < 8; ++i) twice.push_back({NumberTraits<double>::cos_pi(i, 2), sin_pi<double>(i, 2), 0});
  check(coincident, false, NormalKind::kArbitrary, "coincident");
  check(coincident, true, NormalKind::kArbitrary, "coincident");
  check(collinear, false, NormalKind::kArbitrary, "collinear");
  check(twice, false, NormalKind::kFallback, "double winding");
  check({{1e-300, 0, 0}, {0, 1e-300, 0}, {-1e-300, 0, 0}, {0, -1e-300, 0}}, false, NormalKind::kRegular,
        "tiny");
  check({{1e300, 0, 0}, {0, 1e300, 0}, {-1e300, 0, 0}, {0, -1e300, 0}}, false, NormalKind::kRegular, "huge");
}

TEST(D12_Normals, FallBackToWhereTheFacetsFace) {
  const auto expect = [](const std::vector<Vec3<double>>& ring, bool boundary, NormalKind kind, double up,
                         const char* what) {
    const auto limit = vertex_limit<double>({0, 0, 0}, ring, boundary);
    EXPECT_EQ(limit.normal.kind, kind) << what;
    EXPECT_NEAR(limit.normal.direction.z, up, 1e-12) << what;
  };
  std::vector<Vec3<double>> twice;
  for (int i = 0; i < 8; ++i) twice.push_back({NumberTraits<double>::cos_pi(i, 2), sin_pi<double>(i, 2), 0});
  expect(twice, false, NormalKind::kFallback, 1, "winds round twice");
  auto thin = twice;
  for (auto& r : thin) r.y *= 1e-14;
  expect(thin, false, NormalKind::kFallback, 1, "too thin for the steps: the control ring decides");
  expect({{1, 0, 0}, {1, 1e-8, 0}, {-1, 0, 0}, {-1, -1e-8, 0}}, false, NormalKind::kRegular, 1,
         "a sine of 1e-8 is enough");
  // Across is parallel to along; the open fan faces up, the polygon closed over the boundary would not.
  expect({{1, 1, 0}, {.25, .5, 0}, {.25, .5, 0}, {-1, 1, 0}}, true, NormalKind::kFallback, 1, "open fan");
}

}  // namespace
}  // namespace limitcheck::reference
