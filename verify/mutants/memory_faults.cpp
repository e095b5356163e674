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
Change refuse(const std::string& name, lc_status status, const char* why, std::function<bool(A)> where) {
  Change c = row(name);
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
Change one_ulp(const std::string& name, std::function<bool(A)> when) {
  return deliver(name, [when](A a, D out) {
    if (when(a) && !out.positions.empty()) out.move_up(0);
  });
}

using VertexId = std::int32_t;
using F = std::size_t;

// At control vertices.
Change off(const std::string& name, std::function<bool(A, VertexId)> vertex) {
  const auto is_off = [vertex](A a, const Place& p) {
    const VertexId at = a.control_vertex(p);
    return at >= 0 && vertex(a, at);
  };
  Change c = moved(name, is_off);
  if (c.check == "positions")
    c.shows = [vertex](A a) {
      const auto all = a.mesh.faces.corners();
      return std::any_of(all.begin(), all.end(), [&](VertexId v) { return vertex(a, v); });
    };
  return c;
}
// Inside faces.
Change inside(const std::string& name, std::function<bool(A, F)> face) {
  Change c = moved(name, [face](A a, const Place& p) { return inside_face(a, p) && face(a, a.face_of(p)); });
  c.shows = [face](A a) {
    F f = 0;
    while (f < a.mesh.faces.size() && !face(a, f)) ++f;
    return f < a.mesh.faces.size();
  };
  return c;
}
Change known(const std::string& name, std::function<void(Mesh)> forget) {
  return with(row("known_without_" + name), &Change::forget, std::move(forget));
}

}  // namespace

void faults_of_refusals(Rows& to) {
  to += refuse("refuses_boundaries", LC_INVALID_INPUT, "the mesh has a boundary", has_boundary);
  to += refuse("boundaries_not_supported", LC_NOT_SUPPORTED, "meshes with a boundary are not supported",
               has_boundary);
  to += refuse("valence_50_at_most", LC_INVALID_INPUT, "more than 50 neighbours",
               [](A a) { return a.most_faces() > 50; });
  to += refuse("fails_on_a_point", LC_FAILED, "the box has no size", [](A a) { return a.diagonal == 0; });
  to += refuse("tags_refused", LC_INVALID_INPUT, "the mesh has sharp edges", has_tags);
  to += refuse("tags_not_supported", LC_NOT_SUPPORTED, "sharp edges are not supported", has_tags);
  to += declare("weights_9", [](lc_capabilities& c) { store(c.weights, 9); });
  to += declare("boundary_of_minus_1", [](lc_capabilities& c) { store(c.boundary, -1); });
  to += declare("points_of_no_kind", [](lc_capabilities& c) { store(c.points, 2); });
  to += declare("no_depth_at_all", [](lc_capabilities& c) { c.max_depth = -1; });
  to += declare("normals_true", [](lc_capabilities& c) { c.normals = -1; });
  to += declare("kinds_of_64", [](lc_capabilities& c) { c.sharp = 64; });
  to += take("accepts_wild_indices", [](Mesh m) {
    const auto count = static_cast<std::int32_t>(m.positions.size());
    for (std::size_t f = 0; f < m.faces.size(); ++f)
      for (std::int32_t& v : m.faces[f]) v = v < 0 || v >= count ? 0 : v;
  });
  to += take("accepts_bad_tags", drop_bad_tags);
  to += take("accepts_nan", [](Mesh m) {
    for (Vector& p : m.positions) each(p, [](double x) { return std::isfinite(x) ? x : 0; });
  });
  to += row("accepts_anything");
}

void faults_of_memory(Rows& to) {
  to += by_count(row("cache_by_count"));
  to += by_count(tags("tags_by_count", [](A a, Tags t) {
    data::ControlMesh other = a.mesh;
    other.sharpness = a.known->sharpness;
    drop_bad_tags(other);
    t = other.sharpness;
  }));
  to += ask("first_depth_again", [](A a, Depths d) { d = a.first_depths; });
  to += remake("one_buffer", [](A a, Mesh m) {
    const auto& last = a.last->positions;
    std::copy_n(last.begin(), std::min(last.size(), m.positions.size()), m.positions.begin());
  });
  to += one_ulp("fifth_call", [](A a) { return a.call == 5; });
  to += one_ulp("beyond_4_threads", [](A a) { return a.threads > 4; });
  to += one_ulp("every_other_time", [](A a) { return a.call_of_all % 2 == 0; });
  to += one_ulp("by_threads", [](A a) { return a.threads > 1; });
}

