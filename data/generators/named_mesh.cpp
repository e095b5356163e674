// SPDX-License-Identifier: MIT
#include "data/generators/named_mesh.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <functional>
#include <limits>
#include <string_view>
#include <utility>

#include "data/building_blocks.h"
#include "data/generators/awkward_meshes.h"
#include "data/generators/bumpy_sphere.h"
#include "data/generators/channel_meshes.h"
#include "data/generators/every_neighbourhood.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/random_mesh.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/star_meshes.h"
#include "data/generators/surgery.h"
#include "data/io/gltf.h"
#include "data/io/polygon_soup.h"
#include "data/shapes.h"
#include "data/summary.h"
#include "data/triangulate.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

constexpr std::uint64_t kMostOfAll = std::numeric_limits<std::uint64_t>::max();

// The whole of a text as a number. `about` says in what.
std::uint64_t number_in(std::string_view text, const std::string& about) {
  std::uint64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  require(stop == text.data() + text.size() && error != std::errc::invalid_argument,
          "\"" + std::string(text) + "\" is not a whole number" + about);
  require(error == std::errc(), std::string(text) + " is more than " + std::to_string(kMostOfAll) + about);
  return value;
}

// The parameters behind a name. One that is not given has a value that the caller says.
class Parameters {
 public:
  Parameters(std::vector<std::uint64_t> values, std::string about)
      : values_(std::move(values)), about_(std::move(about)) {}

  std::uint64_t at(std::size_t k, std::uint64_t otherwise = 1) const {
    return k < values_.size() ? values_[k] : otherwise;
  }
  // Of what is counted.
  int count(std::size_t k, int otherwise = 0) const {
    constexpr auto kMost = std::numeric_limits<int>::max();
    const std::uint64_t value = at(k, static_cast<std::uint64_t>(otherwise));
    require(value <= kMost, std::to_string(value) + " is more than " + std::to_string(kMost) + about_);
    return static_cast<int>(value);
  }

 private:
  std::vector<std::uint64_t> values_;
  std::string about_;
};

struct Entry {
  std::string_view usage;  // the name, and its parameters: "bumpy:FACES[:SEED]"
  std::string_view description;
  std::function<ControlMesh(const Parameters&)> make;

  std::string_view name() const { return usage.substr(0, usage.find_first_of(":[")); }
  // How many parameters there must and may be.
  auto least() const { return std::count(usage.begin(), std::find(usage.begin(), usage.end(), '['), ':'); }
  auto most() const { return std::count(usage.begin(), usage.end(), ':'); }
};

auto plain(ControlMesh (*make)()) {
  return [make](const Parameters&) { return make(); };
}

using P = const Parameters&;

ControlMesh random_of(P p) {
  return random_mesh(p.at(0), {.faces = p.count(1, 200)});
}
ControlMesh mixed_of(P p) {
  return mixed_mesh(p.at(0), {.faces = p.count(1, 200)});
}

ControlMesh smooth_triangles(P p) {
  ControlMesh mesh = with_random_sharpness(mixed_of(p), p.at(0));
  mesh.sharpness.triangles = TriangleRule::kSmooth;
  return mesh;
}

ControlMesh planned(std::uint64_t k, bool triangles) {
  const auto& all = planned_stars(triangles);
  require(k >= 1 && k <= all.size(), "there are stars 1 to " + std::to_string(all.size()));
  return star_mesh(parse_stars(all[k - 1].stars), triangles);
}

