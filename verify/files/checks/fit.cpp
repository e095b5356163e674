// SPDX-License-Identifier: MIT
// Moving a tessellation to where its control mesh is: scale, offset and rotation that a program put in.
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "verify/files/checks/file_evidence.h"

namespace limitcheck::verify {
namespace {

using Eigen::Affine3d, Eigen::Index, Eigen::Matrix3d, Eigen::Translation3d, Eigen::Vector3d;
using Points = Eigen::Matrix3Xd;  // a column each
using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// The feet of points, and the mean square distance.
struct Feet {
  Points at, normal;
  double error;
};
Feet feet_of(const ClosestPoint& surface, const Points& points) {
  Feet feet{Points(3, points.cols()), Points(3, points.cols()), 0};
  Eigen::VectorXd squares(points.cols());
  tbb::parallel_for(Index{0}, points.cols(), [&](Index k) {
    const Foot foot = surface.closest({points(0, k), points(1, k), points(2, k)});
    feet.at.col(k) = Vector3d::Map(foot.position.data());
    feet.normal.col(k) = Vector3d::Map(foot.normal.data());
    squares[k] = foot.distance * foot.distance;
  });
  feet.error = squares.mean();
  return feet;
}

// Every step-th point, some `count` of them.
Points chosen(const std::vector<Vector>& points, std::size_t count) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / count);
  Points some(3, static_cast<Index>((points.size() + step - 1) / step));
  for (Index k = 0; k < some.cols(); ++k)
    some.col(k) = Vector3d::Map(points[static_cast<std::size_t>(k) * step].data());
  return some;
}

Eigen::AlignedBox3d box_of(const std::vector<Vector>& points) {
  Eigen::AlignedBox3d box;
  for (const Vector& p : points) box.extend(Vector3d::Map(p.data()));
  return box;
}

