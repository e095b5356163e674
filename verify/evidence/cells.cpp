// SPDX-License-Identifier: MIT
#include "verify/evidence/cells.h"

#include <fmt/core.h>

#include <array>
#include <map>
#include <set>

#include "data/sharpness_classes.h"
#include "data/summary.h"
#include "verify/evidence/lattice.h"

namespace limitcheck::verify {
namespace {

// Classes of numbers of faces and of corners: where tables of programs end.
constexpr std::array<int, kSizeClasses> kLeast{1,  2,  3,  4,  5,  6,  7,  8,  9,   10,  11,
                                               12, 13, 16, 17, 33, 34, 64, 65, 100, 101, 256};
constexpr int kInfiniteEdges = 5, kSemiEdges = 3, kBoundaryEdges = 2, kDepths = 8;
constexpr std::array<std::int64_t, 4> kIndexes{255, 32767, 65535, INT32_MAX}, kTagCounts{0, 12, 100, 255};
constexpr std::size_t kFarIndex = 2;  // from this class on meshes are large
constexpr std::int64_t kMostGenus = 3;
constexpr std::size_t kBetweenCreases = 4, kWeakBetweenStrong = 5;  // on the axis kAround
constexpr std::size_t kUnequal = 2;                                 // on the axis kCreasing, and what follows
constexpr std::array kOwn{"no sharpness of its own", "a finite sharpness of its own", "held"};

std::size_t class_of(std::int64_t count) {
  return static_cast<std::size_t>(std::upper_bound(kLeast.begin(), kLeast.end(), count) - kLeast.begin() - 1);
}
std::string words(std::size_t size_class, const char* noun) {
  const int least = kLeast[size_class];
  if (size_class + 1 == kLeast.size()) return fmt::format("{} {}s and more", least, noun);
  const int most = kLeast[size_class + 1] - 1;
  return least == most ? fmt::format("{} {}{}", least, noun, least == 1 ? "" : "s")
                       : fmt::format("{} to {} {}s", least, most, noun);
}
std::string count_in_words(int count, int most, const char* what) {
  return fmt::format("{}{} {} edge{}", count, count == most ? " and more" : "", what, count == 1 ? "" : "s");
}

// The kinds of vertex, numbered through.
struct VertexKind {
  bool boundary;
  int infinite, semi, own;
  static constexpr std::size_t kInside = 3 * (kInfiniteEdges + 1) * (kSemiEdges + 1);
  std::size_t number() const {
    const int most_infinite = boundary ? kBoundaryEdges : kInfiniteEdges;
    const int most_semi = boundary ? kBoundaryEdges : kSemiEdges;
    return static_cast<std::size_t>(
               (std::min(infinite, most_infinite) * (most_semi + 1) + std::min(semi, most_semi)) * 3 + own) +
           (boundary ? kInside : 0);
  }
  static VertexKind of(std::size_t number) {
    const bool boundary = number >= kInside;
    const int k = static_cast<int>(boundary ? number - kInside : number);
    const int semi = boundary ? kBoundaryEdges + 1 : kSemiEdges + 1;
    return {boundary, k / 3 / semi, k / 3 % semi, k % 3};
  }
};

// The values of the axis kFan: those inside, from three faces on, then those on the boundary.
constexpr std::size_t kLeastInside = 2;
std::size_t number_of(const Fan& fan) {
  return fan.boundary ? kSizeClasses - kLeastInside + fan.size_class : fan.size_class - kLeastInside;
}
Fan fan_of(std::size_t number) {
  const bool boundary = number >= kSizeClasses - kLeastInside;
  return {boundary, boundary ? number + kLeastInside - kSizeClasses : number + kLeastInside};
}

// All features; where those of each axis begin.
struct Table {
  std::vector<Feature> list;
  std::array<std::size_t, kAxes> begin{};

  void axis(Axis a) { begin[static_cast<std::size_t>(a)] = list.size(), axis_ = a; }
  void add(std::string name, std::int32_t needs = 0) { list.push_back({axis_, std::move(name), needs}); }
  std::size_t at(Axis a, std::size_t k) const { return begin[static_cast<std::size_t>(a)] + k; }

