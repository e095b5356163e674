// SPDX-License-Identifier: MIT
#include "data/generators/named_mesh.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "data/error.h"
#include "data/generators/awkward_meshes.h"
#include "data/generators/bumpy_sphere.h"
#include "data/generators/mixed_mesh.h"
#include "data/generators/planned_stars.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/random_mesh.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/star_meshes.h"
#include "data/generators/surgery.h"
#include "data/io/polygon_soup.h"
#include "data/scheme.h"
#include "data/shapes.h"
#include "data/summary.h"
#include "data/triangulate.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

using Parameters = std::span<const std::uint64_t>;

struct Entry {
  const char* name;
  const char* usage;
  const char* description;
  std::size_t least, most;  // number of parameters
  std::function<ControlMesh(Parameters)> make;
};

int as_int(std::uint64_t value) {
  return static_cast<int>(std::min<std::uint64_t>(value, std::numeric_limits<int>::max()));
}

ControlMesh planned(std::uint64_t k, bool triangles) {
  const auto& all = planned_stars(triangles);
  if (k < 1 || k > all.size())
    throw InputError("NAME_BAD_PARAMETER", "", 0, "there are stars 1 to " + std::to_string(all.size()));
  return star_mesh(parse_stars(all[k - 1].stars), triangles);
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = {
      {"bumpy", "bumpy:FACES[:SEED]",
       "the paper's bumpy sphere, radii 0.5 to 1.5, FACES even; seed 1 unless given", 1, 2,
       [](Parameters p) { return bumpy_sphere(as_int(p[0]), p.size() > 1 ? p[1] : 1); }},
      {"bumpy-vertices", "bumpy-vertices:V[:SEED]", "the same with 2V - 4 faces", 1, 2,
       [](Parameters p) { return bumpy_sphere_of_vertices(as_int(p[0]), p.size() > 1 ? p[1] : 1); }},
      {"tetrahedron", "tetrahedron", "4 vertices of valence 3", 0, 0,
       [](Parameters) { return tetrahedron(); }},
      {"octahedron", "octahedron", "6 vertices of valence 4", 0, 0, [](Parameters) { return octahedron(); }},
      {"icosahedron", "icosahedron", "12 vertices of valence 5", 0, 0,
       [](Parameters) { return icosahedron(); }},
      {"cube", "cube", "a triangulated cube: valences 4 and 6", 0, 0, [](Parameters) { return cube(); }},
      {"torus", "torus[:AROUND:ALONG]", "a regular torus, 12 x 6 unless given", 0, 2,
       [](Parameters p) { return torus(p.empty() ? 12 : as_int(p[0]), p.size() < 2 ? 6 : as_int(p[1])); }},
      {"bipyramid", "bipyramid:N", "two apices of valence N, an equator of valence 4", 1, 1,
       [](Parameters p) { return bipyramid(as_int(p[0])); }},
      {"wheel", "wheel:N[:RINGS]", "an interior vertex of valence N amid 3 rings of a regular lattice", 1, 2,
       [](Parameters p) { return wheel(as_int(p[0]), p.size() > 1 ? as_int(p[1]) : 3); }},
      {"fan", "fan:K[:RINGS]", "a boundary vertex with K faces amid 3 half rings of a regular lattice", 1, 2,
       [](Parameters p) { return fan(as_int(p[0]), p.size() > 1 ? as_int(p[1]) : 3); }},
      {"sheet", "sheet[:NX:NY]", "a regular sheet of NX x NY squares, 6 x 6 unless given", 0, 2,
       [](Parameters p) { return sheet(p.empty() ? 6 : as_int(p[0]), p.size() < 2 ? 6 : as_int(p[1])); }},
      {"holes", "holes", "a sheet with two holes", 0, 0, [](Parameters) { return holes(); }},
      {"strip", "strip:N", "N triangles in a row, all vertices on the boundary", 1, 1,
       [](Parameters p) { return strip(as_int(p[0])); }},
      {"ragged-disc", "ragged-disc", "a disc with boundary vertices of 1 to 8 faces", 0, 0,
       [](Parameters) { return ragged_disc(); }},
      {"triangle", "triangle", "one triangle", 0, 0, [](Parameters) { return triangle(); }},
      {"triangle-pair", "triangle-pair", "two triangles sharing an edge", 0, 0,
       [](Parameters) { return triangle_pair(); }},
      {"random", "random:SEED[:FACES]",
       "any valid mesh: irregular, closed or open, valences 3 to 50; about 200 faces unless given", 1, 2,
       [](Parameters p) { return random_mesh(p[0], {.faces = p.size() > 1 ? as_int(p[1]) : 200}); }},
      {"two-components", "two-components", "a tetrahedron and a wheel of valence 5", 0, 0,
       [](Parameters) { return two_components(); }},
      {"three-components", "three-components", "these two and an octahedron", 0, 0,
       [](Parameters) { return three_components(); }},
      {"touching-components", "touching-components", "two octahedra with a vertex at the same place", 0, 0,
       [](Parameters) { return touching_components(); }},
      {"handles", "handles:G", "a closed irregular block with G holes through it", 1, 1,
       [](Parameters p) { return handles(as_int(p[0])); }},
      {"stellated", "stellated", "an octahedron with a vertex of valence 3 above each face", 0, 0,
       [](Parameters) { return stellated(); }},
      {"flat", "flat", "a wheel of valence 5 in a plane", 0, 0, [](Parameters) { return flat(); }},
      {"needles", "needles", "a sheet of triangles 16384 times as long as wide", 0, 0,
       [](Parameters) { return needles(); }},
      {"zero-edge", "zero-edge", "an icosahedron with an edge of length 0", 0, 0,
       [](Parameters) { return zero_edge(); }},
      {"far-box", "far-box", "a cube some 100 times its side away from the origin", 0, 0,
       [](Parameters) { return far_box(); }},
      {"tiny-box", "tiny-box", "a cube of about 1e-25", 0, 0, [](Parameters) { return tiny_box(); }},
      {"huge-box", "huge-box", "a cube of about 1e20", 0, 0, [](Parameters) { return huge_box(); }},
      {"quad-cube", "quad-cube", "a cube of six quads; also called cube-quads", 0, 0,
       [](Parameters) { return quad_cube(); }},
      {"quad-torus", "quad-torus[:AROUND:ACROSS]", "a regular torus of quads, 12 x 6 unless given", 0, 2,
       [](Parameters p) {
         return quad_torus(p.empty() ? 12 : as_int(p[0]), p.size() < 2 ? 6 : as_int(p[1]));
       }},
      {"quad-wheel", "quad-wheel:N[:SEED]", "an interior vertex of valence N amid two rings of quads", 1, 2,
       [](Parameters p) { return quad_wheel(as_int(p[0]), p.size() > 1 ? p[1] : 1); }},
      {"quad-fan", "quad-fan:K[:SEED]", "a boundary vertex with K quads amid two half rings of quads", 1, 2,
       [](Parameters p) { return quad_fan(as_int(p[0]), p.size() > 1 ? p[1] : 1); }},
      {"prism", "prism:N", "two faces of N corners and N quads", 1, 1,
       [](Parameters p) { return polygon_prism(as_int(p[0])); }},
      {"pawn", "pawn[:N]", "a chess pawn of quads, its poles of valence N, 8 unless given", 0, 1,
       [](Parameters p) { return pawn(p.empty() ? 8 : as_int(p[0])); }},
      {"mixed-pawn", "mixed-pawn[:N]",
       "the same with N triangles at the head and a face of N corners at the foot, 16 unless given", 0, 1,
       [](Parameters p) { return mixed_pawn(p.empty() ? 16 : as_int(p[0])); }},
      {"mixed", "mixed:SEED[:FACES]",
       "triangles, quads and faces of up to 8 corners: random:SEED[:FACES] with edges dissolved", 1, 2,
       [](Parameters p) { return mixed_mesh(p[0], {.faces = p.size() > 1 ? as_int(p[1]) : 200}); }},
      {"creased-cube", "creased-cube[:S]", "quad-cube with edges of sharpness S, infinite unless given", 0, 1,
       [](Parameters p) { return creased_cube(p.empty() ? 10 : p[0]); }},
      {"crease-ring", "crease-ring[:S[:TENTHS]]",
       "quad-torus with a crease of sharpness S around it, infinite unless given", 0, 2,
       [](Parameters p) { return crease_ring(p.empty() ? 10 : p[0], p.size() > 1 ? p[1] : 0); }},
      {"open-crease", "open-crease[:EDGES]",
       "quad-torus with a crease of 5 edges that starts and ends, or of so many", 0, 1,
       [](Parameters p) { return with_open_crease(quad_torus(12, 6), p.empty() ? 5 : as_int(p[0])); }},
      {"bumpy-crease", "bumpy-crease:FACES[:EDGES]",
       "bumpy:FACES with a crease that starts and ends, of 5 edges", 1, 2,
       [](Parameters p) {
         return with_open_crease(bumpy_sphere(as_int(p[0]), 1), p.size() < 2 ? 5 : as_int(p[1]));
       }},
      {"dart", "dart:N", "wheel:N with one sharp edge at the vertex of valence N", 1, 1,
       [](Parameters p) { return dart(as_int(p[0]), true); }},
      {"quad-dart", "quad-dart:N", "quad-wheel:N with one sharp edge at the vertex of valence N", 1, 1,
       [](Parameters p) { return dart(as_int(p[0]), false); }},
      {"corner", "corner:K", "wheel:2K with K sharp edges at its centre, every second one", 1, 1,
       [](Parameters p) { return corner(as_int(std::min<std::uint64_t>(p[0], 1U << 20)), true); }},
      {"quad-corner", "quad-corner:K", "quad-wheel:2K with K sharp edges at its centre", 1, 1,
       [](Parameters p) { return corner(as_int(std::min<std::uint64_t>(p[0], 1U << 20)), false); }},
      {"sharp", "sharp:SEED[:FACES]", "random:SEED[:FACES] with sharp edges and vertices", 1, 2,
       [](Parameters p) {
         return with_random_sharpness(random_mesh(p[0], {.faces = p.size() > 1 ? as_int(p[1]) : 200}), p[0]);
       }},
      {"mixed-sharp", "mixed-sharp:SEED[:FACES]", "mixed:SEED[:FACES] with sharp edges and vertices", 1, 2,
       [](Parameters p) {
         return with_random_sharpness(mixed_mesh(p[0], {.faces = p.size() > 1 ? as_int(p[1]) : 200}), p[0]);
       }},
      {"creased", "creased:SEED[:FACES]", "sharp:SEED[:FACES] with everything sharp that is so for ever", 1,
       2,
       [](Parameters p) {
         return with_random_creases(random_mesh(p[0], {.faces = p.size() > 1 ? as_int(p[1]) : 200}), p[0]);
       }},
      {"mixed-creased", "mixed-creased:SEED[:FACES]",
       "mixed-sharp:SEED[:FACES] with everything sharp that is so for ever", 1, 2,
       [](Parameters p) {
         return with_random_creases(mixed_mesh(p[0], {.faces = p.size() > 1 ? as_int(p[1]) : 200}), p[0]);
       }},
      {"smooth-triangles", "smooth-triangles:SEED[:FACES]",
       "mixed-sharp:SEED[:FACES] with OpenSubdiv's smooth rule for triangles", 1, 2,
       [](Parameters p) {
         ControlMesh mesh =
             with_random_sharpness(mixed_mesh(p[0], {.faces = p.size() > 1 ? as_int(p[1]) : 200}), p[0]);
         mesh.sharpness.triangles = TriangleRule::kSmooth;
         return mesh;
       }},
      {"stars", "stars:K", "vertices of many kinds amid their triangles, which an audit without meshes takes",
       1, 1, [](Parameters p) { return planned(p[0], true); }},
      {"quad-stars", "quad-stars:K", "the same amid quads and other faces", 1, 1,
       [](Parameters p) { return planned(p[0], false); }},
      {"crowd", "crowd:N", "N tetrahedra apart: beyond 16384 they have more vertices than 16 bits number", 1,
       1, [](Parameters p) { return crowd(as_int(p[0])); }},
      {"quad-crowd", "quad-crowd:N", "N cubes of quads apart: beyond 8192 the same", 1, 1,
       [](Parameters p) { return crowd(as_int(p[0]), true); }},
  };
  return all;
}

