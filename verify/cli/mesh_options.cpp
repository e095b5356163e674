// SPDX-License-Identifier: MIT
#include "verify/cli/mesh_options.h"

#include <algorithm>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "verify/cli/commands.h"

namespace limitcheck::cli {
namespace {

std::int64_t polygons(const data::ControlMesh& mesh) {
  std::int64_t count = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) count += mesh.faces[f].size() > 3;
  return count;
}

OpenedMesh taken(const std::string& name, data::OpenedMesh opened, const data::ReadOptions& options) {
  OpenedMesh result{std::move(opened.mesh), {}};
  const bool declared = !options.scheme && opened.scheme && opened.cut == 0;
  result.chosen = {declared ? *opened.scheme : options.scheme.value_or(data::natural_scheme(result.mesh)),
                   opened.cut, declared};
  if (result.chosen.scheme == data::Scheme::kLoop && !result.mesh.faces.are_triangles())
    throw data::ArgumentError(
        fmt::format("{}: {} of {} faces are no triangles, which Loop's scheme needs. Either leave out "
                    "--scheme loop, for the surface of Catmull-Clark's scheme; or cut them with "
                    "--triangulate fan or --triangulate shortest-diagonal, which is another surface",
                    name, polygons(result.mesh), result.mesh.faces.size()));
  return result;
}

// To be validated for the scheme that the mesh has: `taken` says in words what is wrong with the one asked for.
data::ReadOptions without_scheme(data::ReadOptions options) {
  options.scheme.reset();
  return options;
}

const Words<data::Triangulation> kTriangulations{
    {"fan", data::Triangulation::kFan}, {"shortest-diagonal", data::Triangulation::kShortestDiagonal}};

}  // namespace

CLI::Option* add_scheme(CLI::App& command, std::optional<data::Scheme>& scheme, const std::string& text) {
  using data::Scheme;
  return add_words<std::optional<Scheme>>(
      command, "--scheme", scheme, {{"loop", Scheme::kLoop}, {"catmull-clark", Scheme::kCatmullClark}}, text);
}

void add_mesh_options(CLI::App& command, data::ReadOptions& options) {
  add_scheme(
      command, options.scheme,
      "The subdivision scheme; default: loop if all faces of the mesh are triangles, else catmull-clark");
  add_words(command, "--triangulate", options.polygons, kTriangulations,
            "Cut larger faces into triangles, for Loop's scheme: from their first corner (fan), or quads "
            "along the shorter diagonal. The surface is another one than that of the faces");
}

CLI::Option* add_channel_rule(CLI::App& command, std::optional<data::ChannelRule>& rule) {
  Words<std::optional<data::ChannelRule>> rules;
  for (std::size_t k = 0; k < std::size(data::kChannelRules); ++k)
    rules.push_back({std::string(data::kChannelRules[k]), static_cast<data::ChannelRule>(k)});
  return add_words(
      command, "--channel-rule", rule, rules,
      "How a channel goes over seams and boundary, as USD's faceVaryingLinearInterpolation and "
      "OpenSubdiv's FVarLinearInterpolation; by default as the file says, or else corners-plus1");
}

std::string word(data::Triangulation polygons) {
  return word_of(kTriangulations, polygons);
}

data::Triangulation triangulation(const std::string& word) {
  for (const auto& [known, polygons] : kTriangulations)
    if (known == word) return polygons;
  return data::Triangulation::kKeep;
}

OpenedMesh open_control_mesh(const std::string& file_or_name, const data::ReadOptions& options) {
  data::ReadOptions how = without_scheme(options);
  how.leave_out_unused = true;
  data::OpenedMesh opened = data::open_mesh(file_or_name, how);
  if (opened.left_out > 0)
    say(stderr, "limitcheck: warning: {}: {} no face names {} left out\n", file_or_name,
        opened.left_out == 1 ? "a vertex that" : fmt::format("{} vertices that", opened.left_out),
        opened.left_out == 1 ? "is" : "are");
  for (const std::string& note : opened.notes) say(stderr, "limitcheck: note: {}: {}\n", file_or_name, note);
  return taken(file_or_name, std::move(opened), options);
}

OpenedMesh open_generated_mesh(const std::string& specification, const data::ReadOptions& options) {
  return taken(specification, data::open_named_mesh(specification, without_scheme(options)), options);
}

std::string scheme_line(const std::vector<MeshScheme>& meshes, const data::ReadOptions& options) {
  const auto count = [&](data::Scheme scheme) {
    return std::ranges::count_if(meshes, [&](const MeshScheme& m) { return m.scheme == scheme; });
  };
  std::int64_t cut = 0;
  for (const MeshScheme& m : meshes) cut += m.cut;
  const auto loop = count(data::Scheme::kLoop), catmull_clark = count(data::Scheme::kCatmullClark);
  if (loop > 0 && catmull_clark > 0)
    return fmt::format("scheme: loop ({} of {} meshes, whose faces are all triangles), catmull-clark ({})",
                       loop, meshes.size(), catmull_clark);
  const std::string name(name_of(loop > 0 ? data::Scheme::kLoop : data::Scheme::kCatmullClark));
  const std::string how = cut > 0          ? fmt::format("--triangulate {} cut {} face{} into triangles",
                                                         word(options.polygons), cut, cut == 1 ? "" : "s")
                          : options.scheme ? "--scheme"
                          : std::ranges::any_of(meshes, [](const MeshScheme& m) { return m.declared; })
                              ? "as the file says"
                          : loop > 0 ? "all faces are triangles"
                                     : "not all faces are triangles";
  return fmt::format("scheme: {} ({})", name, how);
}

}  // namespace limitcheck::cli