  Table() {
    axis(Axis::kSide);
    add("inside"), add("on the boundary", kNeedsBoundary);
    axis(Axis::kInfinite);
    for (int k = 0; k <= kInfiniteEdges; ++k)
      add(count_in_words(k, kInfiniteEdges, "infinite"), k > 0 ? LC_SHARP_CREASES : 0);
    axis(Axis::kSemi);
    for (int k = 0; k <= kSemiEdges; ++k)
      add(count_in_words(k, kSemiEdges, "semi-sharp"), k > 0 ? LC_SHARP_SEMI : 0);
    axis(Axis::kOwn);
    const std::array own_needs{0, LC_SHARP_CORNERS | LC_SHARP_SEMI, int{LC_SHARP_CORNERS}};
    for (std::size_t k = 0; k < 3; ++k) add(kOwn[k], own_needs[k]);
    axis(Axis::kFaces);
    for (std::size_t k = 0; k < kLeast.size(); ++k) add(words(k, "face"));
    axis(Axis::kSharpness);
    for (std::size_t k = 0; k < data::kSharpnessClasses.size(); ++k)
      add(fmt::format("an edge of sharpness {}", data::kSharpnessClasses[k].name), sharpness_needs(k));
    axis(Axis::kAround);
    add("beside an irregular vertex");
    add("a smooth edge to another sharp vertex", LC_SHARP_CREASES);
    add("a sharp edge that goes on alike", LC_SHARP_CREASES);
    add("a sharp edge that goes on with another sharpness", LC_SHARP_CREASES | LC_SHARP_SEMI);
    add("a smooth edge between two creases", LC_SHARP_CREASES);
    add("an edge below 1 between semi-sharp ones above 2", LC_SHARP_SEMI);
    axis(Axis::kCreasing);
    add("uniform creasing", LC_SHARP_SEMI);
    for (const char* of : {"", " of unequal edges", " of unequal edges sharp for more than 2 steps"})
      add(fmt::format("Chaikin's creasing{}", of), LC_SHARP_SEMI | LC_SHARP_CHAIKIN);
    axis(Axis::kBoundary);
    add("one face by a boundary of edges", kNeedsBoundary),
        add("one face by a boundary of edges and corners", kNeedsBoundary | LC_SHARP_CORNERS);
    axis(Axis::kTriangles);
    add("a triangle by the ordinary rule"), add("a triangle by the smooth rule", LC_SHARP_SMOOTH_TRIANGLES);
    axis(Axis::kCorners);
    for (std::size_t k = 2; k < kLeast.size(); ++k) add("a face of " + words(k, "corner"));
    axis(Axis::kDepth);
    for (int k = 0; k < kDepths; ++k) add(fmt::format("depth {}{}", k, k + 1 == kDepths ? " and more" : ""));
    axis(Axis::kNeighbour);
    add("faces of one depth");
    for (const char* by : {"1", "2", "3 and more"})
      add(fmt::format("depths that differ by {}", by), kNeedsDepths);
    add("some faces culled", kNeedsDepths);
    axis(Axis::kOwnClass);
    for (std::size_t k = 0; k < data::kSharpnessClasses.size(); ++k)
      add(fmt::format("of sharpness {}", data::kSharpnessClasses[k].name),
          LC_SHARP_CORNERS | sharpness_needs(k));
    axis(Axis::kVertex);
    for (const bool boundary : {false, true})
      for (int i = 0; i <= (boundary ? kBoundaryEdges : kInfiniteEdges); ++i)
        for (int s = 0; s <= (boundary ? kBoundaryEdges : kSemiEdges); ++s)
          for (std::size_t own = 0; own < 3; ++own)
            add(fmt::format("{} with {}, {}, {}", boundary ? "on the boundary" : "inside",
                            count_in_words(i, boundary ? kBoundaryEdges : kInfiniteEdges, "infinite"),
                            count_in_words(s, boundary ? kBoundaryEdges : kSemiEdges, "semi-sharp"),
                            kOwn[own]),
                (boundary ? kNeedsBoundary : 0) | (i > 0 ? LC_SHARP_CREASES : 0) |
                    (s > 0 ? LC_SHARP_SEMI : 0) | own_needs[own]);
    axis(Axis::kFan);
    for (std::size_t k = kLeastInside; k < kLeast.size(); ++k) add(words(k, "face") + " inside");
    for (std::size_t k = 0; k < kLeast.size(); ++k)
      add(words(k, "face") + " on the boundary", kNeedsBoundary);
    axis(Axis::kIndex);
    for (const std::int64_t most : kIndexes)  // large ones are looked at in a part of a mesh
      add(fmt::format("an index up to {}", most), most >= kIndexes[kFarIndex] ? kNeedsDepths : 0);
    axis(Axis::kTags);
    add("a mesh without tags");
    for (const char* many : {"1 to 12", "13 to 100", "101 to 255", "more than 255"})
      add(fmt::format("a mesh of {} tags", many), LC_SHARP_CREASES);
    axis(Axis::kComponents);
    add("a mesh of one component"), add("a mesh of several components");
    axis(Axis::kGenus);
    for (const char* genus : {"0", "1", "2", "3 and more"}) add(fmt::format("a mesh of genus {}", genus));
    axis(Axis::kAsked);
    add("asked for the relations, too", kNeedsRelations);
  }

