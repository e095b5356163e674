// SPDX-License-Identifier: MIT
#include "data/generators/sharp_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "data/building_blocks.h"
#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

float as_sharpness(std::uint64_t s) {
  return static_cast<float>(std::min<std::uint64_t>(s, 10));
}

/// All edges.
std::vector<VertexPair> edges_of(const ControlMesh& mesh) {
  std::vector<VertexPair> edges = sides_of(mesh.faces);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// The neighbours of vertex 0 of a closed fan, counter-clockwise.
std::vector<std::int32_t> spokes(const ControlMesh& mesh) {
  std::vector<VertexPair> next;  // from one neighbour to the one before the far corner
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    const auto at = static_cast<std::size_t>(std::find(face.begin(), face.end(), 0) - face.begin());
    if (at == face.size()) continue;
    next.emplace_back(face[(at + 1) % face.size()], face[(at + face.size() - 1) % face.size()]);
  }
  std::vector<std::int32_t> order{next.front().first};
  while (order.size() < next.size())
    order.push_back(std::find_if(next.begin(), next.end(), [&](const auto& one) {
                      return one.first == order.back();
                    })->second);
  return order;
}

}  // namespace

ControlMesh creased_cube(std::uint64_t sharpness) {
  ControlMesh mesh = quad_cube();
  for (const auto& [a, b] : edges_of(mesh)) mesh.sharpness.edges.push_back({a, b, as_sharpness(sharpness)});
  return mesh;
}

ControlMesh dart(int n, bool triangles) {
  require(n >= 3, "a dart has 3 faces and more");
  ControlMesh mesh = triangles ? wheel(n, 3) : quad_wheel(n, 1);
  mesh.sharpness.edges.push_back({0, spokes(mesh).front(), kInfiniteSharpness});
  return mesh;
}

ControlMesh corner(int k, bool triangles) {
  require(k >= 2 && k <= 1 << 20, "a corner has 2 to 1048576 sharp edges");
  ControlMesh mesh = triangles ? wheel(2 * k, 3) : quad_wheel(2 * k, 1);
  const std::vector<std::int32_t> ends = spokes(mesh);
  for (std::size_t i = 0; i < ends.size(); i += 2)
    mesh.sharpness.edges.push_back({0, ends[i], kInfiniteSharpness});
  return mesh;
}

ControlMesh crease_ring(std::uint64_t sharpness, std::uint64_t tenths) {
  require(tenths < 10, "a sharpness has 9 tenths at most");
  const float s = std::min(as_sharpness(sharpness) + static_cast<float>(tenths) / 10, kInfiniteSharpness);
  ControlMesh mesh = quad_torus(12, 6);
  for_each_side(mesh.faces, [&](std::int32_t a, std::int32_t b) {  // edges between vertices 0, 6, 12, ..
    if (a % 6 == 0 && b % 6 == 0 && a < b) mesh.sharpness.edges.push_back({a, b, s});
  });
  return mesh;
}

ControlMesh with_random_sharpness(ControlMesh mesh, std::uint64_t seed) {
  SplitMix64 random(seed);
  const auto some = [&] {
    return random.next() % 2 == 0 ? kInfiniteSharpness : static_cast<float>(random.next() % 64 + 1) / 16;
  };
  for (const auto& [a, b] : edges_of(mesh))
    if (random.next() % 10 == 0) mesh.sharpness.edges.push_back({a, b, some()});
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (random.next() % 50 == 0) mesh.sharpness.vertices.push_back({static_cast<std::int32_t>(v), some()});
  if (random.next() % 2 == 0) mesh.sharpness.creasing = Creasing::kChaikin;
  if (random.next() % 2 == 0) mesh.sharpness.boundary = Boundary::kEdgeAndCorner;
  return mesh;
}

