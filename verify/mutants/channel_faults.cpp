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
Change channel(const std::string& name, std::function<void(A, Uv)> what) {
  const auto change = [what](A a) { return [what, &a](Mesh m) { what(a, m.channels.front()); }; };
  return of_channels(remake(name, [change](A a, Mesh m) { change(a)(m); }),
                     [change](A a) { return changes(a, change(a)); });
}
// With other indices.
Change indices(const std::string& name,
               std::function<std::int32_t(A, const Channel&, std::size_t face, std::size_t corner)> index) {
  return channel(name, [index](A a, Uv uv) {
    reindex(a, uv,
            [&](const Channel& before, std::size_t f, std::size_t k) { return index(a, before, f, k); });
  });
}
// With one value at each of some vertices.
Change joined(const std::string& name, std::function<bool(A, std::int32_t)> at) {
  return channel(name, [at](A a, Uv uv) { join_seams(a, uv, [&](std::int32_t v) { return at(a, v); }); });
}
// With other values: two components each.
Change values_of(const std::string& name, std::function<void(double&, double&)> what) {
  return channel(name, [what](A, Uv uv) {
    for (std::size_t i = 0; i + 1 < uv.values.size(); i += 2) what(uv.values[i], uv.values[i + 1]);
  });
}

// The channel as it were with other tags; the surface keeps its own.
Change tags_of_channel(const std::string& name, std::function<void(Tags)> what) {
  const auto change = [what](Mesh m) { what(m.sharpness); };
  return of_channels(
      deliver(name, [change](A a, D out) { out.channel_values = again(a, change).channel_values; }),
      [change](A a) { return changes(a, change) && rule_of(a) < ChannelRule::kBoundaries; });
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
Change on_faces(const std::string& name, ChannelRule rule, std::function<bool(A, std::size_t)> some) {
  const auto replace = [=](A a, D out) {
    const Delivered by_rule = again(a, [&](Mesh m) { m.channels.front().rule = rule; });
    for (std::size_t t = 0; t < out.triangles.size(); ++t)
      if (some(a, static_cast<std::size_t>(out.triangle_face[t])))
        std::copy_n(&by_rule.channel_values[6 * t], 6, &out.channel_values[6 * t]);
  };
  return of_channels(deliver(name, replace), [rule](A a) { return rule_of(a) != rule; });
}
// On the faces at some vertices.
Change on_faces_at(const std::string& name, ChannelRule rule, std::function<bool(A, std::int32_t)> some) {
  return on_faces(name, rule, [some](A a, std::size_t f) {
    const auto corners = a.mesh.faces[f];
    return std::any_of(corners.begin(), corners.end(), [&](std::int32_t v) { return some(a, v); });
  });
}

// The values delivered: two numbers for each corner of each triangle.
Change delivered_values(const std::string& name, std::function<void(std::vector<double>&)> what) {
  return of_channels(deliver(name, [what](A, D out) { what(out.channel_values); }));
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

void by_rules(Rows& to) {
  for (std::size_t k = 0; k < std::size(data::kChannelRules); ++k) {
    std::string word(data::kChannelRules[k]);
    std::replace(word.begin(), word.end(), '-', '_');
    to += channel("channel_always_" + word, [k](A, Uv uv) { uv.rule = static_cast<ChannelRule>(k); });
  }
  to += channel("channel_next_rule", [](A a, Uv uv) {
    uv.rule = static_cast<ChannelRule>((static_cast<int>(rule_of(a)) + 1) % 6);
  });
}

void by_indices(Rows& to) {
  to += joined("channel_by_vertex", [](A, std::int32_t) { return true; });
  to += joined("channel_joined_inside", [](A a, std::int32_t v) { return a.inside(v); });
  to += joined("channel_joined_on_boundary", on_boundary);
  to += joined("channel_joined_at_regular_vertices", is_regular);
  to += channel("channel_by_corner", [](A, Uv uv) {
    Channel apart{uv.name, 2, {}, {}, uv.rule};
    for (std::size_t c = 0; c < uv.corners.size(); ++c) {
      apart.values.insert(apart.values.end(), {uv.at(c, 0), uv.at(c, 1)});
      apart.corners.push_back(static_cast<std::int32_t>(c));
    }
    uv = apart;
  });
  to += channel("channel_parted_values", part_values);
  to += indices("channel_index_of_next_corner", [](A a, const Channel& uv, std::size_t f, std::size_t k) {
    return uv.corners[a.mesh.faces.first_corner(f) + (k + 1) % a.mesh.faces[f].size()];
  });
  to += indices("channel_index_of_last_face", [](A a, const Channel& uv, std::size_t f, std::size_t k) {
    const std::size_t first = a.mesh.faces.first_corner(f);
    return uv.corners[f + 1 == a.mesh.faces.size() ? first : first + k];
  });
  to += indices("channel_number_of_vertex", [](A a, const Channel& uv, std::size_t f, std::size_t k) {
    return a.mesh.faces[f][k] % static_cast<std::int32_t>(uv.values.size() / 2);
  });
  to += channel("channel_index_of_a_byte", [](A, Uv uv) {
    for (auto& i : uv.corners) i %= 64;
  });
  to += indices("channel_chart_of_next_face", [](A a, const Channel& uv, std::size_t f, std::size_t k) {
    const std::int32_t v = a.mesh.faces[f][k];
    const auto faces = a.topology.sector(v).faces;
    const auto at = static_cast<std::size_t>(a.topology.ring_index(f, k));
    return uv.corners[corner_of(a, faces[(at + faces.size() - 1) % faces.size()], v)];
  });
}

void by_values(Rows& to) {
  using All = std::vector<double>&;
  to += values_of("channel_first_component", [](double&, double& v) { v = 0; });
  to += values_of("channel_swapped_components", [](double& u, double& v) { std::swap(u, v); });
  to += values_of("channel_upside_down", [](double&, double& v) { v = 1 - v; });
  to += values_of("channel_wrapped", [](double& u, double& v) { u -= std::floor(u), v -= std::floor(v); });
  to += values_of("channel_clamped",
                  [](double& u, double& v) { u = std::clamp(u, 0., 1.), v = std::clamp(v, 0., 1.); });
  to += values_of("channel_of_a_byte",
                  [](double& u, double& v) { u = std::round(u * 255) / 255, v = std::round(v * 255) / 255; });
  to += delivered_values("channel_nan",
                         [](All all) { all[all.size() / 2] = std::numeric_limits<double>::quiet_NaN(); });
  to += delivered_values("channel_infinite",
                         [](All all) { all.back() = std::numeric_limits<double>::infinity(); });
  to +=
      delivered_values("channel_unwritten", [](All all) { std::memset(&all.back(), 0xFF, sizeof(double)); });
  to += delivered_values("channel_moved_value", [](All all) { all[0] += 1e-3; });
  to += delivered_values("channel_turned_corners", [](All all) {
    for (std::size_t t = 0; t + 6 <= all.size(); t += 6) std::rotate(&all[t], &all[t + 2], &all[t] + 6);
  });
  to += delivered_values("channel_of_next_triangle",
                         [](All all) { std::rotate(all.begin(), all.begin() + 6, all.end()); });
  to += delivered_values("channel_by_component", [](All all) {
    const std::vector<double> before = all;
    for (std::size_t i = 0; i < all.size(); i += 2) {
      all[i / 2] = before[i];
      all[(all.size() + i) / 2] = before[i + 1];
    }
  });
  to += of_channels(deliver("channel_ulp", [](A, D out) {
    // A vertex of one face that two triangles have is one point on one side.
    std::map<std::uint32_t, std::size_t> first;
    for (std::size_t c = 0; c < 3 * out.triangles.size(); ++c)
      if (!first.try_emplace(out.triangles[c / 3][c % 3], c).second) {
        out.channel_values[2 * c] = out.one_ulp_up(out.channel_values[2 * c]);
        return;
      }
    nowhere("value that triangles share");
  }));
  to += of_channels(deliver("channel_missing", [](A, D out) { out.channel_values.clear(); }));
}

// Two channels, the second of four components.
bool has_two(const data::ControlMesh& mesh) {
  return mesh.channels.size() == 2 && mesh.channels[1].components == 4;
}
Change channels(const std::string& name, std::function<void(Mesh)> what) {
  Change c = remake(name, [what](A a, Mesh m) {
    if (!has_two(a.mesh)) nowhere("second channel of four components");
    what(m);
  });
  c.shows = [what](A a) { return has_two(a.mesh) && changes(a, what); };
  return c;
}
void by_several(Rows& to) {
  to += channels("channels_have_one_rule", [](Mesh m) { m.channels[1].rule = m.channels[0].rule; });
  to += channels("channels_have_the_last_rule", [](Mesh m) { m.channels[0].rule = m.channels[1].rule; });
  to += channels("channels_have_the_seams_of_one", [](Mesh m) {
    const auto count = static_cast<std::int32_t>(m.channels[1].values.size() / 4);
    m.channels[1].corners = m.channels[0].corners;
    for (std::int32_t& i : m.channels[1].corners) i %= count;
  });
  to += channels("channels_have_two_components", [](Mesh m) {
    for (std::size_t i = 0; i < m.channels[1].values.size(); i += 4)
      m.channels[1].values[i + 2] = m.channels[1].values[i + 3] = 0;
  });
  to += channels("channels_are_opaque", [](Mesh m) {
    for (std::size_t i = 3; i < m.channels[1].values.size(); i += 4) m.channels[1].values[i] = 1;
  });
  to += channels("channels_are_linear_but_the_first", [](Mesh m) { m.channels[1].rule = ChannelRule::kAll; });
}

// What is remembered of an earlier mesh, or depends on the request.
void by_requests(Rows& to) {
  const auto forgets = [](const std::string& name, std::function<void(Uv)> what) {
    return of_channels(with(row(name), &Change::forget, [what](Mesh m) {
      for (Channel& c : m.channels) what(c);
    }));
  };
  const auto request = [](const std::string& name, std::function<bool(A)> when) {
    return of_channels(deliver(name, [when](A a, D out) {
      if (when(a)) out.channel_values.back() += 1e-3;
    }));
  };
  to += forgets("channel_remembers_values", [](Uv uv) { std::fill(uv.values.begin(), uv.values.end(), 0); });
  to +=
      forgets("channel_remembers_indices", [](Uv uv) { std::fill(uv.corners.begin(), uv.corners.end(), 0); });
  to += forgets("channel_remembers_its_rule", [](Uv uv) { uv.rule = ChannelRule::kNone; });
  to += request("channel_by_threads", [](A a) { return a.threads > 1; });
  to += request("channel_by_request", [](A a) { return a.call > 1; });
}

void by_places(Rows& to) {
  using enum ChannelRule;
  to += on_faces_at("channel_linear_at_extraordinary", kAll,
                    [](A a, std::int32_t v) { return a.inside(v) && !is_regular(a, v); });
  to += on_faces_at("channel_linear_on_boundary", kAll, on_boundary);
  to += on_faces_at("channel_linear_at_seams", kAll, seam_at);
  to += on_faces("channel_linear_last_face", kAll,
                 [](A a, std::size_t f) { return f + 1 == a.mesh.faces.size(); });
  to += on_faces_at("channel_smooth_at_seams", kNone, seam_at);
  to += on_faces_at("channel_held_on_boundary", kBoundaries, on_boundary);
  to += on_faces("channel_linear_polygons", kAll, [](A a, std::size_t f) { return a.is_polygon(f); });
  to +=
      of_channels(deliver("channel_chaikin_in_the_cut",
                          [](A a, D out) {
                            const Delivered cut = a.again(forgetful_cut(a), {a.depth.begin(), a.depth.end()});
                            for (std::size_t c = 0; c < 3 * out.triangles.size(); ++c)
                              std::copy_n(cut.positions[cut.triangles[c / 3][c % 3]].begin(), 2,
                                          &out.channel_values[2 * c]);
                          }),
                  has_sharpness_across_seams);
  to += tags_of_channel("channel_without_tags", [](Tags t) { t = {}; });
  to += tags_of_channel("channel_without_sharp_vertices", [](Tags t) { t.vertices.clear(); });
  to += tags_of_channel("channel_without_sharp_edges", [](Tags t) { t.edges.clear(); });
  to += tags_of_channel("channel_without_held_corners", [](Tags t) { t.boundary = data::Boundary::kEdge; });
  to += tags_of_channel("channel_infinite_tags",
                        [](Tags t) { each_sharpness(t, [](float) { return data::kInfiniteSharpness; }); });
  to += tags_of_channel("channel_whole_sharpness",
                        [](Tags t) { each_sharpness(t, [](float s) { return std::floor(s); }); });
}

}  // namespace

void faults_of_channels(Rows& to) {
  for (const auto& add_to : {by_rules, by_indices, by_values, by_several, by_requests, by_places}) add_to(to);
}

}  // namespace limitcheck::verify
