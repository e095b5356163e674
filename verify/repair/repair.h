// SPDX-License-Identifier: MIT
// A mesh as scanners and modelling programs leave it, made into one that can be subdivided.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "data/io/polygon_soup.h"

namespace limitcheck::verify {

struct RepairOptions {
  bool weld = false;  // vertices that lie at exactly the same place become one: seams close
  // Besides, border vertices that lie at most so many diagonals of the bounding box apart, or are connected by others
  // that do, become the first of them. Only where `weld` is set.
  double weld_distance = 0;
};

/// What was done, one line for each kind of change: "dropped 3 faces with a repeated corner".
struct Repaired {
  data::io::PolygonSoup soup;  // polygons stay polygons; without lines
  std::vector<std::string> changes;
};

/// In this order: drops faces that name no existing vertex, have fewer than three corners, a repeated corner
/// or a vertex that is not finite; welds, if asked to; drops all but the first of faces with the same
/// corners; gives faces that share an edge the same orientation, and cuts the mesh apart where that cannot
/// be, along edges of three faces or more and at vertices where fans touch (CGAL, Polygon_mesh_processing);
/// drops vertices that no face names; removes interior vertices of two faces, which become one face. It moves
/// no vertex and fills no hole, and does not turn a whole component inside out. Channels stay if all faces do, corner
/// by corner; else they are dropped.
Repaired repair(const data::io::PolygonSoup& soup, const RepairOptions& options = {});

}  // namespace limitcheck::verify
