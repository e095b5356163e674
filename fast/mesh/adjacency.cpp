// SPDX-License-Identifier: MIT
#include "fast/mesh/adjacency.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "data/error.h"
#include "data/validate.h"

namespace limitcheck::fast {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw data::ArgumentError("control mesh: " + what);
}

// What is wrong with a mesh, now that something is.
template <int K>
[[noreturn]] void diagnose(const data::ControlMesh& mesh) {
  for (const auto& finding : data::validate(mesh, K == 3 ? data::Scheme::kLoop : data::Scheme::kCatmullClark))
    if (finding.fault != data::MeshFault::kIsolatedVertex) refuse(finding.message);
  refuse("no manifold");
}

data::Triangles faces_of(const data::ControlMesh& mesh, std::integral_constant<int, 3>) {
  return triangles_of(mesh);
}

/// Faces that are all quads, each as four indices.
struct Quads {
  std::span<const std::int32_t> corners;
  std::size_t size() const { return corners.size() / 4; }
  std::array<std::int32_t, 4> operator[](std::size_t f) const {
    return {corners[4 * f], corners[4 * f + 1], corners[4 * f + 2], corners[4 * f + 3]};
  }
};

Quads faces_of(const data::ControlMesh& mesh, std::integral_constant<int, 4>) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.faces[f].size() != 4) refuse("face " + std::to_string(f) + " is no quad");
  return {mesh.faces.corners()};
}

template <std::size_t K>
bool repeats(const std::array<std::int32_t, K>& t) {
  bool any = t[0] == t[1];
  any |= t[1] == t[2];
  any |= t[2] == t[0];
  if constexpr (K == 4) any |= t[3] == t[0] || t[3] == t[1] || t[3] == t[2];
  return any;
}

}  // namespace

template <int K>
BasicAdjacency<K>::BasicAdjacency(const data::ControlMesh& mesh) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  if (mesh.faces.size() > kMost / K || mesh.positions.size() > kMost) refuse("too many faces or vertices");
  outgoing_.assign(mesh.positions.size(), -1);
  read_faces(mesh);
  sort_by_origin();
  link(mesh);
}

template <int K>
void BasicAdjacency<K>::read_faces(const data::ControlMesh& mesh) {
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = faces_of(mesh, std::integral_constant<int, K>{});
  origin_.resize(K * faces.size());
  bool bad = false;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& t = faces[f];
    for (std::size_t k = 0; k < K; ++k) {
      bad |= static_cast<std::uint32_t>(t[k]) >= vertices;
      origin_[K * f + k] = t[k];
    }
    bad |= repeats(t);
  }
  if (bad) diagnose<K>(mesh);
}

// Counting sort of the half-edges by origin; those of one vertex stay in order. As 4 face + corner, which
// spares link() most divisions by 3.
template <int K>
void BasicAdjacency<K>::sort_by_origin() {
  first_.assign(outgoing_.size() + 2, 0);
  std::int32_t* cursor = first_.data() + 2;
  for (const std::int32_t v : origin_) ++cursor[v];
  for (std::size_t v = 2; v < first_.size(); ++v) first_[v] += first_[v - 1];
  --cursor;  // the start of each vertex; its end, the next one's start, after all are placed
  fan_.resize(origin_.size());
  for (std::size_t f = 0; K * f < origin_.size(); ++f) {
    for (std::size_t k = 0; k < K; ++k)
      fan_[cursor[origin_[K * f + k]]++] = static_cast<std::int32_t>(static_cast<std::uint32_t>(4 * f + k));
  }
  first_.pop_back();
}

