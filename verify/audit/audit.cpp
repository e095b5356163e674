// SPDX-License-Identifier: MIT
#include "verify/audit/audit.h"

#include <fmt/core.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <utility>

#include "verify/checks/check_oracle.h"
#include "verify/checks/checks.h"
#include "verify/evidence/cells.h"
#include "verify/evidence/vector.h"
#include "verify/host/host.h"
#include "verify/host/matching.h"
#include "verify/interrupt/interrupt.h"
#include "verify/relations/relation_row.h"
#include "verify/report/json.h"
#include "verify/row/statistics.h"
#include "verify/subject/weights_option.h"

namespace limitcheck::verify {
namespace {

bool has_boundary(const AuditMesh& audited) {
  const Lattice lattice(audited.mesh, audited.scheme(), 0);
  return std::any_of(lattice.edges().begin(), lattice.edges().end(),
                     [](const Lattice::Edge& edge) { return edge.on_boundary(); });
}

// A subject answered "not supported": why its capabilities say that it does support this request. Empty if
// they do not, or cannot say so: of sizes beyond 2^-40 and 2^40, where the squares of floats overflow or
// vanish, and of more triangles than 32-bit indices name.
std::string contradicts_capabilities(const std::exception& error, const AuditSubject& audited,
                                     const AuditMesh& mesh, std::span<const std::int32_t> asked) {
  const auto* refusal = dynamic_cast<const SubjectError*>(&error);
  if (refusal == nullptr || refusal->status() != LC_NOT_SUPPORTED ||
      dynamic_cast<const NotAsked*>(refusal) != nullptr)
    return {};
  double size = 0, triangles = 0;
  for (const Vector& p : mesh.mesh.positions) size = std::max(size, largest(p));
  for (std::size_t f = 0; f < asked.size(); ++f) {
    const auto corners = static_cast<double>(mesh.mesh.faces[f].size());
    const double of_face = mesh.scheme() == data::Scheme::kLoop ? 1 : corners / 2;  // at depth 0
    triangles += asked[f] < 0 ? 0 : std::ldexp(of_face, 2 * asked[f]);
  }
  constexpr double kIndexed = 4294967295.0 / 6;  // halfedges included
  if (size < std::ldexp(1.0, -40) || size > std::ldexp(1.0, 40) || triangles > kIndexed) return {};
  try {
    const lc_capabilities c = capabilities(*audited.subject, audited.options, mesh.scheme());
    if (!does(c, mesh.scheme())) return {};
    if (!has_boundary(mesh)) return "its capabilities do not exclude this";
    if (c.boundary != LC_BOUNDARY_NONE) return "its capabilities say that it takes open meshes";
  } catch (const SubjectError&) {  // then there is nothing to hold it to
  }
  return {};
}

// The truth at every point that the subject names. Returns why there is none, or nothing.
std::string prepare(ReferenceSurface& truth, std::span<const Lattice::Id> points) {
  try {
    truth.prepare(points);
  } catch (const std::bad_alloc&) {
    throw;  // no memory of this program's
  } catch (const std::exception& error) {
    return fmt::format("the reference failed: {}", error.what());
  }
  return {};
}

// Whether the relations belong to the audit of a mesh, of which this is judged.
bool related(Level level, const AuditMesh& mesh, const data::ControlMesh& judged) {
  return mesh.relations && (level == Level::kThorough ||
                            (level == Level::kStandard && size_for_relations(judged) <= kRelationFaces));
}

// The rows of relations of the audit of a mesh.
std::vector<std::string_view> rows_of_relations(Level level, const AuditMesh& mesh,
                                                const data::ControlMesh& judged) {
  if (related(level, mesh, judged)) return relation_rows_of(judged, mesh.scheme());
  if (level == Level::kQuick || mesh.sample) return {};
  std::vector<std::string_view> rows;
  if (mesh.asked_again) rows.emplace_back("determinism");
  if (mesh.turned) rows.emplace_back("corner-rotation");
  return rows;
}

// How the places of a subject without provenance were found.
std::string of_places(const Tessellation& t) {
  const Matching* found = t.matching();
  if (found == nullptr) return {};
  std::string text = "places found by how the triangles are connected";
  if (found->welded) text += ", points at equal coordinates taken for one";
  if (found->ways > 1)
    text += fmt::format(
        "; they can be laid on the mesh in {}{} ways, and the one nearest to the surface was chosen",
        found->ways, found->ways == kMostWays ? " and more" : "");
  return text;
}

// The subject is done, and may still break down while it cleans up.
void close(Session& session, Result& tessellates) {
  try {
    session.close();
  } catch (const std::bad_alloc&) {
    throw;  // no memory of this program's
  } catch (const std::exception& error) {
    const auto [status, origin] = breakdown_of(error);
    tessellates.status = status, tessellates.origin = origin;
    tessellates.bad = 1;
    tessellates.message = fmt::format("at the end: {}", error.what());
  }
}

}  // namespace

// Collects the rows of one subject on one mesh.
struct Auditor::Rows {
  std::string subject, mesh;
  std::vector<Result>& results;

