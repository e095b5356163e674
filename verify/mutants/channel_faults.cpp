// SPDX-License-Identifier: MIT
// Faults of face-varying channels, planted in a subject that interpolates them.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <utility>

#include "reference/channel/channel_mesh.h"
#include "reference/surface/channel.h"
#include "verify/mutants/channel_rows.h"

namespace limitcheck::verify {

using namespace rows;

namespace {

using data::Channel, data::ChannelRule;

// Another channel of the same surface. Shows where it is another one.
Change channel(std::string name, std::string description, std::function<void(A, Uv)> what) {
  const auto change = [what](A a) { return [what, &a](Mesh m) { what(a, m.channels.front()); }; };
  return of_channels(remake(std::move(name), std::move(description), "channel-positions",
                            [change](A a, Mesh m) { change(a)(m); }),
                     [change](A a) { return changes(a, change(a)); });
}
// With other indices.
Change indices(const char* name, const char* description,
               std::function<std::int32_t(A, const Channel&, std::size_t face, std::size_t corner)> index) {
  return channel(name, description, [index](A a, Uv uv) {
    reindex(a, uv,
            [&](const Channel& before, std::size_t f, std::size_t k) { return index(a, before, f, k); });
  });
}
// With one value at each of some vertices.
Change joined(const char* name, const char* description, std::function<bool(A, std::int32_t)> at) {
  return channel(name, description,
                 [at](A a, Uv uv) { join_seams(a, uv, [&](std::int32_t v) { return at(a, v); }); });
}
// With other values: two components each.
Change values_of(const char* name, const char* description, std::function<void(double&, double&)> what) {
  return channel(name, description, [what](A, Uv uv) {
    for (std::size_t i = 0; i + 1 < uv.values.size(); i += 2) what(uv.values[i], uv.values[i + 1]);
  });
}

// The channel as it were with other tags; the surface keeps its own.
Change tags_of_channel(const char* name, const char* description, std::function<void(Tags)> what) {
  const auto change = [what](Mesh m) { what(m.sharpness); };
  return sharp(
      of_channels(deliver(name, description, "channel-positions",
                          [change](A a, D out) { out.channel_values = again(a, change).channel_values; }),
                  [change](A a) { return changes(a, change) && rule_of(a) < ChannelRule::kBoundaries; }));
}

// The mesh that is cut along the seams, which does not know what edges its vertices had beyond them.
data::ControlMesh forgetful_cut(A a) {
  const Channel& uv = uv_of(a);
  const reference::ChannelTopology whole(a.topology, a.mesh.sharpness, uv.corners, rule_of(a));
  const reference::ChannelCut cut = reference::cut_and_hold(whole, a.mesh.sharpness.triangles);
  data::ControlMesh mesh{.faces = cut.faces};
  for (const std::size_t c : cut.corner_of) mesh.positions.push_back({uv.at(c, 0), uv.at(c, 1), 0});
  for (const auto& e : cut.tags.edges)
    mesh.sharpness.edges.push_back({e.a, e.b, static_cast<float>(e.sharpness.as_double())});
  for (const auto& v : cut.tags.vertices)
    mesh.sharpness.vertices.push_back({v.vertex, static_cast<float>(v.sharpness.as_double())});
  mesh.sharpness.creasing = a.mesh.sharpness.creasing;
  mesh.sharpness.triangles = a.mesh.sharpness.triangles;
  return mesh;
}
// Whether that changes a sharpness, and nothing else: by Chaikin's creasing, where the edges beyond hold no dependent value,
// and one of another sharpness ends at the same vertex inside the run.
bool has_sharpness_across_seams(A a) {
  if (a.mesh.sharpness.creasing != data::Creasing::kChaikin || rule_of(a) >= ChannelRule::kBoundaries)
    return false;
  const reference::ChannelTopology whole(a.topology, a.mesh.sharpness, uv_of(a).corners, rule_of(a));
  const auto tags = reference::cut_and_hold(whole, a.mesh.sharpness.triangles).tags;
  const auto ends_there = [&](const auto& beyond) {
    return std::any_of(tags.edges.begin(), tags.edges.end(), [&](const auto& e) {
      return (e.a == beyond.vertex || e.b == beyond.vertex) &&
             e.sharpness.as_double() != beyond.sharpness.as_double();
    });
  };
  return std::none_of(tags.beyond.begin(), tags.beyond.end(), [](const auto& b) { return b.holds; }) &&
         std::any_of(tags.beyond.begin(), tags.beyond.end(), ends_there);
}

// The channel by another rule on some faces of the control mesh.
Change on_faces(const char* name, const char* description, ChannelRule rule,
                std::function<bool(A, std::size_t)> some) {
  return of_channels(deliver(name, description, "channel-positions",
                             [=](A a, D out) {
                               const Delivered by_rule =
                                   again(a, [&](Mesh m) { m.channels.front().rule = rule; });
                               for (std::size_t t = 0; t < out.triangles.size(); ++t)
                                 if (some(a, static_cast<std::size_t>(out.triangle_face[t])))
                                   std::copy_n(&by_rule.channel_values[6 * t], 6, &out.channel_values[6 * t]);
                             }),
                     [rule](A a) { return rule_of(a) != rule && a.deepest > 0; });
}
// On the faces at some vertices.
Change on_faces_at(const char* name, const char* description, ChannelRule rule,
                   std::function<bool(A, std::int32_t)> some) {
  return on_faces(name, description, rule, [some](A a, std::size_t f) {
    const auto corners = a.mesh.faces[f];
    return std::any_of(corners.begin(), corners.end(), [&](std::int32_t v) { return some(a, v); });
  });
}

// The values delivered: two numbers for each corner of each triangle.
Change delivered_values(const char* name, const char* description, const char* check,
                        std::function<void(std::vector<double>&)> what) {
  return of_channels(deliver(name, description, check, [what](A, D out) { what(out.channel_values); }));
}

// The number of the face's corner at a vertex.
std::size_t corner_of(A a, std::int32_t face, std::int32_t v) {
  const auto corners = a.mesh.faces[static_cast<std::size_t>(face)];
  const auto at = std::find(corners.begin(), corners.end(), v) - corners.begin();
  return a.mesh.faces.first_corner(static_cast<std::size_t>(face)) + static_cast<std::size_t>(at);
}
bool seam_at(A a, std::int32_t v) {
  const auto faces = a.topology.sector(v).faces;
  const auto index = [&](std::int32_t f) { return uv_of(a).corners[corner_of(a, f, v)]; };
  return std::any_of(faces.begin(), faces.end(), [&](std::int32_t f) { return index(f) != index(faces[0]); });
}
bool on_boundary(A a, std::int32_t v) {
  return !a.inside(v);
}
bool is_regular(A a, std::int32_t v) {
  return a.faces(v) == (a.scheme == data::Scheme::kLoop ? 6 : 4);
}

// A value of its own for each run of a value that has several.
void part_values(A a, Uv uv) {
  const reference::ChannelTopology channel(a.topology, a.mesh.sharpness, uv.corners, ChannelRule::kNone);
  const Channel before = uv;
  for (std::size_t v = 0; v < a.mesh.positions.size(); ++v) {
    const auto sector = a.topology.sector(static_cast<std::int32_t>(v));
    std::set<std::int32_t> known;
    if (sector.faces.empty()) continue;
    for (const reference::Run& run : channel.runs(static_cast<std::int32_t>(v))) {
      const std::size_t first = channel.corner(channel.face(sector, run, 0), static_cast<std::int32_t>(v));
      if (known.insert(before.corners[first]).second) continue;
      const auto copy = static_cast<std::int32_t>(uv.values.size() / 2);
      uv.values.insert(uv.values.end(), {before.at(first, 0), before.at(first, 1)});
      for (std::size_t i = 0; i < run.count; ++i)
        uv.corners[channel.corner(channel.face(sector, run, i), static_cast<std::int32_t>(v))] = copy;
    }
  }
}

std::vector<Change> by_rules() {
  std::vector<Change> all;
  for (std::size_t k = 0; k < std::size(data::kChannelRules); ++k) {
    std::string word(data::kChannelRules[k]);
    std::replace(word.begin(), word.end(), '-', '_');
    all.push_back(
        channel("channel_always_" + word,
                "channels have the rule " + std::string(data::kChannelRules[k]) + ", whatever was asked for",
                [k](A, Uv uv) { uv.rule = static_cast<ChannelRule>(k); }));
  }
  all.push_back(channel("channel_next_rule", "each rule is taken for the next", [](A a, Uv uv) {
    uv.rule = static_cast<ChannelRule>((static_cast<int>(rule_of(a)) + 1) % 6);
  }));
  return all;
}

std::vector<Change> by_indices() {
  return {
      joined("channel_by_vertex", "one value for each vertex: smooth across seams",
             [](A, std::int32_t) { return true; }),
      joined("channel_joined_inside", "one value for each vertex inside the surface",
             [](A a, std::int32_t v) { return a.inside(v); }),
      joined("channel_joined_on_boundary", "one value for each vertex on the boundary", on_boundary),
      joined("channel_joined_at_regular_vertices", "one value for each regular vertex", is_regular),
      channel("channel_by_corner", "a value for each corner: every edge is a seam",
              [](A, Uv uv) {
                Channel apart{uv.name, 2, {}, {}, uv.rule};
                for (std::size_t c = 0; c < uv.corners.size(); ++c) {
                  apart.values.insert(apart.values.end(), {uv.at(c, 0), uv.at(c, 1)});
                  apart.corners.push_back(static_cast<std::int32_t>(c));
                }
                uv = apart;
              }),
      channel("channel_parted_values", "a value that meets itself at a vertex alone is several", part_values),
      indices("channel_index_of_next_corner", "indices are those of the next corner of the face",
              [](A a, const Channel& uv, std::size_t f, std::size_t k) {
                return uv.corners[a.mesh.faces.first_corner(f) + (k + 1) % a.mesh.faces[f].size()];
              }),
      indices("channel_index_of_last_face", "the last face has the indices of the first corner alone",
              [](A a, const Channel& uv, std::size_t f, std::size_t k) {
                const std::size_t first = a.mesh.faces.first_corner(f);
                return uv.corners[f + 1 == a.mesh.faces.size() ? first : first + k];
              }),
      indices("channel_number_of_vertex", "values are looked up by the number of the vertex",
              [](A a, const Channel& uv, std::size_t f, std::size_t k) {
                return a.mesh.faces[f][k] % static_cast<std::int32_t>(uv.values.size() / 2);
              }),
      channel("channel_index_of_a_byte", "indices have a byte",
              [](A, Uv uv) {
                for (auto& i : uv.corners) i %= 64;
              }),
      indices("channel_chart_of_next_face", "at a vertex a face has the value of the face before it",
              [](A a, const Channel& uv, std::size_t f, std::size_t k) {
                const std::int32_t v = a.mesh.faces[f][k];
                const auto faces = a.topology.sector(v).faces;
                const auto at = static_cast<std::size_t>(a.topology.ring_index(f, k));
                return uv.corners[corner_of(a, faces[(at + faces.size() - 1) % faces.size()], v)];
              }),
  };
}

std::vector<Change> by_values() {
  using All = std::vector<double>&;
  return {
      values_of("channel_first_component", "the second component is 0", [](double&, double& v) { v = 0; }),
      values_of("channel_swapped_components", "the components are exchanged",
                [](double& u, double& v) { std::swap(u, v); }),
      values_of("channel_upside_down", "the second component is counted from the top",
                [](double&, double& v) { v = 1 - v; }),
      values_of("channel_wrapped", "values are wrapped into 0 to 1",
                [](double& u, double& v) { u -= std::floor(u), v -= std::floor(v); }),
      values_of("channel_clamped", "values are clamped to 0 to 1",
                [](double& u, double& v) { u = std::clamp(u, 0., 1.), v = std::clamp(v, 0., 1.); }),
      values_of("channel_of_a_byte", "values have eight bits",
                [](double& u, double& v) { u = std::round(u * 255) / 255, v = std::round(v * 255) / 255; }),
      delivered_values("channel_nan", "one value is NaN", "finite",
                       [](All all) { all[all.size() / 2] = std::numeric_limits<double>::quiet_NaN(); }),
      delivered_values("channel_infinite", "one value is infinite", "finite",
                       [](All all) { all.back() = std::numeric_limits<double>::infinity(); }),
      delivered_values("channel_unwritten", "the last value is not written", "written",
                       [](All all) { std::memset(&all.back(), 0xFF, sizeof(double)); }),
      delivered_values("channel_moved_value", "one value is off by a thousandth", "channel-positions",
                       [](All all) { all[0] += 1e-3; }),
      delivered_values("channel_turned_corners", "the corners of each triangle have the values of the next",
                       "channel-positions",
                       [](All all) {
                         for (std::size_t t = 0; t + 6 <= all.size(); t += 6)
                           std::rotate(&all[t], &all[t + 2], &all[t] + 6);
                       }),
      delivered_values("channel_of_next_triangle", "each triangle has the values of the next",
                       "channel-positions",
                       [](All all) { std::rotate(all.begin(), all.begin() + 6, all.end()); }),
      delivered_values("channel_by_component", "all first components come first", "channel-positions",
                       [](All all) {
                         const std::vector<double> before = all;
                         for (std::size_t i = 0; i < all.size(); i += 2) {
                           all[i / 2] = before[i];
                           all[(all.size() + i) / 2] = before[i + 1];
                         }
                       }),
      of_channels(deliver("channel_ulp", "a value that triangles share is one ulp off in one of them",
                          "channel-shared",
                          [](A, D out) {
                            // A vertex of one face that two triangles have is one point on one side.
                            std::map<std::uint32_t, std::size_t> first;
                            for (std::size_t c = 0; c < 3 * out.triangles.size(); ++c)
                              if (!first.try_emplace(out.triangles[c / 3][c % 3], c).second) {
                                out.channel_values[2 * c] = out.one_ulp_up(out.channel_values[2 * c]);
                                return;
                              }
                            nowhere("value that triangles share");
                          }),
                  [](A a) { return a.deepest > 0; }),
      of_channels(deliver("channel_missing", "no values are delivered", "written",
                          [](A, D out) { out.channel_values.clear(); })),
  };
}

// Two channels, the second of four components.
bool has_two(const data::ControlMesh& mesh) {
  return mesh.channels.size() == 2 && mesh.channels[1].components == 4;
}
Change channels(const char* name, const char* description, std::function<void(Mesh)> what) {
  Change c = remake(name, description, "channel-positions", [what](A a, Mesh m) {
    if (!has_two(a.mesh)) nowhere("second channel of four components");
    what(m);
  });
  c.on = Change::On::kBoth;
  c.shows = [what](A a) { return has_two(a.mesh) && changes(a, what); };
  return c;
}
std::vector<Change> by_several() {
  return {
      channels("channels_have_one_rule", "all channels have the rule of the first",
               [](Mesh m) { m.channels[1].rule = m.channels[0].rule; }),
      channels("channels_have_the_last_rule", "all channels have the rule of the last",
               [](Mesh m) { m.channels[0].rule = m.channels[1].rule; }),
      channels("channels_have_the_seams_of_one", "all channels have the indices of the first",
               [](Mesh m) {
                 const auto count = static_cast<std::int32_t>(m.channels[1].values.size() / 4);
                 m.channels[1].corners = m.channels[0].corners;
                 for (std::int32_t& i : m.channels[1].corners) i %= count;
               }),
      channels("channels_have_two_components", "beyond the second all components are 0",
               [](Mesh m) {
                 for (std::size_t i = 0; i < m.channels[1].values.size(); i += 4)
                   m.channels[1].values[i + 2] = m.channels[1].values[i + 3] = 0;
               }),
      channels("channels_are_opaque", "of four components the last is 1",
               [](Mesh m) {
                 for (std::size_t i = 3; i < m.channels[1].values.size(); i += 4) m.channels[1].values[i] = 1;
               }),
      channels("channels_are_linear_but_the_first", "channels behind the first have the rule all",
               [](Mesh m) { m.channels[1].rule = ChannelRule::kAll; }),
  };
}

// What is remembered of an earlier mesh, or depends on the request.
std::vector<Change> by_requests() {
  const auto forgets = [](const char* name, const char* description, std::function<void(Uv)> what) {
    return of_channels(with(row(name, description, "state"), &Change::forget, [what](Mesh m) {
      for (Channel& c : m.channels) what(c);
    }));
  };
  const auto request = [](const char* name, const char* description, std::function<bool(A)> when) {
    return of_channels(deliver(name, description, "determinism", [when](A a, D out) {
      if (when(a)) out.channel_values.back() += 1e-3;
    }));
  };
  return {
      forgets("channel_remembers_values", "the values are those of an earlier mesh with the same indices",
              [](Uv uv) { std::fill(uv.values.begin(), uv.values.end(), 0); }),
      forgets("channel_remembers_indices", "the indices are those of an earlier mesh with the same values",
              [](Uv uv) { std::fill(uv.corners.begin(), uv.corners.end(), 0); }),
      forgets("channel_remembers_its_rule", "the rule is that of an earlier mesh with the same channel",
              [](Uv uv) { uv.rule = ChannelRule::kNone; }),
      request("channel_by_threads", "a value depends on the number of threads",
              [](A a) { return a.threads > 1; }),
      request("channel_by_request", "a value is another from the second request on",
              [](A a) { return a.call > 1; }),
  };
}

std::vector<Change> by_places() {
  using enum ChannelRule;
  return {
      on_faces_at("channel_linear_at_extraordinary", "faces at extraordinary vertices are linear", kAll,
                  [](A a, std::int32_t v) { return a.inside(v) && !is_regular(a, v); }),
      on_faces_at("channel_linear_on_boundary", "faces on the boundary are linear", kAll, on_boundary),
      on_faces_at("channel_linear_at_seams", "faces at seams are linear", kAll, seam_at),
      on_faces("channel_linear_last_face", "the last face is linear", kAll,
               [](A a, std::size_t f) { return f + 1 == a.mesh.faces.size(); }),
      on_faces_at("channel_smooth_at_seams", "seams are smooth at faces beside them, whatever was asked for",
                  kNone, seam_at),
      on_faces_at("channel_held_on_boundary", "boundaries are held where they are not", kBoundaries,
                  on_boundary),
      on(Change::On::kQuads, on_faces("channel_linear_polygons", "faces that are no quads are linear", kAll,
                                      [](A a, std::size_t f) { return a.is_polygon(f); })),
      sharp(of_channels(
          deliver("channel_chaikin_in_the_cut",
                  "by Chaikin's creasing sharpness falls in the mesh that is cut", "channel-positions",
                  [](A a, D out) {
                    const Delivered cut = a.again(forgetful_cut(a), {a.depth.begin(), a.depth.end()});
                    for (std::size_t c = 0; c < 3 * out.triangles.size(); ++c)
                      std::copy_n(cut.positions[cut.triangles[c / 3][c % 3]].begin(), 2,
                                  &out.channel_values[2 * c]);
                  }),
          [](A a) { return a.deepest > 0 && has_sharpness_across_seams(a); })),
      tags_of_channel("channel_without_tags", "channels know no sharp edges and vertices",
                      [](Tags t) { t = {}; }),
      tags_of_channel("channel_without_sharp_vertices", "channels know no sharp vertices",
                      [](Tags t) { t.vertices.clear(); }),
      tags_of_channel("channel_without_sharp_edges", "channels know no sharp edges",
                      [](Tags t) { t.edges.clear(); }),
      tags_of_channel("channel_without_held_corners", "channels do not hold boundary vertices of one face",
                      [](Tags t) { t.boundary = data::Boundary::kEdge; }),
      tags_of_channel("channel_infinite_tags", "what is sharp is sharp for ever in channels",
                      [](Tags t) {
                        for (auto& e : t.edges) e.sharpness = e.sharpness > 0 ? 10.F : 0.F;
                        for (auto& v : t.vertices) v.sharpness = v.sharpness > 0 ? 10.F : 0.F;
                      }),
      tags_of_channel("channel_whole_sharpness", "channels leave out fractions of a sharpness",
                      [](Tags t) {
                        for (auto& e : t.edges) e.sharpness = std::floor(e.sharpness);
                        for (auto& v : t.vertices) v.sharpness = std::floor(v.sharpness);
                        std::erase_if(t.edges, [](const auto& e) { return e.sharpness == 0; });
                        std::erase_if(t.vertices, [](const auto& v) { return v.sharpness == 0; });
                      }),
  };
}

}  // namespace

std::vector<Change> faults_of_channels() {
  std::vector<Change> all;
  for (auto& list : {by_rules(), by_indices(), by_values(), by_several(), by_requests(), by_places()})
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace limitcheck::verify
