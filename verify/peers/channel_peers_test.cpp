// SPDX-License-Identifier: MIT
// Channels by their rules against OpenSubdiv's Far, both schemes, and as each subject delivers them against the
// reference; and where these are known to differ.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

#include "data/generators/channel_meshes.h"
#include "data/generators/random_mesh.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/surgery.h"
#include "reference/channel/channel_mesh.h"
#include "reference/channel/channel_step.h"
#include "reference/surface/channel.h"
#include "verify/host/host.h"
#include "verify/peers/test_opensubdiv.h"
#include "verify/row/bounds.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using data::ChannelRule, data::ControlMesh;
using namespace test;
using reference::ChannelMesh, reference::ChannelTopology, reference::Run, reference::Sharpness,
    reference::ValueState;

ChannelMesh<double> channel_of(const ControlMesh& mesh, ChannelRule rule) {
  const data::Channel& uv = mesh.channels.at(0);
  std::vector<Vec3<double>> values;
  for (std::size_t c = 0; c < uv.corners.size(); ++c) values.push_back({uv.at(c, 0), uv.at(c, 1), 0});
  return {ChannelTopology(reference::Topology(mesh.positions.size(), mesh.faces), mesh.sharpness, uv.corners,
                          rule),
          values};
}

// The largest difference between the values of Far and those of our rules after each of some steps, at every corner.
double worst_difference(ControlMesh mesh, ChannelRule rule, data::Scheme scheme, int depth) {
  mesh.channels.at(0).rule = rule;
  ChannelMesh<double> ours = channel_of(mesh, rule);
  const data::Channel& uv = mesh.channels[0];
  const LentMesh lent(mesh, scheme);
  const auto refiner = make_refiner(lent.view());
  OpenSubdiv::Far::TopologyRefiner::UniformOptions uniform(depth);
  uniform.fullTopologyInLastLevel = true;
  refiner->RefineUniform(uniform);
  const OpenSubdiv::Far::PrimvarRefinerReal<double> primvars(*refiner);
  std::vector<OpenSubdivVector<double>> values;
  for (std::size_t i = 0; i < uv.values.size(); i += 2)
    values.push_back({{uv.values[i], uv.values[i + 1], 0}});
  std::vector<int> vertex(mesh.positions.size()), face(mesh.faces.size());  // Far's number of ours
  std::iota(vertex.begin(), vertex.end(), 0);
  std::iota(face.begin(), face.end(), 0);
  double worst = 0;
  for (int level = 1; level <= depth; ++level) {
    const OpenSubdiv::Far::TopologyLevel &here = refiner->GetLevel(level - 1),
                                         &finer = refiner->GetLevel(level);
    std::vector<OpenSubdivVector<double>> next(static_cast<std::size_t>(finer.GetNumFVarValues(0)));
    primvars.InterpolateFaceVarying(level, values, next, 0);
    values.swap(next);
    std::vector<int> next_vertex, next_face;
    for (const int v : vertex) next_vertex.push_back(here.GetVertexChildVertex(v));
    for (const auto& e : ours.topology.edges())
      next_vertex.push_back(here.GetEdgeChildVertex(
          here.FindEdge(vertex[static_cast<std::size_t>(e.a)], vertex[static_cast<std::size_t>(e.b)])));
    for (std::size_t f = 0; f < face.size(); ++f) {
      if (scheme == data::Scheme::kCatmullClark) next_vertex.push_back(here.GetFaceChildVertex(face[f]));
      // Its faces may begin at other corners than ours.
      const auto children = here.GetFaceChildFaces(face[f]);
      for (const std::int32_t v : ours.topology.faces()[f])
        next_face.push_back(
            children[here.GetFaceVertices(face[f]).FindIndex(vertex[static_cast<std::size_t>(v)])]);
      if (scheme == data::Scheme::kLoop) next_face.push_back(children[3]);
    }
    vertex = std::move(next_vertex), face = std::move(next_face);
    ours = refine_once(ours, scheme, mesh.sharpness.triangles);
    for (std::size_t f = 0; f < face.size(); ++f) {
      const auto corners = finer.GetFaceVertices(face[f]);
      const auto indices = finer.GetFaceFVarValues(face[f], 0);
      for (const std::int32_t v : ours.topology.faces()[f]) {
        const int k = corners.FindIndex(vertex[static_cast<std::size_t>(v)]);
        const auto& x = values[static_cast<std::size_t>(indices[k])].x;
        const Vec3<double> off =
            ours.values[ours.corner(static_cast<std::int32_t>(f), v)] - Vec3<double>{x[0], x[1], x[2]};
        worst = std::max(worst, magnitude(off));
      }
    }
  }
  return worst;
}

