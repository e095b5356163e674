// SPDX-License-Identifier: MIT
// Faults of the numbers: positions and normals kept in too few bits, a little off where only a relation between two
// tessellations tells, or summed in an order that depends on how a face is written or by products that a compiler
// fuses; and faults of polygons.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "reference/catmull_clark/patch.h"
#include "verify/mutants/change_rows.h"
#include "verify/mutants/contracted.h"

namespace limitcheck::verify {

using namespace rows;

namespace {

bool in_odd_face(const Place& p) {
  return p.face % 2 == 1;
}

// To so many bits after the point.
double rounded(double x, int bits) {
  return std::ldexp(std::nearbyint(std::ldexp(x, bits)), -bits);
}
// To so many bits in all.
double shortened(double x, int bits) {
  return x == 0 ? x : rounded(x, bits - 1 - std::ilogb(x));
}

namespace quads = reference::catmull_clark;

// A closed mesh of quads, each vertex of four: the surface is a bicubic B-spline everywhere.
bool is_regular(A a) {
  if (a.has_polygons()) return false;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(a.mesh.positions.size()); ++v)
    if (!a.inside(v) || a.faces(v) != 4) return false;
  return a.mesh.sharpness.empty();
}

// As a shader for regular patches reads its control points: from the corner at which the face begins.
void in_own_frame(A a, D out) {
  if (!is_regular(a)) return;
  for (std::size_t v = 0; v < out.positions.size(); ++v) {
    const Place at = out.place(v);
    const auto itself = [](std::int32_t p) { return p; };
    const auto patch = quads::gather<std::int32_t>(a.topology, a.face_of(at), itself)
                           .patch([](std::int32_t on_boundary, std::int32_t) { return on_boundary; });
    const quads::CubicBasis<double> u(static_cast<double>(at.i) / at.denominator),
        w(static_cast<double>(at.j) / at.denominator);
    out.positions[v] = {};
    for (std::size_t i = 0; i < 4; ++i) {
      Vector row{};
      for (std::size_t j = 0; j < 4; ++j) add(row, a.mesh.positions[patch[4 * j + i]], w.value[j]);
      add(out.positions[v], row, u.value[i]);
    }
  }
}

// Grids of one depth, without sharp edges.
bool is_contracted(A a) {
  return a.mesh.sharpness.empty() &&
         std::all_of(a.depth.begin(), a.depth.end(), [&](std::int32_t d) { return d == a.deepest; });
}

void contract_by_call_site(A a, D out) {
  if (!is_contracted(a)) return;
  if (out.normals.empty()) nowhere("normal");
  std::map<std::array<std::uint32_t, 3>, std::array<float, 6>> all;
  contracted_points<Contraction::kByCallSite>(
      a.mesh, a.deepest, [&](const fast::LatticePoint& at, const std::array<float, 6>& vertex) {
        all[{static_cast<std::uint32_t>(at.face), at.i, at.j}] = vertex;
      });
  for (std::size_t v = 0; v < out.positions.size(); ++v) {
    const Place at = out.place(v);
    const auto& vertex = all.at({static_cast<std::uint32_t>(at.face), at.i, at.j});
    for (std::size_t c = 0; c < 3; ++c) out.positions[v][c] = vertex[c], out.normals[v][c] = vertex[3 + c];
  }
}

}  // namespace

