// SPDX-License-Identifier: MIT
#include "verify/audit/shrink.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "data/channel.h"
#include "data/cut_out.h"
#include "data/validate.h"
#include "verify/audit/audit.h"
#include "verify/evidence/faces_around.h"
#include "verify/interrupt/interrupt.h"
#include "verify/relations/relations.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {
namespace {

using Faces = std::vector<std::int32_t>;  // of the mesh being shrunk, ascending

// The mesh of some faces, cut apart where they touch in a vertex only.
AuditMesh part(const AuditMesh& whole, const Faces& faces) {
  data::CutOut cut = data::cut_out(whole.mesh.faces, faces);
  AuditMesh out{whole.name, {cut.of(whole.mesh.positions), {}, cut.of(whole.mesh.sharpness)}};
  out.mesh.faces = std::move(cut.faces);
  out.mesh.channels = data::channels_of(whole.mesh.channels, whole.mesh.faces, faces);
  out.asked_scheme = whole.asked_scheme;
  out.depths = whole.depths;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (std::binary_search(whole.mesh.holes.begin(), whole.mesh.holes.end(), faces[f]))
      out.mesh.holes.push_back(static_cast<std::int32_t>(f));
  if (!whole.face_depth.empty())
    for (const std::int32_t f : faces) out.face_depth.push_back(whole.face_depth[f]);
  return out;
}

// Vertex b is merged into a, and faces with both vanish. The result may be invalid; the caller checks. What had at b the
// value of a face beside the edge has the value that this face has at a.
AuditMesh collapsed(const AuditMesh& whole, std::int32_t a, std::int32_t b) {
  AuditMesh out = whole;
  data::Faces faces;
  Faces left;
  std::vector<std::map<std::int32_t, std::int32_t>> value_at_a(whole.mesh.channels.size());
  for (data::Channel& channel : out.mesh.channels) channel.corners.clear();
  const auto index = [&](std::size_t channel, std::size_t f, std::size_t k) {
    return whole.mesh.channels[channel].corners[whole.mesh.faces.first_corner(f) + k];
  };
  for (std::size_t f = 0; f < whole.mesh.faces.size(); ++f) {
    const auto its = whole.mesh.faces[f];
    const auto at_a = std::find(its.begin(), its.end(), a), at_b = std::find(its.begin(), its.end(), b);
    for (std::size_t c = 0; at_a != its.end() && at_b != its.end() && c < value_at_a.size(); ++c)
      value_at_a[c].emplace(index(c, f, static_cast<std::size_t>(at_b - its.begin())),
                            index(c, f, static_cast<std::size_t>(at_a - its.begin())));
  }
  for (std::size_t f = 0; f < whole.mesh.faces.size(); ++f) {
    const auto its = whole.mesh.faces[f];
    const bool has_a = std::find(its.begin(), its.end(), a) != its.end();
    std::vector<std::int32_t> corners;
    for (std::size_t k = 0; k < its.size(); ++k) {
      if (its[k] == b && has_a) continue;
      corners.push_back(its[k] == b ? a : its[k]);
      for (std::size_t c = 0; c < value_at_a.size(); ++c) {
        const std::int32_t own = index(c, f, k);
        const auto known = value_at_a[c].find(own);
        out.mesh.channels[c].corners.push_back(its[k] == b && known != value_at_a[c].end() ? known->second
                                                                                           : own);
      }
    }
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
           const ShrinkLimits& limits)
      : best_{mesh, depth, 0}, fails_(fails), limits_(limits) {
    best_.mesh.depth = -1;  // the one that is tried
    best_.mesh.depths = after_of(mesh.depths);
    if (!best_.mesh.depths.empty()) best_.mesh.depths += "uniform";
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
    while (!late() && (remove_chunks() || remove_channels() || collapse_edges() || remove_tags())) {
    }
    lower_depths();
    round_coordinates();
    return std::move(best_);
  }

 private:
  bool late() const {
    return interrupted() != 0 || best_.attempts >= limits_.attempts || clock_.seconds() >= limits_.seconds;
  }

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
    std::vector<int> ring(faces.size(), -1);
    if (face < 0 || face >= static_cast<std::int64_t>(faces.size())) return ring;
    const FacesAround around(faces, best_.mesh.mesh.positions.size());
    Faces reached{static_cast<std::int32_t>(face)};  // in the order of their rings
    ring[face] = 0;
    for (std::size_t k = 0; k < reached.size(); ++k)
      for (const std::int32_t v : faces[reached[k]])
        for (const std::int32_t f : around.of(v)) {
          if (ring[f] >= 0) continue;
          ring[f] = ring[reached[k]] + 1;
          reached.push_back(f);
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

  // Channels one by one, then seams: at each vertex all values become the first.
  bool remove_channels() {
    bool any = false;
    for (std::size_t c = 0; c < best_.mesh.mesh.channels.size() && !late();) {
      AuditMesh candidate = best_.mesh;
      candidate.mesh.channels.erase(candidate.mesh.channels.begin() + static_cast<std::ptrdiff_t>(c));
      if (take(std::move(candidate)))
        any = true;
      else
        ++c;
    }
    for (std::size_t c = 0; c < best_.mesh.mesh.channels.size(); ++c)
      for (std::size_t v = 0; v < best_.mesh.mesh.positions.size() && !late(); ++v) {
        AuditMesh candidate = best_.mesh;
        std::vector<std::int32_t>& values = candidate.mesh.channels[c].corners;
        const auto vertices = std::as_const(candidate.mesh.faces).corners();
        std::int32_t first = -1;
        for (std::size_t at = 0; at < values.size(); ++at)
          if (vertices[at] == static_cast<std::int32_t>(v))
            values[at] = first = first < 0 ? values[at] : first;
        if (values != best_.mesh.mesh.channels[c].corners && take(std::move(candidate))) any = true;
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
    const auto one_by_one = [&](auto list) {  // of the sharpness
      for (std::size_t k = 0; k < (best_.mesh.mesh.sharpness.*list).size() && !late();)
        if (!attempt([&](data::Sharpness& s) {
              (s.*list).erase((s.*list).begin() + static_cast<std::ptrdiff_t>(k));
            }))
          ++k;
    };
    one_by_one(&data::Sharpness::edges);
    one_by_one(&data::Sharpness::vertices);
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

  // Of faces with depths of their own: all by one as long as that fails, then each to the least that does.
  void lower_depths() {
    const auto lowered = [&](auto&& lower) {
      AuditMesh candidate = best_.mesh;
      for (std::size_t f = 0; f < candidate.face_depth.size(); ++f) lower(f, candidate.face_depth[f]);
      return candidate.face_depth != best_.mesh.face_depth && take(std::move(candidate));
    };
    while (best_.depth > 0 &&
           lowered([](std::size_t, std::int32_t& d) { d = std::max(d - 1, std::min(d, 0)); }))
      best_.depth =
          std::max(0, *std::max_element(best_.mesh.face_depth.begin(), best_.mesh.face_depth.end()));
    for (std::size_t f = 0; f < best_.mesh.face_depth.size() && !late(); ++f)
      for (std::int32_t least = 0; least < best_.mesh.face_depth[f] && !late(); ++least)
        if (lowered([&](std::size_t g, std::int32_t& d) { d = g == f ? least : d; })) break;
  }

  // To multiples of 1/2, 1/4, .. of the power of two next to the largest.
  void round_coordinates() {
    double largest = 0;
    for (const auto& p : best_.mesh.mesh.positions)
      for (const double x : p) largest = std::max(largest, std::abs(x));
    if (!(largest > 0)) return;
    for (const int bits : {1, 2, 3, 4, 6, 8, 12}) {
      const double step = std::ldexp(1, std::ilogb(largest) - bits);
      AuditMesh candidate = best_.mesh;
      for (auto& p : candidate.mesh.positions)
        for (double& x : p) x = std::round(x / step) * step;
      if (candidate.mesh.positions == best_.mesh.mesh.positions || take(std::move(candidate))) return;
    }
  }

  Shrunk best_;
  const std::function<bool(const AuditMesh&, int)>& fails_;
  ShrinkLimits limits_;
  Clock clock_;
};

}  // namespace

Shrunk shrink(const AuditMesh& mesh, int depth, std::int64_t face,
              const std::function<bool(const AuditMesh&, int)>& fails, const ShrinkLimits& limits) {
  return Shrinker(mesh, depth, fails, limits).run(face);
}

ShrunkFinding shrink(const AuditSubject& subject, const AuditMesh& mesh, int threads, const Result& finding,
                     const ShrinkLimits& limits) {
  const auto& relations = relation_rows();
  ShrunkFinding result;
  result.relation = std::find(relations.begin(), relations.end(), finding.check) != relations.end();
  const auto found = [&](const AuditMesh& candidate, int at) -> std::optional<Result> {
    const Level level = result.relation ? Level::kThorough : Level::kQuick;
    for (Result& r : Auditor(at, threads, {}, level).run(subject, candidate))
      if (r.check == finding.check && is_bad(r)) return std::move(r);
    return std::nullopt;
  };
  result.small = shrink(
      mesh, finding.depth, finding.witness ? finding.witness->face : -1,
      [&](const AuditMesh& candidate, int at) { return found(candidate, at).has_value(); }, limits);
  result.row = found(result.small.mesh, result.small.depth);
  return result;
}

}  // namespace limitcheck::verify
