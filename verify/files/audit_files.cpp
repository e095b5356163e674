// SPDX-License-Identifier: MIT
#include "verify/files/audit_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "verify/files/checks/diagnosis.h"
#include "verify/files/checks/hausdorff.h"
#include "verify/interrupt/interrupt.h"
#include "verify/row/bounds.h"

namespace limitcheck::verify {
namespace {

void append(std::vector<Result>& all, std::vector<Result> more) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

std::string what_it_is(const FileTessellation& t) {
  std::string text = fmt::format("{}: {} vertices, {} faces", t.name, t.positions.size(), t.polygons);
  if (t.quads > 0) text += fmt::format(", of which {} quads", t.quads);
  if (t.larger > 0) text += fmt::format(", {} with more than four corners", t.larger);
  if (t.quads + t.larger > 0) text += ", cut as fans from their first corner";
  const auto unused = std::count(t.used.begin(), t.used.end(), false);
  if (unused > 0) text += fmt::format("; {} vertices belong to no face and are left out", unused);
  return text;
}

/// The largest angle of the normals of each vertex; -1: it has none, or the surface.
std::vector<double> angles_of(const FileEvidence& e) {
  const FileTessellation& t = e.tessellation;
  std::vector<double> angle(t.positions.size(), -1);
  for (const auto& n : t.normals) {
    const std::int32_t point = e.point_of(n.vertex);
    if (point < 0 || !e.foot[point].has_normal) continue;
    double a = angle_degrees(n.direction, e.foot[point].normal);
    if (e.place[point].face >= 0 && e.surface.domain().on_cut(e.place[point]))
      for (const Foot& side : in_all_faces(e, e.place[point], e.position(point)))
        if (side.has_normal) a = std::min(a, angle_degrees(n.direction, side.normal));
    if (!(a <= angle[n.vertex])) angle[n.vertex] = a;
  }
  return angle;
}

std::string per_vertex(const FileEvidence& e, const std::vector<double>& angle) {
  const FileTessellation& t = e.tessellation;
  const bool loop = e.scheme() == data::Scheme::kLoop;
  std::string out =
      loop ? "vertex,distance,normal_angle,face,l1,l2\n" : "vertex,distance,normal_angle,face,corner,u,v\n";
  for (std::size_t v = 0; v < t.positions.size(); ++v) {
    const std::int32_t point = e.merged.point_of[v];
    if (!t.used[v] || point < 0) continue;
    const Foot& foot = e.foot[point];
    out += fmt::format("{},{},{},", v, foot.distance / e.surface.diagonal(),
                       angle[v] < 0 ? std::string() : fmt::format("{}", angle[v]));
    const auto at = e.surface.surface().control_point(foot.at);
    out += loop ? fmt::format("{},{},{}\n", foot.at.face, foot.at.l[1], foot.at.l[2])
                : fmt::format("{},{},{},{}\n", at.face,
                              at.corner < 0 ? std::string() : std::to_string(at.corner), at.first, at.second);
  }
  return out;
}

const char* distance_row(const std::vector<ProvenanceRow>& provenance) {
  return provenance.empty() ? "file-distance" : "file-positions";
}

Result& row(FilesAudit& audit, std::string_view check) {
  return *std::find_if(audit.results.begin(), audit.results.end(),
                       [&](const Result& r) { return r.check == check; });
}

using Step = std::function<void(const std::string& what, std::size_t done, std::size_t total)>;

// Adds to `audit` row by row, so that an interrupt keeps the rows that are there.
void judge(FilesAudit& audit, const std::string& control_name, const data::ControlMesh& control,
           FileTessellation tessellation, const std::vector<ProvenanceRow>& provenance,
           const FilesOptions& options, const Step& step) {
  audit.notes.push_back(what_it_is(tessellation));
  step("search structure", 0, 1);
  const ClosestPoint surface(control, options.scheme.value_or(data::natural_scheme(control)), options.pieces);

  if (options.fit != Fit::kNone) {
    step("fit", 0, 1);
    audit.notes.push_back("fitted: " + fit(surface, tessellation, options.fit));
  }

  FileEvidence e{control_name, control, surface, tessellation, options.tolerance};
  const auto placed = [&](std::size_t done, std::size_t total) { step("closest points", done, total); };
  const bool told = !provenance.empty();
  const std::vector<ProvenanceRow> matched = told ? std::vector<ProvenanceRow>() : matched_provenance(e);
  const std::vector<ProvenanceRow>& known = told ? provenance : matched;
  if (!matched.empty())
    audit.notes.emplace_back(
        "the faces are connected as those of the control mesh after some steps: each vertex is held against "
        "its own point "
        "of the surface, not against the nearest");
  place_points(e, known, told, placed, true);
  append(audit.results, check_file_finite(e));
  append(audit.results, check_file_unused(e));
  const auto by_feet = [&] {
    std::vector<Result> rows = check_file_distance(e);
    append(rows, check_file_normals(e));
    append(rows, check_file_channel(e));
    step("coverage", 0, 1);
    append(rows, check_file_cover(e));
    append(rows, check_file_triangles(e));
    step("watertight", 0, 1);
    append(rows, check_file_watertight(e));
    return rows;
  };
  std::vector<Result> rows = by_feet();
  if (std::count(e.quick.begin(), e.quick.end(), 1) > 0 && std::any_of(rows.begin(), rows.end(), is_bad)) {
    place_points(e, known, told, placed);
    rows = by_feet();
  }
  append(audit.results, std::move(rows));
  if (tessellation.normals.empty() && options.needs_normals) {
    Result& normals = row(audit, "file-normals");
    normals.status = Status::kFinding;
    normals.bad = normals.of = static_cast<std::int64_t>(tessellation.positions.size());
  }
  if (options.measures_hausdorff) {
    step("Hausdorff distance", 0, 1);
    append(audit.results, check_file_hausdorff(e, options.hausdorff));
    if (!tessellation.triangles.empty()) audit.notes.push_back(row(audit, "file-hausdorff").message);
  } else {
    Result left_out = e.result("file-hausdorff");
    left_out.status = Status::kNotRun;
    left_out.message = "left out, as asked";
    audit.results.push_back(left_out);
  }

  Result& distance = row(audit, distance_row(provenance));
  if (distance.status == Status::kFinding) {
    step("diagnosis", 0, 1);
    Diagnosis diagnosis = diagnose(e);
    for (const std::string& sentence : diagnosis.sentences) say(distance, sentence);
    distance.recognised = std::move(diagnosis.recognised);
    for (const Result& r : diagnosis.rows)
      if (is_bad(r)) audit.notes.push_back(r.message);
    append(audit.results, std::move(diagnosis.rows));  // `distance` is none of them any more
  } else if (const std::string unseen = blind_spots(e); !unseen.empty()) {
    say(distance, unseen);
    audit.notes.push_back(unseen);
  }
  const std::vector<double> angle = angles_of(e);
  audit.per_vertex = per_vertex(e, angle);
  audit.errors = {tessellation.positions, tessellation.triangles,     {}, angle,
                  options.tolerance,      normal_bound(LC_FLOAT32, 5)};
  for (std::size_t v = 0; v < tessellation.positions.size(); ++v) {
    const std::int32_t point = e.merged.point_of[v];
    audit.errors.distance.push_back(point < 0 ? -1 : e.foot[point].distance / e.surface.diagonal());
  }
}

}  // namespace

FilesAudit audit_files(const std::string& control_name, const data::ControlMesh& control,
                       FileTessellation tessellation, const std::vector<ProvenanceRow>& provenance,
                       const FilesOptions& options, const Step& step) {
  FilesAudit audit;
  const std::string name = tessellation.name;
  try {
    judge(audit, control_name, control, std::move(tessellation), provenance, options, step);
  } catch (const Interrupted&) {
    audit.gave_up = true;
    for (const char* check :
         {"file-finite", "file-unused", distance_row(provenance), "file-normals", "file-normal-length",
          "file-orientation", "file-coverage", "file-degenerate", "file-watertight", "file-hausdorff"}) {
      if (std::none_of(audit.results.begin(), audit.results.end(),
                       [&](const Result& r) { return r.check == check; }))
        audit.results.push_back(
            {.subject = name, .mesh = control_name, .check = check, .message = "interrupted"});
    }
  }
  return audit;
}

}  // namespace limitcheck::verify
