// SPDX-License-Identifier: MIT
#include "verify/relations/relations.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "verify/relations/relation_row.h"
#include "verify/relations/relation_state.h"
#include "verify/relations/sharp_variants.h"
#include "verify/row/bounds.h"
#include "verify/row/clock.h"

namespace limitcheck::verify {
namespace {

// Finds each row. A subject may break down in any request, which must not affect the other rows.
class Relations {
 public:
  Relations(const AuditSubject& subject, const Evidence& e, int threads)
      : subject_(subject), e_(e), threads_(threads), compared_(e) {}

  Result determinism() const {
    RelationRow row = begin("determinism", "points", 0);
    const Variant same = identity(e_);
    int request = 1;
    std::string what = "asked again";
    row.ask(what, e_.mesh, [&](Session& session) {
      for (const int threads : {1, 4, 1, 2}) {
        what = fmt::format("request {}, threads: {}", ++request, threads);
        const Tessellation t = session.tessellate(e_.face_depth, threads);
        row.inspect(what, t);
        Comparison c = compared_.with(t, same, 0);
        const Tessellation& mine = e_.tessellation;
        if (t.vertex_count() != mine.vertex_count() || t.triangle_count() != mine.triangle_count()) {
          c.bad += 1;
          c.message =
              fmt::format("{} vertices and {} triangles, but {} and {} in the first", t.vertex_count(),
                          t.triangle_count(), mine.vertex_count(), mine.triangle_count());
        }
        c.bad = std::max(c.bad, c.other_bits);
        c.worst = static_cast<double>(c.bad);
        row.judge(what, c, false);
      }
    });
    return row.take();
  }

  Result relation(const Relation& relation) const {
    RelationRow row = begin(relation.row, "bounds", 1);
    for (const Variant& v : relation.variants(e_))
      row.ask(v.name, v.mesh, [&](Session& session) {
        const Tessellation t = session.tessellate(v.face_depth, threads_);
        row.inspect(v.name, t);
        row.judge(v.name, compared_.with(t, v, 2), v.same_numbers);
      });
    Result r = row.take();
    // A size that the subject does not take is no fault, nor does it undo what was compared at others.
    if (r.status == Status::kNotSupported && r.of > 0) r.status = Status::kHeld;
    return r;
  }

  Result fractional_sharpness() const {
    RelationRow row = begin("fractional-sharpness", "bounds", 1);
    const Blend blend = *blend_of(e_.mesh, e_.lattice);
    std::vector<Vector> position(e_.lattice.size());
    std::vector<int> delivered(e_.lattice.size(), 0);
    for (const bool upper : {false, true}) {
      const float sharpness = upper ? blend.lower + 1 : blend.lower;
      const std::string what = fmt::format("with sharpness {}", sharpness);
      row.ask(what, with_sharpness(e_.mesh, sharpness), [&](Session& session) {
        const Tessellation t = session.tessellate(e_.face_depth, threads_);
        row.inspect(what, t);
        for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
          const Lattice::Id id = t.provenance_ok(v) ? e_.lattice.id(t.place(v)) : Lattice::kNone;
          if (id == Lattice::kNone || delivered[id] != (upper ? 1 : 0) || !is_finite(t.position(v))) continue;
          const double share = upper ? blend.share : 1 - blend.share;
          for (std::size_t c = 0; c < 3; ++c) position[id][c] += share * t.position(v)[c];
          ++delivered[id];
        }
      });
    }
    Comparison c;
    const double limit = 2 * position_bound(e_.capabilities.precision, e_.reference.steps(), e_.magnitude,
                                            std::max(e_.diagonal, 1e-300));
    for (std::int64_t v = 0; v < e_.tessellation.vertex_count(); ++v) {
      const Lattice::Id id = e_.point[v];
      const Vector got = e_.tessellation.position(v);
      if (id == Lattice::kNone || delivered[id] != 2 || !is_finite(got)) continue;
      ++c.of;
      const double off = norm(got - position[id]) / e_.diagonal;
      c.bad += !(off <= limit);
      c.position = std::max(c.position, off);
      if (c.witness && off / limit <= c.worst) continue;
      c.worst = off / limit;
      c.witness = e_.at_vertex(v);
      c.witness->expected = {position[id].begin(), position[id].end()};
      c.witness->got = {got.begin(), got.end()};
    }
    row.judge(fmt::format("against {:.3g} of sharpness {} and {:.3g} of {}", 1 - blend.share, blend.lower,
                          blend.share, blend.lower + 1),
              c, false);
    return row.take();
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
    if (refusals.empty()) refusals = ask_for_refusals(subject_, e_.lattice.scheme(), threads_);
    for (std::size_t k = 0; k < refusals.size(); ++k) {
      const Refusal& refusal = refusals[k];
      row.count(refusal.status != Status::kHeld, 1);
      row.note(refusal.status, refusal.message.empty()
                                   ? ""
                                   : fmt::format("{}: {}", broken_meshes()[k].what, refusal.message));
    }
    return row.take();
  }

 private:
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

}  // namespace

const std::vector<std::string_view>& relation_rows() {
  static const std::vector<std::string_view> rows = [] {
    std::vector<std::string_view> names{"determinism"};
    for (const Relation& r : variant_relations()) names.push_back(r.row);
    for (const Relation& r : sharp_relations()) names.push_back(r.row);
    names.emplace_back("fractional-sharpness");
    names.insert(names.end(), {"state", "degenerate-geometry", "rejected-inputs"});
    return names;
  }();
  return rows;
}

std::vector<std::string_view> relation_rows_of(const data::ControlMesh& mesh, data::Scheme scheme) {
  std::vector<std::string_view> rows = relation_rows();
  const Lattice lattice(mesh, scheme, 0);
  for (const Relation& r : sharp_relations())
    if (!r.applies(mesh, lattice)) std::erase(rows, r.row);
  if (!blend_of(mesh, lattice)) std::erase(rows, "fractional-sharpness");
  return rows;
}

std::vector<Result> check_relations(const AuditSubject& subject, const Evidence& e, int threads,
                                    std::vector<Refusal>& refusals,
                                    const std::function<void(std::string_view)>& on_row) {
  const Relations relations(subject, e, threads);
  std::vector<Result> results;
  const auto add = [&](std::string_view name, const std::function<Result()>& find) {
    if (on_row) on_row(name);
    const Clock clock;
    try {
      results.push_back(find());
      results.back().seconds = clock.seconds();
    } catch (const std::bad_alloc&) {
      throw;  // no memory of this program's
    } catch (const std::exception& error) {
      Result failed = e.result(std::string(name));
      failed.status = Status::kError;
      failed.message = fmt::format("the check itself failed: {}", error.what());
      results.push_back(std::move(failed));
    }
  };
  add("determinism", [&] { return relations.determinism(); });
  for (const Relation& r : variant_relations()) add(r.row, [&] { return relations.relation(r); });
  for (const Relation& r : sharp_relations())
    if (r.applies(e.mesh, e.lattice)) add(r.row, [&] { return relations.relation(r); });
  if (blend_of(e.mesh, e.lattice))
    add("fractional-sharpness", [&] { return relations.fractional_sharpness(); });
  add("state", [&] { return relations.state(results.front()); });
  add("degenerate-geometry", [&] { return relations.degenerate_geometry(); });
  add("rejected-inputs", [&] { return relations.rejected_inputs(refusals); });
  return results;
}

}  // namespace limitcheck::verify
