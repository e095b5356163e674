// SPDX-License-Identifier: MIT
// What the tables of faults of channels are written with. Private to them.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "verify/mutants/change_rows.h"

namespace limitcheck::verify::rows {

using Uv = data::Channel&;

/// The one channel of a mesh.
inline const data::Channel& uv_of(A a) {
  return a.mesh.channels.front();
}
inline data::ChannelRule rule_of(A a) {
  return uv_of(a).rule.value_or(data::kUsualChannelRule);
}
/// What these faults are written for: one channel, of two components.
inline bool has_uv(const data::ControlMesh& mesh) {
  return mesh.channels.size() == 1 && mesh.channels[0].components == 2;
}

inline Change of_channels(Change c, std::function<bool(A)> shows = {}) {
  if (c.deliver)
    c.deliver = [what = std::move(c.deliver)](A a, D out) {
      if (out.channel_values.empty() || !has_uv(a.mesh)) nowhere("channel");
      what(a, out);
    };
  if (c.remake)
    c.remake = [what = std::move(c.remake)](A a, Mesh m) {
      if (!has_uv(m)) nowhere("channel");
      what(a, m);
    };
  c.shows = [shows = std::move(shows)](A a) { return has_uv(a.mesh) && (!shows || shows(a)); };
  return c;
}

/// What is delivered for the mesh with something changed, and whether that is another mesh.
inline Delivered again(A a, const std::function<void(Mesh)>& change) {
  data::ControlMesh other = a.mesh;
  change(other);
  return a.again(other, {a.depth.begin(), a.depth.end()});
}
inline bool changes(A a, const std::function<void(Mesh)>& change) {
  data::ControlMesh other = a.mesh;
  change(other);
  return !(other == a.mesh);
}

/// Each corner has the index that `index` says, of the channel as it was, a face and a corner of it.
inline void reindex(
    A a, Uv uv, const std::function<std::int32_t(const data::Channel&, std::size_t, std::size_t)>& index) {
  const data::Channel before = uv;
  const data::Faces& faces = a.mesh.faces;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < faces[f].size(); ++k)
      uv.corners[faces.first_corner(f) + k] = index(before, f, k);
}
/// The index of the first face at the vertex, for all of them.
inline void join_seams(A a, Uv uv, const std::function<bool(std::int32_t)>& at) {
  std::vector<std::int32_t> first(a.mesh.positions.size(), -1);
  reindex(a, uv, [&](const data::Channel& before, std::size_t f, std::size_t k) {
    const std::int32_t v = a.mesh.faces[f][k], own = before.corners[a.mesh.faces.first_corner(f) + k];
    if (!at(v)) return own;
    std::int32_t& known = first[static_cast<std::size_t>(v)];
    return known = known < 0 ? own : known;
  });
}

}  // namespace limitcheck::verify::rows
