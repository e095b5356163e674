// SPDX-License-Identifier: MIT
#include <algorithm>
#include <initializer_list>
#include <utility>

#include "verify/host/matching.h"
#include "verify/subject/lattice.h"

namespace limitcheck::verify {
namespace {

using Vector = std::array<double, 3>;

std::uint64_t edge_key(std::int32_t a, std::int32_t b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
}

Vector mix(const Vector& a, const Vector& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

}  // namespace

bool Cells::connect(std::int64_t vertices) {
  cell_of.resize(corners.size());
  across.assign(corners.size(), -1);
  valence.assign(vertices, 0);
  on_boundary.assign(vertices, 0);
  for (std::int64_t c = 0; c < count(); ++c)
    std::fill(cell_of.begin() + first[c], cell_of.begin() + first[c + 1], static_cast<std::int32_t>(c));
  // Sorted by their edges: of each edge the sides follow one another.
  std::vector<std::pair<std::uint64_t, std::int64_t>> by_edge;
  by_edge.reserve(corners.size());
  for (std::int64_t s = 0; s < std::ssize(corners); ++s) {
    if (from(s) == to(s)) return false;
    ++valence[from(s)];
    by_edge.emplace_back(edge_key(from(s), to(s)), s);
  }
  std::sort(by_edge.begin(), by_edge.end());
  for (std::size_t k = 0; k < by_edge.size(); ++k) {
    const auto [edge, side] = by_edge[k];
    if (k + 1 == by_edge.size() || by_edge[k + 1].first != edge) {
      on_boundary[from(side)] = on_boundary[to(side)] = 1;
      continue;
    }
    const std::int64_t other = by_edge[++k].second;
    const bool third = k + 1 < by_edge.size() && by_edge[k + 1].first == edge;
    if (third || from(other) == from(side)) return false;
    across[side] = other;
    across[other] = side;
  }
  return true;
}

Cells Cells::reversed() const {
  Cells other;
  other.first = first;
  other.corners = corners;
  for (std::int64_t c = 0; c < count(); ++c)
    std::reverse(other.corners.begin() + first[c], other.corners.begin() + first[c + 1]);
  other.connect(std::ssize(valence));
  return other;
}

RefinedComplex::RefinedComplex(const data::ControlMesh& mesh, data::Scheme scheme, int steps_down)
    : depth(steps_down), mesh_(mesh), scheme_(scheme) {
  const Lattice lattice(mesh, scheme, depth);
  const std::int64_t n = lattice.n();
  side_at.assign(static_cast<std::size_t>(lattice.size()), -1);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    const auto size = static_cast<int>(face.size());
    const FaceDomain domain(scheme, size);
    const bool whole = depth == 0 && domain.parts() > 1;  // a cell that has the corners of the face
    const std::int64_t steps = whole ? 2 : n, most = domain.denominator(steps);
    Vector middle{};
    for (const std::int32_t v : face)
      for (int axis = 0; axis < 3; ++axis) middle[axis] += mesh.positions[v][axis] / size;
    const auto corner_position = [&](int k) { return mesh.positions[face[k]]; };
    const auto about_of = [&](const FaceDomain::Point& p) {
      const double u = static_cast<double>(p.i) / static_cast<double>(most),
                   v = static_cast<double>(p.j) / static_cast<double>(most);
      if (scheme == data::Scheme::kLoop) {
        Vector sum{};
        for (int axis = 0; axis < 3; ++axis)
          sum[axis] = (1 - u - v) * corner_position(0)[axis] + u * corner_position(1)[axis] +
                      v * corner_position(2)[axis];
        return sum;
      }
      const Vector own = corner_position(p.part), after = corner_position(domain.next(p.part));
      if (domain.parts() == 1)
        return mix(mix(own, after, u), mix(corner_position(3), corner_position(2), u), v);
      const Vector before = corner_position(domain.previous(p.part));
      return mix(mix(own, mix(own, after, .5), u), mix(mix(own, before, .5), middle, u), v);
    };
    const auto add = [&](FaceDomain::Point p) {  // the next corner of a cell
      p = domain.canonical(p, steps);
      const Lattice::Id id = lattice.id(static_cast<std::int32_t>(f), p, steps);
      if (side_at[id] < 0) {
        side_at[id] = std::ssize(place);
        about.push_back(about_of(p));
        ++vertices;
      }
      place.push_back({static_cast<std::int32_t>(f), static_cast<std::uint32_t>(p.i),
                       static_cast<std::uint32_t>(p.j), static_cast<std::uint32_t>(most)});
      corner.push_back(p.part);
      cells.corners.push_back(static_cast<std::int32_t>(id));
    };
    const auto cell = [&](std::initializer_list<FaceDomain::Point> points) {
      for (const FaceDomain::Point& p : points) add(p);
      cells.first.push_back(std::ssize(cells.corners));
    };
    if (whole) {
      for (int k = 0; k < size; ++k) add(domain.corner_point(k, steps));
      cells.first.push_back(std::ssize(cells.corners));
    } else if (scheme == data::Scheme::kLoop) {
      for (std::int64_t j = 0; j < n; ++j)
        for (std::int64_t i = 0; i + j < n; ++i) {
          cell({{i, j}, {i + 1, j}, {i, j + 1}});
          if (i + j + 1 < n) cell({{i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
        }
    } else {
      for (std::int32_t part = 0; part < domain.parts(); ++part)
        for (std::int64_t j = 0; j < most; ++j)
          for (std::int64_t i = 0; i < most; ++i)
            cell({{i, j, part}, {i + 1, j, part}, {i + 1, j + 1, part}, {i, j + 1, part}});
    }
    face_of_cell.resize(static_cast<std::size_t>(cells.count()), static_cast<std::int32_t>(f));
  }
  cells.connect(std::ssize(side_at));
}

Vector RefinedComplex::on_surface(std::int32_t vertex) const {
  const auto [known, is_new] = known_.try_emplace(vertex);
  if (is_new) {
    if (!surface_) surface_.emplace(mesh_, scheme_);
    const std::int64_t side = side_at[vertex];
    const lc_provenance& p = place[side];
    const auto n = static_cast<double>(p.denominator);
    const auto at =
        surface_->evaluate(p.face, corner[side], p.i / n, p.j / n, reference::Derivatives::kPosition);
    known->second = {at.position.x, at.position.y, at.position.z};
  }
  return known->second;
}

}  // namespace limitcheck::verify
