// SPDX-License-Identifier: MIT
// data/known_masks.json: limit and tangent masks of either scheme, computed outside this project.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "data/numeral.h"
#include "reference/number/number_exact.h"
#include "reference/number/vec3.h"

namespace limitcheck::reference {

struct KnownMask {
  enum class Kind { kSmooth, kBoundary, kDart } kind;
  int faces;
  std::vector<Decimal100> limit, first, second;  ///< of the centre, the ring from e_0 on, the far corners
};

inline std::vector<KnownMask> known_masks(const std::string& scheme) {
  std::ifstream stream(LIMITCHECK_SOURCE_DIR "/data/known_masks.json");
  std::vector<KnownMask> result;
  const nlohmann::json all = nlohmann::json::parse(stream);
  for (const auto& one : all.at("masks")) {
    if (one.at("scheme") != scheme) continue;
    const auto weights = [&](const char* key) {
      std::vector<Decimal100> list;
      for (const auto& w : one.at(key)) list.push_back(data::parse<Decimal100>(w.get<std::string>()));
      return list;
    };
    const char first = one.at("vertex").get<std::string>()[0];
    const bool boundary = first == 'c', dart = first == 'd';
    const auto& count = one.at(boundary ? "K" : "valence");
    result.push_back({dart       ? KnownMask::Kind::kDart
                      : boundary ? KnownMask::Kind::kBoundary
                                 : KnownMask::Kind::kSmooth,
                      count.is_string() ? std::stoi(count.get<std::string>()) : count.get<int>(),
                      weights("limit"),
                      weights(dart       ? "symmetric"
                              : boundary ? "along"
                                         : "t1"),
                      weights(dart       ? "antisymmetric"
                              : boundary ? "across"
                                         : "t2")});
  }
  return result;
}

/// Compares the masks of a vertex with known ones to 40 digits; tangents up to a factor, which is positive
/// but at darts.
///   evaluate   takes points (of the centre, the ring, the far corners) to limit, first and second tangent
template <class Evaluate>
void expect_masks(const KnownMask& known, Evaluate&& evaluate) {
  using N = Decimal100;
  const std::string what = std::to_string(static_cast<int>(known.kind)) + ", " + std::to_string(known.faces);
  std::array<std::vector<N>, 3> ours;
  for (std::size_t i = 0; i < known.limit.size(); ++i) {
    std::vector<Vec3<N>> points(known.limit.size());
    points[i].x = N(1);
    const std::array<Vec3<N>, 3> values = evaluate(points);
    for (std::size_t m = 0; m < 3; ++m) ours[m].push_back(values[m].x);
  }
  const std::array<const std::vector<N>*, 3> theirs{&known.limit, &known.first, &known.second};
  for (std::size_t m = 0; m < 3; ++m) {
    std::size_t largest = 0;
    for (std::size_t i = 0; i < ours[m].size(); ++i)
      if (magnitude((*theirs[m])[i]) > magnitude((*theirs[m])[largest])) largest = i;
    const N factor = m == 0 ? N(1) : N(ours[m][largest] / (*theirs[m])[largest]);
    if (known.kind != KnownMask::Kind::kDart) {
      EXPECT_GT(factor, N(0)) << what;
    }
    for (std::size_t i = 0; i < ours[m].size(); ++i)
      EXPECT_LE(magnitude(ours[m][i] - (*theirs[m])[i] * factor), N("1e-40") * (N(1) + magnitude(factor)))
          << what << " mask " << m << " weight " << i;
  }
}

}  // namespace limitcheck::reference
