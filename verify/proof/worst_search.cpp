// SPDX-License-Identifier: MIT
// Trying to reach the proved bounds with real control meshes.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "data/splitmix64.h"
#include "reference/stam.h"
#include "verify/proof/bounds.h"
#include "verify/proof/linear_runs.h"
#include "verify/proof/reference_map.h"

namespace limitcheck::verify {

namespace {

template <int tangent>
using FloatLane = fast::row_stream::LinearNumber<float, tangent>;

using Row = std::vector<double>;
using Mesh = std::vector<fast::Vec3<float>>;

// Three meshes at once, one per coordinate: the kernels treat coordinates alike.
constexpr std::array<float fast::Vec3<float>::*, 3> kCoordinates{&fast::Vec3<float>::x, &fast::Vec3<float>::y,
                                                                 &fast::Vec3<float>::z};

struct Errors {
  std::array<double, 3> share{};  // of the bound, largest over the points: what is climbed
  WorstObserved worst;
};

class Search {
 public:
  Search(const Neighbourhood& neighbourhood, const KernelBounds& bounds, double reach, std::uint64_t seed)
      : neighbourhood_(neighbourhood), bounds_(bounds), reach_(reach), random_(seed) {
    ReferenceMap<double, reference::StamEvaluator<double>> reference(neighbourhood.mesh);
    for (const PointBound& p : bounds.points) positions_.push_back(reference.at(p.at).position);
  }

  WorstObserved run(int meshes) {
    WorstObserved worst;
    Mesh best(neighbourhood_.mesh.positions.size());
    std::array<double, 3> best_share{};
    constexpr int kClimb = 40;
    for (int k = 0; k < meshes; ++k) {
      Mesh trial = best;
      if (k % kClimb == 0) {
        best_share = {};
        for (auto& p : trial)
          for (std::size_t c = 0; c < 3; ++c) p.*kCoordinates[c] = fresh((k / kClimb + c) % 4);
      } else {
        for (std::size_t c = 0; c < 3; ++c)
          trial[random_.next() % trial.size()].*kCoordinates[c] = fresh(random_.next() % 4);
      }
      const Errors errors = measure(trial, k / kClimb % 2 == 1);
      for (std::size_t c = 0; c < 3; ++c) {
        if (errors.share[c] <= best_share[c]) continue;
        best_share[c] = errors.share[c];
        for (std::size_t v = 0; v < best.size(); ++v) best[v].*kCoordinates[c] = trial[v].*kCoordinates[c];
      }
      worst.position = std::max(worst.position, errors.worst.position);
      worst.tangent = std::max(worst.tangent, errors.worst.tangent);
      worst.position_share = std::max(worst.position_share, errors.worst.position_share);
      worst.tangent_share = std::max(worst.tangent_share, errors.worst.tangent_share);
    }
    worst.meshes = meshes;
    return worst;
  }

 private:
  // Near a side of the box, with a full mantissa; positive; or anywhere.
  float fresh(std::uint64_t kind) {
    const double depth = random_.unit() * (random_.next() % 2 == 0 ? 1 : 0x1p-6);
    const double sign = random_.next() % 2 == 0 ? 1 : -1;
    const double size = reach_ * (1 - depth);
    if (kind == 0) return static_cast<float>(reach_ * (2 * random_.unit() - 1));
    if (kind == 1) return static_cast<float>(size);
    return static_cast<float>(sign * size);
  }

  static double exact(const Row& row, const Mesh& mesh, float fast::Vec3<float>::*coordinate) {
    double sum = 0;
    for (std::size_t v = 0; v < row.size(); ++v) sum += row[v] * static_cast<double>(mesh[v].*coordinate);
    return sum;
  }

  Errors measure(const Mesh& mesh, bool climb_tangents) const {
    Errors errors;
    LinearRuns<float, FloatLane> runs(neighbourhood_.mesh, mesh);
    std::size_t k = 0;
    runs.run(bounds_.kernel, bounds_.depth, [&](const fast::LatticePoint&, const fast::LimitFrame<float>& f) {
      const PointBound& bound = bounds_.points[k];
      for (std::size_t c = 0; c < 3; ++c) {
        const auto coordinate = kCoordinates[c];
        const auto error = [&](const Row& row, const fast::Vec3<float>& found) {
          return std::abs(static_cast<double>(found.*coordinate) - exact(row, mesh, coordinate));
        };
        const double position = error(positions_[k], f.position);
        WorstObserved& worst = errors.worst;
        worst.position = std::max(worst.position, position);
        worst.position_share = std::max(worst.position_share, position / bound.position);
        double climbed = position / bound.position;
        if (climb_tangents) climbed = 0;
        for (const auto& [t, found] : {std::pair{&bound.du, &f.du}, std::pair{&bound.dv, &f.dv}}) {
          if (!bound.has_tangents) break;
          const double e = error(t->weights, *found);
          worst.tangent = std::max(worst.tangent, e / t->size);
          worst.tangent_share = std::max(worst.tangent_share, e / t->error);
          if (climb_tangents) climbed = std::max(climbed, e / t->error);
        }
        errors.share[c] = std::max(errors.share[c], climbed);
      }
      ++k;
    });
    return errors;
  }

  const Neighbourhood& neighbourhood_;
  const KernelBounds& bounds_;
  double reach_;
  data::SplitMix64 random_;
  std::vector<Row> positions_;
};

}  // namespace

WorstObserved search_worst(const Neighbourhood& neighbourhood, const KernelBounds& bounds, int meshes,
                           std::uint64_t seed, double reach) {
  return Search(neighbourhood, bounds, reach, seed).run(meshes);
}

}  // namespace limitcheck::verify
