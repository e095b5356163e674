// SPDX-License-Identifier: MIT
#include "data/generators/channel_meshes.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "data/building_blocks.h"
#include "data/generators/polygon_meshes.h"
#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

/// Adds values to a channel as its corners come: corners of one key have one value, that of the first.
template <class Key>
class ChannelBuilder {
 public:
  void corner(const Key& key, double u, double v) {
    const auto [found, is_new] = index_.emplace(key, static_cast<std::int32_t>(index_.size()));
    if (is_new) channel_.values.insert(channel_.values.end(), {u, v});
    channel_.corners.push_back(found->second);
  }
  Channel result() { return std::move(channel_); }

 private:
  Channel channel_{.name = "uv"};
  std::map<Key, std::int32_t> index_;
};

using Pair = std::pair<int, int>;
constexpr Pair kCorners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};  // of a quad of a lattice

}  // namespace

ControlMesh cube_with_atlas() {
  ControlMesh mesh = quad_cube();
  ChannelBuilder<Pair> uv;
  for (int f = 0; f < 6; ++f)
    for (int k = 0; k < 4; ++k)
      uv.corner({f, k}, (f % 3 + (k == 1 || k == 2 ? .75 : .25)) / 4, (f / 3 + (k > 1 ? .75 : .25)) / 2);
  mesh.channels.push_back(uv.result());
  return mesh;
}

ControlMesh globe(int around, int across) {
  require(around >= 3 && across >= 2 && std::int64_t{around} * across <= kMostFaces,
          "a globe has 3 faces around or more, 2 from pole to pole or more, and " +
              std::to_string(kMostFaces) + " at most");
  ControlMesh mesh;
  mesh.positions.push_back({0, 0, -1});
  for (int j = 1; j < across; ++j)
    for (int i = 0; i < around; ++i) {
      const double longitude = 2 * std::numbers::pi * i / around,
                   latitude = std::numbers::pi * (double(j) / across - .5);
      mesh.positions.push_back({std::cos(latitude) * std::cos(longitude),
                                std::cos(latitude) * std::sin(longitude), std::sin(latitude)});
    }
  mesh.positions.push_back({0, 0, 1});
  const auto top = static_cast<std::int32_t>(mesh.positions.size() - 1);
  const auto at = [&](int i, int j) {
    return j == 0 ? 0 : j == across ? top : 1 + (j - 1) * around + i % around;
  };
  ChannelBuilder<Pair> uv;
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < around; ++i) {
      std::vector<std::int32_t> face;
      for (const auto& [di, dj] : kCorners) {
        const bool pole = j + dj == 0 || j + dj == across;
        if (pole && di != dj) continue;  // a triangle
        face.push_back(at(i + di, j + dj));
        uv.corner({pole ? i : i + di, j + dj}, (i + (pole ? .5 : di)) / around, double(j + dj) / across);
      }
      mesh.faces.push_back(face);
    }
  mesh.channels.push_back(uv.result());
  for (auto& p : mesh.positions)
    for (double& x : p) x = rounded(x);
  return mesh;
}

ControlMesh torus_in_a_chart(int around, int across) {
  ControlMesh mesh = quad_torus(around, across);
  ChannelBuilder<Pair> uv;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j)
      for (const auto& [di, dj] : kCorners)
        uv.corner({i + di, j + dj}, double(i + di) / around, double(j + dj) / across);
  mesh.channels.push_back(uv.result());
  return mesh;
}

ControlMesh with_random_channel(ControlMesh mesh, std::uint64_t seed) {
  SplitMix64 random(seed);
  const auto below = [&](std::uint64_t n) { return static_cast<int>(random.next() % n); };
  const int charts = 2 + below(3);
  // A face mostly belongs to the chart of an earlier face beside it.
  std::vector<int> chart_at(mesh.positions.size(), -1), chart(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto corners = mesh.faces[f];
    const int near =
        chart_at[static_cast<std::size_t>(corners[static_cast<std::size_t>(below(corners.size()))])];
    chart[f] = near >= 0 && below(4) != 0 ? near : below(static_cast<std::uint64_t>(charts));
    for (const std::int32_t v : corners) chart_at[static_cast<std::size_t>(v)] = chart[f];
  }
  // At a fifth of the vertices some charts share their value.
  std::vector<std::array<int, 4>> shared(mesh.positions.size(), {0, 1, 2, 3});
  for (auto& charts_at : shared)
    if (below(5) == 0)
      for (int& c : charts_at)
        if (below(2) == 0) c = charts_at[0];
  ChannelBuilder<Pair> uv;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const std::int32_t v : mesh.faces[f]) {
      const int c = shared[static_cast<std::size_t>(v)][static_cast<std::size_t>(chart[f])];
      const double first = below(256) / 64., second = below(256) / 64.;
      uv.corner({v, c}, first, second);
    }
  Channel channel = uv.result();
  channel.rule = static_cast<ChannelRule>(below(6));
  mesh.channels = {std::move(channel)};
  return mesh;
}

ControlMesh with_random_channels(ControlMesh mesh, std::uint64_t seed) {
  Channel colour = with_random_channel(mesh, seed + 1).channels.front();
  SplitMix64 random(seed + 2);
  std::vector<double> values;
  for (std::size_t i = 0; i < colour.values.size(); i += 2) {
    values.insert(values.end(), {colour.values[i], colour.values[i + 1]});
    for (int k = 0; k < 2; ++k) values.push_back(static_cast<double>(random.next() % 256) / 64);
  }
  colour.name = "colour", colour.components = 4, colour.values = std::move(values);
  mesh = with_random_channel(std::move(mesh), seed);
  for (double& x : mesh.channels.front().values) x = 8 * x - 8;
  mesh.channels.push_back(std::move(colour));
  return mesh;
}

}  // namespace limitcheck::data