[[noreturn]] void bad_parameter(const Entry& entry, const std::string& why) {
  throw InputError("NAME_BAD_PARAMETER", "", 0, why + " (" + entry.usage + ")");
}

// Another name that users know a mesh by.
std::string without_alias(const std::string& name) {
  return name == "cube-quads" ? "quad-cube" : name;
}

// "dual:NAME..." and so on: the specifications that contain another.
constexpr std::string_view kDual = "dual:", kStretched = "stretched:", kHandled = "handled:",
                           kTurned = "turned:", kTagged = "tagged:", kStar = "star:",
                           kQuadStar = "quad-star:";

ControlMesh dual_of(const std::string& name) {
  const auto refuse = [&](const std::string& why) {
    throw InputError("NAME_BAD_PARAMETER", "", 0, "dual:" + name + ": " + why);
  };
  if (name.empty()) refuse("the name of a mesh is missing (dual:NAME...)");
  const ControlMesh mesh = named_mesh(name);
  const MeshSummary summary = summarise(mesh);
  if (summary.boundary_edges > 0)
    refuse("the dual is for closed meshes, and " + name + " has " + std::to_string(summary.boundary_edges) +
           " boundary edges");
  ControlMesh result = dual(mesh);
  if (const auto faults = validate(result); !faults.empty())
    refuse("two faces of " + name + " share more than one edge: " + faults[0].message);
  return result;
}

