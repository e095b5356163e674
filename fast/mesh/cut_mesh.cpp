// SPDX-License-Identifier: MIT
#include "fast/mesh/cut_mesh.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "data/error.h"
#include "data/validate.h"

namespace limitcheck::fast {

namespace {

using Point = std::array<double, 3>;

Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Point operator*(double s, const Point& a) {
  return {s * a[0], s * a[1], s * a[2]};
}

// The edges of polygons in the order of their first corners.
struct Edges {
  struct Edge {
    std::int32_t a, b;       // the smaller vertex first
    std::int32_t corner[2];  // where it begins in its faces; -1
  };

  explicit Edges(const data::Faces& faces) : of_corner(faces.corners().size()) {
    struct Side {
      std::int32_t a, b, corner;
    };
    std::vector<Side> sides;
    sides.reserve(of_corner.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto face = faces[f];
      for (std::size_t k = 0; k < face.size(); ++k) {
        const auto [a, b] = std::minmax({face[k], face[k + 1 == face.size() ? 0 : k + 1]});
        sides.push_back({a, b, static_cast<std::int32_t>(faces.first_corner(f) + k)});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
      return std::array{s.a, s.b, s.corner} < std::array{t.a, t.b, t.corner};
    });
    for (const Side& s : sides) {
      if (all.empty() || all.back().a != s.a || all.back().b != s.b)
        all.push_back({s.a, s.b, {s.corner, -1}});
      else
        all.back().corner[1] = s.corner;
      of_corner[s.corner] = static_cast<std::int32_t>(all.size()) - 1;
    }
  }
  bool on_boundary(std::size_t e) const { return all[e].corner[1] < 0; }
  std::int32_t find(std::int32_t a, std::int32_t b) const {
    const auto ends = std::minmax(a, b);
    const auto at = std::lower_bound(all.begin(), all.end(), ends, [](const Edge& e, const auto& wanted) {
      return std::pair(e.a, e.b) < std::pair(wanted.first, wanted.second);
    });
    return static_cast<std::int32_t>(at - all.begin());
  }

  std::vector<Edge> all;
  std::vector<std::int32_t> of_corner;
};

// What the rule of a vertex asks for.
struct Star {
  int valence = 0;         // faces, and one more on the boundary
  Point edges{}, faces{};  // sums: the other ends, the middles of the faces
  int sharp = 0, sharp_after = 0;
  Point ends{}, ends_after{};  // sums: the other ends of sharp edges, and of those sharp after the step
  double semi = 0;             // sum of sharpness that is not for ever
  int semi_count = 0;
  double vanishing = 0;
  int vanishing_count = 0;
};

Point by_rule(VertexRule rule, const Point& c, const Star& star, const Point& ends) {
  const double n = star.valence;
  switch (rule) {
    case VertexRule::kHeld:
      return c;
    case VertexRule::kCrease:
      return .75 * c + .125 * ends;
    default:
      return ((n - 2) / n) * c + (1 / (n * n)) * (star.edges + star.faces);
  }
}

}  // namespace

double softened(double sharpness, double sum, int count, data::Creasing creasing) {
  if (!is_semi_sharp(sharpness)) return sharpness;
  if (creasing == data::Creasing::kChaikin && count > 1)
    sharpness = .75 * sharpness + .25 * ((sum - sharpness) / (count - 1));
  return std::max(0., sharpness - 1);
}

SharpPolygons SharpPolygons::of(const data::ControlMesh& mesh, data::Scheme scheme) {
  for (const auto& finding : data::validate(mesh, scheme))
    if (finding.fault != data::MeshFault::kIsolatedVertex)
      throw data::ArgumentError("control mesh: " + finding.message);
  const auto sharpness = [](float s) {
    return s >= data::kInfiniteSharpness ? kAlwaysSharp : static_cast<double>(s);
  };
  const Edges edges(mesh.faces);
  SharpPolygons out{mesh.positions, mesh.faces, {}, {}, mesh.sharpness.creasing, mesh.sharpness.triangles};
  out.side.assign(edges.of_corner.size(), 0);
  out.vertex.assign(mesh.positions.size(), 0);
  std::vector<std::uint8_t> faces_at(mesh.positions.size()), boundary(mesh.positions.size());
  const auto set = [&](std::size_t e, double s) {
    for (const std::int32_t corner : edges.all[e].corner)
      if (corner >= 0) out.side[corner] = s;
  };
  for (const auto& tag : mesh.sharpness.edges) set(edges.find(tag.a, tag.b), sharpness(tag.sharpness));
  for (const auto& tag : mesh.sharpness.vertices) out.vertex[tag.vertex] = sharpness(tag.sharpness);
  for (const std::int32_t v : mesh.faces.corners())
    faces_at[v] = static_cast<std::uint8_t>(std::min(2, faces_at[v] + 1));
  for (std::size_t e = 0; e < edges.all.size(); ++e) {
    if (!edges.on_boundary(e)) continue;
    set(e, kAlwaysSharp);
    boundary[edges.all[e].a] = boundary[edges.all[e].b] = 1;
  }
  if (mesh.sharpness.boundary == data::Boundary::kEdgeAndCorner)
    for (std::size_t v = 0; v < boundary.size(); ++v)
      if (boundary[v] != 0 && faces_at[v] == 1) out.vertex[v] = kAlwaysSharp;
  return out;
}

SharpPolygons SharpPolygons::step() const {
  const Edges edges(faces);
  const std::size_t vertices = positions.size(), first_face = vertices + edges.all.size();
  SharpPolygons out;
  out.creasing = creasing;
  out.triangles = data::TriangleRule::kCatmark;
  out.positions.resize(first_face + faces.size());
  out.vertex.assign(out.positions.size(), 0);
  const auto middle_of = [&](std::size_t f) -> Point& { return out.positions[first_face + f]; };
  std::vector<std::int32_t> face_of(side.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Point sum{};
    for (const std::int32_t v : faces[f]) sum = sum + positions[v];
    middle_of(f) = (1 / static_cast<double>(faces[f].size())) * sum;
    for (std::size_t k = 0; k < faces[f].size(); ++k)
      face_of[faces.first_corner(f) + k] = static_cast<std::int32_t>(f);
  }

  std::vector<Star> stars(vertices);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const std::int32_t v : faces[f]) stars[v].faces = stars[v].faces + middle_of(f);
  const auto sharpness = [&](const Edges::Edge& e) { return side[e.corner[0]]; };
  for (const Edges::Edge& e : edges.all) {
    for (const std::int32_t v : {e.a, e.b}) {
      if (!is_semi_sharp(sharpness(e))) continue;
      stars[v].semi += sharpness(e);
      ++stars[v].semi_count;
    }
  }

