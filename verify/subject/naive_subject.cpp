// SPDX-License-Identifier: MIT
// The recursive subdivider of the paper's section 4 (reference/loop/naive.h) in double. It delivers single
// triangles and rounds differently in each. Of the values of one point the first in the order of their bits
// is taken, so that neither the triangles of a face nor faces of one depth have cracks of one ulp. Faces
// share no vertices. [C18]
//
//   options   weights=loop|warren (default loop)
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "reference/loop/naive.h"
#include "verify/subject/adapter.h"
#include "verify/subject/control_mesh.h"
#include "verify/subject/face_domain.h"
#include "verify/subject/faces_in_parallel.h"
#include "verify/subject/registry.h"
#include "verify/subject/weights_option.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;
using Corner = reference::LeafCorner<double>;

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

// In the order of their bits.
bool before(const reference::Vec3<double>& a, const reference::Vec3<double>& b) {
  const auto bits = [](const reference::Vec3<double>& p) {
    return std::array{std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y),
                      std::bit_cast<std::uint64_t>(p.z)};
  };
  return bits(a) < bits(b);
}

// Puts the lesser of both, by their bits, in place of the first.
void agree(Corner& a, const Corner& b) {
  if (before(b.position, a.position)) a.position = b.position;
  if (before(b.normal, a.normal)) a.normal = b.normal;
}

// The vertices, one for each lattice point, and the triangles of one face.
struct Face {
  std::vector<Corner> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices into vertices

  Face(const reference::NaiveSubdivider<double>& subdivider, std::int64_t face, int depth) {
    const std::size_t row = (std::size_t{1} << depth) + 1;
    std::vector<std::uint32_t> vertex(row * row, kNone);
    vertices.reserve(row * (row + 1) / 2);
    triangles.reserve(std::size_t{1} << (2 * depth));
    subdivider.tessellate(
        static_cast<std::size_t>(face), depth, [&](const reference::LeafTriangle<double>& leaf) {
          auto& triangle = triangles.emplace_back();
          for (std::size_t k = 0; k < 3; ++k) {
            const Corner& corner = leaf[k];
            std::uint32_t& at =
                vertex[static_cast<std::size_t>(corner.i) * row + static_cast<std::size_t>(corner.j)];
            if (at == kNone) {
              at = static_cast<std::uint32_t>(vertices.size());
              vertices.push_back(corner);
            }
            agree(vertices[at], corner);
            triangle[k] = at;
          }
        });
  }
};

// A point on a control edge: its ends, the smaller number first, and the way from there in 2^-31 of it. A
// control vertex is both ends of its edge.
using BorderPoint = std::array<std::int64_t, 3>;

// Sets `point` and returns true, or returns false for a point inside the face.
bool on_border(const std::array<std::int32_t, 3>& face, const Corner& corner, int depth, BorderPoint& point) {
  const std::int64_t n = std::int64_t{1} << depth, unit = std::int64_t{1} << (31 - depth);
  const auto place = FaceDomain().side_of({corner.i, corner.j}, n);
  if (!place) return false;
  std::int64_t a = face[place->side], b = face[FaceDomain().next(place->side)], way = place->along;
  if (way == 0) b = a;
  if (a > b) std::swap(a, b), way = n - way;
  point = {a, b, way * unit};
  return true;
}

class NaiveSubject {
 public:
  static lc_capabilities capabilities(Options& options) {
    return {LC_FLOAT64, weights_option(options), LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 10, 1, 1, 1};
  }

  NaiveSubject(const lc_mesh& mesh, Options& options)
      : mesh_(control_mesh(mesh)), subdivider_(mesh_, family(weights_option(options))) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const auto count = static_cast<std::int64_t>(subdivider_.face_count());
    const std::span depth(request.face_depth, subdivider_.face_count());

    // The number of vertices of a face is known only when it is done, so all faces come first, then the
    // arrays.
    std::vector<std::unique_ptr<Face>> faces(subdivider_.face_count());
    faces_in_parallel(count, request.threads, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t f = begin; f < end; ++f) {
        const auto k = static_cast<std::size_t>(f);
        if (depth[k] >= 0) faces[k] = std::make_unique<Face>(subdivider_, f, depth[k]);
      }
    });
    agree_on_borders(faces, depth);
    std::int64_t vertices = 0, triangles = 0;
    for (const auto& face : faces) {
      if (face == nullptr) continue;
      vertices += static_cast<std::int64_t>(face->vertices.size());
      triangles += static_cast<std::int64_t>(face->triangles.size());
    }
    const auto output = allocate_output<double>(request, out, vertices, triangles, /*normals=*/true);

    std::int64_t v = 0, t = 0;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      if (faces[k] == nullptr) continue;
      const auto face = static_cast<std::int32_t>(k);
      const auto base = static_cast<std::uint32_t>(v);
      for (const Corner& corner : faces[k]->vertices) {
        const auto& [position, normal] = std::tie(corner.position, corner.normal);
        for (std::int64_t c = 0; const double x : {position.x, position.y, position.z})
          output.positions[3 * v + c++] = x;
        for (std::int64_t c = 0; const double x : {normal.x, normal.y, normal.z})
          output.normals[3 * v + c++] = x;
        output.provenance[v++] = {face, static_cast<std::uint32_t>(corner.i),
                                  static_cast<std::uint32_t>(corner.j), std::uint32_t{1} << depth[k]};
      }
      for (const auto& triangle : faces[k]->triangles) {
        for (std::int64_t c = 0; const std::uint32_t corner : triangle)
          output.triangles[3 * t + c++] = base + corner;
        output.triangle_face[t++] = face;
      }
      faces[k].reset();
    }
  }

 private:
  // Position and normal of each point on control edges, whatever the order of faces.
  void agree_on_borders(std::vector<std::unique_ptr<Face>>& faces,
                        std::span<const std::int32_t> depth) const {
    const auto each = [&](const auto& body) {
      BorderPoint point{};
      for (std::size_t f = 0; f < faces.size(); ++f)
        if (faces[f] != nullptr)
          for (Corner& corner : faces[f]->vertices)
            if (on_border(triangles_of(mesh_)[f], corner, depth[f], point)) body(point, corner);
    };
    std::map<BorderPoint, Corner> chosen;
    each([&](const BorderPoint& point, const Corner& corner) {
      agree(chosen.try_emplace(point, corner).first->second, corner);
    });
    each([&](const BorderPoint& point, Corner& corner) {
      corner.position = chosen.at(point).position;
      corner.normal = chosen.at(point).normal;
    });
  }

  const data::ControlMesh mesh_;
  const reference::NaiveSubdivider<double> subdivider_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_naive() {
  static const lc_subject subject = make_subject<NaiveSubject>(
      "naive", "our own recursive subdivider, as the paper's section 4 lists it, in double",
      "weights=loop|warren (default loop)");
  return &subject;
}
