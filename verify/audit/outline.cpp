// SPDX-License-Identifier: MIT
#include "verify/audit/outline.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace limitcheck::verify {

Outline::Outline(const Evidence& e) {
  const Lattice& lattice = e.lattice;
  for (const Lattice::Edge& edge : lattice.edges()) {
    int visible = 0, which = 0;
    for (int s = 0; s < 2; ++s)
      if (edge.face[s] >= 0 && e.face_depth[edge.face[s]] >= 0) ++visible, which = s;
    if (visible != 1) continue;
    const std::int32_t face = edge.face[which];
    const auto side = static_cast<std::int32_t>(sides_.size());
    const int k = edge.corner[which];
    sides_.push_back({face, k, e.face_depth[face], deepest_near(e, face)});
    for (int depth = sides_.back().least; depth <= sides_.back().most; ++depth) {
      const std::uint32_t n = std::uint32_t{1} << depth;
      const auto at = [&](std::uint32_t along) {  // steps from corner k to corner k + 1
        lc_provenance p{face, 0, 0, n};
        if (k == 0) p.i = along;
        if (k == 1) p.i = n - along, p.j = along;
        if (k == 2) p.j = n - along;
        return lattice.id(p);
      };
      for (std::uint32_t along = 0; along < n; ++along)
        steps_.push_back({at(along), at(along + 1), side, depth});
    }
  }
  std::sort(steps_.begin(), steps_.end(),
            [](const Step& a, const Step& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
  find_fans(e);
  count_loops(e);
}

// Corners of faces, joined across every edge whose two faces are visible.
void Outline::find_fans(const Evidence& e) {
  const std::size_t faces = e.mesh.triangles.size();
  std::vector<std::int32_t> parent(3 * faces);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  for (const Lattice::Edge& edge : e.lattice.edges()) {
    if (edge.face[1] < 0 || e.face_depth[edge.face[0]] < 0 || e.face_depth[edge.face[1]] < 0) continue;
    for (int end = 0; end < 2; ++end)  // the two faces run along it in opposite directions
      parent[root(3 * edge.face[0] + (edge.corner[0] + end) % 3)] =
          root(3 * edge.face[1] + (edge.corner[1] + 1 - end) % 3);
  }
  fan_.assign(parent.size(), 0);
  std::vector<int> fans(e.mesh.positions.size(), 0);  // met so far, of each vertex
  std::vector<int> number(parent.size(), -1);         // of each root
  for (std::int32_t c = 0; c < static_cast<std::int32_t>(parent.size()); ++c) {
    if (e.face_depth[c / 3] < 0) continue;
    int& its = number[root(c)];
    if (its < 0) its = fans[e.mesh.triangles[c / 3][c % 3]]++;
    fan_[c] = its;
  }
}

void Outline::count_loops(const Evidence& e) {
  const auto end = [&](const Side& s, int k) {
    return std::pair(e.mesh.triangles[s.face][k], fan(s.face, k));
  };
  std::map<std::pair<std::int32_t, int>, std::size_t> leaving;  // one side leaves the end of each fan
  for (std::size_t s = 0; s < sides_.size(); ++s) leaving[end(sides_[s], sides_[s].corner)] = s;
  std::vector<bool> walked(sides_.size(), false);
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    if (walked[s]) continue;
    ++loops_;
    for (std::size_t at = s; !walked[at]; at = leaving.at(end(sides_[at], (sides_[at].corner + 1) % 3)))
      walked[at] = true;
  }
}

}  // namespace limitcheck::verify
