// SPDX-License-Identifier: MIT
#include "verify/files/checks/fit.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace limitcheck::verify {
namespace {

using Rotation = std::array<Vector, 3>;  // rows
using Quaternion = std::array<double, 4>;

// The eigenvalues of a symmetric matrix, and its eigenvectors as rows, by Jacobi's method (Golub and Van Loan, Matrix
// Computations, 8.5). In long double, so that the squares of singular values down to 1e-9 of the largest are told from 0.
template <std::size_t N>
struct Spectrum {
  using Matrix = std::array<std::array<long double, N>, N>;
  std::array<long double, N> values{};
  Matrix vectors{};

  explicit Spectrum(Matrix a) {
    for (std::size_t i = 0; i < N; ++i) vectors[i][i] = 1;
    for (int sweep = 0; sweep < 30; ++sweep)
      for (std::size_t p = 0; p < N; ++p)
        for (std::size_t q = p + 1; q < N; ++q) {
          if (a[p][q] == 0) continue;
          const long double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
          const long double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::hypot(theta, 1.0L));
          const long double c = 1 / std::hypot(t, 1.0L), s = t * c;
          const auto turn = [c, s](long double& x, long double& y) {
            const long double old = x;
            x = c * old - s * y;
            y = s * old + c * y;
          };
          for (std::size_t k = 0; k < N; ++k) turn(a[k][p], a[k][q]);
          for (std::size_t k = 0; k < N; ++k) turn(a[p][k], a[q][k]);
          for (std::size_t k = 0; k < N; ++k) turn(vectors[p][k], vectors[q][k]);
          a[p][q] = a[q][p] = 0;
        }
    for (std::size_t i = 0; i < N; ++i) values[i] = a[i][i];
  }
};

// The rotation r that makes the sum of b . r(a) largest, from the sums s[i][j] of a[i] b[j]: Horn, Closed-form solution of
// absolute orientation using unit quaternions, 1987.
Quaternion quaternion_of(const std::array<Vector, 3>& s) {
  const double x = s[0][0], y = s[1][1], z = s[2][2];
  const double yz = s[1][2] - s[2][1], zx = s[2][0] - s[0][2], xy = s[0][1] - s[1][0];
  const double xx = s[1][2] + s[2][1], yy = s[2][0] + s[0][2], zz = s[0][1] + s[1][0];
  const Spectrum<4> spectrum(
      {{{x + y + z, yz, zx, xy}, {yz, x - y - z, zz, yy}, {zx, zz, y - x - z, xx}, {xy, yy, xx, z - x - y}}});
  const auto most =
      std::max_element(spectrum.values.begin(), spectrum.values.end()) - spectrum.values.begin();
  Quaternion q;
  std::copy_n(spectrum.vectors[static_cast<std::size_t>(most)].begin(), 4, q.begin());
  return q;
}

// Of a unit quaternion.
Rotation rotation_of(const Quaternion& q) {
  const auto [w, x, y, z] = q;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

Rotation transposed(const Rotation& r) {
  Rotation t;
  for (int i = 0; i < 3; ++i) t[i] = {r[0][i], r[1][i], r[2][i]};
  return t;
}

// The feet of the mapped points; returns the mean square distance.
double feet(const ClosestPoint& surface, const std::vector<Vector>& points, const Similarity& map,
            std::vector<Foot>& foot) {
  foot.resize(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t k) { foot[k] = surface.closest(map(points[k])); });
  double sum = 0;
  for (const Foot& f : foot) sum += f.distance * f.distance;
  return sum / static_cast<double>(points.size());
}

// Every step-th point, some `count` of them.
std::vector<Vector> chosen(const std::vector<Vector>& points, std::size_t count) {
  std::vector<Vector> some;
  const std::size_t step = std::max<std::size_t>(1, points.size() / count);
  for (std::size_t k = 0; k < points.size(); k += step) some.push_back(points[k]);
  return some;
}

struct Box {
  Vector middle{};
  double size = 0;
};
Box box_of(const std::vector<Vector>& points) {
  Vector low = points[0], high = points[0];
  for (const Vector& p : points)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  return {.5 * (low + high), norm(high - low)};
}

// Rotations that take axes to axes.
std::vector<Rotation> orientations(Fit kind) {
  if (kind == Fit::kScale) return {Similarity{}.rotation};
  std::vector<Rotation> list;
  std::array<int, 3> axis{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Rotation r{};
      for (int i = 0; i < 3; ++i) r[i][axis[i]] = (signs >> i & 1) != 0 ? -1 : 1;
      if (dot(r[0], cross(r[1], r[2])) > 0) list.push_back(r);
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return list;
}

// Takes `from` to `to`.
Similarity about(double scale, const Rotation& rotation, const Vector& from, const Vector& to) {
  Similarity map{.scale = scale, .rotation = rotation};
  map.offset = to - map(from);
  return map;
}

// The similarity that takes the points nearest to their feet, pair by pair (Umeyama 1991; Horn's rotation).
Similarity pairs_step(const std::vector<Vector>& points, const std::vector<Foot>& foot, Fit kind) {
  const double share = 1 / static_cast<double>(points.size());
  Vector from{}, to{};
  for (std::size_t k = 0; k < points.size(); ++k) {
    from = from + share * points[k];
    to = to + share * foot[k].position;
  }
  double square = 0;
  std::array<Vector, 3> sums{};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector a = points[k] - from, b = foot[k].position - to;
    square += dot(a, a);
    for (int i = 0; i < 3; ++i) sums[i] = sums[i] + a[i] * b;
  }
  Similarity map;
  if (kind == Fit::kSimilarity) map.rotation = rotation_of(quaternion_of(sums));
  const Rotation turn = transposed(map.rotation);
  map.scale = (dot(turn[0], sums[0]) + dot(turn[1], sums[1]) + dot(turn[2], sums[2])) / square;
  return about(map.scale, map.rotation, from, to);
}

