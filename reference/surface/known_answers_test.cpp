// SPDX-License-Identifier: MIT
// Every known answer, to 39 digits: masks with 50-digit arithmetic, points of surfaces with 100-digit arithmetic by both
// evaluators, and in balls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "data/test_support/known_answers.h"
#include "reference/loop/basis.h"
#include "reference/loop/masks.h"
#include "reference/loop/vertex_limit.h"
#include "reference/number/number_exact.h"
#include "reference/surface/test_methods.h"

namespace limitcheck::reference {
namespace {

using N = Decimal50;
using Big = Decimal100;

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

/// Decimal digits in which two vectors agree, relative to the larger of 1 and the expected one's length.
template <class M>
double digits(const Vec3<M>& got, const Vec3<M>& expected) {
  const double scale = std::max(1.0, NumberTraits<M>::approximate(magnitude(expected)));
  const double error = NumberTraits<M>::approximate(magnitude(got - expected)) / scale;
  return error == 0 ? 100 : -std::log10(error);
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

SharpTags tags_of(const data::QuadAnswer& answer) {
  SharpTags tags;
  for (const auto& e : answer.sharp_edges) tags.edges.push_back({e.a, e.b, Parameter::parse(e.sharpness)});
  for (const auto& v : answer.sharp_vertices) tags.vertices.push_back({v.a, Parameter::parse(v.sharpness)});
  if (answer.boundary == "edge+corner") tags.boundary = data::Boundary::kEdgeAndCorner;
  if (answer.creasing == "chaikin") tags.creasing = data::Creasing::kChaikin;
  if (answer.triangles == "smooth") tags.triangles = data::TriangleRule::kSmooth;
  return tags;
}

data::Scheme scheme_of(const data::QuadAnswer& a) {
  return a.scheme == "loop" ? data::Scheme::kLoop : data::Scheme::kCatmullClark;
}

const std::vector<data::QuadAnswer>& surfaces() {
  static const auto loaded = data::load_quad_answers();
  return loaded;
}

TEST(KnownAnswers_SurfacePoints, AreFoundToThirtyNineDigitsByBothMethods) {
  const auto is_loop = [](const auto& a) { return scheme_of(a) == data::Scheme::kLoop; };
  ASSERT_EQ(std::ranges::count_if(surfaces(), is_loop), 23);
  ASSERT_EQ(surfaces().size(), 73U);
  for (const auto& a : surfaces()) {
    const Methods<Big> by(a.faces, vecs<Big>(a.vertices), tags_of(a), scheme_of(a));
    for (const auto& s : a.samples)
      for (const auto& at : {by.stam, by.by_steps}) {
        const auto p = at(s.face, s.corner, Parameter::parse(s.uv[0]), Parameter::parse(s.uv[1]));
        const std::string where = a.id + " (" + s.uv[0] + ", " + s.uv[1] + ") ";
        EXPECT_DIGITS(p.position, vec<Big>(s.position), where);
        if (s.normal) {
          EXPECT_DIGITS(p.normal, vec<Big>(*s.normal), where);
        }
        EXPECT_EQ(p.at_corner, s.at_vertex) << where;
        EXPECT_TRUE(p.first_exist || !s.du) << where;
        if (s.no_tangent_plane && !is_loop(a)) {
          EXPECT_EQ(p.normal_kind, NormalKind::kNoTangentPlane) << where;
        }
        if (s.du) {
          EXPECT_DIGITS(p.d1, vec<Big>(*s.du), where);
          EXPECT_DIGITS(p.d2, vec<Big>(*s.dv), where);
        }
        if (s.dudu) {
          EXPECT_DIGITS(p.d11, vec<Big>(*s.dudu), where);
          EXPECT_DIGITS(p.d12, vec<Big>(*s.dudv), where);
          EXPECT_DIGITS(p.d22, vec<Big>(*s.dvdv), where);
        }
      }
  }
}

// But for the rounding of the answers' own 42 digits.
TEST(KnownAnswers_SurfacePoints, AreInsideTheCertifiedEnclosures) {
  for (const auto& a : surfaces()) {
    if (a.faces.size() > 100) continue;  // balls at valence 50 take their time
    const CertifiedEvaluator evaluator(a.vertices, a.faces, scheme_of(a), tags_of(a));
    for (const auto& s : a.samples) {
      const auto p =
          evaluator.evaluate(s.face, s.corner, Parameter::parse(s.uv[0]), Parameter::parse(s.uv[1]), 45);
      const auto check = [&](const Enclosure3& got, const data::Numeral3& expected) {
        const Vec3<Big> want = vec<Big>(expected);
        expect_inside(got, want, magnitude(want) * Big("1e-41") + Big("1e-43"), a.id);
        if (scheme_of(a) == data::Scheme::kCatmullClark) return;
        for (const Enclosure& x : got) EXPECT_LE(x.radius.as_double(), 1e-40) << a.id;
      };
      check(p.position, s.position);
      if (s.normal) check(p.normal, *s.normal);
      if (s.du) check(p.d1, *s.du), check(p.d2, *s.dv);
      if (s.dudu) {
        ASSERT_TRUE(p.d11.has_value()) << a.id;
        check(*p.d11, *s.dudu), check(*p.d12, *s.dudv), check(*p.d22, *s.dvdv);
      }
      EXPECT_TRUE(p.first_exist || !s.du) << a.id;
    }
  }
}

// Rational points and sharpnesses give rational positions everywhere, and derivatives but at special
// vertices: the difference from the answer is the answer's rounding to 42 digits.
TEST(KnownAnswersOfCatmullClark, AreTheRoundedRationals) {
  const auto expect_rounded = [](const Vec3<Rational>& got, const data::Numeral3& expected,
                                 const std::string& what) {
    const Vec3<Rational> want = vec<Rational>(expected);
    EXPECT_LE(magnitude(got - want),
              (magnitude(want) + Rational(1)) / Rational(Integer("1" + std::string(40, '0'))))
        << what;
  };
  for (const auto& a : surfaces()) {
    if (scheme_of(a) != data::Scheme::kCatmullClark) continue;
    const catmull_clark::SubdivisionEvaluator<Rational> evaluator(a.faces, vecs<Rational>(a.vertices),
                                                                  tags_of(a));
    for (const auto& s : a.samples) {
      const auto p =
          evaluator.evaluate(s.face, s.corner, Parameter::parse(s.uv[0]), Parameter::parse(s.uv[1]));
      expect_rounded(p.position, s.position, a.id);
      EXPECT_EQ(p.first_exist, s.du.has_value()) << a.id;
      if (s.du) expect_rounded(p.d1, *s.du, a.id), expect_rounded(p.d2, *s.dv, a.id);
      if (!s.dudu) continue;
      expect_rounded(p.d11, *s.dudu, a.id), expect_rounded(p.d12, *s.dudv, a.id);
      expect_rounded(p.d22, *s.dvdv, a.id);
    }
  }
}

TEST(KnownAnswers_SurfacePoints, InDoubleWithinAFewUlpOfTheControlPoints) {
  // One ulp of the largest control coordinate, 2: 2^-52 * 2.
  constexpr double kUlp = 0x1p-51;
  double position = 0, first = 0, normal = 0;
  for (const auto& a : surfaces()) {
    if (a.has_sharp() || scheme_of(a) != data::Scheme::kLoop) continue;
    // The control points are rounded to double first: the truth is that of the rounded mesh.
    const data::ControlMesh mesh = data::control_mesh(a.vertices, a.faces);
    const StamEvaluator<double> fast(mesh);
    const StamEvaluator<N> exact(mesh);
    for (const auto& s : a.samples) {
      const Parameter l1 = Parameter::parse(s.uv[0]), l2 = Parameter::parse(s.uv[1]);
      const auto got = fast.evaluate(s.face, l1, l2);
      const auto want = exact.evaluate(s.face, l1, l2);
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

}  // namespace
}  // namespace limitcheck::reference
