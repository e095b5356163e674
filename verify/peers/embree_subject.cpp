// SPDX-License-Identifier: MIT
// Embree: rtcInterpolate on a subdivision geometry, a limit surface of Catmull-Clark's in float with its
// first derivatives. Its documentation promises no accuracy; verify/subject/README.md says what was
// measured.
//
// Debian's build asserts on the sizes of its arrays, too (verify/peers/embree_geometry.h): what it has no room for is
// refused.
//
// Sharp edges and vertices: an infinite sharpness is an infinite float. There is no choice of creasing: where
// two sharp edges meet sharpness falls by Chaikin's rule, elsewhere by 1. We ask for it as uniform, which it
// is for creases of one sharpness. There is no other rule for triangles.
//
// Channels are attributes with topologies of their own, whose modes are four of the six rules: corners-plus1 and
// corners-plus2 it does not have.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "data/sharpness.h"
#include "verify/peers/embree_geometry.h"
#include "verify/peers/evaluated_faces.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck::verify;

// One face after another.
class FaceOfGeometry {
 public:
  FaceOfGeometry(RTCGeometry geometry, const lc_mesh& mesh) : geometry_(geometry), mesh_(mesh) {}
  void begin(std::int32_t face) { face_ = face; }
  void evaluate(std::int32_t part, const float* uv, float* position, float* du, float* dv) const {
    const auto [u, v] = at(part, uv);
    rtcInterpolate1(geometry_, static_cast<unsigned>(face_), u, v, RTC_BUFFER_TYPE_VERTEX, 0, position, du,
                    dv, 3);
  }
  void channel(std::size_t number, std::int32_t part, const float* uv, float* value) const {
    const auto [u, v] = at(part, uv);
    rtcInterpolate0(geometry_, static_cast<unsigned>(face_), u, v, RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE,
                    static_cast<unsigned>(number), value,
                    static_cast<unsigned>(mesh_.channels[number].components));
  }

 private:
  // A face that is no quad has its parts in a square of squares of two units, four to a row, each from 1/2
  // to 3/2.
  std::array<float, 2> at(std::int32_t part, const float* uv) const {
    if (mesh_.face_sizes[face_] == 4) return {uv[0], uv[1]};
    return {2 * static_cast<float>(part % 4) + 0.5F + uv[0], 2 * static_cast<float>(part / 4) + 0.5F + uv[1]};
  }

  RTCGeometry geometry_;
  const lc_mesh& mesh_;
  std::int32_t face_ = 0;
};

class EmbreeSubject {
 public:
  static constexpr std::int32_t kSchemes = LC_DOES_CATMULL_CLARK;
  static constexpr std::int32_t kSharp = LC_SHARP_CREASES | LC_SHARP_SEMI | LC_SHARP_CORNERS;
  static constexpr bool kTakesAnyEdge = true;  // a fault of its own (verify/peers/findings)

  static lc_capabilities capabilities(Options&, lc_scheme) {
    lc_capabilities result{LC_FLOAT32, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 10, 1, 1, 0};
    result.channel_rules = 1 << LC_CHANNEL_NONE | 1 << LC_CHANNEL_CORNERS_ONLY | 1 << LC_CHANNEL_BOUNDARIES |
                           1 << LC_CHANNEL_ALL;
    return result;
  }