 private:
  static std::int32_t sharpness_needs(std::size_t k) {
    return k < data::kFirstInfiniteClass ? LC_SHARP_SEMI : LC_SHARP_CREASES;
  }
  Axis axis_{};
};

const Table& table() {
  static const Table all;
  return all;
}

// The tags and faces at a vertex.
struct Vertex {
  bool boundary = false;
  int faces = 0, infinite = 0, semi = 0;
  float own = 0;
  std::vector<std::size_t> edges;
  bool sharp() const { return own > 0 || infinite + semi > 0; }
};

// What of the whole mesh goes with each of its vertices.
std::vector<std::uint16_t> of_mesh(const AuditMesh& audited) {
  const data::ControlMesh& mesh = audited.mesh;
  const Table& t = table();
  std::int64_t tags = 0;
  for (const auto& e : mesh.sharpness.edges) tags += e.sharpness > 0 ? 1 : 0;
  for (const auto& v : mesh.sharpness.vertices) tags += v.sharpness > 0 ? 1 : 0;
  const data::MeshSummary s = data::summarise(mesh);
  const auto genus =
      std::clamp<std::int64_t>((2 * s.components - s.boundary_loops - s.euler) / 2, 0, kMostGenus);
  const auto many = std::lower_bound(kTagCounts.begin(), kTagCounts.end(), tags) - kTagCounts.begin();
  std::vector<std::uint16_t> list;
  for (const std::size_t f :
       {t.at(Axis::kTags, static_cast<std::size_t>(many)), t.at(Axis::kComponents, s.components > 1 ? 1 : 0),
        t.at(Axis::kGenus, static_cast<std::size_t>(genus))})
    list.push_back(static_cast<std::uint16_t>(f));
  if (audited.relations && !audited.sample && size_for_relations(mesh) <= kRelationFaces)
    list.push_back(static_cast<std::uint16_t>(t.at(Axis::kAsked, 0)));
  return list;
}

// What two features, of different axes, have to do with each other.
bool go_together(const Feature& a, std::size_t i, const Feature& b, std::size_t j) {
  // How many faces of so many corners, and at which depth, an audit without meshes takes on.
  const auto deepest = [](std::size_t size_class) {
    const int least = kLeast[size_class];
    return least <= 4 ? 4U : least <= 8 ? 3U : least <= 16 ? 2U : 1U;
  };
  const auto is = [&](Axis x, Axis y) { return a.axis == x && b.axis == y; };
  const int faces = a.axis == Axis::kFaces ? kLeast[i] : 0;
  if (b.axis == Axis::kVertex)
    return a.axis == Axis::kCreasing && VertexKind::of(j).semi >= (i < kUnequal ? 1 : 2);
  // The depth is that of masks and of steps, which inside and on the boundary are of different code.
  if (b.axis == Axis::kFan) return a.axis == Axis::kDepth && i <= deepest(fan_of(j).size_class);
  // What a tessellator may keep by, and what its numbers of vertices may be too small for: large meshes take long.
  if (b.axis == Axis::kAsked || (b.axis == Axis::kIndex && j >= kFarIndex)) {
    if (a.axis == Axis::kFaces) return faces <= 8;
    if (a.axis == Axis::kCorners) return kLeast[i + 2] <= 8;
    if (b.axis == Axis::kIndex && a.axis == Axis::kSharpness) return true;
    return a.axis < Axis::kDepth && a.axis != Axis::kSharpness && a.axis != Axis::kAround;
  }
  // Of the whole mesh, or of what lies farther away.
  if (b.axis > Axis::kVertex || a.axis >= Axis::kOwnClass) return false;
  if (a.axis == Axis::kAround ? i == 0 : b.axis == Axis::kAround && j == 0) return false;
  if (b.axis == Axis::kOwnClass)
    return is(Axis::kBoundary, b.axis) || (is(Axis::kCreasing, b.axis) && j < data::kFirstInfiniteClass);
  // A boundary vertex of one face has no edges inside.
  if (b.axis == Axis::kBoundary) {
    if (a.axis == Axis::kInfinite || a.axis == Axis::kSemi) return i == 0;
    if (a.axis == Axis::kSharpness || a.axis == Axis::kAround) return false;
    if (a.axis == Axis::kCreasing) return i < kUnequal;
    if (a.axis == Axis::kFaces) return kLeast[i] == 1;
  }
  if (is(Axis::kBoundary, Axis::kNeighbour)) return j == 0;
  if (is(Axis::kSide, Axis::kFaces)) return false;  // kFan
  if (is(Axis::kSide, Axis::kBoundary)) return i == 1;
  // More edges than there are.
  if (is(Axis::kInfinite, Axis::kFaces) || is(Axis::kSemi, Axis::kFaces))
    return kLeast[j] >= static_cast<int>(i) + (kLeast[j] <= 2 ? 1 : 0);
  if (is(Axis::kInfinite, Axis::kSharpness)) return i > 0 || j < data::kFirstInfiniteClass;
  if (is(Axis::kInfinite, Axis::kAround)) return i >= 2 || j != kBetweenCreases;
  if (is(Axis::kSemi, Axis::kAround)) return i >= 2 || j != kWeakBetweenStrong;
  if (is(Axis::kSemi, Axis::kSharpness)) return i > 0 || j >= data::kFirstInfiniteClass;
  if (is(Axis::kSemi, Axis::kCreasing)) return i >= (j < kUnequal ? 1U : 2U);
  if (a.axis == Axis::kFaces) {
    // Many edges that stay sharp for many steps take a tessellator many seconds.
    if (b.axis == Axis::kSharpness) return faces > 1 && (faces <= 16 || !data::is_long_lasting(j));
    if (b.axis == Axis::kAround) return faces > (j >= kBetweenCreases ? 2 : 1) && faces <= 16;
    if (b.axis == Axis::kCreasing) return faces > (j < kUnequal ? 1 : 2);
    if (b.axis == Axis::kCorners) return faces <= 12 || j <= 6;
    if (b.axis == Axis::kDepth) return false;  // kFan
    if (b.axis == Axis::kNeighbour) return faces > (j == 0 ? 0 : 1) && faces <= 16;
    return true;
  }
  if (is(Axis::kCorners, Axis::kDepth)) return j <= deepest(i + 2);
  if (is(Axis::kCorners, Axis::kNeighbour)) return kLeast[i + 2] <= 16;
  if (is(Axis::kDepth, Axis::kNeighbour)) return i <= 4;
  if (b.axis == Axis::kDepth) return j <= 3;
  return true;
}

struct Universe {
  std::vector<Cell> list;
  std::vector<std::int32_t> number;  // of the pair (a, b), -1 where it is no cell

