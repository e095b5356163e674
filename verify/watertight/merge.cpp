// SPDX-License-Identifier: MIT
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <bit>
#include <cmath>
#include <type_traits>

#include "verify/watertight/watertight.h"

namespace limitcheck::verify {
namespace {

// Vertices are brought together by sorting (hash, vertex); within equal hashes the coordinates decide, so
// that a collision costs time and never correctness.
struct Keyed {
  std::uint64_t hash;
  std::int32_t vertex;
};

std::uint64_t mix(std::uint64_t h, std::uint64_t bits) {
  h = (h ^ bits) * 0x9E3779B97F4A7C15u;
  return h ^ (h >> 29);
}

template <class Real>
MergedPoints merge(std::span<const Real> positions) {
  using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
  const auto count = static_cast<std::int32_t>(positions.size() / 3);
  const auto coordinate = [&](std::int32_t v, int axis) {
    return positions[3 * static_cast<std::size_t>(v) + axis];
  };
  const auto same = [&](std::int32_t a, std::int32_t b) {
    return coordinate(a, 0) == coordinate(b, 0) && coordinate(a, 1) == coordinate(b, 1) &&
           coordinate(a, 2) == coordinate(b, 2);
  };
  const auto less = [&](std::int32_t a, std::int32_t b) {
    for (int axis = 0; axis < 3; ++axis)
      if (coordinate(a, axis) != coordinate(b, axis)) return coordinate(a, axis) < coordinate(b, axis);
    return a < b;
  };

  // Hash. Adding +0 turns -0 into +0 and changes nothing else.
  std::vector<Keyed> keys(count);
  std::vector<std::int32_t> first(count);  // the first vertex in the same place, or -1
  tbb::parallel_for(std::int32_t{0}, count, [&](std::int32_t v) {
    std::uint64_t hash = 0;
    bool finite = true;
    for (int axis = 0; axis < 3; ++axis) {
      finite = finite && std::isfinite(coordinate(v, axis));
      hash = mix(hash, std::bit_cast<Bits>(static_cast<Real>(coordinate(v, axis) + Real{0})));
    }
    keys[v] = {hash, v};
    first[v] = finite ? v : -1;
  });
  tbb::parallel_sort(keys.begin(), keys.end(), [](const Keyed& a, const Keyed& b) {
    return a.hash != b.hash ? a.hash < b.hash : a.vertex < b.vertex;
  });

  // Runs of one hash: nearly always one place, in ascending order of vertices.
  std::vector<std::int32_t> run;
  for (std::size_t begin = 0; begin < keys.size();) {
    std::size_t end = begin + 1;
    bool one_place = true;
    for (; end < keys.size() && keys[end].hash == keys[begin].hash; ++end)
      one_place = one_place && same(keys[begin].vertex, keys[end].vertex);
    if (end - begin > 1) {
      run.clear();
      for (std::size_t k = begin; k < end; ++k)
        if (first[keys[k].vertex] >= 0) run.push_back(keys[k].vertex);
      if (!one_place) std::sort(run.begin(), run.end(), less);
      for (std::size_t k = 1; k < run.size(); ++k)
        if (same(run[k - 1], run[k])) first[run[k]] = first[run[k - 1]];
    }
    begin = end;
  }

  // Number the places by first appearance.
  MergedPoints merged;
  merged.point_of.resize(count);
  for (std::int32_t v = 0; v < count; ++v) {
    if (first[v] == v) {
      merged.point_of[v] = static_cast<std::int32_t>(merged.vertex_of.size());
      merged.vertex_of.push_back(v);
    } else {
      merged.point_of[v] = first[v] < 0 ? -1 : merged.point_of[first[v]];
    }
  }
  return merged;
}

}  // namespace

MergedPoints merge_identical(std::span<const float> positions) {
  return merge(positions);
}
MergedPoints merge_identical(std::span<const double> positions) {
  return merge(positions);
}

}  // namespace limitcheck::verify
