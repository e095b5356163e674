// SPDX-License-Identifier: MIT
// The sharpnesses that programs tell apart: what meshes for tests draw from, and what an audit counts.
#pragma once

#include <array>
#include <cstddef>

#include "data/sharpness.h"

namespace limitcheck::data {

/// All sharpnesses above `least`, or from it on, up to the next class. The letter stands for `typical` where
/// tags are written as text (generators/star_meshes.h).
struct SharpnessClass {
  char letter;
  const char* name;
  float least;
  bool with_least;
  float typical;
};

/// Ascending. Those from kFirstInfiniteClass on are infinite.
inline constexpr std::array<SharpnessClass, 16> kSharpnessClasses{{
    {'a', "below 1/16", 0, false, 0.015625F},
    {'b', "1/16 to 1", 0.0625F, true, 0.3F},
    {'c', "next below 1", 0x1.fffffep-1F, true, 0x1.fffffep-1F},
    {'A', "1", 1, true, 1},
    {'d', "next above 1", 0x1.000002p0F, true, 0x1.000002p0F},
    {'e', "1 to 2", 0x1.000002p0F, false, 1.7F},
    {'f', "next below 2", 0x1.fffffep0F, true, 0x1.fffffep0F},
    {'B', "2", 2, true, 2},
    {'g', "next above 2", 0x1.000002p1F, true, 0x1.000002p1F},
    {'h', "2 to 4", 0x1.000002p1F, false, 2.6F},
    {'D', "4", 4, true, 4},
    {'k', "4 to 7", 4, false, 5.3F},
    {'m', "7 to 10", 7, true, 8.8F},
    {'n', "next below 10", 0x1.3ffffep3F, true, 0x1.3ffffep3F},
    {'J', "10", 10, true, 10},
    {'K', "above 10", 10, false, 12},
}};
/// From this class on sharpness is for ever.
inline constexpr std::size_t kFirstInfiniteClass = 14;
/// Whether what has a sharpness of this class is still sharp after four steps, and not for ever.
constexpr bool is_long_lasting(std::size_t k) {
  return k < kFirstInfiniteClass && kSharpnessClasses[k].least >= 4 && kSharpnessClasses[k].letter != 'D';
}

/// The class of a sharpness above 0.
constexpr std::size_t sharpness_class(float sharpness) {
  std::size_t k = 0;
  while (k + 1 < kSharpnessClasses.size() &&
         (sharpness > kSharpnessClasses[k + 1].least ||
          (kSharpnessClasses[k + 1].with_least && sharpness == kSharpnessClasses[k + 1].least)))
    ++k;
  return k;
}

/// The sharpness that a letter stands for: those of the table, and A .. I for 1 .. 9; 0 for a dot, and
/// less than 0 for any other.
constexpr float sharpness_of(char letter) {
  if (letter == '.') return 0;
  if (letter >= 'A' && letter <= 'I') return static_cast<float>(letter - 'A' + 1);
  for (const SharpnessClass& c : kSharpnessClasses)
    if (c.letter == letter) return c.typical;
  return -1;
}

}  // namespace limitcheck::data
