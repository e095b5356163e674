// SPDX-License-Identifier: MIT
// What the reference says of the points of a mesh, and that a tessellation has each of them once. For tests of this
// folder.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "reference/catmull_clark/recursion.h"
#include "reference/loop/refine.h"
#include "verify/evidence/vector.h"
#include "verify/host/host.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify::test {

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
  reference::VertexLimits<double> limits_;
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

}  // namespace limitcheck::verify::test
