// SPDX-License-Identifier: MIT
#include "verify/relations/relation_row.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <new>
#include <utility>

#include "data/splitmix64.h"
#include "verify/host/in_turns.h"
#include "verify/row/bounds.h"

namespace limitcheck::verify {
namespace {

struct Placed {
  std::optional<std::int64_t> face_and_point;
  Lattice::Id id = Lattice::kNone;
  Sides::Id side = Lattice::kNone;
};

// Where a vertex lies on the original mesh: its point, and that point together with the face that names it.
Placed place(const Lattice& lattice, const Sides& sides, const Variant& v, const Tessellation& t,
             std::int64_t vertex) {
  if (!t.provenance_ok(vertex)) return {};
  const Place q = v.original(t.place(vertex));
  const Lattice::Id id = lattice.id(q);
  if (id == Lattice::kNone) return {};
  return {id * static_cast<std::int64_t>(v.face.size()) + q.face, id, sides.of(id, q.face)};
}
Placed place(const Evidence& e, const Variant& v, const Tessellation& t, std::int64_t vertex) {
  return place(e.lattice, e.reference.sides(), v, t, vertex);
}

// Names for the points of a variant that the original need not have.
struct PointsAnywhere {
  PointsAnywhere(const Evidence& e, const Variant& v, const Tessellation& t)
      : lattice(e.mesh, e.lattice.scheme(), e.lattice.depth(), originals(e, v, t)), sides(lattice) {}
  static std::vector<Place> originals(const Evidence& e, const Variant& v, const Tessellation& t) {
    std::vector<Place> all = points_anywhere(e.capabilities, t);
    for (Place& p : all) p = v.original(p);
    return all;
  }
  Lattice lattice;
  Sides sides;
};

// -0 and +0 are told apart.
bool same_bits(const Vector& a, const Vector& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

// The bits with those of more numbers.
template <std::size_t N>
std::uint64_t digest(std::uint64_t bits, const std::array<double, N>& more) {
  for (const double x : more) bits = data::SplitMix64(bits ^ std::bit_cast<std::uint64_t>(x)).next();
  return bits;
}
// Of a position and the normal, if there is one, which a variant is brought back from.
std::uint64_t digest(const Tessellation& t, std::int64_t vertex, const Variant& v) {
  const std::uint64_t position = digest(0, v.position(t.position(vertex)));
  return t.has_normals() ? digest(position, v.normal(t.normal(vertex))) : position;
}

// How many of the first list the second has not.
std::int64_t lost(std::vector<std::uint64_t> list, std::vector<std::uint64_t> other) {
  std::sort(list.begin(), list.end());
  std::sort(other.begin(), other.end());
  std::vector<std::uint64_t> gone;
  std::set_difference(list.begin(), list.end(), other.begin(), other.end(), std::back_inserter(gone));
  return std::ssize(gone);
}

// From harmless to fatal: the worst of a row is its status.
int gravity(Status status) {
  static constexpr Status kOrder[] = {Status::kHeld,    Status::kQualityWarning, Status::kNotSupported,
                                      Status::kNotRun,  Status::kFinding,        Status::kError,
                                      Status::kTimeout, Status::kCrash};
  return static_cast<int>(std::find(std::begin(kOrder), std::end(kOrder), status) - std::begin(kOrder));
}

template <class T>
bool same(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

// All arrays byte by byte, channels as different_channels() compares them. Points in another order are still the same
// answer: then they are compared one by one.
bool same_arrays(const Tessellation& a, const Tessellation& b) {
  return same(a.positions_f32(), b.positions_f32()) && same(a.positions_f64(), b.positions_f64()) &&
         same(a.normals_f32(), b.normals_f32()) && same(a.normals_f64(), b.normals_f64()) &&
         same(a.provenance(), b.provenance()) && same(a.corners(), b.corners()) &&
         same(a.triangles(), b.triangles()) && same(a.triangle_face(), b.triangle_face()) &&
         different_channels(a, b) == 0;
}

// Counts the vertices at shared points whose bits are not those of the first one there: of positions at the point, of
// normals at its side.
class SharedPointBits {
 public:
  struct Unlike {
    Lattice::Id point;
    Vector first, other;  // positions, or normals if the positions are the same
  };

  void add(const Tessellation& t, std::int64_t vertex, Lattice::Id point, Sides::Id side) {
    const std::int64_t first = at_point_.emplace(point, vertex).first->second;
    const std::int64_t first_of_side = of_side_.emplace(side, vertex).first->second;
    if (!same_bits(t.position(vertex), t.position(first)))
      note({point, t.position(first), t.position(vertex)});
    else if (t.has_normals() && !same_bits(t.normal(vertex), t.normal(first_of_side)))
      note({point, t.normal(first_of_side), t.normal(vertex)});
  }
  std::int64_t unlike() const { return unlike_; }
  const std::optional<Unlike>& first() const { return first_; }

 private:
  void note(const Unlike& found) {
    if (unlike_++ == 0) first_ = found;
  }

  std::unordered_map<Lattice::Id, std::int64_t> at_point_;
  std::unordered_map<Sides::Id, std::int64_t> of_side_;
  std::int64_t unlike_ = 0;
  std::optional<Unlike> first_;
};

}  // namespace

std::int64_t different_points(const Tessellation& a, const Tessellation& b) {
  const auto points = [](const Tessellation& t) {
    std::vector<std::uint64_t> all;
    for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
      const std::uint64_t position = digest(0, t.position(v));
      all.push_back(t.has_normals() ? digest(position, t.normal(v)) : position);
    }
    return all;
  };
  return lost(points(a), points(b)) + std::abs(b.vertex_count() - a.vertex_count()) +
         std::abs(b.triangle_count() - a.triangle_count());
}

std::int64_t different_channels(const Tessellation& a, const Tessellation& b) {
  const auto corners = [](const Tessellation& t) {
    std::vector<std::uint64_t> all;
    for (std::int64_t k = 0; t.channel_count() > 0 && k < t.triangle_count(); ++k)
      for (int corner = 0; corner < 3 && t.triangle_ok(k); ++corner) {
        const Vector position = t.position(t.triangles()[k][static_cast<std::size_t>(corner)]);
        std::uint64_t bits = digest(0, position) ^ static_cast<std::uint64_t>(t.triangle_face()[k]);
        for (std::size_t c = 0; c < t.channel_count(); ++c)
          for (int component = 0; component < t.components(c); ++component) {
            bits = digest(bits, std::array{t.channel_value(c, k, corner, component)});
            for (int by = 0; t.has_channel_derivatives() && by < 2; ++by)
              bits = digest(bits, std::array{t.channel_derivative(c, k, corner, component, by)});
          }
        all.push_back(bits);
      }
    return all;
  };
  return lost(corners(a), corners(b));
}

Compared::Compared(const Evidence& e)
    : e_(e),
      same_(identity(e)),
      uniform_(e.capabilities.points_anywhere == 0 &&
               std::all_of(e.face_depth.begin(), e.face_depth.end(),
                           [&](std::int32_t d) { return d == e.face_depth[0]; })) {
  SharedPointBits shared;
  for (std::int64_t v = 0; v < e.tessellation.vertex_count(); ++v) {
    const Placed at = place(e, same_, e.tessellation, v);
    if (at.id == Lattice::kNone) continue;
    const auto [known, is_new] = by_face_.try_emplace(*at.face_and_point, Delivered{v, v});
    if (!is_new) {
      Delivered& its = known->second;
      if (its.first == its.last) several_.push_back({*at.face_and_point, 0, its.first});
      several_.push_back({*at.face_and_point, 0, its.last = v});
    }
    by_point_.emplace(at.id, v);
    if (!is_finite(e.tessellation, v))
      not_finite_.insert(at.id);
    else if (e.lattice.is_shared(at.id))
      shared.add(e.tessellation, v, at.id, at.side);
  }
  split_ = shared.unlike();
  for (Digest& d : several_) d.bits = digest(e.tessellation, d.vertex, same_);
  std::sort(several_.begin(), several_.end());
}

Comparison Compared::with(const Tessellation& t, const Variant& v, double slack) const {
  Comparison c;
  const bool normals = v.normals && t.has_normals() && e_.tessellation.has_normals();
  std::vector<bool> seen(e_.lattice.size(), false);
  std::unordered_set<Lattice::Id> not_finite;
  SharedPointBits shared;
  const bool cut = v.mesh.positions.size() > e_.mesh.positions.size();  // its sides have nothing in common
  std::optional<PointsAnywhere> anywhere;
  if (e_.capabilities.points_anywhere != 0) anywhere.emplace(e_, v, t);
  const auto note = [&](double excess, std::int64_t mine, const Vector& expected, const Vector& got) {
    if (c.witness && excess <= c.worst) return;
    c.worst = excess;
    c.witness = e_.at_vertex(mine);
    c.witness->show(expected, got);
  };
  for (std::int64_t k = 0; k < t.vertex_count(); ++k) {
    if (anywhere && is_finite(t, k))
      if (const Placed its = place(anywhere->lattice, anywhere->sides, v, t, k);
          its.id != Lattice::kNone && anywhere->lattice.is_shared(its.id))
        shared.add(t, k, cut ? its.side : its.id, its.side);
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
    if (!is_finite(t, k))
      not_finite.insert(at.id);
    else if (!anywhere && e_.lattice.is_shared(at.id))
      shared.add(t, k, cut ? at.side : at.id, at.side);
    if (!is_finite(t, k) || not_finite_.contains(at.id)) continue;
    ++c.of;
    std::int64_t mine = exact != by_face_.end() ? exact->second.last : any->second;
    if (exact != by_face_.end() && exact->second.first != exact->second.last)
      mine = with_same_bits(t, k, v, *at.face_and_point).value_or(mine);
    const Vector p = v.position(t.position(k)), q = e_.tessellation.position(mine);
    const double off = norm(p - q) / e_.diagonal;
    const double position_limit =
        slack * position_bound(e_.capabilities.precision, e_.reference.steps(), v.magnitude, e_.diagonal,
                               e_.reference.terms_at(at.id));
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
    c.not_finite = static_cast<std::int64_t>(not_finite.size() - not_finite_.size());
    c.bad += c.not_finite;
    c.of += static_cast<std::int64_t>(not_finite.size());
    c.worst = std::numeric_limits<double>::infinity();
    c.message =
        fmt::format("{} points are not finite, {} in the original", not_finite.size(), not_finite_.size());
  }
  if (split_ == 0 && shared.first()) {
    c.split = shared.unlike();
    c.split_at = e_.at((anywhere ? anywhere->lattice : e_.lattice).place(shared.first()->point));
    c.split_at->show(shared.first()->first, shared.first()->other);
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

Comparison Compared::bits_with(const Tessellation& t, const char* where) const {
  Comparison c = with(t, same_, 0);
  const Tessellation& mine = e_.tessellation;
  if (t.vertex_count() != mine.vertex_count() || t.triangle_count() != mine.triangle_count()) {
    c.bad += 1;
    c.message = fmt::format("{} vertices and {} triangles, but {} and {} {}", t.vertex_count(),
                            t.triangle_count(), mine.vertex_count(), mine.triangle_count(), where);
  }
  if (const std::int64_t corners = different_channels(mine, t); corners > 0) {
    if (c.bad == 0 && c.other_bits == 0) c.witness.reset();
    c.bad += corners;
    c.message = fmt::format("channels have other bits at {} corners of triangles", corners);
  }
  c.bad = std::max(c.bad, c.other_bits);
  c.worst = static_cast<double>(c.bad);
  return c;
}

std::optional<std::int64_t> Compared::with_same_bits(const Tessellation& t, std::int64_t k, const Variant& v,
                                                     Key key) const {
  Digest least{key, 0, 0};
  const bool same_arrays = t.has_normals() == e_.tessellation.has_normals();
  if (same_arrays) least.bits = digest(t, k, v);
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

Breakdown breakdown_of(const std::exception& error) {
  using Kind = SubjectDied::Kind;
  static const std::map<Kind, Breakdown> of_a_process{{Kind::kTimeout, {Status::kTimeout, Origin::kLimit}},
                                                      {Kind::kMemory, {Status::kCrash, Origin::kLimit}},
                                                      {Kind::kProtocol, {Status::kFinding, Origin::kSubject}},
                                                      {Kind::kCrash, {Status::kCrash, Origin::kSubject}}};
  if (const auto* died = dynamic_cast<const SubjectDied*>(&error)) return of_a_process.at(died->kind());
  const auto* refusal = dynamic_cast<const SubjectError*>(&error);
  if (refusal == nullptr || refusal->status() == LC_FAILED) return {Status::kError, Origin::kSubject};
  return {refusal->status() == LC_NOT_SUPPORTED ? Status::kNotSupported : Status::kFinding, Origin::kSubject};
}

RelationRow::RelationRow(const AuditSubject& subject, const Evidence& e, std::string_view name,
                         const char* unit, double bound)
    : subject_(subject), e_(e), r_(e.result(name, unit, bound)) {}

void RelationRow::ask(const std::string& what, const data::ControlMesh& mesh,
                      const std::function<void(Session&)>& work, const AuditSubject* other) {
  const AuditSubject& subject = other != nullptr ? *other : subject_;
  try {
    Session session(*subject.subject, mesh, subject.options, Session::Input::kValid, e_.lattice.scheme());
    work(session);
    session.close();
  } catch (const std::bad_alloc&) {
    throw;  // no memory of this program's
  } catch (const std::exception& error) {
    const auto [status, origin] = breakdown_of(error);
    if (status != Status::kNotSupported) ++r_.bad;
    note(status, fmt::format("{}: {}", what, error.what()), origin);
  }
}

void RelationRow::inspect(const std::string& what, const Tessellation& t) {
  const bool told = !e_.tessellation.defects().empty() || !e_.tessellation.overruns().empty();
  if (told || (t.defects().empty() && t.overruns().empty())) return;
  ++r_.bad;
  note(Status::kFinding, t.defects().empty()
                             ? fmt::format("{}: {} written outside its memory", what, t.overruns()[0].array)
                             : fmt::format("{}: {}", what, t.defects()[0].message));
}

void RelationRow::judge(const std::string& what, const Comparison& c, bool bits_matter) {
  count(c.bad, c.of);
  r_.not_finite += c.not_finite;
  if (!r_.worst || c.worst > *r_.worst) {
    r_.worst = c.worst;
    if (c.bad > 0 || r_.bad == 0) r_.witness = c.witness;  // a later variant without a fault shows nothing
    comparison_ = fmt::format(
        "{}: positions differ by up to {:.2g} diagonals, normals by {:.2g} degrees; {} of {} in bits", what,
        c.position, c.normal, c.other_bits, c.of);
  }
  if (c.split > 0) {
    r_.bad += c.split;
    if (c.bad == 0) r_.witness = c.split_at;
    note(Status::kFinding,
         fmt::format(
             "{}: {} vertices at points that faces share have other bits than the first one there, none in "
             "the original",
             what, c.split));
  }
  if (c.bad > 0)
    note(Status::kFinding, c.message.empty() ? "" : fmt::format("{}: {}", what, c.message));
  else if (bits_matter && c.other_bits > 0)
    note(Status::kQualityWarning, "");
}

void RelationRow::note(Status status, const std::string& message, std::optional<Origin> origin) {
  if (gravity(status) > gravity(r_.status)) r_.status = status, r_.origin = origin;
  if (message.empty() || r_.message.find(message) != std::string::npos) return;
  r_.message += (r_.message.empty() ? "" : " / ") + message;
}

Result RelationRow::take() {
  if (r_.message.empty()) r_.message = comparison_;
  if (r_.of == 0 && r_.status == Status::kHeld) r_.status = Status::kNotRun;
  if (r_.worst && !std::isfinite(*r_.worst)) r_.worst.reset();
  return std::move(r_);
}

void ask_in_turns(RelationRow& row, const AuditSubject& subject, const Evidence& e,
                  const Compared& compared) {
  std::optional<InTurns> here;
  if (subject.in_turns == nullptr) here.emplace(*subject.subject);
  AuditSubject turns{here ? &here->subject() : subject.in_turns, subject.options};
  std::string what = kTurns[0];
  const auto ask = [&](Session& session, int threads) {
    const Tessellation t = session.tessellate(e.face_depth, threads);
    row.inspect(what, t);
    if (same_arrays(t, e.tessellation)) {
      row.count(0, t.vertex_count());
      return;
    }
    row.judge(what, compared.bits_with(t, "at first"), false);
  };
  row.ask(
      what, e.mesh,
      [&](Session& session) {
        for (std::size_t k = 0; k < kTurns.size(); ++k) {
          what = kTurns[k];
          ask(session, k == 3 ? 8 : 1);
        }
      },
      &turns);
  for (const First& first : kFirst) {
    turns.options = first.option + subject.options;
    what = first.what;
    row.ask(
        what, e.mesh, [&](Session& session) { ask(session, 1); }, &turns);
  }
}

}  // namespace limitcheck::verify
