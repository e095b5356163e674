// SPDX-License-Identifier: MIT
// limitcheck eval: the exact surface at one point, or at many.
#include "verify/cli/eval/eval.h"

#include <fmt/format.h>
#include <tbb/info.h>

#include <cmath>
#include <memory>
#include <numeric>

#include "data/error.h"
#include "data/numeral.h"
#include "reference/surface/channel.h"
#include "verify/audit/at_point.h"
#include "verify/cli/audit.h"
#include "verify/evidence/audit_case.h"

namespace limitcheck::cli {
namespace {

using reference::CertifiedEvaluator, reference::Parameter;

// As a float tessellator sees the mesh.
void round_to_float(data::ControlMesh& mesh) {
  const auto round = [](double& x, const char* what, std::size_t number) {
    const auto rounded = static_cast<double>(static_cast<float>(x));
    if (!std::isfinite(rounded))
      throw data::ArgumentError(fmt::format("{} {}: {} is beyond the largest float", what, number, x));
    x = rounded;
  };
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    for (double& x : mesh.positions[v]) round(x, "vertex", v);
  for (data::Channel& channel : mesh.channels)
    for (std::size_t i = 0; i < channel.values.size(); ++i)
      round(channel.values[i], "texture value", i / static_cast<std::size_t>(channel.components));
}

// "3/8", "0".
std::pair<std::uint32_t, std::uint32_t> fraction(const Parameter& parameter) {
  const std::string text = parameter.to_string();
  std::pair<std::uint32_t, std::uint32_t> result{0, 1};
  if (data::read_numbers(text, '/', result.first, result.second) == 0)
    throw data::ArgumentError(fmt::format("--subject: {} is no lattice point", text));
  return result;
}

verify::Place place(const FaceAndCorner& at, const Parameter& u, const Parameter& v) {
  const auto [i, n] = fraction(u);
  const auto [j, m] = fraction(v);
  const std::uint64_t both = std::lcm<std::uint64_t>(n, m);
  if (both > (1U << 20)) throw data::ArgumentError("--subject: the point is no lattice point");
  return {static_cast<std::int32_t>(at.face), static_cast<std::uint32_t>(i * (both / n)),
          static_cast<std::uint32_t>(j * (both / m)), static_cast<std::uint32_t>(both),
          at.corner.value_or(0)};
}

std::string vector(const verify::Vector& v, bool in_float) {
  if (in_float)
    return fmt::format("{}  {}  {}", static_cast<float>(v[0]), static_cast<float>(v[1]),
                       static_cast<float>(v[2]));
  return fmt::format("{}  {}  {}", v[0], v[1], v[2]);
}

std::string off(double amount, double bound, const char* unit, const char* otherwise) {
  if (std::isnan(amount)) return otherwise;
  return fmt::format("off by {:.3g} {}, allowed {:.2g}{}", amount, unit, bound,
                     amount <= bound ? "" : "  <-- wrong");
}

void print_expected(const verify::VertexAtPoint& p, bool refined) {
  say("expected  position  {}{}\n", vector(p.expected, false),
      refined ? "  (of the refined control mesh)" : "");
  if (p.normal)
    say("          normal    {}\n",
        p.expected_normal ? vector(*p.expected_normal, false) : "any of length 1: the surface has none");
}

/// What the subject delivers at the point and what it should, and how far they are apart. Returns the exit code: 1 if a
/// vertex is beyond its bounds or not finite, or if vertices that should be equal have other bits. Throws
/// data::ArgumentError: there is no such subject, or the point is no lattice point of the depth.
int show_difference(const EvalRequest& request, const FaceAndCorner& at, const OpenedMesh& opened) {
  const Parameter u = Parameter::parse(request.u), v = Parameter::parse(request.v);
  verify::AuditMesh mesh{request.mesh, opened.mesh};
  mesh.asked_scheme = opened.chosen.scheme;
  mesh.depth = request.depth;
  mesh.depths = request.depths;
  mesh.face_depth = verify::face_depths(verify::parse_depths(request.depths), mesh.mesh, request.depth);
  refuse_too_many_points(mesh);
  SubjectLoader loader(SubjectArguments{});
  const verify::AuditSubject subject = loader.open(request.subject);
  const verify::AtPoint found =
      verify::look_at(subject, mesh, place(at, u, v), static_cast<int>(tbb::info::default_concurrency()));

  say("{}\n{} at depth {}{}, face {}{} at ({}, {})\n", scheme_line({opened.chosen}, request.options),
      request.mesh, request.depth, request.depths == "uniform" ? "" : " (" + request.depths + ")", at.face,
      at.corner ? fmt::format(" corner {}", *at.corner) : "", u.to_string(), v.to_string());
  if (found.vertices.empty()) say("{} delivers no vertex there\n", subject.label());
  const verify::VertexAtPoint* before = nullptr;
  for (const verify::VertexAtPoint& p : found.vertices) {
    const bool told =
        before != nullptr && before->expected == p.expected && before->expected_normal == p.expected_normal;
    before = &p;
    if (!told) print_expected(p, found.refined);
    say("{} vertex {}\n", subject.label(), p.vertex);
    say("          position  {}\n                    {}\n", vector(p.position, found.in_float),
        off(p.distance, found.bound, "diagonals", "not finite  <-- wrong"));
    if (p.normal)
      say("          normal    {}\n                    {}\n", vector(*p.normal, found.in_float),
          off(p.angle, p.angle_bound, "degrees", "not finite, or not of length 1  <-- wrong"));
  }
  if (found.vertices.size() > 1)
    say("{} vertices at this point; {}\n", found.vertices.size(),
        found.same_bits ? "the same bits" : "they differ in bits  <-- wrong");
  return found.held() ? kHeld : kFindings;
}

int run(const EvalRequest& request) {
  if (!request.points.empty()) {
    OpenedMesh opened = open_control_mesh(request.mesh, request.options);
    if (request.in_float) round_to_float(opened.mesh);
    evaluate_points(request, opened);
    return kHeld;
  }
  if (request.v.empty())
    throw data::ArgumentError("FACE U V are missing; or name a file of points with --points");
  const FaceAndCorner at = parse_face(request.face);
  OpenedMesh opened = open_control_mesh(request.mesh, request.options);
  if (!request.subject.empty()) {
    check_face(request, opened, at);
    return show_difference(request, at, opened);
  }
  if (request.in_float) round_to_float(opened.mesh);
  check_face(request, opened, at);
  const Parameter u = Parameter::parse(request.u), v = Parameter::parse(request.v);
  EvaluatedPoint evaluated{request, opened.chosen, at, {u.to_string(), v.to_string()}};
  if (opened.chosen.scheme == data::Scheme::kLoop)
    evaluated.parameters.insert(evaluated.parameters.begin(), Parameter::complement(u, v).to_string());
  const auto face = static_cast<int>(at.face);
  if (request.channel.empty()) {
    evaluated.points = {
        certified_evaluator(request, opened).evaluate(face, at.corner.value_or(0), u, v, request.digits)};
  } else {
    const ChosenChannel chosen = channel_of(request, opened);
    evaluated.components = static_cast<std::size_t>(chosen.channel.components);
    evaluated.rule = chosen.rule;
    evaluated.points =
        reference::ChannelEvaluator(opened.mesh, chosen.channel, chosen.rule, opened.chosen.scheme)
            .evaluate(face, at.corner.value_or(0), u, v, request.digits);
  }
  request.json ? print_point_as_json(evaluated) : print_point(evaluated);
  return kHeld;
}

}  // namespace

FaceAndCorner parse_face(const std::string& text) {
  FaceAndCorner result;
  int corner = 0;
  const int count = data::read_numbers(text, ':', result.face, corner);
  if (count == 0)
    throw data::ArgumentError(
        fmt::format("FACE is a number from 0 in file order, or FACE:CORNER, not '{}'", text));
  if (count == 2) result.corner = corner;
  return result;
}

// The face is there, and it has a corner if it needs one.
void check_face(const EvalRequest& request, const OpenedMesh& opened, const FaceAndCorner& at) {
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
        "{}: face {} has {} corners, and U and V run over the quarter at one of them: FACE is {}:0 to {}:{}",
        request.mesh, at.face, corners, at.face, at.face, corners - 1));
  if (at.corner && (*at.corner < 0 || *at.corner >= corners))
    throw data::ArgumentError(fmt::format("{}: face {} has corners 0 to {}, not {}", request.mesh, at.face,
                                          corners - 1, *at.corner));
}

