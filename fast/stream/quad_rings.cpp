// SPDX-License-Identifier: MIT
#include "fast/stream/quad_rings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "data/error.h"
#include "fast/rules/prepared_quads.h"

namespace limitcheck::fast::row_stream {

namespace {

using Point = Vec3<double>;

// Where a closed ring of edge and face neighbours, read from there on, is lexicographically smallest.
int canonical_quad_start(const QuadStar<double>& star) {
  const int count = star.size();
  int best = 0;
  for (int k = 2; k < count; k += 2) {
    for (int t = 0; t < count; ++t) {
      const Point &a = star.ring[(k + t) % count], &b = star.ring[(best + t) % count];
      if (a == b) continue;
      if (a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z) best = k;
      break;
    }
  }
  return best;
}

// k0 .. k4 of a QuadCornerBlock. A dart's centre does not come from sums.
std::array<double, 5> sum_weights(const QuadStar<double>& star) {
  if (star.kind != VertexKind::kPlain) return {0, 0, 0, 0, 0};
  if (star.open) return {.5, 0, 1, 0, 0};
  const double n = star.faces;
  return {6 / (n * n), 1 / (n * n), 2 - 6 / n, .5 - 1 / n, 1 - 1 / n};
}

}  // namespace

template <class T>
struct BasicQuadRings<T>::Scratch {
  std::vector<ControlPoint<T>> points;
  StarWeightTable weights;
  OwnQuadStar<double> own;
};

template <class T>
BasicQuadRings<T>::BasicQuadRings(const QuadMesh& mesh) {
  if (mesh.semi_sharp())
    throw data::ArgumentError("row streaming: semi-sharp edges and vertices are not supported");
  PlacedPoints<T> placed = place_points<T>(mesh.positions);
  placement_ = placed.placement;
  lay_out(mesh.adjacency);
  Scratch scratch{std::move(placed.points), {}, {}};
  for (std::int32_t v = 0; v < mesh.adjacency.vertex_count(); ++v)
    if (mesh.adjacency.outgoing(v) >= 0) make_vertex(mesh, v, scratch);
  find_kinds(mesh);
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
    rings_[v] = {numbers, 2 * faces + (open ? 1 : 0)};
    numbers += 3 * (open ? 2 * faces + 1 : 4 * faces);
  }
  numbers_.resize(static_cast<std::size_t>(numbers) + 4);  // the last one is read four numbers at a time
}

template <class T>
void BasicQuadRings<T>::make_vertex(const QuadMesh& mesh, std::int32_t v, Scratch& scratch) {
  const std::span<const std::int32_t> fan = mesh.adjacency.fan(v);
  const Ring at = rings_[v];
  OwnQuadStar<double>& own = scratch.own;
  own.gather(mesh, v, [&](std::int32_t w) {
    const auto& p = scratch.points[w];
    return Point{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  });
  QuadStar<double>& star = own.star;
  const int start = star.open ? 0 : canonical_quad_start(star);
  std::rotate(star.ring, star.ring + start, star.ring + star.size());
  for (int k = 0; k < star.faces; ++k) {
    const int slot = (k + star.faces - start / 2) % star.faces;
    const int e = slot > 0 ? 2 * slot - 2 : star.open ? -1 : 2 * star.faces - 2;
    corners_[fan[k]] = {v, e < 0 ? -1 : at.first + 3 * e, at.entries, star.open, false, false};
  }

  const Point c = star.centre;
  Point de{}, df{};
  if (star.open) {
    de = (star.edge(0) - c) + (star.edge(star.faces) - c);
  } else {
    for (int k = 0; k < star.faces; ++k) de = de + (star.edge(k) - c), df = df + (star.face(k) - c);
  }

  auto& head = heads_[v];
  const auto put = [](const Point& p, T* to) {
    to[0] = static_cast<T>(p.x), to[1] = static_cast<T>(p.y), to[2] = static_cast<T>(p.z);
  };
  const std::array<double, 5> weights = sum_weights(star);
  for (std::size_t k = 0; k < weights.size(); ++k) head[k] = static_cast<T>(weights[k]);
  put(c, head.data() + QuadCornerBlock::kCentre);
  put(de, head.data() + QuadCornerBlock::kEdges);
  put(df, head.data() + QuadCornerBlock::kFaces);
  T* out = numbers_.data() + at.first;
  for (int copy = 0; copy < (star.open ? 1 : 2); ++copy)
    for (int k = 0; k < star.size(); ++k, out += 3) put(star.ring[k], out);

  const LimitFrame<double> limit = star_limit(star, scratch.weights.of(star.faces, star.open, star.kind));
  const Point origin{static_cast<double>(placement_.centre[0]), static_cast<double>(placement_.centre[1]),
                     static_cast<double>(placement_.centre[2])};
  put(static_cast<double>(placement_.unit) * limit.position + origin, head.data() + QuadCornerBlock::kLimit);
  if (star.kind == VertexKind::kDart) make_dart(v, own);
  bool degenerate = false;
  put(star_normal(limit, own, degenerate),
      head.data() + QuadCornerBlock::kLimit + 3);  // may subdivide the star
  if (degenerate) ++degenerate_normals_;
  for (std::size_t k = QuadCornerBlock::kLimit + 3; k < QuadCornerBlock::kHead; ++k) head[k] = head[k] + T(0);
}

template <class T>
void BasicQuadRings<T>::make_dart(std::int32_t v, const OwnQuadStar<double>& own) {
  OwnQuadStar<double> star;
  star.resize(own.star.faces, own.star.open, own.star.kind);
  star.star.centre = own.star.centre;
  std::copy_n(own.star.ring, own.star.size(), star.star.ring);
  if (darts_.empty()) darts_.resize(rings_.size());
  darts_[v] = std::make_unique<DartCentres>();
  double scale = 1;
  for (int level = 0; level < kMaxDepth; ++level) {
    star.subdivide();
    scale *= 4;
    const Point c = scale * star.star.centre;
    (*darts_[v])[level] = {static_cast<T>(c.x), static_cast<T>(c.y), static_cast<T>(c.z)};
  }
}

template <class T>
void BasicQuadRings<T>::find_kinds(const QuadMesh& mesh) {
  const QuadAdjacency& adjacency = mesh.adjacency;
  kinds_.resize(static_cast<std::size_t>(adjacency.face_count()));
  const auto regular = [&](std::int32_t h) {
    return !corners_[h].open && corners_[h].entries == 8 &&
           mesh.kind(corners_[h].vertex) == VertexKind::kPlain;
  };
  for (std::int32_t f = 0; f < adjacency.face_count(); ++f) {
    bool all = true, open = false;
    for (std::int32_t h = 4 * f; h < 4 * f + 4; ++h) {
      corners_[h].sharp = adjacency.twin(h) < 0;
      corners_[h].polynomial = regular(h) && regular(QuadAdjacency::next(h));
      all = all && regular(h);
      open = open || corners_[h].open;
    }
    kinds_[f] = all ? QuadClass::kRegular : open ? QuadClass::kOpen : QuadClass::kClosed;
  }
}

template class BasicQuadRings<float>;
template class BasicQuadRings<double>;

}  // namespace limitcheck::fast::row_stream
