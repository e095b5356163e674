// SPDX-License-Identifier: MIT
// The parts of `limitcheck reproduce`.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace limitcheck::bench {

/// figure-3, figure-6, figure-7, figure-8, figure-10, figure-13, figure-14.
const std::vector<std::string>& picture_names();

/// One of these as NAME.png in the folder.
void draw_picture(const std::string& name, const std::filesystem::path& folder);

/// Behind Fig. 11 and Fig. 12: for each size of bumpy sphere and each strategy what a frame holds, how many
/// of them per second each engine makes and draws, and their error in pixels. quick: fewer frames.
nlohmann::ordered_json sphere_table(bool quick);

/// `curves`: triangles, frames per second and errors in pixels of uniform depth (from the sphere table) and
/// of the adaptive strategies from coarse to fine settings, with the paper's fans and with stitched borders.
/// `rows`: what each needs for the error that uniform depth 2, 3 or 4 has. quick: three sizes.
nlohmann::ordered_json matched_error_table(const nlohmann::ordered_json& spheres, bool quick);

/// A bumpy sphere tessellated by the combined strategy, triangle by triangle, with depth, kind and the errors
/// at its middle: position in units of the diagonal, interpolated normal in degrees. Numbers of float32 as
/// base 64.
nlohmann::ordered_json model();

/// By name of a control mesh: its limit surface as an indexed mesh of some thousand triangles, float32 and
/// 32-bit integers as base 64, with the control face of each triangle; or `error`, why it cannot be shown.
nlohmann::ordered_json shapes(const std::vector<std::string>& names);

/// The trends T1 to T10 that a reproduction must show: an array of id, statement, held, figures.
nlohmann::ordered_json check_trends(const nlohmann::ordered_json& spheres,
                                    const nlohmann::ordered_json& matched, bool quick);

}  // namespace limitcheck::bench