// What a channel has that Far is known to get wrong. [findings]
struct Disputed {
  bool parted = false;   // a value with several runs at a vertex of three runs and more
  bool in_runs = false;  // or of two
  // A dependent value beside a semi-sharp seam, or at a vertex that is semi-sharp itself; one with several edges
  // that hold it: Far takes their mean, also where they last unequally.
  bool dependent = false, several = false;
  bool one_face = false;  // a value of one face
  bool any() const { return parted || dependent || several; }
};
Disputed disputed_of(const ControlMesh& mesh, ChannelRule rule) {
  const ChannelMesh<double> channel = channel_of(mesh, rule);
  Disputed result;
  for (std::size_t id = 0; id < mesh.positions.size(); ++id) {
    const auto v = static_cast<std::int32_t>(id);
    const auto sector = channel.topology.sector(v);
    const std::vector<Run> runs = channel.runs(v);
    std::set<std::int32_t> different;
    bool semi_sharp_seam = false;
    for (std::size_t i = 0; i < sector.edges.size(); ++i)
      semi_sharp_seam =
          semi_sharp_seam || (channel.seams[static_cast<std::size_t>(sector.edges[i])] &&
                              Sharpness::is_semi_sharp(channel.sharpness.edge(sector.edges[i])));
    for (const Run& run : runs) {
      const std::size_t corner = channel.corner(channel.face(sector, run, 0), v);
      different.insert(mesh.channels[0].corners[corner]);
      result.one_face = result.one_face || run.count == 1;
      if (channel.states[corner] != ValueState::kDependent) continue;
      int holding = 0;
      for (const auto& h : channel.holding(v, run)) holding += h.now > 0 ? 1 : 0;
      result.dependent = result.dependent || semi_sharp_seam || channel.sharpness.vertex(v) > 0;
      result.several = result.several || holding > 1;
    }
    result.in_runs = result.in_runs || runs.size() > different.size();
    result.parted = result.parted || (runs.size() > different.size() && runs.size() > 2);
  }
  return result;
}

ControlMesh random_channel(std::uint64_t seed, bool triangles) {
  ControlMesh mesh =
      triangles ? data::random_mesh(seed, {.faces = 12}) : data::mixed_mesh(seed, {.faces = 16});
  if (seed % 3 != 0) mesh = data::with_random_sharpness(std::move(mesh), seed);
  return data::with_random_channel(std::move(mesh), seed);
}

// Values are below 4, and Far has sharpnesses in float: of each of three steps a few units of its last place.
constexpr double kSame = 4e-6;

TEST(ChannelPeers, FarHasTheSameValuesWhereItIsRight) {
  int same = 0, disputed = 0, different = 0;
  for (std::uint64_t seed = 1; seed <= 6400; ++seed) {
    const bool triangles = seed % 2 == 0;
    const ControlMesh mesh = random_channel(seed, triangles);
    // The rule `all` is linear at once, without steps; what Far delivers by it is compared below.
    const auto rule = static_cast<ChannelRule>(seed / 2 % 5);
    const double worst =
        worst_difference(mesh, rule, triangles ? data::Scheme::kLoop : data::Scheme::kCatmullClark, 3);
    // By Chaikin's creasing Far has other points of some edges, of positions as of values. [findings]
    const bool known =
        disputed_of(mesh, rule).any() || (mesh.sharpness.creasing == data::Creasing::kChaikin &&
                                          (triangles ? FarMesh<Triangles>(mesh, 3, false).worst
                                                     : FarMesh<Quads>(mesh, 3, false).worst) > 1e-6);
    (known ? disputed : same) += 1;
    if (known)
      different += worst > kSame ? 1 : 0;
    else
      EXPECT_LE(worst, kSame) << "seed " << seed << " rule "
                              << data::kChannelRules[static_cast<std::size_t>(rule)];
  }
  std::printf("%d channels the same, %d disputed, of which %d differ\n", same, disputed, different);
  EXPECT_GE(same, 2000);
  EXPECT_GE(different, 100);
}

// How a subject delivers channels, and where it is known to do otherwise. [findings]
struct Delivers {
  const char *subject, *options;
  data::Scheme scheme;
  bool (*known)(const Disputed&, const ControlMesh&, ChannelRule);
  double most = 0;  // that a value may be off, where that is more than the audit's bound of positions
};
bool for_far(const Disputed& d, const ControlMesh&, ChannelRule) {
  return d.any();
}
// Of several edges that hold a value it takes the one that lasts longest.
bool for_bfr(const Disputed& d, const ControlMesh&, ChannelRule) {
  return d.several;
}
bool quads_alone(const ControlMesh& mesh) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.faces[f].size() != 4) return false;
  return true;
}
// Values of one face by the rule none, and values in several runs; by the rule all, faces that are no quads.
bool for_embree(const Disputed& d, const ControlMesh& mesh, ChannelRule rule) {
  if (rule == ChannelRule::kAll) return !quads_alone(mesh);
  return rule != ChannelRule::kBoundaries && (d.in_runs || (d.one_face && rule == ChannelRule::kNone));
}

