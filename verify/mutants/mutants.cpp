// SPDX-License-Identifier: MIT
#include "verify/mutants/mutants.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "data/generators/named_mesh.h"
#include "data/splitmix64.h"
#include "verify/audit/audit.h"
#include "verify/audit/checks.h"
#include "verify/audit/relations.h"
#include "verify/subject/faulty_subjects.h"
#include "verify/subject/model_rules.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

constexpr const char* kBase = "model";

// The row that each planted fault is meant for, and the subject it is planted in.
struct Meant {
  const char* check;
  const char* subject = kBase;
};
const std::map<std::string, Meant>& meant() {
  static const std::map<std::string, Meant> table{
      {"nan_position", {"finite"}},
      {"infinite_position", {"finite"}},
      {"nan_normal", {"finite"}},
      {"unwritten_position", {"written"}},
      {"unwritten_normal", {"written"}},
      {"unwritten_triangle", {"written"}},
      {"wrong_limit_mask", {"positions"}},
      {"wrong_edge_mask", {"positions"}},
      {"flipped_normals", {"normals"}},
      {"one_flipped_normal", {"normals"}},
      {"long_normals", {"normal-length"}},
      {"shifted_provenance", {"positions"}},
      {"mirrored_provenance", {"orientation"}},
      {"swapped_points", {"positions"}},
      {"provenance_out_of_range", {"written"}},
      {"flipped_orientation", {"orientation"}},
      {"one_flipped_triangle", {"orientation"}},
      {"missing_triangle", {"coverage"}},
      {"duplicated_triangle", {"coverage"}},
      {"wrong_triangle_face", {"coverage"}},
      {"index_out_of_range", {"written"}},
      {"t_vertex", {"t-vertices"}},
      {"one_ulp_crack", {"shared-positions"}},
      {"one_ulp_normal", {"shared-normals"}},
      {"negative_count", {"written"}},
      {"count_too_large", {"written"}},
      {"foreign_memory", {"written"}},
      {"write_behind", {"written"}},
      {"write_before", {"written"}},
      {"modified_mesh", {"written"}},
      {"overlapping_arrays", {"written"}},
      {"unwritten_provenance", {"written"}},
      {"unwritten_triangle_face", {"written"}},
      {"snapped_positions", {"watertight"}},
      {"face_twice", {"coverage"}},
      {"edges_of_genus_0", {"positions"}},
      {"edges_of_genus_1", {"positions"}},
      {"second_component", {"normals"}},
      {"third_component", {"positions"}},
      {"welded_components", {"positions"}},
      {"flat_box", {"finite"}},
      {"edge_without_length", {"finite"}},
      {"unmoved_vertices", {"refined-positions", "cgal"}},
      {"indices_of_16_bits", {"positions", "row-stream"}},  // the model refines the whole of a large mesh
  };
  return table;
}

AuditMesh mesh(const std::string& name, bool random_depths) {
  AuditMesh m{name, data::named_mesh(name)};
  if (!random_depths) return m;
  data::SplitMix64 random(1);
  for (std::size_t f = 0; f < m.mesh.triangles.size(); ++f)
    m.face_depth.push_back(static_cast<std::int32_t>(random.next() % 4) - 1);
  return m;
}

}  // namespace

const std::vector<Mutant>& mutants() {
  static const std::vector<Mutant> list = [] {
    std::vector<Mutant> all;
    for (const Fault& f : faults()) {
      if (f.name == "none") continue;
      const auto found = meant().find(std::string(f.name));
      const Meant to = found == meant().end() ? Meant{""} : found->second;
      all.push_back({std::string(f.name), std::string(f.description), "faulty",
                     faulty_options(f.name, to.subject), to.check, ""});
    }
    for (const Mutation& m : mutations())
      if (m.name != "none")
        all.push_back({std::string(m.name), std::string(m.description), kBase,
                       fmt::format("mutation={}{}", m.name, m.in_float ? ",precision=float" : ""),
                       std::string(m.check), std::string(m.claim)});
    all.push_back({"wrong_refined_points", "refined points 1e-5 too far from the origin", "faulty",
                   faulty_options("wrong_edge_mask", "cgal"), "refined-positions", ""});
    return all;
  }();
  return list;
}

bool KillTable::held() const {
  return idle.empty() && red_on_correct.empty() &&
         std::all_of(kills.begin(), kills.end(), [](const Kill& k) { return k.by_its_check(); });
}

KillTable run_mutants(const std::function<void(const std::string&, std::size_t, std::size_t)>& on_step) {
  constexpr int kDepth = 2;
  const std::vector<AuditMesh> meshes{mesh("bumpy:60", false), mesh("ragged-disc", false),
                                      mesh("octahedron", true), mesh("wheel:5:2", true)};
  std::vector<AuditSubject> subjects{{find_subject(kBase), ""}, {find_subject("sliding-window"), ""}};
  const std::size_t correct = subjects.size();
  for (const Mutant& m : mutants()) subjects.push_back({find_subject(m.subject), m.options});

  KillTable table;
  for (const Mutant& m : mutants()) table.kills.push_back({&m, {}});
  std::size_t done = 0;
  for (const AuditMesh& m : meshes) {
    Auditor auditor(kDepth, 2, {}, Level::kThorough);
    for (std::size_t s = 0; s < subjects.size(); ++s, ++done) {
      if (on_step)
        on_step(fmt::format("{} on {}", s < correct ? subjects[s].subject->name : mutants()[s - correct].name,
                            m.name),
                done, subjects.size() * meshes.size());
      for (const Result& r : auditor.run(subjects[s], m)) {
        if (!is_bad(r)) continue;
        if (s < correct)
          table.red_on_correct.push_back(
              fmt::format("{} / {} / {}: {}", r.subject, r.mesh, r.check, r.message));
        else
          table.kills[s - correct].killed_by.insert(r.check);
      }
    }
  }

  std::set<std::string> rows{"tessellates", "refined-positions"}, useful;
  for (const Check& c : checks()) rows.insert(c.rows.begin(), c.rows.end());
  rows.insert(relation_rows().begin(), relation_rows().end());
  for (const Kill& k : table.kills)
    if (k.by_its_check()) useful.insert(k.mutant->check);
  std::set_difference(rows.begin(), rows.end(), useful.begin(), useful.end(), std::back_inserter(table.idle));
  return table;
}

}  // namespace limitcheck::verify