// Rotations that take axes to axes.
std::vector<Matrix3d> orientations(Fit kind) {
  if (kind == Fit::kScale) return {Matrix3d::Identity()};
  std::vector<Matrix3d> list;
  std::array<int, 3> axis{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3d r = Matrix3d::Zero();
      for (int i = 0; i < 3; ++i) r(i, axis[i]) = (signs >> i & 1) != 0 ? -1 : 1;
      if (r.determinant() > 0) list.push_back(r);
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return list;
}

// The similarity that takes the points nearest to their feet, pair by pair.
Affine3d pairs_step(const Points& points, const Feet& feet, Fit kind) {
  if (kind == Fit::kSimilarity) return Affine3d(Eigen::umeyama(points, feet.at));
  const Vector3d from = points.rowwise().mean(), to = feet.at.rowwise().mean();
  const Points a = points.colwise() - from, b = feet.at.colwise() - to;
  return Translation3d(to) * Eigen::Scaling(a.cwiseProduct(b).sum() / a.squaredNorm()) * Translation3d(-from);
}

// One step on the distances along the normals: d + n . (x' delta) for an infinitesimal scaling, shift and turning.
Affine3d normal_step(const Points& mapped, const Feet& feet, Fit kind, const Vector3d& centre, double size) {
  const Points x = (mapped.colwise() - centre) / size;
  Eigen::MatrixXd rows(mapped.cols(), kind == Fit::kScale ? 4 : 7);
  rows.col(0) = x.cwiseProduct(feet.normal).colwise().sum();
  rows.middleCols(1, 3) = feet.normal.transpose();
  for (Index k = 0; kind != Fit::kScale && k < mapped.cols(); ++k)
    rows.row(k).tail(3) = x.col(k).cross(feet.normal.col(k));
  const Eigen::VectorXd right = (feet.at - mapped).cwiseProduct(feet.normal).colwise().sum() / size;
  if (!rows.allFinite() || !right.allFinite()) return Affine3d::Identity();  // a foot without a normal
  // The shortest solution: directions in which the surface can slide along itself stay as they are.
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd delta = svd.setThreshold(1e-9).solve(right);
  const Vector3d turn = kind == Fit::kScale ? Vector3d::Zero() : Vector3d(delta.tail(3));
  return Translation3d(centre + size * delta.segment(1, 3)) *
         Eigen::AngleAxisd(turn.norm(), turn.normalized()) * Eigen::Scaling(1 + delta[0]) *
         Translation3d(-centre);
}

// What brings the points nearest to the surface, and the rms distance then.
std::pair<Affine3d, double> nearest_map(const ClosestPoint& surface, const std::vector<Vector>& points,
                                        Fit kind) {
  if (points.size() < 3) return {Affine3d::Identity(), 0};
  std::vector<Vector> corners;
  for (std::size_t t = 0; t < surface.lattice().size(); ++t)
    for (const Vector& c : surface.lattice().corners(t)) corners.push_back(c);
  const Eigen::AlignedBox3d to = box_of(corners), from = box_of(points);
  const double size = to.diagonal().norm(), own_size = from.diagonal().norm();
  if (!(size > 0 && own_size > 0)) return {Affine3d::Identity(), 0};  // nothing can be laid on a point

  // Where to start.
  const Points few = chosen(points, 256), some = chosen(points, 4096);
  Affine3d best = Affine3d::Identity();
  double least = std::numeric_limits<double>::infinity();
  for (const Matrix3d& rotation : orientations(kind)) {
    Affine3d map =
        Translation3d(to.center()) * Affine3d((size / own_size) * rotation) * Translation3d(-from.center());
    Feet feet = feet_of(surface, map * few);
    for (int round = 0; round < 8; ++round) {
      map = pairs_step(few, feet, kind);
      feet = feet_of(surface, map * few);
    }
    if (feet.error < least) least = feet.error, best = map;
  }

  // Each round is kept if it is better; near the end the steps along the normals are better by far.
  Feet feet = feet_of(surface, best * some);
  least = feet.error;
  for (int round = 0; round < 40; ++round) {
    Affine3d next = normal_step(best * some, feet, kind, to.center(), size) * best;
    Feet there = feet_of(surface, next * some);
    if (!(there.error < least)) {
      next = pairs_step(some, feet, kind);
      there = feet_of(surface, next * some);
      if (!(there.error < least)) break;
    }
    const bool done = there.error > least * (1 - 1e-6);
    best = next, feet = std::move(there), least = feet.error;
    if (done) break;
  }
  return {best, std::sqrt(least)};
}

}  // namespace

std::string fit(const ClosestPoint& surface, FileTessellation& t, Fit kind) {
  std::vector<Vector> points;
  for (std::size_t v = 0; v < t.positions.size(); ++v)
    if (t.used[v] && is_finite(t.positions[v])) points.push_back(t.positions[v]);
  const auto [map, residual] = nearest_map(surface, points, kind);
  const Vector3d first = map.linear().col(0);
  const double scale = kind == Fit::kScale ? first[0] : first.stableNorm();
  std::array<Vector, 3> rotation{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // rows
  if (scale != 0) Rows::Map(rotation[0].data()) = map.linear() / scale;
  const Vector offset{map.translation()[0], map.translation()[1], map.translation()[2]};
  const auto turned = [&](const Vector& x) {
    return Vector{dot(rotation[0], x), dot(rotation[1], x), dot(rotation[2], x)};
  };
  for (Vector& p : t.positions) p = offset + scale * turned(p);
  for (auto& n : t.normals) n.direction = turned(n.direction);

  std::string text = fmt::format("scale {}", scale);
  const Eigen::AngleAxisd turn(Matrix3d(Rows::Map(rotation[0].data())));
  if (turn.angle() > 1e-12)
    text += fmt::format(", turned by {:.6f} degrees about ({:.6f}, {:.6f}, {:.6f})",
                        turn.angle() * 57.295779513082320877, turn.axis()[0], turn.axis()[1], turn.axis()[2]);
  return text + fmt::format(", offset ({}, {}, {}); rms distance then {:.3g} diagonals", offset[0], offset[1],
                            offset[2], residual / surface.diagonal());
}

}  // namespace limitcheck::verify
