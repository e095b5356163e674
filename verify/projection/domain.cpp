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

std::int32_t Domain::across(std::int32_t face, int k) const {
  return lattice_.across(face, lattice_.domain(face).next(k));
}

bool Domain::express(const FacePoint& point, std::int32_t face, FacePoint& result) const {
  result = {face, {0, 0, 0}};
  for (int k = 0; k < 3; ++k) {
    if (point.l[k] == 0) continue;
    const auto& to = triangles()[face];
    const auto place = std::find(to.begin(), to.end(), triangles()[point.face][k]);
    if (place == to.end()) return false;
    result.l[place - to.begin()] = point.l[k];
  }
  return true;
}

FacePoint Domain::walk(FacePoint from, std::array<double, 3> step) const {
  // A straight line crosses few edges unless it circles a vertex; then any point on its way is good enough.
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
    const auto& t = triangles()[from.face];
    const int a = (exit + 1) % 3, b = (exit + 2) % 3;
    FacePoint there{next, {}};
    std::array<double, 3> on{};
    for (int k = 0; k < 3; ++k) {
      const std::int32_t v = triangles()[next][k];
      there.l[k] = v == t[a] ? from.l[a] : v == t[b] ? from.l[b] : 0;
      on[k] = v == t[a] ? step[a] + step[exit] : v == t[b] ? step[b] + step[exit] : -step[exit];
    }
    from = there;
    step = on;
  }
  return from;
}

}  // namespace limitcheck::verify
