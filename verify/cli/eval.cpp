// SPDX-License-Identifier: MIT
// limitcheck eval: the exact surface at one point.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "reference/surface/certified.h"
#include "verify/cli/commands.h"

namespace limitcheck::cli {
namespace {

using reference::CertifiedPoint;
using reference::Enclosure;
using reference::Enclosure3;
using reference::NormalKind;
using reference::Parameter;
using reference::Weights;

struct Request {
  std::string mesh, l1, l2;
  std::int64_t face = 0;
  int digits = 16;
  std::string precision = "double", weights = "loop";
  bool json = false;
};

const char* name(NormalKind kind) {
  switch (kind) {
    case NormalKind::kRegular:
      return "regular";
    case NormalKind::kNoTangentPlane:
      return "no_tangent_plane";
    case NormalKind::kFallback:
      return "fallback";
    case NormalKind::kArbitrary:
      return "arbitrary";
  }
  return "";
}

nlohmann::ordered_json vector(const Enclosure3& v) {
  return {v[0].value, v[1].value, v[2].value};
}
nlohmann::ordered_json vector(const Enclosure& e) {
  return e.value;
}

double radius(const Enclosure3& v) {
  return std::max({v[0].radius, v[1].radius, v[2].radius});
}
double radius(const Enclosure& e) {
  return e.radius;
}

void print_json(const Request& request, const std::array<std::string, 3>& barycentric,
                const CertifiedPoint& p) {
  nlohmann::ordered_json json, radii;
  json["mesh"] = request.mesh;
  json["face"] = request.face;
  json["barycentric"] = barycentric;
  json["digits"] = request.digits;
  json["weights"] = request.weights;
  const auto add = [&](const char* key, const auto& value) {
    json[key] = vector(value);
    radii[key] = radius(value);
  };
  const auto add_maybe = [&](const char* key, const auto& value) {
    if (value) return add(key, *value);
    json[key] = radii[key] = nullptr;
  };
  add("position", p.position);
  add("d1", p.d1);
  add("d2", p.d2);
  json["derivatives_exist"] = p.first_exist;
  add_maybe("tangent1", p.t1);
  add_maybe("tangent2", p.t2);
  add("normal", p.normal);
  json["normal_kind"] = name(p.normal_kind);
  add_maybe("d11", p.d11);
  add_maybe("d12", p.d12);
  add_maybe("d22", p.d22);
  add_maybe("gaussian_curvature", p.gaussian_curvature);
  add_maybe("mean_curvature", p.mean_curvature);
  json["radius"] = p.radius;
  json["radii"] = radii;
  fmt::print("{}\n", json.dump(2));
}

void print_text(const Request& request, const std::array<std::string, 3>& barycentric,
                const CertifiedPoint& p) {
  // Two digits of the radius, not less than it.
  const auto within = [](const auto& value) {
    const double r = radius(value);
    return r == 0 ? "  exact" : fmt::format("  +-{:.1e}", 1.05 * r);
  };
  const auto line = [&](const char* what, const Enclosure3& v, const char* note = "") {
    fmt::print("{:<12}{}  {}  {}{}{}\n", what, v[0].value, v[1].value, v[2].value, within(v), note);
  };
  const auto absent = [](const char* what, const char* why) { fmt::print("{:<12}{}\n", what, why); };
  fmt::print("{} face {} at ({}, {}, {})\n", request.mesh, request.face, barycentric[0], barycentric[1],
             barycentric[2]);
  line("position", p.position);
  const bool regular = p.normal_kind == NormalKind::kRegular || p.normal_kind == NormalKind::kNoTangentPlane;
  const char* none = !regular ? "need not exist at this extraordinary corner, where the tangents degenerate"
                     : p.boundary_corner
                         ? "does not exist at this extraordinary corner, unless it runs along the boundary"
                         : "does not exist: it grows without bound towards this extraordinary corner";
  if (p.first_exist) {
    line("d/dl1", p.d1);
    line("d/dl2", p.d2);
  } else {
    absent("d/dl1", none);
    absent("d/dl2", none);
  }
  if (p.t1) {
    line("tangent 1", *p.t1, "  (direction only)");
    line("tangent 2", *p.t2, "  (direction only)");
  }
  switch (p.normal_kind) {
    case NormalKind::kRegular:
      line("normal", p.normal);
      break;
    case NormalKind::kNoTangentPlane:
      line("normal", p.normal, "  (the surface has no tangent plane here)");
      break;
    case NormalKind::kFallback:
      line("normal", p.normal, "  (tangents degenerate: from the control faces)");
      break;
    case NormalKind::kArbitrary:
      line("normal", p.normal, "  (everything degenerate: arbitrary)");
      break;
  }
  if (p.d11) {
    line("d2/dl1dl1", *p.d11);
    line("d2/dl1dl2", *p.d12);
    line("d2/dl2dl2", *p.d22);
  } else {
    for (const char* what : {"d2/dl1dl1", "d2/dl1dl2", "d2/dl2dl2"}) absent(what, none);
  }
  if (p.gaussian_curvature) {
    fmt::print("{:<12}{}{}\n", "Gaussian K", p.gaussian_curvature->value, within(*p.gaussian_curvature));
    fmt::print("{:<12}{}{}\n", "mean H", p.mean_curvature->value, within(*p.mean_curvature));
  }
  fmt::print("certified: every number is that near the truth; the largest radius of a vector is {:.3g}\n",
             p.radius);
}

// As a float tessellator sees the mesh.
void round_to_float(data::ControlMesh& mesh) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    for (double& x : mesh.positions[v]) {
      const auto rounded = static_cast<double>(static_cast<float>(x));
      if (!std::isfinite(rounded))
        throw data::ArgumentError(fmt::format("vertex {}: {} is beyond the largest float", v, x));
      x = rounded;
    }
}

void run(const Request& request) {
  data::ControlMesh mesh = data::open_mesh(request.mesh);
  if (request.precision == "float") round_to_float(mesh);
  if (request.face < 0 || static_cast<std::size_t>(request.face) >= mesh.faces.size())
    throw data::ArgumentError(fmt::format("{} has faces 0 to {}, not {}", request.mesh,
                                          static_cast<std::int64_t>(mesh.faces.size()) - 1, request.face));
  const Parameter l1 = Parameter::parse(request.l1), l2 = Parameter::parse(request.l2);
  const Weights weights = request.weights == "warren" ? Weights::kWarren : Weights::kLoop;
  const CertifiedPoint point = reference::CertifiedEvaluator(mesh, weights)
                                   .evaluate(static_cast<int>(request.face), l1, l2, request.digits);
  const std::array<std::string, 3> barycentric{Parameter::complement(l1, l2).to_string(), l1.to_string(),
                                               l2.to_string()};
  request.json ? print_json(request, barycentric, point) : print_text(request, barycentric, point);
}

}  // namespace

void add_eval(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "eval", "Limit position, derivatives, normal and curvature at one point, to any number of digits");
  auto request = std::make_shared<Request>();
  command->add_option("MESH", request->mesh, "A mesh file, or a name as `limitcheck generate` takes it")
      ->required();
  command->add_option("FACE", request->face, "Face, from 0 in file order")->required();
  command->add_option("L1", request->l1, "Weight of the face's second corner: 1/3, 0.25, 1e-9")->required();
  command->add_option("L2", request->l2, "Weight of its third corner; the first has 1 - L1 - L2")->required();
  command->add_option("--digits", request->digits, "Significant digits")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command
      ->add_option("--precision", request->precision,
                   "Round the control mesh to it first, as a float tessellator sees it")
      ->check(CLI::IsMember({"float", "double"}))
      ->capture_default_str();
  command->add_option("--weights", request->weights, "Weights of interior vertices: Loop's or Warren's")
      ->check(CLI::IsMember({"loop", "warren"}))
      ->capture_default_str();
  command->add_flag("--json", request->json, "One JSON document, numbers as decimal strings");
  command->callback([request, &exit_code] {
    run(*request);
    exit_code = kHeld;
  });
}

}  // namespace limitcheck::cli
