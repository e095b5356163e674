// SPDX-License-Identifier: MIT
#include "verify/mutants/distortions.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace limitcheck::verify {
namespace {

using Tags = data::Sharpness;
using Edge = data::SharpEdge;
using Vertex = data::SharpVertex;

bool lasts(float s) {
  return s >= data::kInfiniteSharpness;
}

// Each sharpness becomes what `value` makes of it; 0 is no tag.
template <class Value>
void change(Tags& tags, Value value) {
  for (Edge& e : tags.edges) e.sharpness = value(e.sharpness);
  for (Vertex& v : tags.vertices) v.sharpness = value(v.sharpness);
  std::erase_if(tags.edges, [](const Edge& e) { return e.sharpness == 0; });
  std::erase_if(tags.vertices, [](const Vertex& v) { return v.sharpness == 0; });
}
// At a vertex with more edges than that, only the first ones have tags.
void lose_edges_beyond(Tags& tags, int most) {
  std::map<std::int32_t, int> count;
  std::erase_if(tags.edges, [&](const Edge& e) {
    const bool too_many = count[e.a] >= most || count[e.b] >= most;
    if (!too_many) ++count[e.a], ++count[e.b];
    return too_many;
  });
}
bool amid_more(const Around& a, std::int32_t v, int most) {
  return a.inside(v) && a.faces(v) > most;
}
bool on_inner_crease(const Around& a, std::int32_t v) {
  return a.inside(v) && a.infinite[v] == 2 && a.sharp_edges(v) == 2 && a.held[v] == 0;
}

using A = const Around&;
using V = std::int32_t;
using F = std::size_t;
using Mesh = data::ControlMesh&;

constexpr const char* kLaw = "fractional-sharpness";

// The kinds of faults, as a line each.
template <class Value>
Distortion values(std::string name, std::string description, Value value, const char* check = "positions") {
  return {name,  description,
          check, true,
          true,  [value](A a, Tags& t) { change(t, [&](float s) -> float { return value(a, s); }); }};
}
template <class Lost>
Distortion edges(std::string name, std::string description, Lost lost) {
  return {name,
          description,
          "positions",
          true,
          true,
          [lost](A a, Tags& t) {
            std::erase_if(t.edges, [&](const Edge& e) { return lost(a, e); }); }};
}
template <class Lost>
Distortion vertices(std::string name, std::string description, Lost lost) {
  return {name, description, "positions", true, true, [lost](A a, Tags& t) {
            std::erase_if(t.vertices, [&](const Vertex& v) { return lost(a, v.vertex); });
          }};
}
Distortion off(std::string name, std::string description, std::function<bool(A, V)> vertex,
               bool sharp = false, const char* check = "positions") {
  return {name, description, check, sharp, true, {}, std::move(vertex)};
}
Distortion inside(std::string name, std::string description, std::function<bool(A, F)> face,
                  bool loop = true) {
  return {name, description, "positions", false, loop, {}, {}, std::move(face)};
}
Distortion known(std::string name, std::string first, std::function<void(Mesh)> forget, bool sharp,
                 bool loop = true) {
  return {"known_without_" + name,
          "meshes that are otherwise alike have the first one's " + first,
          "state",
          sharp,
          loop,
          {},
          {},
          {},
          std::move(forget)};
}

std::vector<Distortion> classes_of_sharpness() {
  std::vector<Distortion> all{
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
            return s > 1 && s < 9 && s != std::round(s) && std::abs(s - std::round(s)) < .015625F
                       ? std::round(s) - 1
                       : s;
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
             [](A a, float s) { return s > static_cast<float>(a.depth) ? 10 : s; }),
      values("left_is_dropped", "where sharpness is left at the last level, limits as if there were none",
             [](A a, float s) { return lasts(s) ? s : std::min(s, static_cast<float>(a.depth)); }),
      values("tags_ignored_at_depth_0", "at depth 0 no tag is looked at",
             [](A a, float s) { return a.depth == 0 ? 0 : s; })};
  for (const int most : {4, 6, 8})
    all.push_back(values(fmt::format("infinite_above_{}", most),
                         fmt::format("a sharpness of more than {} is taken for infinite", most),
                         [most](A, float s) { return s > static_cast<float>(most) ? 10 : s; }));
  return all;
}

