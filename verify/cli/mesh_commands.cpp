// SPDX-License-Identifier: MIT
// limitcheck generate, check and repair: control meshes by name, what is wrong with one, and one that can be audited
// made of one that cannot.

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "data/generators/named_mesh.h"
#include "data/io/gltf.h"
#include "data/io/polygon_soup.h"
#include "data/io/text_scanner.h"
#include "data/io/whole_content.h"
#include "data/io/write.h"
#include "data/summary.h"
#include "verify/cli/commands.h"
#include "verify/cli/mesh_options.h"
#include "verify/repair/repair.h"

namespace limitcheck::cli {
namespace {

struct GenerateArguments {
  std::string name, file, seed;
  data::ReadOptions mesh;
  bool ascii = false, list = false;
};

int print_list() {
  const auto meshes = data::named_meshes();
  std::size_t width = 0;
  for (const auto& mesh : meshes) width = std::max(width, mesh.name.size());
  for (const auto& mesh : meshes) say_lines(fmt::format("{:<{}}  {}\n", mesh.name, width, mesh.description));
  return kHeld;
}

void note_left_out(const data::ControlMesh& mesh, const std::string& file) {
  if (const std::string lost = data::left_out(mesh, data::io::format_of(file)); !lost.empty())
    say(stderr, "note: the file has no place for {}\n", lost);
}

int generate(const GenerateArguments& a) {
  if (a.list) return print_list();
  if (a.name.empty()) throw CLI::RequiredError("NAME (or --list)");
  if (a.file.empty()) throw CLI::RequiredError("--output");

  const std::string specification = a.seed.empty() ? a.name : a.name + ":" + a.seed;
  const auto [mesh, chosen] = open_generated_mesh(specification, a.mesh);
  data::write_mesh(a.file, mesh, {.ascii_ply = a.ascii});
  say(stderr, "{}\n", scheme_line({chosen}, a.mesh));
  say(stderr, "{}: {} vertices, {} faces\n", a.file, mesh.positions.size(), mesh.faces.size());
  note_left_out(mesh, a.file);
  return kHeld;
}

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
  say_lines(fmt::format("{:<20}{}\n", what, text));
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
           ? fmt::format("single precision rounds these coordinates to steps of {:.2g}, far below every edge",
                         s.float_step)
           : fmt::format("single precision rounds these coordinates to steps of {:.2g}: {} edges are shorter "
                         "than 16, and normals beside them cannot be right in single precision",
                         s.float_step, s.edges_lost_in_float));
}

// "12 for ever, 3 semi-sharp (0.5 to 3)".
template <class Tags>
std::string sharp(const Tags& tags) {
  std::int64_t lasting = 0, semi = 0;
  float least = data::kInfiniteSharpness, most = 0;
  for (const auto& tag : tags) {
    if (tag.sharpness >= data::kInfiniteSharpness) ++lasting;
    if (!(tag.sharpness > 0) || tag.sharpness >= data::kInfiniteSharpness) continue;
    ++semi;
    least = std::min(least, tag.sharpness), most = std::max(most, tag.sharpness);
  }
  std::string text = lasting > 0 ? fmt::format("{} for ever", lasting) : "";
  if (semi > 0)
    text += fmt::format("{}{} semi-sharp ({}{})", lasting > 0 ? ", " : "", semi, least,
                        least < most ? fmt::format(" to {}", most) : "");
  return text;
}

void print_sharpness(const data::Sharpness& s) {
  if (const std::string edges = sharp(s.edges); !edges.empty())
    line("sharp edges",
         edges + (s.creasing == data::Creasing::kChaikin ? "; sharpness falls by Chaikin's rule" : ""));
  if (const std::string vertices = sharp(s.vertices); !vertices.empty()) line("sharp vertices", vertices);
}

void print_channels(const std::vector<data::Channel>& channels) {
  for (const data::Channel& c : channels)
    line("channel",
         fmt::format("{}: {} values of {} components, by the rule {}{}", c.name,
                     c.values.size() / static_cast<std::size_t>(c.components), c.components,
                     data::kChannelRules[static_cast<std::size_t>(c.rule.value_or(data::kUsualChannelRule))],
                     c.rule ? "" : ", as none is said"));
}

