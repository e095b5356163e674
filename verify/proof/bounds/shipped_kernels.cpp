// SPDX-License-Identifier: MIT
#include "verify/proof/bounds/bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>

#include "fast/mesh/cut_mesh.h"
#include "fast/rules/limit.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/gather/rings.h"
#include "fast/stream/kernel/targets.h"
#include "fast/stream/row_stream.h"
#include "verify/proof/maps/scheme_runs.h"

namespace limitcheck::verify {
namespace {

using namespace fast::row_stream;

// The mesh so many times, side by side.
data::ControlMesh copies(const data::ControlMesh& mesh, std::size_t count) {
  data::ControlMesh all;
  all.sharpness = mesh.sharpness;
  all.sharpness.edges.clear(), all.sharpness.vertices.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const auto first = static_cast<std::int32_t>(all.positions.size());
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      std::vector<std::int32_t> face(mesh.faces[f].begin(), mesh.faces[f].end());
      for (std::int32_t& v : face) v += first;
      all.faces.push_back(face);
    }
    for (const data::SharpEdge& e : mesh.sharpness.edges)
      all.sharpness.edges.push_back({e.a + first, e.b + first, e.sharpness});
    for (const data::SharpVertex& v : mesh.sharpness.vertices)
      all.sharpness.vertices.push_back({v.vertex + first, v.sharpness});
  }
  return all;
}

// The scalar code is the last.
template <class K>
std::vector<K> scalar_first(std::span<const K> kernels) {
  return {kernels.rbegin(), kernels.rend()};
}

// Where each lane's output begins.
std::array<float*, kMaxLanes> lanes_of(float* out, std::ptrdiff_t stride, int lanes) {
  std::array<float*, kMaxLanes> list{};
  for (int k = 0; k < lanes; ++k) list[static_cast<std::size_t>(k)] = out + k * stride;
  return list;
}

// The points of all copies; of a mesh that was cut, those of its vertices.
PlacedPoints<float> points_of(std::span<const FloatPoints> meshes, const std::vector<std::int32_t>& uncut) {
  std::vector<ControlPoint<float>> points;
  for (const FloatPoints& mesh : meshes)
    for (const auto& p : mesh) points.push_back({p.x, p.y, p.z, 0});
  PlacedPoints<float> placed{{}, fast::Placement<float>{}};
  if (uncut.empty()) placed.points = points;
  for (const std::int32_t v : uncut) placed.points.push_back(points[static_cast<std::size_t>(v)]);
  return placed;
}

// Collects what targets deliver, and compares it with what the first one did.
class Collector {
 public:
  Collector(std::size_t copies, Delivery& delivery) : copies_(copies), delivery_(delivery) {
    delivery.vertices.resize(copies);
  }

  void begin(const char* target, int lanes) {
    if (at_ > 0) first_ = false;
    target_ = target, lanes_ = static_cast<std::size_t>(lanes), at_ = 0;
  }
  /// A batch, or several if the lanes do not hold all copies: run(the copy in each lane, output, numbers from
  /// lane to lane). Of the `size` vertices of a lane those of the list are looked at, in its order.
  template <class Run>
  void add(std::size_t size, const std::vector<std::size_t>& visited, Run&& run) {
    std::vector<fast::SurfaceVertex<float>> out(lanes_ * size);
    std::vector<std::int32_t> copy(lanes_);
    for (std::size_t begin = 0; begin < copies_; begin += lanes_) {
      for (std::size_t lane = 0; lane < lanes_; ++lane)
        copy[lane] = static_cast<std::int32_t>((begin + lane + lane / 4) % copies_);
      run(copy, &out[0].position.x, static_cast<std::ptrdiff_t>(6 * size));
      for (std::size_t lane = 0; lane < lanes_; ++lane) {
        auto& kept = delivery_.vertices[static_cast<std::size_t>(copy[lane])];
        for (std::size_t k = 0; k < visited.size(); ++k) {
          const auto& vertex = out[lane * size + visited[k]];
          if (first_)
            kept.push_back(vertex);
          else if (delivery_.unlike.empty() && std::memcmp(&vertex, &kept[at_ + k], sizeof vertex) != 0)
            delivery_.unlike = target_;
        }
      }
    }
    at_ += visited.size();
  }

