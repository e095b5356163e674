// SPDX-License-Identifier: MIT
// Embree's interpolation of a subdivision geometry: point by point.
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

namespace limitcheck::bench {

namespace {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};

/// The scene, which joins the faces, is made once; then rtcInterpolate with first derivatives, and their
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
      for (std::size_t face = first; face < last; ++face) evaluate(face);
    });
    benchmark::ClobberMemory();
  }
  double evaluated() const override { return static_cast<double>(faces_ * u_.size()); }

 private:
  template <class T>
  T* buffer(RTCBufferType type, RTCFormat format, std::size_t stride, std::size_t count) {
    void* memory = rtcSetNewGeometryBuffer(geometry_.get(), type, 0, format, stride, count);
    if (memory == nullptr) throw std::runtime_error("Embree makes no buffer");
    return static_cast<T*>(memory);
  }

  // Point by point: rtcInterpolateN of Debian's 3.13 ends with a segmentation fault here.
  void evaluate(std::size_t face) {
    const std::size_t n = u_.size();
    float* out = out_.data() + 6 * n * face;
    for (std::size_t k = 0; k < n; ++k, out += 6) {
      alignas(16) float p[4], du[4], dv[4];
      RTCInterpolateArguments a{};
      a.geometry = geometry_.get();
      a.primID = static_cast<unsigned>(face);
      a.u = u_[k];
      a.v = v_[k];
      a.bufferType = RTC_BUFFER_TYPE_VERTEX;
      a.P = p;
      a.dPdu = du;
      a.dPdv = dv;
      a.valueCount = 3;
      rtcInterpolate(&a);
      const float x = du[1] * dv[2] - du[2] * dv[1], y = du[2] * dv[0] - du[0] * dv[2],
                  z = du[0] * dv[1] - du[1] * dv[0];
      const float scale = 1 / std::sqrt(x * x + y * y + z * z);
      out[0] = p[0], out[1] = p[1], out[2] = p[2];
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
};

}  // namespace

Route embree_interpolation() {
  return {"embree/interpolate",  "Embree 3 rtcInterpolate, float: no accuracy is promised", 400, 24, true,
          maker<Interpolation>()};
}

}  // namespace limitcheck::bench
