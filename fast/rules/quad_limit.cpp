// SPDX-License-Identifier: MIT
// The weights of quad_limit.h in double, and those of a dart of many quads in time linear in its valence.

#include "fast/rules/quad_limit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limitcheck::fast::detail {

namespace {

using Row = std::vector<double>;

// e_0, f_0, .., e_{n-1}, f_{n-1}, and 0 for e_n.
Row in_turns(const Row& edges, const Row& faces, double factor) {
  Row ring;
  ring.reserve(2 * edges.size() + 1);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    ring.push_back(edges[i] * factor);
    ring.push_back(faces[i] * factor);
  }
  ring.push_back(0);
  return ring;
}

// With n^2 at the centre: 7 h_i - h_{i-1} - h_{i+1} = 20 between h_0 = h_n = 0; f_i has (h_i + h_{i+1}) / 12 +
// 1/3, and e_0 has h_1 / 3 + 10/3.
Row limit(int n) {
  const auto size = static_cast<std::size_t>(n);
  Row share{0}, edges{0}, faces;
  for (std::size_t i = 1; i < size; ++i) {
    share.push_back(1 / (7 - share.back()));
    edges.push_back((20 + edges.back()) * share.back());
  }
  for (std::size_t i = size - 1; i-- > 1;) edges[i] += share[i] * edges[i + 1];
  for (std::size_t i = 0; i < size; ++i) faces.push_back((edges[i] + edges[(i + 1) % size]) / 12 + 1. / 3);
  edges[0] = (edges[1] + 10) / 3;
  double sum = static_cast<double>(n) * n;
  for (std::size_t i = 0; i < size; ++i) sum += edges[i] + faces[i];
  return in_turns(edges, faces, 1 / sum);
}

// The waves 1 - cos(t (n/2 - i)) / cos(t n/2) of an angle t, which are zero at e_0 and e_n, times that cosine;
// the face points that belong to them, and what the rule at e_0 leaves of its eigenvalue.
struct Wave {
  int n;
  double t;
  double end = std::cos(t * n / 2), cosine = std::cos(t);
  double d = (1 + cosine + std::cos(t / 2) * std::sqrt(2 * (9 + cosine))) / 16;  // the eigenvalue less 1/4
  double share = (1. / 4 - d + 1 / (16 * d)) / (6 + 1 / (2 * d)) * end;          // of all weights, each has

  double edge(int i) const { return end - std::cos(t * (n - 2 * i) / 2); }
  double first_edge() const {
    const double near = end * (n - 1) - std::sin(t * (n - 1) / 2) / std::sin(t / 2);
    return share * 4 * n * n - near - (near / 8 - share * n) / d;
  }
  double missing() const {
    return (1. / 4 - d) * first_edge() + edge(1) / 8 + (edge(1) / 16 - share) / (2 * d) - share * 6;
  }
};

// The eigenvalue is that of the angle, near 2 pi / n, at which nothing is missing.
Wave tangent_wave(int n) {
  const double unit = 2 * std::numbers::pi / n;
  const auto negative = [&](double t) { return Wave{n, t}.missing() < 0; };
  double low = .6 * unit, high = low;
  for (int k = 1; k <= 200; ++k, low = high) {
    high = (.6 + .005 * k) * unit;
    if (negative(low) != negative(high)) break;
  }
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (negative(low) == negative(middle) ? low : high) = middle;
  }
  return {n, (low + high) / 2};
}

Row tangent(int n) {
  const Wave wave = tangent_wave(n);
  Row edges{0}, faces;
  for (int i = 1; i < n; ++i) edges.push_back(wave.edge(std::min(i, n - i)));
  for (std::size_t i = 0; i < edges.size(); ++i)
    faces.push_back(((edges[i] + edges[(i + 1) % edges.size()]) / 16 - wave.share) / wave.d);
  edges[0] = wave.first_edge();
  double towards = 0;  // towards e_0 it is positive
  for (int i = 0; i < n; ++i)
    towards += edges[static_cast<std::size_t>(i)] * std::cos(2 * std::numbers::pi * i / n);
  return in_turns(edges, faces, 1 / towards);
}

}  // namespace

StarWeights<double> large_dart_weights(int n) {
  return {tangent(n), {}, limit(n)};
}

}  // namespace limitcheck::fast::detail

namespace limitcheck::fast {

template StarWeights<double> star_weights(int, bool, VertexKind);

}  // namespace limitcheck::fast