 private:
  std::size_t copies_, lanes_ = 1, at_ = 0;
  bool first_ = true;
  const char* target_ = "";
  Delivery& delivery_;
};

std::vector<std::size_t> all_of(std::size_t size) {
  std::vector<std::size_t> list(size);
  std::iota(list.begin(), list.end(), std::size_t{0});
  return list;
}

// The same item of the copies that are in the lanes; copies have so many items each.
std::vector<std::int32_t> of_lanes(const std::vector<std::int32_t>& copy, std::int32_t item,
                                   std::size_t items) {
  std::vector<std::int32_t> list;
  for (const std::int32_t k : copy) list.push_back(item + k * static_cast<std::int32_t>(items));
  return list;
}

void stream_triangles(ProvedKernel kernel, const data::ControlMesh& mesh, std::span<const FloatPoints> meshes,
                      int depth, Collector& collector) {
  const data::ControlMesh all = copies(mesh, meshes.size());
  const fast::Adjacency adjacency(all);
  const Rings rings(adjacency, points_of(meshes, {}));
  const std::size_t faces = mesh.faces.size(), width = static_cast<std::size_t>(side(depth));
  const std::int32_t twin = adjacency.twin(0);
  std::vector<std::size_t> visited;
  for (std::size_t row = 0; row < width; ++row)
    for (std::size_t column = 0; column <= (twin < 0 ? row : width - 1); ++column)
      visited.push_back(row * width + column);

  const bool patch = kernel == ProvedKernel::kRowStreamPatch;
  // As StreamRuns has them.
  const std::vector<Edges> ways = ways_of(rings, twin < 0 ? 1 : 2, patch ? 0 : depth);
  AlignedFloats input, work;
  for (const Kernel& target : scalar_first(kernels())) {
    input.grow(static_cast<std::size_t>(target.lanes * input_size(std::max(depth, kPatchWindow))));
    work.grow(static_cast<std::size_t>(target.lanes * work_size(depth)));
    const auto gather_pairs = [&](const std::vector<std::int32_t>& copy, Edges edges) {
      std::vector<fast::Grid> grids;
      for (const std::int32_t face : of_lanes(copy, 0, faces)) {
        if (twin < 0)
          grids.push_back({.face0 = face, .depth = depth});
        else
          grids.push_back({face, face + twin / 3, 0, twin % 3, depth});
      }
      const std::span<const fast::Grid> all_pairs(grids);
      if (patch) return gather_regular(rings, all_pairs, target.lanes, input.data());
      return gather(rings, all_pairs, depth, target.lanes, input.data(), Order::kFromA, edges);
    };
    collector.begin(target.name, target.lanes);
    for (const Edges edges : ways) {
      if (kernel == ProvedKernel::kRowStreamEdge) {
        for (std::int32_t h = 0; h < (twin < 0 ? 3 : 6); ++h)
          collector.add(width, all_of(width), [&](const auto& copy, float* out, std::ptrdiff_t stride) {
            const auto list = of_lanes(copy, h, 3 * faces);
            const auto placement = gather_edges(rings, std::span<const std::int32_t>(list), depth,
                                                target.lanes, input.data(), edges);
            target.run_edges(input.data(), depth, placement, work.data(), out, stride);
          });
        continue;
      }
      const auto row = static_cast<std::ptrdiff_t>(6 * width);
      collector.add(width * width, visited, [&](const auto& copy, float* out, std::ptrdiff_t stride) {
        (patch ? target.run_patches : target.run)(input.data(), depth, gather_pairs(copy, edges), work.data(),
                                                  {out, stride, row, nullptr, nullptr});
      });
    }
    const auto lines = patch ? target.patch_lines : target.run_lines;
    if (lines == nullptr || kernel == ProvedKernel::kRowStreamEdge) continue;
    collector.begin(target.name, target.lanes);
    for (const Edges edges : ways)
      collector.add(width * width, visited, [&](const auto& copy, float* out, std::ptrdiff_t stride) {
        lines(input.data(), depth, gather_pairs(copy, edges), work.data(),
              lanes_of(out, stride, target.lanes).data(), fast::Stores::kOrdinary);
      });
  }
}

