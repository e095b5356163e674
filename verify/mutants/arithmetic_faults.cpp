// SPDX-License-Identifier: MIT
// Faults of what is right in exact numbers: sums in an order that depends on how a face is written, and products that a
// compiler fuses with sums.
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "verify/mutants/change_rows.h"
#include "verify/mutants/contracted.h"

namespace limitcheck::verify {

using namespace rows;

namespace {

// A closed mesh of quads, each vertex of four: the surface is a bicubic B-spline everywhere.
bool is_regular(A a) {
  for (std::size_t f = 0; f < a.mesh.faces.size(); ++f)
    if (a.is_polygon(f)) return false;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(a.mesh.positions.size()); ++v)
    if (!a.inside(v) || a.faces(v) != 4) return false;
  return a.mesh.sharpness.empty();
}

using Patch =
    std::array<std::array<std::int32_t, 4>, 4>;  // control points by u, v; the face is in the middle

// As a shader for regular patches reads them: from the corner at which the face begins.
Patch patch_of(const data::Faces& faces,
               const std::map<std::pair<std::int32_t, std::int32_t>, std::size_t>& side, std::size_t f) {
  // A side's place among all corners, and the corner `more` farther on in its face.
  const auto corner = [&](std::size_t at, std::size_t more) {
    return faces.corners()[at / 4 * 4 + (at + more) % 4];
  };
  Patch patch;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto put = [&](std::size_t i, std::size_t j, std::int32_t vertex) {
      for (std::size_t turn = 0; turn < k; ++turn) i = std::exchange(j, i), i = 3 - i;
      patch[i][j] = vertex;
    };
    const std::int32_t a = corner(4 * f + k, 0), b = corner(4 * f + k, 1);
    const std::size_t beyond = side.at({b, a});
    const std::int32_t behind_a = corner(beyond, 2), behind_b = corner(beyond, 3);
    put(1, 1, a);
    put(1, 0, behind_a);
    put(2, 0, behind_b);
    put(0, 0, corner(side.at({behind_a, a}), 3));
  }
  return patch;
}

std::array<double, 4> cubic(double t) {
  const double s = 1 - t;
  return {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
          t * t * t / 6};
}

void in_own_frame(A a, D out) {
  if (!is_regular(a)) return;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> side;
  for (std::size_t f = 0; f < a.mesh.faces.size(); ++f)
    for (std::size_t k = 0; k < 4; ++k) side[{a.mesh.faces[f][k], a.mesh.faces[f][(k + 1) % 4]}] = 4 * f + k;
  for (std::size_t v = 0; v < out.positions.size(); ++v) {
    const Place at = out.place(v);
    const Patch patch = patch_of(a.mesh.faces, side, a.face_of(at));
    const auto u = cubic(static_cast<double>(at.i) / at.denominator),
               w = cubic(static_cast<double>(at.j) / at.denominator);
    out.positions[v] = {};
    for (std::size_t i = 0; i < 4; ++i) {
      Vector row{};
      for (std::size_t j = 0; j < 4; ++j) add(row, a.mesh.positions[patch[i][j]], w[j]);
      add(out.positions[v], row, u[i]);
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
