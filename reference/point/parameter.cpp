// SPDX-License-Identifier: MIT
#include "reference/point/parameter.h"

#include "data/error.h"
#include "data/numeral.h"
#include "reference/point/parameter_exact.h"

namespace limitcheck::reference {
Parameter Parameter::fraction(std::int64_t numerator, std::int64_t denominator) {
  if (denominator == 0) throw data::ArgumentError("denominator is zero");
  Parameter p(static_cast<double>(numerator) / static_cast<double>(denominator));
  Rational value = Rational(numerator) / Rational(denominator);
  p.exact_ = std::make_shared<RationalParameter>(RationalParameter{std::move(value)});
  return p;
}

Parameter Parameter::parse(std::string_view text) {
  if (text.size() > 10000)
    throw data::ArgumentError("'" + std::string(text.substr(0, 60)) +
                              "' ... is longer than 10000 characters");
  auto value = data::parse<Rational>(text);
  Parameter p(value.convert_to<double>());
  p.exact_ = std::make_shared<RationalParameter>(RationalParameter{std::move(value)});
  return p;
}

Parameter Parameter::complement(const Parameter& l1, const Parameter& l2) {
  Rational value = 1 - exact_value(l1) - exact_value(l2);
  Parameter p(value.convert_to<double>());
  p.exact_ = std::make_shared<RationalParameter>(RationalParameter{std::move(value)});
  return p;
}

std::string Parameter::to_string() const {
  return exact_value(*this).str();
}

}  // namespace limitcheck::reference
