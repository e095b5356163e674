// SPDX-License-Identifier: MIT
// Loop's rules on the regular lattice, times 8 per level, and one corner through all levels: rules-inl.h and
// rows-inl.h.

const int kCentre = 2, kDifference = 5, kLimit = 8, kWindow = 14;  // CornerBlock
const int kBorder = 9;  // of a corner and level: centre, first and last entry of the core
struct Hexagon { vec3 e, ne, nw, w, sw, se; };  // seen along the axis: e ahead, w behind

vec3 edge_rule(vec3 a, vec3 b, vec3 c, vec3 d) {
  precise vec3 sum = 3.0 * (a + b) + (c + d);
  return sum;
}
vec3 vertex_rule(vec3 v, Hexagon h) {
  precise vec3 sum = 5.0 * v + 0.5 * ((h.e + h.w) + ((h.ne + h.nw) + (h.sw + h.se)));
  return sum;
}

// Position and unit normal of a regular point.
Vertex limit_rule(vec3 v, Hexagon h, vec3 centre) {
  precise vec3 north = h.ne + h.nw, south = h.sw + h.se;
  precise vec3 position = (6.0 * v + ((h.e + h.w) + (north + south))) * limit_unit + centre;
  precise vec3 slant = (h.e - h.w) + (h.ne - h.sw), across = north - south;
  return Vertex(position, unit_normal(slant, across));
}

// Coordinate c of a corner: its window, `first` entries further on and core + 2 depth wide, shrinks in memory
// from `window` on; what each level takes from it is kept from `border` on, `corners` blocks to a level.
void refine_corner(int block, int first, int core, float origin, int c, int window, int border, int corners) {
  precise float k0 = given[block], k1 = given[block + given_stride];
  precise float v = given[block + (kCentre + c) * given_stride];
  precise float d = given[block + (kDifference + c) * given_stride];
  int width = core + 2 * depth;
#if LOCAL
  v = v - origin;
#endif
  for (int t = 0; t < width; ++t) {
    precise float entry = given[block + (kWindow + 3 * (first + t) + c) * given_stride];
#if LOCAL
    entry = entry - origin;
#endif
    memory[window + t] = entry;
  }
  for (int level = 0;; ++level, border += kBorder * corners) {
    memory[border + c] = v;
    memory[border + 3 + c] = memory[window + depth - level];
    memory[border + 6 + c] = memory[window + depth - level + core - 1];
    if (level == depth) return;
    width -= 2;
    precise float before = memory[window], here = memory[window + 1];
    for (int t = 0; t < width; ++t) {
      precise float after = memory[window + t + 2];
      precise float entry = 3.0 * (v + here) + (before + after);
      memory[window + t] = entry;
      before = here;
      here = after;
    }
    v = k0 * d + 8.0 * v;
    d = k1 * d;
  }
}
