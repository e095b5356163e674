// SPDX-License-Identifier: MIT
#include <cmath>
#include <utility>

#include "verify/files/checks/file_evidence.h"
#include "verify/host/matching.h"

namespace limitcheck::verify {
namespace {

// The depth at which the refined control mesh has so many triangles, or -1.
int depth_of(const data::ControlMesh& control, data::Scheme scheme, std::size_t triangles) {
  double at_0 = 0, at_1 = 0;  // of faces that are no quads, two for each corner at depth 1
  for (std::size_t f = 0; f < control.faces.size(); ++f) {
    const auto corners = static_cast<double>(control.faces[f].size());
    at_0 += corners - 2;
    at_1 += scheme == data::Scheme::kLoop ? 4 : 2 * corners;
  }
  if (static_cast<double>(triangles) == at_0) return 0;
  for (int depth = 1; depth <= 12; ++depth)
    if (static_cast<double>(triangles) == std::ldexp(at_1, 2 * (depth - 1))) return depth;
  return -1;
}

}  // namespace

std::vector<ProvenanceRow> matched_provenance(const FileEvidence& e) {
  const FileTessellation& t = e.tessellation;
  const int depth = depth_of(e.control, e.scheme(), t.triangles.size());
  if (depth < 0) return {};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(t.triangles.size());
  for (const auto& [a, b, c] : t.triangles)
    triangles.push_back(
        {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
  const Matching found = match(RefinedComplex(e.control, e.scheme(), depth),
                               {std::ssize(t.positions), triangles, [&](std::int64_t v) {
                                  return std::array{t.positions[v][0], t.positions[v][1], t.positions[v][2]};
                                }});
  std::vector<ProvenanceRow> rows;
  std::int64_t near = 0;
  for (std::int64_t v = 0; v < std::ssize(found.provenance); ++v) {
    if (!t.used[v]) continue;
    const lc_provenance& at = found.provenance[v];
    const double n = at.denominator, a = at.i / n, b = at.j / n;
    ProvenanceRow row{v, {at.face, Chart::at(a, b)}, -1};
    if (e.scheme() == data::Scheme::kLoop)
      row.at.l = {1 - a - b, a, b};
    else if (e.control.faces[at.face].size() != 4)
      row.corner = found.corner[v];
    const Vector& p = t.positions[v];
    near += norm(e.surface.at(domain_point(e, row), p).position - p) <= e.tolerance * e.surface.diagonal();
    rows.push_back(row);
  }
  // Of vertices that were moved along the surface, or are those of a refined mesh, most are elsewhere.
  if (2 * near < std::ssize(rows)) rows.clear();
  return rows;
}

}  // namespace limitcheck::verify
