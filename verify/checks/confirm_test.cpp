// SPDX-License-Identifier: MIT
// No finding by the reference in double alone, and a bound that knows how well a normal can be known. Where the
// tangents of the surface vanish but for rounding no subject has a finding, and row streaming takes the same
// side as the sliding window.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "data/generators/named_mesh.h"
#include "data/numeral.h"
#include "data/shapes.h"
#include "data/test_meshes.h"
#include "data/test_support/assertions.h"
#include "verify/audit/audit.h"
#include "verify/checks/checks.h"
#include "verify/evidence/test_script.h"
#include "verify/host/host.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/row/bounds.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using test::exact_script;
using test::Scripted;

// Errors 0 .. 23 of the vertices of a tetrahedron at depth 1, the bound 10.
struct Asked {
  std::vector<double> error;
  std::vector<std::size_t> order;  // in which the certified evaluator was asked
  Confirmation confirmation;
};
Asked ask(const std::function<double(std::size_t)>& truth) {
  const Scripted scripted(data::tetrahedron(), {1, 1, 1, 1}, exact_script(data::tetrahedron(), 1));
  Asked asked;
  for (int k = 0; k < 24; ++k) asked.error.push_back((5 * k) % 24);  // all different, in disorder
  asked.confirmation = confirm(
      *scripted, asked.error, [&](std::size_t v) { return scripted->point[v]; },
      [](std::size_t) { return 10.0; },
      [&](std::size_t v, const ExactPoint& exact) {
        asked.order.push_back(v);
        EXPECT_LE(norm(exact.position - scripted->tessellation.position(static_cast<std::int64_t>(v))),
                  1e-15);
        return truth(v);
      });
  return asked;
}
// The vertex whose error in double is e.
std::size_t with(int e) {
  std::size_t k = 0;
  while ((5 * k) % 24 != static_cast<std::size_t>(e)) ++k;
  return k;
}

TEST(Confirm, OneLookIsEnoughWhereDoubleIsRight) {
  const Asked a = ask([](std::size_t) { return 23.5; });
  EXPECT_EQ(a.order, std::vector<std::size_t>{with(23)}) << "the worst";
  EXPECT_EQ(a.confirmation.worst, static_cast<std::int64_t>(with(23)));
  EXPECT_EQ(a.confirmation.looked, 1);
  EXPECT_EQ(a.confirmation.acquitted, 0);
  EXPECT_EQ(a.confirmation.message, "");
  EXPECT_EQ(a.error[with(23)], 23.5) << "as the certified numbers have it";
  EXPECT_EQ(std::count_if(a.error.begin(), a.error.end(), [](double e) { return e > 10; }), 13);
}

TEST(Confirm, AllAreLookedAtWhereDoubleIsWrong) {
  const Asked a = ask([](std::size_t v) { return v == with(20) ? 12.0 : 1.0; });
  EXPECT_EQ(a.order.size(), 13U);
  EXPECT_EQ(a.order[0], with(23));
  EXPECT_EQ(a.order[3], with(20));
  EXPECT_EQ(a.confirmation.worst, static_cast<std::int64_t>(with(20)));
  EXPECT_EQ(a.confirmation.acquitted, 12);
  EXPECT_EQ(std::count_if(a.error.begin(), a.error.end(), [](double e) { return e > 10; }), 1);
  EXPECT_EQ(
      a.confirmation.message,
      "the reference in double has 13 points beyond the bound; of 13 put before certified numbers, 12 are "
      "not");
}

TEST(Confirm, WhereThereIsNothingToJudgeNothingIsFound) {
  const Asked a = ask([](std::size_t) { return -1.0; });
  EXPECT_EQ(a.confirmation.worst, -1);
  EXPECT_EQ(a.confirmation.looked, 13);
  EXPECT_EQ(a.confirmation.acquitted, 13);
  EXPECT_EQ(std::count(a.error.begin(), a.error.end(), -1.0), 13);
}

