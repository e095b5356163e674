// SPDX-License-Identifier: MIT
// Embree's interpolation of a subdivision geometry: all points of a face in one call.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "bench/contenders/contender.h"
#include "bench/contenders/pool.h"

namespace limitcheck::bench {

namespace {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};

/// The scene, which joins the faces, is made once; then rtcInterpolateN with first derivatives, and their
/// product brought to length.
class Interpolation final : public Contender {
 public:
  Interpolation(const data::ControlMesh& mesh, int depth, int threads)
      : faces_(mesh.faces.size()),
        threads_(threads),
        side_((std::size_t{1} << depth) + 1),
        out_(6 * faces_ * side_ * side_) {
    device_.reset(rtcNewDevice("threads=1"));
    if (device_ == nullptr) throw std::runtime_error("Embree makes no device");
    geometry_.reset(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SUBDIVISION));
    auto* position =
        buffer<float>(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 4 * sizeof(float), mesh.positions.size());
    for (const auto& p : mesh.positions) {
      for (const double x : p) *position++ = static_cast<float>(x);
      *position++ = 0;  // a vertex is read as 16 bytes
    }
    const auto corners = mesh.faces.corners();
    std::copy(
        corners.begin(), corners.end(),
        buffer<std::uint32_t>(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, sizeof(std::uint32_t), corners.size()));
    std::fill_n(buffer<std::uint32_t>(RTC_BUFFER_TYPE_FACE, RTC_FORMAT_UINT, sizeof(std::uint32_t), faces_),
                faces_, 4U);
    rtcSetGeometrySubdivisionMode(geometry_.get(), 0, RTC_SUBDIVISION_MODE_SMOOTH_BOUNDARY);
    rtcCommitGeometry(geometry_.get());
    scene_.reset(rtcNewScene(device_.get()));
    rtcAttachGeometry(scene_.get(), geometry_.get());
    rtcCommitScene(scene_.get());
    for (std::size_t j = 0; j < side_; ++j)
      for (std::size_t i = 0; i < side_; ++i) {
        u_.push_back(static_cast<float>(i) / static_cast<float>(side_ - 1));
        v_.push_back(static_cast<float>(j) / static_cast<float>(side_ - 1));
      }
  }

  void run() override {
    in_parallel(faces_, threads_, [&](std::size_t first, std::size_t last) {
      auto work = pool_.take([] { return std::make_unique<Work>(); });
      for (std::size_t face = first; face < last; ++face) evaluate(face, *work);
      pool_.give(std::move(work));
    });
    benchmark::ClobberMemory();
  }
  double evaluated() const override { return static_cast<double>(faces_ * u_.size()); }

 private:
  struct Work {
    std::vector<unsigned> face;
    std::vector<float> position, du, dv;
  };

  template <class T>
  T* buffer(RTCBufferType type, RTCFormat format, std::size_t stride, std::size_t count) {
    void* memory = rtcSetNewGeometryBuffer(geometry_.get(), type, 0, format, stride, count);
    if (memory == nullptr) throw std::runtime_error("Embree makes no buffer");
    return static_cast<T*>(memory);
  }

  void evaluate(std::size_t face, Work& work) {
    const std::size_t n = u_.size();
    work.face.assign(n, static_cast<unsigned>(face));
    for (auto* values : {&work.position, &work.du, &work.dv}) values->resize(3 * n);
    RTCInterpolateNArguments a{};
    a.geometry = geometry_.get();
    a.primIDs = work.face.data();
    a.u = u_.data();
    a.v = v_.data();
    a.N = static_cast<unsigned>(n);
    a.bufferType = RTC_BUFFER_TYPE_VERTEX;
    a.P = work.position.data();
    a.dPdu = work.du.data();
    a.dPdv = work.dv.data();
    a.valueCount = 3;
    rtcInterpolateN(&a);
    float* out = out_.data() + 6 * n * face;
    const float *p = work.position.data(), *du = work.du.data(), *dv = work.dv.data();
    for (std::size_t k = 0; k < n; ++k, out += 6) {
      const float x = du[n + k] * dv[2 * n + k] - du[2 * n + k] * dv[n + k],
                  y = du[2 * n + k] * dv[k] - du[k] * dv[2 * n + k],
                  z = du[k] * dv[n + k] - du[n + k] * dv[k];
      const float scale = 1 / std::sqrt(x * x + y * y + z * z);
      out[0] = p[k], out[1] = p[n + k], out[2] = p[2 * n + k];
      out[3] = x * scale, out[4] = y * scale, out[5] = z * scale;
    }
  }

  std::size_t faces_;
  int threads_;
  std::size_t side_;
  std::vector<float> u_, v_, out_;
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCGeometryTy, Release> geometry_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
  Pool<Work> pool_;
};

}  // namespace

Route embree_interpolation() {
  return {"embree/interpolate",
          "Embree 3 rtcInterpolateN, a face in one call, float: no accuracy is promised",
          400,
          24,
          true,
          [](const auto& mesh, int depth, int threads) {
            return std::make_unique<Interpolation>(mesh, depth, threads);
          }};
}

}  // namespace limitcheck::bench
