// SPDX-License-Identifier: MIT
// Faults of what any subject of Loop's scheme delivers: a name, what it does, the check meant to find it, and a
// function that does it.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <utility>

#include "verify/mutants/change_rows.h"

namespace limitcheck::verify {

using namespace rows;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// All bytes 0xFF, as the host's memory is; so is the float that it is rounded to.
double unwritten() {
  double value;
  std::memset(&value, 0xFF, sizeof value);
  return value;
}

std::size_t some_vertex(const Delivered& out) {
  if (out.positions.empty()) nowhere("vertex");
  return out.positions.size() / 2;
}
std::size_t some_triangle(const Delivered& out) {
  if (out.triangles.empty()) nowhere("triangle");
  return out.triangles.size() / 2;
}
Vector& some_normal(D out) {
  if (out.normals.empty()) nowhere("normal");
  return out.normals[some_vertex(out)];
}

// Round a point inside an edge: there are no other triangles of the face, and these do not go all round it.
HalfFan on_an_edge(const Delivered& out) {
  return half_fan(out,
                  [](const HalfFan& fan, std::size_t incident) { return incident == 3 && fan.a != fan.b; });
}

// Gives the half fan a vertex of its own in place of m, a copy. Returns it.
std::size_t split_off(D out) {
  const HalfFan fan = on_an_edge(out);
  const std::uint32_t v = out.add_vertex(Delivered(out), fan.m);
  for (const auto t : fan.triangles) std::replace(out.triangles[t].begin(), out.triangles[t].end(), fan.m, v);
  return v;
}

// Edges in the order in which the faces name them; points inside those beyond the first `room` lie half way
// between its ends.
Change forgotten_edges(const std::string& name, std::function<std::size_t(A)> room) {
  return deliver(name, [room](A a, D out) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> edges;
    const auto& faces = a.mesh.faces;
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        edges.emplace(std::minmax(std::int32_t{faces[f][k]}, std::int32_t{faces[f][(k + 1) % 3]}),
                      edges.size());
    for (std::size_t v = 0; v < out.positions.size(); ++v) {
      const Place p = out.place(v);
      const auto at = a.side_of(p);
      if (!at || at->along == 0) continue;
      const auto t = faces[a.face_of(p)];
      const std::int32_t from = t[at->side], to = t[static_cast<std::size_t>(at->side + 1) % 3];
      if (edges.at(std::minmax(from, to)) < room(a)) continue;
      for (std::size_t c = 0; c < 3; ++c)
        out.positions[v][c] = (a.mesh.positions[from][c] + a.mesh.positions[to][c]) / 2;
    }
  });
}

int component(const At& at) {
  return at.a.component[at.a.mesh.faces[at.face()][0]];
}
void too_far_out(Vector& p) {
  each(p, [](double x) { return x * 1.00001; });
}
Change memory(const std::string& name, bool Delivered::*what) {
  return deliver(name, [what](A, D out) { out.*what = true; });
}

