// SPDX-License-Identifier: MIT
#include "verify/hunt/hunt.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "data/bounding_box.h"
#include "verify/audit/shrink.h"
#include "verify/causes/causes.h"
#include "verify/interrupt/interrupt.h"
#include "verify/report/forms.h"
#include "verify/row/commands.h"

namespace limitcheck::verify {

namespace {
constexpr int kOfHangs = 20;

const char* level_of(const HuntCase& at) {
  return at.mesh.relations ? "thorough" : "quick";
}

// Of the rows of a case those that are wrong by themselves: of each cause the first.
std::vector<const Result*> causes_in(const Report& report) {
  std::vector<const Result*> rows;
  for (const Cause& cause : causes(report)) {
    const std::size_t row = cause.direct.empty() ? cause.example : cause.direct.front();
    rows.push_back(&report.results[row]);
  }
  return rows;
}
}  // namespace

Hunt::Hunt(AuditSubject subject, HuntPlan plan, HuntOptions options)
    : subject_(std::move(subject)),
      plan_(std::move(plan)),
      options_(std::move(options)),
      quick_(-1, 1),
      thorough_(-1, 1, {}, Level::kThorough) {}

AuditSubject Hunt::subject(const HuntCase& at) const {
  AuditSubject subject = subject_;
  if (!at.options.empty()) subject.options = at.options;
  return subject;
}

Report Hunt::audit(const HuntCase& at) {
  const AuditSubject asked = subject(at);
  Report report;
  report.subjects = {asked.label()};
  report.meshes.push_back({at.mesh.name, static_cast<std::int64_t>(at.mesh.mesh.positions.size()),
                           static_cast<std::int64_t>(at.mesh.mesh.faces.size()), at.mesh.scheme(), "",
                           data::box_diagonal(at.mesh.mesh)});
  report.results = (at.mesh.relations ? thorough_ : quick_).run(asked, at.mesh);
  return report;
}

std::optional<HuntReport> Hunt::look(std::uint64_t number) {
  const auto start = std::chrono::steady_clock::now();
  const HuntCase at = plan_.at(number);
  const Report report = audit(at);
  if (interrupted() != 0) return std::nullopt;
  HuntReport found;
  found.cases = 1;
  found.kinds = kinds_of_edges(at.mesh);
  found.judged = report.looked() ? 1 : 0;
  for (const Result* row : causes_in(report)) {
    HuntFinding f;
    f.where = likely_cause(*row, at.mesh);
    f.signature = signature(*row, f.where);
    f.check = row->check, f.status = word(row->status), f.scheme = data::name_of(row->scheme);
    f.cases = 1, f.first = number;
    f.found_on = audit_command(*row, level_of(at));
    f.faces_before = static_cast<std::int64_t>(at.mesh.mesh.faces.size());
    f.depth_before = row->depth;
    f.worst = row->worst, f.bound = row->bound, f.unit = row->unit, f.message = row->message;
    found.findings.emplace(f.signature, f);
  }
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return found;
}

void Hunt::shrink_findings(HuntReport& report) {
  if (options_.attempts == 0) return;
  for (HuntFinding* f : report.to_shrink())
    if (f->faces == 0 && interrupted() == 0) shrink_finding(*f);
}

void Hunt::shrink_finding(HuntFinding& f) {
  const HuntCase at = plan_.at(f.first);
  const Report found = audit(at);
  for (const Result* cause : causes_in(found)) {
    const Result& row = *cause;
    if (signature(row, likely_cause(row, at.mesh)) != f.signature) continue;
    // Each attempt with a subject that hangs takes as long as it is given.
    const int attempts =
        row.status == Status::kTimeout ? std::min(options_.attempts, kOfHangs) : options_.attempts;
    const auto [small, again, relation] = shrink(subject(at), at.mesh, 1, row, {.attempts = attempts});
    if (!again) return;
    f.faces = static_cast<std::int64_t>(small.mesh.mesh.faces.size());
    f.depth = again->depth;
    if (options_.witnesses.empty()) return;
    Report report;
    report.subjects = {again->subject};
    const std::string level = relation ? "thorough" : "quick";
    const std::filesystem::path place = write_witness(options_.witnesses, report, *again, small.mesh, level);
    f.witness = place.string();
    Result on_file = *again;
    on_file.mesh = (place / "control.obj").string();
    if (!small.mesh.face_depth.empty())
      on_file.depths = after_of(again->depths) + "file:" + (place / "depths.txt").string();
    f.command = difference_command(on_file);
    if (f.command.empty()) f.command = audit_command(on_file, level);
    return;
  }
}

}  // namespace limitcheck::verify
