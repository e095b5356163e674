// SPDX-License-Identifier: MIT
// Shared by the subjects that ask a library for single points of its limit surface, face by face. Faces
// share no vertices. The normal is d/du x d/dv as evaluated, NaN where the library's derivatives are
// parallel or zero.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "verify/subject/adapter.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {

/// Calls body(begin, end) for ranges that make up [0, faces), on at most `threads` threads at a time; with
/// one thread, once and on the caller's. The ranges, and which thread takes which, are not determined: a body
/// writes only what depends on the face alone, to places that depend on the face alone.
template <class Body>
void faces_in_parallel(std::int64_t faces, int threads, const Body& body) {
  // More than oneTBB has would only earn a warning on standard error.
  using tbb::global_control;
  threads = std::min(threads,
                     static_cast<int>(global_control::active_value(global_control::max_allowed_parallelism)));
  if (threads <= 1) {
    body(std::int64_t{0}, faces);
    return;
  }
  tbb::task_arena(threads).execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, faces),
                      [&](const auto& range) { body(range.begin(), range.end()); });
  });
}

/// The points of one kind of face at one depth, and their triangles.
struct FacePattern {
  std::uint32_t denominator;
  std::vector<FaceDomain::Point> points;  // (i, j) over the denominator on their part
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Each lattice point of a face once; quads of the lattice are cut along the diagonal from (0, 0).
inline FacePattern lattice_pattern(data::Scheme scheme, int corners, int depth) {
  const FaceDomain domain(scheme, corners);
  const std::int64_t n = std::int64_t{1} << depth;
  FacePattern pattern;
  pattern.denominator = static_cast<std::uint32_t>(std::max<std::int64_t>(1, domain.denominator(n)));
  std::vector<std::uint32_t> number(static_cast<std::size_t>(domain.point_count(n)));
  const auto at = [&](FaceDomain::Point p) -> std::uint32_t& {
    return number[static_cast<std::size_t>(domain.number(p, n))];
  };
  domain.for_each_point(n, [&](FaceDomain::Point p) {
    at(p) = static_cast<std::uint32_t>(pattern.points.size());
    pattern.points.push_back(p);
  });
  domain.for_each_triangle(n, 1, [&](FaceDomain::Point a, FaceDomain::Point b, FaceDomain::Point c) {
    pattern.triangles.push_back({at(a), at(b), at(c)});
  });
  return pattern;
}

/// The pattern of each face of a request, made once for each kind of face and depth.
class FacePatterns {
 public:
  struct Face {
    const FacePattern* pattern;  // nullptr: culled
    std::int64_t first_vertex, first_triangle;
  };

  /// `triangle(depth)` makes that of Loop's triangles.
  template <class Triangle>
  FacePatterns(const lc_mesh& mesh, const lc_request& request, Triangle&& triangle) {
    for (std::int64_t f = 0; f < mesh.face_count; ++f) {
      Face& face = faces_.emplace_back(Face{nullptr, vertices_, triangles_});
      const int depth = request.face_depth[f], corners = mesh.face_sizes[f];
      if (depth < 0) continue;
      auto place = patterns_.find({corners, depth});
      if (place == patterns_.end())
        place = patterns_
                    .try_emplace({corners, depth},
                                 mesh.scheme == LC_SCHEME_LOOP
                                     ? triangle(depth)
                                     : lattice_pattern(data::Scheme::kCatmullClark, corners, depth))
                    .first;
      face.pattern = &place->second;
      vertices_ += std::ssize(face.pattern->points);
      triangles_ += std::ssize(face.pattern->triangles);
    }
  }
  std::int64_t faces() const { return std::ssize(faces_); }
  const Face& of(std::int64_t face) const { return faces_[static_cast<std::size_t>(face)]; }
  std::int64_t vertices() const { return vertices_; }
  std::int64_t triangles() const { return triangles_; }

 private:
  std::map<std::pair<int, int>, FacePattern> patterns_;  // by corners and depth
  std::vector<Face> faces_;
  std::int64_t vertices_ = 0, triangles_ = 0;
};

/// Points that were evaluated in the order of the patterns, as tessellate_faces asks for them.
template <class Real>
class PointsInOrder {
 public:
  ///   results   positions and derivatives, three numbers each
  PointsInOrder(const FacePatterns& patterns, const std::array<const Real*, 3>& results)
      : patterns_(patterns), results_(results) {}
  void begin(std::int32_t face) { next_ = patterns_.of(face).first_vertex; }
  void evaluate(std::int32_t, const Real*, Real* position, Real* du, Real* dv) {
    for (std::size_t k = 0; Real* const to : {position, du, dv})
      std::copy_n(results_[k++] + 3 * next_, 3, to);
    ++next_;
  }
  /// Of a mesh without channels.
  void channel(std::size_t, std::int32_t, const Real*, Real*) {}
  /// The point evaluated last.
  std::size_t last() const { return static_cast<std::size_t>(next_ - 1); }

