// SPDX-License-Identifier: MIT
#include "verify/relations/relations.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <utility>

#include "verify/relations/relation_row.h"
#include "verify/relations/variants.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {
namespace {

// Finds each row. A subject may break down in any request, which must not affect the other rows.
class Relations {
 public:
  Relations(const AuditSubject& subject, const Evidence& e, int threads)
      : subject_(subject), e_(e), threads_(threads), compared_(e) {}

  // Again, if so asked; and twice at one depth, with 1 and 4 threads: the greatest at which all faces are kDeep
  // triangles.
  Result determinism(bool again) const {
    RelationRow row = begin("determinism", "points", 0);
    int request = 1;
    std::string what = "asked again";
    if (again)
      row.ask(what, e_.mesh, [&](Session& session) {
        for (const int threads : {1, 4, 1, 2}) {
          what = fmt::format("request {}, threads: {}", ++request, threads);
          const Tessellation t = session.tessellate(e_.face_depth, threads);
          row.inspect(what, t);
          row.judge(what, compared_.bits_with(t, "in the first"), false);
        }
      });
    constexpr double kDeep = 8192;
    double triangles = 0;  // at depth 0
    for (std::size_t f = 0; f < e_.mesh.faces.size(); ++f)
      triangles +=
          e_.lattice.scheme() == data::Scheme::kLoop ? 1 : .5 * static_cast<double>(e_.mesh.faces[f].size());
    int depth = -1;
    while (depth < e_.capabilities.max_depth && std::ldexp(triangles, 2 * (depth + 1)) <= kDeep) ++depth;
    if (depth < 0) return done(row);
    what = fmt::format("at depth {} with 1 thread and with 4", depth);
    row.ask(what, e_.mesh, [&](Session& session) {
      const Tessellation a = session.tessellate(depth, 1), b = session.tessellate(depth, 4);
      const auto bad = different_points(a, b) + different_channels(a, b);
      row.count(bad, a.vertex_count());
      if (bad > 0) row.note(Status::kFinding, fmt::format("{}: {} points have other bits", what, bad));
    });
    return done(row);
  }

  Result relation(const Relation& relation) const {
    RelationRow row = begin(relation.row, "bounds", 1);
    for (const Variant& v : relation.variants(e_))
      row.ask(v.name, v.mesh, [&](Session& session) {
        const Tessellation t = session.tessellate(v.face_depth, threads_);
        row.inspect(v.name, t);
        row.judge(v.name, compared_.with(t, v, 2), v.same_numbers);
      });
    return done(row);
  }

  // With one sharpness s for all its semi-sharp edges and vertices, in whole steps and one of fraction f, each
  // point of that one step is 1 - f of the point without and f of the point with it, and no other step knows
  // of f: the surface is linear in s between whole numbers, and continuous below 10. Three results make the
  // difference, of whose errors the bound has two in all.
  Result fractional_sharpness() const {
    RelationRow row = begin("fractional-sharpness", "bounds", 1);
    const Surfaces surfaces(*this, row);
    std::vector<float> fractions{0x1p-10F, std::nextafter(1.F, 0.F), std::nextafter(1.F, 2.F),
                                 std::nextafter(2.F, 0.F), std::nextafter(2.F, 3.F)};
    if (const auto own = common_sharpness(e_.mesh); own && *own < 9 && *own != std::floor(*own))
      fractions.push_back(*own);
    for (const float s : fractions) {
      const float lower = std::floor(s);
      const double share = static_cast<double>(s) - lower;
      Surfaces::Points mix = surfaces.at(lower);
      for (std::size_t k = 0; k < mix.size(); ++k)
        mix[k] = (1 - share) * mix[k] + share * surfaces.at(lower + 1)[k];
      surfaces.compare(fmt::format("sharpness {} against {:.3g} of sharpness {} and {:.3g} of {}", s,
                                   1 - share, lower, share, lower + 1),
                       surfaces.at(s), mix, 0);
    }
    // From 10 on sharpness is for ever. The rings in which limits still differ shrink by 3/8 + 1/4 or
    // (3 + sqrt 5)/8 a step and more: all that is to come from 9 on is less than twice the step to 9. As much
    // again is left for what is not yet in proportion.
    if (!does_sharp(e_.capabilities.sharp, with_sharpness(e_.mesh, 10), e_.lattice.scheme()))
      return row.take();
    const float below = std::nextafter(10.F, 9.F), above = std::nextafter(10.F, 11.F);
    const double step = 4 * surfaces.distance(surfaces.at(8), surfaces.at(9));
    surfaces.compare(fmt::format("sharpness {} against {}", below, 9), surfaces.at(below), surfaces.at(9),
                     step);
    surfaces.compare(fmt::format("sharpness {} against {}", 10, below), surfaces.at(10), surfaces.at(below),
                     step);
    surfaces.compare(fmt::format("sharpness {} against {}", above, 10), surfaces.at(above), surfaces.at(10),
                     0);
    return done(row);
  }

