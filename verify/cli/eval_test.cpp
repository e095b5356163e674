// SPDX-License-Identifier: MIT
// `limitcheck eval` as a user meets it.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_dec_float.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "data/test_support/known_answers.h"
#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

class EvalCommand : public CommandTest {};

using Decimal = boost::multiprecision::number<boost::multiprecision::cpp_dec_float<100>>;

// Between got / scale and the expected number, relative to the latter where that is larger than 1.
double difference(const std::string& got, int scale, const std::string& expected) {
  const Decimal x = Decimal(got) / scale, y(expected);
  const Decimal size = abs(y) > 1 ? Decimal(abs(y)) : Decimal(1);
  return Decimal(abs(x - y) / size).convert_to<double>();
}

// A height of 324 at one of the twelve vertices picks its weight out of the sum.             [C66; section 5]
TEST_F(EvalCommand, TheCentreOfARegularFaceHasThePapersWeights) {
  // Fig. 9's order: rows (1,2) (3,4,5) (6,7,8,9) (10,11,12).
  const int faces[13][3] = {{4, 7, 8}, {1, 3, 4},  {1, 4, 2},   {2, 4, 5},  {3, 6, 7},   {3, 7, 4}, {4, 8, 5},
                            {5, 8, 9}, {6, 10, 7}, {7, 10, 11}, {7, 11, 8}, {8, 11, 12}, {8, 12, 9}};
  const double xy[12][2] = {{1.5, 3}, {2.5, 3}, {1, 2},   {2, 2}, {3, 2}, {.5, 1},
                            {1.5, 1}, {2.5, 1}, {3.5, 1}, {1, 0}, {2, 0}, {3, 0}};
  const int weight[12] = {1, 1, 14, 92, 14, 1, 92, 92, 1, 1, 14, 1};  // over 324
  for (int chosen = 0; chosen < 12; ++chosen) {
    std::string obj;
    for (int v = 0; v < 12; ++v) {
      obj += "v " + std::to_string(xy[v][0]) + " " + std::to_string(xy[v][1]) +
             (v == chosen ? " 324\n" : " 0\n");
    }
    for (const auto& f : faces) {
      obj += "f " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) + "\n";
    }
    write("regular.obj", obj);
    const auto json = json_of("eval regular.obj 0 1/3 1/3 --json --digits 40", 0);
    EXPECT_EQ(std::stod(json["position"][2].get<std::string>()), weight[chosen]) << "vertex " << chosen + 1;
    for (const char* key : {"position", "d1", "d2", "normal"}) {
      ASSERT_EQ(json[key].size(), 3U) << key;
      EXPECT_TRUE(json[key][0].is_string()) << key;
    }
  }
}

TEST_F(EvalCommand, GivesEveryQuantityARadiusOfItsOwn) {
  // So near a corner of valence 7 second derivatives are huge: theirs is no measure of the position.
  const auto json = json_of("eval wheel:7 0 1e-12 1e-12 --json", 0);
  const auto& radii = json["radii"];
  double largest = 0;
  for (const char* key : {"position", "d1", "d2", "normal", "d11", "d12", "d22"}) {
    const double size = std::abs(std::stod(json[key][0].get<std::string>())) +
                        std::abs(std::stod(json[key][1].get<std::string>())) +
                        std::abs(std::stod(json[key][2].get<std::string>()));
    EXPECT_GT(radii[key].get<double>(), 0) << key;
    EXPECT_LE(radii[key].get<double>(), size * 1e-15) << key;
    largest = std::max(largest, radii[key].get<double>());
  }
  EXPECT_LE(radii["position"].get<double>(), 1e-14);
  EXPECT_GT(radii["d11"].get<double>(), 1e-9);
  for (const char* key : {"gaussian_curvature", "mean_curvature"})
    EXPECT_LE(radii[key].get<double>(), std::abs(std::stod(json[key].get<std::string>())) * 1e-14) << key;
  EXPECT_EQ(json["radius"].get<double>(), largest);
  EXPECT_TRUE(radii["tangent1"].is_null());
}

