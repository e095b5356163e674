// SPDX-License-Identifier: MIT
#include "verify/causes/region.h"

#include <algorithm>

namespace limitcheck::verify {
namespace {

// The region that a kind of place is part of.
Region region_of(PlaceKind kind) {
  switch (kind) {
    case PlaceKind::kRegularFace:
    case PlaceKind::kRegularVertex:
      return Region::kEverywhere;
    case PlaceKind::kBoundaryFace:
    case PlaceKind::kIrregularFace:
      return Region::kIrregular;
    case PlaceKind::kBoundaryVertex:
      return Region::kBoundary;
    case PlaceKind::kExtraordinaryVertex:
    case PlaceKind::kPolygonVertex:
      return Region::kExtraordinary;
    case PlaceKind::kDart:
      return Region::kDart;
    default:
      return Region::kSharp;
  }
}

}  // namespace

std::set<Region> regions(const Result& row) {
  std::set<Region> found;
  for (const PlaceCount& c : row.places)
    if (c.bad > 0) found.insert(region_of(c.kind));
  if (found.empty() || found.contains(Region::kEverywhere)) return {Region::kEverywhere};
  // Where nothing regular was looked at, what is wrong at the most ordinary places may be wrong everywhere.
  const auto looked_at =
      std::find_if(row.places.begin(), row.places.end(), [](const PlaceCount& c) { return c.of > 0; });
  const bool perhaps = looked_at != row.places.end() && region_of(looked_at->kind) != Region::kEverywhere &&
                       found.contains(region_of(looked_at->kind));
  // What is wrong in the faces round a vertex is wrong at the vertex for the same reason.
  if (found.contains(Region::kIrregular)) {
    found.erase(Region::kBoundary);
    found.erase(Region::kExtraordinary);
  }
  if (found.contains(Region::kSharp)) found.erase(Region::kDart);
  if (perhaps) found.insert(Region::kEverywhere);
  return found;
}

std::vector<PlaceCount> counts_in(const std::vector<PlaceCount>& counts, Region region) {
  if (region == Region::kEverywhere) return counts;
  std::vector<PlaceCount> inside;
  for (const PlaceCount& c : counts) {
    const Region own = region_of(c.kind);
    if (own == region || own == Region::kEverywhere ||
        (region == Region::kIrregular && (own == Region::kBoundary || own == Region::kExtraordinary)) ||
        (region == Region::kSharp && own == Region::kDart))
      inside.push_back(c);
  }
  return inside;
}

}  // namespace limitcheck::verify
