// SPDX-License-Identifier: MIT
// Channels by two methods: cut along the seams, and step by step on the whole mesh. [known_answers_channels.json]
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/error.h"
#include "data/generators/channel_meshes.h"
#include "data/generators/random_mesh.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/surgery.h"
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

// A chart for each quadrant of the sheet: A, B, .. of the faces left and right below, left and right above its centre. Up to
// row `joined` the charts share their values.
struct Quadrants {
  const char* charts;
  std::vector<data::SharpEdge> edges = {};
  float centre = 0;  // its sharpness
  int joined = -1;
};
// The states at the centre in the order of the quadrants: held, crease, semi-sharp, dependent, matches.
std::string states_of(const Quadrants& quadrants, ChannelRule rule) {
  ControlMesh mesh = sheet();
  mesh.sharpness.edges = quadrants.edges;
  if (quadrants.centre > 0) mesh.sharpness.vertices = {{12, quadrants.centre}};
  std::vector<std::int32_t> indices;
  for (int f = 0; f < 16; ++f)
    for (const std::int32_t v : mesh.faces[static_cast<std::size_t>(f)])
      indices.push_back(4 * v +
                        (v / 5 <= quadrants.joined ? 0 : quadrants.charts[(f / 8) * 2 + (f % 4) / 2] - 'A'));
  const ChannelTopology channel(Topology(25, mesh.faces), mesh.sharpness, indices, rule);
  std::string result;
  for (const std::int32_t face : {5, 6, 9, 10})
    result += "MHSDC"[static_cast<int>(channel.states[channel.corner(face, 12)])];
  return result;
}

TEST(Channels, HaveTheStatesOfTheTable) {
  const auto none = ChannelRule::kNone, only = ChannelRule::kCornersOnly, plus1 = ChannelRule::kCornersPlus1,
             plus2 = ChannelRule::kCornersPlus2, boundaries = ChannelRule::kBoundaries;
  EXPECT_EQ(states_of({"AAAA"}, plus2), "MMMM");
  EXPECT_EQ(states_of({"ABAB"}, none), "CCCC");
  EXPECT_EQ(states_of({"ABAB"}, plus2), "CCCC");
  EXPECT_EQ(states_of({"ABAB"}, boundaries), "HHHH");
  EXPECT_EQ(states_of({"ABAC"}, none), "CCCC");  // three values
  EXPECT_EQ(states_of({"ABAC"}, only), "CHCH");
  EXPECT_EQ(states_of({"ABAC"}, plus1), "HHHH");
  EXPECT_EQ(states_of({"ABCD"}, none), "CCCC");
  EXPECT_EQ(states_of({"AAAB"}, plus1), "CCCH");  // a concave corner
  EXPECT_EQ(states_of({"AAAB"}, plus2), "HHHH");
  EXPECT_EQ(states_of({"ABBA"}, none), "HHHH");            // parted
  EXPECT_EQ(states_of({"ABAB", {}, 0, 2}, none), "CCCC");  // the end of a seam
  EXPECT_EQ(states_of({"ABAB", {}, 0, 2}, plus1), "CCCC");
  EXPECT_EQ(states_of({"ABAB", {}, 0, 2}, plus2), "HHHH");
  EXPECT_EQ(states_of({"ABAB", {{11, 12, 10}}}, only), "HCHC");
  EXPECT_EQ(states_of({"ABAB", {{11, 12, 10}}}, plus1), "HHHH");
  EXPECT_EQ(states_of({"ABAB", {{11, 12, 1.5}}}, only), "SCSC");
  EXPECT_EQ(states_of({"ABAB", {{11, 12, 1.5}}}, plus1), "SDSD");
  EXPECT_EQ(states_of({"ABAB", {{11, 12, 1.5}}, 2}, plus1), "SDSD");  // more sharpness does not let go
  EXPECT_EQ(states_of({"ABAB", {{11, 12, 1.5}}, 2}, only), "SSSS");
  EXPECT_EQ(states_of({"ABAB", {{12, 17, 1.5}}}, plus1), "CCCC");  // along the seam it says nothing
  EXPECT_EQ(states_of({"ABAB", {}, 2}, none), "SSSS");
  EXPECT_EQ(states_of({"ABAB", {}, 10}, none), "HHHH");
}