nlohmann::ordered_json json_of(const std::vector<data::Channel>& channels) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const data::Channel& c : channels)
    all.push_back(
        {{"name", c.name},
         {"components", c.components},
         {"values", c.values.size() / static_cast<std::size_t>(c.components)},
         {"rule", c.rule ? nlohmann::ordered_json(data::kChannelRules[static_cast<std::size_t>(*c.rule)])
                         : nlohmann::ordered_json()}});
  return all;
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
          {"edges_lost_in_float", s.edges_lost_in_float},
          {"channels", json_of(found.mesh.channels)}};
}

constexpr std::size_t kMostListed = 20;

void print_faults(const std::string& file, const data::io::PolygonSoup& soup,
                  const std::vector<data::io::SoupFault>& faults) {
  const Found found = sorted(faults);
  const auto print = [&](const char* what, const char* why, const std::vector<data::io::SoupFault>& some) {
    line(what, fmt::format("{}{}, vertices and faces counted from {}, as the file does:", some.size(), why,
                           soup.first));
    for (std::size_t k = 0; k < std::min(some.size(), kMostListed); ++k)
      say_lines(fmt::format("  {}{}: {}: {}\n", file,
                            some[k].line > 0 ? fmt::format(":{}", some[k].line) : "", some[k].code,
                            some[k].message));
    if (some.size() > kMostListed)
      say("  and {} more; limitcheck check {} --json has them all\n", some.size() - kMostListed, file);
  };
  if (!found.unused.empty()) print("unused vertices", ", which an audit leaves out", found.unused);
  if (found.faults.empty())
    line("faults", "none");
  else
    print("faults", "", found.faults);
}

struct CheckArguments {
  std::string file;
  data::ReadOptions mesh;
  bool json = false;
};

int check(const CheckArguments& a) {
  const data::io::PolygonSoup soup = data::io::read_control_soup(a.file);
  const data::io::Examination found = data::io::examine(soup, a.mesh);
  const data::MeshSummary summary = data::summarise(found.mesh);
  const MeshScheme chosen{found.scheme, found.cut, soup.scheme == found.scheme && !a.mesh.scheme};
  if (a.json) {
    say("{}", dumped(to_json(a.file, chosen, soup, found, summary), 2));
  } else {
    if (soup.polygon_end.empty() && !soup.positions.empty()) {
      line("point cloud", fmt::format("{} vertices and no faces", soup.positions.size()));
    } else {
      say("{}\n", scheme_line({chosen}, a.mesh));
      print_summary(soup, summary);
      print_sharpness(found.mesh.sharpness);
      print_channels(found.mesh.channels);
    }
    for (const std::string& note : found.notes) line("note", note);
    print_faults(a.file, soup, found.faults);
  }
  return sorted(found.faults).faults.empty() ? kHeld : kFindings;
}

// In diagonals: what lies farther apart is not one vertex that was computed twice.
constexpr double kLargestDistance = 0.01;

struct RepairArguments {
  std::string file, output, weld;
  data::ReadOptions mesh;
  verify::RepairOptions options;
};

// `--weld scan.obj`: the word behind --weld is the mesh where it is no number.
void take_distance(RepairArguments& a) {
  const auto distance = a.weld.empty() ? 0.0 : data::io::to_double(a.weld);
  if (!distance && a.file.empty()) {
    a.file = a.weld;
  } else if (!distance || !(*distance >= 0 && *distance <= kLargestDistance)) {
    throw CLI::ValidationError("--weld",
                               fmt::format("{} is no number from 0 to {}", a.weld, kLargestDistance));
  } else {
    a.options.weld_distance = *distance;
  }
  if (a.file.empty()) throw CLI::RequiredError("MESH");
}

