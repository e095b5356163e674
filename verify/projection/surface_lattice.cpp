// SPDX-License-Identifier: MIT
#include "verify/projection/surface_lattice.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reference/catmull_clark/recursion.h"
#include "reference/loop/refine.h"
#include "reference/mesh/cut_mesh.h"
#include "reference/mesh/topology.h"
#include "verify/interrupt/interrupt.h"
#include "verify/projection/refine_tagged.h"

namespace limitcheck::verify {
namespace {

Chart::Affine middle(const Chart::Affine& a, const Chart::Affine& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

// What the sharp edges and vertices of a refined mesh mean for its pieces.
struct SharpPieces {
  using Points = std::vector<reference::Vec3<double>>;
  const reference::Topology& topology;
  const Points& positions;
  const reference::Sharpness& sharpness;
  reference::CutMesh<double> cut;  // has the faces of the mesh, corner by corner
  const std::vector<bool>& rough = cut.needs_a_step;

  SharpPieces(const reference::Topology& whole, const Points& points, const reference::Sharpness& sharp)
      : topology(whole),
        positions(points),
        sharpness(sharp),
        cut(reference::TaggedMesh<double>{whole, points, sharp}) {}

  // Whether bounds are wanted for the vertex: in one of its sectors it is extraordinary, and no semi-sharp
  // tags are near.
  //   inside, boundary   the faces of an ordinary sector
  bool is_irregular(std::int32_t v, std::size_t inside, std::size_t boundary) const {
    const auto& sector = topology.sector(v).faces;
    for (const std::int32_t f : sector)
      for (const std::int32_t near : topology.faces()[f])
        if (near != v || sector.size() < 3)
          for (const std::int32_t other : topology.sector(near).faces)
            if (rough[other]) return false;
    if (cut.states[v] != reference::VertexState::kOrdinary) return true;
    return std::any_of(sector.begin(), sector.end(), [&](std::int32_t f) {
      const auto corners = topology.faces()[f];
      const auto at = static_cast<std::size_t>(std::ranges::find(corners, v) - corners.begin());
      const reference::Sector its = cut.topology.sector(cut.topology.faces()[f][at]);
      return its.faces.size() != (its.closed ? inside : boundary);
    });
  }
  SharpVertexOf at(std::int32_t v) const {
    return {&sharpness, cut.states[v] == reference::VertexState::kHeld};
  }

  // Of a face without an extraordinary vertex: as a polynomial, or, near semi-sharp tags, by its hull.
  struct Bound {
    double size;
    bool rough;
  };
  Bound bound(std::size_t face, std::size_t first) const {
    if (!rough[face])
      if (const auto size = regular_bound(cut.topology, cut.positions, face, first, cut.states))
        return {*size, false};
    return {hull(static_cast<std::int32_t>(face)), true};
  }
  // The size of what the surface over a face depends on, a bound for all pieces of it.
  double hull(std::int32_t face) const {
    const auto corners = topology.faces()[face];
    double radius = 0;
    for (const std::int32_t corner : corners)
      for (const std::int32_t f : topology.sector(corner).faces)
        for (const std::int32_t v : topology.faces()[f]) {
          const auto to = positions[v] - positions[corners[0]];
          radius = std::max(radius, std::sqrt(dot(to, to)));
        }
    return 2 * radius;
  }
};

using Quad = std::array<std::int32_t, 4>;

// A quad of a face's lattice, its corners from the one at which its diagonal begins: the one nearest to a corner of
// the face.
using QuadCell = std::array<std::array<int, 2>, 4>;

// Of the i-th column and the j-th row of n.
QuadCell cell(int i, int j, int n) {
  constexpr std::array<std::array<int, 2>, 4> kCorner{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const bool right = 2 * i >= n, up = 2 * j >= n;
  const int nearest = up ? (right ? 2 : 3) : (right ? 1 : 0);
  QuadCell c;
  for (int k = 0; k < 4; ++k) {
    const auto& [x, y] = kCorner[(nearest + k) % 4];
    c[k] = {i + x, j + y};
  }
  return c;
}

// A triangle of a face's lattice of n steps: first the upright ones, rows of equal j, then the others.
std::array<std::array<int, 2>, 3> triangle(int number, int n) {
  const int upright = n * (n + 1) / 2;
  int i = number < upright ? number : number - upright, j = 0;
  for (int row = number < upright ? n : n - 1; i >= row; --row, ++j) i -= row;
  if (number < upright) return {{{i, j}, {i + 1, j}, {i, j + 1}}};
  return {{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
}

// The corners of the two triangles of a quad.
constexpr std::array<std::array<int, 3>, 2> kHalves{{{0, 1, 2}, {0, 2, 3}}};

// The face of the refined mesh that is a given cell of the lattice, and the corner of it at which the cell begins. The
// third corner of a quad has few faces.
std::pair<std::size_t, std::size_t> face_of(const reference::Topology& topology, std::size_t,
                                            const Quad& quad) {
  for (const std::int32_t f : topology.sector(quad[2]).faces) {
    const auto face = topology.faces()[f];
    const auto at = static_cast<std::size_t>(std::ranges::find(face, quad[0]) - face.begin());
    if (at < 4 && face[(at + 2) % 4] == quad[2]) return {f, at};
  }
  throw std::logic_error("a quad of the lattice is no face of the refined mesh");
}
std::pair<std::size_t, std::size_t> face_of(const reference::Topology&, std::size_t cell,
                                            const reference::Triangle&) {
  return {cell, 0};
}

}  // namespace

int SurfaceLattice::depth_for(const data::ControlMesh& mesh, std::size_t pieces,
                              const reference::SharpTags& tags) {
  double sharpest = 0;
  const auto look = [&](const reference::Parameter& sharpness) {
    const double s = sharpness.as_double();
    if (s < data::kInfiniteSharpness) sharpest = std::max(sharpest, s);
  };
  for (const auto& edge : tags.edges) look(edge.sharpness);
  for (const auto& vertex : tags.vertices) look(vertex.sharpness);
  const std::size_t of_depth_0 = mesh.faces.are_triangles() ? mesh.faces.size() : 2 * mesh.faces.size();
  int depth = 2;
  while (depth < 7 && of_depth_0 << (2 * depth + 2) <= pieces) ++depth;
  while (depth < sharpest && of_depth_0 << (2 * depth) <= pieces) ++depth;
  return depth;
}

SurfaceLattice::SurfaceLattice(const data::ControlMesh& mesh, int depth, const reference::SharpTags& tags)
    : depth_(depth), chart_(mesh.faces.are_triangles() ? Chart::triangle() : Chart::square()) {
  const auto positions = reference::positions_of<double>(mesh);
  if (chart_.is_square()) {
    reference::catmull_clark::RefinedMesh<double> refined(mesh.faces, positions, tags);
    const int n = 1 << depth_;
    subdivide<Quad>(mesh, refined, tags, [&](std::size_t c) {
      const auto within = static_cast<int>(c & ((std::size_t{1} << (2 * depth_)) - 1));
      const QuadCell at = cell(within % n, within / n, n);
      Quad quad{};
      for (std::size_t k = 0; k < 4; ++k) quad[k] = refined.vertex(c >> (2 * depth_), 0, at[k][0], at[k][1]);
      return quad;
    });
  } else {
    reference::RefinedMesh<double> refined(positions, data::triangles_of(mesh).to_vector(),
                                           reference::Weights::kLoop, tags);
    subdivide<reference::Triangle>(mesh, refined, tags,
                                   [&](std::size_t c) { return refined.triangles()[c]; });
  }
}

// `cell`: the vertices of one of the cells of the lattice, 4^depth for each face; of a quad the first is the one at
// which its diagonal begins.
template <class Corners, class Refined, class Cell>
void SurfaceLattice::subdivide(const data::ControlMesh& mesh, Refined& refined,
                               const reference::SharpTags& tags, Cell cell) {
  constexpr bool kQuads = Corners().size() == 4;
  constexpr std::size_t kInside = kQuads ? 4 : 6, kBoundary = kQuads ? 2 : 3;  // faces of a regular vertex
  constexpr data::Scheme kScheme = kQuads ? data::Scheme::kCatmullClark : data::Scheme::kLoop;
  const auto sharpness = refine_tagged(refined, tags, depth_);
  for (const auto& p : refined.limits().positions) limits_.push_back(vector_of(p));

  const reference::Topology& topology = refined.topology();
  std::optional<SharpPieces> sharp;
  if (sharpness) sharp.emplace(topology, refined.positions(), *sharpness);
  const auto vertices = mesh.positions.size();
  bounds_.resize(vertices);
  tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
    end_if_interrupted();
    const auto id = static_cast<std::int32_t>(v);
    const auto sector = topology.sector(id);
    if (sharp ? sharp->is_irregular(id, kInside, kBoundary)
              : !sector.faces.empty() && sector.faces.size() != (sector.closed ? kInside : kBoundary))
      bounds_[v] =
          corner_bounds(kScheme, topology, refined.positions(), id, sharp ? sharp->at(id) : SharpVertexOf{});
  });
  end_if_interrupted();
  constexpr std::size_t kEach = kQuads ? 2 : 1;  // triangles of a cell
  const std::size_t cells = mesh.faces.size() << (2 * depth_);
  triangles_.resize(kEach * cells);
  deviation_.resize(kEach * cells);
  irregular_.assign(kEach * cells, -1);
  if (sharp) rough_.assign(kEach * cells, 0);
  tbb::parallel_for(std::size_t{0}, cells, [&](std::size_t c) {
    const Corners corners = cell(c);
    std::int32_t irregular = -1;
    for (const std::int32_t v : corners)
      if (static_cast<std::size_t>(v) < vertices && !bounds_[v].corner.empty()) irregular = v;
    SharpPieces::Bound bound{0, false};
    if (irregular >= 0) {
      bound.size = bounds_[irregular].corner[0];
    } else {
      const auto [face, first] = face_of(topology, c, corners);
      bound = sharp ? sharp->bound(face, first)
                    : SharpPieces::Bound{regular_bound(topology, refined.positions(), face, first).value(),
                                         false};
    }
    for (std::size_t half = 0; half < kEach; ++half) {
      const std::size_t t = kEach * c + half;
      for (std::size_t k = 0; k < 3; ++k) triangles_[t][k] = corners[kHalves[half][k]];
      deviation_[t] = bound.size;
      irregular_[t] = irregular;
      if (bound.rough) rough_[t] = 1;
    }
  });
}

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
  const int n = 1 << depth_;
  const double s = std::ldexp(1.0, -depth_);
  const std::size_t cell_number = chart_.is_square() ? index / 2 : index;
  const auto within_face = static_cast<int>(cell_number & ((std::size_t{1} << (2 * depth_)) - 1));
  Piece p;
  p.chart = chart_;
  p.face = static_cast<std::int32_t>(cell_number >> (2 * depth_));
  p.corner = corners(index);
  p.deviation = deviation_[index];
  p.irregular = irregular_[index];
  p.rough = !rough_.empty() && rough_[index] != 0;
  std::array<std::array<int, 2>, 3> at{};
  if (chart_.is_square()) {
    const QuadCell quad = cell(within_face % n, within_face / n, n);
    for (std::size_t k = 0; k < 3; ++k) at[k] = quad[kHalves[index % 2][k]];
  } else {
    at = triangle(within_face, n);
  }
  for (std::size_t k = 0; k < 3; ++k) p.at[k] = Chart::at(at[k][0] * s, at[k][1] * s);
  return p;
}

std::array<Piece, 4> SurfaceLattice::split(const Piece& piece, const LimitSurface& surface) const {
  Piece inner = piece;  // between the middles of the edges 01, 12, 20
  inner.irregular = -1, inner.steps = 0;
  // Regular: second derivatives per edge fall to a quarter.
  if (!piece.rough) inner.deviation /= 4;
  for (int k = 0; k < 3; ++k) {
    inner.at[k] = middle(piece.at[k], piece.at[(k + 1) % 3]);
    inner.corner[k] = surface.position({piece.face, inner.at[k]});
  }
  std::array<Piece, 4> child{inner, inner, inner, inner};
  for (int k = 0; k < 3; ++k) {  // at corner k, with the middles of its two edges
    const int next = (k + 1) % 3, before = (k + 2) % 3;
    child[k].at[k] = piece.at[k], child[k].corner[k] = piece.corner[k];
    child[k].at[next] = inner.at[k], child[k].corner[next] = inner.corner[k];
    child[k].at[before] = inner.at[before], child[k].corner[before] = inner.corner[before];
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
