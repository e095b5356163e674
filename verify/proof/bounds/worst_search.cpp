// SPDX-License-Identifier: MIT
// Trying to reach the proved bounds with real control meshes.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "data/splitmix64.h"
#include "reference/loop/stam.h"
#include "verify/proof/bounds/bounds.h"
#include "verify/proof/maps/reference_map.h"
#include "verify/proof/maps/scheme_runs.h"
#include "verify/proof/numbers/quad_weights.h"

namespace limitcheck::verify {

namespace {

template <int tangent>
using FloatLane = fast::row_stream::LinearNumber<float, tangent>;

using Row = std::vector<double>;
// Three meshes at once, one per coordinate: the kernels treat coordinates alike (Search::alike).
using Mesh = std::vector<fast::Vec3<float>>;

// A mesh is changed this often, one control point per coordinate, before the next begins anew.
constexpr int kClimb = 40;

// What doubles may make of an exact value, relative to what it can be at most: the reference's own error, the
// sum over the control points, and a product and a sum for every change since.
constexpr double kDoubt = 0x1p-45;

/// Position, du or dv at every point: its weights, a column of all points per control point, and the sizes
/// that errors are measured by.
struct Quantity {
  Row weights;
  Row doubt;      // kDoubt of its largest value
  Row per_size;   // 1 / largest value; of positions 1
  Row per_bound;  // 1 / proved bound
};

// The weights of the control points in every limit point, by Stam's evaluator.
std::vector<MapRow<double>> exact_rows(const data::ControlMesh& mesh, const KernelBounds& bounds) {
  std::vector<MapRow<double>> rows;
  const auto ask = [&](auto reference) {
    for (const PointBound& p : bounds.points) rows.push_back(reference.at(p.at));
  };
  by_scheme(mesh, [&]<class Scheme>(Scheme) { ask(StamMap<double, Scheme::kQuads>(mesh)); });
  return rows;
}

// Of two columns of two rows.
double determinant(const Row& a, const Row& b, std::size_t p, std::size_t q) {
  return a[p] * b[q] - a[q] * b[p];
}

// PointBound of a control vertex, whose normal is made in double: of the weights d1 and d2 each is known to
// 2^-40.
PointBound made_in_double(const MapRow<double>& row, double reach) {
  PointBound bound;
  for (const auto& [weights, tangent] : {std::pair{&row.d1, &bound.du}, std::pair{&row.d2, &bound.dv}}) {
    for (const double w : *weights) tangent->size += reach * std::abs(w), tangent->error += 0x1p-40 * reach;
    tangent->weights = *weights;
  }
  return bound;
}

class Search {
 public:
  Search(const Neighbourhood& neighbourhood, const KernelBounds& bounds, double reach, std::uint64_t seed)
      : neighbourhood_(neighbourhood), bounds_(bounds), reach_(reach), random_(seed) {
    const std::vector<MapRow<double>> exact = exact_rows(neighbourhood.mesh, bounds);
    const std::size_t points = bounds.points.size();
    proof_.first_depth = proof_.last_depth = bounds.depth;
    proof_.position_bound = bounds.position();
    for (Quantity& q : quantities_) {
      q.weights.resize(neighbourhood.mesh.positions.size() * points);
      q.doubt.resize(points), q.per_size.resize(points), q.per_bound.resize(points);
    }
    for (std::size_t k = 0; k < points; ++k) {
      put(quantities_[0], k, exact[k].position, reach, 1, bounds.points[k].position);
      normals_.push_back(bounds.points[k].has_tangents ? bounds.points[k] : made_in_double(exact[k], reach));
      const PointBound& p = normals_.back();
      put(quantities_[1], k, p.du.weights, p.du.size, p.du.size, p.du.error);
      put(quantities_[2], k, p.dv.weights, p.dv.size, p.dv.size, p.dv.error);
      if (!bounds.points[k].has_tangents) continue;
      proof_.tangent_bound = std::max({proof_.tangent_bound, p.du.relative(), p.dv.relative()});
      proof_.normal_bound = std::max(proof_.normal_bound, normal_error_share(p));
      proof_.product_bound = std::max(proof_.product_bound, product_by_parameters(p, exact[k]));
    }
    for (auto* values : {&best_exact_, &trial_exact_})
      for (auto& coordinate : *values)
        for (Row& quantity : coordinate) quantity.resize(points);
  }

