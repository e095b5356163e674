// SPDX-License-Identifier: MIT
#include "fast/stream/quad_rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "data/error.h"

namespace limitcheck::fast::row_stream {

namespace {

using Point = Vec3<double>;

// Where a closed ring of edge and face neighbours, read from there on, is lexicographically smallest.
std::size_t canonical_quad_start(const std::vector<Point>& ring) {
  const std::size_t count = ring.size();
  const auto less = [](const Point& a, const Point& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  std::size_t best = 0;
  for (std::size_t k = 2; k < count; k += 2) {
    for (std::size_t t = 0; t < count; ++t) {
      const Point &a = ring[(k + t) % count], &b = ring[(best + t) % count];
      if (a == b) continue;
      if (less(a, b)) best = k;
      break;
    }
  }
  return best;
}

struct Limit {
  Point position, along, across;
};

Limit closed_limit(const Point& c, std::span<const Point> ring, const Point& de, const Point& df) {
  const std::size_t n = ring.size() / 2;
  const double count = static_cast<double>(n), theta = 2 * std::numbers::pi / count, cosine = std::cos(theta);
  const double face = 4 / (1 + cosine + std::cos(theta / 2) * std::sqrt(2 * (9 + cosine)));
  Limit limit{c + 1 / (count * (count + 5)) * (4. * de + df), {}, {}};
  for (std::size_t k = 0; k < n; ++k) {
    const double a = static_cast<double>(k) * theta, b = a + theta;
    const Point e = ring[2 * k] - c, f = ring[2 * k + 1] - c;
    limit.along = limit.along + 4 * std::cos(a) * e + face * (std::cos(a) + std::cos(b)) * f;
    limit.across = limit.across + 4 * std::sin(a) * e + face * (std::sin(a) + std::sin(b)) * f;
  }
  return limit;
}

Limit open_limit(const Point& c, std::span<const Point> ring, const Point& de, bool held) {
  const std::size_t faces = ring.size() / 2;
  const Point first = ring.front() - c, last = ring.back() - c;
  if (held) return {c, first, last};
  Limit limit{c + 1. / 6 * de, first - last, {}};
  if (faces == 1) {
    limit.across = de;
    return limit;
  }
  const double theta = std::numbers::pi / static_cast<double>(faces), cosine = std::cos(theta);
  const double lambda = (5 + cosine + std::cos(theta / 2) * std::sqrt(2 * (9 + cosine))) / 16;
  const double four = 4 * lambda - 1, cotangent = 1 / std::tan(theta / 2);
  const double end = (4 * lambda * std::sin(theta) - (8 * lambda - 1) * cotangent) / (four * four);
  limit.across = end * de;
  for (std::size_t k = 0; k < faces; ++k) {
    const double a = static_cast<double>(k) * theta;
    if (k > 0) limit.across = limit.across + 4 * std::sin(a) * (ring[2 * k] - c);
    limit.across = limit.across + (std::sin(a) + std::sin(a + theta)) / four * (ring[2 * k + 1] - c);
  }
  return limit;
}

}  // namespace

template <class T>
BasicQuadRings<T>::BasicQuadRings(const QuadMesh& mesh) {
  if (mesh.semi_sharp())
    throw data::ArgumentError("row streaming: semi-sharp edges and vertices are not supported");
  PlacedPoints<T> placed = place_points<T>(mesh.positions);
  points_ = std::move(placed.points);
  placement_ = placed.placement;
  const QuadAdjacency& adjacency = mesh.adjacency;
  lay_out(adjacency);
  Scratch scratch;
  for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
    if (adjacency.outgoing(v) >= 0) make_vertex(mesh, v, scratch);
  }
  find_kinds(adjacency);
}

template <class T>
void BasicQuadRings<T>::find_kinds(const QuadAdjacency& adjacency) {
  kinds_.resize(static_cast<std::size_t>(adjacency.face_count()));
  for (std::int32_t f = 0; f < adjacency.face_count(); ++f) {
    bool all = true, open = false;
    for (std::int32_t h = 4 * f; h < 4 * f + 4; ++h) {
      const bool regular_here = regular(adjacency.origin(h));
      corners_[h].sharp = adjacency.twin(h) < 0;
      corners_[h].polynomial = regular_here && regular(adjacency.target(h));
      all = all && regular_here;
      open = open || corners_[h].open;
    }
    kinds_[f] = all ? QuadClass::kRegular : open ? QuadClass::kOpen : QuadClass::kClosed;
  }
}

template <class T>
void BasicQuadRings<T>::lay_out(const QuadAdjacency& adjacency) {
  rings_.resize(static_cast<std::size_t>(adjacency.vertex_count()));
  heads_.resize(rings_.size());
  corners_.resize(4 * static_cast<std::size_t>(adjacency.face_count()));
  std::int32_t numbers = 0;
  for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
    const auto faces = static_cast<std::int32_t>(adjacency.fan(v).size());
    const bool open = adjacency.on_boundary(v);
    rings_[v] = {numbers, 2 * faces + (open ? 1 : 0), open};
    numbers += 3 * (open ? 2 * faces + 1 : 4 * faces);
  }
  numbers_.resize(static_cast<std::size_t>(numbers) + 4);  // the last one is read four numbers at a time
}

