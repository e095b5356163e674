// SPDX-License-Identifier: MIT
// The protocol as PROTOCOL.md states it, answers read from memory.
#include "verify/host/isolation/protocol.h"
#include "verify/host/isolation/header.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "verify/host/host_memory.h"
#include "verify/host/isolation/test_subjects/memory_source.h"
#include "verify/subject/subject_error.h"

namespace {

using namespace limitcheck::verify;
using namespace limitcheck::verify::protocol;

const std::string kHello =
    R"("limitcheck": 1, "status": "ok", "precision": "float32", "weights": "loop", "boundary": "spline", )"
    R"("points": "limit", "max_depth": 5, "normals": true, "per_face_depth": false, "exact_lattice": true)";

Capabilities capabilities_of(const std::string& answer) {
  MemorySource source(answer);
  return read_capabilities(source);
}

std::string bytes_of(const auto&... arrays) {
  std::string all;
  (all.append(reinterpret_cast<const char*>(&arrays), sizeof arrays), ...);
  return all;
}

TEST(Protocol, AsksInOneLineAndAPayload) {
  EXPECT_EQ(ask_capabilities("a=\"b\"", LC_SCHEME_CATMULL_CLARK),
            "{\"latest\":2,\"limitcheck\":1,\"options\":\"a=\\\"b\\\"\",\"request\":\"capabilities\","
            "\"scheme\":\"catmull-clark\"}\n");
  const double positions[] = {0.1, 0, 0, 1, 0, 0, 0, 1, 1e-300};
  const std::int32_t triangles[] = {0, 1, 2};
  const std::int32_t sizes[] = {3};
  const lc_mesh mesh{positions, 3, triangles, 1, sizeof(lc_mesh), LC_SCHEME_LOOP, triangles, 3, sizes, 1};
  const auto program = [](Payload payload, int version) {
    Capabilities c;
    c.payload = payload;
    c.version = version;
    return c;
  };
  const std::string header = "{\"options\":\"\",\"request\":\"create\",\"triangles\":1,\"vertices\":3}\n";
  EXPECT_EQ(ask_create(mesh, "", program(Payload::kBinary, 1)), header + bytes_of(positions, triangles));
  EXPECT_EQ(ask_create(mesh, "", program(Payload::kText, 1)), header + "0.1 0 0\n1 0 0\n0 1 1e-300\n0 1 2\n");
  EXPECT_EQ(ask_tessellate(std::vector<std::int32_t>{3, -1}, 2, program(Payload::kText, 1)),
            "{\"request\":\"tessellate\",\"threads\":2,\"triangles\":2}\n3\n-1\n");
  // Version 2 has faces of any size, and says which scheme.
  const std::int32_t quad[] = {0, 1, 2, 1}, four[] = {4};
  const lc_sharp_edge edges[] = {{2, 1, 2.3F}};
  const lc_sharp_vertex corners[] = {{1, INFINITY}};
  lc_mesh polygons{positions, 3, nullptr, 0, sizeof(lc_mesh), LC_SCHEME_CATMULL_CLARK, quad, 4, four, 1};
  polygons.sharp_edges = edges, polygons.sharp_edge_count = 1;
  polygons.sharp_vertices = corners, polygons.sharp_vertex_count = 1;
  polygons.creasing = LC_CREASING_CHAIKIN, polygons.corners_held = 1;
  const std::string question =
      "{\"corners\":4,\"corners_held\":true,\"creasing\":\"chaikin\",\"faces\":1,\"options\":\"\","
      "\"request\":\"create\",\"scheme\":\"catmull-clark\",\"sharp_edges\":1,\"sharp_vertices\":1,"
      "\"smooth_triangles\":false,\"vertices\":3}\n";
  EXPECT_EQ(ask_create(polygons, "", program(Payload::kText, 2)),
            question + "0.1 0 0\n1 0 0\n0 1 1e-300\n0 1 2 1\n2 1 2.3\n1 inf\n");
  EXPECT_EQ(ask_create(polygons, "", program(Payload::kBinary, 2)),
            question + bytes_of(positions, four, quad, edges, corners));
  EXPECT_EQ(ask_tessellate(std::vector<std::int32_t>{3, -1}, 2, program(Payload::kText, 2)),
            "{\"faces\":2,\"request\":\"tessellate\",\"threads\":2}\n3\n-1\n");
}

TEST(Protocol, ReadsWhatASubjectSaysAboutItself) {
  const Capabilities c = capabilities_of("{" + kHello + ", \"payload\": \"text\", \"unknown\": [1]}\n");
  EXPECT_EQ(c.values.precision, LC_FLOAT32);
  EXPECT_EQ(c.values.max_depth, 5);
  EXPECT_EQ(c.values.normals, 1);
  EXPECT_EQ(c.values.per_face_depth, 0);
  EXPECT_EQ(c.payload, Payload::kText);
  EXPECT_EQ(c.values.does_not_validate, 0);
  EXPECT_EQ(capabilities_of("{" + kHello + ", \"does_not_validate\": true}\n").values.does_not_validate, 1);
  EXPECT_EQ(c.values.quads_only, 0);
  EXPECT_EQ(capabilities_of("{" + kHello + ", \"quads_only\": true}\n").values.quads_only, 1);
}

// Letters of all alphabets; what a terminal would obey, and bytes that are no letter or half of one, in hexadecimal.
TEST(Protocol, PrintsWhatCanBePrinted) {
  EXPECT_EQ(printable("Größe ∞ 𝄞 \\", 100), "Größe ∞ 𝄞 \\");
  EXPECT_EQ(printable("\x1B[2J\n\x7F", 100), "\\x1b[2J\\x0a\\x7f");
  EXPECT_EQ(printable("\xC2\x9B\xC3(\xED\xA0\x80\xFF", 100), "\\xc2\\x9b\\xc3(\\xed\\xa0\\x80\\xff");
  EXPECT_EQ(printable("ö", 1), "\\xc3...");
}

TEST(Protocol, RefusesAnswersThatAreNone) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = "{" + kHello + "}\n";
    return text.replace(text.find(from), from.size(), to);
  };
  for (const std::string& answer :
       {std::string(), std::string("\n"), std::string("hello\n"), std::string("[1]\n"), "{" + kHello + "}",
        with("\"limitcheck\": 1", "\"limitcheck\": 3"), with("\"limitcheck\": 1", "\"limitcheck\": 2"),
        with("\"limitcheck\": 1", "\"limitcheck\": \"1\""), with("\"limitcheck\": 1, ", ""),
        with("float32", "float16"), with("\"max_depth\": 5", "\"max_depth\": -1"),
        with("\"max_depth\": 5", "\"max_depth\": 5.5"),
        with("\"max_depth\": 5", "\"max_depth\": 18446744073709551615"),
        with("\"normals\": true", "\"normals\": 1"),
        with("\"normals\": true", "\"normals\": true, \"does_not_validate\": 1"), with("\"ok\"", "\"fine\""),
        with("\"status\": \"ok\", ", ""), std::string(70000, '[') + "\n"}) {
    EXPECT_THROW(capabilities_of(answer), Error) << answer.substr(0, 300);
  }
}

