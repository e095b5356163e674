// SPDX-License-Identifier: MIT
// Faults of what is declared, refused and remembered.
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

}  // namespace limitcheck::verify
