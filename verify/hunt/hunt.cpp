// SPDX-License-Identifier: MIT
#include "verify/hunt/hunt.h"

#include <algorithm>
#include <set>
#include <utility>

#include "verify/audit/reproduce.h"
#include "verify/audit/shrink.h"
#include "verify/audit/witness_files.h"
#include "verify/hunt/neighbourhood.h"
#include "verify/interrupt/interrupt.h"

namespace limitcheck::verify {

namespace {
constexpr int kOfHangs = 20;
}  // namespace

Hunt::Hunt(AuditSubject subject, HuntPlan plan, HuntOptions options, HuntReport report)
    : subject_(std::move(subject)),
      plan_(std::move(plan)),
      options_(std::move(options)),
      report_(std::move(report)),
      quick_(-1, options_.threads),
      thorough_(-1, options_.threads, {}, Level::kThorough) {}

HuntFinding* Hunt::known(const std::string& signature) {
  for (HuntFinding& f : report_.findings)
    if (f.signature == signature) return &f;
  return nullptr;
}

std::vector<Result> Hunt::audit(const HuntCase& at) {
  return (at.mesh.relations ? thorough_ : quick_).run(subject_, at.mesh);
}

bool Hunt::look(std::uint64_t number) {
  const HuntCase at = plan_.at(number);
  const std::vector<Result> rows = audit(at);
  if (interrupted() != 0) return false;
  ++report_.cases;
  report_.kinds.merge(kinds_of_edges(at.mesh));
  bool judged = false;
  std::set<std::string> here;
  for (const Result& row : rows) {
    judged = judged || (row.status != Status::kNotSupported && row.status != Status::kNotRun);
    if (!is_bad(row)) continue;
    HuntFinding f;
    f.signature = signature(row, at.mesh);
    if (!here.insert(f.signature).second) continue;
    if (HuntFinding* before = known(f.signature)) {
      ++before->cases;
      continue;
    }
    f.check = row.check, f.status = word(row.status), f.scheme = data::name_of(row.scheme);
    f.cases = 1, f.first = number;
    f.found_on = audit_command(row, at.mesh.relations ? "thorough" : "quick");
    f.faces_before = static_cast<std::int64_t>(at.mesh.mesh.faces.size());
    f.depth_before = row.depth;
    f.worst = row.worst, f.bound = row.bound, f.unit = row.unit, f.message = row.message;
    report_.findings.push_back(std::move(f));
  }
  report_.judged += judged ? 1 : 0;
  return true;
}

void Hunt::shrink_findings() {
  if (options_.attempts == 0) return;
  for (HuntFinding* f : report_.to_shrink())
    if (f->faces == 0 && interrupted() == 0) shrink_finding(*f);
}

void Hunt::shrink_finding(HuntFinding& f) {
  const HuntCase at = plan_.at(f.first);
  for (const Result& row : audit(at)) {
    if (!is_bad(row) || signature(row, at.mesh) != f.signature) continue;
    // Each attempt with a subject that hangs takes as long as it is given.
    const int attempts =
        row.status == Status::kTimeout ? std::min(options_.attempts, kOfHangs) : options_.attempts;
    const auto [small, again, relation] =
        shrink(subject_, at.mesh, options_.threads, row, {.attempts = attempts});
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
    if (!small.mesh.face_depth.empty()) on_file.depths = "file:" + (place / "depths.txt").string();
    f.command = difference_command(on_file);
    if (f.command.empty()) f.command = audit_command(on_file, level);
    return;
  }
}

}  // namespace limitcheck::verify
