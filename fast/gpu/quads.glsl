// SPDX-License-Identifier: MIT
// Row streaming of quads of any valences, a work group for each: quad_stream-inl.h, whose bits these are, but
// that from depth 5 on the processor takes the limits inside from the level before.

#if LOCAL
layout(std430, binding = 3) readonly buffer SidePoints { float side_points[]; };  // four of each quad
#endif

// Memory: the windows of the corners, then in their place three rows of each level from 1 on, points -1 ..
// 2^level + 1; what each level takes from the corners; a row on its way out; the sides as polynomials.
int kCurves = STAGED + 6 * (N + 1);
const int kAB = 0, kBC = 1, kCD = 2, kDA = 3, kA = 0, kB = 1, kC = 2, kD = 3;
int row_of(int level, int j) {  // point 0 of it
  int length = (1 << level) + 3;
  return 9 * ((1 << level) - 2 + 3 * (level - 1)) + 3 * ((j + 4) % 3 * length + 1);
}

// What a corner's ring has the last word on; below 0: nothing. e-: 3, f-: 6, e: 9, f: 12, e': 15, f': 18,
// e'': 21.
int border_point(int level, int i, int j) {
  const int a = 0, b = kBorder, c = 2 * kBorder, d = 3 * kBorder;
  int size = 1 << level, at = -1;
  if (j == -1) at = i == size - 1 ? b + 18 : i == size ? b + 21 : i == 0 ? a + 3 : i == 1 ? a + 6 : at;
  if (j == 0) {
    at = i == -1 ? a + 21 : i == 0 ? a : i == 1 ? a + 9 : at;
    at = i == size - 1 ? b + 15 : i == size ? b : i == size + 1 ? b + 3 : at;
  }
  if (j == 1) {
    at = i == -1 ? a + 18 : i == 0 ? a + 15 : i == 1 ? a + 12 : at;
    at = i == size - 1 ? b + 12 : i == size ? b + 9 : i == size + 1 ? b + 6 : at;
  }
  if (j == size - 1) {
    at = i == -1 ? d + 6 : i == 0 ? d + 9 : i == 1 ? d + 12 : at;
    at = i == size - 1 ? c + 12 : i == size ? c + 15 : i == size + 1 ? c + 18 : at;
  }
  if (j == size) {
    at = i == -1 ? d + 3 : i == 0 ? d : i == 1 ? d + 15 : at;
    at = i == size - 1 ? c + 9 : i == size ? c : i == size + 1 ? c + 21 : at;
  }
  if (j == size + 1) at = i == size - 1 ? c + 6 : i == size ? c + 3 : i == 0 ? d + 21 : i == 1 ? d + 18 : at;
  return at < 0 ? -1 : BORDERS + 4 * kBorder * (level - 1) + at;
}

// Row j of a level, from the rows of the level before: across a row first and then along it, but along a
// column next to the sides B C and D A, whose points are seen from there.
void make_row(int at, int level, int j) {
  int size = 1 << level, row = row_of(level, j), parents = size >> 1;
  for (int i = lane() - 1; i <= size + 1; i += LANES) {
    int border = border_point(level, i, j);
    if (border >= 0) {
      store(row + 3 * i, load(border));
    } else if (level > 1) {
      bool column = i <= 1 || i >= size - 1, odd_row = (j & 1) != 0;
      int x = column ? (i <= 1 ? 0 : parents) : i >> 1, beside = column ? i - 2 * x : 0;
      bool between = column ? beside != 0 : odd_row;
      bool sharp_line = column ? is_sharp(at, x == 0 ? kDA : kBC)
                               : j == 0 ? is_sharp(at, kAB) : j == size ? is_sharp(at, kCD) : false;
      int from[3] = int[3](row_of(level - 1, (j >> 1) - 1), row_of(level - 1, j >> 1),
                           row_of(level - 1, (j >> 1) + 1));
      vec3 across[3];
      for (int k = 0; k < 3; ++k) {
        if (column) {
          int here = from[k] + 3 * x, on = beside < 0 ? -3 : 3;
          across[k] = child(load(here - on), load(here), load(here + on), between, sharp_line);
        } else {
          int y = 3 * (x + k - 1);
          across[k] = child(load(from[0] + y), load(from[1] + y), load(from[2] + y), between, sharp_line);
        }
      }
      store(row + 3 * i, child(across[0], across[1], across[2], column ? odd_row : (i & 1) != 0, false));
    }
  }
}