ControlMesh neighbourhoods(P p, bool triangles) {
  if (p.at(0) < 3 || p.at(0) > 10 || p.at(1) > 63)
    throw InputError("NAME_BAD_PARAMETER", "", 0, "MOST is 3 to 10, and KINDS up to 63");
  const auto& all = every_neighbourhood(triangles, p.count(0), p.count(1));
  if (p.at(2) < 1 || p.at(2) > all.size())
    throw InputError("NAME_BAD_PARAMETER", "", 0, "there are meshes 1 to " + std::to_string(all.size()));
  return star_mesh(all[p.at(2) - 1], triangles);
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = {
      {"bumpy:FACES[:SEED]", "the paper's bumpy sphere, radii 0.5 to 1.5, FACES even; seed 1 unless given",
       [](P p) { return bumpy_sphere(p.count(0), p.at(1)); }},
      {"tetrahedron", "4 vertices of valence 3", plain(tetrahedron)},
      {"octahedron", "6 vertices of valence 4", plain(octahedron)},
      {"icosahedron", "12 vertices of valence 5", plain(icosahedron)},
      {"cube", "a triangulated cube: valences 4 and 6", plain(cube)},
      {"torus[:AROUND:ALONG]", "a regular torus, 12 x 6 unless given",
       [](P p) { return torus(p.count(0, 12), p.count(1, 6)); }},
      {"bipyramid:N", "two apices of valence N, an equator of valence 4",
       [](P p) { return bipyramid(p.count(0)); }},
      {"wheel:N[:RINGS]", "an interior vertex of valence N amid 3 rings of a regular lattice",
       [](P p) { return wheel(p.count(0), p.count(1, 3)); }},
      {"fan:K[:RINGS]", "a boundary vertex with K faces amid 3 half rings of a regular lattice",
       [](P p) { return fan(p.count(0), p.count(1, 3)); }},
      {"sheet[:NX:NY]", "a regular sheet of NX x NY squares, 6 x 6 unless given",
       [](P p) { return sheet(p.count(0, 6), p.count(1, 6)); }},
      {"holes", "a sheet with two holes", plain(holes)},
      {"strip:N", "N triangles in a row, all vertices on the boundary",
       [](P p) { return strip(p.count(0)); }},
      {"ragged-disc", "a disc with boundary vertices of 1 to 8 faces", plain(ragged_disc)},
      {"triangle", "one triangle", plain(triangle)},
      {"triangle-pair", "two triangles sharing an edge", plain(triangle_pair)},
      {"random:SEED[:FACES]",
       "any valid mesh: irregular, closed or open, valences 3 to 50; about 200 faces unless given",
       random_of},
      {"two-components", "a tetrahedron and a wheel of valence 5", plain(two_components)},
      {"three-components", "these two and an octahedron", plain(three_components)},
      {"touching-components", "two octahedra with a vertex at the same place", plain(touching_components)},
      {"handles:G", "a closed irregular block with G holes through it",
       [](P p) { return handles(p.count(0)); }},
      {"stellated", "an octahedron with a vertex of valence 3 above each face", plain(stellated)},
      {"flat", "a wheel of valence 5 in a plane", plain(flat)},
      {"needles", "a sheet of triangles 16384 times as long as wide", plain(needles)},
      {"zero-edge", "an icosahedron with an edge of length 0", plain(zero_edge)},
      {"far-box", "a cube some 100 times its side away from the origin", plain(far_box)},
      {"tiny-box", "a cube of about 1e-25", plain(tiny_box)},
      {"huge-box", "a cube of about 1e20", plain(huge_box)},
      {"quad-cube", "a cube of six quads; also called cube-quads", plain(quad_cube)},
      {"quad-torus[:AROUND:ACROSS]", "a regular torus of quads, 12 x 6 unless given",
       [](P p) { return quad_torus(p.count(0, 12), p.count(1, 6)); }},
      {"quad-wheel:N[:SEED]", "an interior vertex of valence N amid two rings of quads",
       [](P p) { return quad_wheel(p.count(0), p.at(1)); }},
      {"quad-fan:K[:SEED]", "a boundary vertex with K quads amid two half rings of quads",
       [](P p) { return quad_fan(p.count(0), p.at(1)); }},
      {"prism:N", "two faces of N corners and N quads", [](P p) { return polygon_prism(p.count(0)); }},
      {"pawn[:N]", "a chess pawn of quads, its poles of valence N, 8 unless given",
       [](P p) { return pawn(p.count(0, 8)); }},
      {"mixed-pawn[:N]",
       "the same with N triangles at the head and a face of N corners at the foot, 16 unless given",
       [](P p) { return mixed_pawn(p.count(0, 16)); }},
      {"mixed:SEED[:FACES]",
       "triangles, quads and faces of up to 8 corners: random:SEED[:FACES] with edges dissolved", mixed_of},
      {"creased-cube[:S]", "quad-cube with edges of sharpness S, infinite unless given",
       [](P p) { return creased_cube(p.at(0, 10)); }},
      {"crease-ring[:S[:TENTHS]]", "quad-torus with a crease of sharpness S around it, infinite unless given",
       [](P p) { return crease_ring(p.at(0, 10), p.at(1, 0)); }},
      {"open-crease[:EDGES]", "quad-torus with a crease of 5 edges that starts and ends, or of so many",
       [](P p) { return with_open_crease(quad_torus(12, 6), p.count(0, 5)); }},
      {"bumpy-crease:FACES[:EDGES]", "bumpy:FACES with a crease that starts and ends, of 5 edges",
       [](P p) { return with_open_crease(bumpy_sphere(p.count(0), 1), p.count(1, 5)); }},
      {"dart:N", "wheel:N with one sharp edge at the vertex of valence N",
       [](P p) { return dart(p.count(0), true); }},
      {"quad-dart:N", "quad-wheel:N with one sharp edge at the vertex of valence N",
       [](P p) { return dart(p.count(0), false); }},
      {"corner:K", "wheel:2K with K sharp edges at its centre, every second one",
       [](P p) { return corner(p.count(0), true); }},
      {"quad-corner:K", "quad-wheel:2K with K sharp edges at its centre",
       [](P p) { return corner(p.count(0), false); }},
      {"sharp:SEED[:FACES]", "random:SEED[:FACES] with sharp edges and vertices",
       [](P p) { return with_random_sharpness(random_of(p), p.at(0)); }},
      {"mixed-sharp:SEED[:FACES]", "mixed:SEED[:FACES] with sharp edges and vertices",
       [](P p) { return with_random_sharpness(mixed_of(p), p.at(0)); }},
      {"creased:SEED[:FACES]", "sharp:SEED[:FACES] with everything sharp that is so for ever",
       [](P p) { return with_random_creases(random_of(p), p.at(0)); }},
      {"mixed-creased:SEED[:FACES]", "mixed-sharp:SEED[:FACES] with everything sharp that is so for ever",
       [](P p) { return with_random_creases(mixed_of(p), p.at(0)); }},
      {"smooth-triangles:SEED[:FACES]",
       "mixed-sharp:SEED[:FACES] with OpenSubdiv's smooth rule for triangles", smooth_triangles},
      {"stars:K", "vertices of many kinds amid their triangles, which an audit without meshes takes",
       [](P p) { return planned(p.at(0), true); }},
      {"quad-stars:K", "the same amid quads and other faces", [](P p) { return planned(p.at(0), false); }},
      {"neighbourhoods:MOST:KINDS:K",
       "mesh K of those with every tagged neighbourhood up to valence MOST, of sharp edges of these KINDS, "
       "as "
       "limitcheck audit --exhaustive takes them",
       [](P p) { return neighbourhoods(p, true); }},
      {"quad-neighbourhoods:MOST:KINDS:K", "the same amid quads and other faces",
       [](P p) { return neighbourhoods(p, false); }},
      {"uv-cube", "quad-cube with texture coordinates in six charts", plain(cube_with_atlas)},
      {"uv-globe[:AROUND:ACROSS]",
       "a sphere with texture coordinates, a seam along a meridian; 12 x 6 unless given",
       [](P p) { return globe(p.count(0, 12), p.count(1, 6)); }},
      {"uv-torus[:AROUND:ACROSS]", "quad-torus with texture coordinates in one chart, cut along two circles",
       [](P p) { return torus_in_a_chart(p.count(0, 12), p.count(1, 6)); }},
      {"crowd:N", "N tetrahedra apart: beyond 16384 they have more vertices than 16 bits number",
       [](P p) { return crowd(p.count(0)); }},
      {"quad-crowd:N", "N cubes of quads apart: beyond 8192 the same",
       [](P p) { return crowd(p.count(0), true); }},
  };
  return all;
}

