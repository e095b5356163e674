// SPDX-License-Identifier: MIT
#include "verify/audit/refusal.h"

#include <algorithm>
#include <limits>

#include "verify/audit/relation_row.h"
#include "verify/audit/vector.h"
#include "verify/subject/host.h"

namespace limitcheck::verify {

const std::vector<BrokenMesh>& broken_meshes() {
  static const std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                          {1, 1, 1}, {2, 0, 1}, {0, 2, 1}};
  static const std::vector<Vector> not_a_number = [] {
    std::vector<Vector> changed = points;
    changed[1][2] = std::numeric_limits<double>::quiet_NaN();
    return changed;
  }();
  static const std::vector<BrokenMesh> meshes{
      {"an edge with three faces", {points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {4, 5, 6}}}},
      {"two faces of opposite orientation", {points, {{0, 1, 2}, {0, 1, 3}, {4, 5, 6}}}},
      {"two fans that meet in a vertex", {points, {{0, 1, 2}, {0, 3, 4}, {4, 5, 6}}}},
      {"no faces", {points, {}}},
      {"faces and no vertices", {{}, {{0, 1, 2}}}},
      {"a vertex that does not exist", {points, {{0, 1, 2}, {2, 1, 1'000'000'000}, {4, 5, 6}}}},
      {"a coordinate that is no number", {not_a_number, {{0, 1, 2}, {2, 1, 3}, {4, 5, 6}}}},
  };
  return meshes;
}

std::vector<Refusal> ask_for_refusals(const AuditSubject& subject, int threads) {
  std::vector<Refusal> refusals;
  for (const BrokenMesh& broken : broken_meshes())
    refusals.push_back(ask_for_refusal(subject, broken.mesh, threads));
  return refusals;
}

Refusal ask_for_refusal(const AuditSubject& subject, const data::ControlMesh& mesh, int threads) {
  try {
    Session session(*subject.subject, mesh, subject.options, Session::Input::kAsItIs);
    const Tessellation t = session.tessellate(std::min(1, session.capabilities().max_depth), threads);
    session.close();
    if (mesh.triangles.empty() && t.triangle_count() == 0) return {};  // nothing of nothing
    return {Status::kFinding, "accepted"};
  } catch (const SubjectDied& error) {
    return {status_of(error), error.what()};
  } catch (const SubjectError&) {
    return {};
  } catch (const std::exception& error) {
    return {Status::kError, error.what()};
  }
}

}  // namespace limitcheck::verify
