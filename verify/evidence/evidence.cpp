// SPDX-License-Identifier: MIT
#include "verify/evidence/evidence.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "data/bounding_box.h"
#include "verify/evidence/cells.h"
#include "verify/row/bounds.h"

namespace limitcheck::verify {

Result Evidence::result(std::string_view check, std::string_view unit, std::optional<double> bound) const {
  return {.subject = subject,
          .mesh = mesh_name,
          .check = std::string(check),
          .depth = lattice.depth(),
          .precision = capabilities.precision,
          .scheme = lattice.scheme(),
          .weights = reference.weights(),
          .status = Status::kHeld,
          .bound = bound,
          .unit = std::string(unit)};
}

Witness Evidence::at_vertex(std::int64_t vertex) const {
  Witness w = at(tessellation.place(vertex));
  w.vertex = vertex;
  return w;
}

Witness Evidence::at_use(const Use& use) const {
  if (use.side == Lattice::kNone || reference.sides().none()) return at_vertex(use.vertex);
  Witness w = at(reference.sides().place(use.side));
  w.vertex = use.vertex;
  return w;
}

double Evidence::position_bound() const {
  return verify::position_bound(capabilities.precision, reference.steps(), magnitude, diagonal);
}

double Evidence::position_bound_at(Lattice::Id id) const {
  return verify::position_bound(capabilities.precision, reference.steps(), magnitude, diagonal,
                                reference.terms_at(id));
}

double Evidence::normal_bound_at(Sides::Id side) const {
  return std::max(
      normal_bound(capabilities.precision, reference.steps()),
      conditioned_normal_bound(capabilities.precision, magnitude, reference.normal_condition(side)));
}

Witness Evidence::at(const Place& p) const {
  Witness w;
  w.face = p.face;
  if (p.face >= 0 && p.face < lattice.face_count() && lattice.domain(p.face).parts() > 1) w.corner = p.corner;
  w.l1 = fraction(p.i, p.denominator);
  w.l2 = fraction(p.j, p.denominator);
  return w;
}

bool Evidence::place(std::int64_t triangle, std::array<Lattice::Coordinates, 3>& corners) const {
  if (!tessellation.triangle_ok(triangle)) return false;
  const std::int32_t face = tessellation.triangle_face()[triangle];
  const auto& vertices = tessellation.triangles()[triangle];
  for (int k = 0; k < 3; ++k) {
    const Lattice::Id id = point[vertices[k]];
    if (id == Lattice::kNone) return false;
    const auto coordinates = lattice.in_face(id, face);
    if (!coordinates) return false;
    corners[k] = *coordinates;
  }
  lattice.domain(face).share_part(corners, lattice.scale());
  return true;
}

std::vector<std::int32_t> deepest_near(const Evidence& e) {
  std::vector<std::int32_t> depth(e.face_depth.begin(), e.face_depth.end());
  for (const Lattice::Edge& edge : e.lattice.edges()) {
    if (edge.on_boundary()) continue;
    for (int s = 0; s < 2; ++s)
      if (std::int32_t& its = depth[edge.face[s]]; its >= 0)
        its = std::max(its, e.face_depth[edge.face[1 - s]]);
  }
  return depth;
}

std::int64_t not_finite(const Tessellation& t) {
  std::int64_t count = 0;
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) count += !is_finite(t, v);
  return count;
}

std::vector<Place> points_anywhere(const lc_capabilities& capabilities, const Tessellation& t) {
  std::vector<Place> all;
  for (std::int64_t v = 0; capabilities.points_anywhere != 0 && v < t.vertex_count(); ++v)
    if (t.provenance_ok(v)) all.push_back(t.place(v));
  return all;
}

std::vector<Lattice::Id> locate(const Tessellation& tessellation, const Lattice& lattice) {
  std::vector<Lattice::Id> ids(tessellation.vertex_count());
  tbb::parallel_for(std::size_t{0}, ids.size(), [&](std::size_t v) {
    ids[v] = lattice.id(tessellation.place(static_cast<std::int64_t>(v)));
  });
  return ids;
}