// A mesh made of another, whose name follows: "dual:NAME...", "stretched:K:NAME...".
struct Operation {
  std::string_view word, usage, description;
  std::uint64_t most;  // of the number K; 0: there is none
  ControlMesh (*apply)(ControlMesh mesh, std::uint64_t number, const std::string& name);
};
constexpr std::size_t kMostOperations = 32;  // one inside the other

ControlMesh dual_of(ControlMesh mesh, std::uint64_t, const std::string& name) {
  const std::int64_t open = summarise(mesh).boundary_edges;
  require(open == 0, "dual:" + name + ": the dual is for closed meshes, and " + name + " has " +
                         std::to_string(open) + " boundary edges");
  ControlMesh result = dual(mesh);
  const auto faults = validate(result);
  require(faults.empty(), faults.empty() ? ""
                                         : "dual:" + name + ": two faces of " + name +
                                               " share more than one edge: " + faults[0].message);
  return result;
}

ControlMesh stretched(ControlMesh mesh, std::uint64_t k, const std::string&) {
  for (auto& p : mesh.positions) p[0] *= static_cast<double>(1U << k);
  return mesh;
}

template <ControlMesh (*apply)(ControlMesh mesh, std::uint64_t number)>
ControlMesh by_number(ControlMesh mesh, std::uint64_t number, const std::string&) {
  return apply(std::move(mesh), number);
}

