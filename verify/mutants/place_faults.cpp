// SPDX-License-Identifier: MIT
// Faults that one neighbourhood or one memory brings out, in both schemes: points at some places move, or what
// is known of an earlier mesh is kept.
#include <fmt/core.h>

#include <algorithm>
#include "verify/mutants/change_rows.h"

namespace limitcheck::verify {

using namespace rows;

namespace {

using V = std::int32_t;
using F = std::size_t;

// Moves the vertices that `is_off` names by their places by 1e-5 of the mesh.
std::function<void(A, D)> moved(std::function<bool(A, const Place&)> is_off) {
  return [is_off](A a, D out) {
    for (std::size_t v = 0; v < out.positions.size(); ++v)
      if (is_off(a, out.place(v))) out.positions[v][0] += 1e-5 * a.largest;
  };
}
// At control vertices.
Change off(std::string name, std::string description, std::function<bool(A, V)> vertex,
           const char* check = "positions") {
  Change c = on(On::kBoth, row(std::move(name), std::move(description), check));
  c.deliver = moved([vertex](A a, const Place& p) {
    const V at = a.control_vertex(p);
    return at >= 0 && vertex(a, at);
  });
  if (c.check == "positions")
    c.shows = [vertex](A a) {
      const auto all = a.mesh.faces.corners();
      return std::any_of(all.begin(), all.end(), [&](V v) { return vertex(a, v); });
    };
  return c;
}
// Inside faces.
Change inside(std::string name, std::string description, std::function<bool(A, F)> face) {
  Change c = on(On::kBoth, row(std::move(name), std::move(description), "positions"));
  c.deliver = moved([face](A a, const Place& p) { return inside_face(a, p) && face(a, a.face_of(p)); });
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
bool amid_more(A a, V v, int most) {
  return a.inside(v) && a.faces(v) > most;
}

}  // namespace

// Neighbourhoods with tags, tables that end, shapes of meshes, and memories.
std::vector<Change> faults_of_rare_places() {
  const auto forgets_tags = [](Mesh m) { m.sharpness.edges.clear(), m.sharpness.vertices.clear(); };
  const auto forgets_values = [](Mesh m) {
    for (auto& e : m.sharpness.edges) e.sharpness = 1;
    for (auto& v : m.sharpness.vertices) v.sharpness = 1;
  };
  std::vector<Change> all{
      sharp(off("crease_above_6", "vertices of creases with more than six faces are off",
                [](A a, V v) { return a.on_inner_crease(v) && a.faces(v) > 6; })),
      sharp(off("side_of_three_faces", "vertices of creases with three faces on a side are off",
                [](A a, V v) { return a.faces_of_side(v) == 3 || a.faces(v) - a.faces_of_side(v) == 3; })),
      sharp(off("corner_of_4_edges", "vertices where four creases meet are off",
                [](A a, V v) { return a.inside(v) && a.infinite[v] == 4; })),
      sharp(off("dart_above_6", "ends of creases amid more than six faces are off",
                [](A a, V v) { return amid_more(a, v, 6) && a.infinite[v] == 1; })),
      sharp(off("crease_to_the_boundary", "vertices where a crease meets the boundary are off",
                [](A a, V v) { return !a.inside(v) && a.infinite[v] > 2; })),
      off("boundary_above_6", "boundary vertices of more than six faces are off",
          [](A a, V v) { return !a.inside(v) && a.faces(v) > 6; }),
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
          [](A a, V v) { return a.faces(v) > a.first_most; }, "state"),
      off(
          "tables_of_a_large_first",
          "after a first mesh with hubs, vertices amid less than six faces are off",
          [](A a, V v) { return a.first_most > 32 && a.first_most != a.faces(v) && a.faces(v) < 6; },
          "state")};
  for (const int n : {3, 5})
    all.push_back(sharp(off(fmt::format("crease_of_valence_{}", n),
                            fmt::format("vertices of creases with {} faces are off", n),
                            [n](A a, V v) { return a.on_inner_crease(v) && a.faces(v) == n; })));
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
    all.push_back(on(On::kQuads, inside(fmt::format("polygons_of_{}", n),
                                        fmt::format("the inside of faces of {} corners and more is off", n),
                                        [n](A a, F f) { return a.mesh.faces[f].size() >= n; })));
  return all;
}

}  // namespace limitcheck::verify