// A flat sheet of 4 x 4 rectangles is its own limit, and the derivatives are the sides: in the middle those
// of the triangle (0, 0) (1, 0) (1, h), of length 1 and sqrt(1 + h^2) with an area vector of length h.
TEST(Condition, IsThatOfTheTangents) {
  for (const double h : {1.0, 1e-3}) {
    data::ControlMesh mesh;
    for (int y = 0; y <= 4; ++y)
      for (int x = 0; x <= 4; ++x) mesh.positions.push_back({static_cast<double>(x), y * h, 0});
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) {
        const int v = 5 * y + x;
        mesh.faces.push_back({v, v + 1, v + 6});
        mesh.faces.push_back({v, v + 6, v + 5});
      }
    ReferenceSurface surface(mesh, 1, LC_POINTS_LIMIT);
    const Lattice::Id id = surface.lattice().id({2 * (4 * 1 + 1), 1, 1, 2});
    surface.prepare({&id, 1});
    const double expected = (1 + std::sqrt(1 + h * h)) / h;
    EXPECT_NEAR(surface.normal_condition(id), expected, 1e-11 * expected) << h;
  }
}

// By hand: 5 * 2^-24 * 3 * 1000 = 0.00089 rad.
TEST(Condition, TurnsANormalByTheErrorOfTheTangents) {
  EXPECT_NEAR(conditioned_normal_bound(LC_FLOAT32, 3, 1000), std::asin(5 * 0x1p-24 * 3000) * 180 / M_PI,
              1e-12);
  EXPECT_NEAR(conditioned_normal_bound(LC_FLOAT64, 1, 1), 5 * 0x1p-53 * 180 / M_PI, 1e-25);
  EXPECT_EQ(conditioned_normal_bound(LC_FLOAT32, 1, 1e30), 180);
  EXPECT_EQ(conditioned_normal_bound(LC_FLOAT32, 1, std::numeric_limits<double>::infinity()), 180);
}

TEST(Condition, IsFiniteAndScalesAtEveryPointOfEveryStockShape) {
  for (const char* name : {"tetrahedron", "bipyramid:64", "ragged-disc", "fan:7"})
    for (const double size : {1e-150, 1.0, 1e150}) {
      data::ControlMesh mesh = data::named_mesh(name);
      for (auto& p : mesh.positions)
        for (double& x : p) x *= size;
      ReferenceSurface surface(mesh, 2, LC_POINTS_LIMIT);
      std::vector<Lattice::Id> all(surface.lattice().size());
      for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<Lattice::Id>(k);
      surface.prepare(all);
      for (const Lattice::Id id : all)
        if (surface.has_normal(id)) {
          EXPECT_GT(surface.normal_condition(id) * size, 1e-3) << name;
          EXPECT_LT(surface.normal_condition(id) * size, 1e6) << name;
        }
    }
}

data::ControlMesh wheel_of_twelve(const std::array<double, 3>& hub,
                                  const std::array<std::array<double, 3>, 12>& ring) {
  data::ControlMesh mesh{{hub}, {}};
  mesh.positions.insert(mesh.positions.end(), ring.begin(), ring.end());
  for (std::int32_t i = 0; i < 12; ++i) mesh.faces.push_back({0, i + 1, (i + 1) % 12 + 1});
  return mesh;
}

/// Rings of dyadic numbers whose first harmonic is zero, though not one rounded sum of it is.
data::ControlMesh tilted() {
  return wheel_of_twelve({.25, .5, -.375}, {{{3.75, .25, 1},
                                             {1.5, .125, -.125},
                                             {-2.5, 1.625, -.5},
                                             {-1.75, 1.75, .625},
                                             {1, -.375, -1.25},
                                             {1, -1.875, -1.625},
                                             {.75, .25, .25},
                                             {1.5, 3.125, -.125},
                                             {.5, 1.625, .25},
                                             {-1.75, -1.25, .625},
                                             {-2, -.375, -2},
                                             {1, 1.125, -1.625}}});
}

// Whatever the finding, what was expected is what the digits say.
TEST(Findings, ExpectWhatTheirDigitsSay) {
  int findings = 0;
  for (const char* fault : {"wrong_limit_mask", "wrong_edge_mask", "flipped_normals", "one_flipped_normal"})
    for (const AuditMesh& mesh : {AuditMesh{"tilted-hub", tilted()}, {"icosahedron", data::icosahedron()}})
      for (const Result& r :
           Auditor(2, 1).run({lc_subject_faulty(), faulty_options(fault, "sliding-window")}, mesh)) {
        if (r.status != Status::kFinding || (r.check != "positions" && r.check != "normals")) continue;
        ++findings;
        ASSERT_TRUE(r.witness.has_value());
        ASSERT_EQ(r.witness->expected_digits.size(), 3U) << fault << " " << r.check;
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_EQ(r.witness->expected[c], data::parse<double>(r.witness->expected_digits[c]));
        EXPECT_GT(*r.worst, *r.bound);
      }
  EXPECT_EQ(findings, 8);
}