ControlMesh with_any_tags(ControlMesh mesh, std::uint64_t seed) {
  SplitMix64 random(seed);
  mesh.sharpness = {};
  const double share = .05 * std::exp2(4.3 * random.unit());  // of the edges; a third as many vertices
  const auto some = [&]() -> float {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    switch (random.next() % 8) {
      case 0:
        return kInfiniteSharpness;
      case 1:
      case 2: {
        const float at = std::array{1.F, 2.F, kInfiniteSharpness}[random.next() % 3];
        return std::array{at, std::nextafter(at, 0.F), std::nextafter(at, kInfinity)}[random.next() % 3];
      }
      case 3:
        return std::array{0.F, std::numeric_limits<float>::denorm_min(), 0x1p-20F,
                          kInfinity}[random.next() % 4];
      case 4:
        return static_cast<float>(10 * random.unit());
      default:
        return static_cast<float>(random.next() % 48) / 16;
    }
  };
  for (const auto& [a, b] : edges_of(mesh))
    if (random.unit() < share) mesh.sharpness.edges.push_back({a, b, some()});
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (3 * random.unit() < share) mesh.sharpness.vertices.push_back({static_cast<std::int32_t>(v), some()});
  const std::uint64_t options = random.next();
  if ((options & 3) != 0) mesh.sharpness.creasing = Creasing::kChaikin;
  if ((options & 4) != 0) mesh.sharpness.boundary = Boundary::kEdgeAndCorner;
  if ((options & 8) != 0 && !mesh.faces.are_triangles()) mesh.sharpness.triangles = TriangleRule::kSmooth;
  return mesh;
}

ControlMesh with_random_creases(ControlMesh mesh, std::uint64_t seed) {
  mesh = with_random_sharpness(std::move(mesh), seed);
  for (SharpEdge& e : mesh.sharpness.edges) e.sharpness = kInfiniteSharpness;
  for (SharpVertex& v : mesh.sharpness.vertices) v.sharpness = kInfiniteSharpness;
  mesh.sharpness.creasing = Creasing::kUniform;
  return mesh;
}

ControlMesh with_open_crease(ControlMesh mesh, int edges) {
  using Point = std::array<double, 3>;
  std::map<std::int32_t, std::set<std::int32_t>> neighbours;
  std::map<VertexPair, int> sides;
  for_each_side(mesh.faces, [&](std::int32_t a, std::int32_t b) {
    neighbours[a].insert(b), neighbours[b].insert(a);
    ++sides[std::minmax(a, b)];
  });
  std::set<std::int32_t> taken;
  for (const auto& [edge, count] : sides)
    if (count < 2) taken.insert({edge.first, edge.second});  // the boundary

  std::int32_t at = 0;
  const auto height = [&](std::int32_t v) {
    const Point& p = mesh.positions[static_cast<std::size_t>(v)];
    return p[0] + p[1] + p[2];
  };
  for (const auto& entry : neighbours)
    if (height(entry.first) > height(at)) at = entry.first;
  Point ahead{1, -1, 0};
  taken.insert(at);
  for (int k = 0; k < edges; ++k) {
    const Point& from = mesh.positions[static_cast<std::size_t>(at)];
    std::int32_t best = -1;
    double straightest = -2;
    for (const std::int32_t v : neighbours[at]) {
      const Point& to = mesh.positions[static_cast<std::size_t>(v)];
      double along = 0, length = 0, before = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        along += ahead[c] * (to[c] - from[c]);
        length += (to[c] - from[c]) * (to[c] - from[c]);
        before += ahead[c] * ahead[c];
      }
      const double cosine = along / std::sqrt(std::max(length * before, 1e-300));
      if (cosine > straightest && !taken.contains(v)) straightest = cosine, best = v;
    }
    require(best >= 0, "the crease has no way on");
    for (std::size_t c = 0; c < 3; ++c)
      ahead[c] = mesh.positions[static_cast<std::size_t>(best)][c] - from[c];
    mesh.sharpness.edges.push_back({at, best, kInfiniteSharpness});
    taken.insert(at = best);
  }
  return mesh;
}

}  // namespace limitcheck::data
