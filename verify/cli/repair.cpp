// SPDX-License-Identifier: MIT
// limitcheck repair: a mesh that can be audited, made of one that cannot.
#include "verify/repair/repair.h"

#include <fmt/core.h>

#include <memory>
#include <string>

#include "data/io/write.h"
#include "verify/cli/commands.h"
#include "verify/cli/mesh_options.h"
#include "verify/cli/mesh_report.h"

namespace limitcheck::cli {
namespace {

struct Arguments {
  std::string file, output;
  MeshOptions mesh;
  verify::RepairOptions options;
};

int repair(const Arguments& a) {
  const verify::Repaired repaired = verify::repair(data::io::read_soup(a.file), a.options);
  const data::io::Examination mesh = data::io::examine(repaired.soup, read_options(a.mesh));
  data::write_mesh(a.output, mesh.mesh);
  fmt::print("{}\n", scheme_line({{mesh.scheme, mesh.cut}}, a.mesh));
  for (const std::string& change : repaired.changes) fmt::print("{}\n", change);
  if (repaired.changes.empty()) fmt::print("nothing had to be changed\n");
  fmt::print("{}: {} vertices, {} faces\n", a.output, mesh.mesh.positions.size(), mesh.mesh.faces.size());
  // As the file that was written has them.
  const data::io::PolygonSoup written = data::io::read_soup(a.output);
  const auto left = data::io::examine(written, {.scheme = read_options(a.mesh).scheme}).faults;
  print_faults(a.output, written, left);
  return left.empty() ? kHeld : kFindings;
}

}  // namespace

void add_repair(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "repair", "Turn a mesh into one that can be audited: limitcheck repair scan.obj -o cage.obj");
  command->add_option("MESH", a->file, "An OBJ, OFF, PLY or STL file")->required();
  command->add_option("-o,--output", a->output, "The repaired mesh: .obj, .off or .ply")
      ->required()
      ->type_name("FILE");
  command->add_flag("--weld", a->options.weld,
                    "Merge vertices at exactly the same place, which closes seams");
  add_mesh_options(*command, a->mesh);
  command->footer(
      "Drops faces with a repeated corner, faces given twice and vertices that no face names; orients "
      "neighbouring faces alike; cuts the mesh apart where it is no manifold; makes one face of two around "
      "an "
      "interior vertex. No vertex is moved, no hole "
      "filled, and faces of more than three corners stay so unless --triangulate is given.\n"
      "Exit codes: 0 the result can be audited, 1 faults are left (they are listed), 2 bad usage, or a file "
      "that cannot be read or written.");
  command->callback([a, &exit_code] { exit_code = repair(*a); });
}

}  // namespace limitcheck::cli
