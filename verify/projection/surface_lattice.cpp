// SPDX-License-Identifier: MIT
#include "verify/projection/surface_lattice.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reference/catmull_clark/refined_mesh.h"
#include "reference/loop/refine.h"
#include "reference/loop/triangles.h"
#include "verify/interrupt/interrupt.h"
#include "verify/projection/quad_bound.h"
#include "verify/projection/quad_cell.h"
#include "verify/projection/sharp_pieces.h"

namespace limitcheck::verify {

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
  if (chart_.is_square())
    subdivide_quads(mesh, tags);
  else
    subdivide_triangles(mesh, tags);
}

void SurfaceLattice::subdivide_triangles(const data::ControlMesh& mesh, const reference::SharpTags& tags) {
  reference::RefinedMesh<double> refined(reference::positions_of<double>(mesh),
                                         data::triangles_of(mesh).to_vector(), reference::Weights::kLoop,
                                         tags);
  const auto sharpness = refine_tagged(refined, tags, depth_);
  triangles_ = refined.triangles();
  for (const auto& p : refined.limits().positions) limits_.push_back(vector_of(p));

  const reference::Topology& topology = refined.topology();
  const auto sharp = sharp_pieces(topology, refined.positions(), sharpness);
  const auto vertices = mesh.positions.size();
  bounds_.resize(vertices);
  tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
    end_if_interrupted();
    const auto id = static_cast<std::int32_t>(v);
    if (sharp ? sharp->is_irregular(id, 6, 3)
              : topology.ring(id).size() != (topology.on_boundary(id) ? 4U : 6U))
      bounds_[v] = corner_bounds(topology, refined.positions(), id, sharp ? sharp->at(id) : SharpVertexOf{});
  });
  deviation_.resize(triangles_.size());
  irregular_.assign(triangles_.size(), -1);
  if (sharp) rough_.assign(triangles_.size(), 0);
  end_if_interrupted();
  tbb::parallel_for(std::size_t{0}, triangles_.size(), [&](std::size_t t) {
    for (const std::int32_t v : triangles_[t])
      if (static_cast<std::size_t>(v) < vertices && !bounds_[v].corner.empty()) irregular_[t] = v;
    if (irregular_[t] >= 0) {
      deviation_[t] = bounds_[irregular_[t]].corner[0];
    } else if (!sharp) {
      deviation_[t] = regular_bound(topology, refined.positions(), triangles_[t]).value();
    } else {
      const auto bound = sharp->bound(t, [&](const CutMesh& cut) {
        return regular_bound(cut.topology, cut.positions, reference::triangle_of(cut.topology, t),
                             cut.states);
      });
      deviation_[t] = bound.size;
      rough_[t] = bound.rough ? 1 : 0;
    }
  });
}

namespace {

// The quad of the cut mesh that is a given one of the mesh, corner by corner. The third corner has few faces.
struct CutQuad {
  std::int32_t face;
  Quad corners;
};
CutQuad cut_quad(const SharpPieces& sharp, const Quad& quad) {
  for (const std::int32_t f : sharp.topology.sector(quad[2]).faces) {
    const auto whole = sharp.topology.faces()[f], cut = sharp.cut.topology.faces()[f];
    const auto at = std::find(whole.begin(), whole.end(), quad[0]) - whole.begin();
    if (at == 4 || whole[(at + 2) % 4] != quad[2]) continue;
    CutQuad found{f, {}};
    for (std::size_t k = 0; k < 4; ++k) found.corners[k] = cut[(static_cast<std::size_t>(at) + k) % 4];
    return found;
  }
  throw std::logic_error("a quad of the lattice is no face of the refined mesh");
}

}  // namespace

void SurfaceLattice::subdivide_quads(const data::ControlMesh& mesh, const reference::SharpTags& tags) {
  reference::catmull_clark::RefinedMesh<double> refined(mesh.faces, reference::positions_of<double>(mesh),
                                                        tags);
  const auto sharpness = refine_tagged(refined, tags, depth_);
  for (const auto& p : refined.limits().positions) limits_.push_back(vector_of(p));

  const reference::Topology& topology = refined.topology();
  const auto sharp = sharp_pieces(topology, refined.positions(), sharpness);
  const auto vertices = mesh.positions.size();
  bounds_.resize(vertices);
  tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
    end_if_interrupted();
    const auto id = static_cast<std::int32_t>(v);
    const auto sector = topology.sector(id);
    if (sharp ? sharp->is_irregular(id, 4, 2)
              : !sector.faces.empty() && sector.faces.size() != (sector.closed ? 4U : 2U))
      bounds_[v] =
          quad_corner_bounds(topology, refined.positions(), id, sharp ? sharp->at(id) : SharpVertexOf{});
  });
  end_if_interrupted();
  const int n = 1 << depth_;
  const std::size_t cells = mesh.faces.size() << (2 * depth_);
  triangles_.resize(2 * cells);
  deviation_.resize(2 * cells);
  irregular_.assign(2 * cells, -1);
  if (sharp) rough_.assign(2 * cells, 0);
  tbb::parallel_for(std::size_t{0}, cells, [&](std::size_t c) {
    const auto within = static_cast<int>(c & ((std::size_t{1} << (2 * depth_)) - 1));
    const QuadCell at = cell(within % n, within / n, n);
    Quad quad{};
    for (std::size_t k = 0; k < 4; ++k)
      quad[k] = refined.vertex(c >> (2 * depth_), 0, at.corner[k][0], at.corner[k][1]);
    // Only where the diagonal begins can there be a vertex of the mesh.
    const std::int32_t v = quad[0];
    const CutQuad cut = sharp ? cut_quad(*sharp, quad) : CutQuad{-1, quad};
    const bool irregular = static_cast<std::size_t>(v) < vertices && !bounds_[v].corner.empty();
    SharpPieces::Bound bound{0, false};
    if (irregular)
      bound.size = bounds_[v].corner[0];
    else if (!sharp)
      bound.size = regular_bound(topology, refined.positions(), quad).value();
    else
      bound = sharp->bound(static_cast<std::size_t>(cut.face), [&](const CutMesh& whole) {
        return regular_bound(whole.topology, whole.positions, cut.corners, whole.states);
      });
    for (std::size_t half = 0; half < 2; ++half) {
      const std::size_t t = 2 * c + half;
      for (std::size_t k = 0; k < 3; ++k) triangles_[t][k] = quad[kHalves[half][k]];
      deviation_[t] = bound.size;
      if (irregular) irregular_[t] = v;
      if (bound.rough) rough_[t] = 1;
    }
  });
}

double SurfaceLattice::largest_deviation() const {
  return *std::max_element(deviation_.begin(), deviation_.end());
}

}  // namespace limitcheck::verify
