// SPDX-License-Identifier: MIT
// Rows of channels: what is named, what is left out, what they are judged on.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/test_support/assertions.h"
#include "reference/surface/channel.h"
#include "verify/audit/audit.h"
#include "verify/audit/default_plan.h"
#include "verify/audit/shrink.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/row/commands.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

AuditSubject naive() {
  return {find_subject("naive"), ""};
}
AuditSubject with_fault(const std::string& fault) {
  return {find_subject("faulty"), faulty_options(fault, "naive")};
}
std::vector<Result> audited(const AuditSubject& subject, const AuditMesh& mesh, Level level = Level::kQuick) {
  return Auditor(2, 1, {}, level).run(subject, mesh);
}
Result row_of(const AuditSubject& subject, const AuditMesh& mesh, const std::string& check,
              Level level = Level::kQuick) {
  for (Result& r : audited(subject, mesh, level))
    if (r.check == check) return r;
  ADD_FAILURE() << "no row " << check;
  return {};
}
AuditMesh mesh_named(const std::string& name) {
  return {name, data::named_mesh(name)};
}

TEST(ChannelRows, NameWhatCameInPlaceOfTheChannel) {
  const char* const in_a_chart = "uv-torus";
  for (const auto& [fault, mesh, words] :
       {std::tuple{"channel_always_all", "uv:1:quad-torus:8:6",
                   "the values are those of the rule all, where corners-plus1 was asked for"},
        {"channel_by_vertex", in_a_chart, "those of the surface's smooth rule across seams"},
        {"channel_swapped_components", in_a_chart, "right with two components exchanged"},
        {"channel_upside_down", in_a_chart,
         "the second component counted from the other end: 1 - v for v"}}) {
    const Result r = row_of(with_fault(fault), mesh_named(mesh), "channel-positions");
    EXPECT_EQ(r.status, Status::kFinding) << fault;
    EXPECT_TRUE(says(r.message, words)) << fault << ": " << r.message;
  }
}

TEST(ChannelRows, LeaveNumbersThatAreNotFiniteToTheRowThatIsAboutThem) {
  const AuditMesh mesh = mesh_named("uv-torus");
  const Result finite = row_of(with_fault("channel_nan"), mesh, "finite"),
               positions = row_of(with_fault("channel_nan"), mesh, "channel-positions");
  EXPECT_EQ(finite.bad, 1);
  ASSERT_TRUE(finite.witness);
  EXPECT_TRUE(says(eval_command(finite), "--channel uv"));
  EXPECT_TRUE(says(finite.message, "1 numbers of channels are NaN or infinite")) << finite.message;
  EXPECT_EQ(positions.status, Status::kHeld);
  EXPECT_EQ(positions.not_finite, 1);
  const Result written = row_of(with_fault("channel_unwritten"), mesh, "written");
  EXPECT_EQ(written.message, "1 numbers of channels unwritten");
}

TEST(ChannelRows, HaveACommandThatEvaluatesTheChannel) {
  const AuditMesh mesh = mesh_named("uv-torus");
  for (const char* check : {"channel-positions", "channel-derivatives"}) {
    const Result r = row_of(with_fault("channel_swapped_components"), mesh, check);
    ASSERT_TRUE(r.witness) << check;
    const std::string command = eval_command(r);
    EXPECT_TRUE(command.starts_with("limitcheck eval uv-torus ")) << command;
    EXPECT_TRUE(says(command, " --channel uv --channel-rule corners-plus1")) << command;
    EXPECT_EQ(r.witness->got.size(), check == std::string("channel-positions") ? 2U : 4U);
  }
}

