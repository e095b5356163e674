// SPDX-License-Identifier: MIT
#include "verify/audit/relations.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include "data/splitmix64.h"
#include "verify/audit/bounds.h"
#include "verify/audit/vector.h"

namespace limitcheck::verify {
namespace {

// The same surface, asked for otherwise, and how its points and faces belong to the original's.
struct Variant {
  data::ControlMesh mesh;
  std::vector<std::int32_t> face_depth;
  std::vector<std::int32_t> face;                         // of the original, for each face
  std::vector<std::array<std::uint8_t, 3>> corner;        // of that face, for each corner
  std::function<Vector(const Vector&)> position, normal;  // back to the original
  double magnitude = 0;                                   // largest coordinate
  bool normals = true;                                    // to be compared
  bool same_numbers = false;                              // a difference in bits is worth a warning
};

Variant identity(const Evidence& e) {
  Variant v;
  v.mesh = e.mesh;
  v.face_depth.assign(e.face_depth.begin(), e.face_depth.end());
  v.face.resize(e.mesh.triangles.size());
  std::iota(v.face.begin(), v.face.end(), 0);
  v.corner.assign(v.face.size(), {0, 1, 2});
  v.position = v.normal = [](const Vector& p) { return p; };
  v.magnitude = e.magnitude;
  return v;
}

std::vector<std::int32_t> shuffled(std::size_t count, std::uint64_t seed) {
  std::vector<std::int32_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  data::SplitMix64 random(seed);
  for (std::size_t k = count; k > 1; --k) std::swap(order[k - 1], order[random.next() % k]);
  return order;
}

Variant face_order(const Evidence& e) {
  Variant v = identity(e);
  v.face = shuffled(v.face.size(), 1);
  for (std::size_t f = 0; f < v.face.size(); ++f) {
    v.mesh.triangles[f] = e.mesh.triangles[v.face[f]];
    v.face_depth[f] = e.face_depth[v.face[f]];
  }
  v.same_numbers = true;
  return v;
}

Variant vertex_order(const Evidence& e) {
  Variant v = identity(e);
  const auto to = shuffled(e.mesh.positions.size(), 2);
  for (std::size_t k = 0; k < to.size(); ++k) v.mesh.positions[to[k]] = e.mesh.positions[k];
  for (auto& t : v.mesh.triangles)
    for (auto& c : t) c = to[c];
  v.same_numbers = true;
  return v;
}

Variant corner_rotation(const Evidence& e) {
  Variant v = identity(e);
  data::SplitMix64 random(3);
  for (std::size_t f = 0; f < v.face.size(); ++f) {
    const auto first = static_cast<std::uint8_t>(1 + random.next() % 2);
    for (std::uint8_t k = 0; k < 3; ++k) v.corner[f][k] = (first + k) % 3;
    for (std::size_t k = 0; k < 3; ++k) v.mesh.triangles[f][k] = e.mesh.triangles[f][v.corner[f][k]];
  }
  v.same_numbers = true;
  return v;
}

void move(Variant& v, const std::function<Vector(const Vector&)>& there) {
  v.magnitude = 0;
  for (Vector& p : v.mesh.positions) {
    p = there(p);
    v.magnitude = std::max(v.magnitude, largest(p));
  }
}

Variant mirror(const Evidence& e) {
  Variant v = identity(e);
  const auto flip = [](const Vector& p) { return Vector{-p[0], p[1], p[2]}; };
  move(v, flip);
  for (std::size_t f = 0; f < v.face.size(); ++f) {
    std::swap(v.mesh.triangles[f][1], v.mesh.triangles[f][2]);
    v.corner[f] = {0, 2, 1};
  }
  v.position = v.normal = flip;
  return v;
}

Variant rotation(const Evidence& e) {
  Variant v = identity(e);
  move(v, [](const Vector& p) { return Vector{p[1], -p[2], -p[0]}; });
  v.position = v.normal = [](const Vector& p) { return Vector{-p[2], p[0], -p[1]}; };
  return v;
}

Variant scaling(const Evidence& e, int exponent) {
  Variant v = identity(e);
  const auto times = [](int k) {
    return [k](const Vector& p) {
      return Vector{std::ldexp(p[0], k), std::ldexp(p[1], k), std::ldexp(p[2], k)};
    };
  };
  move(v, times(exponent));
  v.magnitude = e.magnitude;  // compared after scaling back
  v.position = times(-exponent);
  v.same_numbers = true;
  return v;
}

Variant translation(const Evidence& e) {
  Variant v = identity(e);
  const double step = std::ldexp(1.0, std::ilogb(std::max(e.diagonal, 1e-30)));
  const Vector by{step, -2 * step, 3 * step};
  move(v, [&](const Vector& p) { return p + by; });
  v.position = [by](const Vector& p) { return p - by; };
  v.normals = false;
  return v;
}

using Key = std::int64_t;
struct Placed {
  std::optional<Key> face_and_point;
  Lattice::Id id = Lattice::kNone;
};

// Where a vertex lies on the original mesh: its point, and that point together with the face that names it.
Placed place(const Evidence& e, const Variant& v, const lc_provenance& p) {
  if (p.face < 0 || static_cast<std::size_t>(p.face) >= v.face.size() || p.denominator == 0 ||
      std::int64_t{p.i} + p.j > p.denominator)
    return {};
  const std::array<std::uint32_t, 3> there{p.denominator - p.i - p.j, p.i, p.j};
  std::array<std::uint32_t, 3> here{};
  for (std::size_t k = 0; k < 3; ++k) here[v.corner[p.face][k]] = there[k];
  const lc_provenance q{v.face[p.face], here[1], here[2], p.denominator};
  const Lattice::Id id = e.lattice.id(q);
  if (id == Lattice::kNone) return {};
  return {id * static_cast<Key>(v.face.size()) + q.face, id};
}

// What one variant came to.
struct Comparison {
  std::int64_t of = 0, bad = 0, other_bits = 0;
  double position = 0, normal = 0;  // the largest differences: diagonals, degrees
  double worst = 0;                 // the largest of both in units of its bound
  std::optional<Witness> witness;
  std::string message;
};

class Compared {
 public:
  explicit Compared(const Evidence& e)
      : e_(e), uniform_(std::all_of(e.face_depth.begin(), e.face_depth.end(), [&](std::int32_t d) {
          return d == e.face_depth[0];
        })) {
    const Variant same = identity(e);
    for (std::int64_t v = 0; v < e.tessellation.vertex_count(); ++v) {
      const Placed at = place(e, same, e.tessellation.provenance()[v]);
      if (at.id == Lattice::kNone) continue;
      by_face_.emplace(*at.face_and_point, v);
      by_point_.emplace(at.id, v);
    }
  }

