// SPDX-License-Identifier: MIT
#include "verify/projection/surface_lattice.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "reference/loop/stam.h"

namespace limitcheck::verify {
namespace {

std::array<double, 3> middle(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

}  // namespace

FacePoint Piece::parameter(const std::array<double, 3>& weight) const {
  FacePoint p{face, {}};
  for (int k = 0; k < 3; ++k) p.l[k] = weight[0] * at[0][k] + weight[1] * at[1][k] + weight[2] * at[2][k];
  p.l = clamped(p.l);
  return p;
}

int SurfaceLattice::depth_for(std::size_t faces, std::size_t pieces) {
  int depth = 2;
  while (depth < 7 && faces << (2 * depth + 2) <= pieces) ++depth;
  return depth;
}

SurfaceLattice::SurfaceLattice(const data::ControlMesh& mesh, int depth) : depth_(depth) {
  const auto refined = reference::refine<double>(mesh, depth);
  triangles_ = refined.triangles();
  const auto limits = refined.limits().positions;
  for (const auto& p : limits) limits_.push_back(vector_of(p));

  const auto& topology = refined.topology();
  const auto vertices = mesh.positions.size();
  bounds_.resize(vertices);
  tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
    const auto id = static_cast<std::int32_t>(v);
    if (topology.ring(id).size() != (topology.on_boundary(id) ? 4U : 6U))
      bounds_[v] = corner_bounds(topology, refined.positions(), id);
  });
  deviation_.resize(triangles_.size());
  irregular_.assign(triangles_.size(), -1);
  tbb::parallel_for(std::size_t{0}, triangles_.size(), [&](std::size_t t) {
    for (const std::int32_t v : triangles_[t])
      if (static_cast<std::size_t>(v) < vertices && !bounds_[v].corner.empty()) irregular_[t] = v;
    deviation_[t] = irregular_[t] >= 0 ? bounds_[irregular_[t]].corner[0]
                                       : regular_bound(topology, refined.positions(), triangles_[t]).value();
  });
}

double SurfaceLattice::largest_deviation() const {
  return *std::max_element(deviation_.begin(), deviation_.end());
}

std::array<Vector, 3> SurfaceLattice::corners(std::size_t index) const {
  const auto& t = triangles_[index];
  return {limits_[t[0]], limits_[t[1]], limits_[t[2]]};
}

Piece SurfaceLattice::piece(std::size_t index) const {
  // Of a face, first the upright triangles, rows of equal j, then the others.
  const auto n = std::int64_t{1} << depth_;
  const auto within = static_cast<std::int64_t>(index) % (n * n);
  const std::int64_t upright = n * (n + 1) / 2;
  std::int64_t left = within < upright ? within : within - upright, i = 0, j = 0;
  for (std::int64_t row = within < upright ? n : n - 1; left >= row; --row, ++j) left -= row;
  i = left;
  Piece p;
  p.face = static_cast<std::int32_t>(static_cast<std::int64_t>(index) / (n * n));
  const auto at = [&](std::int64_t a, std::int64_t b) {
    const double s = std::ldexp(1.0, -depth_);
    return std::array<double, 3>{static_cast<double>(n - a - b) * s, static_cast<double>(a) * s,
                                 static_cast<double>(b) * s};
  };
  if (within < upright)
    p.at = {at(i, j), at(i + 1, j), at(i, j + 1)};
  else
    p.at = {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
  p.corner = corners(index);
  p.deviation = deviation_[index];
  p.irregular = irregular_[index];
  return p;
}

std::array<Piece, 4> SurfaceLattice::split(const Piece& piece,
                                           const reference::StamEvaluator<double>& surface) const {
  std::array<std::array<double, 3>, 3> at;  // middles of the edges 01, 12, 20
  std::array<Vector, 3> point;
  for (int k = 0; k < 3; ++k) {
    at[k] = middle(piece.at[k], piece.at[(k + 1) % 3]);
    point[k] =
        vector_of(surface.evaluate(piece.face, at[k][1], at[k][2], reference::Order::kPosition).position);
  }
  std::array<Piece, 4> child;
  for (int k = 0; k < 3; ++k) {
    child[k].at[k] = piece.at[k];
    child[k].corner[k] = piece.corner[k];
    for (const int other : {k, (k + 2) % 3}) {  // middles of the two edges at corner k
      const int place = other == k ? (k + 1) % 3 : (k + 2) % 3;
      child[k].at[place] = at[other];
      child[k].corner[place] = point[other];
    }
  }
  child[3].at = at;
  child[3].corner = point;
  for (Piece& c : child) {
    c.face = piece.face;
    c.deviation = piece.deviation / 4;  // regular: second derivatives per edge fall to a quarter
  }
  if (piece.irregular < 0) return child;
  // Which corner is extraordinary: the one whose coordinate in the face is 1.
  const CornerBounds& bounds = bounds_[piece.irregular];
  const int step = piece.steps + 1;
  const bool known = step < static_cast<int>(bounds.corner.size());
  for (int k = 0; k < 4; ++k) {
    bool at_vertex = false;
    if (k < 3)
      for (const double l : piece.at[k]) at_vertex = at_vertex || l == 1;
    if (at_vertex) {
      child[k].irregular = piece.irregular;
      child[k].steps = step;
      child[k].deviation = known ? bounds.corner[step] : piece.deviation;
    } else {
      child[k].deviation = known ? bounds.outer[step] : piece.deviation;
    }
  }
  return child;
}

}  // namespace limitcheck::verify
