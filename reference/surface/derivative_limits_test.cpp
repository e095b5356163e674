// SPDX-License-Identifier: MIT
// Which derivatives exist at vertices of every kind, and what they are: by the table of vertex_limit.h, by the
// eigenvalues of the rules as they are written down here once more, and by going there.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "reference/number/number_exact.h"
#include "reference/surface/test_methods.h"

namespace limitcheck::reference {
namespace {

using Big = Decimal100;
using data::ControlMesh, data::Scheme;

/// What a vertex is in the end, when all semi-sharp tags are gone; K faces on its side of sharp edges.
enum class Kind { kInside, kBoundary, kHeld, kCone, kDart };

/// One step of a vertex and its ring: c, the K or K + 1 neighbours e, and for quads the K far corners f.
Eigen::MatrixXd rules(Scheme scheme, Kind kind, int faces, Weights weights) {
  const bool open = kind == Kind::kBoundary || kind == Kind::kHeld, quads = scheme == Scheme::kCatmullClark;
  const int ends = faces + (open ? 1 : 0), size = 1 + ends + (quads ? faces : 0);
  const auto e = [&](int i) { return 1 + (i + ends) % ends; };
  const auto f = [&](int i) { return 1 + ends + (i + faces) % faces; };
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; quads && i < faces; ++i)
    for (const int corner : {0, e(i), e(i + 1), f(i)}) a(f(i), corner) += .25;
  for (int i = 0; i < ends; ++i) {
    const bool sharp = (open && (i == 0 || i == faces)) || (kind == Kind::kDart && i == 0);
    if (sharp) {
      a(e(i), 0) = a(e(i), e(i)) = .5;
    } else if (quads) {
      a(e(i), 0) = a(e(i), e(i)) = .25;
      a.row(e(i)) += (a.row(f(i)) + a.row(f(i - 1))) / 4;
    } else {
      a(e(i), 0) = a(e(i), e(i)) = 3. / 8;
      for (const int side : {-1, 1}) a(e(i), e(i + side)) += 1. / 8;
    }
  }
  if (kind == Kind::kHeld || kind == Kind::kCone) {
    a(0, 0) = 1;
  } else if (kind == Kind::kBoundary) {
    a(0, 0) = .75;
    for (const int i : {0, faces}) a(0, e(i)) += .125;
  } else if (quads) {
    Eigen::RowVectorXd c = Eigen::RowVectorXd::Zero(size);
    c(0) = (faces - 2.) / faces;
    for (int i = 0; i < faces; ++i) {
      c(e(i)) += 1. / (faces * faces);
      c += a.row(f(i)) / (faces * faces);
    }
    a.row(0) = c;
  } else {
    const double s = 3. / 8 + std::cos(2 * std::numbers::pi / faces) / 4;
    const double all = weights == Weights::kLoop ? 5. / 8 - s * s : faces == 3 ? 9. / 16 : 3. / 8;
    a(0, 0) = 1 - all;
    for (int i = 0; i < faces; ++i) a(0, e(i)) = all / faces;
  }
  return a;
}

/// What these say of the derivatives of one order. A mode of 2^-d without a Jordan block is a polynomial of
/// degree d on each face; beyond the ring the largest eigenvalue is 1/8.
DerivativeLimit by_rules(const Eigen::MatrixXd& a, int order) {
  const auto n = a.rows();
  const auto rank = [&](const Eigen::MatrixXd& m) {
    Eigen::FullPivLU<Eigen::MatrixXd> lu(m);
    lu.setThreshold(1e-7);
    return lu.rank();
  };
  DerivativeLimit limit{Fate::kZero, .125, 0};
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a, false);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double mu = std::abs(solver.eigenvalues()[i]);
    if (mu > .9) continue;
    bool polynomial = false;
    for (int degree = 1; degree <= order; ++degree) {
      if (std::abs(mu - std::ldexp(1., -degree)) > 1e-6) continue;
      const Eigen::MatrixXd shifted = a - std::ldexp(1., -degree) * Eigen::MatrixXd::Identity(n, n);
      polynomial = rank(shifted) == rank(shifted * shifted);
      if (degree == order) limit.fate = Fate::kValue;
    }
    if (!polynomial) limit.eigenvalue = std::max(limit.eigenvalue, mu);
  }
  limit.growth = std::ldexp(limit.eigenvalue, order);
  if (limit.growth > 1 - 1e-6) limit.fate = limit.growth > 1 + 1e-6 ? Fate::kGrows : Fate::kNoLimit;
  return limit;
}

/// A corner of a face's domain: (0, 0), (1, 0), (0, 1) of a triangle; (0, 0), (1, 0), (1, 1), (0, 1) of a
/// quad, or of the sub-quad at `corner`.
struct Place {
  int face, corner, k;
};
struct Case {
  std::string name;
  Scheme scheme;
  Kind kind;
  int faces;
  ControlMesh mesh;
  std::vector<Place> places;
  Weights weights = Weights::kLoop;
};

