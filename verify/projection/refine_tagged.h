// SPDX-License-Identifier: MIT
// Refined control meshes with sharp edges and vertices. Heavy, as sharpness.h is: include from .cpp files.
#pragma once

#include <optional>

#include "reference/mesh/sharpness.h"

namespace limitcheck::verify {

/// Refines a mesh so many times; returns how sharp its edges are then, nothing if it has no tags.
///   refined   of either scheme, made with the tags
template <class Refined>
std::optional<reference::Sharpness> refine_tagged(Refined& refined, const reference::SharpTags& tags,
                                                  int steps) {
  std::optional<reference::Sharpness> sharpness;
  if (!tags.empty()) sharpness.emplace(refined.topology(), tags);
  for (int step = 0; step < steps; ++step) {
    if (!sharpness) {
      refined.refine();
      continue;
    }
    const reference::Topology before = refined.topology();
    refined.refine();
    sharpness = sharpness->refined(before, refined.topology());
  }
  return sharpness;
}

}  // namespace limitcheck::verify