  explicit Universe(data::Scheme scheme) {
    const std::vector<Feature>& all = features();
    number.assign(all.size() * all.size(), -1);
    const auto of_scheme = [&](std::size_t f) {
      const Axis a = all[f].axis;
      return scheme == data::Scheme::kCatmullClark || (a != Axis::kCorners && a != Axis::kTriangles);
    };
    const auto within = [&](std::size_t f) { return f - table().at(all[f].axis, 0); };
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = a; b < all.size(); ++b)
        if (of_scheme(a) && of_scheme(b) &&
            (a == b || (all[a].axis != all[b].axis && go_together(all[a], within(a), all[b], within(b))))) {
          number[a * all.size() + b] = static_cast<std::int32_t>(list.size());
          list.push_back({a, b});
        }
  }
};

const Universe& universe(data::Scheme scheme) {
  static const Universe loop(data::Scheme::kLoop), quads(data::Scheme::kCatmullClark);
  return scheme == data::Scheme::kLoop ? loop : quads;
}

// The features of the vertices of one mesh.
class Looker {
 public:
  explicit Looker(const AuditMesh& audited)
      : audited_(audited),
        mesh_(audited.mesh),
        lattice_(mesh_, audited.scheme(), 0),
        depth_(audited.face_depth) {
    if (depth_.empty()) depth_.assign(mesh_.faces.size(), audited.depth);
    for (const std::int32_t f : mesh_.holes) depth_[static_cast<std::size_t>(f)] = -1;
    if (audited.sample) depth_ = audited.sample->cull(std::move(depth_));
    find_vertices();
  }

