// SPDX-License-Identifier: MIT
// limitcheck eval: the exact surface at one point.
#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>

#include "data/error.h"
#include "reference/surface/certified.h"
#include "verify/cli/commands.h"
#include "verify/cli/eval_report.h"
#include "verify/cli/eval_subject.h"
#include "verify/cli/mesh_options.h"

namespace limitcheck::cli {
namespace {

using reference::CertifiedEvaluator;
using reference::Parameter;

struct Request {
  std::string mesh, face, u, v;
  MeshOptions options;
  int digits = 16;
  std::string precision = "double", weights = "loop";
  bool json = false;
  std::string subject, depths = "uniform";
  int depth = 4;
};

struct FaceAndCorner {
  std::int64_t face = 0;
  std::optional<int> corner;
};

// "17" or "17:2".
FaceAndCorner parse_face(const std::string& text) {
  const auto number = [&](std::string_view part, auto& value) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || end != part.data() + part.size())
      throw data::ArgumentError(
          fmt::format("FACE is a number from 0 in file order, or FACE:CORNER, not '{}'", text));
  };
  FaceAndCorner result;
  const std::size_t colon = text.find(':');
  number(std::string_view(text).substr(0, colon), result.face);
  if (colon != std::string::npos) number(std::string_view(text).substr(colon + 1), result.corner.emplace());
  return result;
}

// The face is there, and it has a corner if it needs one.
void check_face(const Request& request, const OpenedMesh& opened, const FaceAndCorner& at) {
  const data::Faces& faces = opened.mesh.faces;
  if (at.face < 0 || static_cast<std::size_t>(at.face) >= faces.size())
    throw data::ArgumentError(fmt::format("{} has faces 0 to {}, not {}", request.mesh,
                                          static_cast<std::int64_t>(faces.size()) - 1, at.face));
  if (opened.chosen.scheme == data::Scheme::kLoop) {
    if (!at.corner) return;
    throw data::ArgumentError(
        fmt::format("FACE:CORNER is for Catmull-Clark's scheme; here, for Loop's, FACE is {}", at.face));
  }
  const auto corners = static_cast<int>(faces[static_cast<std::size_t>(at.face)].size());
  if (corners == 4 && at.corner)
    throw data::ArgumentError(
        fmt::format("{}: face {} is a quad, and U and V run over all of it: FACE is {}, without a corner",
                    request.mesh, at.face, at.face));
  if (corners != 4 && !at.corner)
    throw data::ArgumentError(fmt::format(
        "{}: face {} has {} corners, and U and V run over the quarter at one of them: FACE is {}:0 to "
        "{}:{}",
        request.mesh, at.face, corners, at.face, at.face, corners - 1));
  if (at.corner && (*at.corner < 0 || *at.corner >= corners))
    throw data::ArgumentError(fmt::format("{}: face {} has corners 0 to {}, not {}", request.mesh, at.face,
                                          corners - 1, *at.corner));
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

CertifiedEvaluator evaluator(const Request& request, const OpenedMesh& opened) {
  if (opened.chosen.scheme == data::Scheme::kLoop)
    return CertifiedEvaluator(
        opened.mesh, request.weights == "warren" ? reference::Weights::kWarren : reference::Weights::kLoop);
  if (request.weights != "loop")
    throw data::ArgumentError("--weights warren is for Loop's scheme, and this is Catmull-Clark's");
  return {opened.mesh, opened.chosen.scheme};
}

int run(const Request& request) {
  const FaceAndCorner at = parse_face(request.face);
  OpenedMesh opened = open_mesh(request.mesh, request.options);
  if (!request.subject.empty()) {
    check_face(request, opened, at);
    return show_difference({request.subject, request.mesh, request.depth, request.depths, at.face, at.corner,
                            scheme_line({opened.chosen}, request.options)},
                           opened, Parameter::parse(request.u), Parameter::parse(request.v));
  }
  if (request.precision == "float") round_to_float(opened.mesh);
  check_face(request, opened, at);
  const Parameter u = Parameter::parse(request.u), v = Parameter::parse(request.v);
  const reference::CertifiedPoint point =
      evaluator(request, opened)
          .evaluate(static_cast<int>(at.face), at.corner.value_or(0), u, v, request.digits);
  EvaluatedPoint evaluated{request.mesh,
                           scheme_line({opened.chosen}, request.options),
                           opened.chosen,
                           request.weights,
                           at.face,
                           at.corner,
                           {u.to_string(), v.to_string()},
                           request.digits};
  if (opened.chosen.scheme == data::Scheme::kLoop)
    evaluated.parameters.insert(evaluated.parameters.begin(), Parameter::complement(u, v).to_string());
  request.json ? print_json(evaluated, point) : print_text(evaluated, point);
  return kHeld;
}

}  // namespace

void add_eval(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "eval", "Limit position, derivatives, normal and curvature at one point, to any number of digits");
  auto request = std::make_shared<Request>();
  command->add_option("MESH", request->mesh, "A mesh file, or a name as `limitcheck generate` takes it")
      ->required();
  command
      ->add_option(
          "FACE", request->face,
          "Face, from 0 in file order; FACE:CORNER for Catmull-Clark's scheme where the face is no quad")
      ->required();
  command
      ->add_option(
          "U", request->u,
          "Loop: l1, the weight of the face's second corner; Catmull-Clark: u, from the corner towards "
          "the next. 1/3, 0.25, 1e-9")
      ->required();
  command
      ->add_option(
          "V", request->v,
          "Loop: l2, the weight of its third corner (the first has 1 - l1 - l2); Catmull-Clark: v, from "
          "the corner towards the one before")
      ->required();
  add_mesh_options(*command, request->options);
  command->add_option("--digits", request->digits, "Significant digits")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command
      ->add_option("--precision", request->precision,
                   "Round the control mesh to it first, as a float tessellator sees it")
      ->check(CLI::IsMember({"float", "double"}))
      ->capture_default_str();
  command
      ->add_option("--weights", request->weights,
                   "Loop's scheme: weights of interior vertices, Loop's or Warren's")
      ->check(CLI::IsMember({"loop", "warren"}))
      ->capture_default_str();
  command->add_flag("--json", request->json, "One JSON document, numbers as decimal strings");
  CLI::Option* subject = command->add_option(
      "--subject", request->subject,
      "Show what this subject (as `limitcheck audit` takes it) delivers at the point, beside "
      "what it should; exit code 1 if it is wrong");
  command
      ->add_option("--depth", request->depth,
                   "With --subject: subdivision depth of every face, or of the deepest one")
      ->needs(subject)
      ->check(CLI::Range(0, 12))
      ->capture_default_str();
  command
      ->add_option("--depths", request->depths,
                   "With --subject: how the faces get their depths, as for audit")
      ->needs(subject)
      ->capture_default_str();
  command->footer(
      "Catmull-Clark: on a quad (U, V) is (0, 0) at corner 0, (1, 0) at corner 1, (1, 1) and (0, 1) at "
      "corners 2 and 3. Any other face has a quad at each corner: there (0, 0) is the corner, (1, 0) the "
      "middle of the edge to the next corner, (1, 1) the middle of the face. Derivatives are by these "
      "parameters: d1 by U, d2 by V.");
  command->callback([request, &exit_code] { exit_code = run(*request); });
}

}  // namespace limitcheck::cli