namespace {

// The sides of all vertices: those of the triangles that they are corners of; of a vertex of no triangle, that of the
// face it names.
//   point   of each vertex
std::vector<Use> find_uses(const Tessellation& t, const std::vector<Lattice::Id>& point,
                           const Lattice& lattice, const Sides& sides) {
  std::vector<Use> uses;
  uses.reserve(point.size());
  if (!sides.none()) {
    for (std::int64_t k = 0; k < t.triangle_count(); ++k) {
      if (!t.triangle_ok(k)) continue;
      const std::int32_t face = t.triangle_face()[k];
      for (const std::int64_t v : t.triangles()[k])
        if (point[v] != Lattice::kNone && lattice.in_face(point[v], face))
          uses.push_back({v, sides.of(point[v], face)});
    }
    const auto order = [](const Use& use) { return std::pair(use.vertex, use.side); };
    std::sort(uses.begin(), uses.end(), [&](const Use& a, const Use& b) { return order(a) < order(b); });
    const auto same = [&](const Use& a, const Use& b) { return order(a) == order(b); };
    uses.erase(std::unique(uses.begin(), uses.end(), same), uses.end());
  }
  std::vector<bool> used(point.size(), false);
  for (const Use& use : uses) used[use.vertex] = true;
  for (std::size_t v = 0; v < point.size(); ++v)
    if (!used[v]) {
      const auto k = static_cast<std::int64_t>(v);
      uses.push_back({k, point[v] == Lattice::kNone ? Lattice::kNone : sides.of(point[v], t.place(k).face)});
    }
  if (!sides.none())
    std::stable_sort(uses.begin(), uses.end(),
                     [](const Use& a, const Use& b) { return a.vertex < b.vertex; });
  return uses;
}

// The kinds of all lattice points of a mesh.                                              O(faces) to make
class NeighbourhoodCounts {
 public:
  explicit NeighbourhoodCounts(const Lattice& lattice) : lattice_(lattice) {
    const data::ControlMesh& mesh = lattice.mesh();
    const bool loop = lattice.scheme() == data::Scheme::kLoop;
    const auto is_regular = [&](std::int32_t face) { return loop || mesh.faces[face].size() == 4; };
    const ControlVertices vertices(lattice);
    for (const float s : vertices.sharpness) sharp_edge_.push_back(s > 0);
    for (const ControlVertex& at : vertices.all) {
      const bool is_held = at.own > 0 || (mesh.sharpness.boundary == data::Boundary::kEdgeAndCorner &&
                                          at.boundary && at.faces.size() == 1);
      const int sharp_edges = at.infinite + at.semi;
      const int count = sharp_edges + (at.boundary && sharp_edges > 0 ? 2 : 0);
      PlaceCount& place = vertex_.emplace_back();
      place.kind = is_held || count > 2                                         ? PlaceKind::kCorner
                   : count == 2                                                 ? PlaceKind::kCrease
                   : count == 1                                                 ? PlaceKind::kDart
                   : at.boundary                                                ? PlaceKind::kBoundaryVertex
                   : !std::all_of(at.faces.begin(), at.faces.end(), is_regular) ? PlaceKind::kPolygonVertex
                   : at.faces.size() != (loop ? 6U : 4U) ? PlaceKind::kExtraordinaryVertex
                                                         : PlaceKind::kRegularVertex;
      if (place.kind == PlaceKind::kBoundaryVertex || place.kind == PlaceKind::kExtraordinaryVertex)
        place.faces = static_cast<std::int32_t>(at.faces.size());
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      PlaceKind kind =
          is_regular(static_cast<std::int32_t>(f)) ? PlaceKind::kRegularFace : PlaceKind::kIrregularFace;
      for (const std::int32_t v : mesh.faces[f]) {
        const PlaceKind at = vertex_[v].kind;
        kind = std::max(kind, at >= PlaceKind::kDart             ? PlaceKind::kSharpFace
                              : at == PlaceKind::kBoundaryVertex ? PlaceKind::kBoundaryFace
                              : at == PlaceKind::kRegularVertex  ? PlaceKind::kRegularFace
                                                                 : PlaceKind::kIrregularFace);
      }
      face_.push_back(kind);
    }
  }

