// SPDX-License-Identifier: MIT
// Faults of what is declared, refused and remembered, and those that one neighbourhood or one memory brings out, in both
// schemes: points at some places move, or what is known of an earlier mesh is kept.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "verify/mutants/change_rows.h"

namespace limitcheck::verify {

using namespace rows;

namespace {

// A subject in C may store values that C++ does not let an enumeration hold.
void store(auto& value, std::int32_t number) {
  std::memcpy(&value, &number, sizeof value);
}
Change declare(const char* name, const char* description, std::function<void(lc_capabilities&)> what) {
  return with(row(name, description, "tessellates"), &Change::declare, std::move(what));
}
Change refuse(const char* name, const char* description, lc_status status, const char* why,
              std::function<bool(A)> where, const char* check = "tessellates") {
  Change c = row(name, description, check);
  c.refuse = [=](A a) {
    if (where(a)) throw SubjectError(status, why);
  };
  return c;
}
bool has_boundary(A a) {
  const auto edges = a.topology.edges();
  return std::any_of(edges.begin(), edges.end(), [](const reference::Edge& e) { return e.on_boundary(); });
}
bool has_tags(A a) {
  return !a.mesh.sharpness.empty();
}

// The pairs of vertices that follow each other in a face of a mesh that need not be valid.
std::set<std::pair<std::int32_t, std::int32_t>> edges_of(const data::ControlMesh& m) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (std::size_t f = 0; f < m.faces.size(); ++f)
    for (std::size_t k = 0, n = m.faces[f].size(); k < n; ++k)
      edges.insert(std::minmax(std::int32_t{m.faces[f][k]}, std::int32_t{m.faces[f][(k + 1) % n]}));
  return edges;
}
// Without tags that mean nothing.
void drop_bad_tags(Mesh m) {
  const auto edges = edges_of(m);
  const auto count = static_cast<std::int32_t>(m.positions.size());
  std::erase_if(m.sharpness.edges,
                [&](const auto& e) { return !(e.sharpness > 0) || !edges.contains(std::minmax(e.a, e.b)); });
  std::erase_if(m.sharpness.vertices,
                [&](const auto& v) { return !(v.sharpness > 0) || v.vertex < 0 || v.vertex >= count; });
}

// All that is known of a mesh are its numbers of vertices and faces.
Change by_count(Change c) {
  c.forget = [](Mesh m) {
    m.positions.assign(m.positions.size(), Vector{});
    const std::size_t faces = m.faces.size();
    m.faces.clear();
    for (std::size_t f = 0; f < faces; ++f) m.faces.push_back({0});
    m.sharpness = {};
  };
  return c;
}
Change one_ulp(const char* name, const char* description, const char* check, std::function<bool(A)> when) {
  return deliver(name, description, check, [when](A a, D out) {
    if (when(a) && !out.positions.empty()) out.move_up(0);
  });
}

using VertexId = std::int32_t;
using F = std::size_t;

// At control vertices.
Change off(std::string name, std::string description, std::function<bool(A, VertexId)> vertex,
           const char* check = "positions") {
  const auto is_off = [vertex](A a, const Place& p) {
    const VertexId at = a.control_vertex(p);
    return at >= 0 && vertex(a, at);
  };
  Change c = on(On::kBoth, moved(std::move(name), std::move(description), is_off, check));
  if (c.check == "positions")
    c.shows = [vertex](A a) {
      const auto all = a.mesh.faces.corners();
      return std::any_of(all.begin(), all.end(), [&](VertexId v) { return vertex(a, v); });
    };
  return c;
}
// Inside faces.
Change inside(std::string name, std::string description, std::function<bool(A, F)> face) {
  Change c = on(On::kBoth, moved(std::move(name), std::move(description), [face](A a, const Place& p) {
                  return inside_face(a, p) && face(a, a.face_of(p));
                }));
  c.shows = [face](A a) {
    F f = 0;
    while (f < a.mesh.faces.size() && !face(a, f)) ++f;
    return f < a.mesh.faces.size();
  };
  return c;
}
Change known(const std::string& name, const std::string& first, std::function<void(Mesh)> forget) {
  return on(On::kBoth, with(row("known_without_" + name,
                                "meshes that are otherwise alike have the first one's " + first, "state"),
                            &Change::forget, std::move(forget)));
}

}  // namespace