// Sharp edges and vertices that are smooth after two steps: behind them the limits of all are right.
ControlMesh short_lived(ControlMesh mesh) {
  mesh.sharpness.creasing = data::Creasing::kUniform;
  const auto shorten = [](float& s) { s = s < data::kInfiniteSharpness ? std::min(s, 1 + s / 8) : 2; };
  for (auto& e : mesh.sharpness.edges) shorten(e.sharpness);
  for (auto& v : mesh.sharpness.vertices) shorten(v.sharpness);
  return mesh;
}

// At the corners of triangles whose vertices are named by the triangle's own face.
double worst_delivered(const Session& session, const Tessellation& t, ChannelRule rule, data::Scheme scheme) {
  const reference::ChannelSurface surface(session.mesh(), session.mesh().channels.at(0), rule, scheme);
  double worst = 0;
  for (std::int64_t n = 0; n < t.triangle_count(); ++n)
    for (int k = 0; k < 3; ++k) {
      const Place at = t.place(t.triangles()[static_cast<std::size_t>(n)][static_cast<std::size_t>(k)]);
      if (at.face != t.triangle_face()[static_cast<std::size_t>(n)]) continue;
      const auto is =
          surface.evaluate(at.face, at.corner, double(at.i) / at.denominator, double(at.j) / at.denominator)
              .position;
      const double off = std::hypot(t.channel_value(0, n, k, 0) - is.x, t.channel_value(0, n, k, 1) - is.y);
      worst = std::isfinite(off) ? std::max(worst, off) : off;
    }
  return worst;
}

TEST(ChannelPeers, SubjectsDeliverTheReferencesValuesWhereTheyAreRight) {
  constexpr int kDepth = 2;
  constexpr auto kLoop = data::Scheme::kLoop, kQuads = data::Scheme::kCatmullClark;
  const char* const patches = "precision=double,level=6,corners=smooth,inf-sharp=on";
  const char* const stencils = "precision=double,level=6,corners=smooth,inf-sharp=on,evaluate=limit-stencils";
  const char* const bfr = "precision=double,approx-level=6";
  const Delivers all[] = {{"opensubdiv-far", "precision=double", kLoop, for_far, kSame},
                          {"opensubdiv-far", "precision=double", kQuads, for_far, kSame},
                          {"opensubdiv-far", "precision=double,evaluate=stencils", kLoop, for_far, kSame},
                          {"opensubdiv-far", "precision=double,evaluate=stencils", kQuads, for_far, kSame},
                          {"opensubdiv-far-patches", patches, kLoop, for_far},
                          {"opensubdiv-far-patches", patches, kQuads, for_far},
                          {"opensubdiv-far-patches", stencils, kLoop, for_far},
                          {"opensubdiv-far-patches", stencils, kQuads, for_far},
                          {"opensubdiv-bfr", bfr, kLoop, for_bfr},
                          {"opensubdiv-bfr", bfr, kQuads, for_bfr},
                          {"embree", "", kQuads, for_embree}};
  for (const auto& [name, options, scheme, known, most] : all) {
    SCOPED_TRACE(std::string(name) + ":" + options);
    int same = 0, different = 0;
    double worst_same = 0;
    for (std::uint64_t seed = 1; seed <= 250; ++seed) {
      ControlMesh mesh = short_lived(random_channel(seed, scheme == kLoop));
      const auto rule = static_cast<ChannelRule>(seed / 3 % 6);
      mesh.channels[0].rule = rule;
      if (known == for_embree) mesh.sharpness = {};  // at seams it has its faults of boundaries
      Session session(*find_subject(name), mesh, options, Session::Input::kValid, scheme);
      if (session.mesh().channels.empty()) continue;  // it has no such rule
      const Tessellation t = session.tessellate(kDepth);
      ASSERT_TRUE(t.defects().empty() && t.overruns().empty());
      ASSERT_EQ(t.channel_count(), 1U);
      const double worst = worst_delivered(session, t, rule, scheme);
      const double rounding = position_bound(session.capabilities().precision, kDepth, 4, 1);
      // OpenSubdiv has fractions of sharpnesses in float.
      const double bound = std::max({most, rounding, mesh.sharpness.empty() ? 0 : kSame});
      if (known(disputed_of(mesh, rule), mesh, rule)) {
        different += worst > bound ? 1 : 0;
      } else {
        same += 1, worst_same = std::max(worst_same, worst);
        EXPECT_LE(worst, bound) << "seed " << seed << " rule "
                                << data::kChannelRules[static_cast<std::size_t>(rule)];
      }
    }
    std::printf("%s:%s: %d channels the same, %.2g at most; %d known to differ do\n", name, options, same,
                worst_same, different);
    EXPECT_GE(same, 20);
    if (known != for_bfr) {  // Bfr so seldom that findings.json has to do
      EXPECT_GE(different, 1);
    }
  }
}

}  // namespace
}  // namespace limitcheck::verify
