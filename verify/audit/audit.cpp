// SPDX-License-Identifier: MIT
#include "verify/audit/audit.h"

#include <fmt/core.h>

#include <algorithm>
#include <new>
#include <optional>
#include <utility>

#include "data/bounding_box.h"
#include "verify/audit/checks.h"
#include "verify/audit/digits.h"
#include "verify/audit/relation_row.h"
#include "verify/audit/relations.h"
#include "verify/audit/vector.h"
#include "verify/interrupt/interrupt.h"
#include "verify/subject/host.h"

namespace limitcheck::verify {
namespace {

std::string label(const AuditSubject& s) {
  return s.options.empty() ? s.subject->name : fmt::format("{}:{}", s.subject->name, s.options);
}

}  // namespace

Auditor::Auditor(int depth, int threads, std::function<void(const AuditStep&)> on_step, Level level)
    : depth_(depth), threads_(threads), on_step_(std::move(on_step)), level_(level) {}

Auditor::~Auditor() = default;

void Auditor::step(const std::string& subject, const std::string& mesh, std::string_view check) {
  if (on_step_) on_step_({subject, mesh, std::string(check), done_, total_});
}

ReferenceSurface& Auditor::reference(const data::ControlMesh& rounded, lc_points points) {
  for (const auto& kept : cache_)
    if (kept->points() == points && kept->mesh().positions == rounded.positions &&
        kept->mesh().triangles == rounded.triangles)
      return *kept;
  cache_.push_back(std::make_unique<ReferenceSurface>(rounded, depth_, points));
  return *cache_.back();
}

std::vector<Result> Auditor::run(const AuditSubject& audited, const AuditMesh& mesh) {
  if (!mesh.face_depth.empty()) return run(audited, mesh, mesh.face_depth);
  return run(audited, mesh, std::vector<std::int32_t>(mesh.mesh.triangles.size(), depth_));
}

std::vector<Result> Auditor::run(const AuditSubject& audited, const AuditMesh& mesh,
                                 std::span<const std::int32_t> face_depth) {
  std::vector<Result> results;
  bool no_memory = false;
  try {
    if (interrupted() == 0) judge(audited, mesh, face_depth, results);
  } catch (const Interrupted&) {
  } catch (const std::bad_alloc&) {
    no_memory = true;
  } catch (const HostOutOfMemory&) {
    no_memory = true;
  }
  if (no_memory) {
    cache_.clear();
    out_of_memory_ = true;
  }
  // Of a sample, however far it came: faces as the whole numbers them.
  if (mesh.sample)
    for (Result& r : results)
      if (r.witness && r.witness->face >= 0) r.witness->face = mesh.sample->faces()[r.witness->face];
  if (interrupted() == 0 && !no_memory) return results;

  // What there is no row of.
  std::vector<std::string_view> missing{"tessellates"};
  for (const Check& check : checks()) missing.insert(missing.end(), check.rows.begin(), check.rows.end());
  const auto& judged = mesh.sample ? mesh.sample->part() : mesh.mesh;
  if (level_ == Level::kThorough || (level_ == Level::kStandard && judged.triangles.size() <= kRelationFaces))
    missing.insert(missing.end(), relation_rows().begin(), relation_rows().end());
  std::erase_if(missing, [&](std::string_view check) {
    return std::any_of(results.begin(), results.end(), [&](const Result& r) { return r.check == check; });
  });
  if (!no_memory && !missing.empty()) gave_up_ = true;
  for (const std::string_view check : missing) {
    Result r;
    r.subject = label(audited);
    r.mesh = mesh.name;
    r.check = check;
    r.depth = depth_;
    r.status = Status::kNotRun;
    r.message = no_memory ? "this program ran out of memory" : "interrupted";
    results.push_back(std::move(r));
  }
  return results;
}

void Auditor::judge(const AuditSubject& audited, const AuditMesh& mesh,
                    std::span<const std::int32_t> face_depth, std::vector<Result>& results) {
  if (cached_mesh_ != mesh.name) cache_.clear();
  cached_mesh_ = mesh.name;

  const std::string name = label(audited);
  const auto row = [&](std::string_view check, Status status, const std::string& message) {
    Result r;
    r.subject = name;
    r.mesh = mesh.name;
    r.check = check;
    r.depth = depth_;
    r.status = status;
    r.message = message;
    results.push_back(std::move(r));
  };
  const auto rows = [&](const Check& check, Status status, const std::string& message) {
    for (const std::string_view r : check.rows) row(r, status, message);
  };

  // Tessellate: the whole mesh, of which all but a sample is culled.
  const MeshSample* sample = mesh.sample.get();
  std::vector<std::int32_t> asked(face_depth.begin(), face_depth.end());
  if (sample) asked = sample->cull(std::move(asked));
  std::optional<Session> session;
  std::optional<Tessellation> tessellation;
  try {
    step(name, mesh.name, "tessellates");
    session.emplace(*audited.subject, mesh.mesh, audited.options);
    tessellation.emplace(session->tessellate(asked, threads_));
    row("tessellates", Status::kHeld, "");
    results.back().of = 1;
  } catch (const std::bad_alloc&) {
    throw;  // no memory of this program's
  } catch (const std::exception& error) {
    row("tessellates", status_of(error), error.what());
    results.back().of = 1;
    results.back().bad = is_bad(results.back());
    for (const Check& check : checks()) rows(check, Status::kNotRun, "there is no tessellation");
    if (level_ != Level::kQuick)
      for (const std::string_view r : relation_rows()) row(r, Status::kNotRun, "there is no tessellation");
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

  // The truth at every point the subject names.
  const lc_capabilities& capabilities = session->capabilities();
  step(name, mesh.name, "reference");
  ReferenceSurface& truth = reference(judged, capabilities.points);
  std::vector<Lattice::Id> points = locate(*tessellation, truth.lattice());
  const bool same_family = capabilities.weights == LC_WEIGHTS_LOOP;
  std::string no_reference =
      same_family ? "" : "declares another family of weights than Loop's: another surface";
  if (same_family) {
    try {
      truth.prepare(points);
    } catch (const std::bad_alloc&) {
      throw;  // no memory of this program's
    } catch (const std::exception& error) {
      no_reference = fmt::format("the reference failed: {}", error.what());
    }
  }

  // The checks.
  double magnitude = 0;  // of the whole
  for (const Vector& p : session->mesh().positions) magnitude = std::max(magnitude, largest(p));
  const double diagonal = data::box_diagonal(session->mesh());
  const Evidence evidence{
      name,  mesh.name,         capabilities, judged,   asked, *tessellation, truth.lattice(),
      truth, std::move(points), diagonal,     magnitude};
  // The subject is done, and may still break down while it cleans up.
  try {
    session->close();
  } catch (const std::bad_alloc&) {
    throw;  // no memory of this program's
  } catch (const std::exception& error) {
    Result& tessellates = results.front();
    tessellates.status = status_of(error);
    tessellates.bad = 1;
    tessellates.message = fmt::format("at the end: {}", error.what());
  }

  for (const Check& check : checks()) {
    if (interrupted() != 0) break;
    step(name, mesh.name, check.name);
    if (check.needs_reference && !no_reference.empty()) {
      rows(check, same_family ? Status::kError : Status::kNotSupported, no_reference);
      continue;
    }
    try {
      for (Result& r : check.run(evidence)) results.push_back(std::move(r));
    } catch (const std::bad_alloc&) {
      throw;  // no memory of this program's
    } catch (const std::exception& error) {
      rows(check, Status::kError, fmt::format("the check itself failed: {}", error.what()));
    }
  }
  if (interrupted() == 0 && (level_ == Level::kThorough ||
                             (level_ == Level::kStandard && judged.triangles.size() <= kRelationFaces))) {
    const auto told = [&](std::string_view relation) { step(name, mesh.name, relation); };
    for (Result& r : check_relations(audited, evidence, threads_, told)) results.push_back(std::move(r));
  }
  if (capabilities.points == LC_POINTS_LIMIT)
    for (Result& r : results) add_digits(r, evidence.mesh);
}

std::vector<Result> Auditor::run(const std::vector<AuditSubject>& subjects,
                                 const std::vector<AuditMesh>& meshes, Journal* journal) {
  // Mesh by mesh, so that subjects share the reference; told subject by subject.
  done_ = 0;
  total_ = subjects.size() * meshes.size();
  std::vector<std::vector<Result>> of_subject(subjects.size());
  for (const AuditMesh& mesh : meshes)
    for (std::size_t s = 0; s < subjects.size(); ++s, ++done_) {
      const std::string name = label(subjects[s]);
      auto known = journal != nullptr ? journal->recall(name, mesh.name) : std::nullopt;
      std::vector<Result> results = known ? std::move(*known) : run(subjects[s], mesh);
      if (journal != nullptr && !known && !gave_up_ && !out_of_memory_)
        journal->keep(name, mesh.name, results);
      for (Result& r : results) of_subject[s].push_back(std::move(r));
    }
  std::vector<Result> all;
  for (auto& results : of_subject)
    all.insert(all.end(), std::make_move_iterator(results.begin()), std::make_move_iterator(results.end()));
  total_ = 1;
  done_ = 0;
  return all;
}

}  // namespace limitcheck::verify
