// SPDX-License-Identifier: MIT
#include "verify/relations/relation_state.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>

#include "verify/host/in_turns.h"

namespace limitcheck::verify {
namespace {

template <class T>
bool same(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

// All arrays, byte by byte. Points in another order are still the same answer: then they are compared one by
// one.
bool same_arrays(const Tessellation& a, const Tessellation& b) {
  return same(a.positions_f32(), b.positions_f32()) && same(a.positions_f64(), b.positions_f64()) &&
         same(a.normals_f32(), b.normals_f32()) && same(a.normals_f64(), b.normals_f64()) &&
         same(a.provenance(), b.provenance()) && same(a.corners(), b.corners()) &&
         same(a.triangles(), b.triangles()) && same(a.triangle_face(), b.triangle_face());
}

}  // namespace

void ask_in_turns(RelationRow& row, const AuditSubject& subject, const Evidence& e,
                  const Compared& compared) {
  std::optional<InTurns> here;
  if (subject.in_turns == nullptr) here.emplace(*subject.subject);
  AuditSubject turns{here ? &here->subject() : subject.in_turns, subject.options};
  const Variant mine = identity(e);
  std::string what = kTurns[0];
  const auto ask = [&](Session& session, int threads) {
    const Tessellation t = session.tessellate(e.face_depth, threads);
    row.inspect(what, t);
    if (same_arrays(t, e.tessellation)) {
      row.count(0, t.vertex_count());
      return;
    }
    Comparison c = compared.with(t, mine, 0);
    if (t.vertex_count() != e.tessellation.vertex_count() ||
        t.triangle_count() != e.tessellation.triangle_count()) {
      c.bad += 1;
      c.message =
          fmt::format("{} vertices and {} triangles, but {} and {} at first", t.vertex_count(),
                      t.triangle_count(), e.tessellation.vertex_count(), e.tessellation.triangle_count());
    }
    c.bad = std::max(c.bad, c.other_bits);
    c.worst = static_cast<double>(c.bad);
    row.judge(what, c, false);
  };
  row.ask(turns, what, e.mesh, [&](Session& session) {
    for (std::size_t k = 0; k < kTurns.size(); ++k) {
      what = kTurns[k];
      ask(session, k == 3 ? 8 : 1);
    }
  });
  for (const First& first : kFirst) {
    turns.options = first.option + subject.options;
    what = first.what;
    row.ask(turns, what, e.mesh, [&](Session& session) { ask(session, 1); });
  }
}

}  // namespace limitcheck::verify
