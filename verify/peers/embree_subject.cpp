// SPDX-License-Identifier: MIT
// Embree: rtcInterpolate on a subdivision geometry, a limit surface of Catmull-Clark's in float with its
// first derivatives. Its documentation promises no accuracy; verify/subject/README.md says what was
// measured.
//
// Debian's build asserts, and an assertion ends the process: on the fourth float of a vertex, which it
// reads as 16 bytes, and on the sizes of its arrays. So vertices are padded, and what it has no room for is
// refused.
//
// Sharp edges and vertices: an infinite sharpness is an infinite float. There is no choice of creasing: where
// two sharp edges meet sharpness falls by Chaikin's rule, elsewhere by 1. We ask for it as uniform, which it
// is for creases of one sharpness. There is no other rule for triangles.
#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "data/sharpness.h"
#include "verify/peers/evaluated_faces.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;

template <auto release>
struct Release {
  void operator()(auto* of) const { release(of); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release<rtcReleaseDevice>>;
using Scene = std::unique_ptr<RTCSceneTy, Release<rtcReleaseScene>>;
using Geometry = std::unique_ptr<RTCGeometryTy, Release<rtcReleaseGeometry>>;

// One face after another.
class FaceOfGeometry {
 public:
  FaceOfGeometry(RTCGeometry geometry, const std::int32_t* sizes) : geometry_(geometry), sizes_(sizes) {}
  void begin(std::int32_t face) { face_ = face; }
  // A face that is no quad has its parts in a square of squares of two units, four to a row, each from 1/2
  // to 3/2.
  void evaluate(std::int32_t part, const float* uv, float* position, float* du, float* dv) const {
    const bool whole = sizes_[face_] == 4;
    const float u = whole ? uv[0] : 2 * static_cast<float>(part % 4) + 0.5F + uv[0];
    const float v = whole ? uv[1] : 2 * static_cast<float>(part / 4) + 0.5F + uv[1];
    rtcInterpolate1(geometry_, static_cast<unsigned>(face_), u, v, RTC_BUFFER_TYPE_VERTEX, 0, position, du,
                    dv, 3);
  }

 private:
  RTCGeometry geometry_;
  const std::int32_t* sizes_;
  std::int32_t face_ = 0;
};

class EmbreeSubject {
 public:
  static constexpr std::int32_t kSchemes = LC_DOES_CATMULL_CLARK;
  static constexpr std::int32_t kSharp = LC_SHARP_CREASES | LC_SHARP_SEMI | LC_SHARP_CORNERS;
  static constexpr bool kTakesAnyEdge = true;  // a fault of its own (verify/peers/findings)

  static lc_capabilities capabilities(Options&, lc_scheme) {
    return {LC_FLOAT32, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 10, 1, 1, 0};
  }

  EmbreeSubject(const lc_mesh& mesh, Options&) : mesh_(mesh) {
    refuse_beyond_its_arrays();
    device_.reset(rtcNewDevice("threads=1"));
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
    hand_over_sharpness();
    rtcSetGeometrySubdivisionMode(
        geometry_.get(), 0,
        mesh.corners_held != 0 ? RTC_SUBDIVISION_MODE_PIN_CORNERS : RTC_SUBDIVISION_MODE_SMOOTH_BOUNDARY);
    rtcCommitGeometry(geometry_.get());
    // It joins the faces when a scene is committed.
    scene_.reset(rtcNewScene(device_.get()));
    rtcAttachGeometry(scene_.get(), geometry_.get());
    rtcCommitScene(scene_.get());
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE)
      throw SubjectError(LC_FAILED, "Embree reports error " + std::to_string(error));
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const FacePatterns patterns(mesh_, request, [](int) { return FacePattern{}; });
    tessellate_faces<float>(mesh_, patterns, request, out,
                            [&] { return FaceOfGeometry(geometry_.get(), mesh_.face_sizes); });
  }

 private:
  template <class T>
  T* buffer(RTCBufferType type, RTCFormat format, std::int64_t count) {
    void* const memory =
        rtcSetNewGeometryBuffer(geometry_.get(), type, 0, format, sizeof(T), static_cast<std::size_t>(count));
    if (memory == nullptr) throw SubjectError(LC_FAILED, "Embree makes no buffer");
    return static_cast<T*>(memory);
  }

  void hand_over_sharpness() {
    const auto weight = [](const auto& tag) {
      return tag.sharpness >= limitcheck::data::kInfiniteSharpness ? std::numeric_limits<float>::infinity()
                                                                   : tag.sharpness;
    };
    if (const std::int64_t count = mesh_.sharp_edge_count; count > 0) {
      const lc_sharp_edge* const edges = mesh_.sharp_edges;
      std::transform(
          edges, edges + count,
          buffer<std::array<std::uint32_t, 2>>(RTC_BUFFER_TYPE_EDGE_CREASE_INDEX, RTC_FORMAT_UINT2, count),
          [](const lc_sharp_edge& e) {
            return std::array{static_cast<std::uint32_t>(e.a), static_cast<std::uint32_t>(e.b)};
          });
      std::transform(edges, edges + count,
                     buffer<float>(RTC_BUFFER_TYPE_EDGE_CREASE_WEIGHT, RTC_FORMAT_FLOAT, count), weight);
    }
    if (const std::int64_t count = mesh_.sharp_vertex_count; count > 0) {
      const lc_sharp_vertex* const vertices = mesh_.sharp_vertices;
      std::transform(vertices, vertices + count,
                     buffer<std::uint32_t>(RTC_BUFFER_TYPE_VERTEX_CREASE_INDEX, RTC_FORMAT_UINT, count),
                     [](const lc_sharp_vertex& v) { return static_cast<std::uint32_t>(v.vertex); });
      std::transform(vertices, vertices + count,
                     buffer<float>(RTC_BUFFER_TYPE_VERTEX_CREASE_WEIGHT, RTC_FORMAT_FLOAT, count), weight);
    }
  }

  // Its rings are arrays of 64 faces and 128 points; Debian's library asserts that they suffice. A face of n
  // corners adds n - 2 points, and the boundary one more and a face with a point that stand for the outside.
  void refuse_beyond_its_arrays() const {
    constexpr int kMostCorners = 15, kMostFaces = 64, kMostPoints = 128;
    struct Ring {
      int faces = 0, points = 0;
      std::set<std::int32_t> neighbours = {};
    };
    std::vector<Ring> rings(static_cast<std::size_t>(mesh_.vertex_count));
    for (std::int64_t f = 0, first = 0; f < mesh_.face_count; first += mesh_.face_sizes[f++]) {
      const int n = mesh_.face_sizes[f];
      if (n > kMostCorners)
        throw SubjectError(LC_NOT_SUPPORTED, "Embree has no faces of more than 15 corners");
      for (int k = 0; k < n; ++k) {
        Ring& ring = rings[static_cast<std::size_t>(mesh_.corners[first + k])];
        ring.faces += 1, ring.points += n - 2;
        ring.neighbours.insert({mesh_.corners[first + (k + 1) % n], mesh_.corners[first + (k + n - 1) % n]});
      }
    }
    for (Ring& ring : rings) {
      if (std::ssize(ring.neighbours) > ring.faces) ring.faces += 1, ring.points += 2;  // on the boundary
      if (ring.faces > kMostFaces || ring.points > kMostPoints)
        throw SubjectError(
            LC_NOT_SUPPORTED,
            "Embree has no rings of more than 64 faces, with one for the boundary, or 128 points");
    }
  }

  const lc_mesh mesh_;
  Device device_;
  Geometry geometry_;
  Scene scene_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_embree() {
  static const lc_subject subject = make_subject<EmbreeSubject>(
      "embree", "Embree 3 rtcInterpolate: Catmull-Clark's limit surface in float, evaluated");
  return &subject;
}
