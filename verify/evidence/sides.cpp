// SPDX-License-Identifier: MIT
#include "verify/evidence/sides.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace limitcheck::verify {
namespace {

// Sets of corners that grow together.
class Corners {
 public:
  explicit Corners(std::int32_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t find(std::int32_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void join(std::int32_t a, std::int32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::int32_t> parent_;
};

std::set<std::pair<std::int32_t, std::int32_t>> lasting_edges(const data::ControlMesh& mesh) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const data::SharpEdge& e : mesh.sharpness.edges)
    if (e.sharpness >= data::kInfiniteSharpness) edges.insert(std::minmax(e.a, e.b));
  return edges;
}

}  // namespace

Sides::Sides(const Lattice& lattice) : lattice_(lattice) {
  const auto lasting = lasting_edges(lattice.mesh());
  if (lasting.empty()) return;

  // Around a vertex, faces are of one sector that meet in an edge which does not stay sharp.
  Corners corners(lattice.corner_count());
  of_edge_.assign(lattice.edges().size(), -1);
  for (std::size_t k = 0; k < lattice.edges().size(); ++k) {
    const Lattice::Edge& e = lattice.edges()[k];
    if (e.on_boundary()) continue;
    if (!lasting.contains({e.a, e.b})) {
      for (const std::int32_t v : {e.a, e.b}) {
        const auto corner = [&](std::int32_t face) {
          return lattice.corner_number(face, *lattice.corner_of(face, v));
        };
        corners.join(corner(e.face[0]), corner(e.face[1]));
      }
    } else if (lattice.n() > 1) {
      of_edge_[k] = size();
      for (Lattice::Id i = 0; i < lattice.n() - 1; ++i)
        others_.push_back({lattice.first_on_edge(k) + i, e.face[1]});
    }
  }

  // The sectors of each vertex in the order of their lowest faces; the first has the id of the vertex.
  std::vector<std::int32_t> sectors(lattice.mesh().positions.size(), 0);
  std::vector<std::vector<std::int32_t>> first_face(sectors.size());  // of the sectors after the first
  std::vector<std::int32_t> number(lattice.corner_count(), -1);       // by the set of corners
  sector_.resize(lattice.corner_count());
  for (std::int32_t f = 0; f < lattice.face_count(); ++f)
    for (int k = 0; k < lattice.domain(f).corners(); ++k) {
      const std::int32_t v = lattice.vertex(f, k), corner = lattice.corner_number(f, k);
      std::int32_t& its = number[corners.find(corner)];
      if (its < 0) {
        its = sectors[v]++;
        if (its > 0) first_face[v].push_back(f);
      }
      sector_[corner] = its;
    }
  of_vertex_.assign(sectors.size(), -1);
  for (std::size_t v = 0; v < first_face.size(); ++v) {
    if (first_face[v].empty()) continue;
    of_vertex_[v] = size();
    for (const std::int32_t f : first_face[v]) others_.push_back({static_cast<Lattice::Id>(v), f});
  }
}

Sides::Id Sides::first_other(Lattice::Id point) const {
  if (none() || !lattice_.is_shared(point)) return -1;
  if (lattice_.is_vertex(point)) return of_vertex_[point];
  const std::size_t edge = lattice_.edge_of(point);
  return of_edge_[edge] < 0 ? -1 : of_edge_[edge] + point - lattice_.first_on_edge(edge);
}

Sides::Id Sides::of(Lattice::Id point, std::int32_t face) const {
  const Id first = first_other(point);
  if (first < 0) return point;
  if (!lattice_.is_vertex(point))
    return lattice_.edges()[lattice_.edge_of(point)].face[1] == face ? first : point;
  const auto k = lattice_.corner_of(face, point);
  const std::int32_t sector = k ? sector_[lattice_.corner_number(face, *k)] : 0;
  return sector == 0 ? point : first + sector - 1;
}

Place Sides::place(Id side) const {
  if (side < lattice_.size()) return lattice_.place(side);
  const Other& other = others_[side - lattice_.size()];
  return lattice_.place(other.face, *lattice_.in_face(other.point, other.face));
}

}  // namespace limitcheck::verify
