// SPDX-License-Identifier: MIT
#include "verify/proof/proof_set.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <mutex>
#include <set>

#include "data/generators/bumpy_sphere.h"

namespace limitcheck::verify {
namespace {

/// A face with its corners on the pair's diagonal, in rising order, and the one that faces it.
struct Triple {
  int low, high, apex;
  friend auto operator<=>(const Triple&, const Triple&) = default;
};

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

}  // namespace

ProofSet proof_set(const ProofRequest& request) {
  ProofSet set;
  const bool full = request.size == ProofSize::kFull;
  const auto add = [&](const char* group, const std::vector<Neighbourhood>& pairs, Arithmetic arithmetic,
                       int depth) {
    MapOptions options;
    options.arithmetic = arithmetic;
    options.last_depth = std::min(depth, request.depth);
    options.sliding_window = request.sliding_window;
    options.row_stream = request.row_stream;
    for (const Neighbourhood& pair : pairs) set.tasks.push_back({group, pair, options});
  };

  const auto interior = triples(request.valences, set.impossible);
  add("triples", interior, Arithmetic::kResidues, request.depth);
  add("digits", interior, Arithmetic::kDigits, full ? 4 : 2);

  std::vector<Neighbourhood> rational, high, boundary;
  constexpr int kRational[] = {3, 4, 6};
  for (const int a : kRational)
    for (const int b : kRational)
      for (const int c : kRational)
        for (const int d : kRational)
          if (auto pair = interior_pair({a, b, c, d})) rational.push_back(std::move(*pair));
  add("rational", rational, Arithmetic::kExact, full ? 5 : 3);

  for (const int n : {20, 50, 100})
    for (const auto& valences :
         {std::array{n, 6, 6, 6}, std::array{6, n, 6, 6}, std::array{n, 5, 7, 6}, std::array{n, n, n, n}})
      high.push_back(*interior_pair(valences));
  add("high", high, Arithmetic::kResidues, full ? 6 : 4);
  add("high", high, Arithmetic::kDigits, full ? 3 : 1);

  std::set<std::string> seen;
  for (const auto& valences :
       {std::array{6, 6, 6, 6}, std::array{5, 4, 7, 8}, std::array{3, 6, 6, 5}, std::array{6, 3, 5, 6}})
    for (Neighbourhood& pair : boundary_pairs(valences))
      if (seen.insert(pair.name).second) boundary.push_back(std::move(pair));
  add("boundary", boundary, Arithmetic::kResidues, full ? 6 : 4);
  add("boundary", boundary, Arithmetic::kDigits, full ? 3 : 1);

  std::vector<Neighbourhood> spheres;
  seen.clear();
  for (const int faces : full ? std::vector{200, 800, 2000, 4000} : std::vector{200})
    for (Neighbourhood& pair : pairs_of(data::bumpy_sphere(faces, 1)))
      if (seen.insert(pair.name).second) spheres.push_back(std::move(pair));
  add("spheres", spheres, Arithmetic::kResidues, full ? 4 : 2);
  return set;
}

std::vector<std::vector<ProofRow>> prove(const std::vector<ProofTask>& tasks,
                                         const std::function<void(std::size_t)>& progress) {
  std::vector<std::vector<ProofRow>> result(tasks.size());
  std::mutex mutex;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t t) {
    result[t] = prove_map(tasks[t].neighbourhood, tasks[t].options);
    const std::scoped_lock lock(mutex);
    ++done;
    if (progress) progress(done);
  });
  return result;
}

}  // namespace limitcheck::verify
