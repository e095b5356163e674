// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

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

/// A vector of a point, of as many components as were evaluated; or one number.
using Vector = std::vector<Enclosure>;

const Enclosure3& plain(const Enclosure3& v) {
  return v;
}
const Enclosure3& plain(const std::optional<Enclosure3>& v) {
  return *v;
}
template <class Member>
Vector vector_of(const EvaluatedPoint& at, Member member) {
  Vector result;
  for (const CertifiedPoint& p : at.points)
    for (const Enclosure& x : plain(p.*member))
      if (result.size() < at.components) result.push_back(x);
  return result;
}

Radius radius(const Vector& v) {
  Radius largest;
  for (const Enclosure& x : v) largest = std::max(largest, x.radius);
  return largest;
}
Radius radius_of_all(const EvaluatedPoint& at) {
  Radius largest;
  for (const CertifiedPoint& p : at.points) largest = std::max(largest, p.radius);
  return largest;
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

void print_point_as_json(const EvaluatedPoint& at) {
  const CertifiedPoint& p = at.points[0];
  const bool channel = !at.request.channel.empty();
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
  if (channel) {
    json["channel"] = at.request.channel;
    json["channel_rule"] = data::kChannelRules[static_cast<std::size_t>(at.rule)];
  }
  const auto add = [&](const char* key, const Vector& value) {
    json[key] = nlohmann::ordered_json::array();
    for (const Enclosure& x : value) json[key].push_back(x.value);
    radii[key] = number(radius(value));
  };
  const auto add_maybe = [&](const char* key, std::optional<Enclosure3> CertifiedPoint::*member) {
    if (p.*member) return add(key, vector_of(at, member));
    json[key] = radii[key] = nullptr;
  };
  const auto add_number = [&](const char* key, const std::optional<Enclosure>& value) {
    json[key] = value ? nlohmann::ordered_json(value->value) : nlohmann::ordered_json();
    radii[key] = value ? number(value->radius) : nlohmann::ordered_json();
  };
  add("position", vector_of(at, &CertifiedPoint::position));
  add("d1", vector_of(at, &CertifiedPoint::d1));
  add("d2", vector_of(at, &CertifiedPoint::d2));
  json["derivatives_exist"] = p.first_exist;
  json["second_derivatives_exist"] = p.d11.has_value();
  // At an extraordinary corner, which alone has tangents of its own.
  json["first_limit"] = p.t1 ? json_of(p.limits.first) : nlohmann::ordered_json();
  json["second_limit"] = p.t1 ? json_of(p.limits.second) : nlohmann::ordered_json();
  if (!channel) {
    add_maybe("tangent1", &CertifiedPoint::t1);
    add_maybe("tangent2", &CertifiedPoint::t2);
    add("normal", vector_of(at, &CertifiedPoint::normal));
    json["normal_kind"] = word_of(kNormalKinds, p.normal_kind);
  }
  add_maybe("d11", &CertifiedPoint::d11);
  add_maybe("d12", &CertifiedPoint::d12);
  add_maybe("d22", &CertifiedPoint::d22);
  if (!channel) {
    add_number("gaussian_curvature", p.gaussian_curvature);
    add_number("mean_curvature", p.mean_curvature);
  }
  json["radius"] = number(radius_of_all(at));
  json["radii"] = radii;
  say("{}", dumped(json, 2));
}

void print_point(const EvaluatedPoint& at) {
  const CertifiedPoint& p = at.points[0];
  const bool channel = !at.request.channel.empty();
  // How the derivatives by the two parameters are written.
  const bool loop = at.chosen.scheme == data::Scheme::kLoop;
  const std::string a = loop ? "l1" : "u", b = loop ? "l2" : "v";
  const std::string by_a = "d/d" + a, by_b = "d/d" + b;
  const std::string by_aa = fmt::format("d2/d{0}d{0}", a), by_ab = fmt::format("d2/d{}d{}", a, b),
                    by_bb = fmt::format("d2/d{0}d{0}", b);
  const auto line = [&](const std::string& what, const Vector& v, const std::string& note = "") {
    const Radius r = radius(v);
    std::vector<std::string> values;
    for (const Enclosure& x : v) values.push_back(x.value);
    say("{:<12}{}{}{}\n", what, fmt::join(values, "  "), r.is_zero() ? "  exact" : "  +-" + r.to_string(),
        note);
  };
  const auto vector = [&](const std::string& what, auto member, const std::string& note = "") {
    line(what, vector_of(at, member), note);
  };
  const auto absent = [](const std::string& what, const std::string& why) { say("{:<12}{}\n", what, why); };
  say("{}\n{} face {}{} at ({})\n", scheme_line({at.chosen}, at.request.options), at.request.mesh, at.at.face,
      at.at.corner ? fmt::format(" corner {}", *at.at.corner) : "", fmt::join(at.parameters, ", "));
  if (channel)
    say("channel {} by the rule {}\n", at.request.channel,
        data::kChannelRules[static_cast<std::size_t>(at.rule)]);
  vector(channel ? "value" : "position", &CertifiedPoint::position);
  const bool degenerate =
      !channel && (p.normal_kind == NormalKind::kFallback || p.normal_kind == NormalKind::kArbitrary);
  const std::string first = reason(p.limits.first, p.limits.along_boundary, degenerate),
                    second = reason(p.limits.second, p.limits.along_boundary, degenerate);
  if (p.first_exist) {
    vector(by_a, &CertifiedPoint::d1, first);
    vector(by_b, &CertifiedPoint::d2, first);
  } else {
    absent(by_a, first);
    absent(by_b, first);
  }
  if (!channel) {
    if (p.t1) {
      vector("tangent 1", &CertifiedPoint::t1, "  (direction only)");
      vector("tangent 2", &CertifiedPoint::t2, "  (direction only)");
    }
    vector("normal", &CertifiedPoint::normal,
           p.normal_kind == NormalKind::kNoTangentPlane ? "  (the surface has no tangent plane here)"
           : p.normal_kind == NormalKind::kFallback     ? "  (tangents degenerate: from the control faces)"
           : p.normal_kind == NormalKind::kArbitrary    ? "  (everything degenerate: arbitrary)"
                                                        : "");
  }
  if (p.d11) {
    vector(by_aa, &CertifiedPoint::d11, second);
    vector(by_ab, &CertifiedPoint::d12, second);
    vector(by_bb, &CertifiedPoint::d22, second);
  } else {
    for (const std::string& what : {by_aa, by_ab, by_bb}) absent(what, second);
  }
  if (p.gaussian_curvature && !channel) {
    line("Gaussian K", {*p.gaussian_curvature});
    line("mean H", {*p.mean_curvature});
  }
  say("certified: every number is that near the truth; the largest radius of a vector is {}\n",
      radius_of_all(at).to_string(3));
}

}  // namespace limitcheck::cli
