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

// Delivered in float: small faults hide in wider bounds.
Change in_float(Change c) {
  return with(std::move(c), &Change::options, "precision=float");
}
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
  for (std::size_t f = 0; f < a.mesh.faces.size(); ++f)
    if (a.is_polygon(f)) return false;
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

std::vector<Change> faults_of_numbers() {
  Change spline =
      deliver("own_frame", "B-splines summed in the frame of the face: its first corner decides the order",
              "corner-rotation", in_own_frame);
  spline.on = On::kQuads;
  spline.shows = is_regular;
  Change contracted =
      deliver("contracted_by_call_site",
              "row streaming by a compiler that fuses products with sums in each copy of code otherwise",
              "shared-positions", contract_by_call_site);
  contracted.of = "row-stream";
  contracted.shows = is_contracted;
  return {
      spline,
      contracted,
      positions("float_positions", "positions computed in float, and declared double", "positions",
                [](A, double x) { return shortened(x, 24); }),
      in_float(positions("half_positions", "positions kept in 16 bits", "positions",
                         [](A, double x) { return shortened(x, 11); })),
      in_float(outwards("bias_3e-6", "all points are 3e-6 of the box too far out", "positions",
                        [](const At&) { return 3e-6; })),
      positions("fixed_point", "positions are multiples of 2^-40 units", "scaling",
                [](A, double x) { return rounded(x, 40); }),
      positions("grid_of_largest", "positions are multiples of 2^-32 of the largest coordinate",
                "translation",
                [](A a, double x) { return a.largest > 0 ? rounded(x / a.largest, 32) * a.largest : x; }),
      // Normals.
      normals("float_normals", "normals computed in float, and declared double", "normals",
              [](Vector& n) { each(n, [](double x) { return shortened(x, 24); }); }),
      normals("two_components", "normals kept as two floats: the third by a square root", "rotation",
              [](Vector& n) {
                each(n, [](double x) { return static_cast<double>(static_cast<float>(x)); });
                n[2] = std::copysign(std::sqrt(std::max(0., 1 - n[0] * n[0] - n[1] * n[1])), n[2]);
              }),
      normals("tilted_normals", "normals tilted by 1e-3 rad", "normals-against-positions",
              [](Vector& n) {
                const Vector aside = unit_cross(n, std::abs(n[0]) < .5 ? Vector{1, 0, 0} : Vector{0, 1, 0});
                add(n, aside, 1e-3);
                n = unit(n);
              }),
      vertex("boundary_normals_inside", "normals point inside at boundary vertices of four faces or more",
             "normals",
             [](const At& at) {
               const std::int32_t c = at.control_vertex();
               if (c >= 0 && !at.a.inside(c) && at.a.faces(c) >= 4) negate(at.normal());
             }),
      deliver("hard_edges",
              "normals on the borders of odd faces are those of the flat triangle between its corners",
              "continuity",
              [](A a, D out) {
                const Finder find(out);
                for (std::size_t v = 0; v < out.normals.size(); ++v) {
                  const Place p = out.place(v);
                  if (inside_face(a, p) || !in_odd_face(p)) continue;
                  const auto corner = [&](int k) { return out.positions[find.corner(p.face, k)]; };
                  out.normals[v] =
                      unit_cross(difference(corner(1), corner(0)), difference(corner(2), corner(0)));
                }
              }),
      deliver("phong_normals", "normals within a face interpolated between its corners", "normals",
              [](A, D out) {
                const Delivered before = out;
                const Finder find(before);
                for (std::size_t v = 0; v < out.normals.size(); ++v) {
                  const lc_provenance& p = out.provenance[v];
                  const std::array<std::uint32_t, 3> l{p.denominator - p.i - p.j, p.i, p.j};
                  Vector sum{};
                  for (int k = 0; k < 3; ++k) add(sum, before.normals[find.corner(p.face, k)], l[k]);
                  out.normals[v] = unit(sum);
                }
              }),
      // Relations.
      outwards("gap_1e-9", "odd faces keep their border points 1e-9 of the box away", "continuity",
               [](const At& at) { return !at.inside_face() && in_odd_face(at.p) ? 1e-9 : 0; }),
      outwards("by_face_number", "points inside odd faces are 1e-9 of the box off", "face-order",
               [](const At& at) { return at.inside_face() && in_odd_face(at.p) ? 1e-9 : 0; }),
      remake("by_vertex_number", "odd control vertices are 1e-9 of the box off", "vertex-order",
             [](A a, Mesh m) {
               for (std::size_t v = 1; v < m.positions.size(); v += 2) m.positions[v][0] += 1e-9 * a.diagonal;
             }),
      outwards("by_first_corner", "points inside faces lean towards the first corner", "corner-rotation",
               [](const At& at) {
                 const double n = at.p.denominator;
                 return at.inside_face() ? 1e-9 * (n - at.p.i - at.p.j) / n : 0;
               }),
      vertex("right_half", "points with positive x are 1e-9 of the box off", "mirror",
             [](const At& at) {
               if (at.position()[0] > 0) at.position()[1] += 1e-9 * at.a.diagonal;
             }),
      vertex("along_z", "z is stretched by 1e-9", "rotation",
             [](const At& at) { at.position()[2] *= 1 + 1e-9; }),
      positions("about_origin", "everything is stretched by 1e-9 from the origin", "translation",
                [](A, double x) { return x * (1 + 1e-9); }),
      positions("absolute_offset", "everything is moved by 1e-9 of the unit of length", "scaling",
                [](A, double x) { return x + 1e-9; }),
  };
}
// Only polygons, or meshes of quads, bring these out.
std::vector<Change> faults_of_polygons() {
  const auto in_polygon = [](const At& at) { return at.a.is_polygon(at.face()); };
  const auto of_polygons = [&](const char* name, const char* description, const char* check,
                               std::function<void(const At&)> what) {
    return vertex(name, description, check, [in_polygon, what](const At& at) {
      if (in_polygon(at)) what(at);
    });
  };
  std::vector<Change> all{
      of_polygons("flipped_on_polygons", "normals inside faces that are no quads point inward", "normals",
                  [](const At& at) {
                    if (at.inside_face()) negate(at.normal());
                  }),
      of_polygons("next_corner", "points of the quad at a corner are said to be of the next corner's",
                  "positions",
                  [](const At& at) { at.out.corner[at.v] = at.domain().next(at.out.corner[at.v]); }),
      vertex("u_for_v", "u and v are exchanged", "orientation",
             [](const At& at) { std::swap(at.out.provenance[at.v].i, at.out.provenance[at.v].j); }),
      ask("one_level_more_in_polygons", "faces that are no quads are one level finer than asked for",
          "coverage",
          [](A a, Depths d) {
            for (std::size_t f = 0; f < d.size(); ++f)
              d[f] += a.is_polygon(f) && d[f] >= 0 && a.deepest < 6 ? 1 : 0;
          }),
      deliver("middle_left_out", "faces that are no quads have a hole in the middle", "coverage",
              [](A a, D out) {
                for (std::size_t t = out.triangles.size(); t-- > 0;) {
                  const auto& corners = out.triangles[t];
                  const bool middle = std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
                    const Place p = out.place(v);
                    return a.is_polygon(a.face_of(p)) &&
                           a.domain(a.face_of(p)).is_centre(point_of(p), a.steps(p));
                  });
                  if (middle) out.erase_triangle(t);
                }
              }),
      deliver("corner_is_null", "the corner of no point is delivered", "positions",
              [](A, D out) { out.corner.clear(); }),
      deliver("clockwise_polygons", "triangles of faces that are no quads run clockwise", "orientation",
              [](A a, D out) {
                for (std::size_t t = 0; t < out.triangles.size(); ++t)
                  if (a.is_polygon(static_cast<std::size_t>(out.triangle_face[t])))
                    std::swap(out.triangles[t][1], out.triangles[t][2]);
              }),
      vertex("by_parameter", "points on sides are one ulp off where the parameter along the side is small",
             "corner-rotation",
             [](const At& at) {
               const auto side = at.side();
               if (!side || side->along == 0) return;
               const std::int64_t n = at.steps(), along = side->side >= 2 ? n - side->along : side->along;
               if (2 * along < n) at.out.move_up(at.v);
             }),
      of_polygons("ulp_on_polygons", "points of faces that are no quads are one ulp off", "shared-positions",
                  [](const At& at) { at.out.move_up(at.v); }),
  };
  for (Change& c : all) c.on = On::kQuads;
  return all;
}

}  // namespace limitcheck::verify
