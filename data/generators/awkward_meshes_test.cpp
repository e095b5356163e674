// SPDX-License-Identifier: MIT
#include "data/generators/awkward_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

// What can be counted straight from the list of triangles.
struct Counts {
  std::int64_t characteristic = 0;  // V - E + F
  std::int64_t boundary = 0;        // edges with one face
  std::size_t components = 0;
  std::map<int, int> valences;  // neighbours of a vertex, and how many vertices have so many

  explicit Counts(const ControlMesh& mesh) {
    std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
    std::vector<std::int32_t> parent(mesh.positions.size());
    for (std::size_t v = 0; v < parent.size(); ++v) parent[v] = static_cast<std::int32_t>(v);
    const auto root = [&](std::int32_t v) {
      while (parent[v] != v) v = parent[v];
      return v;
    };
    for (const auto& t : triangles_of(mesh))
      for (int k = 0; k < 3; ++k) {
        ++edges[std::minmax(t[k], t[(k + 1) % 3])];
        parent[root(t[k])] = root(t[(k + 1) % 3]);
      }
    std::vector<int> neighbours(mesh.positions.size());
    for (const auto& [edge, faces] : edges) {
      ++neighbours[edge.first];
      ++neighbours[edge.second];
      boundary += faces == 1;
    }
    for (const int n : neighbours) ++valences[n];
    for (std::size_t v = 0; v < parent.size(); ++v) components += parent[v] == static_cast<std::int32_t>(v);
    characteristic = static_cast<std::int64_t>(mesh.positions.size()) -
                     static_cast<std::int64_t>(edges.size()) + static_cast<std::int64_t>(mesh.faces.size());
  }
};

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(AwkwardMeshes, AreValidAndExactInFloat) {
  for (const ControlMesh& mesh :
       {handles(1), handles(2), handles(3), three_components(), touching_components(), flat(), needles(),
        far_box(), zero_edge(), stellated(), tiny_box(), huge_box(), crowd(1), crowd(1000)}) {
    const auto findings = validate(mesh);
    EXPECT_TRUE(findings.empty()) << findings[0].message;
    for (const auto& p : mesh.positions)
      for (const double x : p) EXPECT_EQ(x, static_cast<double>(static_cast<float>(x)));
  }
}

TEST(AwkwardMeshes, HandlesHaveTheirGenusAndAreIrregular) {
  for (const int genus : {1, 2, 7}) {
    const ControlMesh mesh = handles(genus);
    const Counts counts(mesh);
    EXPECT_EQ(counts.characteristic, 2 - 2 * genus);
    EXPECT_EQ(counts.boundary, 0);
    EXPECT_EQ(counts.components, 1U);
    EXPECT_GE(counts.valences.size(), 4U) << "valences";
    EXPECT_EQ(mesh.faces.size(), static_cast<std::size_t>(36 * genus + 28));
  }
  EXPECT_THROW(handles(0), InputError);
}

TEST(AwkwardMeshes, HaveTheComponentsThatTheyAreNamedFor) {
  EXPECT_EQ(Counts(three_components()).components, 3U);
  const ControlMesh touching = touching_components();
  EXPECT_EQ(Counts(touching).components, 2U);
  const std::set<std::array<double, 3>> places(touching.positions.begin(), touching.positions.end());
  EXPECT_EQ(places.size(), touching.positions.size() - 1);
  EXPECT_EQ(Counts(crowd(50)).components, 50U);
  EXPECT_THROW(crowd(0), InputError);
}

TEST(AwkwardMeshes, HaveTheGeometryThatTheyAreNamedFor) {
  for (const auto& p : flat().positions) EXPECT_EQ(p[2], 0);

  const ControlMesh thin = needles();
  for (const auto& t : triangles_of(thin)) {
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, distance(thin.positions[t[k]], thin.positions[t[(k + 1) % 3]]));
    double width = 0;  // across the long axis
    for (int k = 0; k < 3; ++k)
      width = std::max(width, std::abs(thin.positions[t[k]][1] - thin.positions[t[(k + 1) % 3]][1]));
    EXPECT_GE(longest / width, 1e4);
  }

  const ControlMesh edge = zero_edge();
  EXPECT_EQ(edge.positions[0], edge.positions[1]);
  EXPECT_TRUE(std::any_of(triangles_of(edge).begin(), triangles_of(edge).end(), [](const auto& t) {
    return std::count_if(t.begin(), t.end(), [](std::int32_t v) { return v < 2; }) == 2;
  }));

  EXPECT_NEAR(std::abs(tiny_box().positions[0][0]) / 1e-25, 1, 0.05);
  EXPECT_NEAR(std::abs(huge_box().positions[0][0]) / 1e20, 0.75, 0.05);
  const ControlMesh box = far_box();
  EXPECT_GE(distance(box.positions[0], {}) / distance(box.positions[0], box.positions[7]), 60);
}

TEST(AwkwardMeshes, OfTheStellatedOctahedronMostVerticesHaveValenceThree) {
  EXPECT_EQ(Counts(stellated()).valences, (std::map<int, int>{{3, 8}, {8, 6}}));
}

}  // namespace
}  // namespace limitcheck::data
