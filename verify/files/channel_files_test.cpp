// SPDX-License-Identifier: MIT
// Texture coordinates of finished files. Right ones come from the certified evaluator, step by step on the uncut mesh.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "data/generators/channel_meshes.h"
#include "data/generators/random_mesh.h"
#include "data/test_support/assertions.h"
#include "reference/surface/channel.h"
#include "verify/files/test_files.h"

namespace limitcheck::verify {
namespace {

using namespace test;
using data::ChannelRule, data::ControlMesh;

// The file of the limit surface with the channel by a rule, its own value at each corner of a triangle.
FileTessellation textured(const ControlMesh& mesh, data::Scheme scheme, ChannelRule rule, int depth = 1) {
  const reference::ChannelEvaluator channel(mesh, mesh.channels.at(0), rule, scheme,
                                            reference::ChannelEvaluator::Method::kSteps);
  std::map<std::array<std::size_t, 4>, std::array<double, 2>> known;
  const auto value = [&](std::size_t f, std::size_t corner, int steps, const std::array<int, 2>& at) {
    auto [found, is_new] = known.try_emplace({f, corner, std::size_t(at[0]), std::size_t(at[1])});
    if (!is_new) return found->second;
    const auto p = channel.evaluate(static_cast<int>(f), static_cast<int>(corner),
                                    reference::Parameter::fraction(at[0], steps),
                                    reference::Parameter::fraction(at[1], steps), 12)[0];
    return found->second = {std::stof(p.position[0].value), std::stof(p.position[1].value)};
  };
  return sharp_file(mesh, scheme, depth, [&](FileTessellation& t, const CornersAt& corners) {
    auto& which = t.corner_texture.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      which[c] = static_cast<std::int32_t>(t.texture.size());
      t.texture.push_back(value(corners.face, corners.corner, corners.steps, corners.at[c]));
    }
  });
}

struct Case {
  const char* name;
  ControlMesh mesh;
  data::Scheme scheme;
};
std::vector<Case> cases() {
  return {{"globe", data::globe(8, 4), data::Scheme::kCatmullClark},
          {"torus", data::torus_in_a_chart(6, 4), data::Scheme::kCatmullClark},
          {"random", data::with_random_channel(data::random_mesh(3, {.faces = 40}), 3), data::Scheme::kLoop}};
}

TEST(ChannelFiles, RightTextureCoordinatesHoldByEveryRule) {
  for (auto& [name, mesh, scheme] : cases())
    for (const ChannelRule rule :
         {ChannelRule::kNone, ChannelRule::kCornersPlus1, ChannelRule::kBoundaries, ChannelRule::kAll}) {
      mesh.channels[0].rule = rule;
      const Result r = row(audit(mesh, textured(mesh, scheme, rule), {.scheme = scheme}), "file-channel");
      EXPECT_EQ(r.status, Status::kHeld)
          << name << " " << r.bad << " of " << r.of << ": " << r.worst.value_or(-1) << " " << r.message;
      EXPECT_GT(r.of, 100);
    }
}

TEST(ChannelFiles, AnotherRuleIsRecognised) {
  for (auto& [name, mesh, scheme] : cases()) {
    mesh.channels[0].rule = ChannelRule::kNone;
    const Result r =
        row(audit(mesh, textured(mesh, scheme, ChannelRule::kAll), {.scheme = scheme}), "file-channel");
    EXPECT_EQ(r.status, Status::kFinding) << name;
    EXPECT_TRUE(says(r.message, "the values are those of ")) << name << ": " << r.message;
    EXPECT_TRUE(says(r.message, "all, where none was asked for")) << name << ": " << r.message;
    EXPECT_GT(*r.worst, 1e-3) << name;
  }
}

// One corner of one triangle beside a seam has the value of the other side; another one is not finite; a third has none.
TEST(ChannelFiles, WhatIsWrongAtOneCornerIsSeen) {
  ControlMesh mesh = data::torus_in_a_chart(6, 4);
  mesh.channels[0].rule = ChannelRule::kNone;
  const FileTessellation right = textured(mesh, data::Scheme::kCatmullClark, ChannelRule::kNone);
  const auto judged = [&](const auto& spoil, const char* check = "file-channel") {
    FileTessellation t = right;
    spoil(t);
    return row(audit(mesh, t, {.scheme = data::Scheme::kCatmullClark}), check);
  };
  const Result seam = judged([](FileTessellation& t) {
    t.texture[static_cast<std::size_t>(t.corner_texture[0][0])] = {1, 0};
  });
  EXPECT_EQ(seam.bad, 1);
  EXPECT_EQ(seam.witness->face, 0);
  EXPECT_EQ(seam.witness->got, (std::vector<double>{1, 0}));
  EXPECT_EQ(seam.message, "");  // other rules explain no more than this one
  EXPECT_EQ(judged([](FileTessellation& t) { t.texture[7][1] = NAN; }, "file-finite").bad, 1);
  const Result without = judged([](FileTessellation& t) { t.corner_texture[5][1] = -1; });
  EXPECT_EQ(without.bad, 1);
  EXPECT_EQ(without.message, "1 corners of triangles have no texture coordinates");
  EXPECT_EQ(judged([](FileTessellation& t) { t.texture[9][0] += 1e-3; }).bad, 1);
  EXPECT_EQ(judged([](FileTessellation& t) { t.corner_texture.clear(); }).status, Status::kNotSupported);
}

TEST(ChannelFiles, OfAMeshWithoutAChannelHaveNoRow) {
  ControlMesh mesh = data::torus_in_a_chart(6, 4);
  const FileTessellation t = textured(mesh, data::Scheme::kCatmullClark, ChannelRule::kNone);
  mesh.channels.clear();
  EXPECT_THROW(row(audit(mesh, t), "file-channel"), std::out_of_range);
}

// glTF counts the second coordinate from the top.
TEST(ChannelFiles, OfGltfAreTurnedOver) {
  ControlMesh mesh = data::torus_in_a_chart(6, 4);
  FileTessellation t = textured(mesh, data::Scheme::kCatmullClark, data::kUsualChannelRule);
  t.name = "torus.glb";
  EXPECT_EQ(row(audit(mesh, t), "file-channel").status, Status::kFinding);
  for (auto& uv : t.texture) uv[1] = 1 - uv[1];
  EXPECT_EQ(row(audit(mesh, t), "file-channel").status, Status::kHeld);
}

}  // namespace
}  // namespace limitcheck::verify
