// SPDX-License-Identifier: MIT
#include "bench/cases/shapes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"

namespace limitcheck::bench {

namespace {

/// A quad at each corner of each face, between the middles of its sides and its own middle.
data::ControlMesh quads_of(const data::ControlMesh& mesh) {
  data::ControlMesh out{mesh.positions, {}};
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto add_mean = [&](std::span<const std::int32_t> of) {
    std::array<double, 3> mean{};
    for (const std::int32_t v : of)
      for (std::size_t c = 0; c < 3; ++c) mean[c] += mesh.positions[v][c] / static_cast<double>(of.size());
    for (double& x : mean) x = static_cast<float>(x);
    out.positions.push_back(mean);
    return static_cast<std::int32_t>(out.positions.size() - 1);
  };
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    const std::size_t n = face.size();
    std::vector<std::int32_t> middle;
    for (std::size_t k = 0; k < n; ++k) {
      const auto [a, b] = std::minmax(face[k], face[(k + 1) % n]);
      const auto [at, fresh] = middles.try_emplace({a, b}, 0);
      if (fresh) at->second = add_mean(std::array{a, b});
      middle.push_back(at->second);
    }
    const std::int32_t centre = add_mean(face);
    for (std::size_t k = 0; k < n; ++k)
      out.faces.push_back({face[k], middle[k], centre, middle[(k + n - 1) % n]});
  }
  return out;
}

/// Four triangles for each, by the middles of its sides.
data::ControlMesh split(const data::ControlMesh& mesh) {
  const data::ControlMesh quads = quads_of(mesh);
  data::ControlMesh out{quads.positions, {}};
  for (std::size_t f = 0; f < quads.faces.size(); f += 3) {
    const std::int32_t middle[] = {quads.faces[f][1], quads.faces[f + 1][1], quads.faces[f + 2][1]};
    for (std::size_t k = 0; k < 3; ++k)
      out.faces.push_back({quads.faces[f + k][0], middle[k], middle[(k + 2) % 3]});
    out.faces.push_back({middle[0], middle[1], middle[2]});
  }
  return out;
}

data::ControlMesh make_mesh(const Shape& shape) {
  if (shape.name == "bumpy") return data::bumpy_sphere(shape.faces, 1);
  if (shape.name == "torus") return data::torus(10, shape.faces / 20);
  if (shape.name == "split") return split(split(data::bumpy_sphere(shape.faces / 16, 1)));
  if (shape.name == "regular") return data::quad_torus(shape.faces / 50, 50);
  if (shape.name == "half-regular") return quads_of(quads_of(data::bumpy_sphere(shape.faces / 12, 1)));
  return quads_of(data::bumpy_sphere(shape.faces / 3, 1));
}

/// By a thread, which has a heap of its own: the hull's library draws by the clock; the mesh is the same, but what
/// lies free where would not be, and with it the instructions of every later allocation.
data::ControlMesh made_apart(const Shape& shape) {
  data::ControlMesh mesh;
  std::thread([&] { mesh = make_mesh(shape); }).join();
  return data::ControlMesh(mesh);  // a copy of ours
}

}  // namespace

const data::ControlMesh& mesh_of(const Shape& shape) {
  static std::map<std::pair<std::string, int>, data::ControlMesh> known;
  const auto found = known.find({shape.name, shape.faces});
  return found != known.end()
             ? found->second
             : known.emplace(std::pair{shape.name, shape.faces}, made_apart(shape)).first->second;
}

std::string full_name(const std::string& route, const std::string& use, const Shape& shape, int depth,
                      int threads) {
  return route + "/" + use + "/" + shape.name + "/faces:" + std::to_string(shape.faces) +
         "/depth:" + std::to_string(depth) + "/threads:" + std::to_string(threads);
}

}  // namespace limitcheck::bench
