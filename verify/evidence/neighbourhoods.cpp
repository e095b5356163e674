// SPDX-License-Identifier: MIT
// The features of the neighbourhoods of a mesh.
#include <map>
#include <set>

#include "data/sharpness_classes.h"
#include "data/summary.h"
#include "verify/evidence/cells.h"
#include "verify/evidence/evidence.h"

namespace limitcheck::verify {
namespace {

struct Features : std::vector<std::uint16_t> {
  void add(std::size_t feature) { push_back(static_cast<std::uint16_t>(feature)); }
  void add(Axis axis, std::size_t k) { add(feature_on(axis, k)); }
};

// The first class that goes up to a number.
template <std::size_t N>
std::size_t class_up_to(const std::array<std::int64_t, N>& most, std::int64_t number) {
  return static_cast<std::size_t>(std::lower_bound(most.begin(), most.end(), number) - most.begin());
}

// What of the whole mesh goes with each of its vertices.
Features of_mesh(const AuditMesh& audited) {
  const data::ControlMesh& mesh = audited.mesh;
  const auto is_sharp = [](const auto& tag) { return tag.sharpness > 0; };
  const auto tags = std::count_if(mesh.sharpness.edges.begin(), mesh.sharpness.edges.end(), is_sharp) +
                    std::count_if(mesh.sharpness.vertices.begin(), mesh.sharpness.vertices.end(), is_sharp);
  const data::MeshSummary s = data::summarise(mesh);
  const std::int64_t genus = (2 * s.components - s.boundary_loops - s.euler) / 2;
  Features found;
  found.add(Axis::kTags, class_up_to(kTagCounts, tags));
  found.add(Axis::kComponents, s.components > 1 ? 1 : 0);
  found.add(Axis::kGenus, static_cast<std::size_t>(std::clamp<std::int64_t>(genus, 0, kMostGenus)));
  if (audited.relations && !audited.sample && size_for_relations(mesh) <= kRelationFaces)
    found.add(Axis::kAsked, 0);
  return found;
}

class Looker {
 public:
  explicit Looker(const AuditMesh& audited)
      : mesh_(audited.mesh),
        lattice_(mesh_, audited.scheme(), 0),
        depth_(asked_depths(audited, audited.depth)),
        vertices_(lattice_) {}

  bool is_displayed(const ControlVertex& at) const {
    return std::any_of(at.faces.begin(), at.faces.end(), [&](std::int32_t f) { return depth_[f] >= 0; });
  }

  void add_features(std::size_t v, Features& to) const {
    const ControlVertex& at = vertices_.all[v];
    const int own = at.own <= 0 ? 0 : at.own < data::kInfiniteSharpness ? 1 : 2;
    const std::size_t size_class = size_class_of(std::ssize(at.faces));
    to.add(Axis::kSide, at.boundary ? 1 : 0);
    to.add(Axis::kInfinite, static_cast<std::size_t>(std::min(at.infinite, kInfiniteEdges)));
    to.add(Axis::kSemi, static_cast<std::size_t>(std::min(at.semi, kSemiEdges)));
    to.add(Axis::kOwn, static_cast<std::size_t>(own));
    to.add(Axis::kFaces, size_class);
    to.add(VertexTags{at.boundary, at.infinite, at.semi, own}.feature());
    if (const auto fan = Fan{at.boundary, size_class}.feature()) to.add(*fan);
    if (at.own > 0) to.add(Axis::kOwnClass, data::sharpness_class(at.own));
    if (at.semi > 0 || own == 1) {
      const bool chaikin = mesh_.sharpness.creasing == data::Creasing::kChaikin;
      to.add(Axis::kCreasing, chaikin ? 1 : 0);
      if (chaikin && ending_edges(at, 0).size() > 1) to.add(Axis::kCreasing, kUnequal);
      if (chaikin && ending_edges(at, 2).size() > 1) to.add(Axis::kCreasing, kUnequal + 1);
    }
    // No other vertex is held by the option.
    if (at.boundary && at.faces.size() == 1)
      to.add(Axis::kBoundary, mesh_.sharpness.boundary == data::Boundary::kEdgeAndCorner ? 1 : 0);
    to.add(Axis::kIndex, class_up_to(kIndexes, static_cast<std::int64_t>(v)));
    for (const std::size_t k : at.edges) add_edge(k, at, to);
    add_faces(at, to);
  }

  const std::vector<ControlVertex>& vertices() const { return vertices_.all; }

 private:
  bool is_infinite(std::size_t edge) const { return vertices_.sharpness[edge] >= data::kInfiniteSharpness; }

