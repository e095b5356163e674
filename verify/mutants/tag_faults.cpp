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
constexpr const char* kLaw = "fractional-sharpness";

// The next sharpness below: it ends after ten steps.
float almost_infinite() {
  return std::nextafter(kInfinite, 0.F);
}

template <class Tag>
void keep_first(std::vector<Tag>& list, std::ptrdiff_t count) {
  if (std::ssize(list) > count) list.erase(list.begin() + count, list.end());
}

// Edges or vertices without a tag.
Change edges(std::string name, std::string description, std::function<bool(A, const SharpEdge&)> lost,
             const char* check = "positions") {
  return tags(
      std::move(name), std::move(description),
      [lost](A a, Tags t) { std::erase_if(t.edges, [&](const SharpEdge& e) { return lost(a, e); }); }, check);
}
Change vertices(std::string name, std::string description, std::function<bool(A, VertexId)> lost) {
  return tags(std::move(name), std::move(description), [lost](A a, Tags t) {
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

std::vector<Change> faults_of_tags() {
  return {
      tags(
          "boundary_tags_hold", "the ends of a boundary edge that is tagged as sharp stay where they are",
          [](A a, Tags t) {
            for (const SharpEdge& tag : t.edges)
              if (const reference::Edge* e = edge_of(a, tag); e != nullptr && e->on_boundary())
                for (const VertexId v : {e->a, e->b}) {
                  std::erase_if(t.vertices, [v](const auto& held) { return held.vertex == v; });
                  t.vertices.push_back({v, kInfinite});
                }
          },
          "boundary-crease"),
      vertices("vertices_not_sharp", "the sharpness of vertices is ignored",
               [](A, VertexId) { return true; }),
      tags("vertices_never_fall", "sharp vertices stay sharp",
           [](A, Tags t) {
             for (auto& v : t.vertices) v.sharpness = kInfinite;
           }),
      tags("corners_not_held", "boundary vertices of one face are not held, although they should be",
           [](A, Tags t) { t.boundary = data::Boundary::kEdge; }),
      tags("corners_always_held", "boundary vertices of one face are held by default",
           [](A, Tags t) { t.boundary = data::Boundary::kEdgeAndCorner; }),
      values("semi_as_infinite", "declares semi-sharp edges and keeps them sharp for ever",
             [](A, float) { return kInfinite; }),
      values("infinite_is_4", "edges that stay sharp are sharp for 4 steps",
             [](A, float s) { return std::min(s, 4.F); }),
      values("infinite_ends_after_10", "edges that stay sharp are smooth after 10 steps",
             [](A, float s) { return std::min(s, almost_infinite()); }),
      values(
          "ten_is_finite", "a sharpness of 10 ends after 10 steps, only more than that is infinite",
          [](A, float s) { return s == kInfinite ? almost_infinite() : s; }, "infinite-sharpness"),
      values("infinite_from_3", "a sharpness of 3 is taken for infinite",
             [](A, float s) { return s >= 3 ? kInfinite : s; }),
      values("sharpness_rounded_down", "the fraction of a sharpness is dropped",
             [](A, float s) { return std::floor(s); }),
      values("sharpness_rounded_up", "a sharpness is rounded up to a whole number",
             [](A, float s) { return std::ceil(s); }),
      tags("chaikin_as_uniform", "Chaikin's way of falling is not done",
           [](A, Tags t) { t.creasing = data::Creasing::kUniform; }),
      tags("uniform_as_chaikin", "Chaikin's way of falling is done unasked",
           [](A, Tags t) { t.creasing = data::Creasing::kChaikin; }),
      tags("first_tag_only", "only the first sharp edge is looked at",
           [](A, Tags t) { keep_first(t.edges, 1); }),
      edges(
          "tags_by_direction", "an edge given as (a, b) is not found from the face that has it as (b, a)",
          [](A a, const SharpEdge& tag) {
            const reference::Edge* e = edge_of(a, tag);
            return e == nullptr || e->a != tag.a;
          },
          "crease-order"),
      edges(
          "tags_lost_at_corner_0", "an edge from the last corner of its face to the first loses its tag",
          [](A a, const SharpEdge& tag) {
            const reference::Edge* e = edge_of(a, tag);
            if (e == nullptr) return true;
            const auto left = a.mesh.faces[static_cast<std::size_t>(e->left_face)];
            return left.front() == e->b && left.back() == e->a;
          },
          "corner-rotation"),
      on(On::kQuads, values(
                         "infinite_is_9", "edges that stay sharp are sharp for 9 steps",
                         [](A, float s) { return std::min(s, 9.F); }, "cut-by-hand")),
      on(On::kQuads, values(
                         "sharpness_in_halves", "a sharpness is rounded to halves",
                         [](A, float s) { return lasts(s) ? s : std::round(2 * s) / 2; }, kLaw)),
      on(On::kQuads, tags("triangles_not_smooth", "the smooth rule for triangles is ignored",
                          [](A, Tags t) { t.triangles = data::TriangleRule::kCatmark; })),
      // In what is delivered.
      on(On::kBoth, sharp(vertex("sides_apart_by_an_ulp", "one ulp between the two sides of a crease",
                                 "shared-positions",
                                 [](const At& at) {
                                   const auto side = at.side();
                                   if (!side || side->along == 0 || at.p.face % 2 == 0) return;
                                   const auto c = at.a.mesh.faces[at.face()];
                                   const VertexId from = c[side->side], to = c[at.domain().next(side->side)];
                                   for (const SharpEdge& e : at.a.mesh.sharpness.edges)
                                     if (lasts(e.sharpness) && same_edge(e, from, to))
                                       return at.out.move_up(at.v);
                                 }))),
  };
}

std::vector<Change> faults_of_rare_tags() {
  std::vector<Change> all{
      values("at_most_5", "a sharpness of more than 5 that ends is taken for 5",
             [](A, float s) { return lasts(s) ? s : std::min(s, 5.F); }),
      values("tiny_dropped", "a sharpness below 1/16 is taken for none",
             [](A, float s) { return s < .0625F ? 0 : s; }),
      values(
          "rounded_to_integers", "a sharpness is rounded to the next whole number",
          [](A, float s) { return lasts(s) ? s : std::round(s); }, kLaw),
      values(
          "rounded_near_integers", "a sharpness within 1/64 of a whole number above 1 is one less",
          [](A, float s) {
            const float whole = std::round(s);
            return s > 1 && s < 9 && s != whole && std::abs(s - whole) < .015625F ? whole - 1 : s;
          },
          kLaw),
      values(
          "just_below_1_is_none", "a sharpness between 63/64 and 1 is taken for none",
          [](A, float s) { return s < 1 && s > .984375F ? 0 : s; }, kLaw),
      values(
          "just_above_1_is_2", "a sharpness between 1 and 65/64 is taken for 2",
          [](A, float s) { return s > 1 && s < 1.015625F ? 2 : s; }, kLaw),
      values(
          "just_below_10_is_3", "a sharpness between 9.9 and 10 is taken for 3",
          [](A, float s) { return s > 9.9F && !lasts(s) ? 3 : s; }, kLaw),
      values("ends_after_3", "all tags are forgotten after 3 steps",
             [](A, float s) { return std::min(s, 3.F); }),
      values("left_is_infinite",
             "where sharpness is left at the last level, limits by the rule of the moment",
             [](A a, float s) { return s > static_cast<float>(a.deepest) ? kInfinite : s; }),
      values("left_is_dropped", "where sharpness is left at the last level, limits as if there were none",
             [](A a, float s) { return lasts(s) ? s : std::min(s, static_cast<float>(a.deepest)); }),
      values("tags_ignored_at_depth_0", "at depth 0 no tag is looked at",
             [](A a, float s) { return a.deepest == 0 ? 0 : s; }),
      // Tags that are lost by their number, the index of their vertices, or their neighbourhood.
      tags("edges_beyond_16", "only the first 16 sharp edges are looked at",
           [](A, Tags t) { keep_first(t.edges, 16); }),
      tags("vertices_beyond_4", "only the first 4 sharp vertices are looked at",
           [](A, Tags t) { keep_first(t.vertices, 4); }),
      edges("edges_of_the_first_component", "sharp edges of all components but the first are lost",
            [](A a, const SharpEdge& e) { return a.component[e.a] > 0; }),
      edges("edges_at_high_valence", "sharp edges at vertices of more than 16 faces are lost",
            [](A a, const SharpEdge& e) { return a.faces(e.a) > 16 || a.faces(e.b) > 16; }),
      edges(
          "semi_sharp_at_the_boundary", "semi-sharp edges that meet the boundary are lost",
          [](A a, const SharpEdge& e) { return !lasts(e.sharpness) && (!a.inside(e.a) || !a.inside(e.b)); }),
      edges("semi_sharp_at_infinite", "semi-sharp edges that meet lasting ones are lost",
            [](A a, const SharpEdge& e) {
              return !lasts(e.sharpness) && (a.infinite[e.a] > 0 || a.infinite[e.b] > 0);
            }),
      vertices("held_on_a_crease", "the sharpness of a vertex on a crease is lost",
               [](A a, VertexId v) { return a.inside(v) && a.sharp_edges(v) == 2; }),
      vertices("held_at_the_end", "the sharpness of a vertex where a sharp edge ends is lost",
               [](A a, VertexId v) { return a.inside(v) && a.sharp_edges(v) == 1; }),
      vertices("held_on_the_boundary", "the sharpness of boundary vertices is lost",
               [](A a, VertexId v) { return !a.inside(v); }),
      tags("crease_between_creases", "a smooth edge between two creases is taken for one",
           [](A a, Tags t) {
             std::set<std::pair<VertexId, VertexId>> tagged;
             for (const SharpEdge& e : t.edges) tagged.insert(std::minmax(e.a, e.b));
             for (const reference::Edge& e : a.topology.edges())
               if (!e.on_boundary() && a.on_inner_crease(e.a) && a.on_inner_crease(e.b) &&
                   !tagged.contains(std::minmax(e.a, e.b)))
                 t.edges.push_back({e.a, e.b, kInfinite});
           }),
      tags("chaikin_of_two_alone", "no Chaikin where three semi-sharp edges meet", [](A a, Tags t) {
        if (std::any_of(a.semi_sharp.begin(), a.semi_sharp.end(), [](int n) { return n > 2; }))
          t.creasing = data::Creasing::kUniform;
      })};
  for (const int most : {4, 6, 8})
    all.push_back(values(fmt::format("infinite_above_{}", most),
                         fmt::format("a sharpness of more than {} is taken for infinite", most),
                         [most](A, float s) { return s > static_cast<float>(most) ? kInfinite : s; }));
  for (const int most : {3, 4})
    all.push_back(tags(fmt::format("{}_edges_at_most", most),
                       fmt::format("of more than {} sharp edges at a vertex the first ones are taken", most),
                       [most](A, Tags t) { lose_edges_beyond(t, most); }));
  for (const int bits : {8, 15, 16})
    all.push_back(
        edges(fmt::format("tags_of_{}_bits", bits),
              fmt::format("sharp edges of vertices with indices of more than {} bits are lost", bits),
              [bits](A, const SharpEdge& e) { return std::max(e.a, e.b) >> bits > 0; }));
  return all;
}

}  // namespace limitcheck::verify
