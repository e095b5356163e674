// SPDX-License-Identifier: MIT
// What the report shows in three dimensions: a tessellation with its errors, limit surfaces that an audit's witnesses
// lie on, and what tessellators deliver, point by point against the exact surface.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "bench/cases/matched.h"
#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "data/bounding_box.h"
#include "data/error.h"
#include "data/generators/bumpy_sphere.h"
#include "data/generators/named_mesh.h"
#include "data/scheme.h"
#include "fast/mesh/vec3.h"
#include "fast/window/tessellator.h"
#include "verify/evidence/evidence.h"
#include "verify/host/host.h"
#include "verify/subject/lattice.h"
#include "verify/subject/registry.h"

namespace limitcheck::bench {

using Json = nlohmann::ordered_json;

namespace {

/// Numbers in the byte order of every machine that draws them, as base 64.
template <class Number>
std::string base64(const std::vector<Number>& numbers) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes(sizeof(Number) * numbers.size(), '\0'), text;
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    unsigned group = 0;
    for (std::size_t b = k; b < k + 3; ++b)
      group = group << 8 | (b < bytes.size() ? static_cast<unsigned char>(bytes[b]) : 0u);
    for (int digit = 3; digit >= 0; --digit)
      text += k + static_cast<std::size_t>(3 - digit) > bytes.size() ? '=' : kDigits[group >> 6 * digit & 63];
  }
  return text;
}

/// Positions as 16-bit steps from a corner of their box, in few bytes; what is not finite lies in that corner.
Json packed(const std::vector<verify::Vector>& positions) {
  verify::Vector low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const auto& p : positions)
    for (std::size_t c = 0; c < 3; ++c)
      if (std::isfinite(p[c])) low[c] = std::min(low[c], p[c]), high[c] = std::max(high[c], p[c]);
  const double step = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], 1e-300}) / 65535;
  std::vector<std::int16_t> steps;
  for (const auto& p : positions)
    for (std::size_t c = 0; c < 3; ++c)
      steps.push_back(static_cast<std::int16_t>(
          std::isfinite(p[c]) ? std::lround((p[c] - low[c]) / step) - 32768 : -32768));
  return {{"low", low}, {"step", step}, {"steps", base64(steps)}};
}

/// What the view shows of some triangles: packed corners, normals as signed bytes, errors as bytes from 10^-4 of the worst
/// (0) to it (255) by their logarithms, depths and kinds.
class Triangles {
 public:
  void corner(const verify::Vector& position, const verify::Vector& normal) {
    positions_.push_back(position);
    for (const double x : normal)
      normals_.push_back(
          static_cast<std::int8_t>(std::isfinite(x) ? std::lround(127 * std::clamp(x, -1., 1.)) : 0));
  }
  /// The triangle of the last three corners.
  ///   position   in diagonals; normal in degrees
  void triangle(double position, double normal, int depth, int kind) {
    position_error_.push_back(position), normal_error_.push_back(normal);
    depth_.push_back(static_cast<std::uint8_t>(depth)), kind_.push_back(static_cast<std::uint8_t>(kind));
  }
  Json json() const {
    Json out{{"positions", packed(positions_)},
             {"normals", base64(normals_)},
             {"depth", base64(depth_)},
             {"kind", base64(kind_)}};
    add(out, "position", position_error_), add(out, "normal", normal_error_);
    return out;
  }

 private:
  static void add(Json& out, const std::string& name, const std::vector<double>& errors) {
    const auto worst = std::max_element(errors.begin(), errors.end());
    std::vector<std::uint8_t> bytes;
    for (const double e : errors)
      bytes.push_back(static_cast<std::uint8_t>(std::lround(
          255 * std::clamp(1 + std::log10(std::max(e, 1e-30) / std::max(*worst, 1e-20)) / 4, 0., 1.))));
    out[name + "_error"] = base64(bytes);
    out["worst_" + name] = *worst;
    out["worst_" + name + "_at"] = worst - errors.begin();
  }

  std::vector<verify::Vector> positions_;
  std::vector<std::int8_t> normals_;
  std::vector<double> position_error_, normal_error_;
  std::vector<std::uint8_t> depth_, kind_;
};

using verify::cross, verify::dot, verify::norm, verify::Vector, verify::operator-;

struct Wanted {
  std::string subject, options, mesh;
  int depth = 3;
};

// SUBJECT[:OPTIONS]@MESH[@DEPTH]
Wanted parse(const std::string& text) {
  const auto first = text.find('@'), second = text.find('@', std::min(first, text.size() - 1) + 1);
  if (first == std::string::npos || first == 0)
    throw data::ArgumentError("--map: SUBJECT@MESH[@DEPTH], not " + text);
  Wanted w;
  const std::string subject = text.substr(0, first);
  w.subject = subject.substr(0, subject.find(':'));
  if (subject.size() > w.subject.size()) w.options = subject.substr(w.subject.size() + 1);
  w.mesh = text.substr(first + 1, second == std::string::npos ? second : second - first - 1);
  if (second != std::string::npos) w.depth = std::stoi(text.substr(second + 1));
  return w;
}