  Result degenerate_geometry() const {
    RelationRow row = begin("degenerate-geometry", "vertices", 0);
    for (const bool line : {true, false}) {
      const std::string what =
          fmt::format("with all control points {}", line ? "on a line" : "at the same place");
      data::ControlMesh mesh = e_.mesh;
      for (Vector& p : mesh.positions) p = {line ? p[0] : 1.0, 1, 1};
      row.ask(what, mesh, [&](Session& session) {
        const Tessellation t = session.tessellate(e_.face_depth, threads_);
        row.inspect(what, t);
        row.count(0, t.vertex_count());
        std::int64_t of_old = not_finite(e_.tessellation);  // so many are the business of `finite`
        for (std::int64_t v = 0; v < t.vertex_count(); ++v)
          if (!is_displayable(t, v) && (is_finite(t, v) || of_old-- <= 0)) {
            row.count(1, 0);
            row.note(Status::kFinding, what + ": position or normal not finite, or no unit normal");
            row.witness(witness(t, v));
          }
      });
    }
    return row.take();
  }

  Result state(const Result& determinism) const {
    RelationRow row = begin("state", "points", 0);
    if (is_bad(determinism)) {
      row.note(Status::kNotRun, "the same request twice gives other bits: see determinism");
      return row.take();
    }
    ask_in_turns(row, subject_, e_, compared_);
    return row.take();
  }

  Result rejected_inputs(std::vector<Refusal>& refusals) const {
    RelationRow row = begin("rejected-inputs", "meshes", 0);
    if (e_.capabilities.does_not_validate != 0) {
      row.note(Status::kNotSupported, "not asked: does not validate");
      return row.take();
    }
    if (refusals.empty())
      refusals = ask_for_refusals(subject_, e_.lattice.scheme(), threads_, e_.capabilities.sharp);
    for (std::size_t k = 0; k < refusals.size(); ++k) {
      const Refusal& refusal = refusals[k];
      if (!refusal.asked) continue;
      row.count(refusal.status != Status::kHeld, 1);
      if (refusal.status == Status::kFinding) row.accepted(broken_meshes()[k].what);
      row.note(refusal.status,
               refusal.message.empty() ? "" : fmt::format("{}: {}", broken_meshes()[k].what, refusal.message),
               refusal.origin);
    }
    return row.take();
  }

 private:
  // Positions with one sharpness for all semi-sharp edges and vertices, asked for when first needed.
  class Surfaces {
   public:
    using Points = std::vector<Vector>;  // of the lattice; NaN where nothing was delivered

    Surfaces(const Relations& of, RelationRow& row) : of_(of), e_(of.e_), row_(row) {
      if (const auto own = common_sharpness(e_.mesh)) points(e_.tessellation, fresh(*own));
    }

    const Points& at(float sharpness) const {
      if (const auto known = known_.find(sharpness); known != known_.end()) return known->second;
      Points& there = fresh(sharpness);
      const std::string what = fmt::format("with sharpness {}", sharpness);
      row_.ask(what, with_sharpness(e_.mesh, sharpness), [&](Session& session) {
        const Tessellation t = session.tessellate(e_.face_depth, of_.threads_);
        row_.inspect(what, t);
        points(t, there);
      });
      return there;
    }

    // The largest, in diagonals.
    double distance(const Points& a, const Points& b) const {
      double most = 0;
      for (std::size_t k = 0; k < a.size(); ++k)
        if (is_finite(a[k]) && is_finite(b[k])) most = std::max(most, norm(a[k] - b[k]) / e_.diagonal);
      return most;
    }

    // They may differ by two results' errors and as many diagonals.
    void compare(const std::string& what, const Points& got, const Points& expected, double more) const {
      constexpr int kMostSteps = 10;  // of another sharpness than the mesh has
      Comparison c;
      for (std::size_t k = 0; k < got.size(); ++k) {
        if (!is_finite(got[k]) || !is_finite(expected[k])) continue;
        ++c.of;
        const auto id = static_cast<Lattice::Id>(k);
        const double limit =
            more + 2 * position_bound(e_.capabilities.precision, std::max(e_.reference.steps(), kMostSteps),
                                      e_.magnitude, e_.diagonal, e_.reference.terms_at(id));
        const double off = norm(got[k] - expected[k]) / e_.diagonal;
        c.bad += off > limit;
        c.position = std::max(c.position, off);
        if (c.witness && off / limit <= c.worst) continue;
        c.worst = off / limit;
        c.witness = e_.at_point(id);
        c.witness->show(expected[k], got[k]);
      }
      row_.judge(what, c, false);
    }

