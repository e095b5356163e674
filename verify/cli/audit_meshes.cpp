// SPDX-License-Identifier: MIT
#include "verify/cli/audit_meshes.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>
#include <set>
#include <system_error>
#include <utility>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "data/known_answers.h"
#include "verify/audit/default_plan.h"
#include "verify/cli/audit_depths.h"
#include "verify/host/coordinate_range.h"
#include "verify/host/host.h"
#include "verify/relations/refusal.h"

namespace limitcheck::cli {
namespace {

OpenedMesh open_broken_mesh(const std::string& file, const MeshOptions& options) {
  data::io::Examination found = verify::read_broken_mesh(file, read_options(options));
  return {std::move(found.mesh), {found.scheme, found.cut}};
}

// Where no mesh is named and a depth is: Loop's shapes, and the quads and polygons of the plan, of the
// schemes that the subjects do.
std::vector<std::string> default_names(const MeshRequest& a,
                                       const std::vector<verify::AuditSubject>& audited) {
  std::vector<std::string> names;
  if (a.level != verify::Level::kQuick) names = data::worst_case_meshes();
  names.emplace_back("bumpy:800");
  for (std::string& shape : data::stock_shapes()) names.push_back(std::move(shape));
  if (read_options(a.options).scheme == data::Scheme::kLoop) return names;
  for (const verify::AuditMesh& m : verify::default_plan(a.level, audited))
    if (m.scheme() == data::Scheme::kCatmullClark &&
        std::find(names.begin(), names.end(), m.name) == names.end())
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

}  // namespace

std::optional<Sampling> parse_sample(const std::string& text) {
  if (text.empty()) return std::nullopt;
  Sampling sampling;
  const char* last = text.data() + text.size();
  std::from_chars_result read = std::from_chars(text.data(), last, sampling.faces);
  if (read.ec == std::errc() && read.ptr != last && *read.ptr == ':')
    read = std::from_chars(read.ptr + 1, last, sampling.seed);
  if (read.ec != std::errc() || read.ptr != last || sampling.faces == 0)
    throw data::ArgumentError(fmt::format("--sample {}: FACES or FACES:SEED", text));
  return sampling;
}

AuditedMeshes planned_meshes(const MeshOptions& options, verify::Level level,
                             const std::vector<verify::AuditSubject>& audited) {
  const std::optional<data::Scheme> asked = read_options(options).scheme;
  const std::vector<verify::AuditMesh> plan = verify::default_plan(level);
  AuditedMeshes result{asked ? plan : verify::default_plan(level, audited), {}};
  if (asked == data::Scheme::kLoop)
    std::erase_if(result.list, [](const auto& m) { return !m.mesh.faces.are_triangles(); });
  std::map<std::string, MeshScheme> by_name;  // the plan has a mesh at several depths
  for (verify::AuditMesh& m : result.list) {
    m.asked_scheme = asked;
    by_name[m.name] = {m.scheme(), 0};
  }
  std::vector<MeshScheme> chosen;
  for (const auto& [name, scheme] : by_name) chosen.push_back(scheme);
  result.scheme_line = scheme_line(chosen, options);
  if (audited.size() == 1 && !asked) result.scheme_line += left_out(plan, result.list, audited.front());
  return result;
}

AuditedMeshes open_meshes(const MeshRequest& a, const std::vector<verify::AuditSubject>& audited,
                          Progress& progress) {
  const std::vector<std::string> names = a.names.empty() ? default_names(a, audited) : a.names;
  std::vector<verify::AuditMesh> meshes;
  std::vector<MeshScheme> chosen;
  for (const std::string& name : names) {
    progress.show(0, 1, "mesh " + name);
    OpenedMesh opened = a.must_refuse ? open_broken_mesh(name, a.options) : open_mesh(name, a.options);
    chosen.push_back(opened.chosen);
    verify::AuditMesh m{name, std::move(opened.mesh)};
    m.asked_scheme = opened.chosen.scheme;
    if (opened.chosen.cut > 0) m.triangulated = a.options.triangulate;
    m.depth = a.depth;
    m.depths = a.depths.text();
    if (!a.must_refuse) {
      verify::require_range(name, m.mesh, true);
      m.face_depth = verify::face_depths(a.depths, m.mesh, a.depth);
      if (a.sampling)
        m.sample = std::make_shared<verify::MeshSample>(m.mesh, a.sampling->faces, a.sampling->seed);
      refuse_too_many_points(m);
    }
    meshes.push_back(std::move(m));
  }
  return {std::move(meshes), scheme_line(chosen, a.options)};
}

}  // namespace limitcheck::cli