void of_all_meshes(Rows& to) {
  // Values.
  to += deliver("nan_position", [](A, D out) { out.positions[some_vertex(out)][1] = kNan; });
  to += deliver("infinite_position", [](A, D out) {
    out.positions[some_vertex(out)][1] = std::numeric_limits<double>::infinity();
  });
  to += deliver("nan_normal", [](A, D out) { some_normal(out)[1] = kNan; });
  to += deliver("unwritten_position", [](A, D out) { out.positions[some_vertex(out)].fill(unwritten()); });
  to += deliver("unwritten_normal", [](A, D out) { some_normal(out).fill(unwritten()); });
  to += deliver("unwritten_triangle", [](A, D out) { out.triangles[some_triangle(out)].fill(0xFFFFFFFFU); });
  to += deliver("unwritten_provenance", [](A, D out) {
    out.provenance[some_vertex(out)] = {-1, 0xFFFFFFFFU, 0xFFFFFFFFU, 0xFFFFFFFFU};
  });
  to += deliver("unwritten_triangle_face", [](A, D out) { out.triangle_face[some_triangle(out)] = -1; });
  to += vertex("wrong_limit_mask", [](const At& at) {
    if (const std::int32_t c = at.control_vertex(); c >= 0)
      add(at.position(), difference(at.a.mesh.positions[c], at.position()), 0.01);
  });
  to += vertex("wrong_edge_mask", [](const At& at) {
    if (at.control_vertex() < 0) too_far_out(at.position());
  });
  to += vertex("unmoved_vertices", [](const At& at) {
    if (const std::int32_t c = at.control_vertex(); c >= 0) at.position() = at.a.mesh.positions[c];
  });
  to += positions("snapped_positions", [](A, double x) { return std::round(x * 50) / 50; });
  to += normals("flipped_normals", negate);
  to += deliver("one_flipped_normal", [](A, D out) { negate(some_normal(out)); });
  to += normals("long_normals", [](Vector& n) { each(n, [](double x) { return x * 2; }); });
  // Which point is which.
  to += deliver("shifted_provenance", [](A, D out) {
    some_vertex(out);
    std::rotate(out.provenance.begin(), out.provenance.begin() + 1, out.provenance.end());
  });
  to += deliver("mirrored_provenance", [](A, D out) {
    for (lc_provenance& p : out.provenance) std::swap(p.i, p.j);
  });
  to += deliver("swapped_points", [](A, D out) {
    const auto [a, b, c] = out.triangles[some_triangle(out)];
    std::swap(out.positions[a], out.positions[b]);
    if (!out.normals.empty()) std::swap(out.normals[a], out.normals[b]);
  });
  to += deliver("provenance_out_of_range", [](A, D out) {
    lc_provenance& p = out.provenance[some_vertex(out)];
    p.i = p.denominator + 1;
  });
  // Triangles.
  to += deliver("flipped_orientation", [](A, D out) {
    for (auto& t : out.triangles) std::swap(t[1], t[2]);
  });
  to += deliver("one_flipped_triangle", [](A, D out) {
    auto& t = out.triangles[some_triangle(out)];
    std::swap(t[1], t[2]);
  });
  to += deliver("missing_triangle", [](A, D out) { out.erase_triangle(some_triangle(out)); });
  to += deliver("duplicated_triangle", [](A, D out) {
    const std::size_t t = some_triangle(out);
    out.add_triangle(out.triangles[t], out.triangle_face[t]);
  });
  to += deliver("face_twice", [](A, D out) {
    some_triangle(out);
    const std::int32_t face = out.triangle_face.back();
    for (std::size_t t = 0, count = out.triangles.size(); t < count; ++t)
      if (out.triangle_face[t] == face) out.add_triangle(out.triangles[t], face);
  });
  to += deliver("wrong_triangle_face", [](A a, D out) {
    auto& face = out.triangle_face[some_triangle(out)];
    face = (face + 1) % static_cast<std::int32_t>(a.mesh.faces.size());
  });
  to += deliver("index_out_of_range", [](A, D out) {
    out.triangles[some_triangle(out)][2] = static_cast<std::uint32_t>(out.positions.size());
  });
  to += deliver("t_vertex", [](A, D out) { leave_out(out, on_an_edge(out)); });
  to += deliver("one_ulp_crack", [](A, D out) { out.move_up(split_off(out)); });
  to += deliver("one_ulp_normal", [](A, D out) {
    some_normal(out);
    double& x = out.normals[split_off(out)][0];
    x = out.one_ulp_up(x);
  });
  // Memory.
  to += deliver("negative_count", [](A, D out) { out.announced_vertices = -1; });
  to += deliver("count_too_large", [](A, D out) {
    out.announced_vertices = static_cast<std::int64_t>(out.positions.size()) + 1;
  });
  to += memory("foreign_memory", &Delivered::foreign_normals);
  to += memory("write_behind", &Delivered::overrun);
  to += memory("write_before", &Delivered::underrun);
  to += memory("modified_mesh", &Delivered::modify_mesh);
  to += memory("overlapping_arrays", &Delivered::overlap);
}

