// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "verify/cli/eval/eval.h"

namespace limitcheck::cli {
namespace {

using reference::CertifiedPoint, reference::DerivativeLimit, reference::Enclosure, reference::Enclosure3,
    reference::Fate, reference::NormalKind, reference::Radius;

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

}  // namespace

void print_point_as_json(const EvaluatedPoint& at, const CertifiedPoint& p) {
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

void print_point(const EvaluatedPoint& at, const CertifiedPoint& p) {
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

}  // namespace limitcheck::cli