  // The sharpnesses of edges that end, but are sharp for longer than that.
  std::set<float> ending_edges(const ControlVertex& at, float longer_than) const {
    std::set<float> some;
    for (const std::size_t k : at.edges)
      if (vertices_.sharpness[k] > longer_than && !is_infinite(k)) some.insert(vertices_.sharpness[k]);
    return some;
  }

  void add_edge(std::size_t k, const ControlVertex& at, Features& to) const {
    const Lattice::Edge& e = lattice_.edges()[k];
    if (e.on_boundary()) return;
    const float s = vertices_.sharpness[k];
    const ControlVertex& other = &vertices_.all[e.a] == &at ? vertices_.all[e.b] : vertices_.all[e.a];
    if (s > 0) to.add(Axis::kSharpness, data::sharpness_class(s));
    if (!other.boundary && other.faces.size() != (lattice_.scheme() == data::Scheme::kLoop ? 6U : 4U))
      to.add(Axis::kAround, 0);
    if (!(s > 0)) {
      if (at.sharp() && other.sharp()) to.add(Axis::kAround, 1);
      if (at.infinite >= 2 && other.infinite >= 2) to.add(Axis::kAround, kBetweenCreases);
      return;
    }
    if (s < 1 && !ending_edges(at, 2).empty() && !ending_edges(other, 2).empty())
      to.add(Axis::kAround, kWeakBetweenStrong);
    for (const std::size_t next : other.edges)
      if (next != k && vertices_.sharpness[next] > 0)
        to.add(Axis::kAround, vertices_.sharpness[next] == s ? 2 : 3);
  }

  void add_faces(const ControlVertex& at, Features& to) const {
    int least = kDepthClasses, most = -1;
    bool culled = false;
    for (const std::int32_t f : at.faces) {
      if (lattice_.scheme() == data::Scheme::kCatmullClark) {
        const auto corners = std::ssize(mesh_.faces[f]);
        to.add(Axis::kCorners, size_class_of(corners) - 2);
        if (corners == 3)
          to.add(Axis::kTriangles, mesh_.sharpness.triangles == data::TriangleRule::kSmooth ? 1 : 0);
      }
      culled = culled || depth_[f] < 0;
      if (depth_[f] < 0) continue;
      least = std::min(least, depth_[f]), most = std::max(most, depth_[f]);
      to.add(Axis::kDepth, static_cast<std::size_t>(std::min(depth_[f], kDepthClasses - 1)));
    }
    if (culled) to.add(Axis::kNeighbour, kMostDifference + 1);
    if (!culled || most > least)
      to.add(Axis::kNeighbour, static_cast<std::size_t>(std::min(most - least, kMostDifference)));
  }

  const data::ControlMesh& mesh_;
  Lattice lattice_;
  std::vector<std::int32_t> depth_;
  ControlVertices vertices_;
};

}  // namespace

ControlVertices::ControlVertices(const Lattice& lattice) : all(lattice.mesh().positions.size()) {
  const data::ControlMesh& mesh = lattice.mesh();
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const std::int32_t v : mesh.faces[f]) all[v].faces.push_back(static_cast<std::int32_t>(f));
  std::map<std::pair<std::int32_t, std::int32_t>, float> tagged;
  for (const data::SharpEdge& e : mesh.sharpness.edges) tagged[std::minmax(e.a, e.b)] = e.sharpness;
  for (const data::SharpVertex& s : mesh.sharpness.vertices) all[s.vertex].own = s.sharpness;
  for (std::size_t k = 0; k < lattice.edges().size(); ++k) {
    const Lattice::Edge& e = lattice.edges()[k];
    const auto tag = tagged.empty() ? tagged.end() : tagged.find({e.a, e.b});
    const float s = tag == tagged.end() || e.on_boundary() ? 0 : tag->second;
    sharpness.push_back(s);
    for (const std::int32_t v : {e.a, e.b}) {
      ControlVertex& at = all[v];
      at.edges.push_back(k);
      at.boundary = at.boundary || e.on_boundary();
      (s >= data::kInfiniteSharpness ? at.infinite : at.semi) += s > 0 ? 1 : 0;
    }
  }
}

std::vector<std::vector<std::uint16_t>> neighbourhoods(const AuditMesh& mesh) {
  const Features whole = of_mesh(mesh);
  const Looker looker(mesh);
  std::set<std::vector<std::uint16_t>> all;
  for (std::size_t v = 0; v < looker.vertices().size(); ++v) {
    if (!looker.is_displayed(looker.vertices()[v])) continue;
    Features found = whole;
    looker.add_features(v, found);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    all.insert(std::move(found));
  }
  return {all.begin(), all.end()};
}

}  // namespace limitcheck::verify