std::vector<Change> faults_of_refusals() {
  return {
      refuse("refuses_boundaries", "calls a valid mesh with boundary invalid", LC_INVALID_INPUT,
             "the mesh has a boundary", has_boundary),
      refuse("boundaries_not_supported", "declares boundaries, and supports none", LC_NOT_SUPPORTED,
             "meshes with a boundary are not supported", has_boundary),
      refuse("valence_50_at_most", "calls a valid mesh with a valence above 50 invalid", LC_INVALID_INPUT,
             "more than 50 neighbours", [](A a) { return a.most_faces() > 50; }),
      refuse(
          "fails_on_a_point", "gives up on a bounding box without size", LC_FAILED, "the box has no size",
          [](A a) { return a.diagonal == 0; }, "degenerate-geometry"),
      sharp(
          on(On::kBoth, refuse("tags_refused", "declares sharp edges, and calls a mesh that has some invalid",
                               LC_INVALID_INPUT, "the mesh has sharp edges", has_tags))),
      sharp(on(On::kBoth, refuse("tags_not_supported", "declares sharp edges, and does not support them",
                                 LC_NOT_SUPPORTED, "sharp edges are not supported", has_tags))),
      declare("weights_9", "declares a family of weights that there is not",
              [](lc_capabilities& c) { store(c.weights, 9); }),
      declare("boundary_of_minus_1", "declares a kind of boundary that there is not",
              [](lc_capabilities& c) { store(c.boundary, -1); }),
      declare("points_of_no_kind", "declares a kind of points that there is not",
              [](lc_capabilities& c) { store(c.points, 2); }),
      declare("no_depth_at_all", "declares -1 as its largest depth",
              [](lc_capabilities& c) { c.max_depth = -1; }),
      declare("normals_true", "declares normals by -1, as some languages say true",
              [](lc_capabilities& c) { c.normals = -1; }),
      sharp(on(On::kBoth, declare("kinds_of_64", "declares a kind of sharp edge that there is not",
                                  [](lc_capabilities& c) { c.sharp = 64; }))),
      with(take("accepts_wild_indices", "takes an index out of range for vertex 0", "rejected-inputs",
                [](Mesh m) {
                  const auto count = static_cast<std::int32_t>(m.positions.size());
                  for (std::size_t f = 0; f < m.faces.size(); ++f)
                    for (std::int32_t& v : m.faces[f]) v = v < 0 || v >= count ? 0 : v;
                }),
           &Change::deaf, true),
      take("accepts_bad_tags", "leaves out sharpness that is no number or of no edge", "rejected-inputs",
           drop_bad_tags),
      take("accepts_nan", "takes control points that are no numbers", "rejected-inputs",
           [](Mesh m) {
             for (Vector& p : m.positions) each(p, [](double x) { return std::isfinite(x) ? x : 0; });
           }),
      claimed(
          with(row("accepts_anything", "takes what is no manifold, and delivers nothing", "rejected-inputs"),
               &Change::deaf, true),
          "C06"),
  };
}

std::vector<Change> faults_of_memory() {
  return {
      on(On::kBoth, by_count(row("cache_by_count",
                                 "meshes are known again by their numbers of vertices and faces", "state"))),
      by_count(tags(
          "tags_by_count", "a mesh of as many vertices and faces has the tags of the one before",
          [](A a, Tags t) {
            data::ControlMesh other = a.mesh;
            other.sharpness = a.known->sharpness;
            drop_bad_tags(other);
            t = other.sharpness;
          },
          "state")),
      ask("first_depth_again", "the first tessellation of a mesh again, whatever depth is asked for", "state",
          [](A a, Depths d) { d = a.first_depths; }),
      remake("one_buffer", "all instances keep their control points in one place", "state",
             [](A a, Mesh m) {
               const auto& last = a.last->positions;
               std::copy_n(last.begin(), std::min(last.size(), m.positions.size()), m.positions.begin());
             }),
      one_ulp("fifth_call", "the fifth call on an instance: one ulp in one point", "state",
              [](A a) { return a.call == 5; }),
      one_ulp("beyond_4_threads", "with more than four threads: one ulp in one point", "state",
              [](A a) { return a.threads > 4; }),
      on(On::kBoth, one_ulp("every_other_time", "every other call: one ulp in one point", "determinism",
                            [](A a) { return a.call_of_all % 2 == 0; })),
      one_ulp("by_threads", "with more than one thread: one ulp in one point", "determinism",
              [](A a) { return a.threads > 1; }),
  };
}

