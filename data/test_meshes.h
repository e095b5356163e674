// SPDX-License-Identifier: MIT
// What the tests of meshes expect of all of them; and a mesh that programs write.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>

#include "data/validate.h"

namespace limitcheck::data {

/// FNV-1a over the bits of all positions and indices, and over the faces' sizes unless all are triangles.
inline std::uint64_t hash(const ControlMesh& mesh) {
  std::uint64_t value = 0xcbf29ce484222325u;
  const auto add = [&](std::uint64_t word) {
    for (int i = 0; i < 8; ++i) value = (value ^ (word >> 8 * i & 0xff)) * 0x100000001b3u;
  };
  for (const auto& p : mesh.positions) {
    for (const double x : p) add(std::bit_cast<std::uint64_t>(x));
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (!mesh.faces.are_triangles()) add(mesh.faces[f].size());
    for (const std::int32_t v : mesh.faces[f]) add(static_cast<std::uint32_t>(v));
  }
  return value;
}

/// The hashes of several meshes as one.
template <class Meshes>
std::uint64_t hash_of_all(const Meshes& meshes) {
  std::uint64_t all = 0;
  for (const ControlMesh& mesh : meshes) all = all * 31 + hash(mesh);
  return all;
}
/// Of what a generator makes of the seeds below 50.
template <class Make>
std::uint64_t hash_of_seeds(Make&& make) {
  std::uint64_t all = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) all = all * 31 + hash(make(seed));
  return all;
}

inline void expect_valid(const ControlMesh& mesh, const std::string& what, Scheme scheme) {
  const auto faults = validate(mesh, scheme);
  EXPECT_TRUE(faults.empty()) << what << ": " << faults[0].message;
}
inline void expect_valid(const ControlMesh& mesh, const std::string& what) {
  expect_valid(mesh, what, natural_scheme(mesh));
}
/// Valid, and every coordinate exact in float.
inline void expect_sound(const ControlMesh& mesh, const std::string& what) {
  expect_valid(mesh, what);
  for (const auto& p : mesh.positions)
    for (const double x : p) EXPECT_EQ(x, static_cast<double>(static_cast<float>(x))) << what;
}

/// How many faces have so many corners.
inline std::map<std::size_t, int> sizes_of(const ControlMesh& mesh) {
  std::map<std::size_t, int> sizes;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) ++sizes[mesh.faces[f].size()];
  return sizes;
}

/// A sphere of `around` meridians as programs write it that leave sin(pi) at 1e-16: the faces at the poles
/// that would have no area are left out, and the other pole is a row of vertices 1e-17 apart.
inline ControlMesh sphere_with_residue(int around) {
  const int rows = around / 2;
  ControlMesh mesh;
  const auto point = [&](int i, int j) {
    const double t = std::numbers::pi * i / rows, p = 2 * std::numbers::pi * j / around;
    return std::array{std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
  };
  mesh.positions.push_back(point(0, 0));
  for (int i = 1; i <= rows; ++i)
    for (int j = 0; j < around; ++j) mesh.positions.push_back(point(i, j));
  const auto at = [&](int i, int j) {
    return static_cast<std::int32_t>(i == 0 ? 0 : 1 + (i - 1) * around + j % around);
  };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < around; ++j) {
      if (i > 0) mesh.faces.push_back({at(i, j + 1), at(i, j), at(i + 1, j + 1)});
      if (i < rows - 1) mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
    }
  return mesh;
}

}  // namespace limitcheck::data