  // Kind, and number of faces where PlaceCount has one; nothing counted. `id` is a lattice point.
  PlaceCount of(Lattice::Id id) const {
    if (lattice_.is_vertex(id)) return vertex_[id];
    if (!lattice_.is_shared(id)) return {face_[lattice_.place(id).face], -1, 0, 0};
    const std::size_t k = lattice_.edge_of(id);
    if (sharp_edge_[k]) return {PlaceKind::kSharpEdge, -1, 0, 0};
    const Lattice::Edge& edge = lattice_.edges()[k];
    PlaceKind kind = face_[edge.face[0]];
    if (!edge.on_boundary()) kind = std::max(kind, face_[edge.face[1]]);
    return {kind, -1, 0, 0};
  }

 private:
  const Lattice& lattice_;
  std::vector<PlaceCount> vertex_;
  std::vector<PlaceKind> face_;
  std::vector<bool> sharp_edge_;
};

}  // namespace

void count_places(Result& row, const Lattice& lattice, std::size_t count,
                  const std::function<Lattice::Id(std::size_t)>& id,
                  const std::function<int(std::size_t)>& state) {
  if (!is_bad(row)) return;
  const NeighbourhoodCounts places(lattice);
  std::map<std::pair<PlaceKind, std::int32_t>, PlaceCount> counts;
  for (std::size_t k = 0; k < count; ++k) {
    const int wrong = state(k);
    const Lattice::Id point = wrong < 0 ? Lattice::kNone : id(k);
    if (point == Lattice::kNone) continue;
    const PlaceCount at = places.of(point);
    PlaceCount& sum = counts.try_emplace({at.kind, at.faces}, at).first->second;
    sum.bad += wrong;
    ++sum.of;
  }
  row.places.clear();
  for (const auto& [key, sum] : counts) row.places.push_back(sum);
}

std::vector<std::int32_t> asked_depths(const AuditMesh& mesh, int depth) {
  std::vector<std::int32_t> asked = mesh.face_depth;
  if (asked.empty()) asked.assign(mesh.mesh.faces.size(), depth);
  for (const std::int32_t f : mesh.mesh.holes) asked[f] = -1;
  return mesh.sample ? mesh.sample->cull(std::move(asked)) : asked;
}

void warm_up(Session& session, const AuditMesh& mesh, int deepest, int threads) {
  const bool each = session.capabilities().per_face_depth != 0;
  for (auto& depths : earlier_depths(mesh.depths, mesh.mesh.faces.size(), deepest, each)) {
    for (const std::int32_t f : mesh.mesh.holes) depths[f] = -1;
    if (mesh.sample) depths = mesh.sample->cull(std::move(depths));
    (void)session.tessellate(depths, threads);
  }
}

Evidence gather(const AuditSubject& subject, const AuditMesh& mesh, const Session& session,
                const data::ControlMesh& judged, std::span<const std::int32_t> asked,
                const Tessellation& tessellation, const ReferenceSurface& truth) {
  const Lattice& lattice = truth.lattice();
  std::vector<Lattice::Id> points = locate(tessellation, lattice);
  std::vector<Use> uses = find_uses(tessellation, points, lattice, truth.sides());
  double magnitude = 0;
  for (const Vector& p : session.mesh().positions) magnitude = std::max(magnitude, largest(p));
  const double diagonal = unit_of_length(data::box_diagonal(session.mesh()), magnitude);
  return {subject.label(), mesh.name, session.capabilities(), judged,          asked,    tessellation,
          lattice,         truth,     std::move(points),      std::move(uses), diagonal, magnitude};
}

}  // namespace limitcheck::verify
