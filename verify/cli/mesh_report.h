// SPDX-License-Identifier: MIT
// What `check` and `repair` both print.
#pragma once

#include <string>
#include <vector>

#include "data/io/polygon_soup.h"

namespace limitcheck::cli {

/// All faults to standard output, a line for each.
void print_faults(const std::string& file, const data::io::PolygonSoup& soup,
                  const std::vector<data::io::SoupFault>& faults);

}  // namespace limitcheck::cli