// Tags that are lost by their number, the index of their vertices, or their neighbourhood.
std::vector<Distortion> lost_tags() {
  std::vector<Distortion> all{
      {"edges_beyond_16", "only the first 16 sharp edges are looked at", "positions", true, true,
       [](A, Tags& t) { t.edges.resize(std::min<std::size_t>(t.edges.size(), 16)); }},
      {"vertices_beyond_4", "only the first 4 sharp vertices are looked at", "positions", true, true,
       [](A, Tags& t) { t.vertices.resize(std::min<std::size_t>(t.vertices.size(), 4)); }},
      edges("edges_of_the_first_component", "sharp edges of all components but the first are lost",
            [](A a, const Edge& e) { return a.component[e.a] > 0; }),
      edges("edges_at_high_valence", "sharp edges at vertices of more than 16 faces are lost",
            [](A a, const Edge& e) { return a.faces(e.a) > 16 || a.faces(e.b) > 16; }),
      edges("semi_sharp_at_the_boundary", "semi-sharp edges that meet the boundary are lost",
            [](A a, const Edge& e) { return !lasts(e.sharpness) && (!a.inside(e.a) || !a.inside(e.b)); }),
      edges("semi_sharp_at_infinite", "semi-sharp edges that meet lasting ones are lost",
            [](A a, const Edge& e) {
              return !lasts(e.sharpness) && (a.infinite[e.a] > 0 || a.infinite[e.b] > 0);
            }),
      vertices("held_on_a_crease", "the sharpness of a vertex on a crease is lost",
               [](A a, V v) { return a.inside(v) && a.sharp_edges(v) == 2; }),
      vertices("held_at_the_end", "the sharpness of a vertex where a sharp edge ends is lost",
               [](A a, V v) { return a.inside(v) && a.sharp_edges(v) == 1; }),
      vertices("held_on_the_boundary", "the sharpness of boundary vertices is lost",
               [](A a, V v) { return !a.inside(v); }),
      {"crease_between_creases", "a smooth edge between two creases is taken for one", "positions", true,
       true,
       [](A a, Tags& t) {
         std::set<std::pair<V, V>> tagged;
         for (const Edge& e : a.mesh.sharpness.edges) tagged.insert(std::minmax(e.a, e.b));
         for (const reference::Edge& e : a.topology.edges())
           if (!e.on_boundary() && on_inner_crease(a, e.a) && on_inner_crease(a, e.b) &&
               !tagged.contains(std::minmax(e.a, e.b)))
             t.edges.push_back({e.a, e.b, 10});
       }},
      {"chaikin_of_two_alone", "no Chaikin where three semi-sharp edges meet", "positions", true, true,
       [](A a, Tags& t) {
         if (std::any_of(a.semi_sharp.begin(), a.semi_sharp.end(), [](int n) { return n > 2; }))
           t.creasing = data::Creasing::kUniform;
       }}};
  for (const int most : {3, 4})
    all.push_back({fmt::format("{}_edges_at_most", most),
                   fmt::format("of more than {} sharp edges at a vertex the first ones are taken", most),
                   "positions", true, true, [most](A, Tags& t) { lose_edges_beyond(t, most); }});
  for (const int bits : {8, 15, 16})
    all.push_back(
        edges(fmt::format("tags_of_{}_bits", bits),
              fmt::format("sharp edges of vertices with indices of more than {} bits are lost", bits),
              [bits](A, const Edge& e) { return std::max(e.a, e.b) >> bits > 0; }));
  return all;
}

