// SPDX-License-Identifier: MIT
// A control mesh in the arrays in which subjects get it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

constexpr lc_scheme scheme_of(data::Scheme scheme) {
  return scheme == data::Scheme::kLoop ? LC_SCHEME_LOOP : LC_SCHEME_CATMULL_CLARK;
}
constexpr data::Scheme scheme_of(lc_scheme scheme) {
  return scheme == LC_SCHEME_LOOP ? data::Scheme::kLoop : data::Scheme::kCatmullClark;
}
/// Of all channels together.
inline std::size_t components_of_channels(const lc_mesh& mesh) {
  std::size_t components = 0;
  for (std::int64_t c = 0; c < mesh.channel_count; ++c)
    components += static_cast<std::size_t>(mesh.channels[c].components);
  return components;
}
/// The schemes that capabilities declare.
constexpr bool does(const lc_capabilities& c, data::Scheme scheme) {
  const std::int32_t schemes = c.schemes == 0 ? std::int32_t{LC_DOES_LOOP} : c.schemes;
  return (schemes & (scheme == data::Scheme::kLoop ? LC_DOES_LOOP : LC_DOES_CATMULL_CLARK)) != 0;
}

/// What a subject has to do of sharp edges and vertices, LC_SHARP_..., to subdivide this mesh.
inline std::int32_t sharp_kinds(const data::ControlMesh& mesh, data::Scheme scheme) {
  const data::Sharpness& sharp = mesh.sharpness;
  std::int32_t kinds = 0;
  bool semi_sharp_edge = false;
  for (const data::SharpEdge& e : sharp.edges) {
    if (e.sharpness >= data::kInfiniteSharpness)
      kinds |= LC_SHARP_CREASES;
    else if (e.sharpness > 0)
      kinds |= LC_SHARP_SEMI, semi_sharp_edge = true;
  }
  for (const data::SharpVertex& v : sharp.vertices)
    if (v.sharpness > 0)
      kinds |= LC_SHARP_CORNERS | (v.sharpness < data::kInfiniteSharpness ? LC_SHARP_SEMI : 0);
  if (sharp.boundary == data::Boundary::kEdgeAndCorner) kinds |= LC_SHARP_CORNERS;
  if (sharp.creasing == data::Creasing::kChaikin && semi_sharp_edge) kinds |= LC_SHARP_CHAIKIN;
  if (sharp.triangles == data::TriangleRule::kSmooth && scheme == data::Scheme::kCatmullClark)
    kinds |= LC_SHARP_SMOOTH_TRIANGLES;
  return kinds;
}

/// Whether an edge that stays sharp ends inside the surface: at a vertex with no other, which is not held.
/// The mesh is valid.
inline bool has_darts(const data::ControlMesh& mesh) {
  std::vector<std::int32_t> sharp_edges(mesh.positions.size());
  for (const data::SharpEdge& e : mesh.sharpness.edges)
    if (e.sharpness >= data::kInfiniteSharpness) ++sharp_edges[e.a], ++sharp_edges[e.b];
  for (const data::SharpVertex& v : mesh.sharpness.vertices)
    if (v.sharpness >= data::kInfiniteSharpness) sharp_edges[v.vertex] = 0;
  // Inside each neighbour of a vertex comes once before it and once after it in a face.
  std::vector<std::map<std::int32_t, int>> around(mesh.positions.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t k = 0, n = mesh.faces[f].size(); k < n; ++k) {
      const std::int32_t a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % n];
      if (sharp_edges[a] == 1) ++around[a][b];
      if (sharp_edges[b] == 1) --around[b][a];
    }
  for (std::size_t v = 0; v < around.size(); ++v)
    if (sharp_edges[v] == 1 &&
        std::all_of(around[v].begin(), around[v].end(), [](const auto& entry) { return entry.second == 0; }))
      return true;
  return false;
}

/// Whether capabilities `sharp`, LC_SHARP_..., are enough for all that is sharp in this mesh. It is valid.
inline bool does_sharp(std::int32_t sharp, const data::ControlMesh& mesh, data::Scheme scheme) {
  return (sharp_kinds(mesh, scheme) & ~sharp) == 0 && ((sharp & LC_SHARP_NO_DARTS) == 0 || !has_darts(mesh));
}

/// The mesh that the host handed over, for subjects of our own.
inline data::ControlMesh control_mesh(const lc_mesh& mesh) {
  data::ControlMesh result;
  for (std::int64_t v = 0; v < mesh.vertex_count; ++v) {
    const double* p = mesh.positions + 3 * v;
    result.positions.push_back({p[0], p[1], p[2]});
  }
  const std::int32_t* corner = mesh.corners;
  for (std::int64_t f = 0; f < mesh.face_count; ++f) {
    const auto size = static_cast<std::size_t>(mesh.face_sizes[f]);
    result.faces.push_back(std::span(corner, size));
    corner += size;
  }
  for (std::int64_t k = 0; k < mesh.sharp_edge_count; ++k)
    result.sharpness.edges.push_back(
        {mesh.sharp_edges[k].a, mesh.sharp_edges[k].b, mesh.sharp_edges[k].sharpness});
  for (std::int64_t k = 0; k < mesh.sharp_vertex_count; ++k)
    result.sharpness.vertices.push_back({mesh.sharp_vertices[k].vertex, mesh.sharp_vertices[k].sharpness});
  if (mesh.creasing == LC_CREASING_CHAIKIN) result.sharpness.creasing = data::Creasing::kChaikin;
  if (mesh.corners_held != 0) result.sharpness.boundary = data::Boundary::kEdgeAndCorner;
  if (mesh.smooth_triangles != 0) result.sharpness.triangles = data::TriangleRule::kSmooth;
  for (const lc_channel& c : std::span(mesh.channels, static_cast<std::size_t>(mesh.channel_count)))
    result.channels.push_back(
        {result.channels.empty() ? "uv" : "channel" + std::to_string(result.channels.size()),
         c.components,
         {c.values, c.values + c.components * c.value_count},
         {c.corners, c.corners + mesh.corner_count},
         static_cast<data::ChannelRule>(c.rule)});
  return result;
}