  BoundProof run(int meshes) {
    Mesh best(neighbourhood_.mesh.positions.size());
    std::array<double, 3> best_share{};
    for (int k = 0; k < meshes; ++k) {
      Mesh trial = best;
      if (k % kClimb == 0) {
        best_share = {};
        for (auto& p : trial)
          for (std::size_t c = 0; c < 3; ++c) p[c] = fresh((k / kClimb + c) % 4);
        for (std::size_t c = 0; c < 3; ++c) evaluate(trial, c);
      } else {
        for (std::size_t c = 0; c < 3; ++c) {
          const float to = fresh(random_.next() % 4);
          const std::size_t v = random_.next() % trial.size();
          const double change = static_cast<double>(to) - static_cast<double>(trial[v][c]);
          trial[v][c] = to;
          for (std::size_t q = 0; q < 3; ++q)
            add(quantities_[q], v, change, best_exact_[c][q], trial_exact_[c][q]);
        }
      }
      const std::array<double, 3> share = measure(trial, k / kClimb % 2 == 1);
      for (std::size_t c = 0; c < 3; ++c) {
        if (k % kClimb != 0 && share[c] <= best_share[c]) continue;
        best_share[c] = share[c];
        for (std::size_t v = 0; v < best.size(); ++v) best[v][c] = trial[v][c];
        std::swap(best_exact_[c], trial_exact_[c]);
      }
    }
    proof_.alike = alike();
    proof_.shipped = shipped();
    return std::move(proof_);
  }

 private:
  // What ships, unit normals and all, on meshes that are random, at the sides of the box, flat, and both.
  ShippedProof shipped() {
    std::array<Mesh, 4> meshes;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      meshes[m].resize(neighbourhood_.mesh.positions.size());
      for (auto& p : meshes[m]) {
        for (std::size_t c = 0; c < 3; ++c) p[c] = fresh(m % 2 == 0 ? 0 : 2);
        if (m >= 2) p.z *= 0x1p-4F;
      }
    }
    const Delivery found = deliver(bounds_.kernel, neighbourhood_, meshes, bounds_.depth);
    ShippedProof proof{0, 0, found.targets, found.unlike};
    const auto raise = [](double& share, double to) {
      if (!(to <= share)) share = std::isnan(to) ? std::numeric_limits<double>::infinity() : to;
    };
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      for (std::size_t c = 0; c < 3; ++c) evaluate(meshes[m], c);
      const auto exact = [&](std::size_t q, std::size_t k) {
        return fast::Vec3<double>{trial_exact_[0][q][k], trial_exact_[1][q][k], trial_exact_[2][q][k]};
      };
      for (std::size_t k = 0; k < normals_.size(); ++k) {
        const auto position = fast::widen(found.vertices[m][k].position) - exact(0, k);
        for (std::size_t c = 0; c < 3; ++c)
          raise(proof.position_share,
                (std::abs(position[c]) - quantities_[0].doubt[k]) * quantities_[0].per_bound[k]);
        const auto normal = fast::widen(found.vertices[m][k].normal);
        raise(proof.normal_share, std::abs(length(normal) - 1) / kLengthBound);
        const auto product = fast::cross(exact(1, k), exact(2, k));
        const double size = length(product), doubt = kDoubt * normals_[k].du.size * normals_[k].dv.size;
        if (!(size > 0x1p10 * doubt)) continue;  // no tangent plane, or the doubles do not know it
        const double angle = std::atan2(length(fast::cross(product, normal)), fast::dot(product, normal));
        raise(proof.normal_share, angle / normal_angle_bound(normals_[k], size - 8 * doubt));
      }
    }
    return proof;
  }

  // product_error in the units of d1 x d2, which a kernel's tangents multiply by a determinant; 0 at control
  // vertices.
  static double product_by_parameters(const PointBound& p, const MapRow<double>& exact) {
    if (p.at.i % p.at.denominator == 0 && p.at.j % p.at.denominator == 0) return 0;
    const Row &d1 = exact.d1, &d2 = exact.d2;
    std::size_t a = 0, b = 0;
    for (std::size_t k = 0; k < d1.size(); ++k)
      if (std::abs(d1[k]) > std::abs(d1[a])) a = k;
    for (std::size_t k = 0; k < d1.size(); ++k)
      if (std::abs(determinant(d1, d2, a, k)) > std::abs(determinant(d1, d2, a, b))) b = k;
    const double scale = determinant(p.du.weights, p.dv.weights, a, b) / determinant(d1, d2, a, b);
    return scale > 0 ? product_error(p) / scale : 0;
  }