const std::vector<Operation>& operations() {
  static const std::vector<Operation> all{
      {"dual:", "dual:NAME...", "the dual of a closed mesh: dual:bumpy:800 has a face around each vertex", 0,
       dual_of},
      {"stretched:", "stretched:K:NAME...",
       "a mesh 2^K times as long along x: stretched:10:random:1 has needles", 30, stretched},
      {"handled:", "handled:K:NAME...", "a mesh with up to K tubes more, each in the place of two faces",
       1000,
       [](ControlMesh mesh, std::uint64_t k, const std::string&) {
         return with_handles(std::move(mesh), static_cast<int>(k), k);
       }},
      {"turned:", "turned:SEED:NAME...",
       "a mesh with some inner edges between other corners of the faces beside them", kMostOfAll,
       by_number<with_turned_edges>},
      {"tagged:", "tagged:SEED:NAME...",
       "a mesh with any sharp edges, vertices and options in place of its own", kMostOfAll,
       by_number<with_any_tags>},
      {"uv:", "uv:SEED:NAME...",
       "a mesh with texture coordinates in charts drawn by chance, and a rule for them", kMostOfAll,
       by_number<with_random_channel>},
      {"uvs:", "uvs:SEED:NAME...", "the same, and a channel \"colour\" of four components", kMostOfAll,
       by_number<with_random_channels>}};
  return all;
}

// An operation of a name, what it is done with, and the name of the mesh that it is done to.
struct Step {
  const Operation* operation;
  std::uint64_t number = 0;
  std::string name;
};

// Whether a name begins with a word that ends in a colon, or is that word; then it is taken off.
bool take(std::string_view& name, std::string_view word) {
  if (name != word.substr(0, word.size() - 1) && !name.starts_with(word)) return false;
  name.remove_prefix(std::min(word.size(), name.size()));
  return true;
}

// Takes the outermost operation off a name; nothing if there is none.
bool take_step(std::string_view& name, Step& step) {
  for (const Operation& o : operations()) {
    if (!take(name, o.word)) continue;
    step.operation = &o;
    if (o.most == 0) {
      require(!name.empty(), "dual:: the name of a mesh is missing (dual:NAME...)");
    } else {
      const char* const end = name.data() + name.size();
      const auto [stop, error] = std::from_chars(name.data(), end, step.number);
      require(error == std::errc() && step.number <= o.most && end - stop >= 2 && *stop == ':',
              std::string(o.word) + std::string(name) + ": a number K from 0 to " + std::to_string(o.most) +
                  " and the name of a mesh are needed (" + std::string(o.word) + "K:NAME...)");
      name.remove_prefix(static_cast<std::size_t>(stop + 1 - name.data()));
    }
    step.name = name;
    return true;
  }
  return false;
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> parts(1);
  for (const char c : text) c == ':' ? void(parts.emplace_back()) : parts.back().push_back(c);
  return parts;
}

