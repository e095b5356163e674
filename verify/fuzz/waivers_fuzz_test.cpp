// SPDX-License-Identifier: MIT
// libFuzzer target: any bytes are either refused as waivers, or can be applied to a report.
#include <cstdint>
#include <string>

#include "data/error.h"
#include "verify/report/known.h"

using namespace limitcheck::verify;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Report report;
  report.subjects = {"naive", "opensubdiv-far:precision=double"};
  for (const std::string& subject : report.subjects)
    for (const char* check : {"tessellates", "positions", "normals"}) {
      Result r;
      r.subject = subject;
      r.mesh = "icosahedron";
      r.check = check;
      r.status = check[0] == 't' ? Status::kHeld : Status::kFinding;
      r.worst = 1e-3;
      report.results.push_back(r);
    }
  try {
    const auto waivers = parse_waivers(std::string(reinterpret_cast<const char*>(data), size));
    apply_waivers(report, waivers, {{report.subjects[1], "3.5"}}, "2026-11-21");
  } catch (const data::ArgumentError&) {
  }
  return 0;
}
