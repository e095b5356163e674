// SPDX-License-Identifier: MIT
// Our own method: points merged by sorting, and the star of each point looked at by itself.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "verify/watertight/watertight.h"

namespace limitcheck::verify {
namespace {

template <class Real>
MergedPoints merge(std::span<const Real> positions) {
  const auto count = static_cast<std::int32_t>(positions.size() / 3);
  const auto place = [&](std::int32_t v) { return positions.subspan(3 * static_cast<std::size_t>(v), 3); };
  const auto same = [&](std::int32_t a, std::int32_t b) { return std::ranges::equal(place(a), place(b)); };

  // Vertices in order of their places; x, which nearly always decides, lies beside the vertex.
  struct Keyed {
    Real x;
    std::int32_t vertex;
  };
  std::vector<Keyed> keys;
  for (std::int32_t v = 0; v < count; ++v)
    if (std::ranges::all_of(place(v), [](Real x) { return std::isfinite(x); }))
      keys.push_back({place(v)[0], v});
  tbb::parallel_sort(keys.begin(), keys.end(), [&](const Keyed& a, const Keyed& b) {
    if (a.x != b.x) return a.x < b.x;
    return same(a.vertex, b.vertex) ? a.vertex < b.vertex
                                    : std::ranges::lexicographical_compare(place(a.vertex), place(b.vertex));
  });
  std::vector<std::int32_t> first(count, -1);  // the first vertex in the same place
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const std::int32_t v = keys[k].vertex;
    first[v] = k > 0 && same(keys[k - 1].vertex, v) ? first[keys[k - 1].vertex] : v;
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

using Triangle = std::array<std::int32_t, 3>;
using Edge = SurfaceReport::Edge;
constexpr std::size_t kWitnesses = 16;
constexpr std::int32_t kGrain = 4096;

template <class T>
void note(std::int64_t& count, std::vector<T>& witnesses, const T& value) {
  ++count;
  if (witnesses.size() < kWitnesses) witnesses.push_back(value);
}

template <class T>
void append(std::int64_t& count, std::vector<T>& witnesses, std::int64_t more, const std::vector<T>& theirs) {
  count += more;
  witnesses.insert(witnesses.end(), theirs.begin(),
                   theirs.begin() + std::min(theirs.size(), kWitnesses - witnesses.size()));
}

// The star of a point v: for each triangle (v, next, previous) counter-clockwise. The directed edge v -> next
// belongs to v; the directed edge previous -> v is seen here and belongs to `previous`.
struct Ray {
  std::int32_t next, previous, triangle;
};

class StarInspector {
 public:
  void inspect(std::int32_t v, std::span<Ray> star, SurfaceReport& out) {
    std::ranges::sort(star, {}, [](const Ray& r) { return std::pair(r.next, r.triangle); });
    by_previous_.assign(star.begin(), star.end());
    std::ranges::sort(by_previous_, {}, [](const Ray& r) { return std::pair(r.previous, r.triangle); });
    edges(v, star, out);
    duplicates(v, star, out);
    if (fans(star) > 1) note(out.bow_tie_points, out.bow_tie_witness, v);
  }

 private:
  // Every neighbour w: how many triangles run v -> w, how many w -> v.
  void edges(std::int32_t v, std::span<const Ray> star, SurfaceReport& out) {
    neighbours_.clear();
    std::size_t i = 0, j = 0;
    while (i < star.size() || j < by_previous_.size()) {
      const std::int32_t w =
          j == by_previous_.size() || (i < star.size() && star[i].next < by_previous_[j].previous)
              ? star[i].next
              : by_previous_[j].previous;
      neighbours_.push_back(w);
      const std::size_t i0 = i, j0 = j;
      while (i < star.size() && star[i].next == w) ++i;
      while (j < by_previous_.size() && by_previous_[j].previous == w) ++j;
      const std::size_t away = i - i0, back = j - j0;
      const Edge edge{v, w, away > 0 ? star[i0].triangle : by_previous_[j0].triangle};
      if (away == 1 && back == 0) out.open_edges.push_back(edge);
      if (v > w) continue;  // undirected facts are told once, by the smaller point
      ++out.edges;
      if (away + back > 2)
        note(out.crowded_edges, out.crowded_witness, edge);
      else if (away == 2 || back == 2)
        note(out.clashing_edges, out.clashing_witness, edge);
    }
  }

  // Counted once, by the smallest of the three points.
  void duplicates(std::int32_t v, std::span<const Ray> star, SurfaceReport& out) {
    pairs_.clear();
    for (const Ray& r : star)
      if (v < r.next && v < r.previous)
        pairs_.push_back({std::min(r.next, r.previous), std::max(r.next, r.previous), r.triangle});
    std::sort(pairs_.begin(), pairs_.end());
    for (std::size_t k = 1; k < pairs_.size(); ++k)
      if (pairs_[k][0] == pairs_[k - 1][0] && pairs_[k][1] == pairs_[k - 1][1])
        note(out.duplicate_triangles, out.duplicate_witness, pairs_[k][2]);
  }

  // The number of fans: neighbours joined by the triangles of the star.
  std::int32_t fans(std::span<const Ray> star) {
    parent_.resize(neighbours_.size());
    std::iota(parent_.begin(), parent_.end(), 0);
    auto count = static_cast<std::int32_t>(neighbours_.size());
    const auto root_of = [&](std::int32_t neighbour) {
      const auto at = std::lower_bound(neighbours_.begin(), neighbours_.end(), neighbour);
      return root(static_cast<std::int32_t>(at - neighbours_.begin()));
    };
    for (const Ray& r : star) {
      const std::int32_t a = root_of(r.next), b = root_of(r.previous);
      if (a == b) continue;
      parent_[a] = b;
      --count;
    }
    return count;
  }

  std::int32_t root(std::int32_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }

  std::vector<Ray> by_previous_;
  std::vector<std::array<std::int32_t, 3>> pairs_;
  std::vector<std::int32_t> neighbours_, parent_;  // of the star, ascending; of each in its tree
};

// Closed walks along the open edges, or -1 where a point has more than one of them leaving or none.
std::int64_t count_loops(std::int64_t point_count, const std::vector<Edge>& open) {
  std::vector<std::int32_t> leaving(point_count, -1);
  for (std::size_t e = 0; e < open.size(); ++e) {
    if (leaving[open[e].from] >= 0) return -1;
    leaving[open[e].from] = static_cast<std::int32_t>(e);
  }
  std::vector<bool> walked(open.size(), false);
  std::int64_t loops = 0;
  for (std::size_t start = 0; start < open.size(); ++start) {
    if (walked[start]) continue;
    ++loops;
    for (auto e = static_cast<std::int32_t>(start); !walked[e]; e = leaving[open[e].to]) {
      walked[e] = true;
      if (leaving[open[e].to] < 0) return -1;
    }
  }
  return loops;
}

}  // namespace

MergedPoints merge_identical(std::span<const float> positions) {
  return merge(positions);
}
MergedPoints merge_identical(std::span<const double> positions) {
  return merge(positions);
}

SurfaceReport inspect_surface(std::int64_t point_count, std::span<const Triangle> triangles) {
  SurfaceReport report;
  report.points = point_count;
  report.triangles = static_cast<std::int64_t>(triangles.size());

  // The stars, laid out one after the other (counting sort by point).
  std::vector<std::int32_t> start(static_cast<std::size_t>(point_count) + 1, 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (is_degenerate(triangles[t]))
      note(report.degenerate_triangles, report.degenerate_witness, static_cast<std::int32_t>(t));
    else
      for (const std::int32_t p : triangles[t]) ++start[p + 1];
  }
  for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
  std::vector<Ray> rays(start.back());
  {
    std::vector<std::int32_t> fill(start.begin(), start.end() - 1);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const Triangle& c = triangles[t];
      if (is_degenerate(c)) continue;
      for (int k = 0; k < 3; ++k)
        rays[fill[c[k]]++] = {c[(k + 1) % 3], c[(k + 2) % 3], static_cast<std::int32_t>(t)};
    }
  }

