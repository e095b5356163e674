// SPDX-License-Identifier: MIT
#include "verify/audit/shrink.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "data/cut_out.h"
#include "data/validate.h"
#include "verify/audit/audit.h"
#include "verify/audit/relations.h"
#include "verify/interrupt/interrupt.h"

namespace limitcheck::verify {
namespace {

using Faces = std::vector<std::int32_t>;  // of the mesh being shrunk, ascending

// The mesh of some faces, cut apart where they touch in a vertex only.
AuditMesh part(const AuditMesh& whole, const Faces& faces) {
  data::CutOut cut = data::cut_out(whole.mesh.faces, faces);
  AuditMesh out{whole.name, {cut.of(whole.mesh.positions), {}, cut.of(whole.mesh.sharpness)}};
  out.mesh.faces = std::move(cut.faces);
  out.asked_scheme = whole.asked_scheme;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (std::binary_search(whole.mesh.holes.begin(), whole.mesh.holes.end(), faces[f]))
      out.mesh.holes.push_back(static_cast<std::int32_t>(f));
  if (!whole.face_depth.empty())
    for (const std::int32_t f : faces) out.face_depth.push_back(whole.face_depth[f]);
  return out;
}

// Vertex b is merged into a, and faces with both vanish. The result may be invalid; the caller checks.
AuditMesh collapsed(const AuditMesh& whole, std::int32_t a, std::int32_t b) {
  AuditMesh out = whole;
  data::Faces faces;
  Faces left;
  for (std::size_t f = 0; f < whole.mesh.faces.size(); ++f) {
    std::vector<std::int32_t> corners(whole.mesh.faces[f].begin(), whole.mesh.faces[f].end());
    std::replace(corners.begin(), corners.end(), b, a);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    faces.push_back(corners);
    if (corners.size() > 2) left.push_back(static_cast<std::int32_t>(f));
  }
  out.mesh.faces = std::move(faces);
  const auto moved = [&](std::int32_t v) { return v == b ? a : v; };
  data::Sharpness& sharp = out.mesh.sharpness;
  for (data::SharpEdge& e : sharp.edges) e = {moved(e.a), moved(e.b), e.sharpness};
  std::erase_if(sharp.edges, [](const data::SharpEdge& e) { return e.a == e.b; });
  std::erase_if(sharp.vertices, [&](const data::SharpVertex& v) { return v.vertex == b; });
  return part(out, left);
}

class Shrinker {
 public:
  Shrinker(const AuditMesh& mesh, int depth, const std::function<bool(const AuditMesh&, int)>& fails,
           double seconds)
      : best_{mesh, depth, 0},
        fails_(fails),
        end_(std::chrono::steady_clock::now() +
             std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                 std::chrono::duration<double>(seconds))) {
    best_.mesh.depth = -1;  // the one that is tried
    best_.mesh.depths.clear();
    best_.mesh.asked_scheme = mesh.scheme();
  }

  Shrunk run(std::int64_t face) {
    if (best_.mesh.face_depth.empty()) {
      for (int depth = 0; depth < best_.depth && !late(); ++depth) {
        ++best_.attempts;
        if (!fails_(best_.mesh, depth)) continue;
        best_.depth = depth;
        break;
      }
    }
    ball(face);
    while (!late() && (remove_chunks() || collapse_edges() || remove_tags())) {
    }
    return std::move(best_);
  }

 private:
  bool late() const { return interrupted() != 0 || std::chrono::steady_clock::now() >= end_; }

  bool take(AuditMesh candidate) {
    if (late() || candidate.mesh.faces.empty() ||
        !data::validate(candidate.mesh, *candidate.asked_scheme).empty())
      return false;
    ++best_.attempts;
    if (!fails_(candidate, best_.depth)) return false;
    best_.mesh = std::move(candidate);
    return true;
  }

  // All faces by the number of rings between them and `face`; those out of reach last.
  std::vector<int> rings(std::int64_t face) const {
    const data::Faces& faces = best_.mesh.mesh.faces;
    std::vector<int> ring(faces.size(), -1), of_vertex(best_.mesh.mesh.positions.size(), -1);
    if (face < 0 || face >= static_cast<std::int64_t>(faces.size())) return ring;
    ring[face] = 0;
    for (int r = 0, found = 1; found > 0; ++r) {
      found = 0;
      for (std::size_t f = 0; f < faces.size(); ++f)
        if (ring[f] == r)
          for (const auto v : faces[f]) of_vertex[v] = r;
      for (std::size_t f = 0; f < faces.size(); ++f) {
        if (ring[f] >= 0) continue;
        if (std::any_of(faces[f].begin(), faces[f].end(), [&](auto v) { return of_vertex[v] >= 0; })) {
          ring[f] = r + 1;
          ++found;
        }
      }
    }
    return ring;
  }

