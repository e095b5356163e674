// SPDX-License-Identifier: MIT
// Evidence about a tessellation that a test writes down as a script: a subject delivers it.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "verify/evidence/evidence.h"
#include "verify/evidence/vector.h"
#include "verify/host/host.h"
#include "verify/subject/adapter.h"

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

class Scripting {
 public:
  static constexpr std::int32_t kSharp = 2 * LC_SHARP_SMOOTH_TRIANGLES - 1;
  static lc_capabilities capabilities(Options&, lc_scheme) {
    lc_capabilities c{};
    c.precision = script->precision;
    c.points = script->kind;
    c.max_depth = 5;
    c.per_face_depth = 1;
    c.normals = script->normals.empty() ? 0 : 1;
    return c;
  }
  Scripting(const lc_mesh&, Options&) {}
  static void tessellate(const lc_request& request, lc_tessellation& out) {
    DeliveredArrays all{script->positions, script->normals, script->points, {},
                        script->triangles, script->faces};
    for (double v = 0; all.positions.size() < all.provenance.size(); ++v) all.positions.push_back({v, v, v});
    if (script->precision == LC_FLOAT32)
      all.hand_over<float>(request, out, !all.normals.empty(), false);
    else
      all.hand_over<double>(request, out, !all.normals.empty(), false);
  }
};

inline const lc_subject* subject() {
  static const lc_subject table = make_subject<Scripting>("scripted", "what the test says");
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
    evidence_.reset(new Evidence(gather({detail::subject(), ""}, {"mesh", mesh}, *session_, session_->mesh(),
                                        depth_, *tessellation_, *reference_)));
    reference_->prepare(evidence_->point);
    evidence_->diagonal = evidence_->magnitude = 1;
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
