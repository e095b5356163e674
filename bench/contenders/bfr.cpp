// SPDX-License-Identifier: MIT
// OpenSubdiv's Bfr: one surface object per face, in float, default approximation level (2).
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/bfr/tessellation.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "bench/contenders/contender.h"
#include "bench/contenders/opensubdiv.h"

namespace limitcheck::bench {

namespace {

namespace Bfr = OpenSubdiv::Bfr;

/// The parameters of a face's lattice points.
std::vector<float> lattice_coordinates(const OpenSubdivMesh& mesh, int depth) {
  const Bfr::Tessellation tessellation(Bfr::Parameterization(mesh.refiner().GetSchemeType(), mesh.corners()),
                                       1 << depth);
  std::vector<float> coords(2 * static_cast<std::size_t>(tessellation.GetNumCoords()));
  tessellation.GetCoords(coords.data());
  return coords;
}

/// The points of a face, nothing kept: nearest to the paper's method.
struct FaceStream {
  Bfr::Surface<float> surface;
  std::vector<float> patch_points;
  std::vector<LimitPoint> out;

  void run(const OpenSubdivMesh& mesh, const Bfr::RefinerSurfaceFactory<>& factory, std::size_t face,
           const std::vector<float>& coords) {
    factory.InitVertexSurface(static_cast<int>(face), &surface);
    patch_points.resize(3 * static_cast<std::size_t>(surface.GetNumPatchPoints()));
    surface.PreparePatchPoints(mesh.control(), 3, patch_points.data(), 3);
    out.resize(coords.size() / 2);
    for (std::size_t p = 0; p < out.size(); ++p) {
      float du[3], dv[3];
      surface.Evaluate(&coords[2 * p], patch_points.data(), 3, out[p].position, du, dv);
      set_normal(du, dv, out[p]);
    }
  }
};

/// What all uses at one depth share: the topology and the factory.
class BfrContender : public Contender {
 public:
  BfrContender(const data::ControlMesh& mesh, int depth, int threads)
      : threads_(threads),
        mesh_(mesh),
        factory_(mesh_.refiner()),
        coords_(lattice_coordinates(mesh_, depth)) {}
  double evaluated() const override { return static_cast<double>(mesh_.faces() * points()); }

 protected:
  std::size_t points() const { return coords_.size() / 2; }

  int threads_;
  OpenSubdivMesh mesh_;
  Bfr::RefinerSurfaceFactory<> factory_;
  std::vector<float> coords_;
};

class Streaming : public BfrContender {
 public:
  using BfrContender::BfrContender;

  void run() override {
    in_parallel(mesh_.faces(), threads_, [&](std::size_t first, std::size_t last) {
      FaceStream stream;
      for (std::size_t f = first; f < last; ++f) stream.run(mesh_, factory_, f, coords_);
    });
  }
};

/// The same with a depth for each face, -1: not at all.
class Frame {
 public:
  Frame(const data::ControlMesh& mesh, std::span<const std::int32_t> depth)
      : mesh_(mesh), factory_(mesh_.refiner()), depth_(depth.begin(), depth.end()) {
    for (const std::int32_t d : depth_)
      while (static_cast<std::int32_t>(coords_.size()) <= d)
        coords_.push_back(lattice_coordinates(mesh_, static_cast<int>(coords_.size())));
  }
  void run() {
    for (std::size_t f = 0; f < depth_.size(); ++f)
      if (depth_[f] >= 0) stream_.run(mesh_, factory_, f, coords_[static_cast<std::size_t>(depth_[f])]);
  }

 private:
  OpenSubdivMesh mesh_;
  Bfr::RefinerSurfaceFactory<> factory_;
  std::vector<std::int32_t> depth_;
  std::vector<std::vector<float>> coords_;  // by depth
  FaceStream stream_;
};

/// Limit stencils of all points made once, a surface object per face kept.
class CachedStencils : public BfrContender {
 public:
  CachedStencils(const data::ControlMesh& mesh, int depth, int threads)
      : BfrContender(mesh, depth, threads), surfaces_(mesh_.faces()) {
    for (std::size_t f = 0; f < surfaces_.size(); ++f) {
      factory_.InitVertexSurface(static_cast<int>(f), &surfaces_[f]);
      const auto n = static_cast<std::size_t>(surfaces_[f].GetNumControlPoints());
      first_.push_back(weights_.size());
      weights_.resize(weights_.size() + 3 * n * points());
      float* w = weights_.data() + first_.back();
      for (std::size_t p = 0; p < points(); ++p, w += 3 * n)
        surfaces_[f].EvaluateStencil(&coords_[2 * p], w, w + n, w + 2 * n);
    }
  }

  void run() override {
    in_parallel(surfaces_.size(), threads_, [&](std::size_t first, std::size_t last) {
      std::vector<float> control;
      std::vector<LimitPoint> out(points());
      for (std::size_t f = first; f < last; ++f) {
        const auto& surface = surfaces_[f];
        const auto n = static_cast<std::size_t>(surface.GetNumControlPoints());
        control.resize(3 * n);
        surface.GatherControlPoints(mesh_.control(), 3, control.data(), 3);
        const float* w = weights_.data() + first_[f];
        for (std::size_t p = 0; p < out.size(); ++p, w += 3 * n) {
          float du[3], dv[3];
          surface.ApplyStencil(w, control.data(), 3, out[p].position);
          surface.ApplyStencil(w + n, control.data(), 3, du);
          surface.ApplyStencil(w + 2 * n, control.data(), 3, dv);
          set_normal(du, dv, out[p]);
        }
      }
    });
  }

 private:
  std::vector<Bfr::Surface<float>> surfaces_;
  std::vector<std::size_t> first_;
  std::vector<float> weights_;  // per point three rows of as many as the surface has control points
};

}  // namespace

Route bfr_streaming() {
  return {"bfr/streaming",   "OpenSubdiv Bfr, surface per face made and forgotten", 160, 0, true,
          maker<Streaming>()};
}

Route bfr_cached_stencils() {
  return {"bfr/cached-stencils",  "OpenSubdiv Bfr, limit stencils of all points kept", 400, 180, true,
          maker<CachedStencils>()};
}

std::function<void()> bfr_frame(const data::ControlMesh& mesh, std::span<const std::int32_t> depth) {
  return [frame = std::make_shared<Frame>(mesh, depth)] { frame->run(); };
}

}  // namespace limitcheck::bench
