// SPDX-License-Identifier: MIT
#include "data/test_support/known_answers.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "data/error.h"
#include "data/untrusted_json.h"

namespace limitcheck::data {
namespace {

using Json = nlohmann::json;

// Members of an object: key, where it goes, and so on.
template <class To, class... More>
void take(const Json& json, const char* key, To& to, More&&... more) {
  json.at(key).get_to(to);
  if constexpr (sizeof...(more) > 0) take(json, more...);
}

InteriorRingAnswer interior_ring(const Json& json) {
  InteriorRingAnswer a;
  take(json, "id", a.id, "valence", a.valence, "center", a.center, "ring_ccw", a.ring);
  take(json.at("expected"), "limit_position", a.limit_position, "C", a.c, "S", a.s, "unit_normal",
       a.unit_normal);
  return a;
}

BoundaryRingAnswer boundary_ring(const Json& json) {
  BoundaryRingAnswer a;
  take(json, "id", a.id, "triangles", a.faces, "center", a.center, "ring_ccw", a.ring);
  take(json.at("expected"), "limit_position", a.limit_position, "along", a.along, "across", a.across,
       "unit_normal", a.unit_normal);
  return a;
}

ClosedMeshAnswer closed_mesh(const Json& json) {
  const Json& expected = json.at("expected");
  ClosedMeshAnswer a;
  take(json, "id", a.id, "vertices", a.vertices, "faces", a.faces);
  take(expected, "step1_vertex_points", a.step1_vertex_points, "limit_positions", a.limit_positions,
       "face0_center_limit", a.face0_center_limit);
  for (const auto& [edge, point] : expected.at("step1_edge_points").items()) {
    const std::size_t dash = edge.find('-');
    if (dash == std::string::npos) throw ArgumentError("edge \"" + edge + "\" is not of the form a-b");
    a.step1_edge_points.push_back(
        {std::stoi(edge.substr(0, dash)), std::stoi(edge.substr(dash + 1)), point.get<Numeral3>()});
  }
  return a;
}

BasisAnswer basis(const Json& json) {
  BasisAnswer a;
  take(json, "id", a.id, "alpha", a.alpha, "beta", a.beta, "b", a.b, "db_dalpha", a.db_dalpha, "db_dbeta",
       a.db_dbeta);
  return a;
}

QuadSample quad_sample(const Json& json, int face) {
  QuadSample s;
  s.face = face;
  take(json, "position", s.position);
  s.corner = json.value("subface", 0);
  if (json.contains("uv")) {
    take(json, "uv", s.uv);
  } else {
    s.uv = {json.at("barycentric").at(1).get<Numeral>(), json.at("barycentric").at(2).get<Numeral>()};
  }
  s.at_vertex = json.contains("at_vertex");
  s.no_tangent_plane = json.value("no_tangent_plane", false);
  for (const auto& [key, to] : {std::pair{"unit_normal", &s.normal},
                                {"d_du", &s.du},
                                {"d_dv", &s.dv},
                                {"d2_dudu", &s.dudu},
                                {"d2_dudv", &s.dudv},
                                {"d2_dvdv", &s.dvdv},
                                {"d_dl1", &s.du},
                                {"d_dl2", &s.dv},
                                {"d2_dl1dl1", &s.dudu},
                                {"d2_dl1dl2", &s.dudv},
                                {"d2_dl2dl2", &s.dvdv}})
    if (json.contains(key) && !json.at(key).is_null()) *to = json.at(key).get<Numeral3>();
  return s;
}

QuadAnswer quad_answer(const Json& json) {
  QuadAnswer a;
  take(json, "id", a.id, "vertices", a.vertices);
  if (json.contains("scheme"))
    take(json, "scheme", a.scheme, "boundary", a.boundary, "triangles", a.triangles, "creasing", a.creasing);
  const auto sharpness = [](const Json& one) {
    const auto text = one.at("sharpness").get<std::string>();
    return text == "inf" ? "10" : text;
  };
  for (const Json& one : json.value("creases", Json::array()))
    a.sharp_edges.push_back({one.at("edge").at(0), one.at("edge").at(1), sharpness(one)});
  for (const Json& one : json.value("corners", Json::array()))
    a.sharp_vertices.push_back({one.at("vertex"), -1, sharpness(one)});
  for (const Json& face : json.at("faces")) a.faces.push_back(face.get<std::vector<std::int32_t>>());
  for (const Json& one : json.at("expected"))
    a.samples.push_back(quad_sample(one, (one.contains("face") ? one : json).at("face")));
  return a;
}

}  // namespace

KnownAnswers load_known_answers(const std::filesystem::path& file) {
  KnownAnswers answers;
  for_each_case(file, [&](const Json& one) {
    const std::string kind = one.at("kind");
    if (kind == "interior_vertex_ring") {
      answers.interior_rings.push_back(interior_ring(one));
    } else if (kind == "boundary_vertex_ring") {
      answers.boundary_rings.push_back(boundary_ring(one));
    } else if (kind == "closed_mesh") {
      answers.closed_meshes.push_back(closed_mesh(one));
    } else if (kind == "basis_values") {
      answers.basis.push_back(basis(one));
    } else if (!kind.starts_with("surface_point")) {
      throw ArgumentError("unknown kind \"" + kind + "\"");
    }
  });
  return answers;
}

std::vector<QuadAnswer> load_quad_answers() {
  std::vector<QuadAnswer> answers;
  for (const char* file : {"known_answers.json", "known_answers_catmull_clark.json"})
    for_each_case(data_file(file), [&](const Json& one) {
      if (one.at("kind").get<std::string>().starts_with("surface_point")) answers.push_back(quad_answer(one));
    });
  return answers;
}

ControlMesh control_mesh(const std::vector<Numeral3>& vertices, const Faces& faces) {
  ControlMesh mesh;
  for (const Numeral3& vertex : vertices) mesh.positions.push_back(parse<double>(vertex));
  mesh.faces = faces;
  return mesh;
}

}  // namespace limitcheck::data
