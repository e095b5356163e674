// SPDX-License-Identifier: MIT
#include "bench/peer_bfr.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/bfr/tessellation.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "verify/subject/opensubdiv_mesh.h"

namespace limitcheck::bench {

namespace Bfr = OpenSubdiv::Bfr;

namespace {

struct Point {
  float position[3], normal[3];
};

void set_normal(const float* du, const float* dv, Point& point) {
  const float n[3] = {du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2],
                      du[0] * dv[1] - du[1] * dv[0]};
  const float scale = 1 / std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (int c = 0; c < 3; ++c) point.normal[c] = n[c] * scale;
}

}  // namespace

struct BfrPeer::State {
  std::vector<double> positions;
  std::vector<std::int32_t> triangles;
  std::vector<float> control;
  std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner;
  std::unique_ptr<Bfr::RefinerSurfaceFactory<>> factory;

  int depth = -1;
  std::vector<float> coords;
  std::vector<Point> out;
  std::vector<float> patch_points;

  // Per face its surface, per point three rows of as many weights as the surface has control points.
  std::vector<Bfr::Surface<float>> surfaces;
  std::vector<std::size_t> first;
  std::vector<float> weights;

  void use_depth(int d) {
    if (d == depth) return;
    depth = d;
    const Bfr::Tessellation tessellation(Bfr::Parameterization(OpenSubdiv::Sdc::SCHEME_LOOP, 3), 1 << d);
    coords.resize(2 * static_cast<std::size_t>(tessellation.GetNumCoords()));
    tessellation.GetCoords(coords.data());
    out.resize(coords.size() / 2);
  }
};

BfrPeer::BfrPeer(const data::ControlMesh& mesh) : state_(std::make_unique<State>()) {
  State& s = *state_;
  for (const auto& p : mesh.positions) {
    s.positions.insert(s.positions.end(), p.begin(), p.end());
    for (const double x : p) s.control.push_back(static_cast<float>(x));
  }
  for (const auto& t : mesh.triangles) s.triangles.insert(s.triangles.end(), t.begin(), t.end());
  const lc_mesh view{s.positions.data(), static_cast<std::int64_t>(mesh.positions.size()), s.triangles.data(),
                     static_cast<std::int64_t>(mesh.triangles.size())};
  s.refiner = verify::make_refiner(view);
  s.factory = std::make_unique<Bfr::RefinerSurfaceFactory<>>(*s.refiner);
}
BfrPeer::~BfrPeer() = default;

void BfrPeer::stream(int depth) {
  State& s = *state_;
  s.use_depth(depth);
  Bfr::Surface<float> surface;
  for (int f = 0; f < s.refiner->GetLevel(0).GetNumFaces(); ++f) {
    s.factory->InitVertexSurface(f, &surface);
    s.patch_points.resize(3 * static_cast<std::size_t>(surface.GetNumPatchPoints()));
    surface.PreparePatchPoints(s.control.data(), 3, s.patch_points.data(), 3);
    for (std::size_t p = 0; p < s.out.size(); ++p) {
      float du[3], dv[3];
      surface.Evaluate(&s.coords[2 * p], s.patch_points.data(), 3, s.out[p].position, du, dv);
      set_normal(du, dv, s.out[p]);
    }
  }
}

void BfrPeer::cache_stencils(int depth) {
  State& s = *state_;
  s.use_depth(depth);
  const int faces = s.refiner->GetLevel(0).GetNumFaces();
  s.surfaces.assign(static_cast<std::size_t>(faces), {});
  s.first.clear();
  s.weights.clear();
  for (int f = 0; f < faces; ++f) {
    auto& surface = s.surfaces[static_cast<std::size_t>(f)];
    s.factory->InitVertexSurface(f, &surface);
    const auto n = static_cast<std::size_t>(surface.GetNumControlPoints());
    s.first.push_back(s.weights.size());
    s.weights.resize(s.weights.size() + 3 * n * s.out.size());
    float* w = s.weights.data() + s.first.back();
    for (std::size_t p = 0; p < s.out.size(); ++p, w += 3 * n)
      surface.EvaluateStencil(&s.coords[2 * p], w, w + n, w + 2 * n);
  }
}

void BfrPeer::apply_stencils() {
  State& s = *state_;
  for (std::size_t f = 0; f < s.surfaces.size(); ++f) {
    const auto& surface = s.surfaces[f];
    const auto n = static_cast<std::size_t>(surface.GetNumControlPoints());
    s.patch_points.resize(3 * n);
    surface.GatherControlPoints(s.control.data(), 3, s.patch_points.data(), 3);
    const float* w = s.weights.data() + s.first[f];
    for (std::size_t p = 0; p < s.out.size(); ++p, w += 3 * n) {
      float du[3], dv[3];
      surface.ApplyStencil(w, s.patch_points.data(), 3, s.out[p].position);
      surface.ApplyStencil(w + n, s.patch_points.data(), 3, du);
      surface.ApplyStencil(w + 2 * n, s.patch_points.data(), 3, dv);
      set_normal(du, dv, s.out[p]);
    }
  }
}

std::size_t BfrPeer::stencil_bytes() const {
  return 4 * state_->weights.size();
}

}  // namespace limitcheck::bench
