// SPDX-License-Identifier: MIT
// The parts of `limitcheck reproduce`.
#pragma once

#include <filesystem>

namespace limitcheck::bench {

/// Figures 10, 13 and 14 as PNG files; their names are printed.
void draw_pictures(const std::filesystem::path& folder);

}  // namespace limitcheck::bench
