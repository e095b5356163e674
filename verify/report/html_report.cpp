// SPDX-License-Identifier: MIT

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "verify/evidence/evidence.h"
#include "verify/report/forms.h"
#include "verify/row/bounds.h"
#include "verify/row/commands.h"
#include "verify/row/statistics.h"
#include "verify/subject/weights_option.h"

namespace limitcheck::verify {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
std::string base64(const std::vector<T>& list) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto bytes = std::as_bytes(std::span(list));
  std::string out;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const auto byte = [&](std::size_t j) {
      return j < bytes.size() ? std::to_integer<std::uint32_t>(bytes[j]) : 0U;
    };
    const std::uint32_t word = byte(k) << 16 | byte(k + 1) << 8 | byte(k + 2);
    for (std::size_t digit = 0; digit < 4; ++digit)
      out += k + digit <= bytes.size() ? kDigits[(word >> (18 - 6 * digit)) & 63U] : '=';
  }
  return out;
}

Json shape_json(const std::optional<ErrorShape>& shape) {
  if (!shape) return nullptr;
  return {{"positions", base64(shape->positions)},
          {"values", base64(shape->values)},
          {"triangles", base64(shape->triangles)},
          {"witness", shape->witness},
          {"note", shape->note}};
}

// The errors of each subject, over all meshes.
Json errors(const Report& report) {
  Json list = Json::array();
  for (const std::string& subject : report.subjects)
    for (const bool normals : {false, true}) {
      std::vector<std::int64_t> counts(kDecades, 0);
      for (const Result& r : report.results)
        if (r.subject == subject && (r.check == "normals") == normals && r.decades.size() == counts.size())
          std::transform(counts.begin(), counts.end(), r.decades.begin(), counts.begin(), std::plus<>());
      if (*std::max_element(counts.begin(), counts.end()) > 0)
        list.push_back({{"subject", subject}, {"of", normals ? "normals" : "positions"}, {"counts", counts}});
    }
  return list;
}

}  // namespace

std::string to_html(const Report& report, const std::vector<Cause>& causes,
                    const std::vector<std::optional<ErrorShape>>& shapes, const std::string& level) {
  Json data{{"about", header(report) + changes_line(report) + waiver_lines(report) + summary(report)},
            {"legend", legend(report.depths == "plan")},
            {"groups", Json::array()},
            {"subjects", report.subjects},
            {"matrix", Json::array()},
            {"causes", Json::array()},
            {"first", kFirstDecade},
            {"errors", errors(report)}};
  for (const CheckGroup& g : check_groups(report)) data["groups"].push_back(g.title);
  for (const std::string& subject : report.subjects) {
    Json row = Json::array();
    for (const CheckGroup& g : check_groups(report)) row.push_back(verdict_of(report, subject, g).text());
    data["matrix"].push_back(std::move(row));
  }
  for (std::size_t k = 0; k < causes.size(); ++k) {
    const Cause& c = causes[k];
    data["causes"].push_back({{"who", c.who},
                              {"severity", c.severity()},
                              {"title", c.title},
                              {"subjects", c.subjects},
                              {"look", c.look},
                              {"consequences", c.consequences},
                              {"cases", c.cases},
                              {"of", c.of},
                              {"mesh", case_name(report, report.results[c.example])},
                              {"command", command_for(report, c, level)},
                              {"shape", shape_json(k < shapes.size() ? shapes[k] : std::nullopt)}});
  }
  std::string text = data.dump(-1, ' ', true, Json::error_handler_t::replace);
  // Nothing in it ends the script element.
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  std::string page = kHtmlPage;
  constexpr std::string_view kPlace = "%DATA%";
  return page.replace(page.find(kPlace), kPlace.size(), text);
}

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
  const std::vector<std::int32_t> asked = asked_depths(mesh, row.depth);
  Session session(*subject.subject, mesh.mesh, subject.options, Session::Input::kValid, mesh.scheme());
  warm_up(session, mesh, row.depth, threads);
  const Tessellation t = session.tessellate(asked, threads);
  const lc_capabilities& c = session.capabilities();
  session.close();
  if (t.vertex_count() == 0) return std::nullopt;
  ReferenceSurface truth(session.mesh(), mesh.scheme(), row.depth, c.points, family(c.weights));
  const Evidence e = gather(subject, mesh, session, session.mesh(), asked, t, truth);

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
    for (const std::uint32_t v : t.triangles()[k]) wanted.push_back(e.point[v]);
  truth.prepare(wanted);
  const bool normals = row.unit == "degrees" || row.check == "finite";
  const double bound = normals ? normal_bound(c.precision, truth.steps()) : e.position_bound();
  const auto error = [&](std::uint32_t v) {
    const Lattice::Id point = e.point[v];
    if (point == Lattice::kNone) return 0.0;
    if (!normals) return norm(t.position(v) - truth.position(point)) / e.diagonal;
    if (!t.has_normals()) return 0.0;
    if (!is_finite(t.normal(v))) return std::numeric_limits<double>::quiet_NaN();
    const Sides::Id side = truth.sides().of(point, t.place(v).face);
    return truth.has_normal(side) ? angle_degrees(t.normal(v), truth.normal(side)) : 0.0;
  };
  for (const auto& [distance, k] : order)
    for (const std::uint32_t v : t.triangles()[k]) {
      const auto [at, is_new] = number.emplace(v, static_cast<std::uint32_t>(shape.values.size()));
      shape.triangles.push_back(at->second);
      if (!is_new) continue;
      for (const double x : t.position(v)) shape.positions.push_back(static_cast<float>(x));
      shape.values.push_back(value_of(error(v), normals ? bound : e.position_bound_at(e.point[v])));
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
