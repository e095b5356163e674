// SPDX-License-Identifier: MIT
// limitcheck check: everything that is wrong with a control mesh, and what it consists of.
#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "data/io/polygon_soup.h"
#include "data/summary.h"
#include "verify/cli/commands.h"
#include "verify/cli/mesh_options.h"
#include "verify/cli/mesh_report.h"

namespace limitcheck::cli {
namespace {

struct Arguments {
  std::string file;
  MeshOptions mesh;
  bool json = false;
};

// "8 of 3, 6 of 4"; of a long list the middle is left out.
std::string histogram(const std::map<int, std::int64_t>& counts) {
  constexpr std::size_t kMost = 12;
  std::string text;
  std::size_t k = 0;
  for (const auto& [key, count] : counts) {
    ++k;
    if (counts.size() > kMost && k > kMost - 2 && k < counts.size()) {
      if (k == counts.size() - 1) text += ", ...";
      continue;
    }
    text += fmt::format("{}{} of {}", text.empty() ? "" : ", ", count, key);
  }
  return text.empty() ? "none" : text;
}

std::map<int, std::int64_t> face_sizes(const data::io::PolygonSoup& soup) {
  std::map<int, std::int64_t> sizes;
  std::size_t begin = 0;
  for (const std::size_t end : soup.polygon_end) {
    ++sizes[static_cast<int>(end - begin)];
    begin = end;
  }
  return sizes;
}

void line(const std::string& what, const std::string& text) {
  fmt::print("{:<20}{}\n", what, text);
}

void print_summary(const data::io::PolygonSoup& soup, const data::MeshSummary& s) {
  line("vertices", fmt::format("{}", soup.positions.size()));
  line("faces", fmt::format("{}; by corners: {}", soup.polygon_end.size(), histogram(face_sizes(soup))));
  line("components", fmt::format("{}", s.components));
  line("boundary", s.boundary_edges == 0
                       ? "none: the mesh is closed"
                       : fmt::format("{} edges in {} loops", s.boundary_edges, s.boundary_loops));
  if (s.coincident_boundary_edges > 0)
    line("seams", fmt::format("{} boundary edges lie on another one: the surface is open there; limitcheck "
                              "repair --weld closes them",
                              s.coincident_boundary_edges));
  if (s.coincident_vertices > 0)
    line("coincident vertices", fmt::format("{} lie exactly where another one does", s.coincident_vertices));
  if (s.zero_area_faces > 0)
    line("zero area", fmt::format("{} faces; the surface may have no normal at them", s.zero_area_faces));
  line("inner vertices", fmt::format("by neighbours: {}", histogram(s.valence)));
  if (!s.boundary_faces.empty())
    line("boundary vertices", fmt::format("by faces: {}", histogram(s.boundary_faces)));
  line("box", fmt::format("diagonal {:.6g}, largest coordinate {:.6g}, shortest edge {:.3g}", s.diagonal,
                          s.largest, s.shortest_edge));
  line("float",
       s.edges_lost_in_float == 0
           ? fmt::format("numbers lie {:.2g} apart here, which leaves every edge its direction", s.float_step)
           : fmt::format("numbers lie {:.2g} apart here: {} edges are shorter than 16 such steps, and "
                         "normals beside them cannot be right in single precision",
                         s.float_step, s.edges_lost_in_float));
}

// Triangles of the mesh, or those that its faces would be cut into.
std::int64_t triangles(const data::Faces& faces) {
  return static_cast<std::int64_t>(faces.corners().size()) - 2 * static_cast<std::int64_t>(faces.size());
}

// Faults, and vertices that no face names, which are none.
struct Found {
  std::vector<data::io::SoupFault> faults, unused;
};

Found sorted(const std::vector<data::io::SoupFault>& all) {
  Found found;
  for (const auto& f : all) (data::io::is_unused(f) ? found.unused : found.faults).push_back(f);
  return found;
}

nlohmann::ordered_json list(const std::vector<data::io::SoupFault>& faults) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const auto& f : faults)
    all.push_back({{"code", f.code},
                   {"line", f.line > 0 ? nlohmann::ordered_json(f.line) : nlohmann::ordered_json()},
                   {"message", f.message}});
  return all;
}

