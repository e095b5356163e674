// SPDX-License-Identifier: MIT
// The report as a page: overview, causes, histograms, and triangles round the witnesses.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <utility>

#include "verify/evidence/evidence.h"
#include "verify/report/forms.h"
#include "verify/report/json.h"
#include "verify/row/bounds.h"
#include "verify/row/commands.h"
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
  return {{"control", base64(shape->control)}, {"positions", base64(shape->positions)},
          {"values", base64(shape->values)},   {"triangles", base64(shape->triangles)},
          {"witness", shape->witness},         {"note", shape->note}};
}

// The errors of each subject, over all meshes.
Json errors(const Report& report) {
  Json list = Json::array();
  for (const std::string& subject : report.subjects)
    for (const bool normals : {false, true}) {
      std::vector<std::int64_t> counts(kDecades, 0);
      double bound = 0;
      for (const Result& r : report.results) {
        if (r.subject != subject || (r.unit == "degrees") != normals || r.decades.size() != counts.size())
          continue;
        std::ranges::transform(counts, r.decades, counts.begin(), std::plus<>());
        bound = std::max(bound, r.bound.value_or(0));
      }
      if (*std::ranges::max_element(counts) > 0)
        list.push_back({{"subject", subject},
                        {"of", normals ? "normals" : "positions"},
                        {"bound", bound > 0 ? Json(bound) : Json(nullptr)},
                        {"counts", counts}});
    }
  return list;
}

// Overview and causes for who runs no script.
std::string plain(const Json& data) {
  const auto row = [](const char* cell, const std::string& first, const Json& rest) {
    std::string out = fmt::format("<tr><{0}>{1}</{0}>", cell, xml_text(first));
    for (const Json& text : rest)
      out += fmt::format("<{0}>{1}</{0}>", cell, xml_text(text.get<std::string>()));
    return out + "</tr>\n";
  };
  std::string out = fmt::format("<p>{}</p>\n<table>\n", xml_text(data["about"].get<std::string>()));
  out += row("th", "subject", data["groups"]);
  for (std::size_t k = 0; k < data["subjects"].size(); ++k)
    out += row("td", data["subjects"][k].get<std::string>(), data["matrix"][k]);
  out += fmt::format("</table>\n<p>{}</p>\n<ol>\n", xml_text(data["legend"].get<std::string>()));
  for (const Json& c : data["causes"])
    out += fmt::format("<li>{}, {}: {} <code>{}</code></li>\n", xml_text(c["severity"].get<std::string>()),
                       xml_text(c["who"].get<std::string>()), xml_text(c["title"].get<std::string>()),
                       xml_text(c["command"].get<std::string>()));
  return out + "</ol>";
}

void put(std::string& page, std::string_view place, const std::string& text) {
  page.replace(page.find(place), place.size(), text);
}

}  // namespace

std::string to_html(const Report& report, const std::vector<Cause>& causes,
                    const std::vector<std::optional<ErrorShape>>& shapes, const std::string& level) {
  Json data{{"about", header(report) + changes_line(report) + waiver_lines(report) + summary(report)},
            {"legend", legend(report)},
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
    Json c = cause_json(report, causes[k], static_cast<int>(k) + 1, level);
    c["mesh"] = case_name(report, report.results[causes[k].example]);
    c["shape"] = shape_json(k < shapes.size() ? shapes[k] : std::nullopt);
    data["causes"].push_back(std::move(c));
  }
  std::string text = data.dump(-1, ' ', true, Json::error_handler_t::replace);
  // Nothing in it ends the script element.
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  std::string page = kHtmlPage;
  // In this order: names of subjects may be anything, and what is put in first lies behind the other place.
  put(page, "%DATA%", text);
  put(page, "%PLAIN%", plain(data));
  return page;
}

// What the page shows in three dimensions: the triangles round a witness, coloured by their errors, where they lie on
// the control mesh.

namespace {

// 0 within the bound, else how many powers of ten beyond it, from 1 on; 255 not finite.
std::uint8_t value_of(double error, double bound) {
  if (!std::isfinite(error)) return 255;
  if (error <= bound) return 0;
  return static_cast<std::uint8_t>(std::clamp(1 + std::log10(error / bound), 1.0, 20.0));
}

void append(std::vector<float>& to, const Vector& p) {
  for (const double x : p) to.push_back(static_cast<float>(x));
}

/// Both ends of each edge of the control mesh; nothing where so many would hide what they are to show.
std::vector<float> edges_of(const data::ControlMesh& mesh) {
  constexpr std::size_t kMost = 8000;
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (std::size_t f = 0; f < mesh.faces.size() && edges.size() <= kMost; ++f) {
    const auto face = mesh.faces[f];
    for (std::size_t k = 0; k < face.size(); ++k)
      edges.insert(std::minmax(face[k], face[(k + 1) % face.size()]));
  }
  std::vector<float> ends;
  if (edges.size() > kMost) return ends;
  for (const auto& [a, b] : edges) append(ends, mesh.positions[a]), append(ends, mesh.positions[b]);
  return ends;
}

/// A tessellation, and where its witness is.
struct Shown {
  std::vector<Vector> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // of which all may be looked at
  Vector middle;