  /// `slack`: how many results' errors may add up.
  Comparison with(const Tessellation& t, const Variant& v, double slack) const {
    Comparison c;
    const int depth = e_.lattice.depth();
    const double position_limit =
        slack * position_bound(e_.capabilities.precision, depth, v.magnitude, std::max(e_.diagonal, 1e-300));
    const double normal_limit = slack * normal_bound(e_.capabilities.precision, depth);
    const bool normals = v.normals && t.has_normals() && e_.tessellation.has_normals();
    std::vector<bool> seen(static_cast<std::size_t>(e_.lattice.size()), false);
    const auto note = [&](double excess, std::int64_t mine, const Vector& expected, const Vector& got) {
      if (c.witness && excess <= c.worst) return;
      c.worst = excess;
      c.witness = e_.at_vertex(mine);
      c.witness->expected = {expected.begin(), expected.end()};
      c.witness->got = {got.begin(), got.end()};
    };
    for (std::int64_t k = 0; k < t.vertex_count(); ++k) {
      const Placed at = place(e_, v, t.provenance()[k]);
      if (at.id == Lattice::kNone) continue;
      const auto exact = by_face_.find(*at.face_and_point);
      const auto any = by_point_.find(at.id);
      ++c.of;
      if (any == by_point_.end()) {
        if (!uniform_) continue;
        ++c.bad;
        c.message = "a point that the original does not have";
        continue;
      }
      seen[at.id] = true;
      std::int64_t mine = exact != by_face_.end() ? exact->second : any->second;
      for (auto [k2, last] = by_face_.equal_range(*at.face_and_point); k2 != last; ++k2)
        if (same(t, k, v, k2->second)) mine = k2->second;
      const Vector p = v.position(t.position(k)), q = e_.tessellation.position(mine);
      double off = norm(p - q) / e_.diagonal;
      if (!std::isfinite(off)) off = p == q ? 0 : std::numeric_limits<double>::infinity();
      c.position = std::max(c.position, off);
      bool wrong = !(off <= position_limit), bits = p == q;
      note(position_limit > 0 ? off / position_limit : off > 0 ? 1e300 : 0, mine, q, p);
      if (normals && e_.reference.has_normal(at.id)) {
        const Vector a = v.normal(t.normal(k)), b = e_.tessellation.normal(mine);
        const double angle = a == b ? 0 : angle_degrees(a, b);
        c.normal = std::max(c.normal, angle);
        wrong = wrong || !(angle <= normal_limit);
        bits = bits && a == b;
        note(normal_limit > 0 ? angle / normal_limit : angle > 0 ? 1e300 : 0, mine, b, a);
      }
      c.bad += wrong;
      c.other_bits += !bits;
    }
    // A face may be displayed deeper than asked for where its neighbours are: which, may depend on the order.
    for (const auto& [id, vertex] : by_point_)
      if (uniform_ && !seen[id]) {
        ++c.of;
        ++c.bad;
        c.message = "a point of the original is missing";
      }
    return c;
  }

