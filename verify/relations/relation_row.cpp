// SPDX-License-Identifier: MIT
#include "verify/relations/relation_row.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <new>
#include <utility>

namespace limitcheck::verify {
namespace {

// From harmless to fatal: the worst of a row is its status.
int gravity(Status status) {
  static constexpr Status kOrder[] = {Status::kHeld,    Status::kQualityWarning, Status::kNotSupported,
                                      Status::kNotRun,  Status::kFinding,        Status::kError,
                                      Status::kTimeout, Status::kCrash};
  return static_cast<int>(std::find(std::begin(kOrder), std::end(kOrder), status) - std::begin(kOrder));
}

}  // namespace

Status status_of(const std::exception& error) {
  if (const auto* died = dynamic_cast<const SubjectDied*>(&error)) {
    if (died->kind() == SubjectDied::Kind::kTimeout) return Status::kTimeout;
    return died->kind() == SubjectDied::Kind::kProtocol ? Status::kFinding : Status::kCrash;
  }
  const auto* refusal = dynamic_cast<const SubjectError*>(&error);
  if (refusal == nullptr || refusal->status() == LC_FAILED) return Status::kError;
  return refusal->status() == LC_NOT_SUPPORTED ? Status::kNotSupported : Status::kFinding;
}

RelationRow::RelationRow(const AuditSubject& subject, const Evidence& e, std::string_view name,
                         const char* unit, double bound)
    : subject_(subject), e_(e), r_(e.result(std::string(name))) {
  r_.unit = unit;
  r_.bound = bound;
}

void RelationRow::ask(const std::string& what, const data::ControlMesh& mesh,
                      const std::function<void(Session&)>& work) {
  ask(subject_, what, mesh, work);
}

void RelationRow::ask(const AuditSubject& subject, const std::string& what, const data::ControlMesh& mesh,
                      const std::function<void(Session&)>& work) {
  try {
    Session session(*subject.subject, mesh, subject.options, Session::Input::kValid, e_.lattice.scheme());
    work(session);
    session.close();
  } catch (const std::bad_alloc&) {
    throw;  // no memory of this program's
  } catch (const std::exception& error) {
    const Status status = status_of(error);
    if (status != Status::kNotSupported) ++r_.bad;
    note(status, fmt::format("{}: {}", what, error.what()));
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
  if (!r_.worst || c.worst > *r_.worst) {
    r_.worst = c.worst;
    r_.witness = c.witness;
    comparison_ = fmt::format(
        "{}: positions differ by up to {:.2g} diagonals, normals by {:.2g} degrees; {} of {} in bits", what,
        c.position, c.normal, c.other_bits, c.of);
  }
  if (c.bad > 0)
    note(Status::kFinding, c.message.empty() ? "" : fmt::format("{}: {}", what, c.message));
  else if (bits_matter && c.other_bits > 0)
    note(Status::kQualityWarning, "");
}

void RelationRow::note(Status status, const std::string& message) {
  if (gravity(status) > gravity(r_.status)) r_.status = status;
  if (message.empty() || r_.message.find(message) != std::string::npos) return;
  r_.message += (r_.message.empty() ? "" : " / ") + message;
}

Result RelationRow::take() {
  if (r_.message.empty()) r_.message = comparison_;
  if (r_.of == 0 && r_.status == Status::kHeld) r_.status = Status::kNotRun;
  if (r_.worst && !std::isfinite(*r_.worst)) r_.worst.reset();
  return std::move(r_);
}

}  // namespace limitcheck::verify