void stream_quads(ProvedKernel kernel, const data::ControlMesh& mesh, std::span<const FloatPoints> meshes,
                  int depth, Collector& collector) {
  const data::ControlMesh all = copies(mesh, meshes.size());
  const fast::QuadMesh quads(all);
  const QuadRings rings(quads, points_of(meshes, quads.uncut), 0);
  const std::size_t faces = mesh.faces.size(), width = static_cast<std::size_t>(side(depth));
  AlignedFloats input, work;
  for (const QuadKernel& target : scalar_first(quad_kernels())) {
    input.grow(static_cast<std::size_t>(target.lanes * quad_input_size(depth)));
    work.grow(static_cast<std::size_t>(target.lanes * quad_work_size(depth)));
    const bool patch = kernel == ProvedKernel::kRowStreamPatch;
    // As QuadStreamRuns has them.
    const std::vector<bool> origins = origins_at(patch ? 0 : depth);
    const auto batch_of = [&](const std::vector<std::int32_t>& copy, bool local) {
      const auto list = of_lanes(copy, 0, faces);
      if (patch) return gather_patches<float>(rings, list, depth, target.lanes, input.data());
      return with_origins(gather_quads<float>(rings, list, depth, target.lanes, input.data()), local,
                          target.lanes);
    };
    const auto row = static_cast<std::ptrdiff_t>(6 * width);
    const auto run = [&](QuadKernel::Run* code, const QuadBatch<float>& batch, float* out,
                         std::ptrdiff_t stride) {
      code(batch, rings.placement(), work.data(),
           {lanes_of(out, stride, target.lanes).data(), row, nullptr, nullptr});
    };
    collector.begin(target.name, target.lanes);
    for (const bool local : origins) {
      if (kernel == ProvedKernel::kRowStreamEdge) {
        for (std::int32_t side = 0; side < 4; ++side)
          collector.add(width, all_of(width), [&](const auto& copy, float* out, std::ptrdiff_t stride) {
            const auto edges = of_lanes(copy, side, 4 * faces);
            const auto batch = gather_sides<float>(rings, edges, depth, target.lanes, input.data());
            run(target.sides, with_origins(batch, local, target.lanes), out, stride);
          });
        continue;
      }
      collector.add(width * width, all_of(width * width),
                    [&](const auto& copy, float* out, std::ptrdiff_t stride) {
                      run(patch ? target.patches : target.quads, batch_of(copy, local), out, stride);
                    });
    }
    QuadKernel::Lines* const lines = patch ? target.patch_lines : target.quad_lines;
    if (lines == nullptr || kernel == ProvedKernel::kRowStreamEdge) continue;
    collector.begin(target.name, target.lanes);
    for (const bool local : origins)
      collector.add(width * width, all_of(width * width),
                    [&](const auto& copy, float* out, std::ptrdiff_t stride) {
                      lines(batch_of(copy, local), rings.placement(), work.data(),
                            lanes_of(out, stride, target.lanes).data(), fast::Stores::kOrdinary);
                    });
  }
}

}  // namespace

Delivery deliver(ProvedKernel kernel, const Neighbourhood& neighbourhood, std::span<const FloatPoints> meshes,
                 int depth) {
  const data::ControlMesh& mesh = neighbourhood.mesh;
  Delivery delivery;
  const bool triangles = mesh.faces.are_triangles();
  if (!is_stream(kernel)) {
    for (const FloatPoints& points : meshes) {
      auto& vertices = delivery.vertices.emplace_back();
      const auto collect = [&](const auto& window) {
        run_window(window, kernel, depth,
                   [&](const fast::LatticePoint&, const auto& vertex) { vertices.push_back(vertex); });
      };
      using Surface = fast::LimitSurface<float>;
      if (triangles)
        collect(WindowRuns<float, Surface>(mesh, points));
      else
        collect(QuadWindowRuns<float, Surface>(mesh, points));
    }
    return delivery;
  }
  if (triangles)
    for (const Kernel& target : kernels()) delivery.targets += fmt::format("{} ", target.name);
  else
    for (const QuadKernel& target : quad_kernels()) delivery.targets += fmt::format("{} ", target.name);
  delivery.targets.pop_back();
  Collector collector(meshes.size(), delivery);
  (triangles ? stream_triangles : stream_quads)(kernel, mesh, meshes, depth, collector);
  return delivery;
}

}  // namespace limitcheck::verify
