// SPDX-License-Identifier: MIT
// Names of points by where they lie, the same from every face that touches a point; and what the reference says of
// them. For tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "data/bounding_box.h"
#include "data/generators/named_mesh.h"
#include "reference/catmull_clark/refined_mesh.h"
#include "reference/loop/refine.h"
#include "verify/evidence/vector.h"
#include "verify/host/host.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify::test {

/// Every interior valence class, every boundary situation, faces whose corners are all irregular.
inline std::vector<std::pair<std::string, data::ControlMesh>> shapes() {
  std::vector<std::pair<std::string, data::ControlMesh>> result;
  for (const char* name : {"tetrahedron", "octahedron", "triangle", "strip:6", "wheel:3:1", "wheel:7:2",
                           "fan:5:1", "fan:8:2", "ragged-disc", "holes", "two-components", "bumpy:200"}) {
    result.emplace_back(name, data::named_mesh(name));
  }
  return result;
}

/// (kind, a, b, c, d): control vertex a; or on edge a < b, c / d from a; or in face a at (b, c) / d.
using PointName = std::tuple<int, std::int64_t, std::int64_t, std::int64_t, std::int64_t>;

inline PointName place(const data::ControlMesh& mesh, const lc_provenance& p) {
  const auto& corners = triangles_of(mesh)[p.face];
  const auto at = FaceDomain::triangle().side_of(point_of(p), p.denominator);
  if (!at) return {2, p.face, p.i, p.j, p.denominator};
  const auto a = corners[at->side], b = corners[FaceDomain::triangle().next(at->side)];
  if (at->along == 0) return {0, a, 0, 0, 0};
  return a < b ? PointName{1, a, b, at->along, p.denominator}
               : PointName{1, b, a, p.denominator - at->along, p.denominator};
}

/// Every place and the vertices that lie there.
inline std::map<PointName, std::vector<std::int64_t>> places(const data::ControlMesh& mesh,
                                                             const Tessellation& t) {
  std::map<PointName, std::vector<std::int64_t>> result;
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
    result[place(mesh, t.provenance()[v])].push_back(v);
  }
  return result;
}

/// The reference's values and names at one depth: each point of the mesh is a vertex of the refined one.
template <data::Scheme scheme>
class Expected {
 public:
  Expected(const data::ControlMesh& mesh, int depth) : mesh_(mesh), refined_(begin(mesh)) {
    for (int step = 0; step < depth; ++step) refined_.refine();
    limits_ = refined_.limits();
  }
  const auto& refined() const { return refined_; }
  FaceDomain domain(std::int32_t face) const {
    return {scheme, static_cast<int>(mesh_.faces[static_cast<std::size_t>(face)].size())};
  }
  std::int64_t steps() const { return std::int64_t{1} << refined_.depth(); }
  /// At a point of a face in so many steps to a side.
  std::int32_t vertex(std::int32_t face, FaceDomain::Point p, std::int64_t steps_of_face) const {
    const auto f = static_cast<std::size_t>(face);
    if (const auto corner = domain(face).corner_at(p, steps_of_face))
      return mesh_.faces[f][static_cast<std::size_t>(*corner)];
    const auto i = static_cast<int>(p.i * (steps() / steps_of_face)),
               j = static_cast<int>(p.j * (steps() / steps_of_face));
    if constexpr (scheme == data::Scheme::kLoop) {
      return refined_.vertex(f, i, j);
    } else {
      return refined_.vertex(f, static_cast<std::size_t>(p.part), i, j);
    }
  }
  std::int32_t vertex(const Place& p) const {
    return vertex(p.face, point_of(p), std::min(steps(), domain(p.face).steps(p.denominator)));
  }
  /// Every lattice point of a face by the vertex that it is. At depth 0 a face that is no quad has its
  /// corners.
  std::map<std::int32_t, FaceDomain::Point> lattice(std::int32_t face, std::int64_t steps_of_face) const {
    std::map<std::int32_t, FaceDomain::Point> result;
    const FaceDomain d = domain(face);
    const auto add = [&](FaceDomain::Point p) { result.emplace(vertex(face, p, steps_of_face), p); };
    if (steps_of_face == 1 && d.parts() > 1) {
      for (int k = 0; k < d.corners(); ++k) add({0, 0, k});
    } else {
      d.for_each_point(steps_of_face, add);
    }
    return result;
  }
  Vector point(std::int32_t v, lc_points points) const {
    const auto i = static_cast<std::size_t>(v);
    return vector_of(points == LC_POINTS_LIMIT ? limits_.positions[i] : refined_.positions()[i]);
  }
  Vector normal(std::int32_t v) const { return vector_of(limits_.normals[static_cast<std::size_t>(v)]); }
  bool has_normal(std::int32_t v) const {
    return limits_.kinds[static_cast<std::size_t>(v)] == reference::NormalKind::kRegular;
  }
  /// The number of faces at a boundary vertex, 0 inside.
  std::size_t boundary_faces(std::int32_t v) const {
    const auto sector = refined_.topology().sector(v);
    return sector.closed ? 0 : sector.faces.size();
  }