struct NumberedName {
  std::uint64_t number = 0;
  std::string name;
};

// "K:NAME..." behind `word`.
NumberedName numbered(std::string_view word, const std::string& what, std::uint64_t most) {
  NumberedName result;
  const char* const end = what.data() + what.size();
  const auto [stop, error] = std::from_chars(what.data(), end, result.number);
  if (error != std::errc() || result.number > most || end - stop < 2 || *stop != ':')
    throw InputError("NAME_BAD_PARAMETER", "", 0,
                     std::string(word) + what + ": a number K from 0 to " + std::to_string(most) +
                         " and the name of a mesh are needed (" + std::string(word) + "K:NAME...)");
  result.name = stop + 1;
  return result;
}

// x coordinates times 2^K.
ControlMesh stretched(const std::string& what) {
  const NumberedName at = numbered(kStretched, what, 30);
  ControlMesh mesh = named_mesh(at.name);
  for (auto& p : mesh.positions) p[0] *= static_cast<double>(1U << at.number);
  return mesh;
}

ControlMesh handled(const std::string& what) {
  const NumberedName at = numbered(kHandled, what, 1000);
  return with_handles(named_mesh(at.name), static_cast<int>(at.number), at.number);
}

ControlMesh turned(const std::string& what) {
  const NumberedName at = numbered(kTurned, what, std::numeric_limits<std::uint64_t>::max());
  return with_turned_edges(named_mesh(at.name), at.number);
}

