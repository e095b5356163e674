// SPDX-License-Identifier: MIT
// The parts of `limitcheck reproduce`.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace limitcheck::bench {

/// figure-3, figure-8, figure-10, figure-13, figure-14; picture-cracks and picture-error,
/// for the README; picture-sharp, picture-crease.
std::vector<std::string> picture_names();

/// One of these as NAME.png in the folder.
void draw_picture(const std::string& name, const std::filesystem::path& folder);

/// Behind Fig. 11 and Fig. 12: for each size of bumpy sphere and each strategy what a frame holds, how many
/// of them per second each engine makes and draws, and how they look. Times of one thread are processor time,
/// those of all threads time on the wall; each the least of three repetitions, with the spread. `culled`: mean and
/// deviation of the share of faces that thirty spheres of that size cull. quick: fewer frames.
nlohmann::ordered_json sphere_table(bool quick);

/// `curves`: triangles, frames per second and pictures of uniform depth and of the adaptive strategies from
/// coarse to fine settings, with the paper's fans and with stitched borders. `rows`: what each needs to look
/// as good as uniform depth 2, 3 or 4, by each measure, and how far repetitions of its times differed. quick: two
/// sizes.
nlohmann::ordered_json matched_error_table(bool quick);

/// A bumpy sphere tessellated by the combined strategy, triangle by triangle, with depth, kind and the errors
/// at its middle: position in units of the diagonal, interpolated normal in degrees. In few bytes, as base 64.
nlohmann::ordered_json model();

/// By name of a control mesh: its limit surface as an indexed mesh of some thousand triangles, packed as
/// base 64, with the control face of each triangle; or `error`, why it cannot be shown.
nlohmann::ordered_json shapes(const std::vector<std::string>& names);

/// What subjects deliver: an array of title and what model() has, errors at the points of each triangle. Each
/// wanted is SUBJECT[:OPTIONS]@MESH[@DEPTH]; none: a choice of both schemes. Throws data::ArgumentError,
/// verify::SubjectError.
nlohmann::ordered_json maps(std::vector<std::string> wanted);

/// What the text says of time, measured: an array of id, outcome ("as the text says", "not as the text says",
/// "could not be measured", or "depends" of several of which some are one and some the other), figures and series,
/// [{name, unit, at, values}].
nlohmann::ordered_json timings(const nlohmann::ordered_json& spheres, const nlohmann::ordered_json& matched,
                               bool quick);

/// Repetitions that differ by a larger factor have measured nothing; as in bench/report/tables.py.
inline constexpr double kWidest = 1.5;

/// Of a quantity that the text says exceeds a bound, measured with repetitions that differed by a factor
/// `spread`: what their disagreement leaves to be said. The words are those of timings().
const char* outcome(double quantity, double bound, double spread);

/// The system's load average of the last minute, with the time.
double load_average();

}  // namespace limitcheck::bench
