// SPDX-License-Identifier: MIT
// What the report shows in three dimensions: a tessellation with its errors, limit surfaces that an audit's witnesses
// lie on, and what tessellators deliver, point by point against the exact surface.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/cases/triangle_middles.h"
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
#include "verify/evidence/lattice.h"
#include "verify/host/host.h"
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

  std::vector<float> positions, normals, position_error, normal_error;
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
      for (std::size_t x = 0; x < 3; ++x) {
        positions.push_back(static_cast<float>(p[x]));
        normals.push_back(static_cast<float>(n[x]));
      }
    }
    position_error.push_back(static_cast<float>(off));
    normal_error.push_back(static_cast<float>(turned));
  }
  const auto count = static_cast<std::size_t>(t.triangle_count());
  return {{"title", fmt::format("{} on {}, depth {}", session.label(), w.mesh, w.depth)},
          {"positions", base64(positions)},
          {"normals", base64(normals)},
          {"position_error", base64(position_error)},
          {"normal_error", base64(normal_error)},
          {"worst_position", *std::max_element(position_error.begin(), position_error.end())},
          {"worst_normal", *std::max_element(normal_error.begin(), normal_error.end())},
          {"depth", std::vector<int>(count, w.depth)},
          {"kind", std::vector<int>(count, 0)}};
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
  fast::DepthOptions depth;
  depth.strategy = fast::Strategy::kCombined;
  depth.cull = false;
  const auto frame = frame_seen(mesh, depth);

  const double diagonal = data::box_diagonal(mesh);

  std::vector<float> positions, normals, position_error, normal_error;
  std::vector<int> depths, kinds;
  float worst_position = 0, worst_normal = 0;
  each_triangle_error(mesh, frame, [&](const TriangleError& error) {
    for (const std::int32_t v : error.draw->triangle(error.triangle)) {
      const auto& vertex = frame.vertices[error.draw->first + v];
      positions.insert(positions.end(), {vertex.position.x, vertex.position.y, vertex.position.z});
      normals.insert(normals.end(), {vertex.normal.x, vertex.normal.y, vertex.normal.z});
    }
    position_error.push_back(static_cast<float>(error.position / diagonal));
    normal_error.push_back(static_cast<float>(error.normal));
    worst_position = std::max(worst_position, position_error.back());
    worst_normal = std::max(worst_normal, normal_error.back());
    depths.push_back(error.draw->depth);
    kinds.push_back(static_cast<int>(error.draw->kind));
  });
  return {{"positions", base64(positions)},
          {"normals", base64(normals)},
          {"position_error", base64(position_error)},
          {"normal_error", base64(normal_error)},
          {"worst_position", worst_position},
          {"worst_normal", worst_normal},
          {"depth", depths},
          {"kind", kinds}};
}

Json shapes(const std::vector<std::string>& names) {
  constexpr std::size_t kTriangles = 6000;  // enough to look round, few enough for a page of many
  Json list = Json::object();
  for (const std::string& name : names) {
    try {
      const data::ControlMesh mesh = data::open_mesh(name).mesh;
      fast::DepthOptions depth;
      depth.strategy = fast::Strategy::kUniform;
      for (depth.depth = 0; depth.depth < 4 && mesh.faces.size() << 2 * (depth.depth + 1) <= kTriangles;)
        ++depth.depth;
      fast::TessellatorOptions options;
      options.scheme = data::natural_scheme(mesh);
      fast::Tessellator<float> engine(mesh, options);
      fast::IndexedMesh<float> out;
      engine.frame(depth, viewer(0), out);
      std::vector<std::uint32_t> corners;
      for (const auto& t : out.triangles) corners.insert(corners.end(), t.begin(), t.end());
      list[name] = {{"depth", depth.depth},
                    {"positions", base64(coordinates(out))},
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
    wanted = {"opensubdiv-far@bumpy:200@3", "opensubdiv-far@open-crease:3@4", "row-stream@pawn@3"};
  Json list = Json::array();
  for (const std::string& text : wanted) list.push_back(map_of(parse(text)));
  return list;
}

}  // namespace limitcheck::bench