ControlMesh tagged(const std::string& what) {
  const NumberedName at = numbered(kTagged, what, std::numeric_limits<std::uint64_t>::max());
  return with_any_tags(named_mesh(at.name), at.number);
}

ControlMesh star(const std::string& what) {
  return star_mesh(parse_stars(what), true);
}
ControlMesh quad_star(const std::string& what) {
  return star_mesh(parse_stars(what), false);
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ':') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

}  // namespace

ControlMesh named_mesh(const std::string& specification) {
  for (const auto& [word, make] :
       {std::pair{kDual, &dual_of}, std::pair{kStretched, &stretched}, std::pair{kHandled, &handled},
        std::pair{kTurned, &turned}, std::pair{kTagged, &tagged}, std::pair{kStar, &star},
        std::pair{kQuadStar, &quad_star}})
    if (specification == word.substr(0, word.size() - 1) || specification.starts_with(word))
      return make(specification.substr(std::min(word.size(), specification.size())));
  std::vector<std::string> parts = split(specification);
  parts[0] = without_alias(parts[0]);
  for (const Entry& entry : entries()) {
    if (parts[0] != entry.name) continue;
    std::vector<std::uint64_t> parameters;
    for (std::size_t i = 1; i < parts.size(); ++i) {
      std::uint64_t value = 0;
      const char* end = parts[i].data() + parts[i].size();
      const auto [stop, error] = std::from_chars(parts[i].data(), end, value);
      if (error != std::errc() || stop != end)
        bad_parameter(entry, "\"" + parts[i] + "\" is not a whole number");
      parameters.push_back(value);
    }
    if (parameters.size() < entry.least) bad_parameter(entry, "a parameter is missing");
    if (parameters.size() > entry.most) bad_parameter(entry, "too many parameters");
    return entry.make(parameters);
  }
  throw InputError("NAME_UNKNOWN", "", 0,
                   "no mesh is called \"" + parts[0] + "\"; \"limitcheck generate --list\" names them all");
}

