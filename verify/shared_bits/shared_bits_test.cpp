// SPDX-License-Identifier: MIT
// Claim D14 for row streaming, in numbers: how many shared points were compared, and how many bits differ.
// Meshes at the ends of the float range, far from the origin, flat, or fallen together.
#include <gtest/gtest.h>

#include <fmt/core.h>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/generators/random_mesh.h"
#include "fast/stream/kernel/targets.h"
#include "fast/stream/stream_tessellator.h"
#include "verify/audit/audit.h"
#include "verify/shared_bits/test_support/shared_bits.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using fast::row_stream::Kernel;
using fast::row_stream::kernels;

// What a test compared, printed and recorded at its end.
class Tally {
 public:
  ~Tally() {
    fmt::print("{} shared points, {} comparisons, {} points and {} bits differ\n", points_, compared_,
               different_, bits_);
    testing::Test::RecordProperty("shared_points", std::to_string(points_));
    testing::Test::RecordProperty("comparisons", std::to_string(compared_));
    testing::Test::RecordProperty("different_bits", std::to_string(bits_));
  }
  void add(const SharedBits& bits, const std::string& name) {
    EXPECT_EQ(bits.different_bits(), 0) << name << ": " << bits.witness();
    points_ += bits.points();
    compared_ += bits.compared();
    different_ += bits.different();
    bits_ += bits.different_bits();
  }
  std::int64_t points() const { return points_; }

 private:
  std::int64_t points_ = 0, compared_ = 0, different_ = 0, bits_ = 0;
};

// Flat in the plane across an axis, on a grid, symmetric: tangents with components that are exactly zero.
data::ControlMesh flat_sheet(std::size_t across, int size) {
  data::ControlMesh mesh = data::named_mesh(fmt::format("sheet:{0}:{0}", size));
  for (auto& p : mesh.positions) {
    const std::array<double, 3> grid{std::round(p[0] * size) / size, std::round(p[1] * size) / size, 0};
    for (std::size_t c = 0; c < 3; ++c) p[(c + across + 1) % 3] = grid[c];
  }
  return mesh;
}

// Those with hardware fused multiply-add, or the only ones there are.
std::vector<const Kernel*> quick_kernels() {
  std::vector<const Kernel*> list;
  for (const Kernel& kernel : kernels())
    if (kernel.fused) list.push_back(&kernel);
  if (list.empty()) list.push_back(&kernels().front());
  return list;
}

// The volume: each of ten million points from every face that touches it, twice over, on two targets, in two
// numberings, in two pairings, and along its edge in both directions.
TEST(SharedBits, AreEqualAtTenMillionPoints) {
  struct Case {
    const char* mesh;
    int depth;
  };
  Tally tally;
  const auto quick = quick_kernels();
  std::size_t turn = 0;
  for (const Case& c :
       {Case{"bumpy:100000", 4}, Case{"bumpy:20000", 6}, Case{"bumpy:20000:2", 5}, Case{"bumpy:4000", 7},
        Case{"bumpy:4000:3", 8}, Case{"bumpy:2000", 9}, Case{"bumpy:800", 10}}) {
    const auto mesh = data::named_mesh(c.mesh);
    SharedBits bits(mesh, c.depth);
    const Kernel& first = *quick[turn++ % quick.size()];
    const Kernel& second = *quick[turn % quick.size()];
    add_pairs(rewrite(mesh, 0), c.depth, first, Form::kRows, turn, bits);
    const Rewriting other = rewrite(mesh, turn);
    add_pairs(other, c.depth, second, Form::kRows, turn + 100, bits);
    add_edges(other, c.depth, first, turn, bits);
    tally.add(bits, fmt::format("{} depth {}", c.mesh, c.depth));
  }
  EXPECT_GE(tally.points(), 10'000'000);
}