 private:
  bool same(const Tessellation& t, std::int64_t k, const Variant& v, std::int64_t mine) const {
    return v.position(t.position(k)) == e_.tessellation.position(mine) &&
           (!t.has_normals() || !e_.tessellation.has_normals() ||
            v.normal(t.normal(k)) == e_.tessellation.normal(mine));
  }

  const Evidence& e_;
  const bool uniform_;
  std::unordered_multimap<Key, std::int64_t> by_face_;  // a face may deliver a point more than once
  std::unordered_map<Lattice::Id, std::int64_t> by_point_;
};

class Relations {
 public:
  Relations(const AuditSubject& subject, const Evidence& e, int threads)
      : subject_(subject), e_(e), threads_(threads), compared_(e) {}

  std::vector<Result> run() {
    determinism();
    relation("face-order", {face_order(e_)});
    relation("vertex-order", {vertex_order(e_)});
    relation("corner-rotation", {corner_rotation(e_)});
    relation("mirror", {mirror(e_)});
    relation("rotation", {rotation(e_)});
    relation("scaling", {scaling(e_, 10), scaling(e_, -10)});
    relation("translation", {translation(e_)});
    relation("extreme-scale", {scaling(e_, 40), scaling(e_, -40)});
    degenerate();
    rejected();
    return std::move(results_);
  }

 private:
  Result& row(const char* name) {
    results_.push_back(e_.result(name));
    return results_.back();
  }

  // A subject that gives up on a variant of what it could do is at fault, unless it says that it cannot.
  static void give_up(Result& r, const std::exception& error) {
    const auto* refusal = dynamic_cast<const SubjectError*>(&error);
    const bool unsupported = refusal != nullptr && refusal->status() == LC_NOT_SUPPORTED;
    r.status = unsupported ? Status::kNotSupported : Status::kFinding;
    r.message = error.what();
    r.bad += !unsupported;
  }

  void judge(Result& r, const Comparison& c, bool bits_matter) {
    r.of += c.of;
    r.bad += c.bad;
    if (!r.worst || c.worst > *r.worst) {
      r.worst = c.worst;
      r.witness = c.witness;
      r.message = fmt::format(
          "positions differ by up to {:.2g} diagonals, normals by {:.2g} degrees; {} of {} in bits",
          c.position, c.normal, c.other_bits, c.of);
    }
    if (!c.message.empty()) r.message = c.message;
    if (r.bad > 0)
      r.status = Status::kFinding;
    else if (r.status != Status::kFinding && bits_matter && c.other_bits > 0)
      r.status = Status::kQualityWarning;
    if (r.worst && !std::isfinite(*r.worst)) r.worst.reset();
  }

  void relation(const char* name, const std::vector<Variant>& variants) {
    Result& r = row(name);
    r.bound = 1;
    r.unit = "bounds";
    for (const Variant& v : variants) {
      try {
        Session session(*subject_.subject, v.mesh, subject_.options);
        judge(r, compared_.with(session.tessellate(v.face_depth, threads_), v, 2), v.same_numbers);
      } catch (const std::exception& error) {
        give_up(r, error);
        return;
      }
    }
    if (r.of == 0) r.status = Status::kNotRun;
  }

