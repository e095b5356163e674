// SPDX-License-Identifier: MIT
// `limitcheck audit --control cage.obj --tessellation out.ply`.

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "data/error.h"
#include "verify/cli/audit.h"
#include "verify/cli/commands.h"
#include "verify/host/host.h"
#include "verify/interrupt/interrupt.h"
#include "verify/report/json.h"
#include "verify/subject/shell_word.h"

namespace limitcheck::cli {
namespace {

// For the attestation: which files were read.
nlohmann::json plan_of(const FilesArguments& files, const std::vector<std::string>& subjects) {
  nlohmann::json stamps = nlohmann::json::array();
  for (const std::string& file : subjects) stamps.push_back({file, file_digest(file)});
  return {{"stamps", stamps},
          {"meshes", nlohmann::json::array({{files.control, file_digest(files.control)}})},
          {"provenance", file_digest(files.provenance)},
          {"tolerance", files.options.tolerance}};
}

// What was asked besides the files, as the command line has it.
std::string options_of(const FilesArguments& files) {
  const verify::FilesOptions standard, &o = files.options;
  std::string text;
  if (o.tolerance != standard.tolerance) text += fmt::format(" --tolerance {}", o.tolerance);
  if (o.fit != standard.fit) text += o.fit == verify::Fit::kScale ? " --fit scale" : " --fit";
  if (!files.provenance.empty()) text += " --provenance " + verify::shell_word(files.provenance);
  if (o.hausdorff) text += fmt::format(" --max-deviation {}", *o.hausdorff);
  if (!o.measures_hausdorff) text += " --no-hausdorff";
  if (o.needs_normals) text += " --normals";
  if (files.channel_rule)
    text +=
        fmt::format(" --channel-rule {}", data::kChannelRules[static_cast<std::size_t>(*files.channel_rule)]);
  return text;
}

// The files that are named and those of folders, in the order of their names, each once.
std::vector<std::string> files_of(const FilesArguments& files) {
  namespace fs = std::filesystem;
  static const std::set<std::string> kTypes{".ply", ".obj", ".off", ".stl", ".gltf", ".glb"};
  std::vector<std::string> all;
  for (const std::string& name : files.tessellations) {
    std::vector<std::string> here{name};
    if (fs::is_directory(name)) {
      here.clear();
      for (const auto& entry : fs::directory_iterator(name))
        if (kTypes.contains(entry.path().extension())) here.push_back(entry.path());
      if (here.empty()) throw data::ArgumentError(name + ": there is no tessellation in this folder");
      std::ranges::sort(here);
    }
    for (std::string& file : here)
      if (std::ranges::find(all, file) == all.end()) all.push_back(std::move(file));
  }
  if (all.size() > 1 && !(files.provenance.empty() && files.per_vertex.empty()))
    throw data::ArgumentError("--provenance and --per-vertex are of one file, and several are named");
  return all;
}

}  // namespace

void add_files_options(CLI::App& audit, FilesArguments& files) {
  const char* group = kFilesGroup;
  verify::FilesOptions& options = files.options;
  auto* control = audit.add_option("--control", files.control, "Control mesh: a file or a generator's name")
                      ->group(group);
  auto* tessellation =
      audit
          .add_option("--tessellation", files.tessellations,
                      "A tessellation of it by any program: PLY, OBJ, OFF, STL, glTF or GLB, or a folder of "
                      "such files; may be repeated, each file is a subject of the report. Larger polygons "
                      "count as fans of triangles from their first corner")
          ->take_all()
          ->expected(1)
          ->allow_extra_args(false)
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
  option(add_channel_rule(audit, files.channel_rule));
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

int audit_files(const FilesArguments& files, const AuditArguments& a) {
  const tbb::global_control limit(
      tbb::global_control::max_allowed_parallelism,
      static_cast<std::size_t>(a.threads > 0 ? a.threads : tbb::info::default_concurrency()));
  const std::string& json = a.shard.json;
  refuse_one_file_for_two({{"--json", json}, {"--per-vertex", files.per_vertex}, {"--html", a.output.html}},
                          a.output);
  const verify::Clock clock;
  OpenedMesh opened = open_control_mesh(files.control, a.mesh);
  for (data::Channel& channel : opened.mesh.channels)
    if (files.channel_rule) channel.rule = files.channel_rule;
  const data::ControlMesh& control = opened.mesh;
  verify::require_range(files.control, control, true);
  const std::string cut = opened.chosen.cut > 0 ? word(a.mesh.polygons) : "";
  verify::FilesOptions options = files.options;
  options.scheme = opened.chosen.scheme;

  verify::Report report;
  report.version = LIMITCHECK_VERSION;
  report.depths = "file";
  report.meshes.push_back({files.control, static_cast<std::int64_t>(control.positions.size()),
                           static_cast<std::int64_t>(control.faces.size()), opened.chosen.scheme, cut});
  report.subjects = files_of(files);
  std::string about = scheme_line({opened.chosen}, a.mesh), per_vertex;
  std::map<std::string, verify::VertexErrors> errors;  // of each file
  Progress progress;
  const verify::InterruptGuard guard;
  int signal = 0;
  for (const std::string& file : report.subjects) {
    verify::FileTessellation tessellation = verify::read_tessellation(file);
    std::vector<verify::ProvenanceRow> provenance;
    if (!files.provenance.empty())
      provenance =
          verify::read_provenance(files.provenance, static_cast<std::int64_t>(tessellation.positions.size()),
                                  control, opened.chosen.scheme);
    verify::FilesAudit audit =
        verify::audit_files(files.control, control, std::move(tessellation), provenance, options,
                            [&](const std::string& what, std::size_t done, std::size_t total) {
                              progress.show(done, total, what);
                              verify::end_if_interrupted();
                            });
    for (verify::Result& r : audit.results) {
      r.triangulated = cut;
      r.file_options = options_of(files);
      report.results.push_back(std::move(r));
    }
    for (const std::string& note : audit.notes) about += "\n" + note;
    per_vertex = std::move(audit.per_vertex);
    if (!a.output.html.empty()) errors[file] = std::move(audit.errors);
    if (audit.gave_up) signal = verify::interrupted();  // the other files say the same of each row
  }
  progress.clear();
  if (signal != 0) report.incomplete = fmt::format("interrupted by {}", verify::signal_name(signal));
  report.seconds = clock.seconds();
  const bool judged = settle(a.output, report);
  const std::string text = json.empty() ? ""
                                        : attested(verify::to_json(report, a.output.level, a.output.all_rows),
                                                   plan_of(files, report.subjects));
  // The table stands behind an empty line.
  deliver(a, report, text, a.details ? about + "\n" : about, [&] {
    if (!files.per_vertex.empty() && signal == 0) verify::write_text(files.per_vertex, per_vertex);
    std::vector<verify::AuditMesh> meshes{{files.control, control}};
    meshes[0].depth = 0;  // as rows of files say
    meshes[0].asked_scheme = opened.chosen.scheme;
    write_report(a, {{}, meshes, report, a.threads}, text, [&](const verify::Result& row) {
      return verify::error_shape(errors[row.subject], control, row);
    });
  });
  return signal != 0 ? kSignalled + signal : exit_code_of(report, judged);
}

}  // namespace limitcheck::cli