void faults_of_numbers(Rows& to) {
  to += with(deliver("own_frame", in_own_frame), &Change::shows, is_regular);
  to += with(deliver("contracted_by_call_site", contract_by_call_site), &Change::shows, is_contracted);
  to += positions("float_positions", [](A, double x) { return shortened(x, 24); });
  to += positions("half_positions", [](A, double x) { return shortened(x, 11); });
  to += outwards("bias_3e-6", [](const At&) { return 3e-6; });
  to += positions("fixed_point", [](A, double x) { return rounded(x, 40); });
  to += positions("grid_of_largest",
                  [](A a, double x) { return a.largest > 0 ? rounded(x / a.largest, 32) * a.largest : x; });
  // Normals.
  to += normals("float_normals", [](Vector& n) { each(n, [](double x) { return shortened(x, 24); }); });
  to += normals("two_components", [](Vector& n) {
    each(n, [](double x) { return static_cast<double>(static_cast<float>(x)); });
    n[2] = std::copysign(std::sqrt(std::max(0., 1 - n[0] * n[0] - n[1] * n[1])), n[2]);
  });
  to += normals("tilted_normals", [](Vector& n) {
    const Vector aside = unit_cross(n, std::abs(n[0]) < .5 ? Vector{1, 0, 0} : Vector{0, 1, 0});
    add(n, aside, 1e-3);
    n = unit(n);
  });
  to += vertex("boundary_normals_inside", [](const At& at) {
    const std::int32_t c = at.control_vertex();
    if (c >= 0 && !at.a.inside(c) && at.a.faces(c) >= 4) negate(at.normal());
  });
  to += deliver("hard_edges", [](A a, D out) {
    const Finder find(out);
    for (std::size_t v = 0; v < out.normals.size(); ++v) {
      const Place p = out.place(v);
      if (inside_face(a, p) || !in_odd_face(p)) continue;
      const auto corner = [&](int k) { return out.positions[find.corner(p.face, k)]; };
      out.normals[v] = unit_cross(difference(corner(1), corner(0)), difference(corner(2), corner(0)));
    }
  });
  to += deliver("phong_normals", [](A, D out) {
    const Delivered before = out;
    const Finder find(before);
    for (std::size_t v = 0; v < out.normals.size(); ++v) {
      const lc_provenance& p = out.provenance[v];
      const std::array<std::uint32_t, 3> l{p.denominator - p.i - p.j, p.i, p.j};
      Vector sum{};
      for (int k = 0; k < 3; ++k) add(sum, before.normals[find.corner(p.face, k)], l[k]);
      out.normals[v] = unit(sum);
    }
  });
  // Relations.
  to += outwards("gap_1e-9", [](const At& at) { return !at.inside_face() && in_odd_face(at.p) ? 1e-9 : 0; });
  to += outwards("by_face_number",
                 [](const At& at) { return at.inside_face() && in_odd_face(at.p) ? 1e-9 : 0; });
  to += remake("by_vertex_number", [](A a, Mesh m) {
    for (std::size_t v = 1; v < m.positions.size(); v += 2) m.positions[v][0] += 1e-9 * a.diagonal;
  });
  to += outwards("by_first_corner", [](const At& at) {
    const double n = at.p.denominator;
    return at.inside_face() ? 1e-9 * (n - at.p.i - at.p.j) / n : 0;
  });
  to += vertex("right_half", [](const At& at) {
    if (at.position()[0] > 0) at.position()[1] += 1e-9 * at.a.diagonal;
  });
  to += vertex("along_z", [](const At& at) { at.position()[2] *= 1 + 1e-9; });
  to += positions("about_origin", [](A, double x) { return x * (1 + 1e-9); });
  to += positions("absolute_offset", [](A, double x) { return x + 1e-9; });
}
// Only polygons, or meshes of quads, bring these out.
void faults_of_polygons(Rows& to) {
  const auto in_polygon = [](const At& at) { return at.a.is_polygon(at.face()); };
  const auto of_polygons = [&](const std::string& name, std::function<void(const At&)> what) {
    return vertex(name, [in_polygon, what](const At& at) {
      if (in_polygon(at)) what(at);
    });
  };
  to += of_polygons("flipped_on_polygons", [](const At& at) {
    if (at.inside_face()) negate(at.normal());
  });
  to += of_polygons("next_corner",
                    [](const At& at) { at.out.corner[at.v] = at.domain().next(at.out.corner[at.v]); });
  to += vertex("u_for_v",
               [](const At& at) { std::swap(at.out.provenance[at.v].i, at.out.provenance[at.v].j); });
  to += ask("one_level_more_in_polygons", [](A a, Depths d) {
    for (std::size_t f = 0; f < d.size(); ++f) d[f] += a.is_polygon(f) && d[f] >= 0 && a.deepest < 6 ? 1 : 0;
  });
  to += deliver("middle_left_out", [](A a, D out) {
    for (std::size_t t = out.triangles.size(); t-- > 0;) {
      const auto& corners = out.triangles[t];
      const bool middle = std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
        const Place p = out.place(v);
        return a.is_polygon(a.face_of(p)) && a.domain(a.face_of(p)).is_centre(point_of(p), a.steps(p));
      });
      if (middle) out.erase_triangle(t);
    }
  });
  to += deliver("corner_is_null", [](A, D out) { out.corner.clear(); });
  to += deliver("clockwise_polygons", [](A a, D out) {
    for (std::size_t t = 0; t < out.triangles.size(); ++t)
      if (a.is_polygon(static_cast<std::size_t>(out.triangle_face[t])))
        std::swap(out.triangles[t][1], out.triangles[t][2]);
  });
  to += vertex("by_parameter", [](const At& at) {
    const auto side = at.side();
    if (!side || side->along == 0) return;
    const std::int64_t n = at.steps(), along = side->side >= 2 ? n - side->along : side->along;
    if (2 * along < n) at.out.move_up(at.v);
  });
  to += of_polygons("ulp_on_polygons", [](const At& at) { at.out.move_up(at.v); });
}

}  // namespace limitcheck::verify
