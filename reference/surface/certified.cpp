// SPDX-License-Identifier: MIT
#include "reference/surface/certified.h"

#include <flint/flint.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <utility>

#include "data/cut_out.h"
#include "data/error.h"
#include "reference/catmull_clark/stam.h"
#include "reference/loop/stam.h"
#include "reference/mesh/sharpness.h"
#include "reference/mesh/support.h"
#include "reference/point/parameter_exact.h"
#include "reference/surface/near_part.h"

namespace limitcheck::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// More than the roundings of a few operations in double.
constexpr double kUpward = 1 + 1e-14;

SurfacePoint<Ball> evaluate_in_balls(const PartWithPoint& part, data::Scheme scheme, Weights weights) {
  if (scheme == data::Scheme::kCatmullClark)
    return catmull_clark::StamEvaluator<Ball>(part.faces, part.positions(), part.tags, part.valences)
        .evaluate(0, part.corner, part.u, part.v);
  if (part.corner != 0) throw data::ArgumentError("a triangle has one domain, with corner 0");
  return StamEvaluator<Ball>(part.positions(), data::Triangles(part.faces).to_vector(), weights, part.tags,
                             part.valences)
      .evaluate(0, part.u, part.v);
}

/// Largest decimal exponent e with 10^e <= the magnitude the ball may have; very small for an exact zero.
long decimal_exponent(const Ball& a) {
  const long binary = NumberTraits<Ball>::exponent(a);
  return binary == kZeroExponent
             ? std::numeric_limits<int>::min()
             : static_cast<long>(std::floor(static_cast<double>(binary) * std::log10(2.0)));
}

/// 10^e as a ball
Ball power_of_ten(long e) {
  Ball result(10);
  arb_pow_ui(result.raw(), result.raw(), static_cast<ulong>(std::labs(e)), Ball::precision());
  return e < 0 ? Ball(1) / result : result;
}

/// Upper bound of |a|. (mag_get_d ends at 2^+-1000.)
Radius magnitude(const Ball& a) {
  Ball bound;
  arb_get_mag(arb_radref(bound.raw()), a.raw());
  arf_set_mag(arb_midref(bound.raw()), arb_radref(bound.raw()));
  mag_zero(arb_radref(bound.raw()));
  if (arf_is_inf(arb_midref(bound.raw())) != 0) return {std::numeric_limits<double>::infinity(), 0};
  const long exponent = decimal_exponent(bound);
  if (exponent == std::numeric_limits<int>::min()) return {};
  const Ball digits = bound * power_of_ten(-exponent);  // between .1 and 100
  return {arf_get_d(arb_midref(digits.raw()), ARF_RND_UP) * (1 + 1e-9), exponent};
}

/// The ball's midpoint rounded to a multiple of 10^-decimals (10^-decimals may exceed 1), with a radius that
/// covers both.
Enclosure print(const Ball& a, long decimals) {
  const long saved = Ball::precision();
  Ball::precision() = saved + 64;
  Ball middle;
  arf_set(arb_midref(middle.raw()), arb_midref(a.raw()));
  const Ball shifted = middle * power_of_ten(decimals);
  fmpz_t mantissa;
  fmpz_init(mantissa);
  arf_get_fmpz(mantissa, arb_midref(shifted.raw()), ARF_RND_NEAR);
  Ball printed;
  arb_set_fmpz(printed.raw(), mantissa);
  const Ball difference = a - printed * power_of_ten(-decimals);  // holds every (true - printed)
  Enclosure result{"0", magnitude(difference)};

  // mantissa 10^-decimals as plain decimals, or with an exponent where that would be long.
  char* raw = fmpz_get_str(nullptr, 10, mantissa);
  std::string digits(raw);
  flint_free(raw);
  fmpz_clear(mantissa);
  Ball::precision() = saved;
  const bool negative = digits.front() == '-';
  if (negative) digits.erase(0, 1);
  if (digits == "0") return result;
  const long exponent = static_cast<long>(digits.size()) - 1 - decimals;
  if (exponent < -6 || decimals < 0) {
    std::string fraction = digits.substr(1);
    result.value =
        digits.substr(0, 1) + (fraction.empty() ? "" : "." + fraction) + "e" + std::to_string(exponent);
  } else if (decimals == 0) {
    result.value = digits;
  } else {
    if (exponent < 0) digits = std::string(-exponent, '0') + digits;
    result.value = digits.substr(0, digits.size() - decimals) + "." + digits.substr(digits.size() - decimals);
  }
  if (negative) result.value = std::string(1, '-').append(result.value);
  return result;
}

