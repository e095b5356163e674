// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <tbb/info.h>

#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "data/error.h"
#include "data/numeral.h"
#include "verify/audit/at_point.h"
#include "verify/cli/audit.h"
#include "verify/cli/eval/eval.h"
#include "verify/evidence/audit_case.h"

namespace limitcheck::cli {
namespace {

using reference::Parameter;

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

}  // namespace

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

}  // namespace limitcheck::cli
