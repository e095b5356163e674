// SPDX-License-Identifier: MIT
// What a tessellator delivers for a mesh, point by point against the exact surface: for the report's view in
// three dimensions.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bench/reproduction/base64.h"
#include "bench/reproduction/reproduction.h"
#include "data/bounding_box.h"
#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "verify/evidence/evidence.h"
#include "verify/host/host.h"
#include "verify/subject/registry.h"

namespace limitcheck::bench {
namespace {

using verify::cross;
using verify::dot;
using verify::norm;
using verify::Vector;
using verify::operator-;

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

nlohmann::ordered_json map_of(const Wanted& w) {
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

nlohmann::ordered_json maps(std::vector<std::string> wanted) {
  // A library on triangles, and one on a mesh of quads with a crease, each at its default precision.
  if (wanted.empty())
    wanted = {"opensubdiv-far@bumpy:200@3", "opensubdiv-far@open-crease:3@4", "row-stream@pawn@3"};
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const std::string& text : wanted) list.push_back(map_of(parse(text)));
  return list;
}

}  // namespace limitcheck::bench