 private:
  const FacePatterns& patterns_;
  std::array<const Real*, 3> results_;
  std::int64_t next_ = 0;
};

/// Writes which points of its face the vertices of a face are, and its triangles.
template <class Real>
void write_pattern(const FacePatterns& patterns, std::int64_t face, const Output<Real>& output) {
  auto [pattern, vertex, triangle] = patterns.of(face);
  if (pattern == nullptr) return;
  const auto number = static_cast<std::int32_t>(face);
  for (const auto& corners : pattern->triangles) {
    for (std::size_t c = 0; c < 3; ++c)
      output.triangles[3 * triangle + static_cast<std::int64_t>(c)] =
          static_cast<std::uint32_t>(vertex) + corners[c];
    output.triangle_face[triangle++] = number;
  }
  for (const FaceDomain::Point& p : pattern->points) {
    output.provenance[vertex] = {number, static_cast<std::uint32_t>(p.i), static_cast<std::uint32_t>(p.j),
                                 pattern->denominator};
    if (output.corner != nullptr) output.corner[vertex] = p.part;
    ++vertex;
  }
}

/// Tessellates each face by its pattern. `surface()` makes, once for each range of faces, what has
///   void begin(std::int32_t face)
///   void evaluate(std::int32_t part, const Real uv[2], Real position[3], Real du[3], Real dv[3])
///   void channel(std::size_t number, std::int32_t part, const Real uv[2], Real value[])   all components
/// and is asked for all points of a face in the order of its pattern, for the channels of the mesh at each of them.
template <class Real, class Make>
void tessellate_faces(const lc_mesh& mesh, const FacePatterns& patterns, const lc_request& request,
                      lc_tessellation& out, Make&& surface) {
  const auto output = allocate_output<Real>(request, out, patterns.vertices(), patterns.triangles(), true,
                                            /*corners=*/mesh.scheme == LC_SCHEME_CATMULL_CLARK);
  const std::span channels(mesh.channels, static_cast<std::size_t>(mesh.channel_count));
  Real* const channel_values = channels.empty() ? nullptr : allocate_channels<Real>(request, mesh, out);
  faces_in_parallel(patterns.faces(), request.threads, [&](std::int64_t begin, std::int64_t end) {
    auto here = surface();
    std::vector<std::vector<Real>> values(channels.size());  // of the points of a face
    for (std::int64_t f = begin; f < end; ++f) {
      auto [pattern, vertex, triangle] = patterns.of(f);
      if (pattern == nullptr) continue;
      write_pattern(patterns, f, output);
      here.begin(static_cast<std::int32_t>(f));
      const auto first = static_cast<std::uint32_t>(vertex);
      const auto denominator = static_cast<Real>(pattern->denominator);
      for (std::size_t c = 0; c < channels.size(); ++c)
        values[c].resize(pattern->points.size() * static_cast<std::size_t>(channels[c].components));
      for (const FaceDomain::Point& p : pattern->points) {
        const Real uv[2] = {static_cast<Real>(p.i) / denominator, static_cast<Real>(p.j) / denominator};
        Real du[3], dv[3];
        here.evaluate(p.part, uv, output.positions + 3 * vertex, du, dv);
        const Real n[3] = {du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2],
                           du[0] * dv[1] - du[1] * dv[0]};
        const Real length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int c = 0; c < 3; ++c) output.normals[3 * vertex + c] = n[c] / length;
        for (std::size_t c = 0; c < channels.size(); ++c)
          here.channel(c, p.part, uv, values[c].data() + (vertex - first) * channels[c].components);
        ++vertex;
      }
      Real* to = channel_values;
      for (std::size_t c = 0; c < channels.size(); ++c) {
        const std::int32_t n = channels[c].components;
        Real* value = to + 3 * triangle * n;
        for (const auto& corners : pattern->triangles)
          for (const std::uint32_t v : corners)
            value = std::copy_n(values[c].data() + static_cast<std::int64_t>(v) * n, n, value);
        to += 3 * patterns.triangles() * n;
      }
    }
  });
}

}  // namespace limitcheck::verify
