// SPDX-License-Identifier: MIT
// Embree's interpolation of a subdivision geometry: point by point.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

#include "bench/contenders/contender.h"
#include "data/scheme.h"
#include "verify/peers/embree_geometry.h"
#include "verify/subject/lent_mesh.h"

namespace limitcheck::bench {

namespace {

/// The scene, which joins the faces, is made once; then rtcInterpolate with first derivatives, and their
/// product brought to length.
class Interpolation final : public Contender {
 public:
  Interpolation(const data::ControlMesh& mesh, int depth, int threads)
      : faces_(mesh.faces.size()),
        threads_(threads),
        side_((std::size_t{1} << depth) + 1),
        out_(faces_ * side_ * side_),
        geometry_(verify::LentMesh(mesh, data::Scheme::kCatmullClark).view()) {
    geometry_.commit();
    for (std::size_t j = 0; j < side_; ++j)
      for (std::size_t i = 0; i < side_; ++i) {
        u_.push_back(static_cast<float>(i) / static_cast<float>(side_ - 1));
        v_.push_back(static_cast<float>(j) / static_cast<float>(side_ - 1));
      }
  }

  void run() override {
    in_parallel(faces_, threads_, [&](std::size_t first, std::size_t last) {
      for (std::size_t face = first; face < last; ++face) evaluate(face);
    });
    benchmark::ClobberMemory();
  }
  double evaluated() const override { return static_cast<double>(faces_ * u_.size()); }

 private:
  // Point by point: rtcInterpolateN of Debian's 3.13 ends with a segmentation fault here.
  void evaluate(std::size_t face) {
    const std::size_t n = u_.size();
    LimitPoint* out = out_.data() + n * face;
    for (std::size_t k = 0; k < n; ++k, ++out) {
      float du[3], dv[3];
      rtcInterpolate1(geometry_.get(), static_cast<unsigned>(face), u_[k], v_[k], RTC_BUFFER_TYPE_VERTEX, 0,
                      out->position, du, dv, 3);
      set_normal(du, dv, *out);
    }
  }

  std::size_t faces_;
  int threads_;
  std::size_t side_;
  std::vector<float> u_, v_;
  std::vector<LimitPoint> out_;
  verify::EmbreeGeometry geometry_;
};

}  // namespace

Route embree_interpolation() {
  return {"embree/interpolate",  "Embree 3 rtcInterpolate, float: no accuracy is promised", 400, 24, true,
          maker<Interpolation>()};
}

}  // namespace limitcheck::bench
