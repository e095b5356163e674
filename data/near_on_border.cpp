// SPDX-License-Identifier: MIT
#include "data/near_on_border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "data/building_blocks.h"

namespace limitcheck::data {

std::vector<std::int32_t> joined_on_border(const ControlMesh& mesh, double distance) {
  std::vector<std::int32_t> first(mesh.positions.size());
  std::iota(first.begin(), first.end(), 0);
  std::vector<std::int32_t> border;
  const std::vector<VertexPair> sides = sides_of(mesh.faces);
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end] == sides[begin]) ++end;
    if (end - begin == 1) border.insert(border.end(), {sides[begin].first, sides[begin].second});
  }
  std::sort(border.begin(), border.end());
  border.erase(std::unique(border.begin(), border.end()), border.end());

  // A quarter of each coordinate: the diagonal of the largest box is a number, too.
  using Point = std::array<double, 3>;
  Point low{}, size{};
  for (std::size_t c = 0; c < 3 && !first.empty(); ++c) {
    const auto [least, most] =
        std::minmax_element(mesh.positions.begin(), mesh.positions.end(),
                            [c](const Point& p, const Point& q) { return p[c] < q[c]; });
    low[c] = (*least)[c] / 4;
    size[c] = (*most)[c] / 4 - low[c];
  }
  const double diagonal = std::hypot(size[0], size[1], size[2]), reach = distance * diagonal;
  // Cells of twice the reach, so that rounding leaves no neighbour two cells away; and not so small that their
  // numbers lose their last place.
  const double cell = 2 * std::max(reach, 1e-10 * diagonal);
  if (!(cell > 0)) return first;

  const auto root = [&first](std::int32_t v) {
    while (first[v] != v) v = first[v] = first[first[v]];
    return v;
  };
  std::map<Point, std::vector<std::int32_t>> cells;
  for (const std::int32_t v : border) {
    Point at{}, p{};
    for (std::size_t c = 0; c < 3; ++c) {
      p[c] = mesh.positions[v][c] / 4;
      at[c] = std::floor((p[c] - low[c]) / cell);
    }
    for (int k = 0; k < 27; ++k) {
      const auto beside = cells.find({at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1});
      if (beside == cells.end()) continue;
      for (const std::int32_t w : beside->second) {
        const Point& q = mesh.positions[w];
        if (std::hypot(p[0] - q[0] / 4, p[1] - q[1] / 4, p[2] - q[2] / 4) > reach) continue;
        const auto [a, b] = std::minmax({root(v), root(w)});
        first[b] = a;
      }
    }
    cells[at].push_back(v);
  }
  for (std::int32_t& v : first) v = root(v);
  return first;
}

}  // namespace limitcheck::data