// A radius is a JSON number as long as a double of full precision is that small or large, and else a string.
TEST_F(EvalCommand, NoRadiusIsTooSmallOrTooLargeToBeSaid) {
  write("tiny.obj",
        "v 1e-300 0 0\nv 0 2e-300 0\nv 0 0 3e-300\nv -1e-300 -1e-300 -1e-300\n"
        "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
  const auto json = json_of("eval tiny.obj 0 1/4 1/4 --json", 0);
  const auto radius = [&](const char* key) { return Decimal(json["radii"][key].get<std::string>()); };
  EXPECT_TRUE(json["radii"]["position"].is_string());
  EXPECT_LT(radius("position"), Decimal("1e-315"));
  EXPECT_GT(radius("position"), 0);
  EXPECT_TRUE(json["radii"]["gaussian_curvature"].is_string());
  EXPECT_LT(radius("gaussian_curvature"), Decimal(json["gaussian_curvature"].get<std::string>()) * 1e-14);
  EXPECT_GT(Decimal(json["gaussian_curvature"].get<std::string>()), Decimal("1e600"));
  EXPECT_TRUE(json["radius"].is_number());
  const Outcome text = run("eval tiny.obj 0 1/4 1/4");
  EXPECT_TRUE(says(text.out, "e-317\n"));
}

TEST_F(EvalCommand, SaysWhichDerivativesExistAtAnExtraordinaryCorner) {
  const auto at = [&](const std::string& mesh) { return json_of("eval " + mesh + " 0 0 0 --json", 0); };
  const nlohmann::json zero{"0", "0", "0"};
  for (const char* mesh : {"tetrahedron", "octahedron", "icosahedron"}) {  // valence 3, 4, 5
    const auto json = at(mesh);
    EXPECT_EQ(json["derivatives_exist"], true) << mesh;
    EXPECT_EQ(json["d1"], zero) << mesh;
    EXPECT_EQ(json["d2"], zero) << mesh;
    EXPECT_EQ(json["radii"]["d1"], 0) << mesh;
    EXPECT_EQ(json["d11"].is_null(), std::string(mesh) != "tetrahedron") << mesh;
    EXPECT_NE(json["tangent1"], zero) << mesh;
  }
  const auto json = at("wheel:7");
  EXPECT_EQ(json["derivatives_exist"], false);
  EXPECT_EQ(json["d1"], json["tangent1"]);  // as ever
  EXPECT_TRUE(json["d11"].is_null());
  const std::string text = run("eval wheel:7 0 0 0").out;
  EXPECT_TRUE(says(text, "d/dl1       does not exist"));
  EXPECT_TRUE(says(text, "d2/dl1dl1   does not exist"));
  EXPECT_TRUE(says(run("eval octahedron 0 0 0").out, "d/dl1       0  0  0  exact"));
}

// The table itself is tested in reference/: here, that its words are those of each kind of vertex.
TEST_F(EvalCommand, SaysWhyDerivativesExistOrNot) {
  struct Case {
    const char *mesh, *first, *second, *why;
  };
  const Case cases[] = {
      {"dart:5", "zero", "grows", "(zero at such a corner: 0.962 times as much after each halving"},
      {"dart:6", "value", "grows", "grows 1.35355-fold"},
      {"dart:7", "grows", "grows", "grows 1.06174-fold"},
      {"fan:1", "value", "value", "d2/dl1dl2"},
      {"fan:4", "grows", "grows", "(eigenvalue 0.551777), unless it runs along the boundary or crease"},
      {"corner:3", "value", "grows", "(eigenvalue 0.375), unless"},
      {"quad-cube", "zero", "grows", "(zero at such a corner: 0.82 times as much"},
      {"quad-dart:3", "zero", "grows", "(zero at such a corner: 0.924 times"},
      {"quad-dart:4", "value", "grows", "grows 1.27873-fold"},
      {"quad-fan:1", "value", "no_limit", "it depends on the direction, or grows like the logarithm"},
      {"quad-corner:3", "no_limit", "grows", "(eigenvalue 0.5), unless"},
      {"quad-wheel:5", "grows", "grows", "grows 1.09998-fold"}};
  for (const Case& c : cases) {
    const std::string command = "eval " + std::string(c.mesh) + " 0 0 0";
    const auto json = json_of(command + " --json");
    const std::string first = c.first, second = c.second;
    EXPECT_EQ(json["first_limit"]["fate"], first) << c.mesh;
    EXPECT_EQ(json["second_limit"]["fate"], second) << c.mesh;
    EXPECT_EQ(json["derivatives_exist"], first == "value" || first == "zero") << c.mesh;
    EXPECT_EQ(json["second_derivatives_exist"], second == "value") << c.mesh;
    EXPECT_EQ(json["d11"].is_null(), second != "value") << c.mesh;
    const std::string text = run(command).out;
    EXPECT_TRUE(says(text, c.why));
  }
  EXPECT_TRUE(json_of("eval dart:6 0 .25 .25 --json")["first_limit"].is_null());
}

TEST_F(EvalCommand, HasWarrensWeightsToo) {
  // A vertex of the octahedron keeps half of its distance from the centre, 24/55 by Loop's weights.
  const auto first = [&](const std::string& options) {
    const auto json = json_of("eval octahedron 0 0 0 --digits 20 --json" + options, 0);
    double length = 0;
    for (const auto& x : json["position"]) length = std::hypot(length, std::stod(x.get<std::string>()));
    return length;
  };
  EXPECT_NEAR(first(" --weights warren") / first(""), 0.5 * 55 / 24, 1e-14);
}

constexpr int kScale = 3000;

// Every smooth known answer, at 45 digits; the answers have 42. A file holds no fractions: the control points
// are kScale times those of the answers, which makes integers of them.
TEST_F(EvalCommand, KnowsTheAnswersOfCatmullClarksSurface) {
  int cases = 0, samples = 0;
  for (const data::QuadAnswer& a : data::load_quad_answers()) {
    if (a.scheme != "catmull-clark" || a.has_sharp() || a.boundary != "edge" || a.triangles != "catmark")
      continue;
    if (a.faces.size() > 100) continue;  // interval arithmetic at valence 50 takes its time
    const auto scaled = [](const std::string& fraction) {
      const std::size_t slash = fraction.find('/');
      const int denominator = slash == std::string::npos ? 1 : std::stoi(fraction.substr(slash + 1));
      EXPECT_EQ(kScale % denominator, 0) << fraction;
      return std::stoi(fraction) * (kScale / denominator);
    };
    ++cases;
    std::string obj;
    for (const auto& p : a.vertices)
      obj += fmt::format("v {} {} {}\n", scaled(p[0]), scaled(p[1]), scaled(p[2]));
    for (std::size_t f = 0; f < a.faces.size(); ++f) {
      obj += "f";
      for (const auto v : a.faces[f]) obj += fmt::format(" {}", v + 1);
      obj += "\n";
    }
    write("case.obj", obj);
    for (const data::QuadSample& s : a.samples) {
      const bool quad = a.faces[s.face].size() == 4;
      const std::string at = quad ? fmt::format("{}", s.face) : fmt::format("{}:{}", s.face, s.corner);
      const auto json =
          json_of(fmt::format("eval case.obj {} {} {} --json --digits 45 --scheme catmull-clark", at, s.uv[0],
                              s.uv[1]),
                  0);
      EXPECT_EQ(json["scheme"], "catmull-clark");
      EXPECT_EQ(json["corner"].is_null(), quad);
      EXPECT_EQ(json["parameters"].size(), 2U);
      const auto agrees = [&](const char* key, const data::Numeral3& expected, int scale = kScale) {
        for (std::size_t i = 0; i < 3; ++i)
          EXPECT_LE(difference(json[key][i].get<std::string>(), scale, expected[i]), 1e-39)
              << a.id << " " << at << " " << s.uv[0] << " " << s.uv[1] << " " << key;
      };
      agrees("position", s.position);
      if (s.normal) agrees("normal", *s.normal, 1);
      if (s.du) agrees("d1", *s.du), agrees("d2", *s.dv);
      if (s.dudu) agrees("d11", *s.dudu), agrees("d12", *s.dudv), agrees("d22", *s.dvdv);
      ++samples;
    }
  }
  EXPECT_EQ(cases, 23);
  RecordProperty("samples", samples);
}

}  // namespace
}  // namespace limitcheck::cli
