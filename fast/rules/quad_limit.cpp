// SPDX-License-Identifier: MIT
#include "fast/rules/quad_limit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace limitcheck::fast {

namespace {

using std::numbers::pi;

// 4 lambda - 1 of the waves with angle theta from edge to edge.
double four_lambda_less_one(double theta) {
  return (1 + std::cos(theta) + std::cos(theta / 2) * std::sqrt(2 * (9 + std::cos(theta)))) / 4;
}

// The waves of a closed ring, cosine and sine.
StarWeights closed_weights(int n) {
  StarWeights w;
  const double theta = 2 * pi / n, m = four_lambda_less_one(theta);
  for (int i = 0; i < n; ++i) {
    const auto wave = [&](double (*f)(double), std::vector<double>& out) {
      out.push_back(4 * f(i * theta));
      out.push_back((f(i * theta) + f((i + 1) * theta)) / m);
    };
    wave(std::cos, w.du);
    wave(std::sin, w.dv);
  }
  return w;
}

StarWeights boundary_weights(int n) {
  StarWeights w;
  const std::size_t size = 2 * static_cast<std::size_t>(n) + 1;
  w.du.assign(size, 0);
  w.dv.assign(size, 0);
  w.du.front() = 1;
  w.du.back() = -1;
  if (n == 1) {
    w.dv = {1, 0, 1};
    return w;
  }
  const double theta = pi / n, m = four_lambda_less_one(theta), t = 1 / std::tan(theta / 2);
  for (int i = 0; i < n; ++i) {
    w.dv[2 * i] = 4 * std::sin(i * theta);
    w.dv[2 * i + 1] = (std::sin(i * theta) + std::sin((i + 1) * theta)) / m;
  }
  w.dv.front() = w.dv.back() = ((m + 1) * std::sin(theta) - (2 * m + 1) * t) / (m * m);
  return w;
}

StarWeights held_weights(int n) {
  StarWeights w;
  const std::size_t size = 2 * static_cast<std::size_t>(n) + 1;
  w.du.assign(size, 0);
  w.dv.assign(size, 0);
  w.du.front() = 1;
  w.dv.back() = 1;
  return w;
}

using Row = std::vector<double>;
using Matrix = std::vector<Row>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c(a.size(), Row(a.size()));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < a.size(); ++k)
      if (a[i][k] != 0)
        for (std::size_t j = 0; j < a.size(); ++j) c[i][j] += a[i][k] * b[k][j];
  return c;
}

// A dart's star as it is seen by what is symmetric to its sharp edge e_0: entry 0 is the centre, then come
// e_j and e_{n-j}, then f_j and f_{n-1-j}, which have equal weights and make one entry.
class DartMatrix {
 public:
  explicit DartMatrix(int n) : n_(n), edges_(n / 2 + 1), faces_((n + 1) / 2) {
    step_.assign(static_cast<std::size_t>(1 + edges_ + faces_),
                 Row(static_cast<std::size_t>(1 + edges_ + faces_)));
    const double valence = n;
    Row& centre = step_[0];
    centre[0] = 1 - 7 / (4 * valence);
    for (int i = 0; i < n; ++i) {
      centre[edge(i)] += 3 / (2 * valence * valence);
      centre[face(i)] += 1 / (4 * valence * valence);
    }
    for (int i = 0; i < edges_; ++i) {
      Row& row = step_[edge(i)];
      row[0] += i == 0 ? .5 : .375;
      row[edge(i)] += i == 0 ? .5 : .375;
      if (i == 0) continue;
      for (const int side : {i - 1, i + 1}) row[edge(side)] += .0625;
      for (const int side : {i - 1, i}) row[face(side)] += .0625;
    }
    for (int i = 0; i < faces_; ++i) {
      Row& row = step_[face(i)];
      for (const std::size_t k : {std::size_t{0}, edge(i), edge(i + 1), face(i)}) row[k] += .25;
    }
  }

  /// The left eigenvector of eigenvalue 1, which sums to 1.
  Row limit() const {
    Row x(step_.size(), 1 / static_cast<double>(step_.size()));
    for (int i = 0; i < 300; ++i) x = times(x, step_);
    double sum = 0;
    for (const double w : x) sum += w;
    for (double& w : x) w /= sum;
    return x;
  }

  /// The left eigenvector of the largest other eigenvalue, by squaring what is left without the first.
  Row tangent() const {
    const Row first = limit();
    Matrix power = step_;
    for (Row& row : power)
      for (std::size_t j = 0; j < row.size(); ++j) row[j] -= first[j];
    for (int i = 0; i < 20; ++i) {
      power = product(power, power);
      double largest = 0;
      for (const Row& row : power)
        for (const double x : row) largest = std::max(largest, std::abs(x));
      for (Row& row : power)
        for (double& x : row) x /= largest;
    }
    const Row& row = *std::max_element(power.begin(), power.end(),
                                       [](const Row& a, const Row& b) { return size(a) < size(b); });
    // Towards e_0 it is positive.
    double towards = 0;
    for (int i = 0; i < edges_; ++i) towards += row[edge(i)] * std::cos(2 * pi * i / n_);
    Row out = row;
    for (double& x : out) x /= towards;
    return out;
  }

  /// The weights of e_0, f_0, .., e_{n-1}, f_{n-1}, and 0 for e_n.
  std::vector<double> of_ring(const Row& x) const {
    std::vector<double> out;
    std::vector<int> members(x.size());
    for (int i = 0; i < n_; ++i) ++members[edge(i)], ++members[face(i)];
    for (int i = 0; i < n_; ++i)
      for (const std::size_t k : {edge(i), face(i)}) out.push_back(x[k] / members[k]);
    out.push_back(0);
    return out;
  }

 private:
  static double size(const Row& row) {
    double sum = 0;
    for (const double x : row) sum += x * x;
    return sum;
  }
  static Row times(const Row& x, const Matrix& m) {
    Row out(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t j = 0; j < x.size(); ++j) out[j] += x[i] * m[i][j];
    return out;
  }
  std::size_t edge(int i) const {
    i = (i + n_) % n_;
    return static_cast<std::size_t>(1 + std::min(i, n_ - i));
  }
  std::size_t face(int i) const {
    i = (i + n_) % n_;
    return static_cast<std::size_t>(1 + edges_ + std::min(i, n_ - 1 - i));
  }

  int n_, edges_, faces_;
  Matrix step_;
};

StarWeights dart_weights(int n) {
  const DartMatrix dart(n);
  StarWeights w;
  w.position = dart.of_ring(dart.limit());
  w.du = dart.of_ring(dart.tangent());
  w.dv = closed_weights(n).dv;  // antisymmetric: it does not know of e_0
  w.dv.push_back(0);
  return w;
}

}  // namespace

StarWeights star_weights(int faces, bool open, VertexKind kind) {
  if (kind == VertexKind::kDart) return dart_weights(faces);
  if (!open) return closed_weights(faces);
  return kind == VertexKind::kHeld ? held_weights(faces) : boundary_weights(faces);
}

const StarWeights& StarWeightTable::of(int faces, bool open, VertexKind kind) {
  auto& list = list_[2 * static_cast<std::size_t>(kind) + (open ? 1 : 0)];
  if (static_cast<std::size_t>(faces) >= list.size()) list.resize(static_cast<std::size_t>(faces) + 1);
  auto& entry = list[static_cast<std::size_t>(faces)];
  if (entry == nullptr) entry = std::make_unique<StarWeights>(star_weights(faces, open, kind));
  return *entry;
}

}  // namespace limitcheck::fast