TEST(Protocol, PassesRefusalsOn) {
  try {
    capabilities_of("{\"limitcheck\": 1, \"status\": \"invalid-input\", \"message\": \"no\\u0007\"}\n");
    ADD_FAILURE();
  } catch (const SubjectError& refusal) {
    EXPECT_EQ(refusal.status(), LC_INVALID_INPUT);
    EXPECT_STREQ(refusal.what(), "no\\x07");
  }
}

struct Read {
  detail::Memory memory;
  lc_request request{nullptr, 1, &memory, &detail::Memory::allocate};
  lc_tessellation out{};
};

void read(Read& r, const std::string& answer, Payload payload,
          Capabilities c = capabilities_of("{" + kHello + "}\n"), const lc_mesh& mesh = {}) {
  c.payload = payload;
  MemorySource source(answer);
  read_tessellation(source, c, 1 << 20, mesh, r.request, r.out);
}

const std::string kText = "{\"status\": \"ok\", \"vertices\": 1, \"triangles\": 1}\n";

TEST(Protocol, ReadsTextAndBinaryToTheSameArrays) {
  Read text, binary;
  read(text, kText + "0.1 2 -3e5\t0 0  1 7 1 2 4\n0 0 0 7\n", Payload::kText);
  const float positions[] = {0.1F, 2, -3e5F}, normals[] = {0, 0, 1};
  const lc_provenance provenance{7, 1, 2, 4};
  const std::uint32_t corners[] = {0, 0, 0};
  const std::int32_t face = 7;
  const std::string bytes = kText + bytes_of(positions, normals, provenance, corners, face);
  read(binary, bytes, Payload::kBinary);
  for (const Read* r : {&text, &binary}) {
    EXPECT_EQ(r->out.vertex_count, 1);
    EXPECT_EQ(r->out.triangle_count, 1);
    EXPECT_EQ(std::memcmp(r->out.positions, positions, sizeof positions), 0);
    EXPECT_EQ(std::memcmp(r->out.normals, normals, sizeof normals), 0);
    EXPECT_EQ(std::memcmp(r->out.provenance, &provenance, sizeof provenance), 0);
    EXPECT_EQ(std::memcmp(r->out.triangles, corners, sizeof corners), 0);
    EXPECT_EQ(*r->out.triangle_face, face);
  }
  // Beyond the range of its type a number is zero or infinite.
  Read wide;
  read(wide, kText + "1e-50 1e50 -1e50 0 0 1 7 1 2 4\n0 0 0 7\n", Payload::kText);
  const float beyond[] = {0, INFINITY, -INFINITY};
  EXPECT_EQ(std::memcmp(wide.out.positions, beyond, sizeof beyond), 0);
  // Any byte less is too few.
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    Read r;
    EXPECT_THROW(read(r, bytes.substr(0, k), Payload::kBinary), Error) << k;
  }
}