  std::vector<std::vector<std::uint16_t>> all() const {
    const std::vector<std::uint16_t> whole = of_mesh(audited_);
    std::set<std::vector<std::uint16_t>> list;
    for (std::size_t v = 0; v < vertex_.size(); ++v) {
      if (std::none_of(faces_[v].begin(), faces_[v].end(), [&](std::int32_t f) { return depth_[f] >= 0; }))
        continue;
      std::vector<std::uint16_t> found = whole;
      add_features(v, found);
      std::sort(found.begin(), found.end());
      found.erase(std::unique(found.begin(), found.end()), found.end());
      list.insert(std::move(found));
    }
    return {list.begin(), list.end()};
  }

 private:
  void find_vertices() {
    vertex_.resize(mesh_.positions.size());
    faces_.resize(mesh_.positions.size());
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
      for (const std::int32_t v : mesh_.faces[f]) faces_[v].push_back(static_cast<std::int32_t>(f));
    std::map<std::pair<std::int32_t, std::int32_t>, float> tagged;
    for (const data::SharpEdge& e : mesh_.sharpness.edges) tagged[std::minmax(e.a, e.b)] = e.sharpness;
    for (const data::SharpVertex& s : mesh_.sharpness.vertices) vertex_[s.vertex].own = s.sharpness;
    for (std::size_t k = 0; k < lattice_.edges().size(); ++k) {
      const Lattice::Edge& e = lattice_.edges()[k];
      const auto tag = tagged.empty() ? tagged.end() : tagged.find({e.a, e.b});
      sharpness_.push_back(tag == tagged.end() || e.on_boundary() ? 0 : tag->second);
      for (const std::int32_t v : {e.a, e.b}) {
        Vertex& at = vertex_[v];
        at.edges.push_back(k);
        at.boundary = at.boundary || e.on_boundary();
        (sharpness_[k] >= data::kInfiniteSharpness ? at.infinite : at.semi) += sharpness_[k] > 0 ? 1 : 0;
      }
    }
    for (std::size_t v = 0; v < vertex_.size(); ++v) vertex_[v].faces = static_cast<int>(faces_[v].size());
  }