ChosenChannel channel_of(const EvalRequest& request, const OpenedMesh& opened) {
  if (request.weights != reference::Weights::kLoop)
    throw data::ArgumentError("--channel is evaluated with Loop's weights, not with Warren's");
  const data::Channel& channel = data::channel_of(opened.mesh, request.channel);
  return {channel, request.channel_rule.value_or(channel.rule.value_or(data::kUsualChannelRule))};
}

CertifiedEvaluator certified_evaluator(const EvalRequest& request, const OpenedMesh& opened) {
  if (opened.chosen.scheme == data::Scheme::kLoop) return CertifiedEvaluator(opened.mesh, request.weights);
  if (request.weights != reference::Weights::kLoop)
    throw data::ArgumentError("--weights warren is for Loop's scheme, and this is Catmull-Clark's");
  return {opened.mesh, opened.chosen.scheme};
}

void add_eval(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "eval", "Limit position, derivatives, normal and curvature at one point, to any number of digits");
  auto request = std::make_shared<EvalRequest>();
  command->add_option("MESH", request->mesh, "A mesh file, or a name as `limitcheck generate` takes it")
      ->required();
  CLI::Option* points =
      add_value(*command, "--points", request->points, "FILE|-",
                "Evaluate every line FACE,U,V of a file, or of standard input, on all processors, and write "
                "a line for each: CSV with a header, or JSON with --json");
  command
      ->add_option(
          "FACE", request->face,
          "Face, from 0 in file order; FACE:CORNER for Catmull-Clark's scheme where the face is no quad")
      ->excludes(points);
  command
      ->add_option("U", request->u,
                   "Loop: l1, the weight of the face's second corner; Catmull-Clark: u, from the corner "
                   "towards the next. 1/3, 0.25, 1e-9")
      ->excludes(points);
  command
      ->add_option("V", request->v,
                   "Loop: l2, the weight of its third corner (the first has 1 - l1 - l2); Catmull-Clark: v, "
                   "from the corner towards the one before")
      ->excludes(points);
  CLI::Option* certified = command->add_flag(
      "--certified", request->certified,
      "With --points: certified decimals, as many as --digits, and the largest radius; without: doubles");
  certified->needs(points);
  add_number(*command, "--derivatives", request->derivatives, 0, 2,
             "With --points: columns for position alone (0), for normal, d1 and d2 (1), for d11, d12, d22 "
             "and curvatures (2)")
      ->needs(points);
  add_mesh_options(*command, request->options);
  add_number(*command, "--digits", request->digits, 1, 10000, "Significant digits");
  add_words(*command, "--precision", request->in_float, {{"float", true}, {"double", false}},
            "Round the control mesh to it first, as a float tessellator sees it");
  add_words(*command, "--weights", request->weights, kWeights,
            "Loop's scheme: weights of interior vertices, Loop's or Warren's");
  command->add_flag("--json", request->json,
                    "One JSON document, numbers as decimal strings; with --points a document on each line");
  CLI::Option* subject = command
                             ->add_option("--subject", request->subject,
                                          "Show what this subject (as `limitcheck audit` takes it) delivers "
                                          "at the point, beside what it should; exit code 1 if it is wrong")
                             ->check(kNotEmpty)
                             ->excludes(points);
  add_number(*command, "--depth", request->depth, 0, 12,
             "With --subject: subdivision depth of every face, or of the deepest one")
      ->needs(subject);
  command
      ->add_option("--depths", request->depths,
                   "With --subject: how the faces get their depths, as for audit")
      ->needs(subject)
      ->capture_default_str();
  CLI::Option* channel =
      add_value(
          *command, "--channel", request->channel, "NAME",
          "Evaluate a face-varying channel of the mesh in place of its positions: uv, the texture "
          "coordinates of an OBJ file or of a mesh by name. Face and parameters say on which side of a seam")
          ->excludes(subject);
  add_channel_rule(*command, request->channel_rule)->needs(channel);
  command->footer(
      "Catmull-Clark: on a quad (U, V) is (0, 0) at corner 0, (1, 0) at corner 1, (1, 1) and (0, 1) at "
      "corners 2 and 3. Any other face has a quad at each corner: there (0, 0) is the corner, (1, 0) the "
      "middle of the edge to the next corner, (1, 1) the middle of the face. Derivatives are by these "
      "parameters: d1 by U, d2 by V.\n\n"
      "Curvatures: K is positive where the surface is like a ball, negative where it is like a saddle. H, "
      "the mean of the two principal curvatures, is positive where the surface bends away from its normal: "
      "on a ball seen from outside.");
  command->callback([request, &exit_code] { exit_code = run(*request); });
}

}  // namespace limitcheck::cli