// Chains the corners of each vertex: the next one counter-clockwise is that whose half-edge goes where the
// last one's face comes from, and the two half-edges there are twins.
template <int K>
void BasicAdjacency<K>::link(const data::ControlMesh& mesh) {
  struct FaceCorner {  // of a face: the half-edge into the vertex, the one out of it, the next corner
    std::int32_t in, out, next;
  };
  constexpr std::int32_t kToNext[4] = {1, 1, K == 3 ? -2 : 1, -3};
  constexpr std::int32_t kToPrev[4] = {K - 1, -1, -1, -1};
  twin_.resize(origin_.size());
  std::int32_t most = 0;
  for (std::size_t v = 0; v < outgoing_.size(); ++v) most = std::max(most, first_[v + 1] - first_[v]);
  std::vector<FaceCorner> corner(static_cast<std::size_t>(most));
  // Per vertex: which one last had it for a target (upper half), and in which of its corners (lower half).
  std::vector<std::uint64_t> seen(outgoing_.size(), ~std::uint64_t{0});

  for (std::int32_t v = 0; v < vertex_count(); ++v) {
    const std::int32_t n = first_[v + 1] - first_[v];
    if (n == 0) continue;
    std::int32_t* fan = fan_.data() + first_[v];
    const std::uint64_t stamp = static_cast<std::uint64_t>(v) << 32;
    bool good = true;
    for (std::int32_t i = 0; i < n; ++i) {
      const auto packed = static_cast<std::uint32_t>(fan[i]), k = packed & 3;
      const auto h = static_cast<std::int32_t>(K == 3 ? packed - (packed >> 2) : packed);
      corner[i] = {h + kToPrev[k], h, -1};
      std::uint64_t& entry = seen[origin_[h + kToNext[k]]];
      good &= (entry ^ stamp) >> 32 != 0;
      entry = stamp | static_cast<std::uint64_t>(i);
    }
    std::int64_t unreached = std::int64_t{n} * (n - 1) / 2;  // in an open fan: the number of the first corner
    std::int32_t ends = 0;
    for (std::int32_t i = 0; i < n; ++i) {
      const std::uint64_t entry = seen[origin_[corner[i].in]];
      const bool found = (entry ^ stamp) >> 32 == 0;
      const std::int32_t j = found ? static_cast<std::int32_t>(entry) : -1;
      corner[i].next = j;
      twin_[corner[i].in] = found ? corner[j].out : -1;
      unreached -= found ? j : 0;
      ends += found ? 0 : 1;
    }
    if (!good || ends > 1 || (ends == 1 && (unreached < 0 || unreached >= n))) diagnose<K>(mesh);
    const std::int32_t start = ends == 0 ? 0 : static_cast<std::int32_t>(unreached);
    std::int32_t met = 0, i = start;
    do {
      fan[met++] = corner[i].out;
      i = corner[i].next;
    } while (i >= 0 && i != start && met < n);
    const bool closed = ends == 0 && i == start;
    if (met != n || !(closed ? n >= 3 : i < 0)) diagnose<K>(mesh);
    outgoing_[v] = fan[0];
    max_valence_ = std::max(max_valence_, n + ends);
  }
}

template <int K>
std::vector<std::int32_t> BasicAdjacency<K>::cut(std::span<const std::uint8_t> cuts) {
  for (std::size_t h = 0; h < twin_.size(); ++h)
    if (cuts[h] != 0) twin_[h] = -1;
  std::vector<std::int32_t> before(outgoing_.size()), starts;
  for (std::size_t v = 0; v < before.size(); ++v) before[v] = static_cast<std::int32_t>(v);
  // The fans of a vertex begin where there is no face to the right.
  std::vector<std::vector<std::int32_t>> added;
  for (std::int32_t v = 0; v < vertex_count(); ++v) {
    std::int32_t* const fan = fan_.data() + first_[v];
    const std::int32_t n = first_[v + 1] - first_[v];
    starts.clear();
    for (std::int32_t i = 0; i < n; ++i)
      if (twin(fan[i]) < 0) starts.push_back(i);
    if (starts.empty()) continue;
    std::rotate(fan, fan + starts[0], fan + n);
    outgoing_[v] = fan[0];
    for (std::size_t s = 1; s < starts.size(); ++s) {
      const std::int32_t from = starts[s] - starts[0];
      const std::int32_t to = s + 1 < starts.size() ? starts[s + 1] - starts[0] : n;
      added.emplace_back(fan + from, fan + to);
      before.push_back(v);
    }
  }
  if (!added.empty()) split(added);
  max_valence_ = 0;
  for (std::int32_t v = 0; v < vertex_count(); ++v) max_valence_ = std::max(max_valence_, valence(v));
  return before;
}

template <int K>
void BasicAdjacency<K>::split(const std::vector<std::vector<std::int32_t>>& added) {
  const std::size_t old_count = outgoing_.size();
  for (std::size_t i = 0; i < added.size(); ++i) {
    outgoing_.push_back(added[i].front());
    for (const std::int32_t h : added[i]) origin_[h] = static_cast<std::int32_t>(old_count + i);
  }
  std::vector<std::int32_t> fan, first{0};
  fan.reserve(fan_.size());
  for (std::size_t v = 0; v < old_count; ++v) {
    for (std::int32_t i = first_[v]; i < first_[v + 1]; ++i)
      if (origin_[fan_[i]] == static_cast<std::int32_t>(v)) fan.push_back(fan_[i]);
    first.push_back(static_cast<std::int32_t>(fan.size()));
  }
  for (const auto& half_edges : added) {
    fan.insert(fan.end(), half_edges.begin(), half_edges.end());
    first.push_back(static_cast<std::int32_t>(fan.size()));
  }
  fan_ = std::move(fan);
  first_ = std::move(first);
}

template class BasicAdjacency<3>;
template class BasicAdjacency<4>;

}  // namespace limitcheck::fast