void put_row(int at, int j, vec3 centre) {
  for (int i = lane(); i <= N; i += LANES) {
    int side = j == 0 ? kAB : j == N ? kCD : i == N ? kBC : i == 0 ? kDA : -1;
    int k = side == kAB ? i : side == kBC ? j : side == kCD ? N - i : N - j;  // from its beginning
    Vertex v;
    if ((i == 0 || i == N) && (j == 0 || j == N)) {
      v = at_corner(at, j == 0 ? (i == 0 ? kA : kB) : (i == 0 ? kD : kC));
#if LOCAL
    } else if (side >= 0) {
      int from = 6 * ((4 * group() + side) * (N + 1) + k);
      v = Vertex(vec3(side_points[from], side_points[from + 1], side_points[from + 2]),
                 vec3(side_points[from + 3], side_points[from + 4], side_points[from + 5]));
#else
    } else if (side >= 0 && is_polynomial(at, side)) {
      v = curve_point(kCurves + kCurve * side, k);
#endif
    } else {
      int s = row_of(depth, j - 1) + 3 * i, m = row_of(depth, j) + 3 * i, n = row_of(depth, j + 1) + 3 * i;
      bool column = side == kBC || side == kDA, is_sharp_line = side >= 0 && is_sharp(at, side);
      v = line_limit(column ? ivec3(s, m, n) : ivec3(m - 3, m, m + 3), column ? 3 : s - m, column ? -3 : n - m,
                     is_sharp_line, side == kAB || side == kBC, centre);
    }
    stage(i, v);
  }
  put_staged_row(j);
}

void main() {
  int at = begin_of(group());
  precise vec3 centre = batch_centre.xyz;
  vec3 origin = vec3(0.0);
#if LOCAL
  origin = middle(own(at, kInside), corner_point(at, kA), corner_point(at, kC));
  centre = origin * control_unit + centre;
#else
  int side = lane() / 4, curve = kCurves + kCurve * side;
  bool has_curve = depth > 0 && side < 4 && is_polynomial(at, side);
  if (has_curve) make_side_curve_point(at, side, (side + 1) % 4, curve, lane() % 4);
#endif
  for (int k = lane(); k < 12; k += LANES)
    refine_corner(at, k / 3, origin[k % 3], k % 3, k * kWidth, BORDERS + kBorder * (k / 3), 4);
  barrier();
#if !LOCAL
  if (has_curve) make_curve_difference(curve, lane() % 4);
#endif
  // Each level needs its rows -1 .. 1 before the next one's row 1, level 1 has all five from the corners; then the rows of
  // the last one in turn, each after the rows of the levels before that it needs.
  for (int last = -depth; last <= N + 1; ++last) {
    bool first = last < 0;
    int level = first ? last + depth + 1 : depth, j = first ? -1 : last;
    int rows = first ? min(3, depth - level + 1) : 1;
    for (; !first && level > 1 && (j & 1) == 0; --level) j = j / 2 + 1;
    for (; level >= 1 && level <= depth; level = first ? depth + 1 : level + 1, j = 2 * j - 2) {
      for (int row = j; row < j + rows; ++row) make_row(at, level, row);
      barrier();
    }
    if (last > 0) put_row(at, last - 1, centre);
    if (depth == 0) barrier();  // where no rows are made between two that are staged
  }
}