 private:
  static auto begin(const data::ControlMesh& mesh) {
    if constexpr (scheme == data::Scheme::kLoop) {
      return reference::RefinedMesh<double>(mesh);
    } else {
      return reference::catmull_clark::RefinedMesh<double>(mesh.faces, reference::positions_of<double>(mesh));
    }
  }
  using Refined = decltype(begin(std::declval<const data::ControlMesh&>()));

  const data::ControlMesh& mesh_;
  Refined refined_;
  typename Refined::Limits limits_;
};

/// Each face is tiled by the lattice of its depth, -1 for none: each point is one vertex, each triangle one of Loop's
/// or half a quad, counter-clockwise, each edge in each direction once.
template <data::Scheme scheme>
void expect_full_lattice(const Expected<scheme>& expected, const Tessellation& t,
                         const std::vector<int>& depth) {
  const std::size_t faces = depth.size();
  const auto steps_of = [&](std::size_t f) { return std::int64_t{1} << std::max(0, depth[f]); };
  std::vector<std::map<std::int32_t, std::int64_t>> found(faces);  // vertices of the subject by point
  std::vector<std::set<std::pair<std::int32_t, std::int32_t>>> edges(faces);
  std::vector<std::int64_t> triangles(faces);
  std::vector<std::map<std::int32_t, FaceDomain::Point>> lattice(faces);
  for (std::size_t f = 0; f < faces; ++f)
    if (depth[f] >= 0) lattice[f] = expected.lattice(static_cast<std::int32_t>(f), steps_of(f));
  for (std::int64_t k = 0; k < t.triangle_count(); ++k) {
    ASSERT_TRUE(t.triangle_ok(k));
    const std::int32_t face = t.triangle_face()[static_cast<std::size_t>(k)];
    const auto f = static_cast<std::size_t>(face);
    ++triangles[f];
    std::array<FaceDomain::Point, 3> at{};
    std::array<std::int32_t, 3> id{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int64_t v = t.triangles()[static_cast<std::size_t>(k)][c];
      ASSERT_TRUE(t.provenance_ok(v));
      const Place p = t.place(v);
      EXPECT_EQ(p.denominator, std::max<std::int64_t>(1, expected.domain(p.face).denominator(steps_of(f))));
      id[c] = expected.vertex(p);
      const auto here = lattice[f].find(id[c]);
      ASSERT_NE(here, lattice[f].end()) << "triangle " << k << " is not on face " << face;
      at[c] = here->second;
      EXPECT_EQ(found[f].try_emplace(id[c], v).first->second, v)
          << "two vertices at a point of face " << face;
    }
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_TRUE(edges[f].emplace(id[c], id[(c + 1) % 3]).second) << "face " << face;
    if (depth[f] > 0 || expected.domain(face).parts() == 1) {
      EXPECT_EQ(expected.domain(face).area(at, steps_of(f)), 1) << "triangle " << k;
    }
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const FaceDomain d = expected.domain(static_cast<std::int32_t>(f));
    EXPECT_EQ(found[f].size(), lattice[f].size()) << "face " << f;
    const std::int64_t n = d.denominator(steps_of(f)), of_part = scheme == data::Scheme::kLoop ? 1 : 2;
    EXPECT_EQ(triangles[f], depth[f] < 0 ? 0
                            : n == 0     ? d.corners() - 2
                                         : of_part * n * n * d.parts())
        << "face " << f;
  }
}

inline double distance(const Vector& a, const Vector& b) {
  return norm(a - b);
}

/// Keeps the worst value seen in the test's record.
inline void record(const std::string& what, double worst) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", worst);
  testing::Test::RecordProperty(what, text);
}

}  // namespace limitcheck::verify::test
