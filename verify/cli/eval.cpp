// SPDX-License-Identifier: MIT
// limitcheck eval: the exact surface at one point.
#include <fmt/format.h>
#include <tbb/info.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/error.h"
#include "reference/surface/certified.h"
#include "verify/audit/at_point.h"
#include "verify/cli/audit.h"
#include "verify/cli/commands.h"
#include "verify/cli/mesh_options.h"
#include "verify/evidence/face_depths.h"

namespace limitcheck::cli {
namespace {

using reference::CertifiedEvaluator, reference::CertifiedPoint, reference::DerivativeLimit,
    reference::Enclosure, reference::Enclosure3, reference::Fate, reference::NormalKind, reference::Parameter,
    reference::Radius;

struct Request {
  std::string mesh, face, u, v;
  data::ReadOptions options;
  int digits = 16;
  bool in_float = false;
  reference::Weights weights = reference::Weights::kLoop;
  bool json = false;
  std::string subject, depths = "uniform";
  int depth = 4;
};
const Words<reference::Weights> kWeights{{"loop", reference::Weights::kLoop},
                                         {"warren", reference::Weights::kWarren}};

struct FaceAndCorner {
  std::int64_t face = 0;
  std::optional<int> corner;
};

// What was evaluated.
struct EvaluatedPoint {
  const Request& request;
  MeshScheme chosen;
  FaceAndCorner at;
  std::vector<std::string> parameters;  // exact: l0, l1, l2 of Loop's scheme, u, v of Catmull-Clark's
};

const Words<NormalKind> kNormalKinds{{"regular", NormalKind::kRegular},
                                     {"no_tangent_plane", NormalKind::kNoTangentPlane},
                                     {"fallback", NormalKind::kFallback},
                                     {"arbitrary", NormalKind::kArbitrary}};
const Words<Fate> kFates{
    {"value", Fate::kValue}, {"zero", Fate::kZero}, {"no_limit", Fate::kNoLimit}, {"grows", Fate::kGrows}};

nlohmann::ordered_json json_vector(const Enclosure3& v) {
  return {v[0].value, v[1].value, v[2].value};
}
nlohmann::ordered_json json_vector(const Enclosure& e) {
  return e.value;
}

Radius radius(const Enclosure3& v) {
  return std::max({v[0].radius, v[1].radius, v[2].radius});
}
Radius radius(const Enclosure& e) {
  return e.radius;
}

nlohmann::ordered_json json_of(const DerivativeLimit& limit) {
  return {{"fate", word_of(kFates, limit.fate)}, {"eigenvalue", limit.eigenvalue}, {"growth", limit.growth}};
}

// What is said beside derivatives of one order at an extraordinary corner, or in their place.
std::string reason(const DerivativeLimit& limit, bool along_boundary, bool degenerate) {
  if (limit.fate == Fate::kValue) return "";
  if (limit.fate == Fate::kZero)
    return fmt::format("  (zero at such a corner: {:.3g} times as much after each halving of the distance)",
                       limit.growth);
  if (degenerate) return "need not exist at this extraordinary corner, where the tangents degenerate";
  const std::string how =
      limit.fate == Fate::kGrows
          ? fmt::format("it grows {:.6g}-fold with each halving of the distance to this extraordinary corner",
                        limit.growth)
          : "it depends on the direction, or grows like the logarithm of the distance to this extraordinary "
            "corner";
  return fmt::format("does not exist in general: {} (eigenvalue {:.6g}){}", how, limit.eigenvalue,
                     along_boundary ? ", unless it runs along the boundary or crease" : "");
}

// A number, or, where no double of full precision is that small or large, a string of the same form.
nlohmann::ordered_json number(const Radius& r) {
  const double value = r.as_double();
  if (r.is_zero() || std::isnormal(value)) return value;
  if (r == Radius(std::numeric_limits<double>::infinity(), 0)) return nullptr;
  return r.to_string();
}

void print_json(const EvaluatedPoint& at, const CertifiedPoint& p) {
  nlohmann::ordered_json json, radii;
  json["mesh"] = at.request.mesh;
  json["scheme"] = name_of(at.chosen.scheme);
  json["faces_cut"] = at.chosen.cut;
  json["face"] = at.at.face;
  const bool loop = at.chosen.scheme == data::Scheme::kLoop;
  if (!loop) json["corner"] = at.at.corner ? nlohmann::ordered_json(*at.at.corner) : nlohmann::ordered_json();
  json[loop ? "barycentric" : "parameters"] = at.parameters;
  json["digits"] = at.request.digits;
  json["weights"] =
      loop ? nlohmann::ordered_json(word_of(kWeights, at.request.weights)) : nlohmann::ordered_json();
  const auto add = [&](const char* key, const auto& value) {
    json[key] = json_vector(value);
    radii[key] = number(radius(value));
  };
  const auto add_maybe = [&](const char* key, const auto& value) {
    if (value) return add(key, *value);
    json[key] = radii[key] = nullptr;
  };
  add("position", p.position);
  add("d1", p.d1);
  add("d2", p.d2);
  json["derivatives_exist"] = p.first_exist;
  json["second_derivatives_exist"] = p.d11.has_value();
  // At an extraordinary corner, which alone has tangents of its own.
  json["first_limit"] = p.t1 ? json_of(p.limits.first) : nlohmann::ordered_json();
  json["second_limit"] = p.t1 ? json_of(p.limits.second) : nlohmann::ordered_json();
  add_maybe("tangent1", p.t1);
  add_maybe("tangent2", p.t2);
  add("normal", p.normal);
  json["normal_kind"] = word_of(kNormalKinds, p.normal_kind);
  add_maybe("d11", p.d11);
  add_maybe("d12", p.d12);
  add_maybe("d22", p.d22);
  add_maybe("gaussian_curvature", p.gaussian_curvature);
  add_maybe("mean_curvature", p.mean_curvature);
  json["radius"] = number(p.radius);
  json["radii"] = radii;
  say("{}", dumped(json, 2));
}

void print_text(const EvaluatedPoint& at, const CertifiedPoint& p) {
  // How the derivatives by the two parameters are written.
  const bool loop = at.chosen.scheme == data::Scheme::kLoop;
  const std::string a = loop ? "l1" : "u", b = loop ? "l2" : "v";
  const std::string by_a = "d/d" + a, by_b = "d/d" + b;
  const std::string by_aa = fmt::format("d2/d{0}d{0}", a), by_ab = fmt::format("d2/d{}d{}", a, b),
                    by_bb = fmt::format("d2/d{0}d{0}", b);
  const auto within = [](const auto& value) {
    const Radius r = radius(value);
    return r.is_zero() ? "  exact" : "  +-" + r.to_string();
  };
  const auto line = [&](const std::string& what, const Enclosure3& v, const std::string& note = "") {
    say("{:<12}{}  {}  {}{}{}\n", what, v[0].value, v[1].value, v[2].value, within(v), note);
  };
  const auto absent = [](const std::string& what, const std::string& why) { say("{:<12}{}\n", what, why); };
  say("{}\n{} face {}{} at ({})\n", scheme_line({at.chosen}, at.request.options), at.request.mesh, at.at.face,
      at.at.corner ? fmt::format(" corner {}", *at.at.corner) : "", fmt::join(at.parameters, ", "));
  line("position", p.position);
  const bool degenerate = p.normal_kind == NormalKind::kFallback || p.normal_kind == NormalKind::kArbitrary;
  const std::string first = reason(p.limits.first, p.limits.along_boundary, degenerate),
                    second = reason(p.limits.second, p.limits.along_boundary, degenerate);
  if (p.first_exist) {
    line(by_a, p.d1, first);
    line(by_b, p.d2, first);
  } else {
    absent(by_a, first);
    absent(by_b, first);
  }
  if (p.t1) {
    line("tangent 1", *p.t1, "  (direction only)");
    line("tangent 2", *p.t2, "  (direction only)");
  }
  line("normal", p.normal,
       p.normal_kind == NormalKind::kNoTangentPlane ? "  (the surface has no tangent plane here)"
       : p.normal_kind == NormalKind::kFallback     ? "  (tangents degenerate: from the control faces)"
       : p.normal_kind == NormalKind::kArbitrary    ? "  (everything degenerate: arbitrary)"
                                                    : "");
  if (p.d11) {
    line(by_aa, *p.d11, second);
    line(by_ab, *p.d12, second);
    line(by_bb, *p.d22, second);
  } else {
    for (const std::string& what : {by_aa, by_ab, by_bb}) absent(what, second);
  }
  if (p.gaussian_curvature) {
    say("{:<12}{}{}\n", "Gaussian K", p.gaussian_curvature->value, within(*p.gaussian_curvature));
    say("{:<12}{}{}\n", "mean H", p.mean_curvature->value, within(*p.mean_curvature));
  }
  say("certified: every number is that near the truth; the largest radius of a vector is {}\n",
      p.radius.to_string(3));
}

// "17" or "17:2".
FaceAndCorner parse_face(const std::string& text) {
  FaceAndCorner result;
  int corner = 0;
  const int count = read_numbers(text, ':', result.face, corner);
  if (count == 0)
    throw data::ArgumentError(
        fmt::format("FACE is a number from 0 in file order, or FACE:CORNER, not '{}'", text));
  if (count == 2) result.corner = corner;
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
        "{}: face {} has {} corners, and U and V run over the quarter at one of them: FACE is {}:0 to {}:{}",
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

// "3/8", "0".
std::pair<std::uint32_t, std::uint32_t> fraction(const Parameter& parameter) {
  const std::string text = parameter.to_string();
  std::pair<std::uint32_t, std::uint32_t> result{0, 1};
  if (read_numbers(text, '/', result.first, result.second) == 0)
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

// What the subject delivers at the point and what it should, and how far they are apart. Returns the exit code: 1 if a
// vertex is beyond its bounds or not finite, or if vertices that should be equal have other bits. Throws
// data::ArgumentError: there is no such subject, or the point is no lattice point of the depth.
int show_difference(const Request& request, const FaceAndCorner& at, const OpenedMesh& opened,
                    const Parameter& u, const Parameter& v) {
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

CertifiedEvaluator evaluator(const Request& request, const OpenedMesh& opened) {
  if (opened.chosen.scheme == data::Scheme::kLoop) return CertifiedEvaluator(opened.mesh, request.weights);
  if (request.weights != reference::Weights::kLoop)
    throw data::ArgumentError("--weights warren is for Loop's scheme, and this is Catmull-Clark's");
  return {opened.mesh, opened.chosen.scheme};
}

int run(const Request& request) {
  const FaceAndCorner at = parse_face(request.face);
  OpenedMesh opened = open_control_mesh(request.mesh, request.options);
  if (!request.subject.empty()) {
    check_face(request, opened, at);
    return show_difference(request, at, opened, Parameter::parse(request.u), Parameter::parse(request.v));
  }
  if (request.in_float) round_to_float(opened.mesh);
  check_face(request, opened, at);
  const Parameter u = Parameter::parse(request.u), v = Parameter::parse(request.v);
  const reference::CertifiedPoint point =
      evaluator(request, opened)
          .evaluate(static_cast<int>(at.face), at.corner.value_or(0), u, v, request.digits);
  EvaluatedPoint evaluated{request, opened.chosen, at, {u.to_string(), v.to_string()}};
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
      ->add_option("U", request->u,
                   "Loop: l1, the weight of the face's second corner; Catmull-Clark: u, from the corner "
                   "towards the next. 1/3, 0.25, 1e-9")
      ->required();
  command
      ->add_option("V", request->v,
                   "Loop: l2, the weight of its third corner (the first has 1 - l1 - l2); Catmull-Clark: v, "
                   "from the corner towards the one before")
      ->required();
  add_mesh_options(*command, request->options);
  add_number(*command, "--digits", request->digits, 1, 10000, "Significant digits");
  add_words(*command, "--precision", request->in_float, {{"float", true}, {"double", false}},
            "Round the control mesh to it first, as a float tessellator sees it");
  add_words(*command, "--weights", request->weights, kWeights,
            "Loop's scheme: weights of interior vertices, Loop's or Warren's");
  command->add_flag("--json", request->json, "One JSON document, numbers as decimal strings");
  CLI::Option* subject =
      command->add_option("--subject", request->subject,
                          "Show what this subject (as `limitcheck audit` takes it) delivers at the point, "
                          "beside what it should; exit code 1 if it is wrong");
  add_number(*command, "--depth", request->depth, 0, 12,
             "With --subject: subdivision depth of every face, or of the deepest one")
      ->needs(subject);
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