// Neighbourhoods with tags, tables that end, and shapes of meshes.
std::vector<Distortion> places() {
  std::vector<Distortion> all{
      off(
          "crease_above_6", "vertices of creases with more than six faces are off",
          [](A a, V v) { return on_inner_crease(a, v) && a.faces(v) > 6; }, true),
      off(
          "side_of_three_faces", "vertices of creases with three faces on a side are off",
          [](A a, V v) { return a.faces_of_side(v) == 3 || a.faces(v) - a.faces_of_side(v) == 3; }, true),
      off(
          "corner_of_4_edges", "vertices where four creases meet are off",
          [](A a, V v) { return a.inside(v) && a.infinite[v] == 4; }, true),
      off(
          "dart_above_6", "ends of creases amid more than six faces are off",
          [](A a, V v) { return amid_more(a, v, 6) && a.infinite[v] == 1; }, true),
      off(
          "crease_to_the_boundary", "vertices where a crease meets the boundary are off",
          [](A a, V v) { return !a.inside(v) && a.infinite[v] > 2; }, true),
      off("boundary_above_6", "boundary vertices of more than six faces are off",
          [](A a, V v) { return !a.inside(v) && a.faces(v) > 6; }),
      inside("second_component_off", "the inside of faces of the second component is off",
             [](A a, F f) { return a.component[a.mesh.faces[f][0]] == 1; }),
      inside("genus_2_off", "the inside of faces of a surface of genus 2 is off",
             [](A a, F) { return a.characteristic() == -2; }),
      inside("depth_above_5", "the inside of faces of frames deeper than 5 is off",
             [](A a, F) { return a.depth > 5; }),
      inside(
          "polygons_above_depth_4", "the inside of no quads of frames deeper than 4 is off",
          [](A a, F f) { return a.depth > 4 && a.mesh.faces[f].size() != 4; }, false)};
  for (const int n : {3, 5})
    all.push_back(off(
        fmt::format("crease_of_valence_{}", n), fmt::format("vertices of creases with {} faces are off", n),
        [n](A a, V v) { return on_inner_crease(a, v) && a.faces(v) == n; }, true));
  for (const int n : {9, 10, 13})
    all.push_back(off(fmt::format("valence_{}", n), fmt::format("vertices amid {} faces are off", n),
                      [n](A a, V v) { return a.inside(v) && a.faces(v) == n; }));
  for (const int n : {8, 16, 64, 100, 255})
    all.push_back(off(fmt::format("table_of_{}", n),
                      fmt::format("vertices amid more than {} faces are off", n),
                      [n](A a, V v) { return amid_more(a, v, n); }));
  for (const int bits : {15, 16})
    all.push_back(off(fmt::format("vertices_of_{}_bits", bits),
                      fmt::format("vertices with indices of more than {} bits are off", bits),
                      [bits](A, V v) { return v >> bits > 0; }));
  for (const std::size_t n : {9U, 17U, 65U, 256U})
    all.push_back(inside(
        fmt::format("polygons_of_{}", n), fmt::format("the inside of faces of {} corners and more is off", n),
        [n](A a, F f) { return a.mesh.faces[f].size() >= n; }, false));
  return all;
}

std::vector<Distortion> memories() {
  return {
      known(
          "tags", "tags", [](Mesh m) { m.sharpness.edges.clear(), m.sharpness.vertices.clear(); }, true),
      known(
          "values", "sharpness", [](Mesh m) { change(m.sharpness, [](float) { return 1.F; }); }, true),
      known(
          "creasing", "creasing", [](Mesh m) { m.sharpness.creasing = data::Creasing::kUniform; }, true),
      known(
          "boundary", "boundary option", [](Mesh m) { m.sharpness.boundary = data::Boundary::kEdge; }, false),
      known(
          "triangles", "rule of triangles",
          [](Mesh m) { m.sharpness.triangles = data::TriangleRule::kCatmark; }, false, false),
      known(
          "positions", "positions",
          [](Mesh m) { std::fill(m.positions.begin(), m.positions.end(), std::array<double, 3>{}); }, false),
      {.name = "tags_of_the_last",
       .description = "meshes of the same faces have the tags of the last one made",
       .check = "state",
       .kept = Distortion::Kept::kTagsOfTheLast},
      {.name = "culling_of_the_first",
       .description = "requests as deep as an earlier one cull as it did",
       .check = "state",
       .sharp = false,
       .kept = Distortion::Kept::kCulling},
      off(
          "tables_of_the_first", "tables end at the largest valence of the first mesh",
          [](A a, V v) { return a.faces(v) > a.first_most; }, false, "state"),
      off(
          "tables_of_a_large_first",
          "after a first mesh with hubs, vertices amid less than six faces are off",
          [](A a, V v) { return a.first_most > 32 && a.first_most != a.faces(v) && a.faces(v) < 6; }, false,
          "state")};
}

}  // namespace