/// Prints a group of numbers to `digits` significant digits of the largest of them, or says that
/// it cannot yet.
class Printer {
 public:
  Printer(int digits, bool last_chance) : digits_(digits), last_chance_(last_chance) {}

  template <std::size_t Size>
  std::array<Enclosure, Size> operator()(const std::array<const Ball*, Size>& group) {
    long exponent = std::numeric_limits<int>::min();
    Radius worst;
    std::array<Enclosure, Size> result;
    for (const Ball* a : group) {
      if (arb_is_finite(a->raw()) == 0) {  // a division by something not told from zero
        enough_ = false;
        const Radius infinite(std::numeric_limits<double>::infinity(), 0);
        result.fill({"0", infinite});
        if (last_chance_) largest_ = infinite;
        return result;
      }
      exponent = std::max(exponent, decimal_exponent(*a));
    }
    if (exponent == std::numeric_limits<int>::min()) {
      result.fill({"0", {}});
      return result;
    }
    const long decimals = digits_ - 1 - exponent;
    for (std::size_t i = 0; i < Size; ++i) {
      const Ball unit = power_of_ten(-decimals);
      Ball radius;
      arf_set_mag(arb_midref(radius.raw()), arb_radref(group[i]->raw()));
      if (!(radius * Ball(8) < unit)) {
        enough_ = false;
        if (!last_chance_) return result;
        result[i] = {"0", magnitude(*group[i])};  // not told from zero: the radius says how far
      } else {
        result[i] = print(*group[i], decimals);
      }
      worst = std::max(worst, result[i].radius);
    }
    largest_ = std::max(largest_, worst);
    return result;
  }
  Enclosure3 operator()(const Vec3<Ball>& v) { return (*this)(std::array<const Ball*, 3>{&v.x, &v.y, &v.z}); }
  Enclosure operator()(const Ball& a) { return (*this)(std::array<const Ball*, 1>{&a})[0]; }

  bool enough() const { return enough_; }
  const Radius& largest() const { return largest_; }

 private:
  int digits_;
  bool last_chance_;
  bool enough_ = true;
  Radius largest_;
};

}  // namespace

Radius::Radius(double digits, long exponent) {
  if (digits == 0) return;
  if (!(digits < kInfinity)) {
    exponent_ = 1L << 40;
    digits_ = kInfinity;
    return;
  }
  for (; digits >= 10; ++exponent) digits = digits / 10 * kUpward;
  for (; digits < 1; --exponent) digits = digits * 10 * kUpward;
  if (digits >= 10) digits /= 10, ++exponent;  // 1 at last, and more by rounding upwards
  exponent_ = exponent;
  digits_ = digits;
}

double Radius::as_double() const {
  if (digits_ == 0 || digits_ == kInfinity) return digits_;
  if (exponent_ < -400) return std::numeric_limits<double>::denorm_min();
  if (exponent_ > 400) return kInfinity;
  return std::nextafter(std::strtod(to_string(17).c_str(), nullptr), kInfinity);
}

std::string Radius::to_string(int digits) const {
  if (digits_ == 0) return "0";
  if (digits_ == kInfinity) return "inf";
  const double unit = std::pow(10.0, digits - 1);
  double shown = digits < 17 ? std::ceil(digits_ * unit) / unit : digits_;
  long exponent = exponent_;
  if (shown >= 10) shown /= 10, ++exponent;
  char text[64];
  std::snprintf(text, sizeof text, "%.*fe%+03ld", digits - 1, shown, exponent);
  return text;
}

struct CertifiedEvaluator::Data {
  using Position = std::array<Rational, 3>;
  Topology topology;
  std::function<Position(std::int32_t)> position;                   // of a vertex
  std::function<std::array<double, 3>(std::int32_t)> in_doubles{};  // none if they were given as text
  data::Scheme scheme;
  Weights weights;
  std::optional<Sharpness> sharpness{};
  data::TriangleRule triangles = data::TriangleRule::kCatmark;