// One step on the distances along the normals: d + n . (x' delta) for an infinitesimal scaling, turning and shift.
Similarity normal_step(const std::vector<Vector>& points, const std::vector<Foot>& foot,
                       const Similarity& map, Fit kind, const Vector& centre, double size) {
  constexpr std::size_t kUnknowns = 7;  // scale, shift, turn: the last are 0 for kScale
  Spectrum<kUnknowns>::Matrix a{};
  std::array<long double, kUnknowns> b{};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector mapped = map(points[k]), x = (1 / size) * (mapped - centre), &n = foot[k].normal;
    const Vector turn = kind == Fit::kScale ? Vector{} : cross(x, n);
    const std::array<long double, kUnknowns> row{dot(n, x), n[0], n[1], n[2], turn[0], turn[1], turn[2]};
    const double right = dot(n, foot[k].position - mapped) / size;
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      b[i] += right * row[i];
      for (std::size_t j = 0; j < kUnknowns; ++j) a[i][j] += row[i] * row[j];
    }
  }
  // The shortest solution: directions in which the surface can slide along itself stay as they are.
  const Spectrum<kUnknowns> spectrum(a);
  const long double largest = *std::max_element(spectrum.values.begin(), spectrum.values.end());
  std::array<double, kUnknowns> delta{};
  for (std::size_t m = 0; m < kUnknowns; ++m) {
    if (!(spectrum.values[m] > 1e-18L * largest)) continue;
    const auto& vector = spectrum.vectors[m];
    const long double part =
        std::inner_product(vector.begin(), vector.end(), b.begin(), 0.0L) / spectrum.values[m];
    for (std::size_t i = 0; i < kUnknowns; ++i) delta[i] += static_cast<double>(part * vector[i]);
  }
  const Vector shift{delta[1], delta[2], delta[3]}, w{delta[4], delta[5], delta[6]};
  const double half = norm(w) / 2, sine = half > 0 ? std::sin(half) / norm(w) : 0;
  const Rotation turn = rotation_of({std::cos(half), sine * w[0], sine * w[1], sine * w[2]});
  Rotation rotation;
  const Rotation columns = transposed(map.rotation);
  for (int i = 0; i < 3; ++i)
    rotation[i] = {dot(turn[i], columns[0]), dot(turn[i], columns[1]), dot(turn[i], columns[2])};
  const Similarity step = about(1 + delta[0], turn, centre, centre + size * shift);
  return {.scale = step.scale * map.scale, .rotation = rotation, .offset = step(map.offset)};
}

}  // namespace

Similarity fit(const ClosestPoint& surface, const std::vector<Vector>& points, Fit kind) {
  if (kind == Fit::kNone || points.size() < 3) return {};
  std::vector<Vector> corners;
  for (std::size_t t = 0; t < surface.lattice().size(); ++t)
    for (const Vector& c : surface.lattice().corners(t)) corners.push_back(c);
  const Box to = box_of(corners), from = box_of(points);
  if (!(from.size > 0)) return {};

  // Where to start.
  const std::vector<Vector> few = chosen(points, 256), some = chosen(points, 4096);
  std::vector<Foot> foot;
  Similarity best;
  double least = std::numeric_limits<double>::infinity();
  for (const Rotation& rotation : orientations(kind)) {
    Similarity map = about(to.size / from.size, rotation, from.middle, to.middle);
    double error = feet(surface, few, map, foot);
    for (int round = 0; round < 8; ++round) {
      map = pairs_step(few, foot, kind);
      error = feet(surface, few, map, foot);
    }
    if (error < least) {
      least = error;
      best = map;
    }
  }

  // Each round is kept if it is better; near the end the steps along the normals are better by far.
  least = feet(surface, some, best, foot);
  for (int round = 0; round < 40; ++round) {
    Similarity next = normal_step(some, foot, best, kind, to.middle, to.size);
    std::vector<Foot> kept = foot;
    double error = feet(surface, some, next, foot);
    if (!(error < least)) {
      foot = std::move(kept);
      next = pairs_step(some, foot, kind);
      error = feet(surface, some, next, foot);
      if (!(error < least)) break;
    }
    const bool done = error > least * (1 - 1e-6);
    best = next;
    least = error;
    if (done) break;
  }
  best.residual = std::sqrt(least);
  return best;
}

std::string to_string(const Similarity& map) {
  std::string text = fmt::format("scale {}", map.scale);
  const Quaternion q = quaternion_of(transposed(map.rotation));
  const Vector v{q[1], q[2], q[3]};
  const double half = std::atan2(norm(v), std::abs(q[0]));
  if (half > 5e-13) {
    const Vector axis = ((q[0] < 0 ? -1 : 1) / norm(v)) * v;
    text += fmt::format(", turned by {:.6f} degrees about ({:.6f}, {:.6f}, {:.6f})",
                        2 * half * 57.295779513082320877, axis[0], axis[1], axis[2]);
  }
  return text + fmt::format(", offset ({}, {}, {})", map.offset[0], map.offset[1], map.offset[2]);
}

}  // namespace limitcheck::verify