// Tables too short, assumptions about the shape, neighbourhoods that a search over many meshes has to find.
void of_some_meshes(Rows& to) {
  to += forgotten_edges("edges_of_genus_0", [](A a) { return 3 * a.mesh.positions.size() - 6; });
  to += forgotten_edges("edges_of_genus_1", [](A a) { return 3 * a.mesh.positions.size(); });
  to += vertex("second_component", [](const At& at) {
    if (component(at) > 0 && !at.out.normals.empty()) negate(at.normal());
  });
  to += vertex("third_component", [](const At& at) {
    if (component(at) > 1) too_far_out(at.position());
  });
  to += deliver("welded_components", [](A a, D out) {
    std::map<Vector, std::pair<int, std::size_t>> known;
    for (std::size_t v = 0; v < out.positions.size(); ++v) {
      const std::int32_t at = a.control_vertex(out.place(v));
      if (at < 0) continue;
      const auto [first, is_new] = known.try_emplace(a.mesh.positions[at], a.component[at], v);
      if (!is_new && first->second.first != a.component[at])
        out.positions[v] = Vector(out.positions[first->second.second]);
    }
  });
  to += deliver("flat_box", [](A a, D out) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto less = [&](const auto& p, const auto& q) { return p[c] < q[c]; };
      const auto [low, high] = std::minmax_element(a.mesh.positions.begin(), a.mesh.positions.end(), less);
      if ((*low)[c] == (*high)[c])
        for (Vector& p : out.positions) p[c] = kNan;
    }
  });
  to += vertex("edge_without_length", [](const At& at) {
    const std::int32_t c = at.control_vertex();
    if (c < 0) return;
    for (const std::int32_t r : at.a.topology.ring(c))
      if (at.a.mesh.positions[r] == at.a.mesh.positions[c]) at.position().fill(kNan);
  });
  to += take("indices_of_16_bits", [](Mesh m) {
    for (std::size_t v = 0x10000; v < m.positions.size(); ++v) m.positions[v] = m.positions[v & 0xFFFF];
  });
  to += moved("adjacent_extraordinary", [](A a, const Place& p) {
    const auto corners = a.mesh.faces[a.face_of(p)];
    return a.control_vertex(p) < 0 && std::count_if(corners.begin(), corners.end(), [&](std::int32_t v) {
                                        return a.inside(v) && a.faces(v) != 6;
                                      }) > 1;
  });
  to += moved("depth_difference_3", [](A a, const Place& p) {
    const auto beside = [&](std::size_t side) {
      const int other = a.depth_beyond(a.face_of(p), side);
      return other >= 0 && std::abs(a.depth[a.face_of(p)] - other) == 3;
    };
    return a.control_vertex(p) < 0 && (beside(0) || beside(1) || beside(2));
  });
  to += moved("valence_above_40", [](A a, const Place& p) { return amid_more(a, a.control_vertex(p), 40); });
}

}  // namespace

HalfFan half_fan(const Delivered& out, const std::function<bool(const HalfFan&, std::size_t)>& wanted) {
  // Of each corner of a face: the triangles there, (m, x, y), by their x.
  using Around = std::map<std::uint32_t, std::pair<std::size_t, std::uint32_t>>;
  std::map<std::pair<std::int32_t, std::uint32_t>, Around> around;
  const auto corner = [&](std::size_t t, std::size_t k) { return out.triangles[t][k % 3]; };
  for (std::size_t t = 0; t < out.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      around[{out.triangle_face[t], corner(t, k)}].try_emplace(corner(t, k + 1), t, corner(t, k + 2));
  for (std::size_t t = 0; t < out.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t m = corner(t, k), a = corner(t, k + 1), x = corner(t, k + 2);
      const Around& here = around.at({out.triangle_face[t], m});
      const auto second = here.find(x);
      if (second == here.end()) continue;
      const auto third = here.find(second->second.second);
      if (third == here.end()) continue;
      const HalfFan fan{
          {t, second->second.first, third->second.first}, m, a, x, third->first, third->second.second};
      if (wanted(fan, here.size())) return fan;
    }
  nowhere("point to leave out");
}

void leave_out(D out, const HalfFan& fan) {
  out.triangles[fan.triangles[0]] = {fan.b, fan.a, fan.x};
  out.triangles[fan.triangles[1]] = {fan.b, fan.x, fan.y};
  out.erase_triangle(fan.triangles[2]);
}

std::span<const Fault> faults() {
  static const Rows list = [] {
    Rows to;
    to += row("none");
    of_all_meshes(to), of_some_meshes(to);
    return to;
  }();
  return list;
}

}  // namespace limitcheck::verify
