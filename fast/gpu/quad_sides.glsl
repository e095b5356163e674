// SPDX-License-Identifier: MIT
// Sides of quads, one for each work group, from three rows along them: QuadSideStream of quad_side-inl.h.

// Memory: the windows of the two corners; in their place the three rows, two levels in turn; what each level
// takes from the corners; the side as a polynomial.
int kRow = 3 * (N + 3);
int row_of(int level, int j) { return ((level & 1) * 3 + j + 1) * kRow + 3; }

// What the rings of the ends own; below 0: nothing.
int border_point(int level, int i, int j) {
  int size = 1 << level, at = -1;
  const int q = kBorder;
  if (j == -1) at = i == 0 ? 3 : i == 1 ? 6 : at;
  if (j == 0) at = i == -1 ? 21 : i == 0 ? 0 : i == 1 ? 9 : at;
  if (j == 1) at = i == -1 ? 18 : i == 0 ? 15 : i == 1 ? 12 : at;
  if (j == -1) at = i == size - 1 ? q + 18 : i == size ? q + 21 : at;
  if (j == 0) at = i == size - 1 ? q + 15 : i == size ? q : i == size + 1 ? q + 3 : at;
  if (j == 1) at = i == size - 1 ? q + 12 : i == size ? q + 9 : i == size + 1 ? q + 6 : at;
  return at < 0 ? -1 : BORDERS + 2 * kBorder * (level - 1) + at;
}

void make_point(int level, int i, int j, bool is_sharp_line) {
  int border = border_point(level, i, j), to = row_of(level, j) + 3 * i;
  if (border >= 0) {
    store(to, load(border));
  } else if (level > 1 && i >= 2) {
    vec3 across[3];
    for (int k = 0; k < 3; ++k) {
      int x = 3 * ((i >> 1) + k - 1);
      vec3 s = load(row_of(level - 1, -1) + x), m = load(row_of(level - 1, 0) + x);
      vec3 n = load(row_of(level - 1, 1) + x);
      across[k] = j < 0 ? child(m, s, m, true, false) : child(s, m, n, j > 0, is_sharp_line);
    }
    store(to, child(across[0], across[1], across[2], (i & 1) != 0, false));
  }
}

void main() {
  int at = begin_of(group() / sides), p = group() % sides, q = (p + 1) % 4;
  precise vec3 centre = batch_centre.xyz;
  vec3 origin = vec3(0.0);
#if LOCAL
  origin = middle(own(at, p), corner_point(at, p), corner_point(at, q));
  centre = origin * control_unit + centre;
#endif
  bool sharp_side = is_sharp(at, p), polynomial = is_polynomial(at, p);
  for (int k = lane(); k < 6; k += LANES)
    refine_corner(at, k < 3 ? p : q, origin[k % 3], k % 3, k * kWidth, BORDERS + kBorder * (k / 3), 2);
  if (polynomial && lane() < 4) make_side_curve_point(at, p, q, STAGED, lane());
  barrier();
  if (polynomial && lane() < 4) make_curve_difference(STAGED, lane());
  for (int level = 1; level <= depth; ++level) {
    for (int k = lane(); k < 3 * ((1 << level) + 3); k += LANES) make_point(level, k / 3 - 1, k % 3 - 1, sharp_side);
    barrier();
  }
  for (int i = lane(); i <= N; i += LANES) {
    int m = row_of(depth, 0) + 3 * i;
    Vertex v;
    if (i == 0 || i == N) v = at_corner(at, i == 0 ? p : q);
    else if (polynomial) v = curve_point(STAGED, i);
    else v = line_limit(ivec3(m - 3, m, m + 3), -kRow, kRow, sharp_side, true, centre);
    put(first_vertex(N + 1) + i, v);
  }
}
