// SPDX-License-Identifier: MIT
// OpenSubdiv's tessellation shaders: each vertex lies where Far evaluates the same patches, and on regular meshes where
// the reference's surface does; and what the hardware's triangles are.
#include <gtest/gtest.h>

#include <opensubdiv/far/primvarRefiner.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "data/bounding_box.h"
#include "data/generators/named_mesh.h"
#include "reference/surface/surface.h"
#include "verify/evidence/vector.h"
#include "verify/host/host.h"
#include "verify/peers/opensubdiv_patches.h"
#include "verify/row/bounds.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using Point = std::array<double, 3>;

// Without OpenGL none of the tests looks at anything.
class TessellationShaders : public testing::Test {
 protected:
  void SetUp() override {
    const lc_subject* const subject = find_subject("opensubdiv-gl");
    if (subject == nullptr) GTEST_SKIP() << "this machine has no libraries of OpenGL";
    try {
      (void)capabilities(*subject, "path=tess");
    } catch (const SubjectError& error) {  // the libraries are there, and no driver
      GTEST_SKIP() << error.what();
    }
  }
  static Session session(const data::ControlMesh& mesh, const std::string& options,
                         std::optional<data::Scheme> scheme = {}) {
    return {*find_subject("opensubdiv-gl"), mesh, "path=tess" + options, Session::Input::kValid, scheme};
  }
};

// The patches that the subject makes of the mesh, evaluated by Far.
class FarPatches {
 public:
  FarPatches(const data::ControlMesh& mesh, data::Scheme scheme, Options options)
      : lent_(mesh, scheme), patches_(lent_.lend(), boundary_rule(lent_.lend()), patch_options(options)) {
    const auto& refiner = *patches_.refiner;
    points_ = opensubdiv_points<float>(lent_.lend());
    const auto refined = static_cast<std::size_t>(refiner.GetNumVerticesTotal());
    points_.resize(refined + static_cast<std::size_t>(patches_.table->GetNumLocalPoints()));
    auto* from = points_.data();
    for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
      auto* const to = from + refiner.GetLevel(level - 1).GetNumVertices();
      OpenSubdiv::Far::PrimvarRefinerReal<float>(refiner).Interpolate(level, from, to);
      from = to;
    }
    if (points_.size() > refined)
      patches_.table->GetLocalPointStencilTable()->UpdateValues(points_.data(), points_.data() + refined);
  }
  Point at(const Place& p) const {
    const double uv[2] = {p.i / static_cast<double>(p.denominator), p.j / static_cast<double>(p.denominator)};
    const auto& patch = patches_.patch(p.face, p.corner, uv);
    std::array<double, 20> weights{}, du{}, dv{};
    patches_.table->EvaluateBasis(patch, uv[0], uv[1], weights.data(), du.data(), dv.data());
    Point sum{};
    const auto control = patches_.table->GetPatchVertices(patch);
    for (int k = 0; k < control.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += weights[static_cast<std::size_t>(k)] *
                  static_cast<double>(points_[static_cast<std::size_t>(control[k])].x[c]);
    return sum;
  }

 private:
  LentMesh lent_;
  const OpenSubdivPatches patches_;
  std::vector<OpenSubdivVector<float>> points_;
};

double bound(const data::ControlMesh& mesh, int depth) {
  double most = 0;
  for (const auto& p : mesh.positions)
    for (const double x : p) most = std::max(most, std::abs(x));
  return data::box_diagonal(mesh) * position_bound(LC_FLOAT32, depth, most, data::box_diagonal(mesh));
}