// Every stock shape at every depth on every target, in both output forms, each with a numbering and a pairing
// of its own.
void expect_equal_bits(const std::vector<std::pair<std::string, data::ControlMesh>>& meshes, int deepest) {
  Tally tally;
  for (const auto& [name, mesh] : meshes) {
    SharedBits bits(mesh, deepest);
    std::uint64_t seed = 0;
    for (int depth = 0; depth <= deepest; ++depth) {
      for (const Kernel& kernel : kernels()) {
        if (!kernel.fused && depth > 4 && mesh.faces.size() > 200) continue;
        const Rewriting other = rewrite(mesh, seed);
        add_pairs(other, depth, kernel, Form::kRows, ++seed, bits);
        if (depth <= 4) add_pairs(other, depth, kernel, Form::kWhole, ++seed, bits);
        add_edges(other, depth, kernel, ++seed, bits);
      }
    }
    tally.add(bits, name);
  }
}

TEST(SharedBits, AreEqualOnEveryStockShape) {
  std::vector<std::pair<std::string, data::ControlMesh>> meshes;
  for (const std::string& name : data::stock_shapes())
    meshes.emplace_back(name, rounded(data::named_mesh(name)));
  expect_equal_bits(meshes, 5);
}

// Signed zeros: where the tangents of one face are those of the other with the sign turned, a zero component
// is +0 for both, and the products of the two differ in the sign of a zero.
TEST(SharedBits, AreEqualOnFlatMeshesInEveryPlane) {
  std::vector<std::pair<std::string, data::ControlMesh>> meshes;
  for (std::size_t across = 0; across < 3; ++across) {
    data::ControlMesh mesh = flat_sheet(across, 4);
    meshes.emplace_back(fmt::format("flat {}", across), mesh);
    for (auto& p : mesh.positions)
      for (double& x : p) x = -x;
    meshes.emplace_back(fmt::format("flat, negative zeros {}", across), mesh);
  }
  expect_equal_bits(meshes, 5);
}

// Frames of the subject: unequal depths, culled faces, fans, stitched rings, indexed meshes, threads and
// targets. The points of an edge must be those that the edge has by itself at its own depth.
TEST(SharedBits, AreEqualAcrossEdgesOfUnequalDepthsForAnyNumberOfThreads) {
  Tally tally;
  for (const char* name :
       {"bumpy:200", "torus", "wheel:12", "holes", "ragged-disc", "random:5", "random:14"}) {
    const auto mesh = rounded(data::named_mesh(name));
    SharedBits bits(mesh, 6);
    for (int depth = 0; depth <= 6; ++depth) add_edges(rewrite(mesh, 0), depth, kernels().front(), 1, bits);
    std::uint64_t seed = 0;
    for (const Kernel& kernel : kernels()) {
      for (const int threads : {1, 2, 5}) {
        if (!kernel.fused && threads == 5) continue;
        for (const char* form :
             {"output=strips,repair=fan", "output=strips,repair=stitch", "output=indexed"}) {
          const auto depth = random_depths(mesh.faces.size(), -1, kernel.fused ? 6 : 4, ++seed);
          add_frame(rewrite(mesh, seed), depth, fmt::format("{},target={}", form, kernel.name), threads,
                    bits);
        }
      }
    }
    tally.add(bits, name);
  }
}

// Planted faults: the table sees one bit in any of the six numbers, at any place and depth, and the sign of a
// zero.
TEST(SharedBits, OneBitIsSeenWhereverItIs) {
  const auto mesh = data::named_mesh("ragged-disc");
  std::int64_t planted = 0;
  for (const std::uint32_t flip : {1u, 1u << 31}) {
    for (int number = 0; number < 6; ++number) {
      for (const auto& at : {Place{4, 0, 0, 8}, {4, 8, 0, 8}, {4, 5, 0, 8}, {4, 1, 7, 8}, {4, 0, 4, 8}}) {
        SharedBits bits(mesh, 3);
        std::array<float, 6> vertex{};
        bits.add(at, vertex.data());
        bits.add(at, vertex.data());
        EXPECT_EQ(bits.different(), 0);
        std::uint32_t word = std::bit_cast<std::uint32_t>(vertex[number]) ^ flip;
        vertex[number] = std::bit_cast<float>(word);
        bits.add(at, vertex.data());
        EXPECT_EQ(bits.different(), 1);
        EXPECT_EQ(bits.different_bits(), 1);
        EXPECT_EQ(bits.points(), 1);
        ++planted;
      }
    }
  }
  EXPECT_EQ(planted, 60);
}

