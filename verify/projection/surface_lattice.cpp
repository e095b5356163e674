// SPDX-License-Identifier: MIT
#include "verify/projection/surface_lattice.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "reference/catmull_clark/refined_mesh.h"
#include "reference/loop/refine.h"
#include "verify/projection/quad_bound.h"

namespace limitcheck::verify {
namespace {

Chart::Affine middle(const Chart::Affine& a, const Chart::Affine& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

// A quad of a face's lattice, its corners from the one at which its diagonal begins.
struct Cell {
  std::array<std::array<int, 2>, 4> corner;
};
Cell cell(int i, int j, int n) {
  constexpr std::array<std::array<int, 2>, 4> kCorner{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const bool right = 2 * i >= n, up = 2 * j >= n;
  const int nearest = up ? (right ? 2 : 3) : (right ? 1 : 0);
  Cell c;
  for (int k = 0; k < 4; ++k) {
    const auto& [x, y] = kCorner[(nearest + k) % 4];
    c.corner[k] = {i + x, j + y};
  }
  return c;
}

constexpr std::array<std::array<int, 3>, 2> kHalves{{{0, 1, 2}, {0, 2, 3}}};

}  // namespace

FacePoint Piece::parameter(const std::array<double, 3>& weight) const {
  FacePoint p{face, {}};
  for (int k = 0; k < 3; ++k) p.l[k] = weight[0] * at[0][k] + weight[1] * at[1][k] + weight[2] * at[2][k];
  p.l = chart.clamp(p.l);
  return p;
}

int SurfaceLattice::depth_for(const data::ControlMesh& mesh, std::size_t pieces) {
  const std::size_t of_depth_0 = mesh.faces.are_triangles() ? mesh.faces.size() : 2 * mesh.faces.size();
  int depth = 2;
  while (depth < 7 && of_depth_0 << (2 * depth + 2) <= pieces) ++depth;
  return depth;
}

SurfaceLattice::SurfaceLattice(const data::ControlMesh& mesh, int depth)
    : depth_(depth), chart_(mesh.faces.are_triangles() ? Chart::triangle() : Chart::square()) {
  if (chart_.is_square())
    subdivide_quads(mesh);
  else
    subdivide_triangles(mesh);
}

void SurfaceLattice::subdivide_triangles(const data::ControlMesh& mesh) {
  const auto refined = reference::refine<double>(mesh, depth_);
  triangles_ = refined.triangles();
  for (const auto& p : refined.limits().positions) limits_.push_back(vector_of(p));

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

void SurfaceLattice::subdivide_quads(const data::ControlMesh& mesh) {
  reference::catmull_clark::RefinedMesh<double> refined(mesh.faces, reference::positions_of<double>(mesh));
  for (int step = 0; step < depth_; ++step) refined.refine();
  for (const auto& p : refined.limits().positions) limits_.push_back(vector_of(p));

  const auto& topology = refined.topology();
  const auto vertices = mesh.positions.size();
  bounds_.resize(vertices);
  tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
    const auto sector = topology.sector(static_cast<std::int32_t>(v));
    if (!sector.faces.empty() && sector.faces.size() != (sector.closed ? 4U : 2U))
      bounds_[v] = quad_corner_bounds(topology, refined.positions(), static_cast<std::int32_t>(v));
  });
  const int n = 1 << depth_;
  const std::size_t cells = mesh.faces.size() << (2 * depth_);
  triangles_.resize(2 * cells);
  deviation_.resize(2 * cells);
  irregular_.assign(2 * cells, -1);
  tbb::parallel_for(std::size_t{0}, cells, [&](std::size_t c) {
    const auto within = static_cast<int>(c & ((std::size_t{1} << (2 * depth_)) - 1));
    const Cell at = cell(within % n, within / n, n);
    Quad quad{};
    for (std::size_t k = 0; k < 4; ++k)
      quad[k] = refined.vertex(c >> (2 * depth_), 0, at.corner[k][0], at.corner[k][1]);
    // Only where the diagonal begins can there be a vertex of the mesh.
    const std::int32_t v = quad[0];
    const bool irregular = static_cast<std::size_t>(v) < vertices && !bounds_[v].corner.empty();
    const double bound =
        irregular ? bounds_[v].corner[0] : regular_bound(topology, refined.positions(), quad).value();
    for (std::size_t half = 0; half < 2; ++half) {
      const std::size_t t = 2 * c + half;
      for (std::size_t k = 0; k < 3; ++k) triangles_[t][k] = quad[kHalves[half][k]];
      deviation_[t] = bound;
      if (irregular) irregular_[t] = v;
    }
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
  const auto n = std::int64_t{1} << depth_;
  const double s = std::ldexp(1.0, -depth_);
  Piece p;
  p.chart = chart_;
  p.corner = corners(index);
  p.deviation = deviation_[index];
  p.irregular = irregular_[index];
  if (chart_.is_square()) {
    const auto quad = static_cast<std::int64_t>(index / 2), within_face = quad % (n * n);
    p.face = static_cast<std::int32_t>(quad / (n * n));
    const Cell its =
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
    c.deviation = piece.deviation / 4;  // regular: second derivatives per edge fall to a quarter
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
