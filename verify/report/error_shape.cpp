// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "data/bounding_box.h"
#include "verify/evidence/evidence.h"
#include "verify/report/html_report.h"
#include "verify/row/bounds.h"
#include "verify/subject/weights_option.h"

namespace limitcheck::verify {
namespace {

// 0 within the bound, else how many powers of ten beyond it, from 1 on; 255 not finite.
std::uint8_t value_of(double error, double bound) {
  if (!std::isfinite(error)) return 255;
  if (error <= bound) return 0;
  return static_cast<std::uint8_t>(std::clamp(1 + std::log10(error / bound), 1.0, 20.0));
}

}  // namespace

std::optional<ErrorShape> error_shape(const AuditSubject& subject, const AuditMesh& mesh, const Result& row,
                                      int threads) try {
  if (!row.witness || row.witness->face < 0) return std::nullopt;
  std::vector<std::int32_t> asked = mesh.face_depth;
  if (asked.empty()) asked.assign(mesh.mesh.faces.size(), row.depth);
  for (const std::int32_t f : mesh.mesh.holes) asked[f] = -1;
  if (mesh.sample) asked = mesh.sample->cull(std::move(asked));
  Session session(*subject.subject, mesh.mesh, subject.options, Session::Input::kValid, mesh.scheme());
  const Tessellation t = session.tessellate(asked, threads);
  const lc_capabilities& c = session.capabilities();
  session.close();
  if (t.vertex_count() == 0) return std::nullopt;

  ReferenceSurface truth(session.mesh(), mesh.scheme(), row.depth, c.points, family(c.weights));
  const std::vector<Lattice::Id> points = locate(t, truth.lattice());

  // The triangles nearest to the witness; without a vertex of its own, to the first of its face.
  std::int64_t centre = row.witness->vertex;
  for (std::int64_t v = 0; centre < 0 && v < t.vertex_count(); ++v)
    if (t.provenance_ok(v) && t.place(v).face == row.witness->face) centre = v;
  if (centre < 0 || centre >= t.vertex_count()) return std::nullopt;
  const Vector middle = t.position(centre);
  std::vector<std::pair<double, std::int64_t>> order;
  for (std::int64_t k = 0; k < t.triangle_count(); ++k) {
    if (!t.triangle_ok(k)) continue;
    const Vector p = t.position(t.triangles()[k][0]);
    if (is_finite(p)) order.emplace_back(is_finite(middle) ? norm(p - middle) : 0, k);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), kMostTriangles));

  ErrorShape shape;
  std::map<std::uint32_t, std::uint32_t> number;
  std::vector<Lattice::Id> wanted;
  for (const auto& [distance, k] : order)
    for (const std::uint32_t v : t.triangles()[k]) wanted.push_back(points[v]);
  truth.prepare(wanted);
  double magnitude = 0;
  for (const Vector& p : session.mesh().positions) magnitude = std::max(magnitude, largest(p));
  const double diagonal = unit_of_length(data::box_diagonal(session.mesh()), magnitude);
  const bool normals = row.unit == "degrees" || row.check == "finite";
  const double bound = normals ? normal_bound(c.precision, truth.steps())
                               : position_bound(c.precision, truth.steps(), magnitude, diagonal);
  const auto error = [&](std::uint32_t v) {
    if (points[v] == Lattice::kNone) return 0.0;
    if (!normals) return norm(t.position(v) - truth.position(points[v])) / diagonal;
    if (!t.has_normals()) return 0.0;
    if (!is_finite(t.normal(v))) return std::numeric_limits<double>::quiet_NaN();
    const Sides::Id side = truth.sides().of(points[v], t.place(v).face);
    return truth.has_normal(side) ? angle_degrees(t.normal(v), truth.normal(side)) : 0.0;
  };
  for (const auto& [distance, k] : order)
    for (const std::uint32_t v : t.triangles()[k]) {
      const auto [at, is_new] = number.emplace(v, static_cast<std::uint32_t>(shape.values.size()));
      shape.triangles.push_back(at->second);
      if (!is_new) continue;
      for (const double x : t.position(v)) shape.positions.push_back(static_cast<float>(x));
      shape.values.push_back(value_of(error(v), bound));
    }
  for (std::size_t axis = 0; axis < 3; ++axis) shape.witness[axis] = static_cast<float>(middle[axis]);
  shape.note = fmt::format("Colours are of {}, whose bound is {:.1e}{}", normals ? "normals" : "positions",
                           bound, normals ? " degrees" : " diagonals");
  if (order.size() == kMostTriangles)
    shape.note += fmt::format("; the {} triangles at the witness", kMostTriangles);
  return shape;
} catch (const std::exception&) {
  return std::nullopt;  // the report has a row that says so
}

}  // namespace limitcheck::verify