// And knows a point from both of its faces: the last place of a coordinate of the mesh is changed for one of
// two evaluations.
TEST(SharedBits, AMovedVertexIsSeenByItsNeighbourhoodOnly) {
  const auto mesh = rounded(data::named_mesh("torus"));
  auto moved = mesh;
  moved.positions[7][1] = static_cast<double>(std::nextafter(static_cast<float>(moved.positions[7][1]), 9.f));
  SharedBits bits(mesh, 4);
  const Kernel& kernel = kernels().front();
  add_pairs(rewrite(mesh, 0), 4, kernel, Form::kRows, 1, bits);
  const std::int64_t compared = bits.compared();
  EXPECT_EQ(bits.different(), 0);
  add_pairs(rewrite(moved, 3), 4, kernel, Form::kRows, 2, bits);
  EXPECT_GT(bits.different(), 0);
  EXPECT_LT(bits.different(), (bits.compared() - compared) / 2);
}

// Each coordinate through `place`, rounded to float.
template <class Place>
data::ControlMesh placed(data::ControlMesh mesh, Place&& place) {
  for (auto& p : mesh.positions)
    for (double& x : p) x = static_cast<double>(static_cast<float>(place(x)));
  return mesh;
}

int expect_no_findings(Auditor& auditor, const AuditSubject& subject, const AuditMesh& mesh) {
  int held = 0;
  for (const Result& r : auditor.run(subject, mesh)) {
    EXPECT_FALSE(is_bad(r)) << subject.options << " " << r.mesh << " depth " << r.depth << " " << r.check
                            << " " << r.message;
    held += r.status == Status::kHeld;
  }
  return held;
}

TEST(RowStreamAudit, HasNoFindingsOnAnyTarget) {
  int held = 0;
  for (const int depth : {0, 3, 5}) {
    Auditor auditor(depth, 1);
    for (const char* name : {"tetrahedron", "bipyramid:7", "wheel:5", "fan:3", "ragged-disc", "triangle"}) {
      for (const auto& kernel : kernels())
        held += expect_no_findings(auditor, {lc_subject_row_stream(), fmt::format("target={}", kernel.name)},
                                   {name, data::named_mesh(name)});
    }
  }
  RecordProperty("held", held);
}

TEST(RowStreamAudit, HasNoFindingsAtAnyScaleNorFarFromTheOrigin) {
  int held = 0;
  for (const int depth : {1, 3, 5}) {
    Auditor auditor(depth, 1);
    for (const char* name : {"tetrahedron", "bumpy:20", "sheet:3:3", "fan:5", "wheel:12:2"}) {
      const auto mesh = data::named_mesh(name);
      for (const double scale : {1e-6, 1e6, 1e-30, 1e30}) {
        const AuditMesh scaled{fmt::format("{} times {}", name, scale),
                               placed(mesh, [&](double x) { return x * scale; })};
        held += expect_no_findings(auditor, {lc_subject_row_stream(), ""}, scaled);
      }
      // The stock shapes have size 2 to 3.
      const AuditMesh shifted{fmt::format("{} shifted", name),
                              placed(mesh, [](double x) { return x + 3000; })};
      held += expect_no_findings(auditor, {lc_subject_row_stream(), ""}, shifted);
    }
  }
  RecordProperty("held", held);
}

