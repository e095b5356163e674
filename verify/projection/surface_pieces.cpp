// SPDX-License-Identifier: MIT
// The pieces of a surface lattice: where they are, and what they are split into.
#include <algorithm>
#include <cmath>

#include "verify/projection/quad_cell.h"
#include "verify/projection/surface_lattice.h"

namespace limitcheck::verify {
namespace {

Chart::Affine middle(const Chart::Affine& a, const Chart::Affine& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

}  // namespace

FacePoint Piece::parameter(const std::array<double, 3>& weight) const {
  FacePoint p{face, {}};
  for (int k = 0; k < 3; ++k) p.l[k] = weight[0] * at[0][k] + weight[1] * at[1][k] + weight[2] * at[2][k];
  p.l = chart.clamp(p.l);
  return p;
}

std::array<Vector, 3> SurfaceLattice::corners(std::size_t index) const {
  const auto& t = triangles_[index];
  return {limits_[t[0]], limits_[t[1]], limits_[t[2]]};
}

Piece SurfaceLattice::piece(std::size_t index) const {
  const auto n = std::int64_t{1} << depth_;
  const double s = std::ldexp(1.0, -depth_);
  Piece p;
  p.chart = chart_;
  p.corner = corners(index);
  p.deviation = deviation_[index];
  p.irregular = irregular_[index];
  p.rough = !rough_.empty() && rough_[index] != 0;
  if (chart_.is_square()) {
    const auto quad = static_cast<std::int64_t>(index / 2), within_face = quad % (n * n);
    p.face = static_cast<std::int32_t>(quad / (n * n));
    const QuadCell its =
        cell(static_cast<int>(within_face % n), static_cast<int>(within_face / n), static_cast<int>(n));
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [i, j] = its.corner[kHalves[index % 2][k]];
      p.at[k] = Chart::at(i * s, j * s);
    }
    return p;
  }
  // Of a triangle, first the upright triangles, rows of equal j, then the others.
  const auto within = static_cast<std::int64_t>(index) % (n * n);
  const std::int64_t upright = n * (n + 1) / 2;
  std::int64_t left = within < upright ? within : within - upright, i = 0, j = 0;
  for (std::int64_t row = within < upright ? n : n - 1; left >= row; --row, ++j) left -= row;
  i = left;
  p.face = static_cast<std::int32_t>(static_cast<std::int64_t>(index) / (n * n));
  const auto at = [&](std::int64_t a, std::int64_t b) {
    return Chart::Affine{static_cast<double>(n - a - b) * s, static_cast<double>(a) * s,
                         static_cast<double>(b) * s};
  };
  if (within < upright)
    p.at = {at(i, j), at(i + 1, j), at(i, j + 1)};
  else
    p.at = {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
  return p;
}

std::array<Piece, 4> SurfaceLattice::split(const Piece& piece, const LimitSurface& surface) const {
  std::array<Chart::Affine, 3> at;  // middles of the edges 01, 12, 20
  std::array<Vector, 3> point;
  for (int k = 0; k < 3; ++k) {
    at[k] = middle(piece.at[k], piece.at[(k + 1) % 3]);
    point[k] = surface.position({piece.face, at[k]});
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
    c.chart = piece.chart;
    c.face = piece.face;
    c.rough = piece.rough;
    // Regular: second derivatives per edge fall to a quarter.
    c.deviation = piece.rough ? piece.deviation : piece.deviation / 4;
  }
  if (piece.irregular < 0) return child;
  // Which corner is extraordinary: the one that is a corner of the face.
  const CornerBounds& bounds = bounds_[piece.irregular];
  const int step = piece.steps + 1;
  const bool known = step < static_cast<int>(bounds.corner.size());
  for (int k = 0; k < 4; ++k) {
    if (k < 3 && chart_.corner_at(piece.at[k]) >= 0) {
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
