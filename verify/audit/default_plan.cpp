// SPDX-License-Identifier: MIT
#include "verify/audit/default_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <set>
#include <string_view>
#include <utility>

#include "data/generators/named_mesh.h"
#include "data/generators/star_meshes.h"
#include "data/worst_cases.h"
#include "verify/host/host.h"

namespace limitcheck::verify {
namespace {

constexpr std::size_t kSampled = 3000;  // faces of a mesh of large indices

// What the cells of neighbourhoods (cells.h) do not say: deep levels, the ways of asking, geometry, topology,
// and what the relations look at. Each case is here because faults of its kind passed the audit without it.
const std::vector<PlannedCase>& small_cases() {
  static const std::vector<PlannedCase> all{
      // Faults at odd depths, and those that begin at depth 5 or 7.
      {"tetrahedron", 7},
      {"wheel:5:1", 5},
      {"wheel:7:1", 6},
      {"triangle-pair", 7},
      {"star:1:rk.Je._or.h.", 6},
      {"quad-cube", 5},
      {"quad-star:1:or..", 7},
      {"quad-star:2:r.3/5-3", 6},
      {"quad-star:3:rk.J", 6},
      // Unequal depths and culled faces.
      {"bumpy:60", 4, "random:1", true},
      {"ragged-disc", 3, "random:2"},
      {"bumpy:60", 4, "view"},
      {"octahedron", 2, "face0-culled"},
      {"wheel:5:2", 2, "face0-culled"},
      {"octahedron", 2, "all-culled"},
      // Topology.
      {"handles:1", 2, "uniform", true},
      {"handles:2", 3},
      {"handles:3", 1},
      {"handled:1:quad-torus", 1},
      {"handled:2:quad-torus", 1},
      {"three-components", 3},
      {"touching-components", 3},
      {"stellated", 3, "uniform", true},
      // Indices of more than 16 bits, for subjects that do not cull.
      {"crowd:16500", 0},
      // More tags than a byte counts.
      {"star:1:rJ300", 1},
      {"quad-star:1:rJ300", 1},
      {"star:2:rJ120", 1},
      {"quad-star:2:rJ120", 1},
      // Hundreds of unlike tags at edges between vertices far apart in number: keys of two vertices that meet.
      {"sharp:7:2000", 1},
      {"mixed-sharp:9:2500", 1},
      // Geometry.
      {"flat", 3},
      {"needles", 3},
      {"zero-edge", 3},
      {"far-box", 3},
      {"tiny-box", 3},
      {"huge-box", 3},
      // Quads and other polygons.
      {"quad-cube", 3, "uniform", true},
      {"quad-cube", 0},
      {"quad-cube", 2, "face0-culled"},
      {"quad-torus:4:3", 2},
      {"prism:3", 2, "uniform", true},
      {"prism:5", 5},
      {"prism:5", 2, "all-culled"},
      {"dual:bumpy:60", 3, "random:1", true},
      {"mixed:1:60", 3, "random:2"},
      {"mixed:1:60", 3, "view"},
      {"mixed-pawn", 2},
      // Texture coordinates at deep levels.
      {"uv:3:quad-cube", 6},
      {"uv:4:tetrahedron", 6},
      // The relations of sharp edges and vertices, for subjects that do them.
      {"corner:3", 1, "uniform", true},
      {"sharp:22:60", 1, "uniform", true},
      {"creased-cube", 2, "uniform", true},
      {"creased-cube:3", 1, "uniform", true},
      {"crease-ring:2:3", 1, "uniform", true},
      {"quad-corner:3", 1, "uniform", true},
      {"mixed-sharp:8:60", 2, "uniform", true},
  };
  return all;
}

std::vector<PlannedCase> chosen_cases(Level level) {
  std::vector<PlannedCase> cases;
  if (level != Level::kQuick)
    for (const std::string& name : data::worst_case_meshes()) cases.push_back({name, 4});
  cases.push_back({"bumpy:800", 4});
  for (const std::string& shape : data::stock_shapes()) {
    if (shape != "wheel:200") cases.push_back({shape, 4});
    cases.push_back({shape, 2, "uniform", true});
  }
  cases.insert(cases.end(), small_cases().begin(), small_cases().end());
  return cases;
}

}  // namespace

AuditMesh made(const PlannedCase& planned) {
  AuditMesh m{planned.mesh, data::named_mesh(planned.mesh)};
  m.depth = planned.depth;
  m.face_depth = face_depths(parse_depths(planned.depths), m.mesh, planned.depth);
  m.depths = planned.depths;
  m.relations = planned.relations;
  m.asked_again = planned.asked_again;
  // Deep levels and large meshes cost most, and what turned corners show is seen on the others, too.
  m.turned = planned.depth < 4 && m.mesh.faces.size() <= 8192;
  if (m.mesh.positions.size() > 0x8000 && m.depth > 0)
    m.sample = std::make_shared<MeshSample>(m.mesh, kSampled, 1);
  return m;
}

Looked look_at(const AuditMesh& mesh) {
  const bool uniform = mesh.face_depth.empty() && !mesh.sample;
  return {sharp_kinds(mesh.mesh, mesh.scheme()) | (uniform ? 0 : kNeedsDepths), cells_of(mesh)};
}

const std::vector<std::int32_t>& steps_of_ability() {
  constexpr std::int32_t kHeld = LC_SHARP_CREASES | LC_SHARP_CORNERS, kUniform = kHeld | LC_SHARP_SEMI;
  constexpr std::int32_t kAll = kUniform | LC_SHARP_CHAIKIN | LC_SHARP_SMOOTH_TRIANGLES;
  static const std::vector<std::int32_t> all{
      0, LC_SHARP_CREASES, kHeld, kUniform, kAll, kNeedsDepths, kHeld | kNeedsDepths, kAll | kNeedsDepths};
  return all;
}

Covered covered_by(const std::vector<Looked>& known, data::Scheme scheme, std::int32_t ability) {
  Covered result{CellSet(cells(scheme).size()), CellSet(cells(scheme).size())};
  for (std::size_t k = 0; k < result.wanted.size(); ++k)
    result.wanted[k] =
        (cells(scheme)[k].needs() & ~(ability | kNeedsBoundary | kNeedsRelations | kNeedsOtherFaces)) == 0;
  for (const Looked& one : known)
    if ((one.needs & ~ability) == 0) add_cells(result.looked, one.cells);
  return result;
}

std::vector<AuditMesh> default_plan(Level level) {
  std::vector<PlannedCase> cases = chosen_cases(level);
  // Deep requests with other threads are no matter of neighbourhoods: stars without relations do without.
  for (const bool triangles : {true, false}) {
    const auto& stars = data::planned_stars(triangles);
    for (std::size_t k = 0; k < stars.size(); ++k)
      // Every second one has a channel, or two, which shape nothing.
      cases.push_back(
          {fmt::format("{}{}:{}", k % 2 != 0 ? "" : fmt::format("{}:{}:", k % 8 == 6 ? "uvs" : "uv", k + 1),
                       triangles ? "stars" : "quad-stars", k + 1),
           stars[k].depth, stars[k].depths, stars[k].relations, stars[k].relations});
  }
  // The cases of a mesh together, so that its exact surface is there for all of them.
  std::vector<AuditMesh> plan;
  for (std::size_t k = 0; k < cases.size(); ++k)
    if (std::none_of(cases.begin(), cases.begin() + static_cast<std::ptrdiff_t>(k),
                     [&](const PlannedCase& before) { return before.mesh == cases[k].mesh; }))
      for (std::size_t same = k; same < cases.size(); ++same)
        if (cases[same].mesh == cases[k].mesh) plan.push_back(made(cases[same]));

  return plan;
}

std::vector<AuditMesh> default_plan(Level level, const std::vector<AuditSubject>& subjects) {
  struct Does {
    data::Scheme scheme;
    std::int32_t sharp;
  };
  std::vector<Does> all;
  for (const auto scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark})
    for (const AuditSubject& s : subjects) try {
        const lc_capabilities c = capabilities(*s.subject, s.options, scheme);
        if (does(c, scheme)) all.push_back({scheme, c.sharp});
      } catch (const std::exception&) {  // the audit will say why
        all.push_back({scheme, 0});
      }
  std::vector<AuditMesh> plan = default_plan(level);
  std::erase_if(plan, [&](const AuditMesh& m) {
    return std::none_of(all.begin(), all.end(), [&](const Does& d) {
      return d.scheme == m.scheme() && does_sharp(d.sharp, m.mesh, m.scheme());
    });
  });
  return plan;
}

bool is_looked_at_beside_all(const AuditSubject& subject, bool on_a_device, const AuditMesh& mesh) {
  // Both schemes with relations, a boundary and sharp edges, and quads at a great depth.
  static const std::set<std::pair<std::string_view, int>> for_devices{
      {"icosahedron", 2}, {"icosahedron", 4},    {"sheet", 2},       {"sheet", 4},
      {"quad-cube", 5},   {"quad-torus:4:3", 2}, {"creased-cube", 2}};
  if (on_a_device) return for_devices.contains({mesh.name, mesh.depth});
  return subject.options.empty() || mesh.mesh.faces.size() <= kMostFacesUnderOptions;
}

}  // namespace limitcheck::verify
