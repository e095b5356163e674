// SPDX-License-Identifier: MIT
#include "fast/stream/gather/rings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fast/mesh/vec3.h"
#include "fast/stream/gather/rings_impl.h"

namespace limitcheck::fast::row_stream {

namespace {

// Seen from an origin common to the mesh, normals at depth d lose 2^d s / h roundings or more, where s is the
// size of the mesh and h the height of a triangle. So many are let pass before depth 4: not a power of two,
// for meshes in which s / h is one, where rounding would decide differently for each way to write them.
constexpr double kMostRoundings = 1023;
// Meshes of so many vertices have low triangles anyway, and origins of their own cost 40 to 60 % of the time at
// the least depths. So they have them only if there are needles: triangles lower than this beside the mesh.
constexpr std::size_t kManyVertices = 8192;
constexpr double kNeedle = 0x1p-11;

// The square of the height of the triangle between e and f over the longest of these and `third`, if that is
// less than `least`. 0 is none: a flat triangle has no normal to lose.
double lesser_squared_height(const Vec3<double>& e, const Vec3<double>& f, double third, double least) {
  const Vec3<double> c = cross(e, f);
  const double area = dot(c, c), longest = std::max({dot(e, e), dot(f, f), third});
  return area > 0 && area < least * longest ? area / longest : least;
}

// A value for KernelPlacement::local_from.
//   least   the square of the least height that is not 0; infinity if there is none. It must not depend on how
//           the mesh is written down, or its bits would.
int local_origins_from(std::span<const std::array<double, 3>> positions, double least) {
  if (positions.empty()) return kLocalFrom;
  const double size = Box(positions).size();
  const auto lower_than = [&](double share) { return least < share * share * size * size; };
  if (positions.size() >= kManyVertices) return lower_than(kNeedle) ? 1 : kLocalFrom;
  int depth = 1;
  while (depth < kLocalFrom && !lower_than((1 << depth) / kMostRoundings)) ++depth;
  return depth;
}

}  // namespace

template <class T>
PlacedPoints<T> place_points(std::span<const std::array<double, 3>> positions) {
  PlacedPoints<T> placed{{}, KernelPlacement<T>{}};
  if (positions.empty()) return placed;
  const Box box(positions);
  const double extent = box.size();
  std::array<double, 3> centre{};
  for (std::size_t c = 0; c < 3; ++c)
    if (std::abs(box.middle(c)) > extent / 4) centre[c] = static_cast<float>(box.middle(c));
  double unit = 1;
  if (extent > 0 && std::isfinite(extent)) unit = std::ldexp(1., std::clamp(std::ilogb(extent), -120, 120));

  const double inverse = 1 / unit;
  placed.points.reserve(positions.size());
  for (const auto& p : positions) {
    placed.points.push_back({static_cast<T>((p[0] - centre[0]) * inverse),
                             static_cast<T>((p[1] - centre[1]) * inverse),
                             static_cast<T>((p[2] - centre[2]) * inverse), T(0)});
  }
  placed.placement = {{{static_cast<T>(centre[0]), static_cast<T>(centre[1]), static_cast<T>(centre[2])},
                       static_cast<T>(unit)},
                      kLocalFrom};
  return placed;
}

template <class T>
PlacedPoints<T> place(const data::ControlMesh& mesh) {
  PlacedPoints<T> placed = place_points<T>(mesh.positions);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : triangles_of(mesh)) {
    const auto &p = mesh.positions[t[0]], &q = mesh.positions[t[1]], &r = mesh.positions[t[2]];
    const Vec3<double> e{q[0] - p[0], q[1] - p[1], q[2] - p[2]}, f{r[0] - p[0], r[1] - p[1], r[2] - p[2]},
        g = f - e;
    least = lesser_squared_height(e, f, dot(g, g), least);
  }
  placed.placement.local_from = local_origins_from(mesh.positions, least);
  return placed;
}

template PlacedPoints<float> place_points(std::span<const std::array<double, 3>>);
template PlacedPoints<double> place_points(std::span<const std::array<double, 3>>);
template PlacedPoints<float> place(const data::ControlMesh&);
template PlacedPoints<double> place(const data::ControlMesh&);
template class BasicLoopRings<ScalarNumber<float>>;
template class BasicLoopRings<ScalarNumber<double>>;

template <class T>
PlacedPoints<T> place(const QuadMesh& mesh) {
  PlacedPoints<T> placed = place_points<T>(mesh.positions);
  const QuadAdjacency& adjacency = mesh.adjacency;
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t f = 0; f < adjacency.face_count(); ++f) {
    std::array<Vec3<double>, 4> side;
    for (int k = 0; k < 4; ++k) {
      const auto &p = mesh.positions[adjacency.corner(f, k)],
                 &q = mesh.positions[adjacency.corner(f, (k + 1) % 4)];
      side[k] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    }
    // At every corner: which is the first is a matter of writing.
    for (std::size_t k = 0; k < 4; ++k) least = lesser_squared_height(side[k], side[(k + 1) % 4], 0, least);
  }
  placed.placement.local_from = local_origins_from(mesh.positions, least);
  return placed;
}

template PlacedPoints<float> place(const QuadMesh&);
template PlacedPoints<double> place(const QuadMesh&);
template class BasicQuadRings<float>;
template class BasicQuadRings<double>;

}  // namespace limitcheck::fast::row_stream