  Data(Topology mesh, std::function<Position(std::int32_t)> exact, data::Scheme by, Weights with,
       const SharpTags& tags)
      : topology(std::move(mesh)), position(std::move(exact)), scheme(by), weights(with) {
    if (tags.empty()) return;
    sharpness.emplace(topology, tags);
    triangles = tags.triangles;
  }
  /// The tags of some faces, `part` of the mesh.
  SharpTags tags_of(const data::CutOut& part, const std::vector<std::int32_t>& faces) const {
    if (!sharpness) return {};
    const Topology local(part.vertices.size(), part.faces);
    SharpTags tags = sharpness->of_part(topology, local, faces, part.vertices).tags(local);
    tags.triangles = triangles;
    return tags;
  }

  static std::unique_ptr<const Data> of(const data::ControlMesh& mesh, data::Scheme scheme, Weights weights) {
    for (const auto& p : mesh.positions)
      for (const double x : p)
        if (!std::isfinite(x)) throw data::ArgumentError("control mesh: a coordinate is not finite");
    if (scheme == data::Scheme::kLoop) (void)triangles_of(mesh);  // or it throws
    const auto in_doubles = [positions =
                                 std::make_shared<const std::vector<std::array<double, 3>>>(mesh.positions)](
                                std::int32_t v) { return (*positions)[static_cast<std::size_t>(v)]; };
    const auto position = [in_doubles](std::int32_t v) {
      const auto p = in_doubles(v);
      return Position{Rational(p[0]), Rational(p[1]), Rational(p[2])};
    };
    auto data = std::make_unique<Data>(Topology(mesh.positions.size(), mesh.faces), position, scheme, weights,
                                       mesh.sharpness);
    data->in_doubles = in_doubles;
    return data;
  }
  static std::unique_ptr<const Data> of(const std::vector<std::array<std::string, 3>>& positions,
                                        data::Faces faces, data::Scheme scheme, Weights weights,
                                        const SharpTags& tags = {}) {
    std::vector<Position> exact;
    for (const auto& p : positions)
      exact.push_back({exact_value(Parameter::parse(p[0])), exact_value(Parameter::parse(p[1])),
                       exact_value(Parameter::parse(p[2]))});
    const auto position = [exact = std::move(exact)](std::int32_t v) { return exact[v]; };
    return std::make_unique<const Data>(Topology(positions.size(), std::move(faces)), position, scheme,
                                        weights, tags);
  }
};

CertifiedEvaluator::CertifiedEvaluator(const data::ControlMesh& mesh, Weights weights)
    : data_(Data::of(mesh, data::Scheme::kLoop, weights)) {}
CertifiedEvaluator::CertifiedEvaluator(const data::ControlMesh& mesh, data::Scheme scheme)
    : data_(Data::of(mesh, scheme, Weights::kLoop)) {}
CertifiedEvaluator::CertifiedEvaluator(const std::vector<std::array<std::string, 3>>& positions,
                                       const std::vector<Triangle>& triangles, Weights weights)
    : data_(Data::of(positions, data::Faces(triangles), data::Scheme::kLoop, weights)) {}
CertifiedEvaluator::CertifiedEvaluator(const std::vector<std::array<std::string, 3>>& positions,
                                       const data::Faces& faces, data::Scheme scheme, const SharpTags& tags)
    : data_(Data::of(positions, faces, scheme, Weights::kLoop, tags)) {}

CertifiedEvaluator::~CertifiedEvaluator() = default;

int& CertifiedEvaluator::whole_up_to() {
  static int faces = 1000;
  return faces;
}

CertifiedPoint CertifiedEvaluator::evaluate(int face, const Parameter& l1, const Parameter& l2,
                                            int digits) const {
  return evaluate(face, 0, l1, l2, digits);
}