TEST(Protocol, WithoutProvenanceHasPointsAndTrianglesAlone) {
  const Capabilities c = capabilities_of("{" + kHello + ", \"provenance\": false}\n");
  EXPECT_EQ(c.values.no_provenance, 1);
  const float numbers[] = {1, 2, 3, 0, 0, 1};
  const std::uint32_t corners[] = {0, 0, 0};
  for (const auto& [payload, answer] :
       {std::pair{Payload::kBinary, bytes_of(numbers, corners)}, {Payload::kText, "1 2 3 0 0 1\n0 0 0\n"}}) {
    Read r;
    read(r, kText + answer, payload, c);
    EXPECT_EQ(std::memcmp(r.out.positions, numbers, sizeof numbers / 2), 0);
    EXPECT_EQ(std::memcmp(r.out.triangles, corners, sizeof corners), 0);
    EXPECT_EQ(r.out.provenance, nullptr);
    EXPECT_EQ(r.out.triangle_face, nullptr);
    EXPECT_EQ(r.out.corner, nullptr);
  }
}

Capabilities of_version_2(const std::string& more) {
  return capabilities_of(
      R"({"limitcheck": 2, "status": "ok", "schemes": ["catmull-clark"], "precision": "float32", )"
      R"("weights": "loop", "boundary": "spline", "points": "limit", "max_depth": 5, "normals": false, )"
      R"("per_face_depth": false, "exact_lattice": true)" +
      more + "}\n");
}

