// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "verify/checks/checks.h"
#include "verify/evidence/evidence.h"
#include "verify/evidence/other_channel.h"
#include "verify/evidence/vector.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {
namespace {

constexpr std::int32_t kUnwritten32 = -1;  // 0xFFFFFFFF

// Adds `bad` entries; the first sentence and witness stay.
void add(Result& r, std::int64_t bad, const std::string& message) {
  if (bad == 0) return;
  r.bad += bad;
  r.message += r.message.empty() ? message : "; " + message;
}

}  // namespace

std::vector<Result> check_written(const Evidence& e) {
  Result r = e.result("written", "entries", 0);
  const Tessellation& t = e.tessellation;

  // What the host found: arrays that cannot be read, indices out of range, guard zones written to.
  std::int64_t structural = 0;
  for (const Defect& d : t.defects()) {
    add(r, std::max<std::int64_t>(d.count, 1), d.message);
    ++structural;
  }
  for (const Overrun& o : t.overruns())
    add(r, 1,
        fmt::format("{} written {} bytes {} its memory", o.array, o.distance,
                    o.before ? "in front of" : "behind"));

  // Entries that still hold the bytes they were handed out with.
  std::int64_t positions = 0, normals = 0, provenance = 0, triangles = 0, faces = 0, channels = 0;
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
    const bool position = t.position_unwritten(v), normal = t.has_normals() && t.normal_unwritten(v);
    const lc_provenance& p = t.provenance()[v];
    const bool where = p.face == kUnwritten32 && p.denominator == static_cast<std::uint32_t>(kUnwritten32);
    positions += position;
    normals += normal;
    provenance += where;
    if ((position || normal) && !where && !r.witness) r.witness = e.at_vertex(v);
  }
  for (std::int64_t k = 0; k < t.triangle_count(); ++k) {
    bool any = false;
    for (const std::uint32_t v : t.triangles()[k]) any = any || v == static_cast<std::uint32_t>(kUnwritten32);
    triangles += any;
    faces += t.triangle_face()[k] == kUnwritten32;
    const std::int64_t of_channels = t.channels_unwritten(k);
    channels += of_channels;
    if ((any || of_channels > 0) && !r.witness)
      r.witness = Witness{.face = t.triangle_face()[k], .triangle = k};
  }
  for (const auto& [count, what] : {std::pair{positions, "positions"},
                                    {normals, "normals"},
                                    {provenance, "provenances"},
                                    {triangles, "triangles"},
                                    {faces, "control faces of triangles"},
                                    {channels, "numbers of channels"}})
    add(r, count, fmt::format("{} {} unwritten", count, what));
  if (t.vertex_count() == 0 && structural == 0 &&
      std::any_of(e.face_depth.begin(), e.face_depth.end(), [](std::int32_t d) { return d >= 0; }))
    add(r, 1, "nothing was delivered");
  r.of = 3 * t.vertex_count() + 2 * t.triangle_count();
  if (r.bad > 0) r.status = Status::kFinding;
  return {r};
}

std::vector<Result> check_finite(const Evidence& e) {
  Result r = e.result("finite", "vectors", 0);
  const Tessellation& t = e.tessellation;
  std::int64_t positions = 0, normals = 0, values = 0;
  const auto look = [&](std::int64_t v, const Vector& value, std::int64_t& count) {
    if (is_finite(value)) return;
    ++count;
    if (r.witness) return;
    r.witness = e.at_vertex(v);
    r.witness->got = {value.begin(), value.end()};
  };
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
    if (!t.position_unwritten(v)) look(v, t.position(v), positions);
    if (t.has_normals() && !t.normal_unwritten(v)) look(v, t.normal(v), normals);
  }
  for (std::size_t c = 0; c < t.channel_count(); ++c)
    for (std::int64_t k = 0; k < t.triangle_count(); ++k)
      for (int corner = 0; corner < 3; ++corner)
        for (int component = 0; component < t.components(c); ++component) {
          const double x = t.channel_value(c, k, corner, component);
          if (std::isfinite(x) || t.channels_unwritten(k) > 0) continue;
          ++values;
          if (!r.witness && t.triangle_ok(k)) {
            r.witness = e.at_vertex(t.triangles()[k][static_cast<std::size_t>(corner)]);
            r.witness->triangle = k;
            r.witness->got = {x};
            name_channel(*r.witness, e.mesh.channels[c]);
          }
        }
  r.of = t.vertex_count() * (t.has_normals() ? 2 : 1);
  for (std::size_t c = 0; c < t.channel_count(); ++c) r.of += 3 * t.triangle_count() * t.components(c);
  r.bad = positions + normals + values;
  settle(r);
  if (r.bad > 0)
    r.message = fmt::format("{} positions and {} normals{} are NaN or infinite", positions, normals,
                            values > 0 ? fmt::format(" and {} numbers of channels", values) : "");
  count_places(
      r, e.lattice, e.point.size(), [&](std::size_t v) { return e.point[v]; },
      [&](std::size_t v) { return static_cast<int>(!is_finite(t, static_cast<std::int64_t>(v))); });
  return {r};
}

}  // namespace limitcheck::verify
