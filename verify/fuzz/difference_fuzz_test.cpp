// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the topology, the depths and the geometry, row streaming gives the limit surface
// that the reference gives, unit normals, and equal bits wherever faces meet, on any kernel.
#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "data/generators/random_mesh.h"
#include "data/shapes.h"
#include "data/validate.h"
#include "fast/stream/kernel/targets.h"
#include "fast/stream/stream_tessellator.h"
#include "reference/loop/stam.h"
#include "verify/row/bounds.h"

using namespace limitcheck;

namespace {

data::ControlMesh shape_from_bytes(FuzzedDataProvider& bytes) {
  const int n = bytes.ConsumeIntegralInRange(0, 15);
  const int valence = n == 15 ? 80 : 3 + n;  // some vertices have very many faces
  switch (bytes.ConsumeIntegralInRange(0, 11)) {
    case 0:
      return data::tetrahedron();
    case 1:
      return data::icosahedron();
    case 2:
      return data::bipyramid(valence);
    case 3:
      return data::wheel(valence, 1);
    case 4:
      return data::fan(valence - 2, 1);
    case 5:
      return data::sheet(1 + n % 4, 1 + n / 4);
    case 6:
      return data::strip(1 + n);
    case 7:
      return data::triangle();
    case 8:
      return data::torus(3 + n % 4, 3 + n / 4);
    case 9:
      return data::cube();
    case 10:
      return data::two_components();
    default:
      return data::random_mesh(bytes.ConsumeIntegral<std::uint16_t>(), {.faces = 4 + 4 * n});
  }
}

// A small control mesh whose topology and geometry the bytes decide. Perhaps not valid: the caller asks
// data::validate.
data::ControlMesh mesh_from_bytes(FuzzedDataProvider& bytes) {
  data::ControlMesh mesh = shape_from_bytes(bytes);
  std::vector<std::array<std::int32_t, 3>> triangles = data::triangles_of(mesh).to_vector();

  // Faces go, are split in three or have an edge flipped.
  for (int edits = bytes.ConsumeIntegralInRange(0, 12); edits > 0 && triangles.size() > 1; --edits) {
    const auto f = bytes.ConsumeIntegralInRange<std::size_t>(0, triangles.size() - 1);
    const std::array<std::int32_t, 3> t = triangles[f];
    const int kind = bytes.ConsumeIntegralInRange(0, 2);
    if (kind == 0) {
      triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(f));
    } else if (kind == 1) {
      const auto centre = static_cast<std::int32_t>(mesh.positions.size());
      std::array<double, 3> p{};
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = (mesh.positions[t[0]][axis] + mesh.positions[t[1]][axis] + mesh.positions[t[2]][axis]) / 4;
      mesh.positions.push_back(p);
      triangles[f] = {t[0], t[1], centre};
      triangles.push_back({t[1], t[2], centre});
      triangles.push_back({t[2], t[0], centre});
    } else {
      for (std::array<std::int32_t, 3>& other : triangles)
        for (int k = 0; k < 3; ++k)
          if (other[k] == t[1] && other[(k + 1) % 3] == t[0]) {
            const std::int32_t beyond = other[(k + 2) % 3];
            other = {beyond, t[1], t[2]};
            triangles[f] = {t[0], beyond, t[2]};
            k = 3;
          }
    }
  }
  // Vertices without a face go, too.
  std::vector<std::int32_t> name(mesh.positions.size(), -1);
  std::vector<std::array<double, 3>> kept;
  for (std::array<std::int32_t, 3>& t : triangles)
    for (std::int32_t& v : t) {
      if (name[v] < 0) {
        name[v] = static_cast<std::int32_t>(kept.size());
        kept.push_back(mesh.positions[v]);
      }
      v = name[v];
    }
  mesh.positions = std::move(kept);
  mesh.faces = data::Faces(triangles);

  // Geometry: shaken, on a coarse grid, flat, far away, huge, tiny.
  const int kind = bytes.ConsumeIntegralInRange(0, 6);
  const bool shake = bytes.ConsumeBool();
  for (auto& p : mesh.positions)
    for (double& x : p) {
      if (shake) x += bytes.ConsumeIntegral<std::int8_t>() / 64.;
      if (kind == 1) x = std::round(x * 2) / 2;
      if (kind == 2) x = 0;
      if (kind == 3) x += 1000;
      if (kind == 4) x = std::ldexp(x, 60);
      if (kind == 5) x = std::ldexp(x, -60);
      x = static_cast<double>(static_cast<float>(x));
    }
  return mesh;
}

