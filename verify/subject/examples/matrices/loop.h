// SPDX-License-Identifier: MIT
// One step of Loop's scheme on a mesh of matrices, as igl::loop does it: V has a vertex in each row, F the
// three corners of a triangle. It relies on F to be an oriented manifold.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

/// Triangle t of F becomes 4 t, 4 t + 1 and 4 t + 3 at its corners, and 4 t + 2 in the middle.
inline void loop(const Eigen::MatrixXd& V, const Eigen::MatrixXi& F, Eigen::MatrixXd& NV,
                 Eigen::MatrixXi& NF) {
  std::map<std::pair<int, int>, int> opposite, middle;  // (a, b) -> c of each triangle; the vertex on a-b
  for (int t = 0; t < F.rows(); ++t)
    for (int k = 0; k < 3; ++k) opposite[{F(t, k), F(t, (k + 1) % 3)}] = F(t, (k + 2) % 3);
  Eigen::MatrixXd around = Eigen::MatrixXd::Zero(V.rows(), 3), along = around;
  Eigen::VectorXd valence = Eigen::VectorXd::Zero(V.rows()), ends = valence;
  NV.resize(V.rows() + static_cast<int>(opposite.size()), 3);
  int next = static_cast<int>(V.rows());
  for (const auto& [edge, c] : opposite) {
    const auto [a, b] = edge;
    around.row(a) += V.row(b), valence(a) += 1;
    const auto other = opposite.find({b, a});
    if (other == opposite.end()) {
      along.row(a) += V.row(b), along.row(b) += V.row(a), ends(a) += 1, ends(b) += 1;
      NV.row(next) = (V.row(a) + V.row(b)) / 2;
    } else if (a < b) {
      NV.row(next) = 3 * (V.row(a) + V.row(b)) / 8 + (V.row(c) + V.row(other->second)) / 8;
    } else {
      continue;
    }
    middle[std::minmax(a, b)] = next++;
  }
  NV.conservativeResize(next, 3);
  for (int v = 0; v < V.rows(); ++v) {
    const double n = ends(v) > 0 ? 2 : valence(v);
    const double w =
        ends(v) > 0 ? 1.0 / 8 : (5.0 / 8 - std::pow(3 + 2 * std::cos(2 * EIGEN_PI / n), 2) / 64) / n;
    NV.row(v) = (1 - n * w) * V.row(v) + w * (ends(v) > 0 ? along : around).row(v);
  }
  NF.resize(4 * F.rows(), 3);
  for (int t = 0; t < F.rows(); ++t) {
    const int v0 = F(t, 0), v1 = F(t, 1), v2 = F(t, 2), m0 = middle.at(std::minmax(v0, v1)),
              m1 = middle.at(std::minmax(v1, v2)), m2 = middle.at(std::minmax(v2, v0));
    NF.middleRows(4 * t, 4) << v0, m0, m2, v1, m1, m0, m0, m1, m2, m1, v2, m2;
  }
}
