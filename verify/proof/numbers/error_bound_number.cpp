// SPDX-License-Identifier: MIT
#include "verify/proof/numbers/error_bound_number.h"

#include <limits>
#include <stdexcept>

namespace limitcheck::verify {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Sums of up to 10^5 non-negative doubles, read upward: 10^5 * 2^-53 < 2^-36.
constexpr double kUpward = 1 + 0x1p-36;
constexpr double kUnderflow = 0x1p-150;
// Less than this of what it is the difference of, a weight is the rounding of weights.
constexpr double kCancelled = 0x1p-48;

struct Column {
  double range;
  bool error;
};
struct Table {
  RoundingModel model;
  double reach = 0;
  std::vector<Column> columns;
  bool open = false;
};
thread_local Table table;

double range(std::int32_t column) {
  return table.columns[column].range;
}
bool is_error(std::int32_t column) {
  return table.columns[column].error;
}
std::int32_t add_column(double size, bool error) {
  table.columns.push_back({size, error});
  return static_cast<std::int32_t>(table.columns.size()) - 1;
}

// What rounding a value of at most `bound` can cost.
double rounding(double bound, double unit) {
  if (!(bound > 0)) return 0;
  if (!std::isfinite(bound)) return kInfinity;
  const double power = std::ldexp(1., std::ilogb(bound));
  const double below = unit * power / 2;
  return std::fmin(unit * power, std::fmax(below, (bound - power) * kUpward)) + kUnderflow;
}

// The same of a constant that is known to `slop`: the distance to the nearest float changes no faster than
// the value.
double rounding_of_constant(double value, double slop) {
  const double nearest = static_cast<double>(static_cast<float>(value));
  return std::fmin(rounding(std::abs(value) + slop, table.model.unit),
                   (std::abs(nearest - value) + slop) * kUpward + kUnderflow);
}

// `size` and the largest that the chosen columns can add to it.
double upper_sum(const BoundForm& form, double size, bool values, bool errors) {
  for (const BoundForm::Term& t : form.terms)
    if (is_error(t.column) ? errors : values) size += std::abs(t.weight) * range(t.column);
  return size * kUpward;
}

void commit(BoundForm& form, double size, bool single) {
  if (size == 0) return;
  if (single)
    form.terms.push_back({add_column(size, true), 1});
  else
    form.slop += size;
}

// a x + b y with exact factors, and without the rounding of the operation. `magnitude`: the result's.
BoundForm combine(double a, const BoundForm& x, double b, const BoundForm& y, double& magnitude) {
  const Column* const columns = table.columns.data();
  BoundForm out;
  out.terms.resize(x.terms.size() + y.terms.size() + 1);
  BoundForm::Term* to = out.terms.data();
  double parts = 0, lost = 0, size = 0;
  const auto put = [&](std::int32_t column, double weight, double part) {
    const double range = columns[column].range;
    parts += part * range;
    if (std::abs(weight) <= kCancelled * part) {
      lost += std::abs(weight) * range;
    } else {
      size += std::abs(weight) * range;
      *to++ = {column, weight};
    }
  };
  const BoundForm::Term *i = x.terms.data(), *const i_end = i + x.terms.size();
  const BoundForm::Term *j = y.terms.data(), *const j_end = j + y.terms.size();
  while (i != i_end && j != j_end) {
    if (i->column < j->column) {
      const double w = a * i->weight;
      put(i++->column, w, std::abs(w));
    } else if (j->column < i->column) {
      const double w = b * j->weight;
      put(j++->column, w, std::abs(w));
    } else {
      const double v = a * i->weight, w = b * j->weight;
      put(i->column, v + w, std::abs(v) + std::abs(w));
      ++i, ++j;
    }
  }
  for (; i != i_end; ++i) put(i->column, a * i->weight, std::abs(a * i->weight));
  for (; j != j_end; ++j) put(j->column, b * j->weight, std::abs(b * j->weight));
  out.terms.resize(static_cast<std::size_t>(to - out.terms.data()));
  out.slop = kUpward * (lost + std::abs(a) * x.slop + std::abs(b) * y.slop + 0x1p-51 * parts);
  magnitude = kUpward * (size + out.slop);
  return out;
}

bool is_power_of_two(double x) {
  int exponent = 0;
  return x != 0 && std::abs(std::frexp(x, &exponent)) == .5;
}

struct Constant {
  double value, error, doubt;  // computed: within `error` of the value; true: within `doubt`
  bool exact() const { return error == 0; }
};
Constant as_constant(const BoundForm& form) {
  const double value = form.constant();
  const double error = form.terms.empty() ? form.slop : (form.error() - form.slop) * kUpward;
  return {value, error, form.slop};
}

// Whether b is a constant, too, and better known: then a's errors are kept apart, as they may leave again. The
// middle of a straight side, seen from an origin there, is such a constant: 0, and the error of the origin.
bool is_worse_factor(const BoundForm& a, const BoundForm& b) {
  return b.is_constant() && as_constant(b).error < as_constant(a).error;
}

// k x + sign c without rounding; what the error of k adds is in `extra`.
BoundForm times(const Constant& k, const BoundForm& x, double sign, const BoundForm& c, double& magnitude,
                double& extra) {
  BoundForm out = combine(k.value, x, sign, c, magnitude);
  extra = 0;
  if (k.exact()) return out;
  const double size = x.magnitude(), doubt = kUpward * k.doubt * (x.slop + size);
  out.slop = kUpward * (out.slop + doubt);
  extra = kUpward * k.error * size;
  magnitude = kUpward * (magnitude + doubt + extra);
  return out;
}

}  // namespace

