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
static_assert(offsetof(lc_capabilities, size) == 32 && sizeof(lc_capabilities) == 72);
static_assert(offsetof(lc_mesh, size) == 32 && sizeof(lc_mesh) == 136);
static_assert(offsetof(lc_request, size) == 32 && sizeof(lc_request) == 40);
static_assert(offsetof(lc_tessellation, size) == 64 && sizeof(lc_tessellation) == 96);
// What it added to itself since it was released with 0.2.0 stands behind what it had then.
static_assert(offsetof(lc_capabilities, no_provenance) == 52 && offsetof(lc_mesh, channels) == 120);
static_assert(offsetof(lc_tessellation, channel_values) == 80);

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

}  // namespace
}  // namespace limitcheck::cli