CertifiedPoint CertifiedEvaluator::evaluate(int face, int corner, const Parameter& l1, const Parameter& l2,
                                            int digits, Wanted wanted) const {
  if (face < 0 || static_cast<std::size_t>(face) >= data_->topology.faces().size())
    throw data::ArgumentError("no face " + std::to_string(face));
  std::optional<NearPart> part;
  if (data_->in_doubles && !data_->sharpness)
    part = near_part(data_->topology, data_->in_doubles, data_->scheme, face, corner, l1, l2, whole_up_to());
  SharpTags tags;
  if (!part) {
    const std::vector<std::int32_t> near = support_of(
        {face}, data_->topology, data_->sharpness ? data_->sharpness->creasing() : data::Creasing::kUniform);
    const data::CutOut local = data::cut_out(data_->topology.faces(), near);
    tags = data_->tags_of(local, near);
    part = NearPart{local.faces, {}, {}, corner};
    for (const std::int32_t v : local.vertices) part->positions.push_back(data_->position(v));
  }
  const auto positions = [exact = std::move(part->positions)] {
    std::vector<Vec3<Ball>> result;
    for (const auto& p : exact)
      result.push_back({NumberTraits<Ball>::from_rational(p[0]), NumberTraits<Ball>::from_rational(p[1]),
                        NumberTraits<Ball>::from_rational(p[2])});
    return result;
  };
  return certify({part->faces, tags, part->valences, part->corner, l1, l2, 1, positions}, data_->scheme,
                 data_->weights, digits, wanted);
}

CertifiedPoint certify(const PartWithPoint& part, data::Scheme scheme, Weights weights, int digits,
                       Wanted wanted) {
  if (digits < 1 || digits > 10000) throw data::ArgumentError("digits must be 1..10000");
  const long first = static_cast<long>(digits * 3.33) + 64;
  // Next to a corner quantities fall and rise with powers of the distance, which costs that many bits: the
  // curvatures take the eighth power. The distance is no smaller than the parameters' digits allow.
  const long nearness = 8 * 4 * static_cast<long>(part.u.to_string().size() + part.v.to_string().size());
  struct Restore {
    long saved = Ball::precision();
    ~Restore() { Ball::precision() = saved; }
  } restore;
  for (long bits = first;; bits *= 2) {
    Ball::precision() = bits;
    const bool last_chance = bits >= 8 * first + nearness;
    SurfacePoint<Ball> s = evaluate_in_balls(part, scheme, weights);
    if (part.factor != 1) {
      const Ball factor = NumberTraits<Ball>::from_rational(part.factor), squared = factor * factor;
      for (Vec3<Ball>* d : {&s.d1, &s.d2}) *d *= factor;
      for (Vec3<Ball>* d : {&s.d11, &s.d12, &s.d22}) *d *= squared;
    }
    const bool has_normal =
        s.normal_kind == NormalKind::kRegular || s.normal_kind == NormalKind::kNoTangentPlane;
    const bool all = wanted == Wanted::kAll;
    if (all && !has_normal && !last_chance) continue;  // perhaps only not yet told from zero

    Printer print(digits, last_chance), print_curvature(digits, last_chance);
    CertifiedPoint result;
    result.position = print(s.position);
    result.d1 = print(s.d1);
    result.d2 = print(s.d2);
    if (all) result.normal = print(s.normal);
    result.normal_kind = s.normal_kind;
    result.first_exist = s.first_exist;
    result.limits = s.limits;
    if (s.at_corner) {
      result.t1 = print(s.t1);
      result.t2 = print(s.t2);
    }
    if (s.second_exist) {
      result.d11 = print(s.d11);
      result.d12 = print(s.d12);
      result.d22 = print(s.d22);
      if (all && has_normal && !s.at_corner) {
        const Ball e = dot(s.d1, s.d1), f = dot(s.d1, s.d2), g = dot(s.d2, s.d2);
        const Ball l = dot(s.d11, s.normal), m = dot(s.d12, s.normal), n = dot(s.d22, s.normal);
        const Ball area = Ball(1) / (e * g - f * f);
        result.gaussian_curvature = print_curvature((l * n - m * m) * area);
        result.mean_curvature =
            print_curvature((Ball(2) * f * m - e * n - g * l) * area * (Ball(1) / Ball(2)));
      }
    }
    result.radius = print.largest();
    result.precision = bits;
    result.faces = part.faces.size();
    if ((print.enough() && print_curvature.enough()) || last_chance) return result;
  }
}

}  // namespace limitcheck::reference
