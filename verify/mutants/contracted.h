// SPDX-License-Identifier: MIT
// Floats as a compiler computes them that may contract: a product that is added to something is not rounded. A model
// for compilers of shaders, which cannot be watched: the paper's scheme needs that a rule gives the same bits wherever
// it stands, and this says what becomes of them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "data/splitmix64.h"
#include "fast/frame/patch.h"
#include "fast/mesh/adjacency.h"
#include "fast/plan/pairing.h"
#include "fast/rules/masks.h"
#include "fast/stream/host/number_stream.h"

namespace limitcheck::verify {

/// Which product of a sum is fused with it, if one of its terms is a product:
///   kNone        none
///   kLeft        the left term if that is one, else the right; kRight the other way round: in all code alike
///   kByCallSite  one of these three, drawn for each place in the program's code: code that was inlined, unrolled or
///                peeled is there several times, and each copy may be contracted otherwise
enum class Contraction { kNone, kLeft, kRight, kByCallSite };
/// The compiler that is modelled by kByCallSite: another number draws otherwise.
inline std::uint64_t which_compiler = 0;

/// A float that knows of which factors it is the rounded product, until it is stored in memory.
template <Contraction kHow>
class Contracted {
 public:
  Contracted() = default;
  template <class X>
  requires std::is_arithmetic_v<X>
  explicit Contracted(X x) : value_(static_cast<float>(x)) {}

  float value() const { return value_; }
  Contracted stored() const { return Contracted(value_); }

  friend Contracted operator*(const Contracted& a, const Contracted& b) {
    Contracted product(a.value_ * b.value_);
    product.left_ = a.value_, product.right_ = b.value_, product.is_product_ = true;
    return product;
  }
  friend Contracted operator-(const Contracted& a) {
    Contracted negated(-a.value_);
    negated.left_ = -a.left_, negated.right_ = a.right_, negated.is_product_ = a.is_product_;
    return negated;
  }
  // Not inline, so that where it returns to is where it was called.
  [[gnu::noinline]] friend Contracted operator+(const Contracted& a, const Contracted& b) {
    return sum(a, b, __builtin_return_address(0));
  }
  [[gnu::noinline]] friend Contracted operator-(const Contracted& a, const Contracted& b) {
    return sum(a, -b, __builtin_return_address(0));
  }
  friend Contracted operator/(const Contracted& a, const Contracted& b) {
    return Contracted(a.value_ / b.value_);
  }
  friend Contracted sqrt(const Contracted& a) { return Contracted(std::sqrt(a.value_)); }
  friend bool operator==(const Contracted& a, const Contracted& b) { return a.value_ == b.value_; }

 private:
  static Contraction at(const void* site) {
    static const char origin = 0;  // the code lies elsewhere in each run, and always as far from this
    const auto distance = static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(site) -
                                                     reinterpret_cast<std::uintptr_t>(&origin));
    constexpr Contraction kOne[] = {Contraction::kNone, Contraction::kLeft, Contraction::kRight};
    return kOne[data::SplitMix64(distance ^ which_compiler << 32).next() % 3];
  }
  static Contracted sum(const Contracted& a, const Contracted& b, const void* site) {
    const Contraction how = kHow == Contraction::kByCallSite ? at(site) : kHow;
    if (how == Contraction::kNone || (!a.is_product_ && !b.is_product_))
      return Contracted(a.value_ + b.value_);
    const bool left = a.is_product_ && (how == Contraction::kLeft || !b.is_product_);
    return left ? Contracted(std::fma(a.left_, a.right_, b.value_))
                : Contracted(std::fma(b.left_, b.right_, a.value_));
  }

  float value_ = 0, left_ = 0, right_ = 0;
  bool is_product_ = false;
};

/// What row streaming's kernel computes with (fast/stream/kernel/number.h).
template <Contraction kHow>
struct ContractedNumber : fast::row_stream::ScalarNumber<Contracted<kHow>> {
  using T = Contracted<kHow>;
  static constexpr bool kHasSeed = true;  // as floats have

  static void store(const T& v, T* p) { *p = v.stored(); }
  static T inverse_root_seed(const T& x) {
    return T(fast::row_stream::ScalarNumber<float>::inverse_root_seed(x.value()));
  }
};

}  // namespace limitcheck::verify

/// Rings are summed in double, as those of floats.
template <limitcheck::verify::Contraction kHow>
struct limitcheck::fast::NumberTraits<limitcheck::verify::Contracted<kHow>> {
  using Scalar = limitcheck::verify::Contracted<kHow>;
  using Wide = double;
  static Wide widen(const Scalar& v) { return static_cast<Wide>(v.value()); }
  static Scalar narrow(Wide v) { return Scalar(v); }
};

namespace limitcheck::verify {

/// What row streaming's kernel makes of a mesh of triangles without sharp edges, all faces at one depth:
/// visit(fast::LatticePoint, const std::array<float, 6>&) for each point of each grid, position and unit normal; a
/// point of the diagonal is named by both of the grid's faces.
template <Contraction kHow, class Visit>
void contracted_points(const data::ControlMesh& mesh, int depth, Visit&& visit) {
  using T = Contracted<kHow>;
  const fast::Adjacency adjacency(mesh);
  const auto grids = fast::pair_faces(adjacency, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids;
  const auto placed = fast::row_stream::place<float>(mesh);
  fast::row_stream::PlacedPoints<T> points;
  for (const auto& p : placed.points) points.points.push_back({T(p[0]), T(p[1]), T(p[2]), T(p[3])});
  for (int c = 0; c < 3; ++c) points.placement.centre[c] = T(placed.placement.centre[c]);
  points.placement.unit = T(placed.placement.unit);
  points.local_from = placed.local_from;
  points.faces_local_from = placed.faces_local_from;

  const int size = 1 << depth, side = size + 1;
  std::vector<T> numbers(6 * grids.size() * static_cast<std::size_t>(side * side));
  fast::row_stream::NumberStream<ContractedNumber<kHow>>(adjacency, std::move(points))
      .whole(grids, depth, numbers.data());
  const T* at = numbers.data();
  for (const fast::Grid& grid : grids)
    for (int row = 0; row <= size; ++row)
      for (int column = 0; column <= size; ++column, at += 6) {
        std::array<float, 6> vertex;
        for (std::size_t k = 0; k < 6; ++k) vertex[k] = at[k].value();
        for (const bool upper : {true, false}) {
          if (upper ? row < column : column < row) continue;
          const fast::LatticePoint point = fast::face_point(grid, size, column, row, upper);
          if (point.face >= 0) visit(point, vertex);
        }
      }
}

}  // namespace limitcheck::verify