// Right ones hold on every fourth of the plan's meshes, and on all where Chaikin's creasing goes across seams; derivatives
// stay below a tenth of their bound.
TEST(ChannelRows, OfRightSubjectsHoldOnThePlan) {
  int across_seams = 0, with_channel = 0, fell_in_the_cut = 0;
  double worst = 0;
  for (const AuditMesh& m : default_plan(Level::kStandard)) {
    if (m.mesh.channels.empty()) continue;
    ++with_channel;
    const bool across = m.mesh.sharpness.creasing == data::Creasing::kChaikin;
    across_seams += across;
    if (!across && with_channel % 4 != 0) continue;
    AuditMesh quick = m;
    quick.relations = false, quick.asked_again = false;
    if (across)
      for (const Result& r : audited(with_fault("channel_chaikin_in_the_cut"), quick))
        fell_in_the_cut += r.check == "channel-positions" && r.status == Status::kFinding;
    for (const Result& r : audited(naive(), quick)) {
      if (!r.check.starts_with("channel-")) continue;
      EXPECT_EQ(r.status, Status::kHeld) << m.name << " " << r.check << ": " << r.message;
      EXPECT_GT(r.of, 0) << m.name << " " << r.check;
      if (r.check == "channel-derivatives" && r.worst) worst = std::max(worst, *r.worst / *r.bound);
    }
  }
  EXPECT_GE(across_seams, 10);
  EXPECT_GE(fell_in_the_cut, 4);
  EXPECT_LE(worst, .1);
  RecordProperty("worst", fmt::format("{:.3g}", worst));
}

TEST(ChannelRows, OfASampleAreThoseOfItsFaces) {
  AuditMesh mesh = mesh_named("uv:2:bumpy:800");
  mesh.sample = std::make_shared<MeshSample>(mesh.mesh, 30, 1);
  const Result held = row_of(naive(), mesh, "channel-positions"),
               slopes = row_of(naive(), mesh, "channel-derivatives"),
               bad = row_of(with_fault("channel_linear_last_face"), mesh_named("uv:3:bumpy:60"),
                            "channel-positions");
  EXPECT_EQ(held.status, Status::kHeld) << held.message;
  EXPECT_GT(held.of, 30 * 16 * 3);
  EXPECT_EQ(slopes.status, Status::kHeld) << slopes.message;
  EXPECT_EQ(bad.status, Status::kFinding);
  const Result swapped = row_of(with_fault("channel_swapped_components"), mesh, "channel-positions");
  EXPECT_GT(swapped.bad * 100, swapped.of * 95);  // but where both components are equal
  ASSERT_TRUE(swapped.witness);
  EXPECT_GE(mesh.sample->part_of()[static_cast<std::size_t>(swapped.witness->face)], 0)
      << "a face of the whole";
}

// All components of all channels, in whatever order they are named.
TEST(ChannelRows, AreOfAllChannels) {
  const AuditMesh mesh = mesh_named("uvs:3:quad-torus:6:4");
  const Result r = row_of(naive(), mesh, "channel-positions");
  EXPECT_EQ(r.status, Status::kHeld) << r.message;
  const Result opaque = row_of(with_fault("channels_are_opaque"), mesh, "channel-positions");
  EXPECT_EQ(opaque.status, Status::kFinding);
  ASSERT_TRUE(opaque.witness);
  EXPECT_EQ(opaque.witness->channel, "colour");
}

TEST(ChannelRows, OfAShrunkMeshAreStillWrong) {
  const AuditMesh mesh = mesh_named("uv:5:quad-torus:8:6");
  const AuditSubject subject = with_fault("channel_linear_at_seams");
  const Result finding = row_of(subject, mesh, "channel-positions");
  ASSERT_EQ(finding.status, Status::kFinding);
  const ShrunkFinding small = shrink(subject, mesh, 1, finding, {.attempts = 400});
  ASSERT_TRUE(small.row);
  EXPECT_EQ(small.row->status, Status::kFinding);
  EXPECT_LT(small.small.mesh.mesh.faces.size(), mesh.mesh.faces.size() / 2);
  const data::ControlMesh& left = small.small.mesh.mesh;
  ASSERT_EQ(left.channels.size(), 1U);
  EXPECT_EQ(data::fault_of(left.channels[0], left), "");
  EXPECT_LE(left.channels[0].values.size() / 2, left.faces.corners().size());
  // What is wrong without a channel shrinks to a mesh without one.
  const AuditMesh torus = mesh_named("uv:5:torus");
  const AuditSubject swapped = with_fault("swapped_points");
  const Result points = row_of(swapped, torus, "positions");
  ASSERT_EQ(points.status, Status::kFinding) << points.message;
  EXPECT_TRUE(shrink(swapped, torus, 1, points, {.attempts = 400}).small.mesh.mesh.channels.empty());
}

}  // namespace
}  // namespace limitcheck::verify