template <class T>
void BasicQuadRings<T>::make_vertex(const QuadMesh& mesh, std::int32_t v, Scratch& scratch) {
  const QuadAdjacency& adjacency = mesh.adjacency;
  const bool held = mesh.kind(v) == VertexKind::kHeld;
  const std::span<const std::int32_t> fan = adjacency.fan(v);
  const Ring at = rings_[v];
  const auto position = [&](std::int32_t w) {
    const auto& p = points_[w];
    return Point{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  };
  auto& ring = scratch.ring;
  ring.clear();
  for (const std::int32_t h : fan) {
    ring.push_back(position(adjacency.target(h)));
    ring.push_back(position(adjacency.target(QuadAdjacency::next(h))));
  }
  std::size_t start = 0;
  if (at.open) {
    ring.push_back(position(adjacency.origin(QuadAdjacency::prev(fan.back()))));
  } else {
    start = canonical_quad_start(ring);
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(start), ring.end());
  }
  const auto count = static_cast<std::int32_t>(fan.size());
  for (std::int32_t k = 0; k < count; ++k) {
    const std::int32_t slot = (k + count - static_cast<std::int32_t>(start / 2)) % count;
    const std::int32_t e = slot > 0 ? 2 * slot - 2 : at.open ? -1 : 2 * count - 2;
    corners_[fan[k]] = {v, e < 0 ? -1 : at.first + 3 * e, at.entries, at.open, false, false};
  }

  const Point c = position(v);
  Point de{}, df{};
  if (at.open) {
    de = (ring.front() - c) + (ring.back() - c);
  } else {
    for (std::size_t k = 0; k < ring.size(); k += 2) de = de + (ring[k] - c), df = df + (ring[k + 1] - c);
  }
  const Limit limit = at.open ? open_limit(c, ring, de, held) : closed_limit(c, ring, de, df);
  const Point normal = cross(limit.along, limit.across);
  const double length = std::sqrt(dot(normal, normal));

  auto& head = heads_[v];
  const auto put = [&](std::size_t first, const Point& p) {
    head[first] = static_cast<T>(p.x), head[first + 1] = static_cast<T>(p.y),
    head[first + 2] = static_cast<T>(p.z);
  };
  const double n = static_cast<double>(fan.size());
  const std::array<double, 5> weights =
      held      ? std::array<double, 5>{0, 0, 0, 0, 0}
      : at.open ? std::array<double, 5>{.5, 0, 1, 0, 0}
                : std::array<double, 5>{6 / (n * n), 1 / (n * n), 2 - 6 / n, .5 - 1 / n, 1 - 1 / n};
  for (std::size_t k = 0; k < 5; ++k) head[k] = static_cast<T>(weights[k]);
  put(QuadCornerBlock::kCentre, c);
  put(QuadCornerBlock::kEdges, de);
  put(QuadCornerBlock::kFaces, df);
  const Point origin{static_cast<double>(placement_.centre[0]), static_cast<double>(placement_.centre[1]),
                     static_cast<double>(placement_.centre[2])};
  put(QuadCornerBlock::kLimit, static_cast<double>(placement_.unit) * limit.position + origin);
  put(QuadCornerBlock::kLimit + 3, length > 0 ? 1 / length * normal : Point{0, 0, 1});
  for (std::size_t k = QuadCornerBlock::kLimit + 3; k < QuadCornerBlock::kHead; ++k) head[k] = head[k] + T(0);

  T* out = numbers_.data() + at.first;
  for (int copy = 0; copy < (at.open ? 1 : 2); ++copy) {
    for (const Point& p : ring) {
      *out++ = static_cast<T>(p.x), *out++ = static_cast<T>(p.y), *out++ = static_cast<T>(p.z);
    }
  }
}

template class BasicQuadRings<float>;
template class BasicQuadRings<double>;

}  // namespace limitcheck::fast::row_stream