// The values after some steps by the channel's rules, and those of the mesh that is cut along its seams, corner by
// corner: the same numbers. Loop's weights are irrational: there they differ by rounding.
template <class N>
void expect_same_nets(const ControlMesh& mesh, ChannelRule rule, data::Scheme scheme, int& compared) {
  const Channel& uv = mesh.channels.at(0);
  std::vector<Vec3<N>> values;
  for (std::size_t c = 0; c < uv.corners.size(); ++c)
    values.push_back({N(uv.at(c, 0)), N(uv.at(c, 1)), N(0)});
  ChannelMesh<N> rules(
      ChannelTopology(Topology(mesh.positions.size(), mesh.faces), mesh.sharpness, uv.corners, rule), values);
  const ChannelCut cut = cut_and_hold(rules, mesh.sharpness.triangles);
  std::vector<Vec3<N>> points;
  for (const std::size_t c : cut.corner_of) points.push_back(values[c]);
  Topology topology(points.size(), cut.faces);
  Sharpness sharpness(topology, cut.tags);
  TaggedMesh<N> plain{std::move(topology), std::move(points), std::move(sharpness)};
  for (int step = 1; step <= 2; ++step) {
    rules = refine_once(rules, scheme, mesh.sharpness.triangles);
    plain = scheme == data::Scheme::kLoop ? refine_once(plain, Weights::kLoop)
                                          : catmull_clark::refine_once(plain, mesh.sharpness.triangles);
    const auto corners = plain.topology.faces().corners();
    ASSERT_EQ(rules.values.size(), corners.size());
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const Vec3<N> off = rules.values[c] - plain.positions[static_cast<std::size_t>(corners[c])];
      ASSERT_LE(NumberTraits<N>::approximate(magnitude(off)), 1e2 * NumberTraits<N>::kRounding)
          << "step " << step << " corner " << c;
    }
  }
  ++compared;
}

TEST(RandomChannels, AreTheSameByTheirRulesAndByTheCut) {
  int compared = 0, chaikin = 0;
  for (std::uint64_t seed = 1; seed <= 2100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto rule = static_cast<ChannelRule>(seed % 5);  // `all` is no surface of the cut
    ControlMesh mesh =
        seed % 3 == 0 ? data::random_mesh(seed, {.faces = 12}) : data::mixed_mesh(seed, {.faces = 16});
    if (seed % 4 != 0) mesh = data::with_random_sharpness(std::move(mesh), seed);
    if (seed % 2 == 0) mesh.sharpness.creasing = data::Creasing::kUniform;
    mesh = data::with_random_channel(std::move(mesh), seed);
    expect_same_nets<Rational>(mesh, rule, data::Scheme::kCatmullClark, compared);
    if (mesh.faces.are_triangles()) expect_same_nets<Decimal50>(mesh, rule, data::Scheme::kLoop, compared);
    chaikin += mesh.sharpness.creasing == data::Creasing::kChaikin ? 1 : 0;
    if (HasFatalFailure()) return;
  }
  EXPECT_GE(compared, 2000);
  EXPECT_GE(chaikin, 200);
}

