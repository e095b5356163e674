// SPDX-License-Identifier: MIT
#include "verify/files/checks/fit.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

namespace limitcheck::verify {
namespace {

using Points = Eigen::Matrix3Xd;

Vector vector(const Eigen::Vector3d& v) {
  return {v[0], v[1], v[2]};
}
Eigen::Vector3d eigen(const Vector& v) {
  return {v[0], v[1], v[2]};
}

Similarity similarity(double scale, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& offset) {
  Similarity s;
  s.scale = scale;
  for (int i = 0; i < 3; ++i) s.rotation[i] = vector(rotation.row(i));
  s.offset = vector(offset);
  return s;
}

Eigen::Matrix3d rotation_of(const Similarity& s) {
  Eigen::Matrix3d r;
  for (int i = 0; i < 3; ++i) r.row(i) = eigen(s.rotation[i]);
  return r;
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
std::vector<Eigen::Matrix3d> orientations(Fit kind) {
  if (kind == Fit::kScale) return {Eigen::Matrix3d::Identity()};
  std::vector<Eigen::Matrix3d> list;
  std::array<int, 3> axis{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d r = Eigen::Matrix3d::Zero();
      for (int i = 0; i < 3; ++i) r(i, axis[i]) = (signs >> i & 1) != 0 ? -1 : 1;
      if (r.determinant() > 0) list.push_back(r);
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return list;
}

// One step on the distances along the normals: d + n . (x'
// delta) for an infinitesimal scaling, turning and shift.
Similarity normal_step(const std::vector<Vector>& points, const std::vector<Foot>& foot,
                       const Similarity& map, Fit kind, const Vector& centre, double size) {
  const int unknowns = kind == Fit::kScale ? 4 : 7;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Eigen::Dynamic, 7> a(points.size(), unknowns);
  Eigen::VectorXd b(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector mapped = map(points[k]);
    const Eigen::Vector3d x = eigen(mapped - centre) / size, n = eigen(foot[k].normal);
    const auto row = static_cast<Eigen::Index>(k);
    a(row, 0) = n.dot(x);
    a.block<1, 3>(row, 1) = n.transpose();
    if (unknowns == 7) a.block<1, 3>(row, 4) = x.cross(n).transpose();
    b[row] = dot(foot[k].normal, foot[k].position - mapped) / size;
  }
  // The shortest solution: directions in which the surface can slide along itself stay as they are.
  Eigen::CompleteOrthogonalDecomposition<decltype(a)> orthogonal;
  orthogonal.setThreshold(1e-9);
  orthogonal.compute(a);
  const Eigen::VectorXd delta = orthogonal.solve(b);
  const double scale = 1 + delta[0];
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (unknowns == 7) {
    const Eigen::Vector3d w = delta.tail<3>();
    if (w.norm() > 0) turn = Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
  }
  const Eigen::Matrix3d rotation = turn * rotation_of(map);
  const Eigen::Vector3d shift = delta.segment<3>(1) * size;
  const Eigen::Vector3d c = eigen(centre);
  return similarity(scale * map.scale, rotation, scale * (turn * (eigen(map.offset) - c)) + c + shift);
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
  const auto pairs_step = [&](const std::vector<Vector>& list, const Similarity& map) {
    Points source(3, list.size()), target(3, list.size());
    for (std::size_t k = 0; k < list.size(); ++k) {
      source.col(static_cast<Eigen::Index>(k)) = eigen(list[k]);
      target.col(static_cast<Eigen::Index>(k)) = eigen(foot[k].position);
    }
    if (kind == Fit::kSimilarity) {
      const Eigen::Matrix4d m = Eigen::umeyama(source, target, true);
      const double scale = std::cbrt(m.topLeftCorner<3, 3>().determinant());
      if (!(scale > 0)) return map;
      return similarity(scale, m.topLeftCorner<3, 3>() / scale, m.topRightCorner<3, 1>());
    }
    const Eigen::Vector3d s = source.rowwise().mean(), t = target.rowwise().mean();
    const Points ds = source.colwise() - s, dt = target.colwise() - t;
    const double scale = ds.cwiseProduct(dt).sum() / ds.squaredNorm();
    return similarity(scale, Eigen::Matrix3d::Identity(), t - scale * s);
  };
  for (const Eigen::Matrix3d& rotation : orientations(kind)) {
    const double scale = to.size / from.size;
    Similarity map = similarity(scale, rotation, eigen(to.middle) - scale * (rotation * eigen(from.middle)));
    double error = feet(surface, few, map, foot);
    for (int round = 0; round < 8; ++round) {
      map = pairs_step(few, map);
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
      next = pairs_step(some, best);
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
  const Eigen::AngleAxisd turn(rotation_of(map));
  if (std::abs(turn.angle()) > 1e-12) {
    const Eigen::Vector3d& a = turn.axis();
    text += fmt::format(", turned by {:.6f} degrees about ({:.6f}, {:.6f}, {:.6f})",
                        turn.angle() * 57.295779513082320877, a[0], a[1], a[2]);
  }
  return text + fmt::format(", offset ({}, {}, {})", map.offset[0], map.offset[1], map.offset[2]);
}

}  // namespace limitcheck::verify
