// SPDX-License-Identifier: MIT
// The fields of rows as JSON: described once for each type, in a visit_fields(row, visit), for all that is written and
// read.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "data/untrusted_json.h"
#include "verify/row/result.h"

namespace limitcheck::verify {

/// Of the parameter of a visit_fields: a T, const or not.
template <class T, class Of>
concept Is = std::same_as<std::remove_const_t<T>, Of>;

/// Calls visit(name, member) for each member.
template <class Visit, class... Member>
void visit_each(Visit& visit, const char* const (&names)[sizeof...(Member)], Member&... members) {
  std::size_t k = 0;
  (visit(names[k++], members), ...);
}
/// Of members that a report does not show.
template <class Visit, class... Member>
void visit_each(Visit& visit, Member&... members) {
  (visit("", members), ...);
}

inline std::string_view word(data::Scheme scheme) {
  return data::name_of(scheme);
}
inline std::string_view word(lc_precision precision) {
  return precision == LC_FLOAT32 ? "float" : "double";
}
inline std::string_view word(reference::Weights weights) {
  return weights == reference::Weights::kWarren ? "warren" : "loop";
}
/// The last enumerator of each type.
inline constexpr std::tuple kLast{Status::kError,     Origin::kHost,
                                  PlaceKind::kCorner, data::Scheme::kCatmullClark,
                                  LC_FLOAT64,         reference::Weights::kWarren};

/// JSON has no number that is not finite: those are the words "nan", "inf", "-inf".
inline nlohmann::ordered_json number(double x) {
  using Json = nlohmann::ordered_json;
  return std::isnan(x) ? Json("nan") : std::isinf(x) ? Json(x > 0 ? "inf" : "-inf") : Json(x);
}
inline double number_of(const nlohmann::json& json) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (json == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (json == "inf" || json == "-inf") return json == "inf" ? kInfinity : -kInfinity;
  return json.get<double>();
}

/// The number of an enumerator, or its word.
template <class E>
E enumerator(const nlohmann::json& json) {
  for (int k = 0; k <= static_cast<int>(std::get<E>(kLast)); ++k)
    if (json.is_string() ? json.get_ref<const std::string&>() == word(static_cast<E>(k)) : json == k)
      return static_cast<E>(k);
  throw data::ArgumentError("no such kind: " + json.dump());
}

template <class T>
inline constexpr bool kIsList = false;
template <class T>
constexpr bool kIsList<std::vector<T>> = true;
template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
constexpr bool kIsOptional<std::optional<T>> = true;
/// Sees whether there is a visit_fields.
struct Nothing {
  template <class Member>
  void operator()(const char*, Member&) {}
};
template <class T>
constexpr bool kHasFields = requires(T& row) {
  visit_fields(row, Nothing{});
};

/// So that nothing is lost: a row is the array of its fields.
template <class T>
nlohmann::json kept(const T& x) {
  if constexpr (std::is_floating_point_v<T>) {
    return number(x);
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<int>(x);
  } else if constexpr (kIsOptional<T>) {
    return x ? kept(*x) : nlohmann::json(nullptr);
  } else if constexpr (kIsList<T>) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& element : x) list.push_back(kept(element));
    return list;
  } else if constexpr (kHasFields<T>) {
    nlohmann::json list = nlohmann::json::array();
    visit_fields(x, [&](const char*, const auto& member) { list.push_back(kept(member)); });
    return list;
  } else {
    return x;
  }
}

/// Both again: of an object the fields that it has, of an array all.
template <class T>
void read(const nlohmann::json& json, T& x) {
  if constexpr (std::is_floating_point_v<T>) {
    x = number_of(json);
  } else if constexpr (std::is_enum_v<T>) {
    x = enumerator<T>(json);
  } else if constexpr (kIsOptional<T>) {
    x.reset();
    if (!json.is_null()) read(json, x.emplace());
  } else if constexpr (kIsList<T>) {
    x.clear();
    for (const nlohmann::json& element : json) read(element, x.emplace_back());
  } else if constexpr (kHasFields<T>) {
    std::size_t k = 0;
    visit_fields(x, [&](const char* name, auto& member) {
      if (json.is_array())
        read(json.at(k++), member);
      else if (const auto field = json.find(name); field != json.end() && !field->is_null())
        read(*field, member);
    });
  } else {
    data::read_value(json, x);
  }
}

}  // namespace limitcheck::verify
