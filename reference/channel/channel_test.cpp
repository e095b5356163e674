// SPDX-License-Identifier: MIT
// Channels by two methods: cut along the seams, and step by step on the whole mesh. [known_answers_channels.json]
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/error.h"
#include "data/shapes.h"
#include "data/splitmix64.h"
#include "reference/channel/channel_mesh.h"
#include "reference/channel/channel_step.h"
#include "reference/number/number_exact.h"
#include "reference/point/parameter_exact.h"
#include "reference/surface/channel.h"

namespace limitcheck::reference {
namespace {

using data::Channel, data::ChannelRule, data::ControlMesh;
using Method = ChannelEvaluator::Method;

const nlohmann::json& answers() {
  static const auto all =
      nlohmann::json::parse(std::ifstream(LIMITCHECK_SOURCE_DIR "/data/known_answers_channels.json"))
          .at("cases");
  return all;
}

ChannelRule rule_named(const std::string& name) {
  return static_cast<ChannelRule>(
      std::find(std::begin(data::kChannelRules), std::end(data::kChannelRules), name) -
      std::begin(data::kChannelRules));
}
double number(const nlohmann::json& text) {
  return Parameter::parse(text.get<std::string>()).as_double();
}

ControlMesh sheet() {
  ControlMesh mesh;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) mesh.positions.push_back({double(i), double(j), 0});
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      mesh.faces.push_back({5 * j + i, 5 * j + i + 1, 5 * j + i + 6, 5 * j + i + 5});
  return mesh;
}

ControlMesh mesh_of(const nlohmann::json& answer) {
  ControlMesh mesh = sheet();
  for (const auto& crease : answer.at("creases"))
    mesh.sharpness.edges.push_back(
        {crease["edge"][0], crease["edge"][1], static_cast<float>(number(crease["sharpness"]))});
  if (answer.at("boundary") == "edge+corner") mesh.sharpness.boundary = data::Boundary::kEdgeAndCorner;
  Channel uv{.name = "uv", .corners = answer.at("indices").get<std::vector<std::int32_t>>()};
  for (const auto& value : answer.at("values"))
    for (const auto& x : value) uv.values.push_back(number(x));
  mesh.channels.push_back(uv);
  return mesh;
}

// |a - b| <= 10^-39 max(1, |b|).
void expect_near(const std::string& decimals, const nlohmann::json& exact, const std::string& what) {
  const Rational a = exact_value(Parameter::parse(decimals)),
                 b = exact_value(Parameter::parse(exact.get<std::string>()));
  Rational off = a - b, size = b;
  if (off < 0) off = -off;
  if (size < 1) size = size < -1 ? Rational(-size) : Rational(1);
  const Rational bound = Rational(1) / Rational(Integer("1" + std::string(39, '0')));
  EXPECT_TRUE(off <= bound * size) << what << ": " << decimals << " for " << exact;
}

class KnownChannels : public testing::TestWithParam<std::size_t> {};

TEST_P(KnownChannels, HaveTheirLimitsByBothMethods) {
  const nlohmann::json& answer = answers().at(GetParam());
  const ControlMesh mesh = mesh_of(answer);
  for (const Method method : {Method::kCut, Method::kSteps}) {
    const ChannelEvaluator channel(mesh, mesh.channels[0], rule_named(answer.at("rule")),
                                   data::Scheme::kCatmullClark, method);
    for (const auto& limit : answer.at("limits")) {
      const auto points =
          channel.evaluate(limit["face"], 0, Parameter::parse(limit["uv"][0].get<std::string>()),
                           Parameter::parse(limit["uv"][1].get<std::string>()), 42);
      ASSERT_EQ(points.size(), 1U);
      const std::string what = answer.at("id").get<std::string>() + " " + limit.dump();
      for (std::size_t k = 0; k < 2; ++k) {
        expect_near(points[0].position[k].value, limit["limit"][k], what);
        if (!limit.contains("d_du") || limit["d_du"].is_null()) continue;
        EXPECT_TRUE(points[0].first_exist) << what;
        expect_near(points[0].d1[k].value, limit["d_du"][k], what + " d/du");
        expect_near(points[0].d2[k].value, limit["d_dv"][k], what + " d/dv");
      }
    }
  }
}

TEST_P(KnownChannels, HaveTheStatesOfTheirValues) {
  const std::map<std::string, ValueState> words{{"held", ValueState::kHeld},
                                                {"crease", ValueState::kCrease},
                                                {"semi", ValueState::kSemiSharp},
                                                {"dep", ValueState::kDependent}};
  const nlohmann::json& answer = answers().at(GetParam());
  const ControlMesh mesh = mesh_of(answer);
  const ChannelTopology channel(Topology(mesh.positions.size(), mesh.faces), mesh.sharpness,
                                mesh.channels[0].corners, rule_named(answer.at("rule")));
  for (const auto& [vertex, states] : answer.at("states").items())
    for (const auto& [index, state] : states.items()) {
      int corners = 0;
      for (std::size_t c = 0; c < channel.states.size(); ++c)
        if (std::to_string(mesh.faces.corners()[c]) == vertex &&
            std::to_string(mesh.channels[0].corners[c]) == index) {
          EXPECT_EQ(channel.states[c], words.at(state)) << answer.at("id") << " vertex " << vertex;
          ++corners;
        }
      EXPECT_GT(corners, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Answers, KnownChannels, testing::Range(std::size_t{0}, answers().size()),
                         [](const auto& answer) {
                           return answers().at(answer.param).at("id").template get<std::string>();
                         });

}  // namespace
}  // namespace limitcheck::reference
