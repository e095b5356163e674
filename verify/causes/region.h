// SPDX-License-Identifier: MIT
// Where on a control mesh a surface is wrong, as far as it tells causes apart.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "verify/row/places.h"
#include "verify/row/result.h"

namespace limitcheck::verify {

enum class Region : std::uint8_t {
  kNone,
  kIrregular,      // in faces at extraordinary vertices or at the boundary
  kSharp,          // at sharp edges and vertices
  kDart,           // at the ends of sharp edges only
  kBoundary,       // at boundary vertices only
  kExtraordinary,  // at extraordinary vertices, and those of faces that are no quads, only
  kEverywhere      // in regular places, too
};

/// The regions where a row of positions or normals has something wrong; at least one. A mesh without regular
/// places does not tell what is wrong everywhere from what is wrong at its most ordinary places: then
/// kEverywhere is among them.
std::set<Region> regions(const Result& row);

/// The counts that belong to a region, and those of regular places.
std::vector<PlaceCount> counts_in(const std::vector<PlaceCount>& counts, Region region);

}  // namespace limitcheck::verify
