// SPDX-License-Identifier: MIT
// Plants one wrong operation in the run of a kernel, which the proof must find.
#pragma once

#include <cstdint>

namespace limitcheck::verify {

/// While one of these lives, stencils of its thread compute one operation wrongly: the `at`-th of its sort.
class StencilFault {
 public:
  enum class Kind : std::uint8_t {
    kFactor,     ///< a wrong coefficient: a product with a factor that is 2^-20 too large
    kDropped,    ///< a wrong index: a sum without its second term
    kDoubled,    ///< a wrong coefficient: a sum with its second term twice
    kNeighbour,  ///< a wrong index: a sum with the second term of the sum before in place of its own
    kCoordinate  ///< a wrong coordinate: a sum of y or z that is the sum of x before it
  };

  StencilFault(Kind kind, std::int64_t at) : kind_(kind), left_(at) { active_ = this; }
  ~StencilFault() { active_ = nullptr; }
  StencilFault(const StencilFault&) = delete;
  StencilFault& operator=(const StencilFault&) = delete;

  static StencilFault* active() { return active_; }
  Kind kind() const { return kind_; }
  bool is_product() const { return kind_ == Kind::kFactor; }
  /// Counts one operation of the fault's sort; true for the one to spoil.
  bool strikes() { return left_-- == 0; }
  bool has_struck() const { return left_ < 0; }
  /// Operations of its sort until it strikes.
  std::int64_t left() const { return left_; }

 private:
  static inline thread_local StencilFault* active_ = nullptr;
  Kind kind_;
  std::int64_t left_;
};

}  // namespace limitcheck::verify
