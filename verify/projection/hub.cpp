// SPDX-License-Identifier: MIT
#include "verify/projection/hub.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "reference/catmull_clark/refined_mesh.h"
#include "reference/loop/refine.h"
#include "verify/evidence/vector.h"
#include "verify/interrupt/interrupt.h"

namespace limitcheck::verify {
namespace {

constexpr int kLevels = 14;

using reference::Topology;
using Points = std::vector<reference::Vec3<double>>;

struct Part {
  Points positions;
  data::Faces faces;
};

// Some faces of a mesh, turned so that they begin at vertex 0 if they have it, and all faces that touch one of
// their corners. Vertex `centre` becomes vertex 0.
Part around(const Topology& topology, const Points& positions, std::int32_t centre,
            std::span<const std::int32_t> first) {
  std::vector<std::int32_t> faces(first.begin(), first.end());
  std::unordered_set<std::int32_t> known(first.begin(), first.end());
  for (const std::int32_t f : first)
    for (const std::int32_t v : topology.faces()[f])
      if (v != centre)
        for (const std::int32_t near : topology.sector(v).faces)
          if (known.insert(near).second) faces.push_back(near);
  Part part;
  std::unordered_map<std::int32_t, std::int32_t> number{{centre, 0}};
  part.positions.push_back(positions[centre]);
  std::vector<std::int32_t> corners;
  for (const std::int32_t f : faces) {
    const auto face = topology.faces()[f];
    corners.assign(face.begin(), face.end());
    for (std::int32_t& v : corners) {
      const auto [at, is_new] = number.try_emplace(v, static_cast<std::int32_t>(part.positions.size()));
      if (is_new) part.positions.push_back(positions[v]);
      v = at->second;
    }
    if (const auto at = std::find(corners.begin(), corners.end(), 0); at != corners.end())
      std::rotate(corners.begin(), at, corners.end());
    part.faces.push_back(corners);
  }
  return part;
}

// One step of a part, of which the first `count` faces are those at vertex 0. Their first children follow at
// every fourth place: at the corner where the face begins.
template <class Refined>
Part step(Refined refined, std::size_t count) {
  refined.refine();
  std::vector<std::int32_t> first;
  for (std::size_t f = 0; f < count; ++f) first.push_back(static_cast<std::int32_t>(4 * f));
  return around(refined.topology(), refined.positions(), 0, first);
}

// x = a[0] l1 + a[1] l2 + .., y = b[0] l1 + b[1] l2 + ..: the coordinates seen from a corner.
struct FromCorner {
  double x, y;
  std::array<double, 2> a, b;
};
FromCorner from_corner(data::Scheme scheme, int corner, const Chart::Affine& l) {
  const double u = l[1], v = l[2];
  if (scheme == data::Scheme::kLoop) {
    if (corner == 0) return {u, v, {1, 0}, {0, 1}};
    if (corner == 1) return {v, std::max(0., l[0]), {0, 1}, {-1, -1}};
    return {std::max(0., l[0]), u, {-1, -1}, {1, 0}};
  }
  if (corner == 0) return {u, v, {1, 0}, {0, 1}};
  if (corner == 1) return {v, 1 - u, {0, 1}, {-1, 0}};
  if (corner == 2) return {1 - u, 1 - v, {-1, 0}, {0, -1}};
  return {1 - v, u, {0, -1}, {1, 0}};
}

}  // namespace

Hub::Hub(const data::ControlMesh& mesh, const Topology& topology, data::Scheme scheme, std::int32_t vertex)
    : scheme_(scheme) {
  const auto sector = topology.sector(vertex).faces;
  faces_.assign(sector.begin(), sector.end());
  std::sort(faces_.begin(), faces_.end());
  Points positions;
  for (const auto& p : mesh.positions) positions.push_back({p[0], p[1], p[2]});
  Part part = around(topology, positions, vertex, faces_);
  levels_.reserve(kLevels);
  for (int level = 0; level < kLevels; ++level) {
    end_if_interrupted();
    if (scheme == data::Scheme::kLoop)
      part = step(reference::RefinedMesh<double>(part.positions, data::Triangles(part.faces).to_vector()),
                  faces_.size());
    else
      part = step(reference::catmull_clark::RefinedMesh<double>(part.faces, part.positions), faces_.size());
    Level& its = levels_.emplace_back();
    for (const auto& p : part.positions) its.mesh.positions.push_back(vector_of(p));
    its.mesh.faces = part.faces;
    its.surface = std::make_unique<reference::Surface>(its.mesh, scheme);
  }
}

std::optional<reference::SurfacePoint<double>> Hub::evaluate(std::int32_t face, int corner,
                                                             const Chart::Affine& at,
                                                             reference::Order order) const {
  const FromCorner p = from_corner(scheme_, corner, at);
  // How often the distance from the corner, measured as the schemes do, is to be doubled to exceed 1/2.
  const double far = scheme_ == data::Scheme::kLoop ? p.x + p.y : std::max(p.x, p.y);
  if (!(far > 0) || far > .5) return std::nullopt;
  int exponent = 0;
  const double mantissa = std::frexp(far, &exponent);
  const int steps = mantissa == .5 ? 1 - exponent : -exponent;
  if (steps < 1 || steps > kLevels) return std::nullopt;
  double x = std::ldexp(p.x, steps), y = std::ldexp(p.y, steps);
  if (scheme_ == data::Scheme::kLoop && y > 1 - x) (x > y ? y : x) = 1 - (x > y ? x : y);
  const auto which = std::lower_bound(faces_.begin(), faces_.end(), face) - faces_.begin();
  const auto& surface = *levels_[static_cast<std::size_t>(steps - 1)].surface;
  auto s = surface.evaluate(static_cast<int>(which), 0, x, y, order);
  reference::scale_derivatives(s, std::ldexp(1.0, steps));
  const auto turned = s;
  const auto [a1, a2] = p.a;
  const auto [b1, b2] = p.b;
  s.d1 = turned.d1 * a1 + turned.d2 * b1;
  s.d2 = turned.d1 * a2 + turned.d2 * b2;
  s.t1 = s.d1, s.t2 = s.d2;
  s.d11 = turned.d11 * (a1 * a1) + turned.d12 * (2 * a1 * b1) + turned.d22 * (b1 * b1);
  s.d12 = turned.d11 * (a1 * a2) + turned.d12 * (a1 * b2 + a2 * b1) + turned.d22 * (b1 * b2);
  s.d22 = turned.d11 * (a2 * a2) + turned.d12 * (2 * a2 * b2) + turned.d22 * (b2 * b2);
  return s;
}

}  // namespace limitcheck::verify