// A mesh that is made of no other.
ControlMesh plain_mesh(std::string_view name) {
  if (std::string_view stars = name; take(stars, "star:"))
    return star_mesh(parse_stars(std::string(stars)), true);
  if (std::string_view stars = name; take(stars, "quad-star:"))
    return star_mesh(parse_stars(std::string(stars)), false);
  std::vector<std::string> parts = split(name);
  if (parts[0] == "cube-quads") parts[0] = "quad-cube";  // users know it by this name, too
  for (const Entry& entry : entries()) {
    if (parts[0] != entry.name()) continue;
    const std::string about = " (" + std::string(entry.usage) + ")";
    std::vector<std::uint64_t> values;
    for (std::size_t i = 1; i < parts.size(); ++i) values.push_back(number_in(parts[i], about));
    require(std::ssize(values) >= entry.least(), "a parameter is missing" + about);
    require(std::ssize(values) <= entry.most(), "too many parameters" + about);
    return entry.make({std::move(values), about});
  }
  throw InputError("NAME_UNKNOWN", "", 0,
                   "no mesh is called \"" + parts[0] + "\"; \"limitcheck generate --list\" names them all");
}

}  // namespace

ControlMesh named_mesh(const std::string& specification) {
  std::string_view name = specification;
  std::vector<Step> steps;  // from the outside inwards
  for (Step step; take_step(name, step); steps.push_back(step))
    require(steps.size() < kMostOperations, "a mesh is made of another one, and that of another, " +
                                                std::to_string(kMostOperations) + " times at most");
  ControlMesh mesh = plain_mesh(name);
  for (auto step = steps.rbegin(); step != steps.rend(); ++step)
    mesh = step->operation->apply(std::move(mesh), step->number, step->name);
  return mesh;
}

OpenedMesh open_named_mesh(const std::string& specification, const ReadOptions& options) {
  ControlMesh mesh = named_mesh(specification);
  Triangulated triangles = triangulate(mesh, options.polygons);
  if (triangles.cut > 0) {
    mesh.faces = std::move(triangles.faces);
    mesh.holes.clear();  // no generator makes any
    mesh.channels = std::move(triangles.channels);
  }
  if (triangles.cut > 0 || options.scheme)
    if (const auto faults = validate(mesh, options.scheme.value_or(natural_scheme(mesh))); !faults.empty())
      throw InputError(std::string(code(faults[0].fault)), specification, 0, faults[0].message);
  return {std::move(mesh), triangles.cut};
}

OpenedMesh open_mesh(const std::string& file_or_name, const ReadOptions& options) {
  // What looks like a file is taken for one, so that a mistyped path is called a missing file, not
  // an unknown name. Stars are written with dots and slashes.
  std::error_code ignored;
  const std::string before = file_or_name.substr(0, file_or_name.find_first_of("./"));
  const std::filesystem::path file = file_or_name;
  if (!std::filesystem::exists(file, ignored) &&
      (before.find("star:") != std::string::npos || (!file.has_extension() && !file.has_parent_path())))
    return open_named_mesh(file_or_name, options);
  const io::PolygonSoup soup = io::read_control_soup(file);
  io::Examination found = io::require_valid(soup, file_or_name, options);
  return {std::move(found.mesh), found.cut, found.left_out, std::move(found.notes), soup.scheme};
}

std::vector<NamedMesh> named_meshes() {
  std::vector<NamedMesh> list;
  for (const Entry& e : entries()) list.push_back({std::string(e.usage), std::string(e.description)});
  for (const Operation& o : operations()) list.push_back({std::string(o.usage), std::string(o.description)});
  list.push_back(
      {"star:SEED[c][h][s]:STAR[_STAR...]",
       "vertices amid their triangles, each edge with its sharpness (c: Chaikin's creasing, h: corners "
       "held): star:1:J.J.3 has a crease, star:2:o.B. a boundary where a semi-sharp edge ends"});
  list.push_back({"quad-star:SEED[c][h][s]:STAR[_STAR...]",
                  "the same amid quads and other faces (s: smooth triangles): quad-star:1:vJ.5/3-8"});
  return list;
}

std::vector<std::string> stock_shapes() {
  return {"tetrahedron", "octahedron",  "icosahedron", "cube",          "torus",    "bipyramid:3",
          "bipyramid:7", "wheel:3",     "wheel:4",     "wheel:5",       "wheel:6",  "wheel:7",
          "wheel:12",    "wheel:50",    "wheel:200",   "sheet",         "strip:6",  "fan:1",
          "fan:2",       "fan:3",       "fan:4",       "fan:5",         "fan:6",    "fan:7",
          "fan:8",       "ragged-disc", "holes",       "triangle-pair", "triangle", "two-components"};
}

}  // namespace limitcheck::data
