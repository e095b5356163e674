// SPDX-License-Identifier: MIT
#include "data/known_answers.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "data/error.h"

namespace limitcheck::data {
namespace {

using Json = nlohmann::json;

InteriorRingAnswer interior_ring(const Json& json) {
  const Json& expected = json.at("expected");
  InteriorRingAnswer answer;
  json.at("id").get_to(answer.id);
  json.at("valence").get_to(answer.valence);
  json.at("center").get_to(answer.center);
  json.at("ring_ccw").get_to(answer.ring);
  expected.at("limit_position").get_to(answer.limit_position);
  expected.at("C").get_to(answer.c);
  expected.at("S").get_to(answer.s);
  expected.at("paper_u1").get_to(answer.paper_u1);
  expected.at("paper_u2").get_to(answer.paper_u2);
  expected.at("unit_normal").get_to(answer.unit_normal);
  return answer;
}

BoundaryRingAnswer boundary_ring(const Json& json) {
  const Json& expected = json.at("expected");
  BoundaryRingAnswer answer;
  json.at("id").get_to(answer.id);
  json.at("triangles").get_to(answer.faces);
  json.at("center").get_to(answer.center);
  json.at("ring_ccw").get_to(answer.ring);
  expected.at("limit_position").get_to(answer.limit_position);
  expected.at("along").get_to(answer.along);
  expected.at("across").get_to(answer.across);
  expected.at("unit_normal").get_to(answer.unit_normal);
  return answer;
}

SurfaceAnswer surface(const Json& json, bool at_boundary) {
  SurfaceAnswer answer;
  answer.at_boundary = at_boundary;
  json.at("id").get_to(answer.id);
  json.at("vertices").get_to(answer.vertices);
  json.at("faces").get_to(answer.faces);
  json.at("face").get_to(answer.face);
  for (const Json& expected : json.at("expected")) {
    SurfaceSample sample;
    expected.at("barycentric").get_to(sample.barycentric);
    expected.at("position").get_to(sample.position);
    expected.at("d_dl1").get_to(sample.d_dl1);
    expected.at("d_dl2").get_to(sample.d_dl2);
    expected.at("unit_normal").get_to(sample.unit_normal);
    answer.samples.push_back(std::move(sample));
  }
  return answer;
}

ClosedMeshAnswer closed_mesh(const Json& json) {
  const Json& expected = json.at("expected");
  ClosedMeshAnswer answer;
  json.at("id").get_to(answer.id);
  json.at("vertices").get_to(answer.vertices);
  json.at("faces").get_to(answer.faces);
  expected.at("step1_vertex_points").get_to(answer.step1_vertex_points);
  for (const auto& [edge, point] : expected.at("step1_edge_points").items()) {
    const std::size_t dash = edge.find('-');
    if (dash == std::string::npos) throw ArgumentError("edge \"" + edge + "\" is not of the form a-b");
    answer.step1_edge_points.push_back(
        {std::stoi(edge.substr(0, dash)), std::stoi(edge.substr(dash + 1)), point.get<Numeral3>()});
  }
  expected.at("limit_positions").get_to(answer.limit_positions);
  expected.at("face0_center_limit").get_to(answer.face0_center_limit);
  return answer;
}

BasisAnswer basis(const Json& json) {
  BasisAnswer answer;
  json.at("id").get_to(answer.id);
  json.at("alpha").get_to(answer.alpha);
  json.at("beta").get_to(answer.beta);
  json.at("b").get_to(answer.b);
  json.at("db_dalpha").get_to(answer.db_dalpha);
  json.at("db_dbeta").get_to(answer.db_dbeta);
  return answer;
}

}  // namespace

std::filesystem::path known_answers_path() {
  std::filesystem::path in_source = LIMITCHECK_KNOWN_ANSWERS_IN_SOURCE;
  std::error_code ignored;
  if (std::filesystem::exists(in_source, ignored)) return in_source;
  return LIMITCHECK_KNOWN_ANSWERS_INSTALLED;
}

KnownAnswers load_known_answers(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError("FILE_CANNOT_OPEN", file.string(), 0, "cannot be opened for reading");
  KnownAnswers answers;
  try {
    const Json json = Json::parse(stream);
    for (const Json& one : json.at("cases")) {
      const std::string kind = one.at("kind");
      if (kind == "interior_vertex_ring") {
        answers.interior_rings.push_back(interior_ring(one));
      } else if (kind == "boundary_vertex_ring") {
        answers.boundary_rings.push_back(boundary_ring(one));
      } else if (kind == "surface_point" || kind == "surface_point_boundary_face") {
        answers.surfaces.push_back(surface(one, kind == "surface_point_boundary_face"));
      } else if (kind == "closed_mesh") {
        answers.closed_meshes.push_back(closed_mesh(one));
      } else if (kind == "basis_values") {
        answers.basis.push_back(basis(one));
      } else {
        throw ArgumentError("unknown kind \"" + kind + "\"");
      }
    }
  } catch (const std::exception& error) {
    throw InputError("FILE_SYNTAX", file.string(), 0, error.what());
  }
  return answers;
}

ControlMesh control_mesh(const std::vector<Numeral3>& vertices,
                         const std::vector<std::array<std::int32_t, 3>>& faces) {
  ControlMesh mesh;
  mesh.positions.reserve(vertices.size());
  for (const Numeral3& vertex : vertices) mesh.positions.push_back(parse<double>(vertex));
  mesh.faces = Faces(faces);
  return mesh;
}

}  // namespace limitcheck::data
