// SPDX-License-Identifier: MIT
// limitcheck eval: the oracle as a calculator.
#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "data/generators/named_mesh.h"
#include "reference/certified.h"
#include "verify/cli/commands.h"

namespace limitcheck::cli {
namespace {

using reference::CertifiedPoint;
using reference::Enclosure;
using reference::Enclosure3;
using reference::NormalKind;
using reference::Parameter;

struct Request {
  std::string mesh, l1, l2;
  std::int64_t face = 0;
  int digits = 16;
  bool json = false;
};

const char* name(NormalKind kind) {
  switch (kind) {
    case NormalKind::kRegular: return "regular";
    case NormalKind::kNoTangentPlane: return "no_tangent_plane";
    case NormalKind::kFallback: return "fallback";
    case NormalKind::kArbitrary: return "arbitrary";
  }
  return "";
}

nlohmann::ordered_json vector(const Enclosure3& v) { return {v[0].value, v[1].value, v[2].value}; }

void print_json(const Request& request, const std::array<std::string, 3>& barycentric, const CertifiedPoint& p) {
  const auto maybe = [](const auto& value, auto convert) -> nlohmann::ordered_json {
    if (!value) return nullptr;
    return convert(*value);
  };
  const auto scalar = [](const Enclosure& e) -> nlohmann::ordered_json { return e.value; };
  nlohmann::ordered_json json;
  json["mesh"] = request.mesh;
  json["face"] = request.face;
  json["barycentric"] = barycentric;
  json["digits"] = request.digits;
  json["position"] = vector(p.position);
  json["d1"] = vector(p.d1);
  json["d2"] = vector(p.d2);
  json["derivatives_exist"] = p.first_exist;
  json["normal"] = vector(p.normal);
  json["normal_kind"] = name(p.normal_kind);
  json["d11"] = maybe(p.d11, vector);
  json["d12"] = maybe(p.d12, vector);
  json["d22"] = maybe(p.d22, vector);
  json["gaussian_curvature"] = maybe(p.gaussian_curvature, scalar);
  json["mean_curvature"] = maybe(p.mean_curvature, scalar);
  json["radius"] = p.radius;
  fmt::print("{}\n", json.dump(2));
}

void print_text(const Request& request, const std::array<std::string, 3>& barycentric, const CertifiedPoint& p) {
  const auto line = [](const char* what, const Enclosure3& v, const char* note = "") {
    fmt::print("{:<12}{}  {}  {}{}\n", what, v[0].value, v[1].value, v[2].value, note);
  };
  fmt::print("{} face {} at ({}, {}, {})\n", request.mesh, request.face, barycentric[0], barycentric[1], barycentric[2]);
  line("position", p.position);
  const char* note = p.first_exist ? "" : "  (tangent direction: no partial derivatives at an extraordinary corner)";
  line("d/dl1", p.d1, note);
  line("d/dl2", p.d2, note);
  switch (p.normal_kind) {
    case NormalKind::kRegular: line("normal", p.normal); break;
    case NormalKind::kNoTangentPlane: line("normal", p.normal, "  (the surface has no tangent plane here)"); break;
    case NormalKind::kFallback: line("normal", p.normal, "  (tangents degenerate: from the control faces)"); break;
    case NormalKind::kArbitrary: line("normal", p.normal, "  (everything degenerate: arbitrary)"); break;
  }
  if (p.d11) {
    line("d2/dl1dl1", *p.d11);
    line("d2/dl1dl2", *p.d12);
    line("d2/dl2dl2", *p.d22);
  }
  if (p.gaussian_curvature) fmt::print("{:<12}{}\n{:<12}{}\n", "Gaussian K", p.gaussian_curvature->value, "mean H", p.mean_curvature->value);
  fmt::print("{:<12}{:.3g} (certified: every number above is at least that near the truth)\n", "radius", p.radius);
}

void run(const Request& request) {
  const data::ControlMesh mesh = data::open_mesh(request.mesh);
  if (request.face < 0 || static_cast<std::size_t>(request.face) >= mesh.triangles.size())
    throw std::out_of_range(fmt::format("{} has faces 0 to {}, not {}", request.mesh, static_cast<std::int64_t>(mesh.triangles.size()) - 1, request.face));
  const Parameter l1 = Parameter::parse(request.l1), l2 = Parameter::parse(request.l2);
  const CertifiedPoint point = reference::CertifiedEvaluator(mesh).evaluate(static_cast<int>(request.face), l1, l2, request.digits);
  const std::array<std::string, 3> barycentric{Parameter::complement(l1, l2).to_string(), l1.to_string(), l2.to_string()};
  request.json ? print_json(request, barycentric, point) : print_text(request, barycentric, point);
}

}  // namespace

void add_eval(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("eval", "Limit position, derivatives, normal and curvature at one point, to any number of digits");
  auto request = std::make_shared<Request>();
  command->add_option("MESH", request->mesh, "A mesh file, or a name as `limitcheck generate` takes it")->required();
  command->add_option("FACE", request->face, "Face, from 0 in file order")->required();
  command->add_option("L1", request->l1, "Weight of the face's second corner: 1/3, 0.25, 1e-9")->required();
  command->add_option("L2", request->l2, "Weight of its third corner; the first has 1 - L1 - L2")->required();
  command->add_option("--digits", request->digits, "Significant digits")->check(CLI::Range(1, 10000))->capture_default_str();
  command->add_flag("--json", request->json, "One JSON document, numbers as decimal strings");
  command->callback([request, &exit_code] {
    run(*request);
    exit_code = kHeld;
  });
}

}  // namespace limitcheck::cli