  void determinism() {
    Result& r = row("determinism");
    r.bound = 0;
    r.unit = "points";
    const Variant same = identity(e_);
    try {
      Session session(*subject_.subject, e_.mesh, subject_.options);
      for (const int threads : {1, 4, 1, 2}) {
        const Tessellation t = session.tessellate(e_.face_depth, threads);
        Comparison c = compared_.with(t, same, 0);
        const auto& mine = e_.tessellation;
        if (t.vertex_count() != mine.vertex_count() || t.triangle_count() != mine.triangle_count()) {
          c.bad += 1;
          c.message =
              fmt::format("{} vertices and {} triangles the one time, {} and {} the other",
                          mine.vertex_count(), mine.triangle_count(), t.vertex_count(), t.triangle_count());
        }
        c.bad = std::max(c.bad, c.other_bits);
        c.worst = static_cast<double>(c.bad);
        judge(r, c, false);
      }
    } catch (const std::exception& error) {
      give_up(r, error);
    }
  }

  void degenerate() {
    Result& r = row("degenerate-geometry");
    r.unit = "vertices";
    r.bound = 0;
    for (const bool line : {true, false}) {
      data::ControlMesh mesh = e_.mesh;
      for (Vector& p : mesh.positions) p = {line ? p[0] : 1.0, 1, 1};
      try {
        Session session(*subject_.subject, mesh, subject_.options);
        const Tessellation t = session.tessellate(e_.face_depth, threads_);
        for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
          ++r.of;
          const bool normal = !t.has_normals() ||
                              (is_finite(t.normal(v)) &&
                               std::abs(norm(t.normal(v)) - 1) <= length_bound(e_.capabilities.precision));
          if (is_finite(t.position(v)) && normal) continue;
          if (r.bad++ > 0) continue;
          r.message =
              fmt::format("with all control points {}: position or normal not finite, or no unit normal",
                          line ? "on a line" : "the same");
          r.witness = e_.at_vertex(std::min(v, e_.tessellation.vertex_count() - 1));
          const Vector p = t.position(v), n = t.has_normals() ? t.normal(v) : p;
          r.witness->got = {n.begin(), n.end()};
        }
      } catch (const std::exception& error) {
        give_up(r, error);
        return;
      }
    }
    if (r.bad > 0) r.status = Status::kFinding;
  }

  void rejected() {
    Result& r = row("rejected-inputs");
    r.unit = "meshes";
    r.bound = 0;
    const std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                     {1, 1, 1}, {2, 0, 1}, {0, 2, 1}};
    const std::vector<std::pair<const char*, data::ControlMesh>> meshes{
        {"an edge with three faces", {points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {4, 5, 6}}}},
        {"two faces of opposite orientation", {points, {{0, 1, 2}, {0, 1, 3}, {4, 5, 6}}}},
        {"two fans that meet in a vertex", {points, {{0, 1, 2}, {0, 3, 4}, {4, 5, 6}}}},
        {"no faces", {points, {}}},
    };
    for (const auto& [what, mesh] : meshes) {
      ++r.of;
      try {
        Session session(*subject_.subject, mesh, subject_.options);
        const Tessellation t = session.tessellate(1, threads_);
        if (mesh.triangles.empty() && t.triangle_count() == 0) continue;  // nothing of nothing
        ++r.bad;
        r.message += fmt::format("{}{}", r.message.empty() ? "accepted: " : ", ", what);
      } catch (const SubjectError&) {
      } catch (const std::exception& error) {
        r.message += error.what();
        ++r.bad;
      }
    }
    if (r.bad > 0) r.status = Status::kFinding;
  }

  const AuditSubject& subject_;
  const Evidence& e_;
  const int threads_;
  const Compared compared_;
  std::vector<Result> results_;
};

}  // namespace

const std::vector<std::string_view>& relation_rows() {
  static const std::vector<std::string_view> rows{
      "determinism", "face-order",  "vertex-order",  "corner-rotation",     "mirror",         "rotation",
      "scaling",     "translation", "extreme-scale", "degenerate-geometry", "rejected-inputs"};
  return rows;
}

std::vector<Result> check_relations(const AuditSubject& subject, const Evidence& e, int threads) {
  return Relations(subject, e, threads).run();
}

}  // namespace limitcheck::verify
