// SPDX-License-Identifier: MIT
#include "verify/cli/audit_depths.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "data/splitmix64.h"
#include "fast/depth.h"
#include "verify/cli/doors.h"

namespace limitcheck::cli {
namespace {

// Measured with bumpy:4000 at depth 5: 358 to 579 bytes a point.
constexpr double kBytesPerPoint = 350;

// A view of the whole mesh from twice its size away, slanting: half of a closed mesh is culled, a flat one
// seen. Triangles of 10 pixels, so that a mesh of a few hundred faces shows more than one depth.
std::vector<std::int32_t> view_depths(const data::ControlMesh& mesh, int deepest) {
  fast::Point3 low = fast::to_point(mesh.positions.at(0)), high = low;
  for (const auto& p : mesh.positions) {
    low = {std::min(low.x, p[0]), std::min(low.y, p[1]), std::min(low.z, p[2])};
    high = {std::max(high.x, p[0]), std::max(high.y, p[1]), std::max(high.z, p[2])};
  }
  const double size = fast::length(high - low);
  fast::Camera camera;
  camera.target = .5 * (low + high);
  camera.eye = camera.target + (2 * size / std::sqrt(14)) * fast::Point3{1, 2, 3};
  camera.near = .01 * size;
  fast::DepthOptions options;
  options.strategy = fast::Strategy::kCombined;
  options.target_pixels = 10;
  const fast::Adjacency adjacency(mesh);
  return fast::DepthHeuristics(mesh, adjacency, deepest).depths(options, camera);
}

}  // namespace

Depths parse_depths(const std::string& text) {
  if (text == "uniform" || text == "view") return {text, std::nullopt};
  if (text == "random") return {text, 1};
  if (text.starts_with("random:")) {
    std::uint64_t seed = 0;
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data() + 7, last, seed);
    if (error == std::errc() && end == last) return {"random", seed};
  }
  if (text.starts_with("file:")) return {text, std::nullopt};
  throw std::invalid_argument(
      fmt::format("--depths {}: uniform, random, random:SEED, view or file:FILE", text));
}

std::vector<std::int32_t> face_depths(const Depths& depths, const data::ControlMesh& mesh, int deepest) {
  if (depths.kind == "uniform") return {};
  if (depths.kind == "view") return view_depths(mesh, deepest);
  if (depths.kind.starts_with("file:")) return read_depths(depths.kind.substr(5), mesh, deepest);
  data::SplitMix64 random(*depths.seed);
  std::vector<std::int32_t> depth(mesh.triangles.size());
  for (std::int32_t& d : depth)
    d = static_cast<std::int32_t>(random.next() % (static_cast<std::uint64_t>(deepest) + 1));
  return depth;
}

void refuse_too_many_points(const std::string& name, const data::ControlMesh& mesh,
                            std::span<const std::int32_t> face_depth, int deepest) {
  double points = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const int depth = face_depth.empty() ? deepest : face_depth[f];
    const double rows = std::ldexp(1, depth) + 1;
    if (depth >= 0) points += rows * (rows + 1) / 2;
  }
  const double needed = points * kBytesPerPoint;
  const double there =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (needed > there)
    throw std::invalid_argument(
        fmt::format("{}: the audit of {:.3g} points needs some {:.0f} GB, and this machine has {:.0f}: take "
                    "a smaller --depth, or look at a part with --sample FACES",
                    name, points, needed / 1e9, there / 1e9));
}

}  // namespace limitcheck::cli