  // The sharpness of both halves of each edge, by its ends, and its point.
  std::vector<std::array<double, 2>> after(edges.all.size());
  for (std::size_t i = 0; i < edges.all.size(); ++i) {
    const Edges::Edge& e = edges.all[i];
    const double s = sharpness(e);
    const std::int32_t ends[2] = {e.a, e.b};
    for (std::size_t k = 0; k < 2; ++k) {
      Star& star = stars[ends[k]];
      const Point& other = positions[ends[1 - k]];
      after[i][k] = softened(s, star.semi, star.semi_count, creasing);
      ++star.valence;
      star.edges = star.edges + other;
      if (s > 0) star.ends = star.ends + other, ++star.sharp;
      if (after[i][k] > 0) star.ends_after = star.ends_after + other, ++star.sharp_after;
      if (s > 0 && after[i][k] <= 0) star.vanishing += s, ++star.vanishing_count;
    }
    const Point middle = .5 * (positions[e.a] + positions[e.b]);
    Point& point = out.positions[vertices + i] = middle;
    const double weight = after[i][0] > 0 && after[i][1] > 0 ? 1 : std::min(1., s);
    if (weight < 1) {
      const std::size_t f = face_of[e.corner[0]], g = face_of[e.corner[1]];
      const auto of_face = [&](std::size_t face) {
        return triangles == data::TriangleRule::kSmooth && faces[face].size() == 3 ? .47 : .25;
      };
      const double of_middle = (of_face(f) + of_face(g)) / 2;
      const Point smooth = (1 - 2 * of_middle) * middle + of_middle * (middle_of(f) + middle_of(g));
      point = weight * middle + (1 - weight) * smooth;
    }
  }

  for (std::size_t v = 0; v < vertices; ++v) {
    Star& star = stars[v];
    const double s = vertex[v], s_after = softened(s, 0, 0, data::Creasing::kUniform);
    if (s > 0 && s_after <= 0) star.vanishing += s, ++star.vanishing_count;
    const VertexRule now = rule_of(s, star.sharp), then = rule_of(s_after, star.sharp_after);
    out.vertex[v] = s_after;
    if (star.valence == 0) {
      out.positions[v] = positions[v];
      continue;
    }
    out.positions[v] = by_rule(now, positions[v], star, star.ends);
    if (now == VertexRule::kSmooth || now == then || star.vanishing_count == 0) continue;
    const double weight = std::min(1., star.vanishing / star.vanishing_count);
    out.positions[v] =
        weight * out.positions[v] + (1 - weight) * by_rule(then, positions[v], star, star.ends_after);
  }

  out.side.reserve(4 * side.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::size_t first = faces.first_corner(f), n = faces[f].size();
    for (std::size_t k = 0; k < n; ++k) {
      const std::int32_t v = faces[f][k];
      const std::int32_t to = edges.of_corner[first + k], from = edges.of_corner[first + (k + n - 1) % n];
      const auto near = [&](std::int32_t e) { return after[e][edges.all[e].a == v ? 0 : 1]; };
      const auto number = [](std::size_t i) { return static_cast<std::int32_t>(i); };
      out.faces.push_back({v, number(vertices) + to, number(first_face + f), number(vertices) + from});
      out.side.insert(out.side.end(), {near(to), 0, 0, near(from)});
    }
  }
  return out;
}