  void add(std::string_view check, Status status, const std::string& message) const {
    results.push_back({.subject = subject,
                       .mesh = mesh,
                       .check = std::string(check),
                       .status = status,
                       .message = message});
  }
  // The row `tessellates` of a subject that does not.
  void add_failure(const std::exception& error, const std::string& contradiction) const {
    const auto [status, origin] = breakdown_of(error);
    add("tessellates", contradiction.empty() ? status : Status::kFinding,
        contradiction.empty() ? error.what() : fmt::format("{}; {}", error.what(), contradiction));
    Result& row = results.back();
    row.of = 1, row.bad = is_bad(row), row.origin = origin;
  }
  // Not judged, for no fault of the subject.
  void add_lack(std::string_view check, const std::string& why) const {
    add(check, Status::kNotRun, why);
    results.back().origin = Origin::kHost;
  }
};

Auditor::Auditor(int depth, int threads, std::function<void(const AuditStep&)> on_step, Level level)
    : depth_(depth), threads_(threads), level_(level), shared_(std::make_shared<Shared>()) {
  shared_->on_step = std::move(on_step);
}

Auditor::~Auditor() = default;

void Auditor::step(const std::string& subject, const std::string& mesh, std::string_view check) {
  if (interrupted() != 0) return;  // nobody may be there any more
  if (keep_rows_) keep_rows_();
  const std::scoped_lock lock(shared_->mutex);
  if (shared_->on_step) shared_->on_step({subject, mesh, std::string(check), shared_->done, shared_->total});
}

ReferenceSurface& Auditor::reference(const data::ControlMesh& rounded, data::Scheme scheme, int depth,
                                     const lc_capabilities& capabilities) {
  const reference::Weights weights = family(capabilities.weights);
  for (const auto& kept : cache_)
    if (kept->points() == capabilities.points && kept->weights() == weights &&
        kept->lattice().scheme() == scheme && kept->lattice().depth() == depth && kept->mesh() == rounded)
      return *kept;
  cache_.push_back(std::make_unique<ReferenceSurface>(rounded, scheme, depth, capabilities.points, weights));
  return *cache_.back();
}

std::vector<Result> Auditor::run(const AuditSubject& audited, const AuditMesh& mesh) {
  if (shared_->wanted && row_names(audited, mesh).empty()) return {};
  // The rows as they come, and those that were there before the last check. Work that is left keeps both.
  struct Kept {
    std::vector<Result> rows;
    std::mutex mutex;
    std::vector<Result> kept;
  };
  const auto shared = std::make_shared<Kept>();
  std::string lack;
  bool left = false;
  const bool begun = interrupted() == 0;
  try {
    if (interrupted() == 0 && !leaves_) {
      judge(audited, mesh, shared->rows);
    } else if (interrupted() == 0) {
      keep_rows_ = [shared] {
        const std::scoped_lock lock(shared->mutex);
        shared->kept = shared->rows;
      };
      left = !run_or_abandon([this, &audited, &mesh, shared] { judge(audited, mesh, shared->rows); });
    }
  } catch (const Interrupted&) {
  } catch (const std::bad_alloc&) {
    lack = "this program ran out of memory";
  } catch (const HostLacks& host) {
    lack = host.text();
  }
  std::vector<Result> results;
  if (left) {
    abandoned_ = true;
    const std::scoped_lock lock(shared->mutex);
    results = shared->kept;
  } else {
    results = std::move(shared->rows);
  }
  if (!lack.empty()) {
    forget();
    lack_ = lack;
  }
  // Witnesses on a sample name the faces of the whole mesh, also in rows of an audit that was interrupted.
  if (mesh.sample)
    for (Result& r : results)
      if (r.witness && r.witness->face >= 0) r.witness->face = mesh.sample->faces()[r.witness->face];
  if (interrupted() != 0 || !lack.empty()) add_missing(audited, mesh, begun, lack, results);
  std::erase_if(results, [&](const Result& r) { return !wants(audited, mesh, r.check); });
  for (Result& r : results) {
    r.depth = depth_of(mesh);
    r.depths = mesh.depths;
    r.scheme = mesh.scheme();
    r.triangulated = mesh.triangulated;
    if (mesh.sample) r.sample = mesh.sample->text();
  }
  return results;
}

std::vector<std::string> Auditor::row_names(const AuditSubject& audited, const AuditMesh& mesh) const {
  std::vector<std::string> rows{"tessellates"};
  if (is_oracle(audited)) {
    rows = {"oracle-faces", "oracle-double", "oracle-parts"};
  } else {
    for (const Check& check : checks())
      if (has_matter(check, mesh.mesh)) rows.insert(rows.end(), check.rows.begin(), check.rows.end());
    for (const std::string_view row :
         rows_of_relations(level_, mesh, mesh.sample ? mesh.sample->part() : mesh.mesh))
      rows.emplace_back(row);
  }
  std::erase_if(rows, [&](const std::string& row) { return !wants(audited, mesh, row); });
  return rows;
}

void Auditor::add_missing(const AuditSubject& audited, const AuditMesh& mesh, bool begun,
                          const std::string& lack, std::vector<Result>& results) {
  std::vector<std::string> missing{"tessellates"};
  if (begun && !is_oracle(audited)) missing = row_names(audited, mesh);
  std::erase_if(missing, [&](const std::string& check) {
    return std::any_of(results.begin(), results.end(), [&](const Result& r) { return r.check == check; });
  });
  if (lack.empty() && !missing.empty()) gave_up_ = true;
  const Rows rows{audited.label(), mesh.name, results};
  for (const std::string& check : missing)
    if (lack.empty())
      rows.add(check, Status::kNotRun, "interrupted");
    else
      rows.add_lack(check, lack);
}

void Auditor::forget() {
  guesses_.clear();
  cache_.clear();
}

void Auditor::judge(const AuditSubject& audited, const AuditMesh& mesh, std::vector<Result>& results) {
  if (cached_mesh_ != mesh.name) {
    forget();
    malloc_trim(0);  // the heaps of many threads keep what they had, gigabytes in the end
  }
  cached_mesh_ = mesh.name;
  const Rows rows{audited.label(), mesh.name, results};
  if (is_oracle(audited)) {
    step(rows.subject, mesh.name, "oracle-faces");
    for (Result& r : check_oracle(mesh)) results.push_back(std::move(r));
    return;
  }

  // The whole mesh is tessellated, and all of it but a sample is culled.
  const MeshSample* sample = mesh.sample.get();
  std::vector<std::int32_t> asked = asked_depths(mesh, depth_of(mesh));
  std::optional<Session> session;
  std::optional<Tessellation> tessellation;
  const Clock clock;
  try {
    step(rows.subject, mesh.name, "tessellates");
    session.emplace(*audited.subject, mesh.mesh, audited.options, Session::Input::kValid, mesh.scheme());
    warm_up(*session, mesh, depth_of(mesh), threads_);
    tessellation.emplace(session->tessellate(asked, threads_));
    rows.add("tessellates", Status::kHeld, of_places(*tessellation));
    results.back().of = 1;
    results.back().seconds = clock.seconds();
  } catch (const std::bad_alloc&) {
    throw;  // no memory of this program's
  } catch (const std::exception& error) {
    rows.add_failure(error, contradicts_capabilities(error, audited, mesh, asked));
    for (const std::string& row : row_names(audited, mesh))
      if (row != "tessellates") rows.add(row, Status::kNotRun, "there is no tessellation");
    return;
  }

  // From here on a sample is the mesh.
  std::optional<data::ControlMesh> part;
  if (sample) {
    tessellation->renumber_faces(sample->part_of(), static_cast<std::int64_t>(sample->faces().size()));
    part = sample->part_with(session->mesh());
    asked = sample->depths_of_part(asked);
  }
  const data::ControlMesh& judged = part ? *part : session->mesh();

  step(rows.subject, mesh.name, "reference");
  std::optional<ReferenceSurface> own;  // of points that may lie elsewhere in each tessellation
  KeptGuesses of_own;
  if (const lc_capabilities& c = session->capabilities(); c.points_anywhere != 0)
    own.emplace(judged, mesh.scheme(), depth_of(mesh), c.points, family(c.weights),
                points_anywhere(c, *tessellation));
  ReferenceSurface& truth =
      own ? *own : reference(judged, mesh.scheme(), depth_of(mesh), session->capabilities());
  const Evidence evidence = gather(audited, mesh, *session, judged, asked, *tessellation, truth);
  const std::string no_reference = prepare(truth, evidence.point);
  close(*session, results.front());

  run_checks(audited, mesh, evidence, rows, no_reference);
  if (keep_rows_) keep_rows_();
  if (no_reference.empty() && interrupted() == 0) recognise(evidence, results, own ? of_own : guesses_);
  if (interrupted() != 0) return;
  const std::vector<std::string_view> relations = rows_of_relations(level_, mesh, judged);
  const auto wanted = [&](std::string_view relation) {
    return std::find(relations.begin(), relations.end(), relation) != relations.end() &&
           wants(audited, mesh, relation);
  };
  const auto told = [&](std::string_view relation) {
    if (!wanted(relation)) return false;
    step(rows.subject, mesh.name, relation);
    return true;
  };
  if (std::none_of(relations.begin(), relations.end(), wanted)) return;
  std::unique_lock lock(shared_->mutex);
  std::vector<Refusal>& refusals = shared_->refusals[{rows.subject, mesh.scheme()}];
  lock.unlock();
  for (Result& r :
       check_relations(audited, evidence, threads_, refusals, related(level_, mesh, judged), told))
    results.push_back(std::move(r));
}

void Auditor::run_checks(const AuditSubject& audited, const AuditMesh& mesh, const Evidence& evidence,
                         const Rows& rows, const std::string& no_reference) {
  const auto give_up = [&](const Check& check, const std::string& why) {
    for (const std::string_view row : check.rows) rows.add_lack(row, why);
    lack_ = why;
  };
  for (const Check& check : checks()) {
    if (interrupted() != 0) break;
    if (!has_matter(check, mesh.mesh)) continue;
    // What is recognised is made of the row of positions.
    const bool for_others = check.name == "positions" &&
                            (wants(audited, mesh, "recognised") || wants(audited, mesh, "refined-positions"));
    if (!for_others && std::none_of(check.rows.begin(), check.rows.end(),
                                    [&](std::string_view row) { return wants(audited, mesh, row); }))
      continue;
    step(rows.subject, rows.mesh, check.name);
    if (check.needs_reference && !no_reference.empty()) {
      give_up(check, no_reference);
      continue;
    }
    const Clock clock;
    try {
      std::vector<Result> found = check.run(evidence);
      // A check looks at all of its rows at once.
      for (Result& r : found) r.seconds = clock.seconds() / static_cast<double>(found.size());
      for (Result& r : found) rows.results.push_back(std::move(r));
    } catch (const std::bad_alloc&) {
      throw;  // no memory of this program's
    } catch (const std::exception& error) {
      give_up(check, fmt::format("the check itself failed: {}", error.what()));
    }
  }
}

}  // namespace limitcheck::verify
