// SPDX-License-Identifier: MIT
// OpenSubdiv's Far: the whole mesh, each of its points once, on one thread.
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/osd/cpuEvaluator.h>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "bench/contenders/contender.h"
#include "bench/contenders/opensubdiv.h"

namespace limitcheck::bench {

namespace {

namespace Far = OpenSubdiv::Far;

using Vector = verify::OpenSubdivVector<float>;

/// Uniformly refined topology; run() interpolates level by level, then applies the limit masks.
class Uniform : public Contender {
 public:
  Uniform(const data::ControlMesh& mesh, int depth) : mesh_(mesh), depth_(depth) {
    Far::TopologyRefiner::UniformOptions options(depth);
    options.fullTopologyInLastLevel = true;  // without it Limit() writes nothing
    mesh_.refiner().RefineUniform(options);
    for (auto* buffer : {&a_, &b_, &limit_, &du_, &dv_}) buffer->resize(vertices());
    out_.resize(vertices());
  }

  void run() override {
    const auto* control = reinterpret_cast<const Vector*>(mesh_.control());
    std::copy(control, control + mesh_.vertices(), a_.begin());
    const Far::PrimvarRefinerReal<float> primvars(mesh_.refiner());
    for (int level = 1; level <= depth_; ++level) {
      primvars.Interpolate(level, a_, b_);
      a_.swap(b_);
    }
    primvars.Limit(a_, limit_, du_, dv_);
    for (std::size_t v = 0; v < out_.size(); ++v) {
      std::copy(limit_[v].x.begin(), limit_[v].x.end(), out_[v].position);
      set_normal(du_[v].x.data(), dv_[v].x.data(), out_[v]);
    }
  }
  double evaluated() const override { return static_cast<double>(vertices()); }

 private:
  std::size_t vertices() const {
    return static_cast<std::size_t>(mesh_.refiner().GetLevel(depth_).GetNumVertices());
  }
  OpenSubdivMesh mesh_;
  int depth_;
  std::vector<Vector> a_, b_, limit_, du_, dv_;
  std::vector<LimitPoint> out_;
};

/// A table of limit stencils, and the evaluator made for it.
class LimitStencils : public Contender {
 public:
  LimitStencils(const data::ControlMesh& mesh, int depth) : mesh_(mesh) {
    mesh_.refiner().RefineAdaptive(Far::TopologyRefiner::AdaptiveOptions(2));
    table_.reset(Far::LimitStencilTableFactory::Create(mesh_.refiner(), locations(depth)));
    if (!table_) throw std::runtime_error("OpenSubdiv makes no limit stencils");
    out_.resize(evaluated_ = static_cast<std::size_t>(table_->GetNumStencils()));
    derivatives_.resize(6 * evaluated_);
  }

  void run() override {
    using OpenSubdiv::Osd::BufferDescriptor;
    const BufferDescriptor control(0, 3, 3), position(0, 3, 6), du(0, 3, 6), dv(3, 3, 6);
    OpenSubdiv::Osd::CpuEvaluator::EvalStencils(
        mesh_.control(), control, out_[0].position, position, derivatives_.data(), du, derivatives_.data(),
        dv, table_->GetSizes().data(), table_->GetOffsets().data(), table_->GetControlIndices().data(),
        table_->GetWeights().data(), table_->GetDuWeights().data(), table_->GetDvWeights().data(), 0,
        table_->GetNumStencils());
    for (std::size_t p = 0; p < out_.size(); ++p)
      set_normal(&derivatives_[6 * p], &derivatives_[6 * p + 3], out_[p]);
  }
  double evaluated() const override { return static_cast<double>(evaluated_); }

 private:
  // Each point of the mesh in the first face that has it.
  Far::LimitStencilTableFactory::LocationArrayVec locations(int depth) {
    const auto& base = mesh_.refiner().GetLevel(0);
    const int n = 1 << depth, sides = mesh_.corners();
    std::vector<char> vertex_done(mesh_.vertices()), edge_done(static_cast<std::size_t>(base.GetNumEdges()));
    Far::LimitStencilTableFactory::LocationArrayVec arrays;
    for (int f = 0; f < base.GetNumFaces(); ++f) {
      const auto corners = base.GetFaceVertices(f);
      const auto edges = base.GetFaceEdges(f);  // edge k from corner k to corner k+1
      auto& s = s_.emplace_back();
      auto& t = t_.emplace_back();
      for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= (sides == 3 ? n - j : n); ++i) {
          const std::array<bool, 4> on{j == 0, sides == 3 ? i + j == n : i == n, sides == 3 ? i == 0 : j == n,
                                       sides == 4 && i == 0};
          int corner = -1, edge = -1;
          for (int k = sides - 1; k >= 0; --k) {
            if (on[k]) edge = k;
            if (on[k] && on[(k + sides - 1) % sides]) corner = k;
          }
          if (corner >= 0 ? vertex_done[corners[corner]] : edge >= 0 && edge_done[edges[edge]]) continue;
          s.push_back(static_cast<float>(i) / static_cast<float>(n));
          t.push_back(static_cast<float>(j) / static_cast<float>(n));
        }
      }
      for (int k = 0; k < sides; ++k) {
        vertex_done[corners[k]] = 1;
        edge_done[edges[k]] = 1;
      }
      Far::LimitStencilTableFactory::LocationArray array;
      array.ptexIdx = f;
      array.numLocations = static_cast<int>(s.size());
      array.s = s.data();
      array.t = t.data();
      arrays.push_back(array);
    }
    return arrays;
  }

  OpenSubdivMesh mesh_;
  std::vector<std::vector<float>> s_, t_;
  std::unique_ptr<const Far::LimitStencilTable> table_;
  std::size_t evaluated_ = 0;
  std::vector<LimitPoint> out_;
  std::vector<float> derivatives_;  // du dv of each point
};

}  // namespace

Route far_uniform() {
  return {"far/uniform", "OpenSubdiv Far, refined uniformly, limit masks", 500, 700, false, maker<Uniform>()};
}

Route far_limit_stencils() {
  return {"far/limit-stencils",  "OpenSubdiv Far, table of limit stencils, CpuEvaluator", 1200, 400, false,
          maker<LimitStencils>()};
}

}  // namespace limitcheck::bench
