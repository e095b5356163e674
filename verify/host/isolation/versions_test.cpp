// SPDX-License-Identifier: MIT
// What was written for version 1 of the interface or of the protocol is asked what it was always asked, and
// nothing else.
#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "verify/cli/command_test.h"
#include "verify/subject/subject.h"

namespace limitcheck::cli {
namespace {

using nlohmann::json;

const std::string kVersion1Program =
    "--program \"python3 '" LIMITCHECK_SOURCE_DIR "/verify/subject/examples/python/loop.py'\"";

// What interface 2 added stands behind what interface 1 has (test_subjects/interface_1.c). README.md has
// the sizes.
static_assert(offsetof(lc_capabilities, size) == 32 && sizeof(lc_capabilities) == 68);
static_assert(offsetof(lc_mesh, size) == 32 && sizeof(lc_mesh) == 136);
static_assert(offsetof(lc_request, size) == 32 && sizeof(lc_request) == 40);
static_assert(offsetof(lc_tessellation, size) == 64 && sizeof(lc_tessellation) == 96);
// What it added to itself stands behind what libraries of it were built with (test_subjects/interface_2.c).
static_assert(offsetof(lc_capabilities, channel_derivatives) == 60 &&
              offsetof(lc_capabilities, points_anywhere) == 64);
static_assert(offsetof(lc_tessellation, channel_derivatives) == 88);

class Versions : public CommandTest {
 protected:
  json report_of(const std::string& arguments, int code) const {
    return json_of("audit " + arguments + " --level quick --json -", code);
  }
  /// How many rows hold; none is anything else but not offered.
  static int held(const json& report) {
    int count = 0;
    for (const json& row : report["results"]) {
      count += row["status"] == "held";
      EXPECT_TRUE(row["status"] == "held" || row["status"] == "not-supported") << row;
    }
    return count;
  }
  static std::string library(const std::string& name) {
    return "'" LIMITCHECK_TEST_SUBJECTS "/" + name + ".so'";
  }
};

TEST_F(Versions, ALibraryBuiltForInterface1IsAuditedAsItAlwaysWas) {
  for (const std::string name : {"interface_1", "interface_1_whatever_is_asked"})
    EXPECT_GE(held(report_of(library(name) + " octahedron fan:3 --depth 0", 0)), 2 * 6) << name;
}

TEST_F(Versions, AProgramOfVersion1IsAuditedAsItAlwaysWas) {
  EXPECT_GE(held(report_of(kVersion1Program + " octahedron fan:3 --depth 1", 0)), 2 * 12);
}

// Nothing is judged, which is no fault; and nothing is held either. A dart needs edges that stay sharp, which neither
// version 1 can say that it does.
TEST_F(Versions, NoneIsAskedForCatmullClarkOrForSharpEdges) {
  for (const std::string& subject :
       {library("interface_1"), library("interface_1_whatever_is_asked"), kVersion1Program})
    for (const auto& [mesh, why] :
         {std::pair{"quad-cube", "does not subdivide by catmull-clark"},
          {"octahedron --scheme catmull-clark", "does not subdivide by catmull-clark"},
          {"dart:5", "does not do edges that stay sharp"}}) {
      const json report = report_of(subject + " " + mesh + " --depth 0", 2);
      for (const json& row : report["results"]) {
        EXPECT_TRUE(row["status"] == "not-supported" || row["status"] == "not-run") << row;
        if (row["check"] == "tessellates") {
          EXPECT_TRUE(says(row["message"].get<std::string>(), why));
        }
      }
    }
}

// Its channels are judged, and derivatives it was never asked for are no fault.
TEST_F(Versions, ALibraryOfInterface2BeforeDerivativesOfChannelsIsAuditedAsItAlwaysWas) {
  write("quad.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 .5\nv 0 1 0\nvt 0 0\nvt .5 0\nvt .5 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n"
        "t interpolateboundary 1/0/0 1\nt facevaryinginterpolateboundary 1/0/0 1\n");
  const json report = report_of(library("interface_2") + " quad.obj --depth 0", 0);
  int channels = 0;
  for (const json& row : report["results"]) {
    const std::string check = row["check"];
    if (!check.starts_with("channel-")) continue;
    ++channels;
    EXPECT_EQ(row["status"], check == "channel-derivatives" ? "not-supported" : "held") << row;
  }
  EXPECT_EQ(channels, 3);
  EXPECT_GE(held(report), 8);
}

}  // namespace
}  // namespace limitcheck::cli