// All kinds of patches: regular ones and end caps of both kinds, turned triangles, quads of other faces, boundaries,
// sharp edges, and transitions between levels; more of them than are drawn at a time.
TEST_F(TessellationShaders, DeliverWhatFarEvaluatesOnTheSamePatches) {
  const std::map<data::Scheme, std::vector<const char*>> meshes{
      {data::Scheme::kLoop,
       {"octahedron", "cube", "torus", "wheel:7", "sheet", "fan:4", "random:1", "sharp:1"}},
      {data::Scheme::kCatmullClark,
       {"quad-cube", "quad-torus", "pawn", "quad-wheel:5", "quad-fan:3", "creased-cube", "mixed:1", "cube"}}};
  std::int64_t looked = 0;
  double worst = 0;
  for (const auto& [scheme, names] : meshes)
    for (const std::string name : names)
      // Where end caps of Loop's are B-splines, patches do not meet: which of them Far takes matters.
      for (const std::string options :
           {"", ",level=3,evaluator=xfb",
            scheme == data::Scheme::kLoop ? ",level=1" : ",level=1,end-cap=bspline"})
        for (const int depth : {0, 2}) {
          SCOPED_TRACE(name + options + " at depth " + std::to_string(depth));
          Session its = session(data::named_mesh(name), options, scheme);
          const Tessellation t = its.tessellate(depth);
          ASSERT_TRUE(t.defects().empty());
          Options of_patches(("path=tess" + options).c_str());
          const FarPatches far(its.mesh(), scheme, of_patches);
          const double most = bound(its.mesh(), std::max(depth, 4));
          std::int64_t wrong = 0;
          for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
            const double error = norm(t.position(v) - far.at(t.place(v)));
            worst = std::max(worst, error / most);
            wrong += !(error <= most);
          }
          EXPECT_EQ(wrong, 0) << "of " << t.vertex_count();
          looked += t.vertex_count();
        }
  std::printf("%lld vertices, worst %.2g of the bound\n", static_cast<long long>(looked), worst);
  EXPECT_GT(looked, 400'000);
}

// By themselves, not as the library names them: positions and normals on meshes whose vertices are all regular.
TEST_F(TessellationShaders, DeliverTheSurfaceOnRegularMeshes) {
  for (const std::string name : {"torus", "quad-torus"}) {
    SCOPED_TRACE(name);
    Session its = session(data::named_mesh(name), "");
    const reference::Surface surface(its.mesh(), its.scheme());
    constexpr int kDepth = 3;
    const Tessellation t = its.tessellate(kDepth);
    std::int64_t wrong = 0;
    for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
      const Place p = t.place(v);
      const auto exact = surface.evaluate(p.face, p.corner, p.i / static_cast<double>(p.denominator),
                                          p.j / static_cast<double>(p.denominator), reference::Order::kFirst);
      wrong += !(norm(t.position(v) - vector_of(exact.position)) <= bound(its.mesh(), kDepth)) ||
               !(angle_degrees(t.normal(v), vector_of(exact.normal)) <= normal_bound(LC_FLOAT32, kDepth));
    }
    EXPECT_EQ(wrong, 0) << "of " << t.vertex_count();
  }
}

// OpenGL cuts a triangle into rings of n, n - 2, n - 4 .. steps: 6 (n / 2)^2 triangles, where halving makes n^2, and
// vertices of which most are no lattice points. Quads are a lattice.
TEST_F(TessellationShaders, AreNoLatticeOnTriangles) {
  for (const int depth : {1, 2, 3, 4}) {
    SCOPED_TRACE(depth);
    const std::int64_t n = std::int64_t{1} << depth, faces = 144;
    const Tessellation t = session(data::named_mesh("torus"), "").tessellate(depth);
    EXPECT_EQ(t.triangle_count(), faces * 6 * (n / 2) * (n / 2));
    std::set<std::tuple<std::uint32_t, std::uint32_t>> all, on;
    for (std::int64_t v = 0; v < t.vertex_count(); ++v)
      if (const Place p = t.place(v); p.face == 0) {
        all.insert({p.i, p.j});
        if (p.i % (p.denominator / n) == 0 && p.j % (p.denominator / n) == 0) on.insert({p.i, p.j});
      }
    std::printf("%lld steps: %zu of %zu points on the lattice\n", static_cast<long long>(n), on.size(),
                all.size());
    EXPECT_EQ(std::ssize(all), 1 + 3 * (n / 2) * (n / 2 + 1));
    const Tessellation quads = session(data::named_mesh("quad-torus"), "").tessellate(depth);
    EXPECT_EQ(quads.triangle_count(), 72 * 2 * n * n);
    if (depth == 4) {
      EXPECT_EQ(on.size(), 90U);
    }
  }
}

}  // namespace
}  // namespace limitcheck::verify
