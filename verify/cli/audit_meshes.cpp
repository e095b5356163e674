// SPDX-License-Identifier: MIT
// Which meshes `limitcheck audit` looks at and at which depths, whether they fit into memory, and the plan of the
// whole.
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <system_error>

#include "data/error.h"
#include "data/generators/every_neighbourhood.h"
#include "data/generators/named_mesh.h"
#include "data/io/whole_content.h"
#include "data/untrusted_json.h"
#include "data/worst_cases.h"
#include "verify/audit/default_plan.h"
#include "verify/cli/audit.h"
#include "verify/host/host.h"
#include "verify/relations/relations.h"
#include "verify/report/json.h"
#include "verify/row/rows.h"
#include "verify/shard/shard.h"
#include "verify/subject/face_domain.h"
#include "verify/subject/subject.h"

namespace limitcheck::cli {
namespace {

namespace fs = std::filesystem;

// Measured with bumpy:4000 at depth 5: 358 to 579 bytes a point.
constexpr double kBytesPerPoint = 350;

// As it is opened, for an audit.
std::pair<verify::AuditMesh, MeshScheme> audit_mesh(const std::string& name, OpenedMesh opened,
                                                    const data::ReadOptions& options, int depth,
                                                    const std::string& depths) {
  verify::AuditMesh m{name, std::move(opened.mesh)};
  m.asked_scheme = opened.chosen.scheme;
  if (opened.chosen.cut > 0) m.triangulated = word(options.polygons);
  m.depth = depth;
  m.depths = depths;
  return {std::move(m), opened.chosen};
}

// Where no mesh is named and a depth is: Loop's shapes, and the quads and polygons of the plan, of the
// schemes that the subjects do.
std::vector<std::string> default_names(const Job& a, const std::vector<verify::AuditSubject>& audited) {
  std::vector<std::string> names;
  if (a.level() != verify::Level::kQuick) names = data::worst_case_meshes();
  names.emplace_back("bumpy:800");
  for (std::string& shape : data::stock_shapes()) names.push_back(std::move(shape));
  if (a.mesh.scheme == data::Scheme::kLoop) return names;
  for (const verify::AuditMesh& m : verify::default_plan(a.level(), audited))
    if (m.scheme() == data::Scheme::kCatmullClark && std::ranges::find(names, m.name) == names.end())
      names.push_back(m.name);
  return names;
}

// "\nleft out: 15 of the plan's meshes: row-stream: does not do semi-sharp edges and vertices", for each reason
// one such line; nothing if all meshes of the plan are looked at.
std::string left_out(const std::vector<verify::AuditMesh>& plan, const std::vector<verify::AuditMesh>& kept,
                     const verify::AuditSubject& subject) {
  std::set<std::string> names;
  for (const verify::AuditMesh& m : kept) names.insert(m.name);
  std::map<std::pair<data::Scheme, std::int32_t>, std::string> reason;  // by scheme and sharp edges
  std::map<std::string, std::set<std::string>> meshes;                  // by reason
  for (const verify::AuditMesh& m : plan) {
    if (names.contains(m.name)) continue;
    const auto [why, is_new] = reason.try_emplace({m.scheme(), verify::sharp_kinds(m.mesh, m.scheme())});
    if (is_new) try {
        const verify::Session asked(*subject.subject, m.mesh, subject.options, verify::Session::Input::kValid,
                                    m.scheme());
      } catch (const verify::NotAsked& refusal) {
        why->second = refusal.what();
      } catch (const verify::SubjectError&) {  // the audit will say why
      }
    if (!why->second.empty()) meshes[why->second].insert(m.name);
  }
  std::string lines;
  for (const auto& [why, of] : meshes)
    lines += fmt::format("\nleft out: {} of the plan's meshes: {}", of.size(), why);
  return lines;
}

AuditedMeshes planned_meshes(const data::ReadOptions& options, verify::Level level,
                             const std::vector<verify::AuditSubject>& audited) {
  const std::optional<data::Scheme> asked = options.scheme;
  const std::vector<verify::AuditMesh> plan = verify::default_plan(level);
  AuditedMeshes result{asked ? plan : verify::default_plan(level, audited), {}};
  if (asked == data::Scheme::kLoop)
    std::erase_if(result.list, [](const auto& m) { return !m.mesh.faces.are_triangles(); });
  std::map<std::string, MeshScheme> by_name;  // the plan has a mesh at several depths
  for (verify::AuditMesh& m : result.list) {
    m.asked_scheme = asked;
    m.relations = m.relations && level != verify::Level::kQuick;
    by_name[m.name] = {m.scheme(), 0};
  }
  std::vector<MeshScheme> chosen;
  for (const auto& [name, scheme] : by_name) chosen.push_back(scheme);
  result.scheme_line = scheme_line(chosen, options);
  if (audited.size() == 1 && !asked) result.scheme_line += left_out(plan, result.list, audited.front());
  return result;
}

AuditedMeshes every_neighbourhood(const data::ReadOptions& options, int most,
                                  const verify::AuditSubject& audited) {
  static_assert(int{data::kWithSmoothTriangles} == int{LC_SHARP_SMOOTH_TRIANGLES} &&
                int{data::kWithoutDarts} == int{LC_SHARP_NO_DARTS});
  AuditedMeshes result;
  std::vector<MeshScheme> chosen;
  for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark}) {
    const lc_capabilities c = verify::capabilities(*audited.subject, audited.options, scheme);
    if (options.scheme.value_or(scheme) != scheme || !verify::does(c, scheme)) continue;
    const bool triangles = scheme == data::Scheme::kLoop;
    const std::int32_t kinds = c.sharp & 63;
    chosen.push_back({scheme, 0});
    const auto& all = data::every_neighbourhood(triangles, most, kinds);
    for (std::size_t k = 0; k < all.size(); ++k) {
      verify::AuditMesh m{fmt::format("{}{}", data::neighbourhoods_name(triangles, most, kinds), k + 1),
                          data::star_mesh(all[k], triangles)};
      m.asked_scheme = scheme;
      m.depths = "uniform";
      m.relations = m.asked_again = m.turned = false;
      for (m.depth = 0; m.depth <= std::min(2, c.max_depth); ++m.depth) result.list.push_back(m);
    }
  }
  result.scheme_line = scheme_line(chosen, options);
  return result;
}