/// A copy, which a subject may write to without spoiling anybody else's.
struct LentMesh {
  std::vector<double> positions;
  std::vector<std::int32_t> corners, face_sizes;
  std::vector<lc_sharp_edge> sharp_edges;
  std::vector<lc_sharp_vertex> sharp_vertices;
  lc_creasing creasing = LC_CREASING_UNIFORM;
  bool corners_held = false, smooth_triangles = false;
  struct LentChannel {
    std::int32_t components = 0;
    lc_channel_rule rule = LC_CHANNEL_NONE;
    std::vector<double> values;
    std::vector<std::int32_t> corners;
  };
  std::vector<LentChannel> channels;
  data::Scheme scheme = data::Scheme::kLoop;

  LentMesh() = default;
  LentMesh(const data::ControlMesh& mesh, data::Scheme of_scheme) : scheme(of_scheme) {
    positions.reserve(3 * mesh.positions.size());
    for (const auto& p : mesh.positions) positions.insert(positions.end(), p.begin(), p.end());
    corners.assign(mesh.faces.corners().begin(), mesh.faces.corners().end());
    face_sizes.reserve(mesh.faces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      face_sizes.push_back(static_cast<std::int32_t>(mesh.faces[f].size()));
    for (const data::SharpEdge& e : mesh.sharpness.edges)
      if (e.sharpness != 0) sharp_edges.push_back({e.a, e.b, e.sharpness});
    for (const data::SharpVertex& v : mesh.sharpness.vertices)
      if (v.sharpness != 0) sharp_vertices.push_back({v.vertex, v.sharpness});
    if (mesh.sharpness.creasing == data::Creasing::kChaikin) creasing = LC_CREASING_CHAIKIN;
    corners_held = mesh.sharpness.boundary == data::Boundary::kEdgeAndCorner;
    smooth_triangles = mesh.sharpness.triangles == data::TriangleRule::kSmooth;
    for (const data::Channel& c : mesh.channels)
      channels.push_back({c.components,
                          static_cast<lc_channel_rule>(c.rule.value_or(data::kUsualChannelRule)), c.values,
                          c.corners});
  }
  /// A copy of a mesh that somebody else lent.
  explicit LentMesh(const lc_mesh& mesh) : LentMesh(control_mesh(mesh), scheme_of(mesh.scheme)) {}

  std::int64_t vertices() const { return static_cast<std::int64_t>(positions.size() / 3); }
  std::int64_t faces() const { return static_cast<std::int64_t>(face_sizes.size()); }

  /// What create() gets: this structure, too, stays as it is as long as the mesh does, or until it is lent
  /// again.
  const lc_mesh& lend() { return lent_ = view(); }

  /// It refers to the arrays, and to what is made anew in each call.
  lc_mesh view() const {
    lent_channels_.clear();
    for (const LentChannel& c : channels)
      lent_channels_.push_back({c.components, c.rule, c.values.data(),
                                static_cast<std::int64_t>(c.values.size()) / c.components, c.corners.data()});
    const bool triangles = std::all_of(face_sizes.begin(), face_sizes.end(), [](auto n) { return n == 3; });
    return {positions.data(),
            vertices(),
            triangles ? corners.data() : nullptr,
            triangles ? faces() : 0,
            sizeof(lc_mesh),
            scheme_of(scheme),
            corners.data(),
            static_cast<std::int64_t>(corners.size()),
            face_sizes.data(),
            faces(),
            sharp_edges.data(),
            static_cast<std::int64_t>(sharp_edges.size()),
            sharp_vertices.data(),
            static_cast<std::int64_t>(sharp_vertices.size()),
            creasing,
            corners_held,
            smooth_triangles,
            lent_channels_.empty() ? nullptr : lent_channels_.data(),
            static_cast<std::int64_t>(lent_channels_.size())};
  }

  /// By bytes: what a subject writes may be a NaN.
  friend bool operator==(const LentMesh& a, const LentMesh& b) {
    const auto same = [](const auto& x, const auto& y) {
      return x.size() == y.size() &&
             (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0);
    };
    return same(a.positions, b.positions) && same(a.corners, b.corners) && same(a.face_sizes, b.face_sizes) &&
           same(a.sharp_edges, b.sharp_edges) && same(a.sharp_vertices, b.sharp_vertices) &&
           std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), b.channels.end(),
                      [&](const LentChannel& c, const LentChannel& d) {
                        return same(c.values, d.values) && same(c.corners, d.corners);
                      });
  }

 private:
  lc_mesh lent_{};
  mutable std::vector<lc_channel> lent_channels_;
};

}  // namespace limitcheck::verify