  // Whether a mesh whose points have one value for x, y and z comes out so, bit for bit.
  bool alike() {
    Mesh mesh(neighbourhood_.mesh.positions.size());
    for (auto& p : mesh) {
      const float value = fresh(0);
      p = {value, value, value};
    }
    bool result = true;
    const auto is_alike = [](const fast::Vec3<float>& v) {
      const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
      return bits(v.x) == bits(v.y) && bits(v.x) == bits(v.z);
    };
    run_kernel(mesh, [&](std::size_t k, const fast::LimitFrame<float>& f) {
      result = result && is_alike(f.position) &&
               (!bounds_.points[k].has_tangents || (is_alike(f.du) && is_alike(f.dv)));
    });
    return result;
  }

  // visit(number of the point, frame)
  template <class Visit>
  void run_kernel(const Mesh& mesh, Visit&& visit) const {
    run_linear<float, FloatLane>(
        neighbourhood_.mesh, mesh, bounds_.kernel, bounds_.depth,
        [&, k = std::size_t{0}](const fast::LatticePoint&, const fast::LimitFrame<float>& f) mutable {
          visit(k++, f);
        });
  }

  static void put(Quantity& q, std::size_t k, const Row& row, double largest, double size, double bound) {
    const std::size_t points = q.doubt.size();
    for (std::size_t v = 0; v < row.size(); ++v) q.weights[v * points + k] = row[v];
    q.doubt[k] = kDoubt * largest;
    q.per_size[k] = 1 / size;
    q.per_bound[k] = 1 / bound;
  }

  // Near a side of the box, with a full mantissa; positive; or anywhere.
  float fresh(std::uint64_t kind) {
    const double depth = random_.unit() * (random_.next() % 2 == 0 ? 1 : 0x1p-6);
    const double sign = random_.next() % 2 == 0 ? 1 : -1;
    const double size = reach_ * (1 - depth);
    if (kind == 0) return static_cast<float>(reach_ * (2 * random_.unit() - 1));
    if (kind == 1) return static_cast<float>(size);
    return static_cast<float>(sign * size);
  }

  // to = from + x times the weights of control point v, at every point
  static void add(const Quantity& q, std::size_t v, double x, const Row& from, Row& to) {
    const double* const weight = &q.weights[v * to.size()];
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[k] + x * weight[k];
  }

  void evaluate(const Mesh& mesh, std::size_t c) {
    for (std::size_t q = 0; q < 3; ++q) {
      Row& exact = trial_exact_[c][q];
      std::ranges::fill(exact, 0.);
      for (std::size_t v = 0; v < mesh.size(); ++v)
        add(quantities_[q], v, static_cast<double>(mesh[v][c]), exact, exact);
    }
  }

  // Of each coordinate the largest share of a bound, over the points: what is climbed.
  std::array<double, 3> measure(const Mesh& mesh, bool climb_tangents) {
    std::array<double, 3> climbed{};
    run_kernel(mesh, [&](std::size_t k, const fast::LimitFrame<float>& f) {
      const bool has_tangents = bounds_.points[k].has_tangents;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto error = [&](std::size_t q, const fast::Vec3<float>& found) {
          const double exact = trial_exact_[c][q][k];
          return std::abs(static_cast<double>(found[c]) - exact) - quantities_[q].doubt[k];
        };
        const double position = error(0, f.position), share = position * quantities_[0].per_bound[k];
        proof_.position_worst = std::max(proof_.position_worst, position);
        double tangent_share = 0;
        if (has_tangents) {
          const double du = error(1, f.du), dv = error(2, f.dv);
          tangent_share = std::max(du * quantities_[1].per_bound[k], dv * quantities_[2].per_bound[k]);
          proof_.tangent_worst = std::max(
              {proof_.tangent_worst, du * quantities_[1].per_size[k], dv * quantities_[2].per_size[k]});
        }
        proof_.share = std::max({proof_.share, share, tangent_share});
        climbed[c] = std::max(climbed[c], climb_tangents ? tangent_share : share);
      }
    });
    return climbed;
  }

  const Neighbourhood& neighbourhood_;
  const KernelBounds& bounds_;
  double reach_;
  data::SplitMix64 random_;
  std::array<Quantity, 3> quantities_;
  std::vector<PointBound> normals_;  // of all points, made in double or not
  BoundProof proof_;
  std::array<std::array<Row, 3>, 3> best_exact_, trial_exact_;  // [coordinate][quantity][point]
};

}  // namespace

BoundProof search_worst(const Neighbourhood& neighbourhood, const KernelBounds& bounds, int meshes,
                        std::uint64_t seed, double reach) {
  return Search(neighbourhood, bounds, reach, seed).run(meshes);
}

}  // namespace limitcheck::verify
