// SPDX-License-Identifier: MIT
#include "verify/relations/relations.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "data/error.h"
#include "data/shapes.h"
#include "data/triangulate.h"
#include "data/validate.h"
#include "verify/evidence/vector.h"
#include "verify/host/host.h"
#include "verify/relations/relation_row.h"

namespace limitcheck::verify {

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

BrokenMesh with_edge(const char* what, std::int32_t a, std::int32_t b, float sharpness) {
  BrokenMesh broken{what, data::octahedron(), LC_SHARP_CREASES};
  broken.mesh.sharpness.edges.push_back({a, b, sharpness});
  return broken;
}

BrokenMesh with_vertex(const char* what, std::int32_t v, float sharpness) {
  BrokenMesh broken{what, data::octahedron(), LC_SHARP_CORNERS};
  broken.mesh.sharpness.vertices.push_back({v, sharpness});
  return broken;
}

}  // namespace

const std::vector<BrokenMesh>& broken_meshes() {
  static const std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                          {1, 1, 1}, {2, 0, 1}, {0, 2, 1}};
  static const std::vector<Vector> not_a_number = [] {
    std::vector<Vector> changed = points;
    changed[1][2] = std::numeric_limits<double>::quiet_NaN();
    return changed;
  }();
  static const std::vector<BrokenMesh> meshes{
      {"an edge with three faces", {points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {4, 5, 6}}}},
      {"two faces of opposite orientation", {points, {{0, 1, 2}, {0, 1, 3}, {4, 5, 6}}}},
      {"two fans that meet in a vertex", {points, {{0, 1, 2}, {0, 3, 4}, {4, 5, 6}}}},
      {"no faces", {points, {}}},
      {"faces and no vertices", {{}, {{0, 1, 2}}}},
      {"a vertex that does not exist", {points, {{0, 1, 2}, {2, 1, 1'000'000'000}, {4, 5, 6}}}},
      {"a coordinate that is no number", {not_a_number, {{0, 1, 2}, {2, 1, 3}, {4, 5, 6}}}},
      with_edge("a sharp edge that no face has", 0, 1, 10),  // opposite vertices
      with_edge("a sharp edge of a vertex that does not exist", 0, 1'000'000'000, 10),
      with_edge("an edge of a sharpness that is no number", 0, 2, kNan),
      with_edge("an edge of a sharpness below 0", 0, 2, -1),
      with_vertex("a sharp vertex that does not exist", 1'000'000'000, 10),
      with_vertex("a vertex of a sharpness that is no number", 0, kNan),
      with_vertex("a vertex of a sharpness below 0", 0, -1),
  };
  return meshes;
}

std::vector<Refusal> ask_for_refusals(const AuditSubject& subject, data::Scheme scheme, int threads,
                                      std::int32_t sharp) {
  std::vector<Refusal> refusals;
  for (const BrokenMesh& broken : broken_meshes())
    refusals.push_back((broken.sharp & ~sharp) != 0 ? Refusal{.asked = false}
                                                    : ask_for_refusal(subject, broken.mesh, scheme, threads));
  return refusals;
}

Refusal ask_for_refusal(const AuditSubject& subject, const data::ControlMesh& mesh, data::Scheme scheme,
                        int threads) {
  try {
    Session session(*subject.subject, mesh, subject.options, Session::Input::kAsItIs, scheme);
    const Tessellation t = session.tessellate(std::min(1, session.capabilities().max_depth), threads);
    session.close();
    if (mesh.faces.empty() && t.triangle_count() == 0) return {};  // nothing of nothing
    return {true, Status::kFinding, "accepted"};
  } catch (const SubjectDied& error) {
    const auto [status, origin] = breakdown_of(error);
    return {true, status, error.what(), origin};
  } catch (const NotAsked& why) {
    return {true, Status::kNotSupported, fmt::format("not asked: {}", why.what())};
  } catch (const SubjectError&) {
    return {};
  } catch (const std::exception& error) {
    return {true, Status::kError, error.what(), Origin::kSubject};
  }
}

data::io::Examination read_broken_mesh(const std::string& file, const data::ReadOptions& options) {
  const data::io::PolygonSoup soup = data::io::read_soup(file);
  data::io::Examination result;
  data::ControlMesh& mesh = result.mesh;
  mesh.positions = soup.positions;
  std::vector<std::int32_t> face;
  std::size_t begin = 0;
  for (const std::size_t end : soup.polygon_end) {
    face.clear();
    for (std::size_t k = begin; k < end; ++k) {
      if (!std::in_range<std::int32_t>(soup.corners[k]))
        throw data::InputError(
            "MESH_INDEX_OUT_OF_RANGE", file, 0,
            fmt::format("a face names vertex {}: 32 bits do not name it", soup.corners[k]));
      face.push_back(static_cast<std::int32_t>(soup.corners[k]));
    }
    if (face.size() > 2) mesh.faces.push_back(face);
    begin = end;
  }
  data::Triangulated triangles = data::triangulate(mesh, options.polygons);
  mesh.faces = std::move(triangles.faces);
  result.cut = triangles.cut;
  mesh.sharpness = data::io::sharpness_of(soup);
  result.scheme = options.scheme.value_or(data::natural_scheme(mesh));
  if (data::validate(mesh, result.scheme).empty())
    throw data::ArgumentError(
        fmt::format("--must-refuse: nothing is wrong with {}, so no subject must refuse it", file));
  return result;
}

std::vector<Result> must_refuse(const std::vector<AuditSubject>& subjects,
                                const std::vector<AuditMesh>& meshes, int threads) {
  std::vector<Result> results;
  for (const AuditSubject& s : subjects)
    for (const AuditMesh& m : meshes) {
      Refusal refusal = ask_for_refusal(s, m.mesh, m.scheme(), threads);
      Result r{.subject = s.label(),
               .mesh = m.name,
               .check = "rejected-inputs",
               .scheme = m.scheme(),
               .triangulated = m.triangulated,
               .status = refusal.status,
               .of = 1,
               .bound = 0,
               .unit = "meshes",
               .message = std::move(refusal.message),
               .origin = refusal.origin};
      r.bad = is_bad(r);
      if (r.status == Status::kFinding) r.accepted.emplace_back("accepted");
      results.push_back(std::move(r));
    }
  return results;
}

}  // namespace limitcheck::verify
