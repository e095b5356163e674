// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the polygons and their tags, a repair ends in a mesh without faults that a second one
// leaves as it is.
#include <fuzzer/FuzzedDataProvider.h>

#include <cstdio>
#include <cstdlib>

#include "verify/repair/test_repair_properties.h"

using namespace limitcheck;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider bytes(data, size);
  data::io::PolygonSoup soup;
  const bool weld = bytes.ConsumeBool();
  const double distance = bytes.ConsumeIntegralInRange(0, 40) / 400.0;
  const int vertices = bytes.ConsumeIntegralInRange(1, 40);
  const int places = bytes.ConsumeIntegralInRange(1, vertices);  // fewer: some vertices lie at one place
  for (int v = 0; v < vertices; ++v) {
    const double x = v % places;
    soup.positions.push_back({x, x * x, x * x * x});
  }
  const auto vertex = [&] { return bytes.ConsumeIntegralInRange<std::int64_t>(-1, vertices); };
  for (int tags = bytes.ConsumeIntegralInRange(0, 12); tags > 0; --tags)
    soup.sharp.push_back({vertex(), vertex(), bytes.ConsumeIntegralInRange(-1, 44) / 4.0, 0});
  while (bytes.remaining_bytes() > 0) {
    for (int n = bytes.ConsumeIntegralInRange(0, 7); n > 0; --n) soup.corners.push_back(vertex());
    soup.close_polygon();
  }
  const std::string broken = verify::broken_property(soup, {.weld = weld, .weld_distance = distance});
  if (!broken.empty()) {
    std::fprintf(stderr, "%s\n", broken.c_str());
    std::abort();
  }
  return 0;
}
