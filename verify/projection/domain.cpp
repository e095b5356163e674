// SPDX-License-Identifier: MIT
#include "verify/projection/domain.h"

#include <algorithm>

namespace limitcheck::verify {

std::array<double, 3> clamped(std::array<double, 3> l) {
  for (double& x : l) x = std::clamp(x, 0.0, 1.0);
  const double sum = l[0] + l[1] + l[2];
  if (sum != 1)
    for (double& x : l) x /= sum;
  return l;
}

Domain::Domain(std::span<const std::array<std::int32_t, 3>> triangles)
    : triangles_(triangles.begin(), triangles.end()), across_(triangles.size(), {-1, -1, -1}) {
  struct Side {
    std::int32_t from, to, face;
    int corner;
  };
  std::vector<Side> sides;
  std::int32_t vertices = 0;
  for (std::size_t f = 0; f < triangles_.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto& t = triangles_[f];
      sides.push_back({t[(k + 1) % 3], t[(k + 2) % 3], static_cast<std::int32_t>(f), k});
      vertices = std::max(vertices, t[k] + 1);
    }
  const auto before = [](const Side& a, const Side& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  };
  std::sort(sides.begin(), sides.end(), before);
  for (const Side& side : sides) {
    const Side wanted{side.to, side.from, 0, 0};
    const auto other = std::lower_bound(sides.begin(), sides.end(), wanted, before);
    if (other != sides.end() && other->from == side.to && other->to == side.from)
      across_[side.face][side.corner] = other->face;
  }

  star_start_.assign(static_cast<std::size_t>(vertices) + 1, 0);
  for (const auto& t : triangles_)
    for (const std::int32_t v : t) ++star_start_[v + 1];
  for (std::size_t v = 1; v < star_start_.size(); ++v) star_start_[v] += star_start_[v - 1];
  star_.resize(star_start_.back());
  std::vector<std::size_t> fill(star_start_.begin(), star_start_.end() - 1);
  for (std::size_t f = 0; f < triangles_.size(); ++f)
    for (const std::int32_t v : triangles_[f]) star_[fill[v]++] = static_cast<std::int32_t>(f);
}

bool Domain::express(const FacePoint& point, std::int32_t face, FacePoint& result) const {
  result = {face, {0, 0, 0}};
  for (int k = 0; k < 3; ++k) {
    if (point.l[k] == 0) continue;
    const auto& to = triangles_[face];
    const auto place = std::find(to.begin(), to.end(), triangles_[point.face][k]);
    if (place == to.end()) return false;
    result.l[place - to.begin()] = point.l[k];
  }
  return true;
}

FacePoint Domain::walk(FacePoint from, std::array<double, 3> step) const {
  // A straight line crosses few edges unless it circles a vertex; then anything on its way will do.
  for (int crossing = 0; crossing < 24; ++crossing) {
    double way = 1;
    int exit = -1;
    for (int k = 0; k < 3; ++k)
      if (step[k] < 0 && from.l[k] + step[k] < 0 && from.l[k] / -step[k] < way) {
        way = from.l[k] / -step[k];
        exit = k;
      }
    for (int k = 0; k < 3; ++k) from.l[k] += way * step[k];
    from.l = clamped(from.l);
    if (exit < 0) return from;
    from.l[exit] = 0;
    from.l = clamped(from.l);
    const std::int32_t next = across(from.face, exit);
    if (next < 0) return from;
    for (double& s : step) s *= 1 - way;

    // (a, b, c) with c left behind becomes (b, a, d), d = a + b - c.
    const auto& t = triangles_[from.face];
    const int a = (exit + 1) % 3, b = (exit + 2) % 3;
    FacePoint there{next, {}};
    std::array<double, 3> on{};
    for (int k = 0; k < 3; ++k) {
      const std::int32_t v = triangles_[next][k];
      there.l[k] = v == t[a] ? from.l[a] : v == t[b] ? from.l[b] : 0;
      on[k] = v == t[a] ? step[a] + step[exit] : v == t[b] ? step[b] + step[exit] : -step[exit];
    }
    from = there;
    step = on;
  }
  return from;
}

}  // namespace limitcheck::verify
