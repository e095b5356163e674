// SPDX-License-Identifier: MIT
#include "verify/audit/default_plan.h"

#include <algorithm>
#include <exception>
#include <string>

#include "data/generators/named_mesh.h"
#include "data/worst_cases.h"
#include "verify/evidence/face_depths.h"
#include "verify/host/host.h"

namespace limitcheck::verify {
namespace {

struct Case {
  std::string mesh;
  int depth;
  const char* depths = "uniform";
  bool relations = false;
};

// Each case is here because faults of its kind passed the audit without it.
const std::vector<Case>& small_cases() {
  static const std::vector<Case> all{
      // Faults at odd depths, and those that begin at depth 5 or 7.
      {"tetrahedron", 7},
      {"wheel:5:1", 5},
      {"bipyramid:5", 5},
      {"wheel:7:1", 6},
      {"triangle-pair", 7},
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
      {"three-components", 3},
      {"touching-components", 3},
      {"stellated", 3, "uniform", true},
      {"wheel:20:1", 3},
      {"wheel:33:1", 2},
      {"wheel:64:1", 2},
      {"wheel:256:1", 1},
      {"bipyramid:33", 2},
      // Indices of more than 16 bits; as a sample below, for subjects that cull.
      {"crowd:16500", 0},
      // Geometry.
      {"flat", 3},
      {"needles", 3},
      {"zero-edge", 3},
      {"far-box", 3},
      {"tiny-box", 3},
      {"huge-box", 3},
      // Quads and other polygons: every valence class and boundary situation, every kind of face.
      {"quad-cube", 4, "uniform", true},
      {"quad-cube", 1},
      {"quad-cube", 0},
      {"quad-cube", 2, "face0-culled"},
      {"quad-torus:4:3", 2},
      {"quad-wheel:3", 3},
      {"quad-wheel:5", 3},
      {"quad-wheel:6", 5},
      {"quad-wheel:8", 3},
      {"quad-wheel:12", 3},
      {"quad-wheel:50", 2},
      {"quad-fan:1", 3},
      {"quad-fan:2", 3},
      {"quad-fan:3", 3},
      {"quad-fan:4", 3},
      {"quad-fan:5", 3},
      {"quad-fan:6", 3},
      {"prism:3", 3, "uniform", true},
      {"prism:5", 4},
      {"prism:5", 0},
      {"prism:5", 2, "all-culled"},
      {"prism:8", 1},
      {"dual:bumpy:60", 3, "random:1", true},
      {"mixed:1:60", 3, "random:2"},
      {"mixed:1:60", 3, "view"},
      {"mixed-pawn", 2},
      // Sharp edges and vertices, for subjects that do them.
      {"dart:4", 2},
      {"dart:5", 1},
      {"corner:2", 2},
      {"corner:3", 2, "random:1"},
      {"corner:3", 1, "uniform", true},
      {"sharp:22:60", 1, "uniform", true},
      {"sharp:20:60", 2, "random:1"},
      {"sharp:36:60", 1},
      {"sharp:12:60", 1},
      {"creased-cube", 2, "uniform", true},
      {"creased-cube:3", 1, "uniform", true},
      {"crease-ring", 1},
      {"crease-ring:2", 2},
      {"crease-ring:2:3", 1, "uniform", true},
      {"quad-dart:4", 2},
      {"quad-dart:5", 1},
      {"quad-corner:2", 2},
      {"quad-corner:3", 2, "random:1"},
      {"quad-corner:3", 1, "uniform", true},
      {"mixed-sharp:8:60", 2, "uniform", true},
      {"mixed-sharp:20:60", 2, "random:1"},
      {"mixed-sharp:11:60", 1},
      {"smooth-triangles:1:60", 1},
  };
  return all;
}

AuditMesh made(const Case& c) {
  AuditMesh m{c.mesh, data::named_mesh(c.mesh)};
  m.depth = c.depth;
  m.face_depth = face_depths(parse_depths(c.depths), m.mesh, c.depth);
  m.depths = c.depths;
  m.relations = c.relations;
  return m;
}

}  // namespace

std::vector<AuditMesh> default_plan(Level level) {
  std::vector<Case> cases;
  if (level != Level::kQuick)
    for (const std::string& name : data::worst_case_meshes()) cases.push_back({name, 4, "uniform", true});
  cases.push_back({"bumpy:800", 4, "uniform", true});
  for (const std::string& shape : data::stock_shapes())
    for (const int depth : {4, 1, 0}) cases.push_back({shape, depth, "uniform", depth == 4});
  cases.insert(cases.end(), small_cases().begin(), small_cases().end());
  // The cases of a mesh together, so that its exact surface is there for all of them.
  std::vector<AuditMesh> plan;
  for (std::size_t k = 0; k < cases.size(); ++k)
    if (std::none_of(cases.begin(), cases.begin() + static_cast<std::ptrdiff_t>(k),
                     [&](const Case& before) { return before.mesh == cases[k].mesh; }))
      for (std::size_t same = k; same < cases.size(); ++same)
        if (cases[same].mesh == cases[k].mesh) plan.push_back(made(cases[same]));

  AuditMesh large = made({"crowd:18000", 2});
  large.sample = std::make_shared<MeshSample>(large.mesh, 100, 1);
  plan.push_back(std::move(large));
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

}  // namespace limitcheck::verify
