// SPDX-License-Identifier: MIT
// A control mesh as Embree takes it. Private to what adapts Embree.
//
// Debian's build asserts, and an assertion ends the process: on the fourth float of a vertex, which it
// reads as 16 bytes. So vertices are padded.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "verify/subject/adapter.h"

namespace limitcheck::verify {

class EmbreeGeometry {
 public:
  /// Positions and faces alone.
  explicit EmbreeGeometry(const lc_mesh& mesh) : device_(rtcNewDevice("threads=1")) {
    if (device_ == nullptr) throw SubjectError(LC_FAILED, "Embree makes no device");
    geometry_.reset(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SUBDIVISION));
    auto* const position =
        buffer<std::array<float, 4>>(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertex_count);
    for (std::int64_t v = 0; v < mesh.vertex_count; ++v) {
      position[v] = {};
      std::copy_n(mesh.positions + 3 * v, 3, position[v].begin());
    }
    std::copy_n(mesh.corners, mesh.corner_count,
                buffer<std::uint32_t>(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, mesh.corner_count));
    std::copy_n(mesh.face_sizes, mesh.face_count,
                buffer<std::uint32_t>(RTC_BUFFER_TYPE_FACE, RTC_FORMAT_UINT, mesh.face_count));
  }
  template <class T>
  T* buffer(RTCBufferType type, RTCFormat format, std::int64_t count, unsigned slot = 0) {
    void* const memory = rtcSetNewGeometryBuffer(geometry_.get(), type, slot, format, sizeof(T),
                                                 static_cast<std::size_t>(count));
    if (memory == nullptr) throw SubjectError(LC_FAILED, "Embree makes no buffer");
    return static_cast<T*>(memory);
  }
  /// Makes the geometry ready for evaluation: Embree joins the faces when a scene is committed.
  void commit() {
    rtcCommitGeometry(geometry_.get());
    scene_.reset(rtcNewScene(device_.get()));
    rtcAttachGeometry(scene_.get(), geometry_.get());
    rtcCommitScene(scene_.get());
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE)
      throw SubjectError(LC_FAILED, "Embree reports error " + std::to_string(error));
  }
  RTCGeometry get() const { return geometry_.get(); }

 private:
  template <auto release>
  struct Release {
    void operator()(auto* of) const { release(of); }
  };
  std::unique_ptr<RTCDeviceTy, Release<rtcReleaseDevice>> device_;
  std::unique_ptr<RTCGeometryTy, Release<rtcReleaseGeometry>> geometry_;
  std::unique_ptr<RTCSceneTy, Release<rtcReleaseScene>> scene_;
};

}  // namespace limitcheck::verify
