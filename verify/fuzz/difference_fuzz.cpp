// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the topology, the depths and the geometry, row streaming gives the limit surface
// that the reference gives, unit normals, and equal bits wherever faces meet, on any kernel.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "data/validate.h"
#include "fast/stream/kernel/targets.h"
#include "fast/stream/stream_tessellator.h"
#include "reference/loop/stam.h"
#include "verify/fuzz/mesh_from_bytes.h"
#include "verify/row/bounds.h"

using namespace limitcheck;

namespace {

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
  const data::ControlMesh mesh = verify::mesh_from_bytes(bytes);
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