int repair(const RepairArguments& a) {
  const verify::Repaired repaired = verify::repair(data::io::read_control_soup(a.file), a.options);
  const data::io::Examination mesh = data::io::examine(repaired.soup, a.mesh);
  data::write_mesh(a.output, mesh.mesh);
  say("{}\n", scheme_line({{mesh.scheme, mesh.cut}}, a.mesh));
  for (const std::string& change : repaired.changes) say("{}\n", change);
  if (repaired.changes.empty()) say("nothing had to be changed\n");
  say("{}: {} vertices, {} faces\n", a.output, mesh.mesh.positions.size(), mesh.mesh.faces.size());
  note_left_out(mesh.mesh, a.output);
  // As the file that was written has them.
  const data::io::PolygonSoup written = data::io::read_soup(a.output);
  const auto left = data::io::examine(written, {.scheme = a.mesh.scheme}).faults;
  print_faults(a.output, written, left);
  return left.empty() ? kHeld : kFindings;
}

}  // namespace

void add_generate(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "generate", "Write a control mesh by name: limitcheck generate bumpy:800 -o bumpy.obj");
  auto a = std::make_shared<GenerateArguments>();
  command->add_option("NAME", a->name,
                      "The mesh, with parameters behind colons: wheel:7, bumpy:800, quad-cube (see --list)");
  add_value(*command, "-o,--output", a->file, "FILE", "The file: .obj, .off or .ply");
  command->add_option("--seed", a->seed, "Seed of a random mesh, as a last parameter of NAME would be");
  add_mesh_options(*command, a->mesh);
  command->add_flag("--ascii", a->ascii, "PLY as text");
  command->add_flag("--list", a->list, "Print the names and what they mean");
  command->callback([a, &exit_code] { exit_code = generate(*a); });
}

void add_check(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand(
      "check", "List everything that is wrong with a control mesh, and what it consists of");
  command->add_option("MESH", a->file, "An OBJ, OFF, PLY, STL, USD (.usda) or glTF file")->required();
  add_mesh_options(*command, a->mesh);
  command->add_flag("--json", a->json, "One JSON document on standard output in place of the text");
  command->footer(
      "What is a fault depends on the scheme: a face of four corners is one for Loop's only (MESH_POLYGON).\n"
      "Vertices that no face names are none: they are left out.\n"
      "Exit codes: 0 nothing is wrong, 1 the mesh has faults, 2 bad usage, or a file that cannot be read.\n"
      "An audit refuses a mesh with faults; limitcheck repair mends most of them.");
  command->callback([a, &exit_code] { exit_code = check(*a); });
}

void add_repair(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<RepairArguments>();
  CLI::App* command = app.add_subcommand(
      "repair", "Turn a mesh into one that can be audited: limitcheck repair scan.obj -o cage.obj");
  command->add_option("MESH", a->file, "An OBJ, OFF, PLY, STL, USD (.usda) or glTF file; it must be named");
  command->add_option("-o,--output", a->output, "The repaired mesh: .obj, .off or .ply")
      ->required()
      ->type_name("FILE");
  auto* weld = command->add_option(
      "--weld", a->weld,
      "Merge vertices at exactly the same place, which closes seams; with EPS, 0.01 or less, also border "
      "vertices that lie no more than EPS diagonals of the bounding box apart");
  weld->expected(0, 1)->type_name("[EPS]");
  add_mesh_options(*command, a->mesh);
  command->footer(
      "Drops faces with a repeated corner, faces given twice and vertices that no face names; orients "
      "neighbouring faces alike; cuts the mesh apart where it is no manifold; makes one face of two around "
      "an interior vertex. No vertex is moved, no hole filled, and faces of more than three corners stay so "
      "unless --triangulate is given.\n"
      "Exit codes: 0 the result can be audited, 1 faults are left (they are listed), 2 bad usage, or a file "
      "that cannot be read or written.");
  command->callback([a, weld, &exit_code] {
    a->options.weld = weld->count() > 0;
    take_distance(*a);
    exit_code = repair(*a);
  });
}

}  // namespace limitcheck::cli