// A needle of 1 : 1e5 turns normals far in float, which is no fault; a flipped one is.
TEST(Findings, OnNeedlesTheRowSaysHowWellNormalsCanBeKnown) {
  data::ControlMesh needles = data::torus(5, 4);
  for (auto& p : needles.positions) p[2] *= 1e-5;
  const AuditMesh mesh{"needles", needles};
  for (const char* name : {"sliding-window", "row-stream"}) {
    const Result r = row(Auditor(2, 1).run({find_subject(name), ""}, mesh), "normals");
    EXPECT_EQ(r.status, Status::kHeld) << r.message;
    ASSERT_TRUE(r.ill_conditioned.has_value());
    EXPECT_GT(r.ill_conditioned->count, 0);
    EXPECT_LE(r.ill_conditioned->worst, r.ill_conditioned->bound);
    EXPECT_TRUE(says(r.message, "ill-conditioned: "));
  }
  const Result flipped =
      row(Auditor(2, 1).run({lc_subject_faulty(), faulty_options("flipped_normals", "sliding-window")}, mesh),
          "normals");
  EXPECT_EQ(flipped.status, Status::kFinding);
  const Result ordinary =
      row(Auditor(2, 1).run({find_subject("sliding-window"), ""}, {"torus", data::torus(5, 4)}), "normals");
  EXPECT_FALSE(ordinary.ill_conditioned.has_value());
  EXPECT_EQ(ordinary.bound, normal_bound(LC_FLOAT32, 2)) << "an ordinary mesh is judged as ever";
}

/// The same in a plane; the control facets face down, those after a step up.
data::ControlMesh in_a_plane() {
  return wheel_of_twelve({0, 0, 0}, {{{3.5, 0, 0},
                                      {1, -.5, 0},
                                      {-2.5, 1, 0},
                                      {-2, 1.5, 0},
                                      {.5, -1, 0},
                                      {1, -2.5, 0},
                                      {.5, 0, 0},
                                      {1, 2.5, 0},
                                      {.5, 1, 0},
                                      {-2, -1.5, 0},
                                      {-2.5, -1, 0},
                                      {1, .5, 0}}});
}

TEST(VanishingNormals, BlameNoSoundSubject) {
  const std::vector<std::pair<std::string, data::ControlMesh>> meshes{
      {"tilted", tilted()}, {"in a plane", in_a_plane()}, {"sphere", data::sphere_with_residue(16)}};
  const std::vector<std::pair<const char*, const char*>> subjects{{"model", ""},
                                                                  {"naive", ""},
                                                                  {"sliding-window", "precision=double"},
                                                                  {"sliding-window", ""},
                                                                  {"row-stream", ""}};
  for (const auto& [name, mesh] : meshes) {
    for (const int depth : {0, 1, 4}) {
      Auditor auditor(depth, 1);
      for (const auto& [subject, options] : subjects) {
        const auto results = auditor.run({find_subject(subject), options}, {name, mesh});
        for (const char* check : {"positions", "normals", "normal-length", "normals-against-positions"})
          EXPECT_EQ(row(results, check).status, Status::kHeld)
              << subject << " " << options << " " << name << " depth " << depth << " " << check;
      }
    }
  }
}

TEST(VanishingNormals, FaceTheSameWayInBothEngines) {
  for (const char* subject : {"sliding-window", "row-stream"}) {
    Session session(*find_subject(subject), in_a_plane());
    const Tessellation t = session.tessellate(1);
    std::int64_t hubs = 0;
    for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
      const lc_provenance& p = t.provenance()[v];
      if (p.i != 0 || p.j != 0) continue;
      ++hubs;
      EXPECT_EQ(t.normal(v), (Vector{0, 0, 1})) << subject;
      for (const double c : t.normal(v)) EXPECT_FALSE(std::signbit(c)) << subject;
    }
    EXPECT_GT(hubs, 0) << subject;
  }
}

}  // namespace

}  // namespace limitcheck::verify
