// SPDX-License-Identifier: MIT
// Faults of the depths, the triangles and the fans of frames, and of what is kept from one to the next.
#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

#include "data/cut_out.h"
#include "reference/loop/refine.h"
#include "verify/mutants/change_rows.h"

namespace limitcheck::verify {

using namespace rows;

namespace {

Change depth(const std::string& name, std::function<void(std::int32_t&)> what) {
  return ask(name, [what](A, Depths d) { std::for_each(d.begin(), d.end(), what); });
}

// Of each centre of a fan: visit(its vertex, its face).
template <class Visit>
void at_centres(const Delivered& out, Visit visit) {
  for (std::size_t v = 0; v < out.positions.size(); ++v)
    if (out.provenance[v].denominator == 3) visit(v, out.provenance[v].face);
}
Change centre(const std::string& name,
              std::function<Vector(A, const Delivered&, std::size_t, std::int32_t)> where) {
  return deliver(name, [where](A a, D out) {
    at_centres(out, [&](std::size_t v, std::int32_t face) { out.positions[v] = where(a, out, v, face); });
  });
}
Vector mean(const std::array<Vector, 3>& p) {
  Vector sum{};
  for (const Vector& q : p) add(sum, q, 1. / 3);
  return sum;
}

// Twice the triangles that `which` names by their numbers, in order.
template <class Which>
void repeat(D out, Which which) {
  const std::size_t count = out.triangles.size();
  for (std::size_t t = 0; t < count; ++t)
    if (which(t, t + 1 == count || out.triangle_face[t + 1] != out.triangle_face[t]))
      out.add_triangle(out.triangles[t], out.triangle_face[t]);
}

}  // namespace

void faults_of_frames(Rows& to) {
  to += depth("printed_cone_depth", [](std::int32_t& d) { d = std::min(d, 0); });
  to += depth("one_level_short", [](std::int32_t& d) { d -= d > 1 ? 1 : 0; });
  to += depth("culled_shown", [](std::int32_t& d) { d = std::max(d, 0); });
  to += deliver("one_strip_more", [](A, D out) { repeat(out, [](std::size_t, bool last) { return last; }); });
  to += deliver("buffer_as_printed", [](A, D out) {  // as many vectors as the true sum counts
    out.announced_vertices = static_cast<std::int64_t>(out.positions.size()) + 5 + 6 * 50;
  });
  to += deliver("fan_twice", [](A, D out) {
    repeat(out, [&](std::size_t t, bool last) {
      return last && out.provenance[out.triangles[t][0]].denominator == 3;
    });
  });
  to += centre("printed_b1", [](A a, const Delivered& out, std::size_t v, std::int32_t face) {
    Vector p = out.positions[v];
    for (std::size_t k = 0; k < 3; ++k)
      if (a.beyond(static_cast<std::size_t>(face), k) < 0) return p;
    // b1 weighs the first of the twelve points: neighbour 4, from the next corner on, of the edge point.
    reference::RefinedMesh<double> once(a.mesh);
    once.refine();
    const auto f = static_cast<std::size_t>(face);
    const std::int32_t four = once.vertex(f, 1, 0), seven = once.vertex(f, 1, 1);
    const auto ring = once.topology().ring(four);
    const auto first = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), seven) - ring.begin());
    const auto& one = once.positions()[ring[(first + 4) % ring.size()]];
    add(p, {one.x, one.y, one.z}, (11. / 108 - 1. / 4) / 81);
    return p;
  });
  to += centre("flat_centre", [](A, const Delivered& out, std::size_t, std::int32_t f) {
    const Finder at(out);
    return mean(
        {out.positions[at.corner(f, 0)], out.positions[at.corner(f, 1)], out.positions[at.corner(f, 2)]});
  });
  to += centre("control_centroid", [](A a, const Delivered&, std::size_t, std::int32_t f) {
    const auto t = a.mesh.faces[static_cast<std::size_t>(f)];
    return mean({a.mesh.positions[t[0]], a.mesh.positions[t[1]], a.mesh.positions[t[2]]});
  });
  to += centre("centre_without_ghosts", [](A a, const Delivered& out, std::size_t v, std::int32_t face) {
    const auto f = static_cast<std::size_t>(face);
    if (a.beyond(f, 0) >= 0 && a.beyond(f, 1) >= 0 && a.beyond(f, 2) >= 0) return out.positions[v];
    Vector sum{};
    double count = 0;
    for (const auto& t : out.triangles)
      if (t[0] == v) add(sum, out.positions[t[1]], 1), ++count;
    each(sum, [&](double x) { return x / count; });
    return sum;
  });
  to += deliver("flat_centre_normal", [](A a, D out) {
    at_centres(out, [&](std::size_t v, std::int32_t f) {
      const auto t = a.mesh.faces[static_cast<std::size_t>(f)];
      const Vector& p = a.mesh.positions[t[0]];
      out.normals[v] =
          unit_cross(difference(a.mesh.positions[t[1]], p), difference(a.mesh.positions[t[2]], p));
    });
  });
  to += deliver("inner_t_vertices", [](A a, D out) {
    leave_out(out, half_fan(out, [&](const HalfFan& fan, std::size_t) {
                const auto f = static_cast<std::size_t>(out.triangle_face[fan.triangles[0]]);
                const bool stitched = a.depth_beyond(f, 0) > a.depth[f] ||
                                      a.depth_beyond(f, 1) > a.depth[f] || a.depth_beyond(f, 2) > a.depth[f];
                const auto &m = out.provenance[fan.m], &p = out.provenance[fan.a], &q = out.provenance[fan.b];
                return stitched && inside_face(a, out.place(fan.m)) && m.denominator == p.denominator &&
                       m.denominator == q.denominator && p.i + q.i == 2 * m.i && p.j + q.j == 2 * m.j;
              }));
  });
  to += ask("depth_of_the_first", [](A, Depths d) { std::fill(d.begin(), d.end(), std::int32_t{d[0]}); });
  to += ask("first_culled_all_culled", [](A, Depths d) {
    if (d[0] < 0) std::fill(d.begin(), d.end(), -1);
  });
  to += ask("fails_if_all_culled", [](A, Depths d) {
    if (*std::max_element(d.begin(), d.end()) < 0) throw std::runtime_error("there is nothing to show");
  });
  to += ask("depths_not_supported", [](A, Depths d) {
    if (std::any_of(d.begin(), d.end(), [&](std::int32_t x) { return x != d[0]; }))
      throw SubjectError(LC_NOT_SUPPORTED, "all faces must have one depth");
  });
  to += vertex("crack_at_depth_steps", [](const At& at) {
    const auto side = at.side();
    if (!side || side->along == 0) return;
    const int other = at.a.depth_beyond(at.face(), static_cast<std::size_t>(side->side));
    if (other >= 0 && other < at.a.depth[at.face()]) at.out.move_up(at.v);
  });
  to += deliver("chords_at_depth_steps", [](A a, D out) {
    const Delivered before = out;
    const Finder find(before);
    for (std::size_t v = 0; v < out.positions.size(); ++v) {
      const Place p = out.place(v);
      const auto at = a.side_of(p);
      if (!at) continue;
      const int other = a.depth_beyond(a.face_of(p), static_cast<std::size_t>(at->side));
      if (other < 0 || other >= a.depth[a.face_of(p)]) continue;
      const std::int64_t n = a.steps(p), step = n >> other, from = at->along / step * step;
      if (from == at->along) continue;
      const auto end = [&](std::int64_t along) {
        const auto q = a.domain(a.face_of(p)).on_side(at->side, along, n);
        return before.positions[find(p.face, q.i, q.j, n)];
      };
      const Vector first = end(from);
      out.positions[v] = first;
      add(out.positions[v], difference(end(from + step), first),
          static_cast<double>(at->along - from) / static_cast<double>(step));
    }
  });
  to += outwards("last_face", [](const At& at) {
    return at.inside_face() && at.face() + 1 == at.a.mesh.faces.size() ? 1e-6 : 0;
  });
  to += vertex("faces_sorted", [](const At& at) {
    const auto c = at.a.mesh.faces[at.face()];
    const auto lowest = static_cast<int>(std::min_element(c.begin(), c.end()) - c.begin());
    const auto q = at.domain().moved(point_of(at.p), at.steps(), {(3 - lowest) % 3});
    at.out.provenance[at.v].i = static_cast<std::uint32_t>(q.i);
    at.out.provenance[at.v].j = static_cast<std::uint32_t>(q.j);
  });
  to += vertex("edges_sorted", [](const At& at) {
    lc_provenance& p = at.out.provenance[at.v];
    const auto c = at.a.mesh.faces[at.face()];
    if (p.j == 0 && c[0] > c[1]) p.i = p.denominator - p.i;
  });
  to += deliver("normals_forgotten", [](A, D out) { out.normals.clear(); });
  // What is kept from one frame to the next.
  to += deliver("culled_are_holes", [](A a, D out) {
    std::vector<std::int32_t> shown, depths;
    for (std::size_t f = 0; f < a.depth.size(); ++f)
      if (a.depth[f] >= 0) shown.push_back(static_cast<std::int32_t>(f)), depths.push_back(a.depth[f]);
    if (shown.empty() || shown.size() == a.depth.size()) return;
    const data::CutOut part = data::cut_out(a.mesh.faces, shown);
    out = a.again({part.of(a.mesh.positions), part.faces, part.of(a.mesh.sharpness)}, depths);
    for (lc_provenance& p : out.provenance) p.face = shown[static_cast<std::size_t>(p.face)];
    for (std::int32_t& f : out.triangle_face) f = shown[static_cast<std::size_t>(f)];
  });
  to += deliver("stale_patch", [](A a, D out) {
    data::ControlMesh other = a.mesh;
    for (Vector& p : other.positions) each(p, [](double x) { return x / 2; });
    const Delivered before = a.again(other, {a.depth.begin(), a.depth.end()});
    if (out.triangles.empty()) nowhere("patch that stays");
    for (std::size_t v = 0; v < out.positions.size(); ++v)
      if (out.provenance[v].face == out.triangle_face[0]) out.positions[v] = before.positions[v];
  });
  to += deliver("place_twice", [](A a, D out) {
    const std::int32_t first = out.triangle_face.empty() ? -1 : out.triangle_face[0];
    std::map<std::int32_t, std::vector<std::size_t>> of;
    for (std::size_t t = 0; t < out.triangles.size(); ++t) of[out.triangle_face[t]].push_back(t);
    for (const auto& [face, theirs] : of)
      if (face != first && theirs.size() == of[first].size() &&
          a.depth[static_cast<std::size_t>(face)] == a.depth[static_cast<std::size_t>(first)]) {
        for (std::size_t k = 0; k < theirs.size(); ++k)
          out.triangles[theirs[k]] = std::array(out.triangles[of[first][k]]);
        return;
      }
    nowhere("two patches of one size");
  });
  to += deliver("old_edge_depth", [](A a, D out) {
    std::vector<std::int32_t> depths(a.depth.begin(), a.depth.end());
    for (std::size_t f = 0; f < depths.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        if (a.depth[f] < 1 || a.depth_beyond(f, k) <= a.depth[f]) continue;
        for (std::size_t side = 0; side < 3; ++side)
          if (const std::int32_t g = a.beyond(f, side); g >= 0 && a.depth[g] > a.depth[f])
            depths[g] = a.depth[f];
        const Delivered before = a.again(a.mesh, depths);
        const auto face = static_cast<std::int32_t>(f);
        for (std::size_t t = out.triangles.size(); t-- > 0;)
          if (out.triangle_face[t] == face) out.erase_triangle(t);
        std::map<std::uint32_t, std::uint32_t> number;
        for (std::size_t t = 0; t < before.triangles.size(); ++t) {
          if (before.triangle_face[t] != face) continue;
          std::array<std::uint32_t, 3> triangle = before.triangles[t];
          for (std::uint32_t& v : triangle) {
            const auto [known, is_new] = number.try_emplace(v, 0);
            if (is_new) known->second = out.add_vertex(before, v);
            v = known->second;
          }
          out.add_triangle(triangle, face);
        }
        return;
      }
    nowhere("face in repair whose edges have become deeper");
  });
}

}  // namespace limitcheck::verify