nlohmann::ordered_json to_json(const std::string& file, const MeshScheme& chosen,
                               const data::io::PolygonSoup& soup, const data::io::Examination& found,
                               const data::MeshSummary& s) {
  const auto counts = [](const std::map<int, std::int64_t>& of) {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    for (const auto& [key, count] : of) object[std::to_string(key)] = count;
    return object;
  };
  const Found all = sorted(found.faults);
  return {{"program", "limitcheck"},
          {"version", LIMITCHECK_VERSION},
          {"file", file},
          {"scheme", name_of(chosen.scheme)},
          {"faces_cut", chosen.cut},
          {"valid", all.faults.empty()},
          {"numbers_from", soup.first},
          {"faults", list(all.faults)},
          {"warnings", list(all.unused)},
          {"notes", found.notes},
          {"vertices", soup.positions.size()},
          {"faces", soup.polygon_end.size()},
          {"face_sizes", counts(face_sizes(soup))},
          {"triangles", triangles(found.mesh.faces)},
          {"unused_vertices", s.unused_vertices},
          {"components", s.components},
          {"boundary_edges", s.boundary_edges},
          {"boundary_loops", s.boundary_loops},
          {"coincident_boundary_edges", s.coincident_boundary_edges},
          {"coincident_vertices", s.coincident_vertices},
          {"zero_area_faces", s.zero_area_faces},
          {"euler_characteristic", s.euler},
          {"interior_valences", counts(s.valence)},
          {"boundary_face_counts", counts(s.boundary_faces)},
          {"diagonal", s.diagonal},
          {"largest_coordinate", s.largest},
          {"shortest_edge", s.shortest_edge},
          {"float_step", s.float_step},
          {"edges_lost_in_float", s.edges_lost_in_float}};
}

int check(const Arguments& a) {
  const data::io::PolygonSoup soup = data::io::read_soup(a.file);
  const data::io::Examination found = data::io::examine(soup, read_options(a.mesh));
  const data::MeshSummary summary = data::summarise(found.mesh);
  const MeshScheme chosen{found.scheme, found.cut};
  if (a.json) {
    fmt::print("{}\n", to_json(a.file, chosen, soup, found, summary).dump(2));
  } else {
    fmt::print("{}\n", scheme_line({chosen}, a.mesh));
    print_summary(soup, summary);
    for (const std::string& note : found.notes) line("note", note);
    print_faults(a.file, soup, found.faults);
  }
  return sorted(found.faults).faults.empty() ? kHeld : kFindings;
}

}  // namespace

void print_faults(const std::string& file, const data::io::PolygonSoup& soup,
                  const std::vector<data::io::SoupFault>& faults) {
  const Found found = sorted(faults);
  const auto print = [&](const char* what, const char* why, const std::vector<data::io::SoupFault>& some) {
    line(what, fmt::format("{}{}, vertices and faces counted from {}, as the file does:", some.size(), why,
                           soup.first));
    for (const auto& f : some)
      fmt::print("  {}{}: {}: {}\n", file, f.line > 0 ? fmt::format(":{}", f.line) : "", f.code, f.message);
  };
  if (!found.unused.empty()) print("unused vertices", ", which an audit leaves out", found.unused);
  if (found.faults.empty())
    line("faults", "none");
  else
    print("faults", "", found.faults);
}

void add_check(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "check", "List everything that is wrong with a control mesh, and what it consists of");
  command->add_option("MESH", a->file, "An OBJ, OFF, PLY or STL file")->required();
  add_mesh_options(*command, a->mesh);
  command->add_flag("--json", a->json, "One JSON document on standard output in place of the text");
  command->footer(
      "What is a fault depends on the scheme: a face of four corners is one for Loop's only (MESH_POLYGON).\n"
      "Vertices that no face names are none: they are left out.\n"
      "Exit codes: 0 nothing is wrong, 1 the mesh has faults, 2 bad usage, or a file that cannot be read.\n"
      "An audit refuses a mesh with faults; limitcheck repair mends most of them.");
  command->callback([a, &exit_code] { exit_code = check(*a); });
}

}  // namespace limitcheck::cli
