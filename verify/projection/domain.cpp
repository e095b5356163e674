// SPDX-License-Identifier: MIT
#include "verify/projection/domain.h"

#include <set>
#include <utility>

namespace limitcheck::verify {

Domain::Domain(const data::ControlMesh& mesh, const reference::SharpTags& tags)
    : lattice_(mesh, 0), around_(mesh.faces, mesh.positions.size()) {
  std::set<std::pair<std::int32_t, std::int32_t>> lasting;
  for (const auto& edge : tags.edges)
    if (edge.sharpness.as_double() >= data::kInfiniteSharpness) lasting.insert(std::minmax(edge.a, edge.b));
  if (lasting.empty()) return;
  cut_.assign(lattice_.corner_count(), false);
  for (std::int32_t f = 0; f < lattice_.face_count(); ++f)
    for (int k = 0; k < chart().corners(); ++k) {
      const Lattice::Edge& edge = lattice_.edge(f, k);
      cut_[lattice_.corner_number(f, k)] = !edge.on_boundary() && lasting.contains({edge.a, edge.b});
    }
}

bool Domain::on_cut(const FacePoint& at) const {
  if (cut_.empty()) return false;
  if (const int corner = chart().corner_at(at.l); corner >= 0) {
    const std::int32_t v = vertex(at.face, corner);
    for (const std::int32_t f : faces_at(v)) {
      const int its = *lattice_.corner_of(f, v), sides = chart().corners();
      for (const int begin : {its, (its + sides - 1) % sides})
        if (cut_[lattice_.corner_number(f, begin)]) return true;
    }
    return false;
  }
  for (int k = 0; k < chart().corners(); ++k)
    if (chart().height(k, at.l) == 0 && is_cut(at.face, k)) return true;
  return false;
}

std::int32_t Domain::across(std::int32_t face, int k) const {
  return lattice_.across(face, chart().first(k));
}

int Domain::side_across(std::int32_t face, int k) const {
  const int begin = chart().first(k);
  const Lattice::Edge& edge = lattice_.edge(face, begin);
  return chart().side_from(edge.corner[edge.face[0] == face && edge.corner[0] == begin ? 1 : 0]);
}

bool Domain::express(const FacePoint& point, std::int32_t face, FacePoint& result) const {
  result = {face, {0, 0, 0}};
  if (point.face == face) {
    result = point;
    return true;
  }
  if (const int k = chart().corner_at(point.l); k >= 0) {
    const auto corner = lattice_.corner_of(face, vertex(point.face, k));
    if (corner) result.l = chart().corner(*corner);
    return corner.has_value();
  }
  for (int k = 0; k < chart().corners(); ++k) {
    if (chart().height(k, point.l) != 0 || across(point.face, k) != face) continue;
    result.l = chart().put_on(side_across(point.face, k), unfolded(point.face, k, point.l));
    return true;
  }
  return false;
}

// `whole`: the sum of the coordinates, 1 of a point and 0 of a step.
Chart::Affine Domain::turned(std::int32_t face, int k, const Chart::Affine& l, double whole) const {
  const Chart shape = chart();
  const int side = side_across(face, k);
  if (!shape.is_square()) {  // (a, b, c) with c left behind becomes (b, a, d), d = a + b - c
    Chart::Affine there{};
    there[shape.last(side)] = l[shape.first(k)] + l[k];
    there[shape.first(side)] = l[shape.last(k)] + l[k];
    there[side] = -l[k];
    return there;
  }
  // Along the side and away from it, counted from where it begins; then from the other face, and turned back.
  const auto [along, away] = shape.from_corner(k, l, whole);
  const auto [u, v] = shape.from_corner((4 - side) % 4, {whole, whole - along, -away}, whole);
  return {whole - u - v, u, v};
}

Chart::Affine Domain::unfolded(std::int32_t face, int k, const Chart::Affine& l) const {
  return turned(face, k, l, 1);
}

FacePoint Domain::walk(FacePoint from, Chart::Affine step) const {
  const Chart shape = chart();
  // A straight line crosses few edges unless it circles a vertex; then any point on its way is good enough.
  for (int crossing = 0; crossing < 24; ++crossing) {
    double way = 1;
    int exit = -1;
    for (int k = 0; k < shape.corners(); ++k) {
      const double height = shape.height(k, from.l), slope = shape.slope(k, step);
      if (slope < 0 && height + slope < 0 && height / -slope < way) {
        way = height / -slope;
        exit = k;
      }
    }
    for (int k = 0; k < 3; ++k) from.l[k] += way * step[k];
    from.l = shape.clamp(from.l);
    if (exit < 0) return from;
    from.l = shape.clamp(shape.put_on(exit, from.l));
    if (!goes_on(from.face, exit)) return from;
    const std::int32_t next = across(from.face, exit);
    for (double& s : step) s *= 1 - way;
    const int entry = side_across(from.face, exit);
    const Chart::Affine on = turned(from.face, exit, step, 0);
    from = {next, shape.put_on(entry, unfolded(from.face, exit, from.l))};
    step = on;
  }
  return from;
}

}  // namespace limitcheck::verify