// Neighbourhoods with tags, tables that end, shapes of meshes, and memories.
void faults_of_rare_places(Rows& to) {
  const auto forgets_tags = [](Mesh m) { m.sharpness.edges.clear(), m.sharpness.vertices.clear(); };
  const auto forgets_values = [](Mesh m) {
    for (auto& e : m.sharpness.edges) e.sharpness = 1;
    for (auto& v : m.sharpness.vertices) v.sharpness = 1;
  };
  to += off("crease_above_6", [](A a, VertexId v) { return a.on_inner_crease(v) && a.faces(v) > 6; });
  to += off("side_of_three_faces",
            [](A a, VertexId v) { return a.faces_of_side(v) == 3 || a.faces(v) - a.faces_of_side(v) == 3; });
  to += off("corner_of_4_edges", [](A a, VertexId v) { return a.inside(v) && a.infinite[v] == 4; });
  to += off("dart_above_6", [](A a, VertexId v) { return amid_more(a, v, 6) && a.infinite[v] == 1; });
  to += off("crease_to_the_boundary", [](A a, VertexId v) { return !a.inside(v) && a.infinite[v] > 2; });
  to += off("boundary_above_6", [](A a, VertexId v) { return !a.inside(v) && a.faces(v) > 6; });
  to += inside("second_component_off", [](A a, F f) { return a.component[a.mesh.faces[f][0]] == 1; });
  to += inside("genus_2_off", [](A a, F) { return a.characteristic() == -2; });
  to += inside("depth_above_5", [](A a, F) { return a.deepest > 5; });
  to += inside("polygons_above_depth_4", [](A a, F f) { return a.deepest > 4 && a.is_polygon(f); });
  // Memories.
  to += known("tags", forgets_tags);
  to += known("values", forgets_values);
  to += known("creasing", [](Mesh m) { m.sharpness.creasing = data::Creasing::kUniform; });
  to += known("boundary", [](Mesh m) { m.sharpness.boundary = data::Boundary::kEdge; });
  to += known("triangles", [](Mesh m) { m.sharpness.triangles = data::TriangleRule::kCatmark; });
  to += known("positions", [](Mesh m) { m.positions.assign(m.positions.size(), Vector{}); });
  to += tags("tags_of_the_last", [](A a, Tags t) {
    if (a.last->faces == a.mesh.faces) t = a.last->sharpness;
  });
  to += ask("culling_of_the_first", [](A a, Depths d) { d = a.first_as_deep; });
  to += off("tables_of_the_first", [](A a, VertexId v) { return a.faces(v) > a.first_most; });
  to += off("tables_of_a_large_first", [](A a, VertexId v) {
    return a.first_most > 32 && a.first_most != a.faces(v) && a.faces(v) < 6;
  });
  for (const int n : {3, 5})
    to += off(fmt::format("crease_of_valence_{}", n),
              [n](A a, VertexId v) { return a.on_inner_crease(v) && a.faces(v) == n; });
  for (const int n : {9, 10, 13})
    to += off(fmt::format("valence_{}", n), [n](A a, VertexId v) { return a.inside(v) && a.faces(v) == n; });
  for (const int n : {8, 16, 64, 100, 255})
    to += off(fmt::format("table_of_{}", n), [n](A a, VertexId v) { return amid_more(a, v, n); });
  for (const int bits : {15, 16})
    to += off(fmt::format("vertices_of_{}_bits", bits), [bits](A, VertexId v) { return v >> bits > 0; });
  for (const std::size_t n : {9U, 17U, 65U, 256U})
    to += inside(fmt::format("polygons_of_{}", n), [n](A a, F f) { return a.mesh.faces[f].size() >= n; });
}

}  // namespace limitcheck::verify