/// Without symmetry or flat sides, so that every mode is there.
ControlMesh uneven(ControlMesh mesh) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k)
      mesh.positions[v][k] += 0x1p-6 * static_cast<double>((7 * v + 3 * k + v * v) % 11);
  return mesh;
}

/// Where vertex v is a corner of a face: all such faces, or those next to each other from one on.
std::vector<Place> around(const ControlMesh& mesh, Scheme scheme, std::int32_t v, int first = 0,
                          int count = 100) {
  const Topology topology(mesh.positions.size(), mesh.faces);
  const auto sector = topology.sector(v).faces;
  std::vector<Place> places;
  for (int i = 0; i < std::min(count, static_cast<int>(sector.size())); ++i) {
    const std::int32_t f = sector[static_cast<std::size_t>(first + i) % sector.size()];
    const auto corners = mesh.faces[static_cast<std::size_t>(f)];
    const auto k = static_cast<int>(std::find(corners.begin(), corners.end(), v) - corners.begin());
    places.push_back(scheme == Scheme::kCatmullClark && corners.size() != 4 ? Place{f, k, 0}
                                                                            : Place{f, 0, k});
  }
  return places;
}

ControlMesh with_tags(ControlMesh mesh, std::initializer_list<std::pair<int, float>> spokes,
                      float vertex = 0) {
  const Topology topology(mesh.positions.size(), mesh.faces);
  for (const auto& [i, sharpness] : spokes)
    mesh.sharpness.edges.push_back(
        {0, topology.sector(0).neighbours[static_cast<std::size_t>(i)], sharpness});
  if (vertex > 0) mesh.sharpness.vertices.push_back({0, vertex});
  return mesh;
}

