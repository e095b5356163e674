// SPDX-License-Identifier: MIT
#include "verify/mutants/models/model_dart.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace limitcheck::verify {
namespace {

// Of `size` rows.
class Square {
 public:
  explicit Square(std::size_t size) : size_(size), entries_(size * size, 0.) {}
  double& at(std::size_t row, std::size_t column) { return entries_[row * size_ + column]; }
  double at(std::size_t row, std::size_t column) const { return entries_[row * size_ + column]; }

  // Times itself, over and over, the largest entry brought to 1 each time.
  Square power(int doublings) const {
    Square result = *this;
    for (int k = 0; k < doublings; ++k) {
      Square next(size_);
      for (std::size_t i = 0; i < size_; ++i)
        for (std::size_t l = 0; l < size_; ++l)
          if (const double x = result.at(i, l); x != 0)
            for (std::size_t j = 0; j < size_; ++j) next.at(i, j) += x * result.at(l, j);
      result = next.scaled();
    }
    return result;
  }
  // The row with the largest entry.
  std::vector<double> row() const {
    const auto less = [](double a, double b) { return std::abs(a) < std::abs(b); };
    const auto largest = std::max_element(entries_.begin(), entries_.end(), less);
    const auto first = entries_.begin() + (largest - entries_.begin()) / static_cast<std::ptrdiff_t>(size_) *
                                              static_cast<std::ptrdiff_t>(size_);
    return {first, first + static_cast<std::ptrdiff_t>(size_)};
  }

 private:
  Square scaled() const {
    double most = 0;
    for (const double x : entries_) most = std::max(most, std::abs(x));
    Square result = *this;
    for (double& x : result.entries_) x *= most > 0 ? 1 / most : 1;
    return result;
  }

  std::size_t size_;
  std::vector<double> entries_;
};

// 2^14 steps part eigenvalues that differ by 1 in 400, as of small rings; those of n edges differ by 1 in n^2.
int doublings_for(std::size_t size) {
  return size <= 64 ? 14 : 20;
}

}  // namespace

RingMasks ring_masks(std::size_t size,
                     const std::function<std::vector<double>(const std::vector<double>&)>& step,
                     const std::function<std::size_t(std::size_t)>& mirror, const std::vector<double>& even,
                     const std::vector<double>& odd) {
  Square matrix(size);
  for (std::size_t j = 0; j < size; ++j) {
    std::vector<double> unit(size, 0.);
    unit[j] = 1;
    const std::vector<double> column = step(unit);
    for (std::size_t i = 0; i < size; ++i) matrix.at(i, j) = column[i];
  }
  RingMasks masks{matrix.power(doublings_for(size)).row(), {}, {}};
  const double sum = std::accumulate(masks.limit.begin(), masks.limit.end(), 0.);
  for (double& w : masks.limit) w /= sum;

  const auto tangent = [&](double sign, const std::vector<double>& towards) {
    Square part(size);  // without the eigenvalue 1, and odd or even
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) {
        const std::size_t seen = mirror(j);
        part.at(i, j) =
            (matrix.at(i, j) - masks.limit[j] + sign * (matrix.at(i, seen) - masks.limit[seen])) / 2;
      }
    std::vector<double> weights = part.power(doublings_for(size)).row();
    const double along = std::inner_product(weights.begin(), weights.end(), towards.begin(), 0.);
    if (along < 0)
      for (double& w : weights) w = -w;
    return weights;
  };
  masks.first = tangent(1, even);
  masks.second = tangent(-1, odd);
  return masks;
}

}  // namespace limitcheck::verify