  void add_features(std::size_t v, std::vector<std::uint16_t>& to) const {
    const Table& t = table();
    const auto add = [&](Axis a, std::size_t k) { to.push_back(static_cast<std::uint16_t>(t.at(a, k))); };
    const Vertex& at = vertex_[v];
    const int own = at.own <= 0 ? 0 : at.own < data::kInfiniteSharpness ? 1 : 2;
    add(Axis::kSide, at.boundary ? 1 : 0);
    add(Axis::kInfinite, static_cast<std::size_t>(std::min(at.infinite, kInfiniteEdges)));
    add(Axis::kSemi, static_cast<std::size_t>(std::min(at.semi, kSemiEdges)));
    add(Axis::kOwn, static_cast<std::size_t>(own));
    add(Axis::kFaces, class_of(at.faces));
    add(Axis::kVertex, VertexKind{at.boundary, at.infinite, at.semi, own}.number());
    const Fan fan{at.boundary, class_of(at.faces)};
    if (fan.boundary || fan.size_class >= kLeastInside) add(Axis::kFan, number_of(fan));
    if (at.own > 0) add(Axis::kOwnClass, data::sharpness_class(at.own));
    if (at.semi > 0 || own == 1) {
      const bool chaikin = mesh_.sharpness.creasing == data::Creasing::kChaikin;
      add(Axis::kCreasing, chaikin ? 1 : 0);
      if (chaikin && unequal_edges(at, 0)) add(Axis::kCreasing, kUnequal);
      if (chaikin && unequal_edges(at, 2)) add(Axis::kCreasing, kUnequal + 1);
    }
    // No other vertex is held by the option.
    if (at.boundary && at.faces == 1)
      add(Axis::kBoundary, mesh_.sharpness.boundary == data::Boundary::kEdgeAndCorner ? 1 : 0);
    const auto index = std::lower_bound(kIndexes.begin(), kIndexes.end(), static_cast<std::int64_t>(v));
    add(Axis::kIndex, static_cast<std::size_t>(index - kIndexes.begin()));
    for (const std::size_t k : at.edges) add_edge(k, v, add);

    int least = kDepths, most = -1;
    bool culled = false;
    for (const std::int32_t f : faces_[v]) {
      if (lattice_.scheme() == data::Scheme::kCatmullClark) {
        const auto corners = static_cast<std::int64_t>(mesh_.faces[f].size());
        add(Axis::kCorners, class_of(corners) - 2);
        if (corners == 3)
          add(Axis::kTriangles, mesh_.sharpness.triangles == data::TriangleRule::kSmooth ? 1 : 0);
      }
      culled = culled || depth_[f] < 0;
      if (depth_[f] < 0) continue;
      least = std::min(least, depth_[f]), most = std::max(most, depth_[f]);
      add(Axis::kDepth, static_cast<std::size_t>(std::min(depth_[f], kDepths - 1)));
    }
    if (culled) add(Axis::kNeighbour, 4);
    if (!culled || most > least) add(Axis::kNeighbour, static_cast<std::size_t>(std::min(most - least, 3)));
  }

  // Whether two edges that end are sharp for longer than that, and not equally.
  bool unequal_edges(const Vertex& at, float longer_than) const {
    std::set<float> some;
    for (const std::size_t k : at.edges)
      if (sharpness_[k] > longer_than && sharpness_[k] < data::kInfiniteSharpness) some.insert(sharpness_[k]);
    return some.size() > 1;
  }

  bool has_strong(const Vertex& at) const {
    return std::any_of(at.edges.begin(), at.edges.end(), [&](std::size_t k) {
      return sharpness_[k] > 2 && sharpness_[k] < data::kInfiniteSharpness;
    });
  }