BoundScope::BoundScope(double reach, const RoundingModel& model) {
  if (table.open) throw std::logic_error("error bounds: a scope within a scope");
  table = {model, reach, {{1, false}}, true};
}
BoundScope::~BoundScope() {
  table.columns.clear();
  table.open = false;
}

bool BoundForm::bounded() const {
  return std::isfinite(slop);
}
bool BoundForm::is_constant() const {
  for (const Term& t : terms)
    if (t.column != 0 && !is_error(t.column)) return false;
  return true;
}
double BoundForm::constant() const {
  return !terms.empty() && terms[0].column == 0 ? terms[0].weight : 0;
}
double BoundForm::magnitude() const {
  return upper_sum(*this, slop, true, true);
}
double BoundForm::true_magnitude() const {
  return upper_sum(*this, slop, true, false);
}
double BoundForm::error() const {
  return upper_sum(*this, 2 * slop, false, true);
}

BoundForm BoundForm::variable() {
  return {{{add_column(table.reach, false), 1}}, 0};
}
BoundForm BoundForm::exact(double value) {
  BoundForm form;
  if (value != 0) form.terms.push_back({0, value});
  return form;
}
BoundForm BoundForm::unbounded() {
  return {{}, kInfinity};
}
BoundForm BoundForm::rounded_constant(double value, double doubt, bool single, bool is_exact) {
  BoundForm form = exact(value);
  if (is_exact) return form;
  form.slop = doubt + 0x1p-53 * std::abs(value);
  if (single && table.model.constants) commit(form, rounding_of_constant(value, form.slop), true);
  return form;
}

BoundForm BoundForm::sum(const BoundForm& a, double sign, const BoundForm& b, bool single) {
  if (!a.bounded() || !b.bounded()) return unbounded();
  if (b.is_zero()) return a;
  if (a.is_zero()) return sign > 0 ? b : negated(b);
  double magnitude = 0;
  BoundForm out = combine(1, a, sign, b, magnitude);
  if (table.model.sums)
    commit(out, rounding(magnitude, single ? table.model.unit : table.model.wide_unit), single);
  return out;
}

BoundForm BoundForm::product(const BoundForm& a, const BoundForm& b, bool single) {
  if (!a.bounded() || !b.bounded()) return unbounded();
  if (a.is_zero() || b.is_zero()) return {};
  if (!a.is_constant()) return b.is_constant() ? product(b, a, single) : unbounded();
  if (is_worse_factor(a, b)) return product(b, a, single);
  const Constant k = as_constant(a);
  if (k.exact() && is_power_of_two(k.value)) {
    BoundForm out = b;
    for (Term& t : out.terms) t.weight *= k.value;
    out.slop = std::abs(k.value) * b.slop + (std::abs(k.value) == 1 ? 0 : kUnderflow);
    return out;
  }
  double magnitude = 0, extra = 0;
  BoundForm out = times(k, b, 1, {}, magnitude, extra);
  if (table.model.products) extra += rounding(magnitude, single ? table.model.unit : table.model.wide_unit);
  commit(out, extra, single);
  return out;
}

BoundForm BoundForm::quotient(const BoundForm& a, const BoundForm& b, bool single) {
  if (!a.bounded() || !b.bounded() || !a.is_constant() || !b.is_constant()) return unbounded();
  const Constant p = as_constant(a), q = as_constant(b);
  const double least = std::abs(q.value) - q.error - q.doubt;
  if (!(least > 0)) return unbounded();
  BoundForm out = exact(p.value / q.value);
  const double ratio = std::abs(p.value / q.value);
  const double known = p.exact() && q.exact() && is_power_of_two(q.value) ? 0 : 0x1p-52 * ratio;
  out.slop = kUpward * (known + (p.doubt + ratio * q.doubt) / least);
  const double extra = kUpward * (p.error + ratio * q.error) / least;
  if (known == 0 && extra == 0) return out;
  commit(out,
         extra + (single && extra == 0
                      ? rounding_of_constant(out.constant(), out.slop)
                      : rounding(out.magnitude() + extra, single ? table.model.unit : table.model.wide_unit)),
         single);
  return out;
}

BoundForm BoundForm::fused(const BoundForm& a, const BoundForm& b, double sign, const BoundForm& c) {
  if (!a.bounded() || !b.bounded() || !c.bounded()) return unbounded();
  if (a.is_zero() || b.is_zero()) return sign > 0 ? c : negated(c);
  if (!a.is_constant()) return b.is_constant() ? fused(b, a, sign, c) : unbounded();
  if (is_worse_factor(a, b)) return fused(b, a, sign, c);
  const Constant k = as_constant(a);
  if (k.exact() && is_power_of_two(k.value) && c.is_zero()) return product(a, b, true);
  double magnitude = 0, extra = 0;
  BoundForm out = times(k, b, sign, c, magnitude, extra);
  if (table.model.fused) extra += rounding(magnitude, table.model.unit);
  commit(out, extra, true);
  return out;
}

BoundForm BoundForm::negated(BoundForm a) {
  for (Term& t : a.terms) t.weight = -t.weight;
  return a;
}

BoundForm BoundForm::narrowed(BoundForm a) {
  if (!a.bounded() || !table.model.narrowing) return a;
  const bool constant = a.is_constant();
  if (constant && a.error() == 0 && static_cast<float>(a.constant()) == a.constant()) return a;
  commit(a, constant ? rounding_of_constant(a.constant(), a.slop) : rounding(a.magnitude(), table.model.unit),
         true);
  return a;
}

}  // namespace limitcheck::verify
