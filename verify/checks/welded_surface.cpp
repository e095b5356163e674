// SPDX-License-Identifier: MIT
#include "verify/checks/welded_surface.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "verify/evidence/vector.h"
#include "verify/watertight/watertight.h"

namespace limitcheck::verify {

Welded weld(const Evidence& e) {
  const Tessellation& t = e.tessellation;
  const MergedPoints places =
      t.precision() == LC_FLOAT32 ? merge_identical(t.positions_f32()) : merge_identical(t.positions_f64());
  Welded welded;
  welded.point_of.assign(e.point.size(), -1);
  // The points at each lattice point and at each place, of which there is nearly always one.
  std::vector<std::int32_t> of_lattice_point(e.lattice.size(), -1), next, place;
  std::vector<std::int32_t> of_place(places.vertex_of.size(), -1);
  const auto add = [&](std::size_t v) {
    const auto point = static_cast<std::int32_t>(welded.vertex_of.size());
    welded.vertex_of.push_back(static_cast<std::int32_t>(v));
    place.push_back(places.point_of[v]);
    next.push_back(-1);
    if (place.back() >= 0 && of_place[place.back()] < 0) of_place[place.back()] = point;
    if (e.point[v] != Lattice::kNone) next.back() = std::exchange(of_lattice_point[e.point[v]], point);
    return point;
  };
  for (std::size_t v = 0; v < e.point.size(); ++v) {
    if (e.point[v] == Lattice::kNone || places.point_of[v] < 0) continue;
    std::int32_t point = of_lattice_point[e.point[v]];
    while (point >= 0 && place[point] != places.point_of[v]) point = next[point];
    welded.point_of[v] = point >= 0 ? point : add(v);
  }
  for (std::size_t v = 0; v < e.point.size(); ++v) {
    if (welded.point_of[v] >= 0) continue;
    const bool named = e.point[v] != Lattice::kNone;
    if (!named && places.point_of[v] < 0) continue;
    const std::int32_t point = named ? of_lattice_point[e.point[v]] : of_place[places.point_of[v]];
    welded.point_of[v] = point >= 0 ? point : add(v);
  }
  return welded;
}

namespace {

// The points on each edge, its ends apart, that are corners of triangles.
std::vector<std::vector<Lattice::Id>> used_on_edges(const Evidence& e) {
  std::vector<std::vector<Lattice::Id>> used(e.lattice.edges().size());
  for (std::int64_t k = 0; k < e.tessellation.triangle_count(); ++k)
    for (std::size_t c = 0; c < 3 && e.tessellation.triangle_ok(k); ++c)
      if (const Lattice::Id id = e.point[e.tessellation.triangles()[k][c]];
          id != Lattice::kNone && e.lattice.is_shared(id) && !e.lattice.is_vertex(id))
        used[e.lattice.edge_of(id)].push_back(id);
  return used;
}

}  // namespace

Outline::Outline(const Evidence& e) : lattice_(e.lattice) {
  const std::vector<std::int32_t> deepest = deepest_near(e);
  const auto used =
      e.capabilities.points_anywhere != 0 ? used_on_edges(e) : std::vector<std::vector<Lattice::Id>>();
  for (const Lattice::Edge& edge : lattice_.edges()) {
    int visible = 0, which = 0;
    for (int s = 0; s < 2; ++s)
      if (edge.face[s] >= 0 && e.face_depth[edge.face[s]] >= 0) ++visible, which = s;
    if (visible != 1) continue;
    const std::int32_t face = edge.face[which];
    const auto side = static_cast<std::int32_t>(sides_.size());
    const int k = edge.corner[which];
    if (e.capabilities.points_anywhere != 0) {
      sides_.push_back({face, k, 0, 0});
      const FaceDomain domain = lattice_.domain(face);
      std::vector<std::pair<std::int64_t, Lattice::Id>> along;
      for (const Lattice::Id id : used[static_cast<std::size_t>(&edge - lattice_.edges().data())])
        along.emplace_back(domain.along(*lattice_.in_face(id, face), k, lattice_.scale()), id);
      std::sort(along.begin(), along.end());
      along.erase(std::unique(along.begin(), along.end()), along.end());
      along.emplace_back(lattice_.scale(), lattice_.vertex(face, domain.next(k)));
      Lattice::Id from = lattice_.vertex(face, k);
      for (const auto& [at, to] : along) {
        steps_.push_back({from, to, side, 0});
        from = to;
      }
      continue;
    }
    sides_.push_back({face, k, e.face_depth[face], deepest[face]});
    for (int depth = sides_.back().least; depth <= sides_.back().most; ++depth) {
      const std::int64_t n = std::int64_t{1} << depth;
      const auto at = [&](std::int64_t along) {
        return lattice_.id(face, lattice_.domain(face).on_side(k, along, n), n);
      };
      for (std::int64_t along = 0; along < n; ++along)
        steps_.push_back({at(along), at(along + 1), side, depth});
    }
  }
  std::sort(steps_.begin(), steps_.end(),
            [](const Step& a, const Step& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
  const auto visible = [&](std::int32_t face) { return e.face_depth[face] >= 0; };
  fan_ = fans_of_corners(
      lattice_, [&](const Lattice::Edge& edge) { return visible(edge.face[0]) && visible(edge.face[1]); },
      visible);
  count_loops();
}

void Outline::count_loops() {
  const auto end = [&](const Side& s, int k) {
    return std::pair(lattice_.vertex(s.face, k), fan(s.face, k));
  };
  const auto last = [&](const Side& s) { return lattice_.domain(s.face).next(s.corner); };
  std::map<std::pair<std::int32_t, int>, std::size_t> leaving;  // one side leaves the end of each fan
  for (std::size_t s = 0; s < sides_.size(); ++s) leaving[end(sides_[s], sides_[s].corner)] = s;
  std::vector<bool> walked(sides_.size(), false);
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    if (walked[s]) continue;
    ++loops_;
    for (std::size_t at = s; !walked[at]; at = leaving.at(end(sides_[at], last(sides_[at]))))
      walked[at] = true;
  }
}

namespace {

// A side of a triangle, in the direction in which the triangle runs along it.
struct Side {
  std::int32_t face, from, to;  // points
  friend auto operator<=>(const Side&, const Side&) = default;
};

// Whether side k of a triangle joins two corners of its face that are not next to each other.
bool is_diagonal(const Evidence& e, std::int64_t triangle, std::size_t k) {
  const std::int32_t face = e.tessellation.triangle_face()[triangle];
  const auto& vertices = e.tessellation.triangles()[triangle];
  const Lattice::Id p = e.point[vertices[k]], q = e.point[vertices[(k + 1) % 3]];
  if (p == Lattice::kNone || q == Lattice::kNone || !e.lattice.is_vertex(p) || !e.lattice.is_vertex(q))
    return false;
  const auto a = e.lattice.corner_of(face, p), b = e.lattice.corner_of(face, q);
  const FaceDomain domain = e.lattice.domain(face);
  return a && b && *a != *b && domain.next(*a) != *b && domain.previous(*a) != *b;
}

}  // namespace

OriginOfTriangles tell_diagonals_apart(const Evidence& e, std::vector<std::array<std::int32_t, 3>> triangles,
                                       std::int64_t points) {
  OriginOfTriangles out{std::move(triangles), {}, points};
  out.origin.resize(out.triangles.size());
  std::iota(out.origin.begin(), out.origin.end(), 0);
  if (e.mesh.faces.are_triangles()) return out;

  std::map<Side, std::int32_t> triangle_of;  // of each diagonal, in each direction
  std::set<Side> twice;
  for (std::int32_t t = 0; t < std::ssize(out.triangles); ++t)
    for (std::size_t k = 0; k < 3 && e.tessellation.triangle_ok(t); ++k) {
      if (!is_diagonal(e, t, k)) continue;
      const Side side{e.tessellation.triangle_face()[t], out.triangles[t][k], out.triangles[t][(k + 1) % 3]};
      if (side.from >= 0 && side.to >= 0 && !triangle_of.try_emplace(side, t).second) twice.insert(side);
    }
  if (triangle_of.empty()) return out;
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;  // of the pairs of points that diagonals join
  for (const auto& [side, t] : triangle_of) uses.try_emplace(std::minmax(side.from, side.to), 0);
  for (const auto& t : out.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto pair = uses.find(std::minmax(t[k], t[(k + 1) % 3])); pair != uses.end()) ++pair->second;

  // Cuts the triangle along this side from the side's middle to the corner opposite.
  const auto cut = [&](const Side& side, std::int32_t middle) {
    const std::int32_t t = triangle_of.at(side), other = static_cast<std::int32_t>(out.triangles.size());
    auto& first = out.triangles[t];
    std::size_t k = 0;
    while (first[k] != side.from || first[(k + 1) % 3] != side.to) ++k;
    const std::int32_t opposite = first[(k + 2) % 3];
    first[(k + 1) % 3] = middle;
    out.triangles.push_back({middle, side.to, opposite});
    out.origin.push_back(out.origin[t]);
    if (const auto next = triangle_of.find({side.face, side.to, opposite}); next != triangle_of.end())
      next->second = other;
  };
  const auto sides = triangle_of;
  for (const auto& [side, t] : sides) {
    const Side back{side.face, side.to, side.from};
    if (side.from > side.to || uses.at(std::minmax(side.from, side.to)) <= 2 || !sides.contains(back) ||
        twice.contains(side) || twice.contains(back))
      continue;
    const auto middle = static_cast<std::int32_t>(out.points++);
    cut(side, middle);
    cut(back, middle);
  }
  return out;
}

}  // namespace limitcheck::verify
