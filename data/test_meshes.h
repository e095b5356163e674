// SPDX-License-Identifier: MIT
// What the tests of meshes expect of all of them.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <map>
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

}  // namespace limitcheck::data
