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

/// A bumpy sphere tessellated by the combined strategy, triangle by triangle, with depth, kind and the errors
/// at its middle: position in units of the diagonal, interpolated normal in degrees. Numbers of float32 as
/// base 64.
nlohmann::ordered_json model();

/// The trends T1 to T10 that a reproduction must show: an array of id, statement, held, figures.
nlohmann::ordered_json check_trends(const nlohmann::ordered_json& spheres, bool quick);

}  // namespace limitcheck::bench