  // The smallest number of rings about the witness that is enough.
  void ball(std::int64_t face) {
    const std::vector<int> ring = rings(face);
    const int most = ring.empty() ? -1 : *std::max_element(ring.begin(), ring.end());
    for (int r = 0; r < most && !late(); ++r) {
      Faces faces;
      for (std::size_t f = 0; f < ring.size(); ++f)
        if (ring[f] >= 0 && ring[f] <= r) faces.push_back(static_cast<std::int32_t>(f));
      if (take(part(best_.mesh, faces))) return;
    }
  }

  bool remove_chunks() {
    bool any = false;
    for (std::size_t chunk = best_.mesh.mesh.faces.size() / 2; chunk > 0 && !late();) {
      bool smaller = false;
      for (std::size_t begin = 0; begin < best_.mesh.mesh.faces.size() && !late();) {
        const std::size_t count = best_.mesh.mesh.faces.size();
        Faces faces;
        for (std::size_t f = 0; f < count; ++f)
          if (f < begin || f >= begin + chunk) faces.push_back(static_cast<std::int32_t>(f));
        if (take(part(best_.mesh, faces)))
          smaller = true;
        else
          begin += chunk;
      }
      any = any || smaller;
      if (!smaller) chunk /= 2;
    }
    return any;
  }

  // Sharp edges and vertices one by one, and the choices that go with them.
  bool remove_tags() {
    bool any = false;
    const auto attempt = [&](const std::function<void(data::Sharpness&)>& remove) {
      AuditMesh candidate = best_.mesh;
      remove(candidate.mesh.sharpness);
      const bool taken =
          !(candidate.mesh.sharpness == best_.mesh.mesh.sharpness) && take(std::move(candidate));
      any = any || taken;
      return taken;
    };
    attempt([](data::Sharpness& s) { s.boundary = data::Boundary::kEdge; });
    attempt([](data::Sharpness& s) { s.creasing = data::Creasing::kUniform; });
    attempt([](data::Sharpness& s) { s.triangles = data::TriangleRule::kCatmark; });
    for (std::size_t k = 0; k < best_.mesh.mesh.sharpness.edges.size() && !late();)
      if (!attempt(
              [&](data::Sharpness& s) { s.edges.erase(s.edges.begin() + static_cast<std::ptrdiff_t>(k)); }))
        ++k;
    for (std::size_t k = 0; k < best_.mesh.mesh.sharpness.vertices.size() && !late();)
      if (!attempt([&](data::Sharpness& s) {
            s.vertices.erase(s.vertices.begin() + static_cast<std::ptrdiff_t>(k));
          }))
        ++k;
    return any;
  }

  bool collapse_edges() {
    bool any = false;
    for (std::size_t f = 0; f < best_.mesh.mesh.faces.size() && !late(); ++f) {
      const auto corners = std::as_const(best_.mesh.mesh.faces)[f];
      const std::vector<std::int32_t> its(corners.begin(), corners.end());
      for (std::size_t k = 0; k < its.size(); ++k) {
        if (!take(collapsed(best_.mesh, its[k], its[(k + 1) % its.size()]))) continue;
        any = true;
        break;
      }
    }
    return any;
  }

  Shrunk best_;
  const std::function<bool(const AuditMesh&, int)>& fails_;
  std::chrono::steady_clock::time_point end_;
};

}  // namespace

Shrunk shrink(const AuditMesh& mesh, int depth, std::int64_t face,
              const std::function<bool(const AuditMesh&, int)>& fails, double seconds) {
  return Shrinker(mesh, depth, fails, seconds).run(face);
}

Shrunk shrink(const AuditSubject& subject, const AuditMesh& mesh, int depth, int threads,
              const Result& finding, double seconds) {
  const auto& relations = relation_rows();
  const Level level = std::find(relations.begin(), relations.end(), finding.check) == relations.end()
                          ? Level::kQuick
                          : Level::kThorough;
  const auto fails = [&](const AuditMesh& candidate, int at) {
    const auto results = Auditor(at, threads, {}, level).run(subject, candidate);
    return std::any_of(results.begin(), results.end(),
                       [&](const Result& r) { return r.check == finding.check && is_bad(r); });
  };
  return shrink(mesh, depth, finding.witness ? finding.witness->face : -1, fails, seconds);
}

}  // namespace limitcheck::verify