/// The same with a face of four corners cut from its corner k to the opposite one.
ControlMesh with_triangles(const ControlMesh& mesh, std::size_t face, std::size_t k) {
  ControlMesh result = mesh;
  result.faces = {};
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto c = mesh.faces[f];
    if (f != face) result.faces.push_back(c);
    for (std::size_t i = 1; f == face && i < 3; ++i)
      result.faces.push_back(std::array{c[k], c[(k + i) % 4], c[(k + i + 1) % 4]});
  }
  return result;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  constexpr float kEver = 10;
  for (const Scheme scheme : {Scheme::kLoop, Scheme::kCatmullClark}) {
    const bool loop = scheme == Scheme::kLoop;
    const auto add = [&](const std::string& name, Kind kind, int faces, ControlMesh mesh, int first = 0,
                         int count = 100) {
      mesh = uneven(std::move(mesh));
      std::vector<Place> places = around(mesh, scheme, 0, first, count);
      all.push_back({name, scheme, kind, faces, std::move(mesh), std::move(places)});
    };
    const auto wheel = [&](int n) { return loop ? data::wheel(n) : data::quad_wheel(n, 7); };
    const auto fan = [&](int k) { return loop ? data::fan(k) : data::quad_fan(k, 11); };
    for (const int n : {3, 4, 5, 6, 7, 8, 12}) {
      const std::string number = " " + std::to_string(n);
      add("inside" + number, Kind::kInside, n, wheel(n));
      add("dart" + number, Kind::kDart, n, with_tags(wheel(n), {{0, kEver}}));
      if (n < 8) add("cone" + number, Kind::kCone, n, with_tags(wheel(n), {}, kEver));
    }
    for (int k = 1; k <= 7; ++k) {
      add("boundary " + std::to_string(k), Kind::kBoundary, k, fan(k));
      add("held " + std::to_string(k), Kind::kHeld, k, with_tags(fan(k), {}, kEver));
    }
    ControlMesh corner = fan(1);
    corner.sharpness.boundary = data::Boundary::kEdgeAndCorner;
    add("boundary 1, edge and corner", Kind::kHeld, 1, corner);
    for (const int k : {1, 2, 3}) {  // the sectors of a crease, those of three
      const ControlMesh crease = with_tags(wheel(7), {{0, kEver}, {k, kEver}});
      add("crease " + std::to_string(k), Kind::kBoundary, k, crease, 0, k);
      add("crease " + std::to_string(7 - k), Kind::kBoundary, 7 - k, crease, k, 7 - k);
    }
    const ControlMesh three = with_tags(wheel(6), {{0, kEver}, {1, kEver}, {3, kEver}});
    for (int k = 1; k <= 3; ++k)
      add("three creases " + std::to_string(k), Kind::kHeld, k, three, k * (k - 1) / 2, k);
    // Semi-sharp: what is left in the end.
    add("held for 1.5 steps", Kind::kInside, 3, with_tags(wheel(3), {}, 1.5F));
    add("held for 2.25 steps", Kind::kBoundary, 1, with_tags(fan(1), {}, 2.25F));
    const int plane = loop ? 6 : 4;
    add("dart beside a semi-sharp edge", Kind::kDart, plane,
        with_tags(wheel(plane), {{0, kEver}, {2, 1.5F}}));
    add("crease 2 with a semi-sharp edge", Kind::kBoundary, 2,
        with_tags(wheel(5), {{0, kEver}, {2, kEver}, {3, .75F}}), 0, 2);
    add("held 2 with a semi-sharp edge", Kind::kHeld, 2, with_tags(fan(2), {{1, 2}}, kEver));
  }
  for (const int n : {4, 5}) {
    const ControlMesh wheel = data::wheel(n);
    for (const bool dart : {false, true}) {
      const ControlMesh mesh = uneven(dart ? with_tags(wheel, {{0, kEver}}) : wheel);
      all.push_back({"Warren's " + std::string(dart ? "dart " : "") + std::to_string(n), Scheme::kLoop,
                     dart ? Kind::kDart : Kind::kInside, n, mesh, around(mesh, Scheme::kLoop, 0),
                     Weights::kWarren});
    }
  }
  // Faces of other than four corners: their vertices, middles, and middles of edges.
  for (const int n : {3, 5, 6}) {
    const ControlMesh prism = uneven(data::polygon_prism(n));
    const std::string name = " of a " + std::to_string(n) + "-gon";
    const auto add = [&](const std::string& what, Kind kind, int faces, const ControlMesh& mesh,
                         std::vector<Place> places) {
      all.push_back({what + name, Scheme::kCatmullClark, kind, faces, mesh, std::move(places)});
    };
    add("corner", Kind::kInside, 3, prism, around(prism, Scheme::kCatmullClark, 0));
    add("middle", Kind::kInside, n, prism, {{0, 0, 2}, {0, n - 1, 2}});
    add("middle of an edge", Kind::kInside, 4, prism, {{0, 1, 1}, {0, 2, 3}});
    ControlMesh alone = prism;
    alone.faces = {};
    alone.faces.push_back(prism.faces[0]);
    alone.positions.resize(static_cast<std::size_t>(n));
    add("corner, alone,", Kind::kBoundary, 1, alone, around(alone, Scheme::kCatmullClark, 0));
    add("middle, alone,", Kind::kInside, n, alone, {{0, 1, 2}});
    add("middle of a boundary edge", Kind::kBoundary, 2, alone, {{0, 1, 1}, {0, 2, 3}});
  }
  const auto mixed = [&](const std::string& name, Kind kind, int faces, const ControlMesh& mesh,
                         std::size_t face, std::size_t k) {
    const ControlMesh cut = uneven(with_triangles(mesh, face, k));
    all.push_back({name + " beside a triangle", Scheme::kCatmullClark, kind, faces, cut,
                   around(cut, Scheme::kCatmullClark, 0)});
  };
  mixed("boundary 1", Kind::kBoundary, 1, data::quad_fan(1, 11), 3, 0);
  const ControlMesh dart = with_tags(data::quad_wheel(4, 7), {{0, kEver}});
  for (const std::size_t face : {std::size_t{0}, std::size_t{5}}) {
    const auto corners = dart.faces[face];
    const auto hub = std::find(corners.begin(), corners.end(), 0) - corners.begin();
    mixed("dart 4", Kind::kDart, 4, dart, face, static_cast<std::size_t>(hub + 1) % 4);
  }
  return all;
}

/// The parameters of the point (x, y) steps of 2^-halvings / 16 from a corner, x towards the next.
std::array<Parameter, 2> near(const Case& c, int k, int x, int y, int halvings) {
  const Rational unit = Rational(1, Integer(16) << halvings);
  return seen_from(static_cast<std::size_t>(k), c.scheme == Scheme::kLoop ? 3 : 4, x * unit, y * unit);
}

std::vector<Vec3<Big>> derivatives(const SurfacePoint<Big>& p, int order) {
  return order == 1 ? std::vector{p.d1, p.d2} : std::vector{p.d11, p.d12, p.d22};
}
bool exist(const SurfacePoint<Big>& p, int order) {
  return order == 1 ? p.first_exist : p.second_exist;
}
Big farthest(const std::vector<Vec3<Big>>& a, const std::vector<Vec3<Big>>& b) {
  Big most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, Big(magnitude(a[i] - b[i])));
  return most;
}

constexpr int kFar = 30, kClose = 80;
constexpr std::array<std::array<int, 2>, 4> kDirections{{{16, 3}, {5, 14}, {8, 8}, {12, 1}}};

/// log2 of the factor by which something changes with each halving.
double slope(const Big& far, const Big& close) {
  return static_cast<Big>(log2(Big(close / far))).convert_to<double>() / (kClose - kFar);
}