AuditedMeshes open_meshes(const Job& a, const std::vector<verify::AuditSubject>& audited,
                          Progress& progress) {
  AuditedMeshes result;
  std::vector<MeshScheme> chosen;
  for (const std::string& name : a.meshes.empty() ? default_names(a, audited) : a.meshes) {
    progress.show(0, 1, "mesh " + name);
    data::io::Examination broken;
    if (a.must_refuse) broken = verify::read_broken_mesh(name, a.mesh);
    auto [mesh, scheme] = a.must_refuse
                              ? audit_mesh(name, {std::move(broken.mesh), {broken.scheme, broken.cut}},
                                           a.mesh, a.depth, a.depths)
                              : open_audit_mesh(name, a.mesh, a.depth, a.chosen.text(), a.sampling);
    mesh.relations = a.level() != verify::Level::kQuick;
    chosen.push_back(scheme);
    result.list.push_back(std::move(mesh));
  }
  result.scheme_line = scheme_line(chosen, a.mesh);
  return result;
}

template <class List>
std::string_view bytes(const List& list) {
  return {reinterpret_cast<const char*>(list.data()), list.size() * sizeof(*list.data())};
}

// Differs for another mesh of the same name.
std::string content(const data::ControlMesh& mesh) {
  std::vector<std::size_t> ends;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) ends.push_back(mesh.faces.first_corner(f + 1));
  return verify::digest(verify::digest(bytes(mesh.positions)) + verify::digest(bytes(mesh.faces.corners())) +
                        verify::digest(bytes(ends)));
}

}  // namespace

std::pair<verify::AuditMesh, MeshScheme> open_audit_mesh(const std::string& name,
                                                         const data::ReadOptions& options, int depth,
                                                         const std::string& depths,
                                                         const std::optional<Sampling>& sampling) {
  auto opened = audit_mesh(name, open_control_mesh(name, options), options, depth, depths);
  verify::AuditMesh& m = opened.first;
  verify::require_range(name, m.mesh, true);
  m.face_depth = verify::face_depths(verify::parse_depths(depths), m.mesh, depth);
  if (sampling) m.sample = std::make_shared<verify::MeshSample>(m.mesh, sampling->faces, sampling->seed);
  refuse_too_many_points(m);
  return opened;
}

AuditedMeshes meshes_of(const Job& a, const std::vector<verify::AuditSubject>& audited, Progress& progress) {
  if (!a.rerun.empty()) return meshes_again(a.again);
  if (a.exhaustive > 0) return every_neighbourhood(a.mesh, a.exhaustive, audited.front());
  return a.plan ? planned_meshes(a.mesh, a.level(), audited) : open_meshes(a, audited, progress);
}

void refuse_too_many_points(const verify::AuditMesh& mesh) {
  std::vector<std::int32_t> depths = mesh.face_depth;
  if (depths.empty()) depths.assign(mesh.mesh.faces.size(), mesh.depth);
  if (mesh.sample) depths = mesh.sample->depths_of_part(mesh.sample->cull(std::move(depths)));
  double points = 0;
  const data::ControlMesh& judged = mesh.sample ? mesh.sample->part() : mesh.mesh;
  for (std::size_t f = 0; f < depths.size(); ++f) {
    const verify::FaceDomain domain(mesh.scheme(), static_cast<int>(judged.faces[f].size()));
    // A polygon has points inside from depth 1 on.
    if (depths[f] >= 0)
      points += static_cast<double>(domain.point_count(std::int64_t{1} << std::max(depths[f], 1)));
  }
  const double needed = points * kBytesPerPoint;
  const double there =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (needed > there)
    throw data::ArgumentError(
        fmt::format("{}: the audit of {:.3g} points needs some {:.0f} GB, and this machine has {:.0f}: take "
                    "a smaller --depth, or look at a part with --sample FACES",
                    mesh.name, points, needed / 1e9, there / 1e9));
}