  EmbreeSubject(const lc_mesh& mesh, Options&)
      : EmbreeSubject(mesh, rings_of(mesh, mesh.corners, mesh.vertex_count)) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const FacePatterns patterns(mesh_, request, [](int) { return FacePattern{}; });
    tessellate_faces<float>(mesh_, patterns, request, out,
                            [&] { return FaceOfGeometry(geometry_.get(), mesh_); });
  }

 private:
  struct Ring {
    int faces = 0, points = 0;
    std::set<std::int32_t> neighbours = {};
  };

  EmbreeSubject(const lc_mesh& mesh, const std::vector<Ring>& rings) : mesh_(mesh), geometry_(mesh) {
    hand_over_sharpness(rings);
    rtcSetGeometryTopologyCount(geometry_.get(), 1 + static_cast<unsigned>(mesh.channel_count));
    rtcSetGeometryVertexAttributeCount(geometry_.get(), static_cast<unsigned>(mesh.channel_count));
    for (unsigned c = 0; c < mesh.channel_count; ++c) hand_over_channel(c);
    geometry_.commit();
  }

  // Its mode PIN_CORNERS holds boundary vertices of one face in one topology; sharp vertices are those of all.
  void hand_over_sharpness(const std::vector<Ring>& rings) {
    constexpr float kHeld = std::numeric_limits<float>::infinity();
    const auto weight = [](const auto& tag) {
      return tag.sharpness >= limitcheck::data::kInfiniteSharpness ? kHeld : tag.sharpness;
    };
    if (const std::int64_t count = mesh_.sharp_edge_count; count > 0) {
      const lc_sharp_edge* const edges = mesh_.sharp_edges;
      std::transform(edges, edges + count,
                     geometry_.buffer<std::array<std::uint32_t, 2>>(RTC_BUFFER_TYPE_EDGE_CREASE_INDEX,
                                                                    RTC_FORMAT_UINT2, count),
                     [](const lc_sharp_edge& e) {
                       return std::array{static_cast<std::uint32_t>(e.a), static_cast<std::uint32_t>(e.b)};
                     });
      std::transform(edges, edges + count,
                     geometry_.buffer<float>(RTC_BUFFER_TYPE_EDGE_CREASE_WEIGHT, RTC_FORMAT_FLOAT, count),
                     weight);
    }
    std::map<std::uint32_t, float> vertices;
    for (std::int64_t k = 0; k < mesh_.sharp_vertex_count; ++k)
      vertices[static_cast<std::uint32_t>(mesh_.sharp_vertices[k].vertex)] = weight(mesh_.sharp_vertices[k]);
    for (std::uint32_t v = 0; mesh_.corners_held != 0 && v < rings.size(); ++v)
      if (rings[v].faces == 1) vertices[v] = kHeld;
    if (vertices.empty()) return;
    const auto count = std::ssize(vertices);
    auto* at = geometry_.buffer<std::uint32_t>(RTC_BUFFER_TYPE_VERTEX_CREASE_INDEX, RTC_FORMAT_UINT, count);
    auto* by = geometry_.buffer<float>(RTC_BUFFER_TYPE_VERTEX_CREASE_WEIGHT, RTC_FORMAT_FLOAT, count);
    for (const auto& [v, sharpness] : vertices) *at++ = v, *by++ = sharpness;
  }

  // An attribute on a topology of its own, whose vertices are the values: pairs of a vertex and an index.
  void hand_over_channel(unsigned number) {
    const lc_channel& channel = mesh_.channels[number];
    std::map<std::array<std::int32_t, 2>, std::int32_t> values;
    std::vector<std::int32_t> corners;
    for (std::int64_t k = 0; k < mesh_.corner_count; ++k)
      corners.push_back(
          values.try_emplace({mesh_.corners[k], channel.corners[k]}, static_cast<std::int32_t>(values.size()))
              .first->second);
    (void)rings_of(mesh_, corners.data(), std::ssize(values));
    std::copy(corners.begin(), corners.end(),
              geometry_.buffer<std::int32_t>(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, mesh_.corner_count,
                                             number + 1));
    auto* const to = geometry_.buffer<std::array<float, 4>>(RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE,
                                                            RTC_FORMAT_FLOAT4, std::ssize(values), number);
    for (const auto& [at, value] : values) {
      to[value] = {};
      std::copy_n(channel.values + std::int64_t{at[1]} * channel.components, channel.components,
                  to[value].begin());
    }
    rtcSetGeometryVertexAttributeTopology(geometry_.get(), number, number + 1);
    rtcSetGeometrySubdivisionMode(geometry_.get(), number + 1, mode_of(channel.rule));
  }
  static RTCSubdivisionMode mode_of(lc_channel_rule rule) {
    if (rule == LC_CHANNEL_NONE) return RTC_SUBDIVISION_MODE_SMOOTH_BOUNDARY;
    if (rule == LC_CHANNEL_CORNERS_ONLY) return RTC_SUBDIVISION_MODE_PIN_CORNERS;
    return rule == LC_CHANNEL_BOUNDARIES ? RTC_SUBDIVISION_MODE_PIN_BOUNDARY : RTC_SUBDIVISION_MODE_PIN_ALL;
  }

  // Its rings are arrays of 64 faces and 128 points; Debian's library asserts that they suffice. A face of n
  // corners adds n - 2 points, and the boundary one more and a face with a point that stand for the outside.
  static std::vector<Ring> rings_of(const lc_mesh& mesh, const std::int32_t* corners, std::int64_t vertices) {
    constexpr int kMostCorners = 15, kMostFaces = 64, kMostPoints = 128;
    std::vector<Ring> rings(static_cast<std::size_t>(vertices));
    for (std::int64_t f = 0; f < mesh.face_count; corners += mesh.face_sizes[f++]) {
      const int n = mesh.face_sizes[f];
      if (n > kMostCorners)
        throw SubjectError(LC_NOT_SUPPORTED, "Embree has no faces of more than 15 corners");
      for (int k = 0; k < n; ++k) {
        Ring& ring = rings[static_cast<std::size_t>(corners[k])];
        ring.faces += 1, ring.points += n - 2;
        ring.neighbours.insert({corners[(k + 1) % n], corners[(k + n - 1) % n]});
      }
    }
    for (const Ring& ring : rings) {
      const int outside = std::ssize(ring.neighbours) > ring.faces ? 1 : 0;  // on the boundary
      if (ring.faces + outside > kMostFaces || ring.points + 2 * outside > kMostPoints)
        throw SubjectError(
            LC_NOT_SUPPORTED,
            "Embree has no rings of more than 64 faces, with one for the boundary, or 128 points");
    }
    return rings;
  }

  const lc_mesh mesh_;
  EmbreeGeometry geometry_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_embree() {
  static const lc_subject subject = make_subject<EmbreeSubject>(
      "embree", "Embree 3 rtcInterpolate: Catmull-Clark's limit surface in float, evaluated");
  return &subject;
}