  // Keeps the triangles nearest to the middle, at most kMostTriangles.
  void keep_nearest() {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < triangles.size(); ++k)
      if (const Vector& p = positions[triangles[k][0]]; is_finite(p))
        order.emplace_back(is_finite(middle) ? norm(p - middle) : 0, k);
    std::ranges::sort(order);
    order.resize(std::min(order.size(), kMostTriangles));
    std::vector<std::array<std::uint32_t, 3>> kept;
    for (const auto& [distance, k] : order) kept.push_back(triangles[k]);
    triangles = std::move(kept);
  }
  // In the colours of normals or positions, with their bound.
  ErrorShape shape(const data::ControlMesh& control, bool normals, double bound,
                   const std::function<std::uint8_t(std::uint32_t)>& value) const {
    ErrorShape shape;
    shape.control = edges_of(control);
    std::map<std::uint32_t, std::uint32_t> number;
    for (const auto& corners : triangles)
      for (const std::uint32_t v : corners) {
        const auto [at, is_new] = number.emplace(v, static_cast<std::uint32_t>(shape.values.size()));
        shape.triangles.push_back(at->second);
        if (!is_new) continue;
        append(shape.positions, positions[v]);
        shape.values.push_back(value(v));
      }
    for (std::size_t axis = 0; axis < 3; ++axis) shape.witness[axis] = static_cast<float>(middle[axis]);
    shape.note = fmt::format("Colours are of {}, whose bound is {:.1e}{}", normals ? "normals" : "positions",
                             bound, normals ? " degrees" : " diagonals");
    if (triangles.size() == kMostTriangles)
      shape.note += fmt::format("; the {} triangles at the witness", kMostTriangles);
    return shape;
  }
};

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
  ReferenceSurface truth(session.mesh(), mesh.scheme(), row.depth, c.points, family(c.weights),
                         points_anywhere(c, t));
  const Evidence e = gather(subject, mesh, session, session.mesh(), asked, t, truth);

  // The triangles nearest to the witness; without a vertex of its own, to the first of its face.
  std::int64_t centre = row.witness->vertex;
  for (std::int64_t v = 0; centre < 0 && v < t.vertex_count(); ++v)
    if (t.provenance_ok(v) && t.place(v).face == row.witness->face) centre = v;
  if (centre < 0 || centre >= t.vertex_count()) return std::nullopt;
  Shown shown{{}, {}, t.position(centre)};
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) shown.positions.push_back(t.position(v));
  for (std::int64_t k = 0; k < t.triangle_count(); ++k)
    if (t.triangle_ok(k)) shown.triangles.push_back(t.triangles()[k]);
  shown.keep_nearest();
  std::vector<Lattice::Id> wanted;
  for (const auto& corners : shown.triangles)
    for (const std::uint32_t v : corners) wanted.push_back(e.point[v]);
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
  return shown.shape(mesh.mesh, normals, bound, [&](std::uint32_t v) {
    return value_of(error(v), normals ? bound : e.position_bound_at(e.point[v]));
  });
} catch (const std::exception&) {
  return std::nullopt;  // the report has a row that says so
}

std::optional<ErrorShape> error_shape(const VertexErrors& file, const data::ControlMesh& control,
                                      const Result& row) {
  if (!row.witness || row.witness->vertex < 0 || file.positions.empty()) return std::nullopt;
  Shown shown{file.positions, {}, file.positions[static_cast<std::size_t>(row.witness->vertex)]};
  for (const auto& [a, b, c] : file.triangles)
    shown.triangles.push_back(
        {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
  shown.keep_nearest();
  const bool normals = row.unit == "degrees";
  const double bound = normals ? file.angle_bound : file.distance_bound;
  return shown.shape(control, normals, bound, [&](std::uint32_t v) {
    return is_finite(file.positions[v]) ? value_of(normals ? file.angle[v] : file.distance[v], bound)
                                        : std::uint8_t{255};
  });
}

}  // namespace limitcheck::verify