template <int K>
SharpCut cut_sharp(BasicAdjacency<K>& adjacency, const SharpPolygons& sharp) {
  SharpCut out;
  // How many infinitely sharp edges end at each vertex, and which of them have two faces.
  std::vector<std::int32_t> sharp_edges(sharp.vertex.size());
  std::vector<std::uint8_t> cuts(sharp.side.size());
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const auto h = static_cast<std::int32_t>(i);
    if (sharp.side[i] != kAlwaysSharp) continue;
    ++sharp_edges[adjacency.origin(h)];
    if (adjacency.twin(h) < 0) ++sharp_edges[adjacency.target(h)];
    cuts[i] = adjacency.twin(h) >= 0 ? 1 : 0;
  }
  out.uncut.resize(sharp.vertex.size());
  std::iota(out.uncut.begin(), out.uncut.end(), 0);
  if (std::find(cuts.begin(), cuts.end(), 1) != cuts.end()) {
    out.twin.assign(cuts.size(), -1);
    for (std::size_t h = 0; h < cuts.size(); ++h)
      if (cuts[h] != 0) out.twin[h] = adjacency.twin(static_cast<std::int32_t>(h));
    out.uncut = adjacency.cut(cuts);
  }
  out.kinds.resize(out.uncut.size());
  for (std::size_t v = 0; v < out.kinds.size(); ++v) {
    const std::int32_t b = out.uncut[v];
    if (sharp.vertex[b] == kAlwaysSharp || sharp_edges[b] > 2)
      out.kinds[v] = VertexKind::kHeld;
    else if (sharp_edges[b] == 1)
      out.kinds[v] = VertexKind::kDart;
  }
  return out;
}

template SharpCut cut_sharp(BasicAdjacency<3>&, const SharpPolygons&);
template SharpCut cut_sharp(BasicAdjacency<4>&, const SharpPolygons&);

namespace {

bool any_semi_sharp(const SharpPolygons& sharp) {
  return std::any_of(sharp.side.begin(), sharp.side.end(), is_semi_sharp) ||
         std::any_of(sharp.vertex.begin(), sharp.vertex.end(), is_semi_sharp);
}

bool all_quads(const data::Faces& faces) {
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (faces[f].size() != 4) return false;
  return true;
}

// The mesh with its tags where they are used, of quads; nothing if it is one of quads without tags.
std::optional<SharpPolygons> sharp_quads(const data::ControlMesh& mesh) {
  const bool quads = all_quads(mesh.faces);
  if (quads && mesh.sharpness.empty()) return std::nullopt;
  SharpPolygons polygons = SharpPolygons::of(mesh);
  return quads ? std::move(polygons) : polygons.step();
}

data::ControlMesh plain(const data::ControlMesh& mesh, const std::optional<SharpPolygons>& sharp) {
  return sharp ? data::ControlMesh{sharp->positions, sharp->faces} : mesh;
}

}  // namespace

TriangleMesh::TriangleMesh(const data::ControlMesh& mesh) : mesh_(&mesh), adjacency_(mesh) {
  if (mesh.sharpness.empty()) return;
  const SharpPolygons sharp = SharpPolygons::of(mesh, data::Scheme::kLoop);
  if (any_semi_sharp(sharp))
    throw data::ArgumentError("tessellator: no semi-sharp edges or vertices in Loop's scheme");
  SharpCut cut = cut_sharp(adjacency_, sharp);
  kinds_ = std::move(cut.kinds);
  cut_twin_ = std::move(cut.twin);
  if (cut_twin_.empty()) return;
  uncut_ = std::move(cut.uncut);
  with_copies_.emplace();
  with_copies_->faces = mesh.faces;
  points_moved();
}

void TriangleMesh::points_moved() {
  if (!with_copies_) return;
  with_copies_->positions.resize(uncut_.size());
  for (std::size_t v = 0; v < uncut_.size(); ++v) with_copies_->positions[v] = mesh_->positions[uncut_[v]];
}

QuadMesh::QuadMesh(const data::ControlMesh& mesh) : QuadMesh(mesh, sharp_quads(mesh)) {}

QuadMesh::QuadMesh(const data::ControlMesh& mesh, const std::optional<SharpPolygons>& sharp)
    : steps(all_quads(mesh.faces) ? 0 : 1),
      positions(sharp ? sharp->positions : mesh.positions),
      adjacency(plain(mesh, sharp)),
      creasing(mesh.sharpness.creasing) {
  if (!sharp) return;
  SharpCut cut = cut_sharp(adjacency, *sharp);
  for (std::size_t v = positions.size(); v < cut.uncut.size(); ++v)
    positions.push_back(std::array<double, 3>(positions[cut.uncut[v]]));

  if (any_semi_sharp(*sharp)) {
    side_sharpness.resize(sharp->side.size());
    for (const std::int32_t before : cut.uncut)
      vertex_sharpness.push_back(is_semi_sharp(sharp->vertex[before]) ? sharp->vertex[before] : 0);
  }
  for (std::size_t h = 0; h < side_sharpness.size(); ++h)
    if (is_semi_sharp(sharp->side[h])) side_sharpness[h] = sharp->side[h];
  cut_twin = std::move(cut.twin);
  if (!cut_twin.empty()) uncut = std::move(cut.uncut);
  kinds = std::move(cut.kinds);
}

}  // namespace limitcheck::fast