// Both methods of evaluation, with semi-sharp tags near: the steps end in another mesh than the cut.
// By Chaikin's creasing, too, where semi-sharp edges end on seams.
TEST(RandomChannels, HaveTheSameLimitsByBothMethodsAndInDouble) {
  std::size_t with_edges_beyond = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const bool loop = seed % 2 == 0;
    ControlMesh mesh = loop ? data::random_mesh(seed, {.faces = 30}) : data::mixed_mesh(seed, {.faces = 30});
    mesh = data::with_random_channel(data::with_random_sharpness(std::move(mesh), seed), seed);
    const data::Scheme scheme = loop ? data::Scheme::kLoop : data::Scheme::kCatmullClark;
    const ChannelEvaluator by_cut(mesh, mesh.channels[0], *mesh.channels[0].rule, scheme),
        by_steps(mesh, mesh.channels[0], *mesh.channels[0].rule, scheme, Method::kSteps);
    const ChannelSurface in_double(mesh, mesh.channels[0], *mesh.channels[0].rule, scheme);
    const ChannelTopology topology(Topology(mesh.positions.size(), mesh.faces), mesh.sharpness,
                                   mesh.channels[0].corners, *mesh.channels[0].rule);
    with_edges_beyond += !cut_and_hold(topology, mesh.sharpness.triangles).tags.beyond.empty();
    for (int f = 0; f < 8; ++f)
      for (const auto& at : {std::array{"1/3", "1/4"}, {"3/5", "3/10"}, {"0", "0"}, {"1/7", "6/7"}}) {
        const char *const u = at[0], *const v = at[1];
        const auto a = by_cut.evaluate(f, 0, Parameter::parse(u), Parameter::parse(v), 30)[0],
                   b = by_steps.evaluate(f, 0, Parameter::parse(u), Parameter::parse(v), 30)[0];
        const auto same = [&](const Enclosure3& x, const Enclosure3& y) {
          for (std::size_t k = 0; k < 2; ++k)
            EXPECT_NEAR(std::stod(x[k].value), std::stod(y[k].value),
                        1e-12 * (1 + std::abs(std::stod(x[k].value))))
                << "seed " << seed << " face " << f << " " << u << " " << v;
        };
        same(a.position, b.position);
        EXPECT_EQ(a.first_exist, b.first_exist) << "seed " << seed << " face " << f << " " << u << " " << v;
        if (a.first_exist && b.first_exist) same(a.d1, b.d1), same(a.d2, b.d2);
        if (a.d11 && b.d11) same(*a.d11, *b.d11), same(*a.d12, *b.d12), same(*a.d22, *b.d22);
        const auto c =
            in_double.evaluate(f, 0, Parameter::parse(u).as_double(), Parameter::parse(v).as_double());
        const auto close = [&](const Enclosure3& x, const Vec3<double>& y) {
          EXPECT_NEAR(std::stod(x[0].value), y.x, 1e-11)
              << "seed " << seed << " face " << f << " " << u << " " << v;
          EXPECT_NEAR(std::stod(x[1].value), y.y, 1e-11)
              << "seed " << seed << " face " << f << " " << u << " " << v;
        };
        close(b.position, c.position);
        EXPECT_EQ(b.first_exist, c.first_exist) << "seed " << seed << " face " << f << " " << u << " " << v;
        if (b.first_exist && c.first_exist) close(b.d1, c.d1), close(b.d2, c.d2);
      }
  }
  EXPECT_GE(with_edges_beyond, 4U);
}

TEST(Channels, OfFourComponentsAreTwoPoints) {
  ControlMesh mesh = data::cube_with_atlas();
  Channel four = mesh.channels[0];
  four.components = 4;
  four.values.clear();
  for (std::size_t i = 0; i < mesh.channels[0].values.size(); i += 2)
    for (const double factor : {1., 2., 3., 4.}) four.values.push_back(factor * mesh.channels[0].values[i]);
  const ChannelEvaluator channel(mesh, four, ChannelRule::kNone, data::Scheme::kCatmullClark);
  const auto points = channel.evaluate(3, 0, .25, .5, 20);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_NEAR(std::stod(points[1].position[0].value), 4 * std::stod(points[0].position[0].value), 1e-12);
  EXPECT_EQ(std::stod(points[1].position[1].value), 0);
}

TEST(Channels, OfRuleAllAreBilinearOnTheQuartersOfPolygons) {
  ControlMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 3, 0}, {0, 2, 0}};
  mesh.faces.push_back({0, 1, 2, 3, 4});
  const Channel uv{.name = "uv", .values = {0, 0, 2, 0, 3, 1, 1, 3, 0, 2}, .corners = {0, 1, 2, 3, 4}};
  const ChannelEvaluator channel(mesh, uv, ChannelRule::kAll, data::Scheme::kCatmullClark);
  const auto middle = channel.evaluate(0, 2, 1., 1., 20)[0], edge = channel.evaluate(0, 2, 1., 0., 20)[0];
  EXPECT_NEAR(std::stod(middle.position[0].value), 1.2, 1e-15);
  EXPECT_NEAR(std::stod(middle.position[1].value), 1.2, 1e-15);
  EXPECT_NEAR(std::stod(edge.position[0].value), 2, 1e-15);
  EXPECT_THROW(channel.evaluate(0, 5, 0., 0., 20), data::ArgumentError);
  EXPECT_THROW(channel.evaluate(1, 0, 0., 0., 20), data::ArgumentError);
  Channel wrong = uv;
  wrong.corners[0] = 5;
  EXPECT_THROW(ChannelEvaluator(mesh, wrong, ChannelRule::kAll, data::Scheme::kCatmullClark),
               data::ArgumentError);
}

}  // namespace
}  // namespace limitcheck::reference