// Neighbourhoods with tags, tables that end, shapes of meshes, and memories.
std::vector<Change> faults_of_rare_places() {
  const auto forgets_tags = [](Mesh m) { m.sharpness.edges.clear(), m.sharpness.vertices.clear(); };
  const auto forgets_values = [](Mesh m) {
    for (auto& e : m.sharpness.edges) e.sharpness = 1;
    for (auto& v : m.sharpness.vertices) v.sharpness = 1;
  };
  std::vector<Change> all{
      sharp(off("crease_above_6", "vertices of creases with more than six faces are off",
                [](A a, VertexId v) { return a.on_inner_crease(v) && a.faces(v) > 6; })),
      sharp(off(
          "side_of_three_faces", "vertices of creases with three faces on a side are off",
          [](A a, VertexId v) { return a.faces_of_side(v) == 3 || a.faces(v) - a.faces_of_side(v) == 3; })),
      sharp(off("corner_of_4_edges", "vertices where four creases meet are off",
                [](A a, VertexId v) { return a.inside(v) && a.infinite[v] == 4; })),
      sharp(off("dart_above_6", "ends of creases amid more than six faces are off",
                [](A a, VertexId v) { return amid_more(a, v, 6) && a.infinite[v] == 1; })),
      sharp(off("crease_to_the_boundary", "vertices where a crease meets the boundary are off",
                [](A a, VertexId v) { return !a.inside(v) && a.infinite[v] > 2; })),
      off("boundary_above_6", "boundary vertices of more than six faces are off",
          [](A a, VertexId v) { return !a.inside(v) && a.faces(v) > 6; }),
      inside("second_component_off", "the inside of faces of the second component is off",
             [](A a, F f) { return a.component[a.mesh.faces[f][0]] == 1; }),
      inside("genus_2_off", "the inside of faces of a surface of genus 2 is off",
             [](A a, F) { return a.characteristic() == -2; }),
      inside("depth_above_5", "the inside of faces of frames deeper than 5 is off",
             [](A a, F) { return a.deepest > 5; }),
      on(On::kQuads, inside("polygons_above_depth_4", "the inside of no quads of frames deeper than 4 is off",
                            [](A a, F f) { return a.deepest > 4 && a.is_polygon(f); })),
      // Memories.
      sharp(known("tags", "tags", forgets_tags)), sharp(known("values", "sharpness", forgets_values)),
      sharp(known("creasing", "creasing", [](Mesh m) { m.sharpness.creasing = data::Creasing::kUniform; })),
      known("boundary", "boundary option", [](Mesh m) { m.sharpness.boundary = data::Boundary::kEdge; }),
      on(On::kQuads, known("triangles", "rule of triangles",
                           [](Mesh m) { m.sharpness.triangles = data::TriangleRule::kCatmark; })),
      known("positions", "positions", [](Mesh m) { m.positions.assign(m.positions.size(), Vector{}); }),
      tags(
          "tags_of_the_last", "meshes of the same faces have the tags of the last one made",
          [](A a, Tags t) {
            if (a.last->faces == a.mesh.faces) t = a.last->sharpness;
          },
          "state"),
      on(On::kBoth, ask("culling_of_the_first", "requests as deep as an earlier one cull as it did", "state",
                        [](A a, Depths d) { d = a.first_as_deep; })),
      off(
          "tables_of_the_first", "tables end at the largest valence of the first mesh",
          [](A a, VertexId v) { return a.faces(v) > a.first_most; }, "state"),
      off(
          "tables_of_a_large_first",
          "after a first mesh with hubs, vertices amid less than six faces are off",
          [](A a, VertexId v) { return a.first_most > 32 && a.first_most != a.faces(v) && a.faces(v) < 6; },
          "state")};
  for (const int n : {3, 5})
    all.push_back(sharp(off(fmt::format("crease_of_valence_{}", n),
                            fmt::format("vertices of creases with {} faces are off", n),
                            [n](A a, VertexId v) { return a.on_inner_crease(v) && a.faces(v) == n; })));
  for (const int n : {9, 10, 13})
    all.push_back(off(fmt::format("valence_{}", n), fmt::format("vertices amid {} faces are off", n),
                      [n](A a, VertexId v) { return a.inside(v) && a.faces(v) == n; }));
  for (const int n : {8, 16, 64, 100, 255})
    all.push_back(off(fmt::format("table_of_{}", n),
                      fmt::format("vertices amid more than {} faces are off", n),
                      [n](A a, VertexId v) { return amid_more(a, v, n); }));
  for (const int bits : {15, 16})
    all.push_back(off(fmt::format("vertices_of_{}_bits", bits),
                      fmt::format("vertices with indices of more than {} bits are off", bits),
                      [bits](A, VertexId v) { return v >> bits > 0; }));
  for (const std::size_t n : {9U, 17U, 65U, 256U})
    all.push_back(on(On::kQuads, inside(fmt::format("polygons_of_{}", n),
                                        fmt::format("the inside of faces of {} corners and more is off", n),
                                        [n](A a, F f) { return a.mesh.faces[f].size() >= n; })));
  return all;
}

}  // namespace limitcheck::verify