void require(bool condition, const char* what, double value = 0) {
  if (condition) return;
  std::fprintf(stderr, "%s: %g\n", what, value);
  std::abort();
}

// A place on the surface, the same for every face that has it: the corners with their weights.
using Place = std::vector<std::pair<std::int32_t, std::uint32_t>>;

Place place_of(const std::array<std::int32_t, 3>& t, const fast::LatticePoint& p) {
  const auto i = static_cast<std::uint32_t>(p.i), j = static_cast<std::uint32_t>(p.j),
             n = static_cast<std::uint32_t>(p.denominator);
  const std::uint32_t common = std::gcd(std::gcd(i, j), n);
  Place place;
  for (const auto& [corner, weight] : {std::pair{t[0], n - i - j}, {t[1], i}, {t[2], j}})
    if (weight != 0) place.emplace_back(corner, weight / common);
  std::sort(place.begin(), place.end());
  return place;
}

struct Bits {
  std::array<std::uint32_t, 6> of{};
  bool operator==(const Bits&) const = default;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider bytes(data, size);
  const data::ControlMesh mesh = mesh_from_bytes(bytes);
  if (mesh.faces.size() > 200 || mesh.faces.size() == 0 || !data::validate(mesh).empty()) return 0;
  const auto triangles = data::triangles_of(mesh);

  fast::TessellatorOptions options;
  options.provenance = true;
  options.threads = 1;
  options.cracks.repair = bytes.ConsumeBool() ? fast::Repair::kFan : fast::Repair::kStitch;
  const auto kernels = fast::row_stream::kernels();
  const auto& kernel = kernels[bytes.ConsumeIntegralInRange<std::size_t>(0, kernels.size() - 1)];
  const int deepest = bytes.ConsumeIntegralInRange(0, kernel.fused ? 4 : 2);
  std::vector<std::int32_t> depth(triangles.size(), deepest);
  if (bytes.ConsumeBool())
    for (std::int32_t& d : depth) d = bytes.ConsumeIntegralInRange(-1, deepest);

  fast::IndexedMesh<float> out;
  fast::row_stream::StreamTessellator(mesh, options, kernel).frame(depth, out);
  require(out.provenance.size() == out.vertices.size(), "a vertex without provenance");
  for (const auto& t : out.triangles)
    for (const std::uint32_t v : t) require(v < out.vertices.size(), "an index out of range", v);

  std::array<double, 3> low = mesh.positions[0], high = low;
  double magnitude = 0;
  for (const auto& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
      magnitude = std::max(magnitude, std::abs(p[axis]));
    }
  // The audit's bound, times the diagonal; below float's normal range a rounding is absolute.
  const double bound = verify::position_bound(LC_FLOAT32, deepest, magnitude, 1) + 1e-43;

  const reference::StamEvaluator<double> reference(mesh);
  std::map<Place, Bits> seen;
  for (std::size_t v = 0; v < out.vertices.size(); ++v) {
    const fast::LatticePoint& at = out.provenance[v];
    require(at.face >= 0 && at.face < static_cast<std::int32_t>(triangles.size()), "no such face", at.face);
    const auto& p = out.vertices[v].position;
    const auto& n = out.vertices[v].normal;
    const double length = std::hypot(n.x, n.y, n.z);
    require(std::abs(length - 1) <= verify::length_bound(LC_FLOAT32), "a normal's length", length);
    const auto truth =
        reference.evaluate(at.face, reference::Parameter::fraction(at.i, at.denominator),
                           reference::Parameter::fraction(at.j, at.denominator), reference::Order::kFirst);
    const double error = std::hypot(p.x - truth.position.x, p.y - truth.position.y, p.z - truth.position.z);
    require(error <= bound, "a position beyond its bound, of it", error / bound);

    const std::array<float, 6> numbers{p.x, p.y, p.z, n.x, n.y, n.z};
    Bits bits;
    std::memcpy(bits.of.data(), numbers.data(), sizeof numbers);
    const auto [other, first] =
        seen.emplace(place_of(triangles[static_cast<std::size_t>(at.face)], at), bits);
    require(first || other->second == bits, "bits differ at a shared point", at.face);
  }
  return 0;
}
