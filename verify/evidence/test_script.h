// SPDX-License-Identifier: MIT
// Evidence about a tessellation that a test writes down as a script: a subject delivers it.
#pragma once

#include <array>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "verify/evidence/evidence.h"
#include "verify/evidence/vector.h"
#include "verify/host/host.h"

namespace limitcheck::verify::test {

struct Script {
  std::vector<lc_provenance> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::int32_t> faces;     // of the triangles
  std::vector<Vector> positions = {};  // empty: all different
  std::vector<Vector> normals = {};    // empty: none
  lc_precision precision = LC_FLOAT64;
  lc_points kind = LC_POINTS_LIMIT;
};

namespace detail {

inline const Script* script = nullptr;  // of the session being made

template <class T>
T* copy(const lc_request* request, const std::vector<T>& from) {
  auto* to = static_cast<T*>(request->allocate(request->host, from.size() * sizeof(T)));
  if (to != nullptr && !from.empty()) std::memcpy(to, from.data(), from.size() * sizeof(T));
  return to;
}

inline void* vectors(const lc_request* request, const std::vector<Vector>& from) {
  if (from.empty()) return nullptr;
  if (script->precision == LC_FLOAT64) return copy(request, from);
  std::vector<std::array<float, 3>> narrow;
  for (const Vector& p : from)
    narrow.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  return copy(request, narrow);
}

inline const lc_subject* subject() {
  static const lc_subject table = [] {
    lc_subject s{};
    s.abi = LC_SUBJECT_ABI;
    s.name = "scripted";
    s.description = "what the test says";
    s.capabilities = [](const char*, lc_capabilities* out, const char**) {
      *out = {};
      out->precision = script->precision;
      out->points = script->kind;
      out->max_depth = 5;
      out->per_face_depth = 1;
      out->normals = script->normals.empty() ? 0 : 1;
      out->schemes = LC_DOES_LOOP | LC_DOES_CATMULL_CLARK;
      out->sharp = 2 * LC_SHARP_SMOOTH_TRIANGLES - 1;
      return LC_OK;
    };
    s.create = [](const lc_mesh*, const char*, void** instance, const char**) {
      *instance = nullptr;
      return LC_OK;
    };
    s.tessellate = [](void*, const lc_request* request, lc_tessellation* out, const char**) {
      out->vertex_count = static_cast<std::int64_t>(script->points.size());
      out->triangle_count = static_cast<std::int64_t>(script->triangles.size());
      std::vector<Vector> positions = script->positions;
      for (double v = 0; positions.size() < script->points.size(); ++v) positions.push_back({v, v, v});
      out->positions = vectors(request, positions);
      out->normals = vectors(request, script->normals);
      out->provenance = copy(request, script->points);
      out->triangles = reinterpret_cast<std::uint32_t*>(copy(request, script->triangles));
      out->triangle_face = copy(request, script->faces);
      return LC_OK;
    };
    s.release = [](void*, lc_tessellation*) {};
    s.destroy = [](void*) {};
    return s;
  }();
  return &table;
}

}  // namespace detail

/// What an audit would look at if a subject delivered the script for this mesh at these depths.
class Scripted {
 public:
  Scripted(const data::ControlMesh& mesh, std::vector<std::int32_t> depth, Script script)
      : script_(std::move(script)), depth_(std::move(depth)) {
    detail::script = &script_;
    session_ = std::make_unique<Session>(*detail::subject(), mesh);
    tessellation_ = std::make_unique<Tessellation>(session_->tessellate(depth_));
    const int deepest = *std::max_element(depth_.begin(), depth_.end());
    reference_ = std::make_unique<ReferenceSurface>(session_->mesh(), deepest, script_.kind);
    std::vector<Lattice::Id> points = locate(*tessellation_, reference_->lattice());
    reference_->prepare(points);
    std::vector<Use> uses = find_uses(*tessellation_, points, reference_->lattice(), reference_->sides());
    evidence_.reset(new Evidence{"scripted", "mesh", session_->capabilities(), session_->mesh(), depth_,
                                 *tessellation_, reference_->lattice(), *reference_, std::move(points),
                                 std::move(uses), 1, 1});
  }
  const Evidence& operator*() const { return *evidence_; }
  const Evidence* operator->() const { return evidence_.get(); }

 private:
  Script script_;
  std::vector<std::int32_t> depth_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<Tessellation> tessellation_;
  std::unique_ptr<ReferenceSurface> reference_;
  std::unique_ptr<Evidence> evidence_;
};

/// All lattice points of every face for itself, at their exact places and with the exact normals, and the
/// unit triangles: what a right subject delivers.
inline Script exact_script(const data::ControlMesh& mesh, int depth) {
  Script s;
  ReferenceSurface surface(mesh, depth, LC_POINTS_LIMIT);
  const auto n = std::uint32_t{1} << depth;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = static_cast<std::int32_t>(f);
    const auto first = static_cast<std::uint32_t>(s.points.size());
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
      return first + j * (n + 1) - j * (j - 1) / 2 + i;
    };
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i + j <= n; ++i) s.points.push_back({face, i, j, n});
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i + j < n; ++i) {
        s.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < n) s.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    s.faces.resize(s.triangles.size(), face);
  }
  for (const lc_provenance& p : s.points) {
    const Lattice::Id id = surface.lattice().id(place_of(p));
    surface.prepare({&id, 1});
    s.positions.push_back(surface.position(id));
    s.normals.push_back(surface.normal(id));
  }
  return s;
}

}  // namespace limitcheck::verify::test
