// SPDX-License-Identifier: MIT
// Faults of what is right in exact numbers: sums in an order that depends on how a face is written, and products that a
// compiler fuses with sums.
#include <algorithm>
#include <array>
#include <map>

#include "reference/catmull_clark/patch.h"
#include "verify/mutants/change_rows.h"
#include "verify/mutants/contracted.h"

namespace limitcheck::verify {

using namespace rows;

namespace {

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

std::vector<Change> faults_of_arithmetic() {
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
  return {spline, contracted};
}

}  // namespace limitcheck::verify
