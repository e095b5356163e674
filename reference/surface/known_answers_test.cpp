// SPDX-License-Identifier: MIT
// Every known answer, to 39 digits with 50-digit arithmetic, by both evaluators where both apply.
#include <gtest/gtest.h>

#include "data/test_support/known_answers.h"
#include "reference/loop/basis.h"
#include "reference/loop/masks.h"
#include "reference/loop/refine.h"
#include "reference/loop/stam.h"
#include "reference/loop/subdivision_evaluator.h"
#include "reference/loop/vertex_limit.h"
#include "reference/number/number_exact.h"
#include "reference/surface/certified.h"

namespace limitcheck::reference {
namespace {

using N = Decimal50;

const data::KnownAnswers& answers() {
  static const data::KnownAnswers loaded = data::load_known_answers();
  return loaded;
}

template <class M = N>
Vec3<M> vec(const data::Numeral3& text) {
  return {data::parse<M>(text[0]), data::parse<M>(text[1]), data::parse<M>(text[2])};
}
template <class M = N>
std::vector<Vec3<M>> vecs(const std::vector<data::Numeral3>& texts) {
  std::vector<Vec3<M>> result;
  for (const auto& t : texts) result.push_back(vec<M>(t));
  return result;
}

double size(const Vec3<N>& a) {
  return std::max({NumberTraits<N>::approximate(abs(a.x)), NumberTraits<N>::approximate(abs(a.y)),
                   NumberTraits<N>::approximate(abs(a.z))});
}

/// Decimal digits in which two vectors agree, relative to the larger of 1 and the expected one's size.
double digits(const Vec3<N>& got, const Vec3<N>& expected) {
  const double error = size(got - expected) / std::max(1.0, size(expected));
  return error == 0 ? 50 : -std::log10(error);
}

constexpr double kDigits = 39;
#define EXPECT_DIGITS(got, expected, id)    \
  EXPECT_GE(digits(got, expected), kDigits) \
      << (id) << ": " #got " " << (got).x << " " << (got).y << " " << (got).z

TEST(KnownAnswers_InteriorRings, LimitMaskAndTangentsToThirtyNineDigits) {
  ASSERT_EQ(answers().interior_rings.size(), 6U);
  for (const auto& a : answers().interior_rings) {
    const auto centre = vec(a.center);
    auto ring = vecs(a.ring);
    const auto limit = vertex_limit<N>(centre, ring, false);
    EXPECT_DIGITS(limit.position, vec(a.limit_position), a.id);
    EXPECT_DIGITS(limit.normal.direction, vec(a.unit_normal), a.id);
    // The answers number the ring from 1.
    std::rotate(ring.begin(), ring.end() - 1, ring.end());
    const auto t = interior_tangents<N>(centre, ring);
    EXPECT_DIGITS(t.first, vec(a.c), a.id);
    EXPECT_DIGITS(t.second, vec(a.s), a.id);
  }
}

TEST(KnownAnswers_BoundaryRings, LimitMaskAndBothTangentsToThirtyNineDigits) {
  ASSERT_EQ(answers().boundary_rings.size(), 4U);
  for (const auto& a : answers().boundary_rings) {
    const auto ring = vecs(a.ring);
    const auto limit = vertex_limit<N>(vec(a.center), ring, true);
    EXPECT_DIGITS(limit.position, vec(a.limit_position), a.id);
    EXPECT_DIGITS(limit.tangents.first, vec(a.along), a.id);
    // The weights of the answer may differ from ours by a positive factor.
    EXPECT_DIGITS(unit(limit.tangents.second), unit(vec(a.across)), a.id);
    EXPECT_DIGITS(limit.normal.direction, vec(a.unit_normal), a.id);
  }
}

template <class Evaluator>
void check_surfaces() {
  ASSERT_EQ(answers().surfaces.size(), 15U);
  double worst = 50;
  for (const auto& a : answers().surfaces) {
    const Evaluator evaluator(vecs(a.vertices), a.faces);
    for (const auto& s : a.samples) {
      const auto p = evaluator.evaluate(a.face, Parameter::parse(s.barycentric[1]),
                                        Parameter::parse(s.barycentric[2]), Derivatives::kFirst);
      const std::string id =
          a.id + " (" + s.barycentric[0] + ", " + s.barycentric[1] + ", " + s.barycentric[2] + ")";
      EXPECT_DIGITS(p.position, vec(s.position), id);
      EXPECT_DIGITS(p.d1, vec(s.d_dl1), id);
      EXPECT_DIGITS(p.d2, vec(s.d_dl2), id);
      EXPECT_DIGITS(p.normal, vec(s.unit_normal), id);
      worst = std::min({worst, digits(p.position, vec(s.position)), digits(p.d1, vec(s.d_dl1)),
                        digits(p.d2, vec(s.d_dl2)), digits(p.normal, vec(s.unit_normal))});
    }
  }
  testing::Test::RecordProperty("fewest_digits", std::to_string(worst));
}
TEST(KnownAnswers_SurfacePoints, ByStamToThirtyNineDigits) {
  check_surfaces<StamEvaluator<N>>();
}
TEST(KnownAnswers_SurfacePoints, BySubdivisionToThirtyNineDigits) {
  check_surfaces<SubdivisionEvaluator<N>>();
}

TEST(KnownAnswers_SurfacePoints, AreInsideTheCertifiedEnclosures) {
  for (const auto& a : answers().surfaces) {
    const CertifiedEvaluator evaluator(a.vertices, a.faces);
    for (const auto& s : a.samples) {
      const auto p = evaluator.evaluate(a.face, Parameter::parse(s.barycentric[1]),
                                        Parameter::parse(s.barycentric[2]), 45);
      const auto check = [&](const Enclosure3& got, const data::Numeral3& expected) {
        for (std::size_t i = 0; i < 3; ++i) {
          const Decimal100 want = data::parse<Decimal100>(expected[i]), value(got[i].value);
          const Decimal100 rounding =
              abs(want) * Decimal100("1e-41") + Decimal100("1e-43");  // of the answer's own 42 digits
          EXPECT_LE(abs(want - value), Decimal100(got[i].radius.to_string(17)) + rounding)
              << a.id << " " << s.barycentric[1] << " " << s.barycentric[2];
          EXPECT_LE(got[i].radius.as_double(), 1e-43);
        }
      };
      check(p.position, s.position);
      check(p.d1, s.d_dl1);
      check(p.d2, s.d_dl2);
      check(p.normal, s.unit_normal);
    }
  }
}

TEST(KnownAnswers_SurfacePoints, InDoubleWithinAFewUlpOfTheControlPoints) {
  // One ulp of the largest control coordinate, 2: 2^-52 * 2.
  constexpr double kUlp = 0x1p-51;
  double position = 0, first = 0, normal = 0;
  for (const auto& a : answers().surfaces) {
    // The control points are rounded to double first: the truth is that of the rounded mesh.
    const data::ControlMesh mesh = data::control_mesh(a.vertices, a.faces);
    const StamEvaluator<double> fast(mesh);
    const StamEvaluator<N> exact(mesh);
    for (const auto& s : a.samples) {
      const Parameter l1 = Parameter::parse(s.barycentric[1]), l2 = Parameter::parse(s.barycentric[2]);
      const auto got = fast.evaluate(a.face, l1, l2);
      const auto want = exact.evaluate(a.face, l1, l2);
      const auto error = [](const Vec3<double>& x, const Vec3<N>& y) {
        return size(Vec3<N>{x.x, x.y, x.z} - y) / kUlp;
      };
      position = std::max(position, error(got.position, want.position));
      first = std::max({first, error(got.d1, want.d1), error(got.d2, want.d2)});
      normal = std::max(normal, error(got.normal, want.normal));
    }
  }
  RecordProperty("position_ulp", std::to_string(position));
  RecordProperty("first_ulp", std::to_string(first));
  RecordProperty("normal_ulp", std::to_string(normal));
  std::printf("worst in ulp of 2: position %.2f, d1 d2 %.2f, normal %.2f\n", position, first, normal);
  EXPECT_LE(position, StamError::kPosition);
  EXPECT_LE(first, StamError::kFirst);
  EXPECT_LE(normal * kUlp, StamError::kNormal);
}

TEST(KnownAnswers_ClosedMeshes, OneStepIsExactInRationals) {
  for (const auto& a : answers().closed_meshes) {
    const Topology topology(a.vertices.size(), a.faces);
    const auto refined = refine_once(topology, vecs<Rational>(a.vertices));
    for (std::size_t v = 0; v < a.vertices.size(); ++v)
      EXPECT_EQ(refined[v], vec<Rational>(a.step1_vertex_points[v])) << a.id;
    ASSERT_EQ(topology.edges().size(), a.step1_edge_points.size());
    for (std::size_t e = 0; e < topology.edges().size(); ++e) {
      const auto [low, high] = std::minmax(topology.edges()[e].a, topology.edges()[e].b);
      for (const auto& expected : a.step1_edge_points)
        if (expected.v0 == low && expected.v1 == high) {
          EXPECT_EQ(refined[a.vertices.size() + e], vec<Rational>(expected.position))
              << a.id << " edge " << low << "-" << high;
        }
    }
    for (std::size_t v = 0; v < a.vertices.size(); ++v) {
      std::vector<Vec3<Rational>> ring;
      for (const auto r : topology.ring(static_cast<std::int32_t>(v)))
        ring.push_back(vec<Rational>(a.vertices[r]));
      EXPECT_EQ(interior_limit<Rational>(vec<Rational>(a.vertices[v]), ring),
                vec<Rational>(a.limit_positions[v]))
          << a.id;
    }
  }
}

TEST(KnownAnswers_ClosedMeshes, FaceCentreByBothEvaluators) {
  ASSERT_EQ(answers().closed_meshes.size(), 2U);
  const Parameter third = Parameter::fraction(1, 3);
  for (const auto& a : answers().closed_meshes) {
    EXPECT_DIGITS(StamEvaluator<N>(vecs(a.vertices), a.faces).evaluate(0, third, third).position,
                  vec(a.face0_center_limit), a.id);
    EXPECT_DIGITS(SubdivisionEvaluator<N>(vecs(a.vertices), a.faces).evaluate(0, third, third).position,
                  vec(a.face0_center_limit), a.id);
  }
}

TEST(KnownAnswers_Basis, ValuesAndDerivativesAreExactInRationals) {
  ASSERT_EQ(answers().basis.size(), 6U);
  for (const auto& a : answers().basis) {
    Basis<Rational> basis;
    evaluate_basis(basis, data::parse<Rational>(a.alpha), data::parse<Rational>(a.beta),
                   Derivatives::kSecond);
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_EQ(basis.value[i], data::parse<Rational>(a.b[i])) << a.id << " b" << i + 1;
      EXPECT_EQ(basis.da[i], data::parse<Rational>(a.db_dalpha[i])) << a.id << " db" << i + 1 << "/dalpha";
      EXPECT_EQ(basis.db[i], data::parse<Rational>(a.db_dbeta[i])) << a.id << " db" << i + 1 << "/dbeta";
    }
  }
}

}  // namespace
}  // namespace limitcheck::reference