TEST(Protocol, OfVersion2HasTheCornersOfProvenance) {
  const Capabilities c = of_version_2("");
  EXPECT_EQ(c.values.schemes, LC_DOES_CATMULL_CLARK);
  const float position[] = {1, 2, 3};
  const lc_provenance provenance{7, 1, 2, 4};
  const std::int32_t corner = 5, face = 7;
  const std::uint32_t corners[] = {0, 0, 0};
  for (const auto& [payload, answer] :
       {std::pair{Payload::kBinary, bytes_of(position, provenance, corner, corners, face)},
        {Payload::kText, "1 2 3 7 1 2 4 5\n0 0 0 7\n"}}) {
    Read r;
    read(r, kText + answer, payload, c);
    EXPECT_EQ(std::memcmp(r.out.provenance, &provenance, sizeof provenance), 0);
    ASSERT_NE(r.out.corner, nullptr);
    EXPECT_EQ(*r.out.corner, 5);
    EXPECT_EQ(*r.out.triangle_face, 7);
  }
}

// A channel goes with the mesh, and comes with the tessellation: of each corner of each triangle its components, and behind
// all of these, if they were announced, its derivatives by u, then those by v.
TEST(Protocol, HandsChannelsOverAndReadsTheirValuesAndDerivatives) {
  const std::string channels = R"(, "provenance": false, "channels": ["none", "all", "unheard"])";
  const Capabilities c = of_version_2(
      channels + R"(, "points_anywhere": true, "device": "a card\u0007", "channel_derivatives": true)");
  EXPECT_EQ(c.values.points_anywhere, 1);
  EXPECT_EQ(c.device, R"(a card\x07)");
  EXPECT_EQ(c.values.channel_rules, 1 << LC_CHANNEL_NONE | 1 << LC_CHANNEL_ALL);
  EXPECT_EQ(c.values.channel_derivatives, 1);
  const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, values[] = {0.5, 0.25, 1, 0};
  const std::int32_t corners[] = {0, 1, 2}, sizes[] = {3}, indices[] = {0, 1, 1};
  const lc_channel channel{2, LC_CHANNEL_ALL, values, 2, indices};
  lc_mesh mesh{positions, 3, corners, 1, sizeof(lc_mesh), LC_SCHEME_CATMULL_CLARK, corners, 3, sizes, 1};
  mesh.channels = &channel, mesh.channel_count = 1;
  Capabilities text = c;
  text.payload = Payload::kText;
  const std::string asked = ask_create(mesh, "", c), in_words = ask_create(mesh, "", text);
  const Header header(asked.substr(0, asked.find('\n')));
  ASSERT_EQ(header.channels().size(), 1U);
  EXPECT_EQ(header.channels()[0].components, 2);
  EXPECT_EQ(header.channels()[0].rule, LC_CHANNEL_ALL);
  EXPECT_EQ(header.channels()[0].values, 2);
  EXPECT_TRUE(asked.ends_with(bytes_of(values, indices)));
  EXPECT_TRUE(in_words.ends_with("0 1 2\n0.5 0.25\n1 0\n0\n1\n1\n")) << in_words;

  const float numbers[] = {1, 2, 3}, uv[] = {0.5, 0.25, 1, 0, 1, 0};
  const float slopes[] = {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14};
  const std::uint32_t triangle[] = {0, 0, 0};
  const std::string in_text = "1 2 3\n0 0 0\n0.5 0.25\n1 0\n1 0\n",
                    slopes_in_text = "3 4 5 6\n7 8 9 10\n11 12 13 14\n";
  for (const bool derivatives : {false, true})
    for (const auto& [payload, answer] :
         {std::pair{Payload::kBinary,
                    bytes_of(numbers, triangle, uv) + (derivatives ? bytes_of(slopes) : "")},
          {Payload::kText, in_text + (derivatives ? slopes_in_text : "")}}) {
      const Capabilities announced = derivatives ? c : of_version_2(channels);
      Read r;
      read(r, kText + answer, payload, announced, mesh);
      ASSERT_NE(r.out.channel_values, nullptr);
      EXPECT_EQ(std::memcmp(r.out.channel_values, uv, sizeof uv), 0);
      ASSERT_EQ(r.out.channel_derivatives != nullptr, derivatives);
      if (derivatives) {
        EXPECT_EQ(std::memcmp(r.out.channel_derivatives, slopes, sizeof slopes), 0);
      }
      Read shorter;
      EXPECT_THROW(read(shorter, kText + answer.substr(0, answer.size() - 3), payload, announced, mesh),
                   Error);
    }
}

