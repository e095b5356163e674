// SPDX-License-Identifier: MIT
// The parts of `limitcheck reproduce`.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace limitcheck::bench {

/// Figures 3, 6, 7, 8, 10, 13 and 14 as PNG files; their names are printed.
void draw_pictures(const std::filesystem::path& folder);

/// Behind Fig. 11 and Fig. 12: for each size of bumpy sphere and each strategy what a frame holds, how many
/// of them per second each engine makes and draws, and their error in pixels. quick: fewer frames.
nlohmann::ordered_json sphere_table(bool quick);

/// The trends T1 to T10 that a reproduction must show: an array of id, statement, held, figures.
nlohmann::ordered_json check_trends(const nlohmann::ordered_json& spheres, bool quick);

}  // namespace limitcheck::bench
