// SPDX-License-Identifier: MIT
#include "verify/relations/relation_comparison.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "data/splitmix64.h"
#include "verify/row/bounds.h"

namespace limitcheck::verify {
namespace {

using Key = std::int64_t;
struct Placed {
  std::optional<Key> face_and_point;
  Lattice::Id id = Lattice::kNone;
  Sides::Id side = Lattice::kNone;
};

// Where a vertex lies on the original mesh: its point, and that point together with the face that names it.
Placed place(const Evidence& e, const Variant& v, const Tessellation& t, std::int64_t vertex) {
  if (!t.provenance_ok(vertex)) return {};
  const Place q = v.original(t.place(vertex));
  const Lattice::Id id = e.lattice.id(q);
  if (id == Lattice::kNone) return {};
  return {id * static_cast<Key>(v.face.size()) + q.face, id, e.reference.sides().of(id, q.face)};
}

// -0 and +0 are told apart.
bool same_bits(const Vector& a, const Vector& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

// Of a position and a normal, or of a position alone.
std::uint64_t digest(const Vector& position, const Vector* normal) {
  std::uint64_t bits = 0;
  const auto add = [&](const Vector& v) {
    for (const double x : v) bits = data::SplitMix64(bits ^ std::bit_cast<std::uint64_t>(x)).next();
  };
  add(position);
  if (normal != nullptr) add(*normal);
  return bits;
}

}  // namespace

Compared::Compared(const Evidence& e)
    : e_(e), uniform_(std::all_of(e.face_depth.begin(), e.face_depth.end(), [&](std::int32_t d) {
        return d == e.face_depth[0];
      })) {
  const Variant same = identity(e);
  for (std::int64_t v = 0; v < e.tessellation.vertex_count(); ++v) {
    const Placed at = place(e, same, e.tessellation, v);
    if (at.id == Lattice::kNone) continue;
    const auto [known, is_new] = by_face_.try_emplace(*at.face_and_point, Delivered{v, v});
    if (!is_new) {
      Delivered& its = known->second;
      if (its.first == its.last) several_.push_back({*at.face_and_point, 0, its.first});
      several_.push_back({*at.face_and_point, 0, its.last = v});
    }
    by_point_.emplace(at.id, v);
    if (!is_finite(e.tessellation, v)) not_finite_.insert(at.id);
  }
  for (Digest& d : several_) {
    const Vector normal = e.tessellation.has_normals() ? e.tessellation.normal(d.vertex) : Vector{};
    d.bits = digest(e.tessellation.position(d.vertex), e.tessellation.has_normals() ? &normal : nullptr);
  }
  std::sort(several_.begin(), several_.end());
}

Comparison Compared::with(const Tessellation& t, const Variant& v, double slack) const {
  Comparison c;
  const double position_limit = slack * position_bound(e_.capabilities.precision, e_.reference.steps(),
                                                       v.magnitude, std::max(e_.diagonal, 1e-300));
  const bool normals = v.normals && t.has_normals() && e_.tessellation.has_normals();
  std::vector<bool> seen(e_.lattice.size(), false);
  std::unordered_set<Lattice::Id> not_finite;
  const auto note = [&](double excess, std::int64_t mine, const Vector& expected, const Vector& got) {
    if (c.witness && excess <= c.worst) return;
    c.worst = excess;
    c.witness = e_.at_vertex(mine);
    c.witness->expected = {expected.begin(), expected.end()};
    c.witness->got = {got.begin(), got.end()};
  };
  for (std::int64_t k = 0; k < t.vertex_count(); ++k) {
    const Placed at = place(e_, v, t, k);
    if (at.id == Lattice::kNone) continue;
    const auto exact = by_face_.find(*at.face_and_point);
    const auto any = by_point_.find(at.id);
    if (any == by_point_.end()) {
      ++c.of;
      if (!uniform_) continue;
      ++c.bad;
      c.message = "a point that the original does not have";
      continue;
    }
    seen[at.id] = true;
    if (!is_finite(t, k)) not_finite.insert(at.id);
    if (!is_finite(t, k) || not_finite_.contains(at.id)) continue;
    ++c.of;
    std::int64_t mine = exact != by_face_.end() ? exact->second.last : any->second;
    if (exact != by_face_.end() && exact->second.first != exact->second.last)
      mine = with_same_bits(t, k, v, *at.face_and_point).value_or(mine);
    const Vector p = v.position(t.position(k)), q = e_.tessellation.position(mine);
    const double off = norm(p - q) / e_.diagonal;
    c.position = std::max(c.position, off);
    bool wrong = !(off <= position_limit), bits = same_bits(p, q);
    note(position_limit > 0 ? off / position_limit : off > 0 ? 1e300 : 0, mine, q, p);
    const bool same_side = e_.reference.sides().of(at.id, e_.tessellation.place(mine).face) == at.side;
    if (normals && same_side && e_.reference.has_normal(at.side)) {
      const double normal_limit = slack * e_.normal_bound_at(at.side);
      const Vector a = v.normal(t.normal(k)), b = e_.tessellation.normal(mine);
      const double angle = a == b ? 0 : angle_degrees(a, b);
      c.normal = std::max(c.normal, angle);
      wrong = wrong || !(angle <= normal_limit);
      bits = bits && same_bits(a, b);
      note(normal_limit > 0 ? angle / normal_limit : angle > 0 ? 1e300 : 0, mine, b, a);
    }
    c.bad += wrong;
    c.other_bits += !bits;
  }
  // Which points are not finite may depend on the order of the input, and `finite` reports them. Only here it
  // shows that there are more of them than in the original.
  if (not_finite.size() > not_finite_.size()) {
    c.bad += static_cast<std::int64_t>(not_finite.size() - not_finite_.size());
    c.of += static_cast<std::int64_t>(not_finite.size());
    c.worst = std::numeric_limits<double>::infinity();
    c.message =
        fmt::format("{} points are not finite, {} in the original", not_finite.size(), not_finite_.size());
  }
  // Next to deeper neighbours a face may be displayed deeper than asked for; which face is may depend on the
  // order.
  for (const auto& [id, vertex] : by_point_)
    if (uniform_ && !seen[id]) {
      ++c.of;
      ++c.bad;
      c.message = "a point of the original is missing";
    }
  return c;
}

std::optional<std::int64_t> Compared::with_same_bits(const Tessellation& t, std::int64_t k, const Variant& v,
                                                     Key key) const {
  Digest least{key, 0, 0};
  const bool same_arrays = t.has_normals() == e_.tessellation.has_normals();
  if (same_arrays) {
    const Vector normal = t.has_normals() ? v.normal(t.normal(k)) : Vector{};
    least.bits = digest(v.position(t.position(k)), t.has_normals() ? &normal : nullptr);
  }
  for (auto d = std::lower_bound(several_.begin(), several_.end(), least);
       d != several_.end() && d->key == key && (!same_arrays || d->bits == least.bits); ++d)
    if (same(t, k, v, d->vertex)) return d->vertex;
  return std::nullopt;
}

bool Compared::same(const Tessellation& t, std::int64_t k, const Variant& v, std::int64_t mine) const {
  return same_bits(v.position(t.position(k)), e_.tessellation.position(mine)) &&
         (!t.has_normals() || !e_.tessellation.has_normals() ||
          same_bits(v.normal(t.normal(k)), e_.tessellation.normal(mine)));
}

}  // namespace limitcheck::verify