// A part of a ten-millionth of the mesh's size keeps its normals. The kernel's remedy against zero normals
// shows below that: at depth 1 they lean by 4e-3 degrees at 1e-8 of the size and by 0.4 at 1e-9 (measured),
// at depth d by 16^(d-1) times less.
TEST(RowStreamAudit, HasNoFindingsOnAPartOfATenMillionthOfTheMesh) {
  data::ControlMesh mesh = data::named_mesh("tetrahedron");
  const data::ControlMesh part = data::named_mesh("icosahedron");
  const auto before = static_cast<std::int32_t>(mesh.positions.size());
  for (const auto& p : placed(part, [](double x) { return 1e-7 * x; }).positions) mesh.positions.push_back(p);
  for (const auto& t : triangles_of(part))
    mesh.faces.push_back({t[0] + before, t[1] + before, t[2] + before});
  for (const int depth : {1, 4}) {
    Auditor auditor(depth, 1);
    expect_no_findings(auditor, {lc_subject_row_stream(), ""}, {"part", mesh});
  }
}

// No normal anywhere: every vertex in one point, or all on a line through it. The tangents are zero, or
// parallel with exact products. [claim D12]
std::vector<std::pair<std::string, data::ControlMesh>> collapsed() {
  std::vector<std::pair<std::string, data::ControlMesh>> list;
  for (const char* name : {"icosahedron", "wheel:5", "fan:4", "ragged-disc", "triangle"}) {
    for (const auto& along : {std::array<double, 3>{0, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {1, 2, -3}}) {
      data::ControlMesh mesh = data::named_mesh(name);
      for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const auto step = static_cast<double>(v * 7 % 16);
        mesh.positions[v] = {1 + step * along[0], 2 + step * along[1], 3 + step * along[2]};
      }
      list.emplace_back(fmt::format("{} along {} {} {}", name, along[0], along[1], along[2]), mesh);
    }
  }
  return list;
}

TEST(RowStreamDegenerate, NormalsAreUnitVectorsWhereTheSurfaceHasNoneAndTheVerticesAreCounted) {
  for (const auto& [name, mesh] : collapsed()) {
    for (int depth = 0; depth <= 6; ++depth) {
      for (const auto& kernel : kernels()) {
        if (!kernel.fused && depth > 4) continue;
        fast::row_stream::StreamTessellator tessellator(mesh, {}, kernel);
        fast::DrawList<float> out;
        const auto stats = tessellator.frame(std::vector<std::int32_t>(mesh.faces.size(), depth), out);
        EXPECT_EQ(stats.zero_normals, static_cast<std::int64_t>(mesh.positions.size())) << name;
        for (const auto& v : out.vertices) {
          ASSERT_TRUE(std::isfinite(v.position.x + v.position.y + v.position.z))
              << name << " depth " << depth;
          ASSERT_NEAR(std::hypot(v.normal.x, v.normal.y, v.normal.z), 1, 1e-6)
              << name << " depth " << depth << " " << kernel.name << ": " << v.normal.x << " " << v.normal.y
              << " " << v.normal.z;
        }
      }
    }
  }
}

TEST(RowStreamDegenerate, SharedPointsHaveEqualBitsAllTheSame) {
  std::int64_t compared = 0;
  for (const auto& [name, mesh] : collapsed()) {
    SharedBits bits(mesh, 6);
    std::uint64_t seed = 0;
    for (int depth = 0; depth <= 6; ++depth) {
      for (const auto& kernel : kernels()) {
        if (!kernel.fused && depth > 4) continue;
        add_pairs(rewrite(mesh, seed), depth, kernel, Form::kRows, seed + 1, bits);
        add_edges(rewrite(mesh, seed), depth, kernel, seed + 2, bits);
        ++seed;
      }
    }
    EXPECT_EQ(bits.different_bits(), 0) << name << ": " << bits.witness();
    compared += bits.compared();
  }
  RecordProperty("comparisons", std::to_string(compared));
}

}  // namespace
}  // namespace limitcheck::verify