   private:
    Points& fresh(float sharpness) const {
      constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
      return known_.try_emplace(sharpness, e_.lattice.size(), Vector{kNowhere, kNowhere, kNowhere})
          .first->second;
    }
    void points(const Tessellation& t, Points& to) const {
      for (std::int64_t v = 0; v < t.vertex_count(); ++v)
        if (const Lattice::Id id = t.provenance_ok(v) ? e_.lattice.id(t.place(v)) : Lattice::kNone;
            id != Lattice::kNone)
          to[id] = t.position(v);
    }

    const Relations& of_;
    const Evidence& e_;
    RelationRow& row_;
    mutable std::map<float, Points> known_;
  };

  // A size that the subject does not take is no fault, nor does it undo what was compared at others.
  static Result done(RelationRow& row) {
    Result r = row.take();
    if (r.status == Status::kNotSupported && r.of > 0) r.status = Status::kHeld;
    return r;
  }

  RelationRow begin(std::string_view name, const char* unit, double bound) const {
    return {subject_, e_, name, unit, bound};
  }

  bool is_displayable(const Tessellation& t, std::int64_t v) const {
    return is_finite(t, v) &&
           (!t.has_normals() || std::abs(norm(t.normal(v)) - 1) <= length_bound(e_.capabilities.precision));
  }

  // Vertices are matched by their place in the list, because on degenerate geometry nothing else tells them
  // apart.
  Witness witness(const Tessellation& t, std::int64_t v) const {
    Witness w;
    if (v < e_.tessellation.vertex_count()) w = e_.at_vertex(v);
    const Vector shown = t.has_normals() ? t.normal(v) : t.position(v);
    w.got = {shown.begin(), shown.end()};
    return w;
  }

  const AuditSubject& subject_;
  const Evidence& e_;
  const int threads_;
  const Compared compared_;
};

// The rows as they are found.
struct Rows {
  const Evidence& e;
  const std::function<bool(std::string_view)>& on_row;
  std::vector<Result> results;

  void add(std::string_view name, const std::function<Result()>& find) {
    if (!on_row(name)) return;
    const Clock clock;
    try {
      results.push_back(find());
      results.back().seconds = clock.seconds();
    } catch (const std::bad_alloc&) {
      throw;  // no memory of this program's
    } catch (const std::exception& error) {
      Result failed = e.result(name);
      failed.status = Status::kError;
      failed.message = fmt::format("the check itself failed: {}", error.what());
      results.push_back(std::move(failed));
    }
  }
};

}  // namespace

const std::vector<std::string_view>& relation_rows() {
  static const std::vector<std::string_view> rows = [] {
    std::vector<std::string_view> names{"determinism"};
    for (const Relation& r : surface_relations()) names.push_back(r.row);
    names.insert(names.end(), {"fractional-sharpness", "state", "degenerate-geometry", "rejected-inputs"});
    return names;
  }();
  return rows;
}

std::vector<std::string_view> relation_rows_of(const data::ControlMesh& mesh, data::Scheme scheme) {
  std::vector<std::string_view> rows = relation_rows();
  const Lattice lattice(mesh, scheme, 0);
  for (const Relation& r : surface_relations())
    if (!r.applies(mesh, lattice)) std::erase(rows, r.row);
  if (!has_semi_sharp(mesh)) std::erase(rows, "fractional-sharpness");
  return rows;
}

std::vector<Result> check_relations(const AuditSubject& subject, const Evidence& e, int threads,
                                    std::vector<Refusal>& refusals, bool again,
                                    const std::function<bool(std::string_view)>& on_row) {
  const Relations relations(subject, e, threads);
  Rows rows{e, on_row, {}};
  rows.add("determinism", [&] { return relations.determinism(again); });
  for (const Relation& r : surface_relations())
    if (r.applies(e.mesh, e.lattice)) rows.add(r.row, [&] { return relations.relation(r); });
  if (has_semi_sharp(e.mesh))
    rows.add("fractional-sharpness", [&] { return relations.fractional_sharpness(); });
  rows.add("state", [&] {
    const bool asked = !rows.results.empty() && rows.results.front().check == "determinism";
    return relations.state(asked ? rows.results.front() : relations.determinism(true));
  });
  rows.add("degenerate-geometry", [&] { return relations.degenerate_geometry(); });
  rows.add("rejected-inputs", [&] { return relations.rejected_inputs(refusals); });
  return std::move(rows.results);
}

}  // namespace limitcheck::verify
