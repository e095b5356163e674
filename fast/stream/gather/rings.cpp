// SPDX-License-Identifier: MIT
#include "fast/stream/gather/rings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "fast/mesh/vec3.h"
#include "fast/stream/gather/rings_impl.h"

namespace limitcheck::fast::row_stream {

namespace {

// Seen from an origin common to the mesh, normals at depth d lose 2^d s / h roundings or more, where s is the
// size of the mesh and h the height of a triangle. So many are let pass before depth 4, and in meshes of many vertices,
// where most triangles are low and origins of their own cost 20 to 30 % of the time, more. No powers of two, for meshes
// in which s / h is one, where rounding would decide differently for each way to write them.
constexpr double most_roundings(std::size_t vertices) {
  return vertices < 8192 ? 1023 : 8185;
}

// From which depth on faces have origins of their own, by their lowest triangle. It must not depend on how the
// mesh is written down, or its bits would.
class LowTriangles {
 public:
  LowTriangles(std::span<const std::array<double, 3>> positions, std::size_t faces) : faces_(faces) {
    const double size = positions.empty() ? 0 : Box(positions).size();
    for (int depth = 1; depth < kLocalFrom; ++depth) {
      const double height = size * ((1 << depth) / most_roundings(positions.size()));
      squared_height_[depth] = height * height;
    }
  }
  /// The triangle of a face between e and f, over the longest of these and one of the squared length `third`. A flat
  /// one has no normal to lose.
  void see(std::size_t face, const Vec3<double>& e, const Vec3<double>& f, double third) {
    const Vec3<double> c = cross(e, f);
    const double area = dot(c, c), longest = std::max({dot(e, e), dot(f, f), third});
    if (!(area > 0 && area < squared_height_[kLocalFrom - 1] * longest)) return;
    if (from.empty()) from.assign(faces_, kLocalFrom);
    for (std::uint8_t depth = 1; depth < from[face]; ++depth)
      if (area < squared_height_[depth] * longest) from[face] = depth;
  }
  std::vector<std::uint8_t> from;  // empty: no triangle is low

 private:
  std::array<double, kLocalFrom> squared_height_{};
  std::size_t faces_;
};

}  // namespace

template <class T>
PlacedPoints<T> place_points(std::span<const std::array<double, 3>> positions) {
  PlacedPoints<T> placed{{}, Placement<T>{}};
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
  placed.placement = {{static_cast<T>(centre[0]), static_cast<T>(centre[1]), static_cast<T>(centre[2])},
                      static_cast<T>(unit)};
  return placed;
}

template <class T>
PlacedPoints<T> place(const data::ControlMesh& mesh) {
  PlacedPoints<T> placed = place_points<T>(mesh.positions);
  LowTriangles low(mesh.positions, mesh.faces.size());
  std::size_t face = 0;
  for (const auto& t : triangles_of(mesh)) {
    const auto &p = mesh.positions[t[0]], &q = mesh.positions[t[1]], &r = mesh.positions[t[2]];
    const Vec3<double> e{q[0] - p[0], q[1] - p[1], q[2] - p[2]}, f{r[0] - p[0], r[1] - p[1], r[2] - p[2]},
        g = f - e;
    low.see(face++, e, f, dot(g, g));
  }
  placed.faces_local_from = std::move(low.from);
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
  LowTriangles low(mesh.positions, static_cast<std::size_t>(adjacency.face_count()));
  for (std::int32_t f = 0; f < adjacency.face_count(); ++f) {
    std::array<Vec3<double>, 4> side;
    for (int k = 0; k < 4; ++k) {
      const auto &p = mesh.positions[adjacency.corner(f, k)],
                 &q = mesh.positions[adjacency.corner(f, (k + 1) % 4)];
      side[k] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    }
    // At every corner: which is the first is a matter of writing.
    for (std::size_t k = 0; k < 4; ++k) low.see(static_cast<std::size_t>(f), side[k], side[(k + 1) % 4], 0);
  }
  placed.faces_local_from = std::move(low.from);
  return placed;
}

template PlacedPoints<float> place(const QuadMesh&);
template PlacedPoints<double> place(const QuadMesh&);
template class BasicQuadRings<float>;
template class BasicQuadRings<double>;

}  // namespace limitcheck::fast::row_stream
