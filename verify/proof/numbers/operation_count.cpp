// SPDX-License-Identifier: MIT
#include "verify/proof/numbers/operation_count.h"

#include <array>
#include <cmath>
#include <compare>
#include <concepts>
#include <optional>
#include <type_traits>
#include <vector>

#include "fast/stream/host/number_stream.h"
#include "fast/window/sliding_window.h"

namespace limitcheck::verify {

namespace {

thread_local OperationCounts counted;
thread_local std::int64_t stored_numbers;

/// A T that counts what is done with it.
template <std::floating_point T>
struct Counted {
  T value = 0;

  constexpr Counted() = default;
  template <class X>
  requires std::is_arithmetic_v<X>
  constexpr explicit Counted(X x) : value(static_cast<T>(x)) {}
  template <std::floating_point U>
  explicit Counted(const Counted<U>& other) : value(static_cast<T>(other.value)) {}

  friend Counted operator+(const Counted& a, const Counted& b) {
    return ++counted.additions, Counted(a.value + b.value);
  }
  friend Counted operator-(const Counted& a, const Counted& b) {
    return ++counted.additions, Counted(a.value - b.value);
  }
  friend Counted operator-(const Counted& a) { return Counted(-a.value); }
  friend Counted operator*(const Counted& a, const Counted& b) {
    return ++counted.multiplications, Counted(a.value * b.value);
  }
  friend Counted operator*(T a, const Counted& b) { return Counted(a) * b; }
  friend Counted operator/(const Counted& a, const Counted& b) {
    return ++counted.divisions, Counted(a.value / b.value);
  }
  friend Counted sqrt(const Counted& a) { return ++counted.roots, Counted(std::sqrt(a.value)); }
  friend Counted fused(const Counted& a, const Counted& b, const Counted& c) {
    return ++counted.fused, Counted(std::fma(a.value, b.value, c.value));
  }
  // NOLINTNEXTLINE(modernize-use-nullptr): there is no pointer
  friend auto operator<=>(const Counted&, const Counted&) = default;
};

/// The number of the row streaming kernel; what it stores counts, too.
struct CountedLane : fast::row_stream::ScalarNumber<Counted<float>> {
  static void store(const V& v, V* p) {
    *p = v;
    ++stored_numbers;
  }
  static V fma(const V& a, const V& b, const V& c) { return fused(a, b, c); }
  static V fms(const V& a, const V& b, const V& c) { return fused(a, b, -c); }
  static V fnma(const V& a, const V& b, const V& c) { return fused(-a, b, c); }
  static constexpr bool kHasSeed = true;
  static V inverse_root_seed(const V& x) {
    return V(fast::row_stream::ScalarNumber<float>::inverse_root_seed(x.value));
  }
};

template <class Work>
OperationCounts count(Work&& work) {
  const OperationCounts before = counted;
  work();
  return counted - before;
}

}  // namespace
}  // namespace limitcheck::verify

namespace limitcheck::fast {

template <std::floating_point T>
struct NumberTraits<verify::Counted<T>> {
  using Scalar = T;
  using Wide = verify::Counted<double>;
  static constexpr T ratio(int p, int q) { return NumberTraits<T>::ratio(p, q); }
  static T cosine(int p, int q) { return NumberTraits<T>::cosine(p, q); }
  static T sine(int p, int q) { return NumberTraits<T>::sine(p, q); }
  static Wide widen(const verify::Counted<T>& v) { return Wide(v); }
  static verify::Counted<T> narrow(const Wide& v) { return verify::Counted<T>(v); }
};

}  // namespace limitcheck::fast

namespace limitcheck::verify {

namespace {

using Number = Counted<float>;

template <bool kCarry>
KernelCost count_window(const data::ControlMesh& mesh, int depth) {
  KernelCost cost;
  const fast::Adjacency adjacency(mesh);
  const auto points = fast::positions_of<Number>(mesh);
  std::optional<fast::PreparedMesh<Number>> prepared;
  cost.prepass = count([&] { prepared.emplace(adjacency, points); });
  fast::SlidingWindow<Number, fast::LimitSurface<Number>, fast::Counting, kCarry> window(
      depth, adjacency.max_valence());
  cost.operations = count([&] { window.run(*prepared, 0, depth, [](int, const auto*) {}); });
  cost.limits = window.probe().counts.limit_points;
  cost.stored_vectors = window.probe().counts.stored();
  return cost;
}

KernelCost count_stream(const data::ControlMesh& mesh, int depth) {
  KernelCost cost;
  const fast::Adjacency adjacency(mesh);
  std::vector<std::array<Number, 3>> points;
  for (const auto& p : mesh.positions) points.push_back({Number(p[0]), Number(p[1]), Number(p[2])});
  std::optional<fast::row_stream::NumberStream<CountedLane>> stream;
  cost.prepass = count([&] { stream.emplace(adjacency, points); });
  const std::int32_t twin = adjacency.twin(0);
  const fast::Grid pair{0, twin / 3, 0, twin % 3, depth};
  const std::int64_t side = (std::int64_t{1} << depth) + 1;
  std::vector<Number> out(6 * side * side);
  stored_numbers = 0;
  cost.operations = count([&] { stream->whole({&pair, 1}, depth, out.data()); });
  cost.stored_vectors = stored_numbers / 3;
  cost.limits = side * side;
  return cost;
}

}  // namespace

KernelCost count_operations(CountedKernel kernel, const data::ControlMesh& mesh, int depth) {
  KernelCost cost = kernel == CountedKernel::kRowStream       ? count_stream(mesh, depth)
                    : kernel == CountedKernel::kSlidingWindow ? count_window<true>(mesh, depth)
                                                              : count_window<false>(mesh, depth);
  const std::int64_t side = (std::int64_t{1} << depth) + 1;
  cost.points = side * side;
  return cost;
}

}  // namespace limitcheck::verify