// The table of PROTOCOL.md: each question has the keys that are sent, the first answer is one that is read.
TEST(Protocol, IsAsItsPageSays) {
  std::ifstream in(LIMITCHECK_SOURCE_DIR "/verify/host/isolation/PROTOCOL.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  static const std::regex object("`(\\{[^`]*\\})`"), letter(": ([A-Zvt])([,}])");
  std::vector<std::string> objects;
  for (std::sregex_iterator m(page.begin(), page.end(), object), end; m != end; ++m)
    objects.push_back(std::regex_replace((*m)[1].str(), letter, ": 0$2"));
  ASSERT_GE(objects.size(), 6U);
  const auto keys = [](const std::string& text) {
    std::set<std::string> result;
    const auto json = nlohmann::json::parse(text.substr(0, text.find('\n')));
    for (const auto& [key, value] : json.items()) result.insert(key);
    return result;
  };
  const Capabilities c = capabilities_of(objects[1] + "\n");
  EXPECT_EQ(c.version, kVersion);
  EXPECT_EQ(c.values.schemes, LC_DOES_LOOP | LC_DOES_CATMULL_CLARK);
  const lc_mesh nothing{};
  EXPECT_EQ(keys(objects[0]), keys(ask_capabilities("k=v", LC_SCHEME_CATMULL_CLARK)));
  EXPECT_EQ(keys(objects[2]), keys(ask_create(nothing, "k=v", c)));
  EXPECT_EQ(keys(objects[4]), keys(ask_tessellate({}, 1, c)));
}

TEST(Protocol, RefusesTextThatIsNotTheNumbersAnnounced) {
  for (const char* payload :
       {"", "0 0 0 0 0 1 7 1 2 4", "0 0 0 0 0 1 7 1 2\n", "0 0 0 0 0 1 7 1 2 4 5\n", "0 0 0 0 0 1 7 1 2 x\n",
        "0 0 0 0 0 1 7 1 2 4x\n", "0 0 0 0 0 1 7 -1 2 4\n", "0 0 0 0 0 1 7 1.5 2 4\n",
        "0,0 0 0 0 0 1 7 1 2 4\n", "0 0 0 0 0 1 99999999999 1 2 4\n", "0 0 0 0 0 1 7 1 2 4\n0 0 0\n"}) {
    Read r;
    EXPECT_THROW(read(r, kText + payload, Payload::kText), Error) << payload;
  }
  Read r;
  EXPECT_THROW(read(r, kText + std::string(2000, '1') + "\n", Payload::kText), Error);
}

// Counts that cannot be meant, and sums of sizes that would overflow: nothing is allocated for them.
TEST(Protocol, AllocatesNothingForAbsurdCounts) {
  for (const char* counts :
       {"\"vertices\": 1000000000000000000, \"triangles\": 1",
        "\"vertices\": 9223372036854775807, \"triangles\": 1",
        "\"vertices\": 1, \"triangles\": 9223372036854775807",
        "\"vertices\": 18446744073709551615, \"triangles\": 1", "\"vertices\": -1, \"triangles\": 1",
        "\"vertices\": 1e18, \"triangles\": 1", "\"vertices\": 30000, \"triangles\": 1",
        "\"vertices\": [1], \"triangles\": 1", "\"vertices\": 1"}) {
    Read r;
    EXPECT_THROW(read(r, "{\"status\": \"ok\", " + std::string(counts) + "}\n", Payload::kBinary), Error)
        << counts;
    EXPECT_TRUE(r.memory.blocks().empty()) << counts;
  }
}

}  // namespace
