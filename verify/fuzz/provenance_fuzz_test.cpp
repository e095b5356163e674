// SPDX-License-Identifier: MIT
// libFuzzer target: any bytes are either refused as a table of provenance, or name points that are there.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "data/error.h"
#include "data/shapes.h"
#include "verify/files/read/provenance.h"

using namespace limitcheck;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  constexpr std::int64_t kVertices = 100, kFaces = 20;
  static const data::ControlMesh control = data::icosahedron();
  try {
    for (const verify::ProvenanceRow& row :
         verify::parse_provenance({reinterpret_cast<const char*>(bytes), size}, "input", kVertices, control,
                                  data::Scheme::kLoop)) {
      const auto& l = row.at.l;
      const bool inside = l[0] >= 0 && l[1] >= 0 && l[2] >= 0 && std::abs(l[0] + l[1] + l[2] - 1) <= 1e-15;
      if (row.vertex < 0 || row.vertex >= kVertices || row.at.face < 0 || row.at.face >= kFaces || !inside)
        std::abort();
    }
  } catch (const data::InputError&) {
  }
  return 0;
}
