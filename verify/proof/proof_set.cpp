// SPDX-License-Identifier: MIT
#include "verify/proof/proof_set.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <initializer_list>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <utility>

#include "data/generators/bumpy_sphere.h"
#include "verify/proof/bounds/bounds.h"
#include "verify/proof/numbers/operation_count.h"
#include "verify/proof/topologies/proof_row.h"

namespace limitcheck::verify {
namespace {

/// What a task costs in seconds of one core, roughly: for the progress bar and its estimate.
double estimated_seconds(const ProofTask& task) {
  const auto at = [](int depth) { return std::exp2(2. * depth); };
  const auto vertices = static_cast<double>(task.neighbourhood.mesh.positions.size());
  const MapOptions& o = task.options;
  if (!task.neighbourhood.mesh.faces.are_triangles()) {
    constexpr double kWeights[]{1.5e-4, 8e-6, 3e-4};  // in the order of Arithmetic
    return 1e-3 + kWeights[static_cast<std::size_t>(o.arithmetic)] * vertices * at(o.last_depth) +
           (task.bounds ? 4e-4 * at(task.bounds->last_depth) : 0);
  }
  const double weight = o.arithmetic == Arithmetic::kResidues ? 2e-6 : 8e-5;
  double seconds = weight * vertices * at(o.last_depth);
  if (task.bounds) {
    const auto& [first, last, meshes] = *task.bounds;
    seconds += (3e-4 + 2e-6 * vertices + 2e-6 * meshes * (last > 4 ? 1. / 5 : 1)) * at(last);
  }
  return seconds;
}

/// The first and the last of some depths; none without a last.
struct Depths {
  int first = 0, last = -1;
};

/// Some topologies in one arithmetic, with the depths of their maps and of their bounds: in the standard set, and in the
/// full one.
struct Group {
  const char* name;
  const std::vector<Neighbourhood>& topologies;
  Arithmetic arithmetic;
  std::array<Depths, 2> map, bounds{};
};

/// The tasks of these groups, no deeper than was asked for.
///   meshes   tried against the bounds at each depth, in either set; of spheres always 40
std::vector<ProofTask> tasks_of(const ProofRequest& request, std::array<int, 2> meshes,
                                std::initializer_list<Group> groups) {
  const std::size_t size = request.size == ProofSize::kFull ? 1 : 0;
  std::vector<ProofTask> tasks;
  for (const Group& group : groups) {
    const auto last = [&](const Depths& depths) { return std::min(depths.last, request.depth); };
    const Depths &map = group.map[size], &bounds = group.bounds[size];
    if (last(map) < map.first) continue;
    for (const Neighbourhood& topology : group.topologies) {
      ProofTask& task = tasks.emplace_back(ProofTask{group.name, topology, {}, {}, 0});
      task.options = {group.arithmetic, map.first, last(map), request.sliding_window, request.row_stream};
      if (last(bounds) >= bounds.first)
        task.bounds = {bounds.first, last(bounds), task.group == "spheres" ? 40 : meshes[size]};
      task.estimate = estimated_seconds(task);
    }
  }
  return tasks;
}

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

using Valences = std::array<int, 4>;

std::vector<Valences> quadruples(const std::vector<int>& valences) {
  std::vector<Valences> all;
  for (const int a : valences)
    for (const int b : valences)
      for (const int c : valences)
        for (const int d : valences) all.push_back({a, b, c, d});
  return all;
}

/// Those whose names were not seen before.
void add_new(std::vector<Neighbourhood>& to, std::vector<Neighbourhood> from, std::set<std::string>& seen) {
  for (Neighbourhood& topology : from)
    if (seen.insert(topology.name).second) to.push_back(std::move(topology));
}

using enum Arithmetic;

ProofSet triangle_proof_set(const ProofRequest& request) {
  const bool full = request.size == ProofSize::kFull;
  ProofSet set;
  const auto interior = triples(request.valences, set.impossible);
  const auto once = each_triple_once(interior);
  std::vector<Neighbourhood> rational, high, boundary, spheres;
  for (const Valences& v : quadruples({3, 4, 6}))
    if (auto pair = interior_pair(v)) rational.push_back(std::move(*pair));
  for (const int n : {20, 50, 100})
    for (const Valences& v :
         {Valences{n, 6, 6, 6}, Valences{6, n, 6, 6}, Valences{n, 5, 7, 6}, Valences{n, n, n, n}})
      high.push_back(*interior_pair(v));
  std::vector<Neighbourhood> small = high;
  if (!full) std::erase_if(small, [](const Neighbourhood& pair) { return pair.mesh.positions.size() > 100; });
  std::set<std::string> seen;
  add_new(boundary, boundary_pairs({6, 6, 6, 6}), seen);
  const std::vector<Neighbourhood> regular = boundary, alone{face_alone()};
  for (const Valences& v : {Valences{5, 4, 7, 8}, Valences{3, 6, 6, 5}, Valences{6, 3, 5, 6}})
    add_new(boundary, boundary_pairs(v), seen);
  seen.clear();
  for (const int faces : full ? std::vector{200, 800, 2000, 4000} : std::vector{200})
    add_new(spheres, pairs_of(data::bumpy_sphere(faces, 1)), seen);

  set.tasks = tasks_of(
      request, {40, 400},
      {// Every triple of valences, each of its corners once facing the pair's diagonal; then every triple once.
       {"triples", interior, kResidues, {{{0, 4}, {0, 6}}}, {{{0, 4}, {0, 4}}}},
       {"deep", once, kResidues, {{{5, 10}, {5, 10}}}, {{{}, {5, 6}}}},
       {"digits", full ? interior : once, kDigits, {{{0, 2}, {0, 3}}}},
       {"rational", rational, kExact, {{{0, 2}, {0, 5}}}},
       {"high", high, kResidues, {{{0, 4}, {0, 6}}}, {{{0, 4}, {0, 6}}}},
       {"high", small, kDigits, {{{0, 1}, {0, 3}}}},
       {"boundary-deep", regular, kResidues, {{{}, {5, 6}}}, {{{}, {5, 6}}}},
       {"boundary", regular, kDigits, {{{0, 1}, {}}}},
       {"boundary", boundary, kResidues, {{{0, 3}, {0, 6}}}, {{{0, 3}, {0, 4}}}},
       {"boundary", boundary, kDigits, {{{}, {0, 3}}}},
       {"alone", alone, kResidues, {{{0, 4}, {0, 6}}}, {{{0, 4}, {0, 6}}}},
       {"alone", alone, kDigits, {{{0, 2}, {0, 4}}}},
       {"alone", alone, kExact, {{{0, 3}, {0, 6}}}},
       {"spheres", spheres, kResidues, {{{0, 3}, {0, 6}}}, {{{0, 3}, {0, 4}}}}});
  return set;
}

Valences turned(const Valences& v, std::size_t by) {
  return {v[by % 4], v[(by + 1) % 4], v[(by + 2) % 4], v[(by + 3) % 4]};
}

/// One of every quadruple and its turns: each begins elsewhere.
std::vector<Valences> up_to_turns(const std::vector<Valences>& all) {
  std::vector<Valences> chosen;
  std::set<Valences> seen;
  for (const Valences& v : all) {
    if (seen.contains(v)) continue;
    for (std::size_t k = 0; k < 4; ++k) seen.insert(turned(v, k));
    chosen.push_back(turned(v, chosen.size()));
  }
  return chosen;
}

std::vector<Neighbourhood> quads_of(const std::vector<Valences>& valences) {
  std::vector<Neighbourhood> quads;
  for (const Valences& v : valences) quads.push_back(interior_quad(v));
  return quads;
}

ProofSet quad_proof_set(const ProofRequest& request) {
  const bool full = request.size == ProofSize::kFull;
  const std::vector<Valences> quadruple = quadruples(request.valences);
  const auto all = quads_of(quadruple), once = quads_of(up_to_turns(quadruple));
  std::vector<Valences> some, many;
  for (const Valences& v :
       {Valences{4, 4, 4, 3}, Valences{5, 4, 4, 4}, Valences{3, 5, 7, 4}, Valences{6, 3, 8, 5}})
    for (std::size_t k = 0; k < 4; ++k) some.push_back(turned(v, k));
  some.push_back({4, 4, 4, 4});
  for (const int n : {20, 50})
    for (const Valences& v :
         {Valences{n, 4, 4, 4}, Valences{n, 3, 5, 8}, Valences{n, n, 4, 3}, Valences{n, n, n, n}})
      for (std::size_t k = 0; k < (v[1] == n && v[2] == n ? 1U : 4U); ++k) many.push_back(turned(v, k));
  const auto deep = quads_of(some), high = quads_of(many);
  if (!full) std::erase_if(many, [](const Valences& v) { return v[0] + v[1] + v[2] + v[3] > 70; });
  const auto small = quads_of(many);

  std::vector<Neighbourhood> boundary, cuts, darts, semi_sharp;
  std::set<std::string> seen;
  for (const Valences& v : {Valences{4, 4, 4, 4}, Valences{5, 3, 6, 4}}) {
    add_new(boundary, boundary_quads(v), seen);
    for (Neighbourhood& quad : creased_quads(v)) {
      std::vector<Neighbourhood>& to = has_dart(quad.mesh) ? darts : cuts;
      to.push_back(std::move(quad));
    }
    for (Neighbourhood& quad : semi_sharp_quads(v))
      if (!has_dart(quad.mesh)) semi_sharp.push_back(std::move(quad));
  }
  if (full) add_new(boundary, boundary_quads({3, 3, 8, 5}), seen);

  ProofSet set;
  set.tasks = tasks_of(request, {20, 200},
                       {// Every four valences in every order; then one of their turns.
                        {"quadruples", all, kResidues, {{{0, 2}, {0, 4}}}, {{{0, 2}, {0, 4}}}},
                        {"quadruples", once, kExact, {{{0, 1}, {0, 3}}}},
                        {"quadruples", once, kDigits, {{{0, 0}, {0, 2}}}},
                        {"deep", deep, kResidues, {{{0, 6}, {0, 7}}}, {{{0, 5}, {0, 6}}}},
                        {"deep", deep, kExact, {{{0, 3}, {0, 5}}}},
                        {"deep", deep, kDigits, {{{0, 2}, {0, 4}}}},
                        {"high", high, kResidues, {{{0, 2}, {0, 5}}}, {{{0, 2}, {0, 4}}}},
                        {"high", small, kExact, {{{0, 1}, {0, 2}}}},
                        {"high", small, kDigits, {{{0, 0}, {0, 1}}}},
                        {"boundary", boundary, kResidues, {{{0, 3}, {0, 5}}}, {{{0, 2}, {0, 4}}}},
                        {"boundary", boundary, kExact, {{{0, 1}, {0, 3}}}},
                        {"boundary", boundary, kDigits, {{{0, 0}, {0, 2}}}},
                        {"cuts", cuts, kExact, {{{0, 2}, {0, 3}}}, {{{0, 2}, {0, 4}}}},
                        {"cuts", cuts, kDigits, {{{0, 0}, {0, 2}}}},
                        {"darts", darts, kDigits, {{{0, 1}, {0, 3}}}, {{{0, 2}, {0, 4}}}},
                        {"semi-sharp", semi_sharp, kExact, {{{0, 1}, {0, 3}}}, {{{0, 2}, {0, 4}}}}});
  return set;
}

std::optional<BoundProof> bound_of(const std::string& kernel, const ProofTask& task) {
  const ProvedKernel k = kernel_named(kernel);
  const BoundOptions& o = *task.bounds;
  if (k != ProvedKernel::kCrackCentre)
    return prove_bound(k, task.neighbourhood, o.first_depth, o.last_depth, o.meshes);
  if (o.first_depth > 0) return std::nullopt;  // knows no depth
  return prove_bound(k, task.neighbourhood, 0, 0, o.meshes);
}

std::optional<CostProof> cost_of(const std::string& kernel, const ProofTask& task) {
  const bool window = kernel_named(kernel) == ProvedKernel::kSlidingWindow;
  if (!window && kernel_named(kernel) != ProvedKernel::kRowStream) return std::nullopt;
  const data::ControlMesh& mesh = task.neighbourhood.mesh;
  if (mesh.faces.size() == 1 || !mesh.faces.are_triangles()) return std::nullopt;  // counted per pair
  const KernelCost cost = count_operations(window ? CountedKernel::kSlidingWindow : CountedKernel::kRowStream,
                                           mesh, task.options.last_depth);
  return CostProof{cost.flops_per_point(), cost.vectors_per_point()};
}

/// Nothing if it was stopped on the way.
std::vector<ProofRow> rows_of(const ProofTask& task, const std::function<bool()>& stop) {
  std::vector<ProofRow> rows = prove_map(task.neighbourhood, task.options);
  for (ProofRow& row : rows) {
    if (stop && stop()) return {};
    const ThreadClock clock;
    if (task.bounds) row.bound = bound_of(row.kernel, task);
    row.cost = cost_of(row.kernel, task);
    row.seconds += clock.seconds();
  }
  return rows;
}

}  // namespace

ProofSet proof_set(const ProofRequest& request) {
  if (request.size == ProofSize::kSample) return sample_of(request);
  ProofSet set =
      request.scheme == data::Scheme::kCatmullClark ? quad_proof_set(request) : triangle_proof_set(request);
  set.scheme = request.scheme;
  std::vector<ProvedKernel> kernels;
  if (request.sliding_window) kernels.push_back(ProvedKernel::kSlidingWindow);
  if (request.row_stream) kernels.push_back(ProvedKernel::kRowStream);
  set.certified = stock_shape_lines(kernels, std::min(request.depth, 4), request.scheme);
  return set;
}

std::vector<std::vector<ProofRow>> prove(const std::vector<ProofTask>& tasks,
                                         const std::function<void(const ProofProgress&)>& progress,
                                         const std::function<bool()>& stop) {
  std::vector<std::vector<ProofRow>> result(tasks.size());
  double all = 0;
  for (const ProofTask& task : tasks) all += task.estimate;
  std::mutex mutex;
  ProofProgress done;
  std::atomic<std::size_t> next = 0;
  // In the order of the set, so that what is there after a stop is whole groups and the beginning of one.
  tbb::parallel_for(
      0, tbb::this_task_arena::max_concurrency(),
      [&](int) {
        for (std::size_t t = next++; t < tasks.size() && !(stop && stop()); t = next++) {
          result[t] = rows_of(tasks[t], stop);
          const std::scoped_lock lock(mutex);
          ++done.tasks;
          done.share += tasks[t].estimate / all;
          done.latest = &tasks[t];
          done.rows = &result[t];
          if (progress) progress(done);
        }
      },
      tbb::simple_partitioner());
  return result;
}

}  // namespace limitcheck::verify