Json map_of(const Wanted& w) {
  const lc_subject* subject = verify::find_subject(w.subject);
  if (subject == nullptr) throw data::ArgumentError("there is no subject " + w.subject);
  verify::Session session(*subject, data::open_mesh(w.mesh).mesh, w.options);
  const verify::Tessellation t = session.tessellate(w.depth);
  verify::ReferenceSurface exact(session.mesh(), w.depth, session.capabilities().points);
  const auto points = verify::locate(t, exact.lattice());
  exact.prepare(points);
  const double diagonal = data::box_diagonal(session.mesh());
  const bool has_normals = session.capabilities().normals == 1;

  Triangles triangles;
  for (std::int64_t k = 0; k < t.triangle_count(); ++k) {
    double off = 0, turned = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto v = static_cast<std::int64_t>(t.triangles()[k][c]);
      const Vector p = t.position(v);
      const bool known = points[v] != verify::Lattice::kNone;
      const Vector n =
          known ? exact.normal(exact.sides().of(points[v], t.triangle_face()[k])) : Vector{0, 0, 1};
      if (known) off = std::max(off, norm(p - exact.position(points[v])) / diagonal);
      if (known && has_normals) {
        const Vector got = t.normal(v);
        turned = std::max(turned, std::atan2(norm(cross(got, n)), dot(got, n)) * 180 / std::numbers::pi);
      }
      triangles.corner(p, n);
    }
    triangles.triangle(off, turned, w.depth, 0);
  }
  if (t.triangle_count() == 0) throw data::ArgumentError(w.subject + " delivers no triangles on " + w.mesh);
  Json out = triangles.json();
  out["title"] = fmt::format("{} on {}, depth {}", session.label(), w.mesh, w.depth);
  return out;
}

}  // namespace

void each_triangle_error(const data::ControlMesh& mesh, const fast::DrawList<float>& frame,
                         const std::function<void(const TriangleError&)>& with) {
  each_triangle_middle(
      mesh, data::Scheme::kLoop, frame, reference::Derivatives::kSecond, [&](const TriangleMiddle& middle) {
        const auto &p = middle.exact.position, &m = middle.exact.normal;
        const fast::Point3 n{m.x, m.y, m.z};
        const double angle = std::atan2(length(cross(n, middle.normal)), dot(n, middle.normal));
        with({middle.draw, middle.triangle, length(middle.position - fast::Point3{p.x, p.y, p.z}),
              angle * 180 / std::numbers::pi});
      });
}

Json model() {
  const auto mesh = data::bumpy_sphere(200, kSphereSeed);
  const auto frame = frame_seen(mesh, {.strategy = fast::Strategy::kCombined, .cull = false});
  const double diagonal = data::box_diagonal(mesh);
  Triangles triangles;
  each_triangle_error(mesh, frame, [&](const TriangleError& error) {
    for (const std::int32_t v : error.draw->triangle(error.triangle)) {
      const auto& [p, n] = frame.vertices[error.draw->first + v];
      triangles.corner({p.x, p.y, p.z}, {n.x, n.y, n.z});
    }
    triangles.triangle(error.position / diagonal, error.normal, error.draw->depth,
                       static_cast<int>(error.draw->kind));
  });
  return triangles.json();
}

Json shapes(const std::vector<std::string>& names) {
  constexpr std::size_t kTriangles = 3000;  // enough to look round, few enough for a page of many
  Json list = Json::object();
  for (const std::string& name : names) {
    try {
      const data::ControlMesh mesh = data::open_mesh(name).mesh;
      int depth = 0;
      while (depth < 4 && mesh.faces.size() << 2 * (depth + 1) <= kTriangles) ++depth;
      fast::IndexedMesh<float> out;
      fast::Tessellator<float>(mesh, {.scheme = data::natural_scheme(mesh)})
          .frame(verify::uniform(depth), viewer(0), out);
      if (out.vertices.size() > 65535) throw data::ArgumentError("it has too many vertices for the view");
      std::vector<verify::Vector> positions;
      for (const auto& [p, n] : out.vertices) positions.push_back({p.x, p.y, p.z});
      std::vector<std::uint16_t> corners;
      for (const auto& t : out.triangles)
        for (const std::uint32_t v : t) corners.push_back(static_cast<std::uint16_t>(v));
      list[name] = {{"depth", depth},
                    {"positions", packed(positions)},
                    {"triangles", base64(corners)},
                    {"face", base64(out.triangle_face)}};
    } catch (const std::exception& error) {
      list[name] = {{"error", error.what()}};
    }
  }
  return list;
}

Json maps(std::vector<std::string> wanted) {
  // A library on triangles, and one on a mesh of quads with a crease, each at its default precision.
  if (wanted.empty())
    wanted = {"opensubdiv-far@bumpy:200@3", "opensubdiv-far@open-crease:3@3", "row-stream@pawn@3"};
  Json list = Json::array();
  for (const std::string& text : wanted) list.push_back(map_of(parse(text)));
  return list;
}

}  // namespace limitcheck::bench
