// SPDX-License-Identifier: MIT
// `limitcheck audit --control cage.obj --tessellation out.ply`.
#include "verify/files/audit_files.h"

#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <chrono>
#include <exception>
#include <nlohmann/json.hpp>

#include "verify/cli/audit.h"
#include "verify/cli/commands.h"
#include "verify/cli/mesh_options.h"
#include "verify/host/host.h"
#include "verify/interrupt/interrupt.h"
#include "verify/report/forms.h"
#include "verify/report/json.h"

namespace limitcheck::cli {
namespace {

// For the attestation: which files were read.
nlohmann::json plan_of(const FilesArguments& files) {
  return {{"stamps", nlohmann::json::array({{files.tessellation, file_digest(files.tessellation)}})},
          {"meshes", nlohmann::json::array({{files.control, file_digest(files.control)}})},
          {"provenance", file_digest(files.provenance)},
          {"tolerance", files.options.tolerance}};
}

}  // namespace

void add_files_options(CLI::App& audit, FilesArguments& files) {
  const char* group = "A finished tessellation (instead of SUBJECT)";
  verify::FilesOptions& options = files.options;
  auto* control = audit.add_option("--control", files.control, "Control mesh: a file or a generator's name")
                      ->group(group);
  auto* tessellation =
      audit
          .add_option("--tessellation", files.tessellation,
                      "A tessellation of it by any program: PLY, OBJ, OFF, STL, glTF or GLB; larger polygons "
                      "count as fans of triangles from their first corner")
          ->group(group)
          ->needs(control);
  control->needs(tessellation);
  const auto option = [&](CLI::Option* o) { return o->group(group)->needs(tessellation); };
  option(
      audit.add_flag("--normals", options.needs_normals,
                     "Report a file without normals as a finding (normals that it has are always judged)"));
  option(
      audit.add_option("--provenance", files.provenance,
                       "CSV that says where each vertex lies: vertex,face,l1,l2 or "
                       "vertex,face,i,j,denominator; without it the closest point of the surface is found. "
                       "Of Catmull-Clark's scheme u and v, and of a face that is no quad a column corner"));
  using verify::Fit;
  option(add_words(audit, "--fit", options.fit, {{"scale", Fit::kScale}, {"similarity", Fit::kSimilarity}},
                   "Undo a scale and an offset first (scale), or also a rotation (similarity)"))
      ->expected(0, 1)
      ->default_str("similarity");
  option(audit.add_option("--tolerance", options.tolerance,
                          "Of positions, in diagonals of the control mesh's bounding box"))
      ->check(CLI::PositiveNumber)
      ->check(kFinite)
      ->capture_default_str();
  CLI::Option* deviation =
      option(audit.add_option("--max-deviation", options.hausdorff,
                              "Of the triangles from the surface and back, in diagonals (default: what one "
                              "triangle, or polygon, per control face would have)"))
          ->check(CLI::PositiveNumber)
          ->check(kFinite);
  option(audit.add_flag_callback(
             "--no-hausdorff", [&options] { options.measures_hausdorff = false; },
             "Leave out how far the triangles are from the surface and back, which takes longest: the row "
             "file-hausdorff is not run"))
      ->excludes(deviation);
  option(audit.add_option("--per-vertex", files.per_vertex,
                          "Write distance, normal angle and parameter of every vertex to this CSV file"));
}

int audit_files(const FilesArguments& files, const data::ReadOptions& mesh, const std::string& json,
                int threads) {
  const tbb::global_control limit(
      tbb::global_control::max_allowed_parallelism,
      static_cast<std::size_t>(threads > 0 ? threads : tbb::info::default_concurrency()));
  refuse_one_file_for_two({{"--json", json}, {"--per-vertex", files.per_vertex}});
  const auto start = std::chrono::steady_clock::now();
  const OpenedMesh opened = open_control_mesh(files.control, mesh);
  const data::ControlMesh& control = opened.mesh;
  verify::require_range(files.control, control, true);
  verify::FileTessellation tessellation = verify::read_tessellation(files.tessellation);
  std::vector<verify::ProvenanceRow> provenance;
  if (!files.provenance.empty())
    provenance =
        verify::read_provenance(files.provenance, static_cast<std::int64_t>(tessellation.positions.size()),
                                control, opened.chosen.scheme);
  verify::FilesOptions options = files.options;
  options.scheme = opened.chosen.scheme;

  Progress progress;
  const verify::InterruptGuard guard;
  const auto audit = verify::audit_files(files.control, control, std::move(tessellation), provenance, options,
                                         [&](const std::string& what, std::size_t done, std::size_t total) {
                                           progress.show(done, total, what);
                                           verify::end_if_interrupted();
                                         });
  progress.clear();
  const int signal = audit.gave_up ? verify::interrupted() : 0;

  verify::Report report;
  report.version = LIMITCHECK_VERSION;
  report.depths = "file";
  report.meshes.push_back({files.control, static_cast<std::int64_t>(control.positions.size()),
                           static_cast<std::int64_t>(control.faces.size()), opened.chosen.scheme,
                           opened.chosen.cut > 0 ? word(mesh.polygons) : ""});
  report.subjects.push_back(files.tessellation);
  report.results = audit.results;
  if (signal != 0) report.incomplete = fmt::format("interrupted by {}", verify::signal_name(signal));
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string text = json.empty() ? "" : attested(verify::to_json(report), plan_of(files));
  // Files are written first, because a reader of the table may close the pipe; and the table is printed even
  // if a file cannot be written.
  std::exception_ptr not_written;
  try {
    if (!files.per_vertex.empty() && signal == 0) verify::write_text(files.per_vertex, audit.per_vertex);
    if (!json.empty() && json != "-") verify::write_text(json, text);
  } catch (const std::exception&) {
    not_written = std::current_exception();
  }
  if (json == "-") {
    say_text(stdout, text);
  } else {
    say("{}\n", scheme_line({opened.chosen}, mesh));
    for (const std::string& note : audit.notes) say("{}\n", note);
    say("{}", audit.notes.empty() ? "" : "\n");
    say_report(report, [](const verify::Report& shown, bool in_colour) {
      return verify::to_table(shown, in_colour, false);
    });
  }
  if (not_written) std::rethrow_exception(not_written);
  if (signal != 0) return kSignalled + signal;
  return report.held() ? kHeld : kFindings;
}

}  // namespace limitcheck::cli