  template <class Add>
  void add_edge(std::size_t k, std::size_t v, const Add& add) const {
    const Lattice::Edge& e = lattice_.edges()[k];
    if (e.on_boundary()) return;
    const float s = sharpness_[k];
    const Vertex &at = vertex_[v], &other = vertex_[static_cast<std::size_t>(e.a) == v ? e.b : e.a];
    if (s > 0) add(Axis::kSharpness, data::sharpness_class(s));
    if (!other.boundary && other.faces != (lattice_.scheme() == data::Scheme::kLoop ? 6 : 4))
      add(Axis::kAround, 0);
    if (!(s > 0)) {
      if (at.sharp() && other.sharp()) add(Axis::kAround, 1);
      if (at.infinite >= 2 && other.infinite >= 2) add(Axis::kAround, kBetweenCreases);
      return;
    }
    if (s < 1 && has_strong(at) && has_strong(other)) add(Axis::kAround, kWeakBetweenStrong);
    for (const std::size_t next : other.edges)
      if (next != k && sharpness_[next] > 0) add(Axis::kAround, sharpness_[next] == s ? 2 : 3);
  }

  const AuditMesh& audited_;
  const data::ControlMesh& mesh_;
  Lattice lattice_;
  std::vector<std::int32_t> depth_;
  std::vector<Vertex> vertex_;
  std::vector<std::vector<std::int32_t>> faces_;
  std::vector<float> sharpness_;  // of each edge
};

}  // namespace

const std::vector<Feature>& features() {
  return table().list;
}

std::string Cell::name() const {
  return first == second ? features()[first].name : features()[first].name + ", " + features()[second].name;
}

Fan fan(std::size_t feature) {
  return fan_of(feature - table().at(Axis::kFan, 0));
}

VertexTags vertex_tags(std::size_t feature) {
  const VertexKind kind = VertexKind::of(feature - table().at(Axis::kVertex, 0));
  return {kind.boundary, kind.infinite, kind.semi, kind.own};
}

std::pair<Axis, std::size_t> on_axis(std::size_t feature) {
  const Axis a = features()[feature].axis;
  return {a, feature - table().at(a, 0)};
}

int least_of(std::size_t size_class) {
  return kLeast[size_class];
}

std::int32_t Cell::needs() const {
  const std::int32_t both = features()[first].needs | features()[second].needs;
  const auto [a, i] = on_axis(first);
  const auto [b, j] = on_axis(second);
  if (b != Axis::kAround || j == 0 || j >= 3) return both;
  // Sharp without an infinite edge; or with none at all.
  if (a == Axis::kInfinite && i == 0) return both | LC_SHARP_SEMI;
  return a == Axis::kFaces && kLeast[i] == 2 && j == 1 ? both | LC_SHARP_CORNERS : both;
}

const std::vector<Cell>& cells(data::Scheme scheme) {
  return universe(scheme).list;
}

std::vector<std::vector<std::uint16_t>> neighbourhoods(const AuditMesh& mesh) {
  return Looker(mesh).all();
}

void add_cells(CellSet& to, const std::vector<std::uint16_t>& found, data::Scheme scheme) {
  const Universe& all = universe(scheme);
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t j = i; j < found.size(); ++j)
      if (const std::int32_t k = all.number[found[i] * features().size() + found[j]]; k >= 0)
        to[static_cast<std::size_t>(k)] = true;
}

void add_cells(CellSet& to, const CellSet& from) {
  for (std::size_t k = 0; k < to.size(); ++k) to[k] = to[k] || from[k];
}

CellSet cells_of(const AuditMesh& mesh) {
  CellSet set(cells(mesh.scheme()).size());
  for (const auto& found : neighbourhoods(mesh)) add_cells(set, found, mesh.scheme());
  return set;
}

std::string text_of(const CellSet& set) {
  std::string text((set.size() + 3) / 4, '0');
  for (std::size_t k = 0; k < set.size(); ++k) {
    char& c = text[k / 4];
    const int value = (c <= '9' ? c - '0' : c - 'a' + 10) | (set[k] ? 1 << k % 4 : 0);
    c = "0123456789abcdef"[value];
  }
  return text;
}

CellSet cell_set(const std::string& text, data::Scheme scheme) {
  CellSet set(cells(scheme).size());
  for (std::size_t k = 0; k < set.size() && k / 4 < text.size(); ++k) {
    const char c = text[k / 4];
    set[k] = ((c <= '9' ? c - '0' : c - 'a' + 10) >> k % 4 & 1) != 0;
  }
  return set;
}

}  // namespace limitcheck::verify
