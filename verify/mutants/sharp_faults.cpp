// SPDX-License-Identifier: MIT
// Faults of the rules of sharp edges and vertices: as tags with which a sound subject does the same, or nearly, and in
// the limits that it delivers.
#include <algorithm>
#include <cmath>
#include <map>

#include "verify/mutants/change_rows.h"

namespace limitcheck::verify {

using namespace rows;

namespace {

using VertexId = std::int32_t;
using data::SharpEdge;

// Vertices inside with so many sharp edges stay where they are.
Change held(const std::string& name, int edges) {
  return tags(name, [edges](A a, Tags t) {
    for (VertexId v = 0; v < std::ssize(a.mesh.positions); ++v)
      if (a.inside(v) && a.sharp_edges(v) == edges && a.held[v] == 0)
        t.vertices.push_back({v, data::kInfiniteSharpness});
  });
}
// A sharpness that ends is another one; 0 is none.
Change ends(const std::string& name, std::function<float(float)> value) {
  return values(name, [value](A, float s) { return lasts(s) ? s : value(s); });
}

// A semi-sharp edge inside beside the others that end, at its first end and at the second.
struct Beside {
  float own;
  std::array<float, 2> mean, most{}, sum{};
  bool lasting;  // whether an edge there stays sharp
};
Change beside(const std::string& name, data::Creasing creasing, std::function<float(const Beside&)> value) {
  return tags(name, [=](A a, Tags t) {
    if (t.creasing != creasing) return;
    for (SharpEdge& e : t.edges) {
      if (lasts(e.sharpness) || !a.inside(e.a) || !a.inside(e.b)) continue;
      Beside all{e.sharpness, {e.sharpness, e.sharpness}};
      for (std::size_t end = 0; end < 2; ++end) {
        float count = 0;
        for (const SharpEdge& other : a.mesh.sharpness.edges) {
          const VertexId v = end == 0 ? e.a : e.b;
          if (same_edge(other, e.a, e.b) || (other.a != v && other.b != v)) continue;
          all.lasting |= lasts(other.sharpness);
          if (lasts(other.sharpness)) continue;
          all.sum[end] += other.sharpness, ++count;
          all.most[end] = std::max(all.most[end], other.sharpness);
          all.mean[end] = all.sum[end] / count;
        }
      }
      e.sharpness = std::max(0.F, value(all));
    }
    std::erase_if(t.edges, [](const SharpEdge& e) { return e.sharpness == 0; });
  });
}
// By Chaikin's creasing an edge is sharper by a quarter of what is told.
Change chaikin(const std::string& name, std::function<float(const Beside&)> more) {
  return beside(name, data::Creasing::kChaikin, [more](const Beside& b) { return b.own + more(b) / 4; });
}

// Positions or normals at some control vertices as they are with other tags.
Change limits(const std::string& name, std::function<bool(A, VertexId)> which,
              std::function<void(Tags)> other,
              std::vector<Vector> DeliveredArrays::*what = &Delivered::positions) {
  return deliver(name, [=](A a, D out) {
    data::ControlMesh mesh = a.mesh;
    other(mesh.sharpness);
    Delivered there = a.again(mesh, {a.depth.begin(), a.depth.end()});
    if (there.positions.size() != out.positions.size()) return;  // fans
    for (std::size_t v = 0; v < out.positions.size(); ++v)
      if (const VertexId c = a.control_vertex(out.place(v)); c >= 0 && which(a, c))
        (out.*what)[v] = Vector((there.*what)[v]);
  });
}
// The normals of a crease at a control vertex, one for each face there: each by all of them.
using Normals = std::vector<Vector>;
Change sides(const std::string& name, std::function<Vector(const Normals&, const Vector&)> other) {
  return deliver(name, [other](A a, D out) {
    std::map<VertexId, Normals> all;
    const auto at = [&](std::size_t v) { return a.control_vertex(out.place(v)); };
    for (std::size_t v = 0; v < out.normals.size(); ++v) all[at(v)].push_back(out.normals[v]);
    for (std::size_t v = 0; v < out.normals.size(); ++v)
      if (at(v) >= 0 && a.on_inner_crease(at(v))) out.normals[v] = other(all[at(v)], Vector(out.normals[v]));
  });
}

// So many times what the smooth rule for triangles changes.
Change smooth_rule(const std::string& name, double times) {
  return deliver(name, [times](A a, D out) {
    data::ControlMesh plain = a.mesh;
    plain.sharpness.triangles = data::TriangleRule::kCatmark;
    const Delivered without = a.again(plain, {a.depth.begin(), a.depth.end()});
    for (std::size_t v = 0; v < out.positions.size(); ++v)
      add(out.positions[v], difference(out.positions[v], without.positions[v]), times - 1);
  });
}

}  // namespace

void faults_of_sharp_rules(Rows& to) {
  const auto is_dart = [](A a, VertexId v) { return a.inside(v) && a.infinite[v] == 1; };
  const auto is_held = [](A a, VertexId v) { return lasts(a.held[v]); };
  const auto nothing = [](Tags t) { t = {}; };
  to += smooth_rule("smooth_rule_twice", 2);
  to += smooth_rule("smooth_rule_half", .5);
  // Rules of vertices and edges.
  to += held("crease_as_corner", 2);
  to += held("dart_as_corner", 1);
  to += tags("three_edges_are_a_crease", [](A, Tags t) { lose_edges_beyond(t, 2); });
  to += tags("boundary_not_counted", [](A a, Tags t) {
    std::erase_if(t.edges,
                  [&](const SharpEdge& e) { return lasts(e.sharpness) && a.inside(e.a) != a.inside(e.b); });
  });
  // Sharpness.
  to += ends("below_1_is_smooth", [](float s) { return s < 1 ? 0 : s; });
  to += ends("falls_by_2", [](float s) { return s / 2; });
  to += ends("last_sharp_step_missing", [](float s) { return std::max(0.F, s - 1); });
  to += ends("no_blend", [](float s) { return std::max(s / 2, s - .5F); });
  to += ends("blend_reversed", [](float s) { return s == std::floor(s) ? s : 2 * std::floor(s) + 1 - s; });
  to += beside("blend_by_the_sharpest", data::Creasing::kUniform, [](const Beside& b) {
    return std::max({b.own, b.most[0], b.most[1]});
  });
  to += values("tags_for_one_step", [](A, float s) { return std::min(s, 1.F); });
  to += tags("tags_of_the_lower_end", [](A a, Tags t) {
    for (const reference::Edge& e : a.topology.edges())
      std::erase_if(t.edges, [&](const auto& tag) { return e.a > e.b && same_edge(tag, e.a, e.b); });
  });
  // Chaikin's creasing.
  to += chaikin("chaikin_ends_exchanged", [](const Beside& b) { return b.mean[1] - b.mean[0]; });
  to += chaikin("chaikin_without_clamp", [](const Beside& b) {
    return std::min({0.F, 3 * b.own + b.mean[0] - 4, 3 * b.own + b.mean[1] - 4});
  });
  to += chaikin("chaikin_takes_infinite", [](const Beside& b) { return b.lasting ? 10 - b.own : 0; });
  to += chaikin("chaikin_takes_half", [](const Beside& b) { return b.mean[0] + b.mean[1] - 2 * b.own; });
  to += chaikin("chaikin_by_maximum", [](const Beside& b) {
    return std::max({0.F, b.most[0] - b.mean[0], b.most[1] - b.mean[1]});
  });
  to += chaikin("chaikin_by_sum", [](const Beside& b) {
    return std::max({0.F, b.sum[0] - b.mean[0], b.sum[1] - b.mean[1]});
  });
  // Limits, at control vertices.
  to += limits("dart_limit_smooth", is_dart, nothing);
  to += limits("dart_normal_smooth", is_dart, nothing, &Delivered::normals);
  to += limits("corner_limit_moved", is_held, [](Tags t) { t.vertices.clear(); });
  to += sides("normal_of_the_other_side", [](const Normals& all, const Vector& own) {
    return all.front() == own ? all.back() : all.front();
  });
  to += sides("one_normal_for_all_sides", [](const Normals& all, const Vector&) { return all[0]; });
  to += sides("mean_of_all_sides", [](const Normals& all, const Vector&) {
    Vector sum{};
    for (const Vector& n : all) add(sum, n, 1);
    return unit(sum);
  });
}

}  // namespace limitcheck::verify