void expect_what_is_near(const Case& c, const Methods<Big>& evaluate, const Place& place, int order,
                         const DerivativeLimit& want) {
  const std::string what =
      c.name + ", face " + std::to_string(place.face) + ", order " + std::to_string(order);
  const auto corner = near(c, place.k, 0, 0, 0);
  const SurfacePoint<Big> at = evaluate.stam(place.face, place.corner, corner[0], corner[1]),
                          same = evaluate.by_steps(place.face, place.corner, corner[0], corner[1]);
  const std::vector<Vec3<Big>> here = derivatives(at, order);
  EXPECT_EQ(exist(at, order), want.exists()) << what;
  EXPECT_EQ(exist(same, order), want.exists()) << what;
  if (want.exists()) {
    EXPECT_LE(farthest(derivatives(same, order), here), Big("1e-80")) << what;
  }
  if (at.at_corner) {
    const DerivativeLimit& table = order == 1 ? at.limits.first : at.limits.second;
    EXPECT_EQ(table.fate, want.fate) << what;
    EXPECT_NEAR(table.eigenvalue, want.eigenvalue, want.fate == Fate::kNoLimit ? 1e-6 : 1e-9) << what;
    EXPECT_EQ(table.growth, std::ldexp(table.eigenvalue, order)) << what;
  }
  const std::vector<Vec3<Big>> zero(here.size());
  Big far = 0, close = 0, spread = 0;
  std::vector<Vec3<Big>> first;
  for (const auto& [x, y] : kDirections) {
    const auto seen = [&, &x = x, &y = y](int halvings) {
      const auto [u, v] = near(c, place.k, x, y, halvings);
      return derivatives(evaluate.stam(place.face, place.corner, u, v), order);
    };
    const auto d_far = seen(kFar), d_close = seen(kClose);
    const auto& origin = want.exists() ? here : zero;
    far = std::max(far, farthest(d_far, origin));
    close = std::max(close, farthest(d_close, origin));
    if (first.empty()) first = d_close;
    spread = std::max(spread, farthest(d_close, first));
  }
  if (want.fate == Fate::kZero) {
    EXPECT_EQ(farthest(here, zero), 0) << what;
  }
  if (want.fate == Fate::kValue && order == 1) {
    EXPECT_GT(farthest(here, zero), 1e-3) << what;
  }
  EXPECT_NEAR(slope(far, close), std::log2(want.growth), .04) << what;
  if (want.fate == Fate::kNoLimit) {
    EXPECT_GT(spread, 1e-3) << what;
  }
}

TEST(DerivativeLimits, AreWhatEigenvaluesSayAndWhatIsSeenNextToTheVertex) {
  const std::vector<Case> all = cases();
  EXPECT_GE(all.size(), 110U);
  for (const Case& c : all) {
    const Eigen::MatrixXd a = rules(c.scheme, c.kind, c.faces, c.weights);
    const Methods<Big> evaluate(c.mesh, c.scheme, c.weights);
    ASSERT_FALSE(c.places.empty()) << c.name;
    std::vector<Place> places = c.places;  // of many the first two, one in the middle and the last
    if (places.size() > 4) places = {places[0], places[1], places[places.size() / 2], places.back()};
    for (const Place& place : places)
      for (const int order : {1, 2}) expect_what_is_near(c, evaluate, place, order, by_rules(a, order));
  }
}

TEST(DerivativeLimits, AreCertified) {
  for (const Case& c : cases()) {
    if (c.weights != Weights::kLoop) continue;
    const Place& place = c.places.front();
    const auto corner = near(c, place.k, 0, 0, 0);
    const SurfacePoint<Big> want =
        Methods<Big>(c.mesh, c.scheme).stam(place.face, place.corner, corner[0], corner[1]);
    const CertifiedPoint got =
        CertifiedEvaluator(c.mesh, c.scheme).evaluate(place.face, place.corner, corner[0], corner[1], 20);
    const auto check = [&](const Enclosure3& box, const Vec3<Big>& v, const char* what) {
      expect_inside(box, v, Big("1e-90"), c.name + what);
      for (const Enclosure& x : box) EXPECT_LE(x.radius.as_double(), 1e-17) << c.name << what;
    };
    EXPECT_EQ(got.first_exist, want.first_exist) << c.name;
    EXPECT_EQ(got.d11.has_value(), want.second_exist) << c.name;
    check(got.d1, want.d1, " d1");
    check(got.d2, want.d2, " d2");
    if (got.d11)
      check(*got.d11, want.d11, " d11"), check(*got.d12, want.d12, " d12"), check(*got.d22, want.d22, " d22");
    if (want.at_corner) {
      EXPECT_FALSE(got.gaussian_curvature) << c.name;
    }
  }
}

}  // namespace
}  // namespace limitcheck::reference
