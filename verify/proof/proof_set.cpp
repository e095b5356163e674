// SPDX-License-Identifier: MIT
#include "verify/proof/proof_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "data/generators/bumpy_sphere.h"

namespace limitcheck::verify {
namespace {

/// Pairs that hold every triple, two at a time where there is such a mesh.
std::vector<Neighbourhood> triples(const std::vector<int>& valences, std::vector<std::string>& impossible) {
  std::vector<Neighbourhood> pairs;
  std::set<std::array<int, 3>> none;
  for (const int a : valences) {
    for (const int c : valences) {
      if (c < a) continue;
      std::set<int> open(valences.begin(), valences.end());
      while (!open.empty()) {
        const int d = *open.begin();
        open.erase(open.begin());
        // The largest partner first, so that small and large valences meet; any partner if all are done.
        std::vector<int> partners(open.rbegin(), open.rend());
        partners.push_back(d);
        for (int b = 3; b <= 12; ++b) partners.push_back(b);
        const auto found = std::ranges::find_if(partners, [&](int b) {
          return interior_pair({a, b, c, d}).has_value();
        });
        if (found == partners.end()) {
          std::array<int, 3> triple{a, c, d};
          std::ranges::sort(triple);
          none.insert(triple);
          continue;
        }
        pairs.push_back(*interior_pair({a, *found, c, d}));
        open.erase(*found);
      }
    }
  }
  for (const auto& t : none) impossible.push_back(fmt::format("{} {} {}", t[0], t[1], t[2]));
  return pairs;
}

/// As few of the pairs as still hold every triple of valences, in any order of its corners.
std::vector<Neighbourhood> each_triple_once(const std::vector<Neighbourhood>& pairs) {
  const auto triples_of = [](const Neighbourhood& pair) {
    std::array<int, 4> v{};
    std::istringstream(pair.name) >> v[0] >> v[1] >> v[2] >> v[3];
    std::array<std::array<int, 3>, 2> both{{{v[0], v[2], v[3]}, {v[0], v[1], v[2]}}};
    for (auto& triple : both) std::ranges::sort(triple);
    return both;
  };
  std::vector<Neighbourhood> chosen;
  std::set<std::array<int, 3>> held;
  for (const int fresh : {2, 1}) {
    for (const Neighbourhood& pair : pairs) {
      const auto [first, second] = triples_of(pair);
      const int added = (held.contains(first) ? 0 : 1) + (second == first || held.contains(second) ? 0 : 1);
      if (added < fresh) continue;
      chosen.push_back(pair);
      held.insert({first, second});
    }
  }
  return chosen;
}

/// What a full set costs in seconds of one core, roughly: for the progress bar and its estimate.
double estimated_seconds(const ProofTask& task) {
  const auto at = [](int depth) { return std::exp2(2. * depth); };
  const auto vertices = static_cast<double>(task.neighbourhood.mesh.positions.size());
  const MapOptions& o = task.options;
  const double weight = o.arithmetic == Arithmetic::kResidues ? 2e-6 : 8e-5;
  double seconds = weight * vertices * at(o.last_depth);
  if (task.bounds) {
    const double points = at(task.bounds->last_depth) * (task.bounds->last_depth > 4 ? 1. / 5 : 1);
    seconds += (3e-4 + 1e-6 * vertices) * at(task.bounds->last_depth) + 2e-6 * points * task.bounds->meshes +
               1e-6 * vertices * at(task.bounds->last_depth);
  }
  return seconds;
}

ProofSet sample_of(ProofRequest request) {
  request.size = ProofSize::kStandard;
  ProofSet set = proof_set(request);
  set.certified_points = 1;
  std::map<std::pair<std::string, Arithmetic>, int> seen;
  std::erase_if(set.tasks, [&](const ProofTask& task) {
    return seen[{task.group, task.options.arithmetic}]++ % 10 != 0;
  });
  return set;
}

ProofSet triangle_proof_set(const ProofRequest& request) {
  ProofSet set;
  const bool full = request.size == ProofSize::kFull;
  const auto add = [&](const char* group, const std::vector<Neighbourhood>& pairs, Arithmetic arithmetic,
                       int first, int last, std::optional<BoundOptions> bounds = {}) {
    MapOptions options;
    options.arithmetic = arithmetic;
    options.first_depth = first;
    options.last_depth = std::min(last, request.depth);
    options.sliding_window = request.sliding_window;
    options.row_stream = request.row_stream;
    if (options.last_depth < first) return;
    if (bounds) bounds->last_depth = std::min(bounds->last_depth, request.depth);
    if (bounds && bounds->last_depth < bounds->first_depth) bounds.reset();
    for (const Neighbourhood& pair : pairs) {
      ProofTask task{group, pair, options, bounds, 0};
      task.estimate = estimated_seconds(task);
      set.tasks.push_back(std::move(task));
    }
  };
  const int meshes = full ? 400 : 40;

  const auto interior = triples(request.valences, set.impossible);
  const auto once = each_triple_once(interior);
  add("triples", interior, Arithmetic::kResidues, 0, full ? 6 : 4, BoundOptions{0, 4, meshes});
  add("deep", once, Arithmetic::kResidues, 5, request.depth,
      full ? std::optional(BoundOptions{5, 6, meshes}) : std::nullopt);
  add("digits", full ? interior : once, Arithmetic::kDigits, 0, full ? 3 : 2);

  std::vector<Neighbourhood> rational, high, boundary;
  constexpr int kRational[] = {3, 4, 6};
  for (const int a : kRational)
    for (const int b : kRational)
      for (const int c : kRational)
        for (const int d : kRational)
          if (auto pair = interior_pair({a, b, c, d})) rational.push_back(std::move(*pair));
  add("rational", rational, Arithmetic::kExact, 0, full ? 5 : 2);

  for (const int n : {20, 50, 100})
    for (const auto& valences :
         {std::array{n, 6, 6, 6}, std::array{6, n, 6, 6}, std::array{n, 5, 7, 6}, std::array{n, n, n, n}})
      high.push_back(*interior_pair(valences));
  add("high", high, Arithmetic::kResidues, 0, full ? 6 : 4, BoundOptions{0, full ? 6 : 4, meshes});
  if (!full) std::erase_if(high, [](const Neighbourhood& pair) { return pair.mesh.positions.size() > 100; });
  add("high", high, Arithmetic::kDigits, 0, full ? 3 : 1);

  std::set<std::string> seen;
  const auto add_boundary = [&](const std::array<int, 4>& valences) {
    for (Neighbourhood& pair : boundary_pairs(valences))
      if (seen.insert(pair.name).second) boundary.push_back(std::move(pair));
  };
  add_boundary({6, 6, 6, 6});
  if (full) add("boundary-deep", boundary, Arithmetic::kResidues, 5, 6, BoundOptions{5, 6, meshes});
  if (!full) add("boundary", boundary, Arithmetic::kDigits, 0, 1);
  for (const auto& valences : {std::array{5, 4, 7, 8}, std::array{3, 6, 6, 5}, std::array{6, 3, 5, 6}})
    add_boundary(valences);
  add("boundary", boundary, Arithmetic::kResidues, 0, full ? 6 : 3, BoundOptions{0, full ? 4 : 3, meshes});
  if (full) add("boundary", boundary, Arithmetic::kDigits, 0, 3);

  const std::vector<Neighbourhood> alone{face_alone()};
  add("alone", alone, Arithmetic::kResidues, 0, full ? 6 : 4, BoundOptions{0, full ? 6 : 4, meshes});
  add("alone", alone, Arithmetic::kDigits, 0, full ? 4 : 2);
  add("alone", alone, Arithmetic::kExact, 0, full ? 6 : 3);

  std::vector<Neighbourhood> spheres;
  seen.clear();
  for (const int faces : full ? std::vector{200, 800, 2000, 4000} : std::vector{200})
    for (Neighbourhood& pair : pairs_of(data::bumpy_sphere(faces, 1)))
      if (seen.insert(pair.name).second) spheres.push_back(std::move(pair));
  add("spheres", spheres, Arithmetic::kResidues, 0, full ? 6 : 3, BoundOptions{0, full ? 4 : 3, 40});
  return set;
}

}  // namespace

ProofSet proof_set(const ProofRequest& request) {
  if (request.size == ProofSize::kSample) return sample_of(request);
  ProofSet set =
      request.scheme == data::Scheme::kCatmullClark ? quad_proof_set(request) : triangle_proof_set(request);
  std::vector<FloatKernel> kernels;
  if (request.sliding_window) kernels.push_back(FloatKernel::kSlidingWindow);
  if (request.row_stream) kernels.push_back(FloatKernel::kRowStream);
  set.certified = stock_shape_lines(kernels, std::min(request.depth, 4), request.scheme);
  return set;
}

}  // namespace limitcheck::verify
