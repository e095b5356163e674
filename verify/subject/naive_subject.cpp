// SPDX-License-Identifier: MIT
// The recursive subdivider of the paper's section 4 (reference/naive.h) in double. It sends single triangles;
// corners of one face that agree in place, position and normal, bit for bit, become one vertex, so that
// nothing it says is lost. Faces share no vertices. [C18]
//
//   options   weights=loop|warren (default loop)
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "reference/naive.h"
#include "verify/subject/adapter.h"
#include "verify/subject/control_mesh.h"
#include "verify/subject/faces_in_parallel.h"
#include "verify/subject/registry.h"
#include "verify/subject/weights_option.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;
using Corner = reference::LeafCorner<double>;

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

// -0 and +0 are told apart, NaN equals itself.
bool same_bits(const reference::Vec3<double>& a, const reference::Vec3<double>& b) {
  const auto same = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

// The vertices and triangles of one face.
struct Face {
  std::vector<Corner> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices into vertices

  Face(const reference::NaiveSubdivider<double>& subdivider, std::int64_t face, int depth) {
    const std::size_t row = (std::size_t{1} << depth) + 1;
    // The first vertex at each lattice point, and after each vertex the next at the same point.
    std::vector<std::uint32_t> first(row * row, kNone);
    std::vector<std::uint32_t> next;
    vertices.reserve(row * (row + 1) / 2);
    next.reserve(vertices.capacity());
    triangles.reserve(std::size_t{1} << (2 * depth));
    subdivider.tessellate(
        static_cast<std::size_t>(face), depth, [&](const reference::LeafTriangle<double>& leaf) {
          auto& triangle = triangles.emplace_back();
          for (std::size_t k = 0; k < 3; ++k) {
            const Corner& corner = leaf[k];
            std::uint32_t* link =
                &first[static_cast<std::size_t>(corner.i) * row + static_cast<std::size_t>(corner.j)];
            while (*link != kNone && !(same_bits(vertices[*link].position, corner.position) &&
                                       same_bits(vertices[*link].normal, corner.normal))) {
              link = &next[*link];
            }
            triangle[k] = *link;
            if (*link != kNone) continue;
            triangle[k] = *link = static_cast<std::uint32_t>(vertices.size());
            vertices.push_back(corner);
            next.push_back(kNone);  // `link` may point into it: not used from here on
          }
        });
  }
};

class NaiveSubject {
 public:
  static lc_capabilities capabilities(Options& options) {
    return {LC_FLOAT64, weights_option(options), LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 10, 1, 1, 1};
  }

  NaiveSubject(const lc_mesh& mesh, Options& options)
      : subdivider_(control_mesh(mesh), family(weights_option(options))) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const auto count = static_cast<std::int64_t>(subdivider_.face_count());
    const std::span depth(request.face_depth, subdivider_.face_count());

    // How many vertices a face has is known when it is done: all faces first, then the arrays.
    std::vector<std::unique_ptr<const Face>> faces(subdivider_.face_count());
    faces_in_parallel(count, request.threads, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t f = begin; f < end; ++f) {
        const auto k = static_cast<std::size_t>(f);
        if (depth[k] >= 0) faces[k] = std::make_unique<Face>(subdivider_, f, depth[k]);
      }
    });
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
  const reference::NaiveSubdivider<double> subdivider_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_naive() {
  static const lc_subject subject = make_subject<NaiveSubject>(
      "naive", "our own recursive subdivider, as the paper's section 4 lists it, in double",
      "weights=loop|warren (default loop)");
  return &subject;
}