std::string subject_digest(const lc_subject& subject) {
  std::string file = subject.name;
  if (file.starts_with("program:")) file = file.substr(8, file.find(' ', 8) - 8);
  if (file.starts_with("shader:")) file.erase(0, 7);
  std::string found;
  if (const fs::path module = file; module.extension() == ".spv") {  // with its pragmas and passes
    std::set<fs::path> parts;
    std::error_code none;
    for (const fs::directory_entry& e : fs::directory_iterator(fs::absolute(module).parent_path(), none))
      if (e.path().filename().string().starts_with(module.stem().string() + '.')) parts.insert(e.path());
    for (const fs::path& part : parts) found += file_digest(part.string());
  } else {
    found = file_digest(file);
  }
  return !found.empty() ? found : subject.description != nullptr ? subject.description : "";
}

verify::Plan audit_plan(const verify::Auditor& auditor, const std::vector<verify::AuditSubject>& subjects,
                        const std::vector<verify::AuditMesh>& meshes, const verify::Report& report,
                        const verify::CoverageQuestion& coverage, const std::string& level) {
  nlohmann::json what{{"report", verify::header_json(report)},
                      {"coverage", verify::coverage_json(coverage)},
                      {"level", level},
                      {"stamps", nlohmann::json::array()},
                      {"rows", nlohmann::json::array()}};
  for (const auto& s : subjects) what["stamps"].push_back({s.label(), subject_digest(*s.subject)});
  bool polygons = false;
  std::map<std::vector<std::string>, std::size_t> lists;
  for (const auto& m : meshes) {
    what["meshes"].push_back({m.name, content(m.mesh), m.depth, m.depths, name_of(m.scheme()),
                              verify::digest(bytes(m.face_depth)), m.sample ? m.sample->text() : ""});
    polygons = polygons || !m.mesh.faces.are_triangles();
    for (const auto& s : subjects) {
      const auto [list, is_new] = lists.try_emplace(auditor.row_names(s, m), lists.size());
      if (is_new) what["rows"].push_back(list->first);
      what["rows_of_units"].push_back(list->second);
    }
  }
  what["polygons"] = polygons;
  return {"limitcheck audit", std::move(what), subjects.size() * meshes.size(), subjects.size()};
}

void require_units(const nlohmann::json& plan, const std::map<std::size_t, nlohmann::json>& results) try {
  const nlohmann::json &subjects = plan.at("report").at("subjects"), &meshes = plan.at("meshes");
  for (const auto& [unit, result] : results) {
    const std::string subject = subjects.at(unit % subjects.size());
    const nlohmann::json& mesh = meshes.at(unit / subjects.size());
    const auto refuse = [&, unit = unit](const std::string& why) {
      throw data::ArgumentError(
          fmt::format("unit {}, {} on {}: {}", unit, subject, mesh.at(0).get<std::string>(), why));
    };
    std::set<std::string> there,
        missing = plan.at("rows").at(data::value_of<std::size_t>(plan.at("rows_of_units").at(unit)));
    for (const verify::Result& row : verify::rows_of(result)) {
      if (row.subject != subject || row.mesh != mesh.at(0) || (mesh.at(2) >= 0 && row.depth != mesh.at(2)) ||
          row.depths != mesh.at(3) || row.sample != mesh.at(6) ||
          name_of(row.scheme) != mesh.at(4).get<std::string>())
        refuse(fmt::format("the row {} is of {} on {}, depth {} {} {}", row.check, row.subject, row.mesh,
                           row.depth, row.depths, row.sample));
      if (verify::verdict_of(row) != row.status)
        refuse(fmt::format("{} says {}, and its numbers say {}", row.check, word(row.status),
                           word(verify::verdict_of(row))));
      // Rows that only some subjects have are in no plan.
      const bool known = missing.erase(row.check) > 0 || verify::row_kind(row.check) != nullptr;
      if (!known || !there.insert(row.check).second)
        refuse(fmt::format("{} is no row of it, or is there twice", row.check));
    }
    if (!missing.empty()) refuse(fmt::format("there is no row {}", *missing.begin()));
  }
} catch (const nlohmann::json::exception& error) {
  throw data::ArgumentError(fmt::format("these are no results of an audit: {}", error.what()));
}

}  // namespace limitcheck::cli
