// SPDX-License-Identifier: MIT
#include "verify/evidence/outline.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace limitcheck::verify {

Outline::Outline(const Evidence& e) : lattice_(e.lattice) {
  const std::vector<std::int32_t> deepest = deepest_near(e);
  for (const Lattice::Edge& edge : lattice_.edges()) {
    int visible = 0, which = 0;
    for (int s = 0; s < 2; ++s)
      if (edge.face[s] >= 0 && e.face_depth[edge.face[s]] >= 0) ++visible, which = s;
    if (visible != 1) continue;
    const std::int32_t face = edge.face[which];
    const auto side = static_cast<std::int32_t>(sides_.size());
    const int k = edge.corner[which];
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
  find_fans(e);
  count_loops();
}

// Corners of faces, joined across every edge whose two faces are visible.
void Outline::find_fans(const Evidence& e) {
  std::vector<std::int32_t> parent(lattice_.corner_count());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  for (const Lattice::Edge& edge : lattice_.edges()) {
    const std::int32_t f = edge.face[0], g = edge.face[1];
    if (edge.on_boundary() || e.face_depth[f] < 0 || e.face_depth[g] < 0) continue;
    const auto join = [&](int k, int m) {
      parent[root(lattice_.corner_number(f, k))] = root(lattice_.corner_number(g, m));
    };
    const int k = edge.corner[0], m = edge.corner[1];  // the two faces run along it in opposite directions
    join(k, lattice_.domain(g).next(m));
    join(lattice_.domain(f).next(k), m);
  }
  fan_.assign(parent.size(), 0);
  std::vector<int> fans(e.mesh.positions.size(), 0);  // met so far, of each vertex
  std::vector<int> number(parent.size(), -1);         // of each root
  for (std::int32_t f = 0; f < lattice_.face_count(); ++f)
    for (int k = 0; k < lattice_.domain(f).corners() && e.face_depth[f] >= 0; ++k) {
      const std::int32_t c = lattice_.corner_number(f, k);
      int& its = number[root(c)];
      if (its < 0) its = fans[lattice_.vertex(f, k)]++;
      fan_[c] = its;
    }
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

}  // namespace limitcheck::verify
