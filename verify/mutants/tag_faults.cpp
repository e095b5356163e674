// SPDX-License-Identifier: MIT
// Faults of sharp edges and vertices: sharpness read in another way, and tags that are lost.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "verify/mutants/change_rows.h"

namespace limitcheck::verify {

using namespace rows;

namespace {

using VertexId = std::int32_t;
using data::SharpEdge;

constexpr float kInfinite = data::kInfiniteSharpness;

// The next sharpness below: it ends after ten steps.
float almost_infinite() {
  return std::nextafter(kInfinite, 0.F);
}

template <class Tag>
void keep_first(std::vector<Tag>& list, std::ptrdiff_t count) {
  if (std::ssize(list) > count) list.erase(list.begin() + count, list.end());
}

// Edges or vertices without a tag.
Change edges(const std::string& name, std::function<bool(A, const SharpEdge&)> lost) {
  return tags(
      name, [lost](A a, Tags t) { std::erase_if(t.edges, [&](const SharpEdge& e) { return lost(a, e); }); });
}
Change vertices(const std::string& name, std::function<bool(A, VertexId)> lost) {
  return tags(name, [lost](A a, Tags t) {
    std::erase_if(t.vertices, [&](const auto& v) { return lost(a, v.vertex); });
  });
}
// The edge of the mesh that a tag is of.
const reference::Edge* edge_of(A a, const SharpEdge& tag) {
  const auto& edges = a.topology.edges();
  const auto found = std::find_if(edges.begin(), edges.end(),
                                  [&](const reference::Edge& e) { return same_edge(e, tag.a, tag.b); });
  return found == edges.end() ? nullptr : &*found;
}

}  // namespace

void rows::lose_edges_beyond(Tags t, int most) {
  std::map<VertexId, int> count;
  std::erase_if(t.edges, [&](const SharpEdge& e) {
    const bool too_many = count[e.a] >= most || count[e.b] >= most;
    if (!too_many) ++count[e.a], ++count[e.b];
    return too_many;
  });
}

void faults_of_tags(Rows& to) {
  to += tags("boundary_tags_hold", [](A a, Tags t) {
    for (const SharpEdge& tag : t.edges)
      if (const reference::Edge* e = edge_of(a, tag); e != nullptr && e->on_boundary())
        for (const VertexId v : {e->a, e->b}) {
          std::erase_if(t.vertices, [v](const auto& held) { return held.vertex == v; });
          t.vertices.push_back({v, kInfinite});
        }
  });
  to += vertices("vertices_not_sharp", [](A, VertexId) { return true; });
  to += tags("vertices_never_fall", [](A, Tags t) {
    for (auto& v : t.vertices) v.sharpness = kInfinite;
  });
  to += tags("corners_not_held", [](A, Tags t) { t.boundary = data::Boundary::kEdge; });
  to += tags("corners_always_held", [](A, Tags t) { t.boundary = data::Boundary::kEdgeAndCorner; });
  to += values("semi_as_infinite", [](A, float) { return kInfinite; });
  to += values("infinite_is_4", [](A, float s) { return std::min(s, 4.F); });
  to += values("infinite_ends_after_10", [](A, float s) { return std::min(s, almost_infinite()); });
  to += values("ten_is_finite", [](A, float s) { return s == kInfinite ? almost_infinite() : s; });
  to += values("infinite_from_3", [](A, float s) { return s >= 3 ? kInfinite : s; });
  to += values("sharpness_rounded_down", [](A, float s) { return std::floor(s); });
  to += values("sharpness_rounded_up", [](A, float s) { return std::ceil(s); });
  to += tags("chaikin_as_uniform", [](A, Tags t) { t.creasing = data::Creasing::kUniform; });
  to += tags("uniform_as_chaikin", [](A, Tags t) { t.creasing = data::Creasing::kChaikin; });
  to += tags("first_tag_only", [](A, Tags t) { keep_first(t.edges, 1); });
  to += edges("tags_by_direction", [](A a, const SharpEdge& tag) {
    const reference::Edge* e = edge_of(a, tag);
    return e == nullptr || e->a != tag.a;
  });
  to += edges("tags_lost_at_corner_0", [](A a, const SharpEdge& tag) {
    const reference::Edge* e = edge_of(a, tag);
    if (e == nullptr) return true;
    const auto left = a.mesh.faces[static_cast<std::size_t>(e->left_face)];
    return left.front() == e->b && left.back() == e->a;
  });
  to += values("infinite_is_9", [](A, float s) { return std::min(s, 9.F); });
  to += values("sharpness_in_halves", [](A, float s) { return lasts(s) ? s : std::round(2 * s) / 2; });
  to += tags("triangles_not_smooth", [](A, Tags t) { t.triangles = data::TriangleRule::kCatmark; });
  // In what is delivered.
  to += vertex("sides_apart_by_an_ulp", [](const At& at) {
    const auto side = at.side();
    if (!side || side->along == 0 || at.p.face % 2 == 0) return;
    const auto c = at.a.mesh.faces[at.face()];
    const VertexId from = c[side->side], to = c[at.domain().next(side->side)];
    for (const SharpEdge& e : at.a.mesh.sharpness.edges)
      if (lasts(e.sharpness) && same_edge(e, from, to)) return at.out.move_up(at.v);
  });
}

void faults_of_rare_tags(Rows& to) {
  to += values("at_most_5", [](A, float s) { return lasts(s) ? s : std::min(s, 5.F); });
  to += values("tiny_dropped", [](A, float s) { return s < .0625F ? 0 : s; });
  to += values("rounded_to_integers", [](A, float s) { return lasts(s) ? s : std::round(s); });
  to += values("rounded_near_integers", [](A, float s) {
    const float whole = std::round(s);
    return s > 1 && s < 9 && s != whole && std::abs(s - whole) < .015625F ? whole - 1 : s;
  });
  to += values("just_below_1_is_none", [](A, float s) { return s < 1 && s > .984375F ? 0 : s; });
  to += values("just_above_1_is_2", [](A, float s) { return s > 1 && s < 1.015625F ? 2 : s; });
  to += values("just_below_10_is_3", [](A, float s) { return s > 9.9F && !lasts(s) ? 3 : s; });
  to += values("ends_after_3", [](A, float s) { return std::min(s, 3.F); });
  to += values("left_is_infinite",
               [](A a, float s) { return s > static_cast<float>(a.deepest) ? kInfinite : s; });
  to += values("left_is_dropped",
               [](A a, float s) { return lasts(s) ? s : std::min(s, static_cast<float>(a.deepest)); });
  to += values("tags_ignored_at_depth_0", [](A a, float s) { return a.deepest == 0 ? 0 : s; });
  // Tags that are lost by their number, the index of their vertices, or their neighbourhood.
  to += tags("edges_beyond_16", [](A, Tags t) { keep_first(t.edges, 16); });
  to += tags("vertices_beyond_4", [](A, Tags t) { keep_first(t.vertices, 4); });
  to += edges("edges_of_the_first_component", [](A a, const SharpEdge& e) { return a.component[e.a] > 0; });
  to += edges("edges_at_high_valence",
              [](A a, const SharpEdge& e) { return a.faces(e.a) > 16 || a.faces(e.b) > 16; });
  to += edges("semi_sharp_at_the_boundary", [](A a, const SharpEdge& e) {
    return !lasts(e.sharpness) && (!a.inside(e.a) || !a.inside(e.b));
  });
  to += edges("semi_sharp_at_infinite", [](A a, const SharpEdge& e) {
    return !lasts(e.sharpness) && (a.infinite[e.a] > 0 || a.infinite[e.b] > 0);
  });
  to += vertices("held_on_a_crease", [](A a, VertexId v) { return a.inside(v) && a.sharp_edges(v) == 2; });
  to += vertices("held_at_the_end", [](A a, VertexId v) { return a.inside(v) && a.sharp_edges(v) == 1; });
  to += vertices("held_on_the_boundary", [](A a, VertexId v) { return !a.inside(v); });
  to += tags("crease_between_creases", [](A a, Tags t) {
    std::set<std::pair<VertexId, VertexId>> tagged;
    for (const SharpEdge& e : t.edges) tagged.insert(std::minmax(e.a, e.b));
    for (const reference::Edge& e : a.topology.edges())
      if (!e.on_boundary() && a.on_inner_crease(e.a) && a.on_inner_crease(e.b) &&
          !tagged.contains(std::minmax(e.a, e.b)))
        t.edges.push_back({e.a, e.b, kInfinite});
  });
  to += tags("chaikin_of_two_alone", [](A a, Tags t) {
    if (std::any_of(a.semi_sharp.begin(), a.semi_sharp.end(), [](int n) { return n > 2; }))
      t.creasing = data::Creasing::kUniform;
  });
  for (const int most : {4, 6, 8})
    to += values(fmt::format("infinite_above_{}", most),
                 [most](A, float s) { return s > static_cast<float>(most) ? kInfinite : s; });
  for (const int most : {3, 4})
    to += tags(fmt::format("{}_edges_at_most", most), [most](A, Tags t) { lose_edges_beyond(t, most); });
  for (const int bits : {8, 15, 16})
    to += edges(fmt::format("tags_of_{}_bits", bits),
                [bits](A, const SharpEdge& e) { return std::max(e.a, e.b) >> bits > 0; });
}

}  // namespace limitcheck::verify