Around::Around(const data::ControlMesh& of, data::Scheme by, int at_depth)
    : mesh(of),
      scheme(by),
      depth(at_depth),
      topology(of.positions.size(), of.faces),
      infinite(of.positions.size()),
      semi_sharp(infinite.size()),
      held(infinite.size()),
      component(infinite.size()) {
  // Tags that name no vertex are for the sound subject to refuse.
  const auto known = [&](std::int32_t v) { return v >= 0 && static_cast<std::size_t>(v) < held.size(); };
  const auto count = [&](std::vector<int>& to, std::int32_t a, std::int32_t b) {
    if (known(a) && known(b)) ++to[a], ++to[b];
  };
  std::map<std::pair<std::int32_t, std::int32_t>, bool> boundary;
  for (const reference::Edge& e : topology.edges())
    if (e.on_boundary()) {
      boundary[std::minmax(e.a, e.b)] = true;
      count(infinite, e.a, e.b);
    }
  for (const Edge& e : mesh.sharpness.edges)
    if (e.sharpness > 0 && !boundary.contains(std::minmax(e.a, e.b)))
      count(lasts(e.sharpness) ? infinite : semi_sharp, e.a, e.b);
  for (const Vertex& v : mesh.sharpness.vertices)
    if (known(v.vertex)) held[v.vertex] = v.sharpness;

  // The least number of a vertex that is joined to it, then numbered.
  std::vector<std::int32_t> root(infinite.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::int32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const reference::Edge& e : topology.edges()) root[find(e.a)] = find(e.b);
  std::map<std::int32_t, int> number;
  for (const std::int32_t v : mesh.faces.corners()) number.emplace(find(v), static_cast<int>(number.size()));
  for (const std::int32_t v : mesh.faces.corners()) component[v] = number.at(find(v));
}

int Around::faces_of_side(std::int32_t v) const {
  if (!inside(v) || infinite[v] != 2) return 0;
  std::vector<int> at;
  const reference::Sector sector = topology.sector(v);
  for (std::size_t k = 0; k < sector.neighbours.size(); ++k)
    for (const Edge& e : mesh.sharpness.edges)
      if (lasts(e.sharpness) && std::minmax(e.a, e.b) == std::minmax(v, sector.neighbours[k]))
        at.push_back(static_cast<int>(k));
  return at.size() == 2 ? at[1] - at[0] : 0;
}

std::int64_t Around::characteristic() const {
  return static_cast<std::int64_t>(mesh.positions.size()) -
         static_cast<std::int64_t>(topology.edges().size()) + static_cast<std::int64_t>(mesh.faces.size());
}

std::span<const Distortion> distortions() {
  static const std::vector<Distortion> list = [] {
    std::vector<Distortion> all{{"none", "none"}};
    for (const std::vector<Distortion>& some : {classes_of_sharpness(), lost_tags(), places(), memories()})
      all.insert(all.end(), some.begin(), some.end());
    return all;
  }();
  return list;
}

bool shows(const Distortion& fault, const data::ControlMesh& mesh, data::Scheme scheme, int depth) {
  if (scheme == data::Scheme::kLoop && !fault.loop) return false;
  if (fault.check != "positions") return true;
  const Around around(mesh, scheme, depth);
  if (fault.take) {
    data::Sharpness tags = mesh.sharpness;
    fault.take(around, tags);
    return !(tags == mesh.sharpness);
  }
  if (fault.vertex) {
    for (const std::int32_t v : mesh.faces.corners())
      if (fault.vertex(around, v)) return true;
    return false;
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (fault.face(around, f)) return true;
  return false;
}

}  // namespace limitcheck::verify
