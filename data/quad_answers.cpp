// SPDX-License-Identifier: MIT
#include "data/quad_answers.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "data/error.h"
#include "data/known_answers.h"

namespace limitcheck::data {
namespace {

using Json = nlohmann::json;

QuadSample sample(const Json& json) {
  QuadSample s;
  json.at("face").get_to(s.face);
  s.corner = json.value("subface", 0);
  if (json.contains("uv")) {
    json.at("uv").get_to(s.uv);
  } else {
    s.uv = {json.at("barycentric").at(1).get<Numeral>(), json.at("barycentric").at(2).get<Numeral>()};
  }
  s.at_vertex = json.contains("at_vertex");
  s.no_tangent_plane = json.value("no_tangent_plane", false);
  json.at("position").get_to(s.position);
  const auto vector = [&](const char* key, std::optional<Numeral3>& to) {
    if (json.contains(key) && !json.at(key).is_null()) to = json.at(key).get<Numeral3>();
  };
  vector("unit_normal", s.normal);
  vector("d_du", s.du), vector("d_dv", s.dv);
  vector("d2_dudu", s.dudu), vector("d2_dudv", s.dudv), vector("d2_dvdv", s.dvdv);
  vector("d_dl1", s.du), vector("d_dl2", s.dv);
  vector("d2_dl1dl1", s.dudu), vector("d2_dl1dl2", s.dudv), vector("d2_dl2dl2", s.dvdv);
  return s;
}

QuadAnswer answer(const Json& json) {
  QuadAnswer a;
  json.at("id").get_to(a.id);
  json.at("scheme").get_to(a.scheme);
  json.at("boundary").get_to(a.boundary);
  json.at("triangles").get_to(a.triangles);
  json.at("creasing").get_to(a.creasing);
  const auto sharpness = [](const Json& one) {
    const auto text = one.at("sharpness").get<std::string>();
    return text == "inf" ? "10" : text;
  };
  for (const Json& one : json.at("creases"))
    a.sharp_edges.push_back({one.at("edge").at(0), one.at("edge").at(1), sharpness(one)});
  for (const Json& one : json.at("corners"))
    a.sharp_vertices.push_back({one.at("vertex"), -1, sharpness(one)});
  json.at("vertices").get_to(a.vertices);
  for (const Json& face : json.at("faces")) a.faces.push_back(face.get<std::vector<std::int32_t>>());
  for (const Json& one : json.at("expected")) a.samples.push_back(sample(one));
  return a;
}

}  // namespace

std::vector<QuadAnswer> load_quad_answers() {
  const std::filesystem::path file =
      known_answers_path().replace_filename("known_answers_catmull_clark.json");
  std::ifstream stream(file);
  if (!stream) throw InputError("FILE_CANNOT_OPEN", file.string(), 0, "cannot be opened for reading");
  std::vector<QuadAnswer> answers;
  try {
    const Json json = Json::parse(stream);
    for (const Json& one : json.at("cases")) answers.push_back(answer(one));
  } catch (const Json::exception& error) {
    throw InputError("FILE_SYNTAX", file.string(), 0, error.what());
  }
  return answers;
}

}  // namespace limitcheck::data
