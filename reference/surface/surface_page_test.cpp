// SPDX-License-Identifier: MIT
// The worked answers of reference/SURFACE.md, computed again: steps and sharpness in rationals, points of the
// surface in certified decimals, Catmull-Clark's in rationals, too. The page says what its lines mean.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "data/io/read.h"
#include "reference/catmull_clark/recursion.h"
#include "reference/loop/refine.h"
#include "reference/mesh/sharpness.h"
#include "reference/number/number_exact.h"
#include "reference/surface/certified.h"

namespace limitcheck::reference {
namespace {

using Weights = std::map<int, Rational>;
using Words = std::vector<std::string>;

Words words_of(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

Rational number(const std::string& text) {
  const auto slash = text.find('/');
  if (slash == std::string::npos) return Rational(Integer(text));
  return Rational(Integer(text.substr(0, slash)), Integer(text.substr(slash + 1)));
}

/// "0-3 5": calls with 0, 1, 2, 3, 5.
template <class Function>
void for_each_index(const std::string& range, Function&& function) {
  const auto dash = range.find('-');
  const int first = std::stoi(range),
            last = dash == std::string::npos ? first : std::stoi(range.substr(dash + 1));
  for (int i = first; i <= last; ++i) function(i);
}

Weights weights_of(const std::string& text) {
  Weights result;
  for (const std::string& word : words_of(text)) {
    const auto colon = word.find(':');
    for_each_index(word.substr(0, colon), [&](int v) {
      EXPECT_TRUE(result.emplace(v, number(word.substr(colon + 1))).second) << "vertex " << v << " twice";
    });
  }
  return result;
}

/// A line of the page: SCHEME MESH TAGS ? QUESTION = ANSWER.
struct Line {
  std::string text, answer;
  data::Scheme scheme;
  data::Faces faces;
  std::string tags;  ///< as in an OBJ file
  Words question;

  explicit Line(const std::string& line) : text(line) {
    const auto mark = line.find('?'), equal = line.find('=');
    if (equal != std::string::npos) answer = line.substr(equal + 1);
    question = words_of(line.substr(mark + 1, equal == std::string::npos ? equal : equal - mark - 1));
    Words words = words_of(line.substr(0, mark));
    std::size_t at = 0;
    const auto next = [&] { return at < words.size() ? words[at++] : std::string(); };
    scheme = next() == "loop" ? data::Scheme::kLoop : data::Scheme::kCatmullClark;
    read_faces(words, at);
    while (at < words.size()) {
      const std::string tag = next();
      if (tag == "crease") {
        const std::string a = next(), b = next();
        tags += "t crease 2/1/0 " + a + " " + b + " " + next() + "\n";
      } else if (tag == "corner") {
        const std::string v = next();
        tags += "t corner 1/1/0 " + v + " " + next() + "\n";
      } else if (tag == "hole") {
        tags += "t hole 1/0/0 " + next() + "\n";
      } else if (tag == "boundary") {
        const std::string option = next();
        tags += "t interpolateboundary 1/0/0 " +
                std::string(option == "none"   ? "0"
                            : option == "edge" ? "2"
                                               : "1") +
                "\n";
      } else {
        EXPECT_TRUE(tag == "creasing" || tag == "triangles") << tag;
        tags += (tag == "creasing" ? "t creasemethod 0/0/1 " : "t smoothtriangles 0/0/1 ") + next() + "\n";
      }
    }
  }

  bool is_loop() const { return scheme == data::Scheme::kLoop; }
  int vertex_count() const { return 1 + *std::max_element(faces.corners().begin(), faces.corners().end()); }
  /// With vertex v at place(v), three whole numbers: read as a file is.
  template <class Place>
  data::ControlMesh mesh(Place&& place) const {
    std::ostringstream obj;
    for (int v = 0; v < vertex_count(); ++v) {
      const std::array<int, 3> p = place(v);
      obj << "v " << p[0] << " " << p[1] << " " << p[2] << "\n";
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
      obj << "f";
      for (const std::int32_t v : faces[f]) obj << " " << v + 1;
      obj << "\n";
    }
    return data::read_mesh(obj.str() + tags, data::FileFormat::kObj, text, {.scheme = scheme});
  }

 private:
  void read_faces(const Words& words, std::size_t& at) {
    const std::string kind = words[at++];
    const auto count = [&] { return std::stoi(words[at++]); };
    if (kind == "faces") {
      std::vector<std::int32_t> face;
      for (bool more = true; more && at < words.size() && std::isdigit(words[at][0]) != 0;) {
        face.push_back(std::stoi(words[at]));
        const bool ends = words[at++].back() == ',';
        more = ends || (at < words.size() && std::isdigit(words[at][0]) != 0);
        if (ends || !more) faces.push_back(face), face.clear();
      }
    } else if (kind == "sheet") {
      const int columns = count(), rows = count();
      for (int v = 0; v + columns + 1 < (columns + 1) * (rows + 1); ++v) {
        if (v % (columns + 1) == columns) continue;
        const int across = v + columns + 2;
        if (is_loop())
          faces.push_back({v, v + 1, across}), faces.push_back({v, across, across - 1});
        else
          faces.push_back({v, v + 1, across, across - 1});
      }
    } else {
      const int n = count();
      const bool closed = kind == "wheel";
      for (int i = 0; i < n; ++i) {
        const int before = 1 + i, after = closed ? 1 + (i + 1) % n : 2 + i;
        if (is_loop())
          faces.push_back({0, before, after});
        else
          faces.push_back({0, before, n + (closed ? 1 : 2) + i, after});
      }
    }
  }
};

template <class N>
std::vector<Vec3<N>> positions_in(const data::ControlMesh& mesh) {
  std::vector<Vec3<N>> result;
  for (const auto& p : mesh.positions) result.push_back({N(p[0]), N(p[1]), N(p[2])});
  return result;
}

std::size_t edge_of(const Topology& topology, const std::string& a, const std::string& b) {
  for (std::size_t e = 0; e < topology.edges().size(); ++e)
    if (std::minmax(topology.edges()[e].a, topology.edges()[e].b) == std::minmax(std::stoi(a), std::stoi(b)))
      return e;
  ADD_FAILURE() << "no edge " << a << "-" << b;
  return 0;
}

/// The point of a step that is asked for: "V", "A B", "face F".
Vec3<Rational> stepped(const Line& line, const data::ControlMesh& mesh) {
  const Topology topology(mesh.positions.size(), mesh.faces);
  const Words& q = line.question;
  const std::size_t edges = mesh.positions.size(), faces = edges + topology.edges().size();
  const std::size_t at = q[1] == "face" ? faces + std::stoul(q[2])
                         : q.size() > 2 ? edges + edge_of(topology, q[1], q[2])
                                        : std::stoul(q[1]);
  if (line.is_loop()) {
    RefinedMesh<Rational> refined(positions_in<Rational>(mesh), data::triangles_of(mesh).to_vector(),
                                  reference::Weights::kLoop, mesh.sharpness);
    refined.refine();
    return refined.positions().at(at);
  }
  catmull_clark::RefinedMesh<Rational> refined(mesh.faces, positions_in<Rational>(mesh), mesh.sharpness);
  refined.refine();
  return refined.positions().at(at);
}

/// Where "F" or "F:C" and two parameters are.
struct Place {
  int face, corner;
  Parameter u, v;
  explicit Place(std::span<const std::string> words)
      : face(std::stoi(words[0])),
        corner(words[0].find(':') == std::string::npos ? 0
                                                       : std::stoi(words[0].substr(words[0].find(':') + 1))),
        u(Parameter::parse(words[1])),
        v(Parameter::parse(words[2])) {}
};

CertifiedPoint certified(const Line& line, const data::ControlMesh& mesh, const Place& at) {
  return CertifiedEvaluator(mesh, line.scheme).evaluate(at.face, at.corner, at.u, at.v, 30);
}

Rational exact_decimal(const std::string& text) {
  const Parameter p = Parameter::parse(text);
  return number(p.to_string());
}

void expect_within(const Enclosure& got, const Rational& expected, const std::string& what) {
  EXPECT_LE(magnitude(Rational(exact_decimal(got.value) - expected)), Rational(got.radius.as_double()))
      << what << ": " << got.value << " is not " << expected;
  EXPECT_LE(got.radius.as_double(), 1e-28) << what;
}

/// The weights of all vertices, three at a time: one for each coordinate.
void check_weights(const Line& line) {
  const Weights expected = weights_of(line.answer);
  EXPECT_FALSE(expected.empty());
  EXPECT_LT(expected.rbegin()->first, line.vertex_count());
  for (int first = 0; first < line.vertex_count(); first += 3) {
    const data::ControlMesh mesh = line.mesh([&](int v) {
      return std::array<int, 3>{v == first, v == first + 1, v == first + 2};
    });
    const auto want = [&](int i) {
      const auto found = expected.find(first + i);
      return found == expected.end() ? Rational(0) : found->second;
    };
    const Vec3<Rational> all{want(0), want(1), want(2)};
    const std::string& question = line.question[0];
    if (question == "point") {
      EXPECT_EQ(stepped(line, mesh), all) << "vertices from " << first;
      continue;
    }
    const Place at(std::span(line.question).subspan(1));
    const CertifiedPoint p = certified(line, mesh, at);
    EXPECT_TRUE(question == "limit" || p.first_exist) << "no derivative";
    const Enclosure3& got = question == "limit" ? p.position : question == "d1" ? p.d1 : p.d2;
    for (int i = 0; i < 3; ++i)
      expect_within(got[static_cast<std::size_t>(i)], want(i), "vertex " + std::to_string(first + i));
    if (line.is_loop()) continue;
    const auto exact = catmull_clark::SubdivisionEvaluator<Rational>(mesh.faces, positions_in<Rational>(mesh),
                                                                     mesh.sharpness)
                           .evaluate(at.face, at.corner, at.u, at.v, Derivatives::kFirst);
    // At special vertices derivatives need roots, which rationals lack.
    if (question == "limit" || exact.first_exist) {
      EXPECT_EQ(question == "limit" ? exact.position : question == "d1" ? exact.d1 : exact.d2, all);
    }
  }
}

/// Of three meshes in which the vertices are anywhere: the normal is the direction of a x b.
void check_normal(const Line& line) {
  const auto half = line.answer.find(';');
  ASSERT_NE(half, std::string::npos);
  const Weights first = weights_of(line.answer.substr(0, half)),
                second = weights_of(line.answer.substr(half + 1));
  for (const int seed : {1, 2, 3}) {
    const auto anywhere = [&](int v) {
      return std::array{(v * 37 + seed * 11) % 19 - 9, (v * v * 5 + seed * 7) % 23 - 11,
                        (v * 29 + v * v * v * seed) % 17 - 8};
    };
    const auto sum = [&](const Weights& weights) {
      Vec3<Rational> result;
      for (const auto& [v, w] : weights) {
        const auto p = anywhere(v);
        result += Vec3<Rational>{Rational(p[0]), Rational(p[1]), Rational(p[2])} * w;
      }
      return result;
    };
    const Vec3<Rational> expected = cross(sum(first), sum(second));
    const CertifiedPoint p = certified(line, line.mesh(anywhere), Place(std::span(line.question).subspan(1)));
    EXPECT_EQ(p.normal_kind, NormalKind::kRegular);
    const auto value = [&](std::size_t i) { return exact_decimal(p.normal[i].value); };
    const Vec3<Rational> got{value(0), value(1), value(2)}, off = cross(got, expected);
    const Rational radius(std::max({p.normal[0].radius, p.normal[1].radius, p.normal[2].radius}).as_double());
    EXPECT_LE(radius, Rational(1e-28));
    EXPECT_LE(magnitude(off), radius * 2 * magnitude(expected));
    EXPECT_GT(dot(got, expected), 0);
  }
}

void check(const Line& line) {
  const Words& q = line.question;
  if (q[0] == "sharpness") {
    const data::ControlMesh mesh = line.mesh([](int v) { return std::array{v, v * v, 1}; });
    const Topology topology(mesh.positions.size(), mesh.faces);
    catmull_clark::RefinedMesh<Rational> refined(mesh.faces, positions_in<Rational>(mesh));
    refined.refine();
    const Sharpness after = Sharpness(topology, mesh.sharpness).refined(topology, refined.topology());
    const std::size_t middle = mesh.positions.size() + edge_of(topology, q[1], q[2]);
    const std::size_t half = edge_of(refined.topology(), q[4], std::to_string(middle));
    EXPECT_EQ(after.edge(static_cast<std::int32_t>(half)), number(words_of(line.answer).at(0)));
  } else if (q[0] == "none" && q[1] == "faces") {
    std::vector<std::int32_t> expected;
    for (const std::string& range : words_of(line.answer))
      for_each_index(range, [&](int f) { expected.push_back(f); });
    EXPECT_EQ(line.mesh([](int v) { return std::array{v, v * v, 1}; }).holes, expected);
  } else if (q[0] == "none") {
    const data::ControlMesh mesh = line.mesh([](int v) { return std::array{v % 4, v * v % 7, v * 5 % 11}; });
    EXPECT_EQ(certified(line, mesh, Place(std::span(q).subspan(2))).normal_kind, NormalKind::kNoTangentPlane);
  } else if (q[0] == "normal") {
    check_normal(line);
  } else {
    check_weights(line);
  }
}

TEST(SurfacePage, EveryWorkedAnswerIsWhatTheReferenceComputes) {
  std::ifstream page(std::string(LIMITCHECK_SOURCE_DIR) + "/reference/SURFACE.md");
  ASSERT_TRUE(page);
  std::map<std::string, int> asked;
  int blocks = 0;
  bool inside = false;
  for (std::string text; std::getline(page, text);) {
    if (text.rfind("```", 0) == 0) {
      inside = text == "```answers";
      blocks += inside ? 1 : 0;
    } else if (inside) {
      SCOPED_TRACE(text);
      const Line line(text);
      ASSERT_FALSE(line.question.empty());
      ++asked[line.question[0]];
      EXPECT_NO_THROW(check(line));
    }
  }
  EXPECT_EQ(blocks, 6);
  for (const char* question : {"point", "sharpness", "limit", "d1", "d2", "normal", "none"})
    EXPECT_GE(asked[question], 2) << question;
}

}  // namespace
}  // namespace limitcheck::reference