OpenedMesh open_named_mesh(const std::string& specification, const ReadOptions& options) {
  ControlMesh mesh = named_mesh(specification);
  Triangulated triangles = triangulate(mesh, options.polygons);
  if (triangles.cut > 0) {
    mesh.faces = std::move(triangles.faces);
    mesh.holes.clear();  // no generator makes any
  }
  if (triangles.cut > 0 || options.scheme)
    if (const auto faults = validate(mesh, options.scheme.value_or(natural_scheme(mesh))); !faults.empty())
      throw InputError(std::string(code(faults[0].fault)), specification, 0, faults[0].message);
  return {std::move(mesh), triangles.cut};
}

OpenedMesh open_mesh(const std::string& file_or_name, const ReadOptions& options) {
  // What looks like a file is taken for one, so that a mistyped path is called a missing file, not
  // an unknown name.
  std::error_code ignored;
  const std::filesystem::path file = file_or_name;
  if (!std::filesystem::exists(file, ignored) && !file.has_extension() && !file.has_parent_path())
    return open_named_mesh(file_or_name, options);
  io::Examination found = io::require_valid(io::read_soup(file), file_or_name, options);
  return {std::move(found.mesh), found.cut, found.left_out, std::move(found.notes)};
}

std::vector<NamedMesh> named_meshes() {
  std::vector<NamedMesh> list;
  for (const Entry& entry : entries()) list.push_back({entry.usage, entry.description});
  list.push_back({"dual:NAME...", "the dual of a closed mesh: dual:bumpy:800 has a face around each vertex"});
  list.push_back(
      {"stretched:K:NAME...", "a mesh 2^K times as long along x: stretched:10:random:1 has needles"});
  list.push_back({"handled:K:NAME...", "a mesh with up to K tubes more, each in the place of two faces"});
  list.push_back(
      {"turned:SEED:NAME...", "a mesh with some inner edges between other corners of the faces beside them"});
  list.push_back(
      {"tagged:SEED:NAME...", "a mesh with any sharp edges, vertices and options in place of its own"});
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
