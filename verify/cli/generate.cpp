// SPDX-License-Identifier: MIT
// limitcheck generate: a control mesh by name into a file.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include "data/generators/named_mesh.h"
#include "data/io/write.h"
#include "verify/cli/commands.h"
#include "verify/cli/mesh_options.h"

namespace limitcheck::cli {
namespace {

struct Options {
  std::string name;
  std::string file;
  std::string seed;
  MeshOptions mesh;
  bool ascii = false;
  bool list = false;
  bool stock = false;
};

int print_list(const Options& options) {
  if (options.stock) {
    for (const std::string& name : data::stock_shapes()) fmt::print("{}\n", name);
    return kHeld;
  }
  const auto meshes = data::named_meshes();
  std::size_t width = 0;
  for (const auto& mesh : meshes) width = std::max(width, mesh.name.size());
  for (const auto& mesh : meshes) fmt::print("{:<{}}  {}\n", mesh.name, width, mesh.description);
  return kHeld;
}

int generate(const Options& options) {
  if (options.list || options.stock) return print_list(options);
  if (options.name.empty()) throw CLI::RequiredError("NAME (or --list)");
  if (options.file.empty()) throw CLI::RequiredError("--output");

  const std::string specification = options.seed.empty() ? options.name : options.name + ":" + options.seed;
  const auto [mesh, chosen] = open_named_mesh(specification, options.mesh);
  data::write_mesh(options.file, mesh, {.ascii_ply = options.ascii});
  fmt::print(stderr, "{}\n", scheme_line({chosen}, options.mesh));
  fmt::print(stderr, "{}: {} vertices, {} faces\n", options.file, mesh.positions.size(), mesh.faces.size());
  return kHeld;
}

}  // namespace

void add_generate(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "generate", "Write a control mesh by name: limitcheck generate bumpy:800 -o bumpy.obj");
  auto options = std::make_shared<Options>();
  command->add_option("NAME", options->name,
                      "The mesh, with parameters behind colons: wheel:7, bumpy:800, quad-cube (see --list)");
  command->add_option("-o,--output", options->file, "The file: .obj, .off or .ply")->type_name("FILE");
  command->add_option("--seed", options->seed, "Seed of a random mesh, as a last parameter of NAME would be");
  add_mesh_options(*command, options->mesh);
  command->add_flag("--ascii", options->ascii, "PLY as text");
  command->add_flag("--list", options->list, "Print the names and what they mean");
  command->add_flag("--stock", options->stock, "Print the names of the stock shapes that an audit runs on");
  command->callback([options, &exit_code] { exit_code = generate(*options); });
}

}  // namespace limitcheck::cli
