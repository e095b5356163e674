// SPDX-License-Identifier: MIT
#include "verify/audit/refusal.h"

#include <algorithm>

#include "verify/audit/relation_row.h"
#include "verify/audit/vector.h"
#include "verify/subject/host.h"

namespace limitcheck::verify {

const std::vector<BrokenMesh>& broken_meshes() {
  static const std::vector<Vector> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                          {1, 1, 1}, {2, 0, 1}, {0, 2, 1}};
  static const std::vector<BrokenMesh> meshes{
      {"an edge with three faces", {points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {4, 5, 6}}}},
      {"two faces of opposite orientation", {points, {{0, 1, 2}, {0, 1, 3}, {4, 5, 6}}}},
      {"two fans that meet in a vertex", {points, {{0, 1, 2}, {0, 3, 4}, {4, 5, 6}}}},
      {"no faces", {points, {}}},
  };
  return meshes;
}

Refusal ask_for_refusal(const AuditSubject& subject, const data::ControlMesh& mesh, int threads) {
  try {
    Session session(*subject.subject, mesh, subject.options);
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