  const auto block_count = static_cast<std::int32_t>((point_count + kGrain - 1) / kGrain);
  // What is found in each block of consecutive points. They are joined in order, so that the result does not depend
  // on threads.
  std::vector<SurfaceReport> blocks(block_count);
  tbb::parallel_for(tbb::blocked_range<std::int32_t>(0, block_count, 1), [&](const auto& range) {
    StarInspector inspector;
    for (std::int32_t b = range.begin(); b < range.end(); ++b) {
      const auto end =
          static_cast<std::int32_t>(std::min<std::int64_t>(point_count, std::int64_t{kGrain} * (b + 1)));
      for (std::int32_t p = kGrain * b; p < end; ++p)
        if (start[p] < start[p + 1])
          inspector.inspect(p, std::span(rays).subspan(start[p], start[p + 1] - start[p]), blocks[b]);
    }
  });
  for (const SurfaceReport& b : blocks) {
    report.edges += b.edges;
    append(report.crowded_edges, report.crowded_witness, b.crowded_edges, b.crowded_witness);
    append(report.clashing_edges, report.clashing_witness, b.clashing_edges, b.clashing_witness);
    append(report.bow_tie_points, report.bow_tie_witness, b.bow_tie_points, b.bow_tie_witness);
    append(report.duplicate_triangles, report.duplicate_witness, b.duplicate_triangles, b.duplicate_witness);
    report.open_edges.insert(report.open_edges.end(), b.open_edges.begin(), b.open_edges.end());
  }
  report.open_loops = count_loops(point_count, report.open_edges);
  return report;
}

}  // namespace limitcheck::verify
