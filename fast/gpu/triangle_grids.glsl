// SPDX-License-Identifier: MIT
// Row streaming as a work group for each grid: a row across the lanes, three rows of each level in shared
// memory. Every point of every level is computed once; see fast/stream/kernel/stream-inl.h, whose order and
// bits these are.

#if LOCAL
layout(std430, binding = 3) readonly buffer EdgePoints { float edge_points[]; };  // see triangle_edges.glsl
// Five of each grid: A D, B C, A C, D C, A B; the complement where the edge runs the other way.
layout(std430, binding = 4) readonly buffer EdgeOf { int edge_of[]; };
#endif

const int kA = 0, kB = 1, kC = 2, kD = 3;
int core_width(int corner) { return 5 - corner % 2; }
int block_of(int corner) {  // batches of given_stride grids side by side
  const int kBlock = kWindow + 3 * (5 + 2 * depth);
  int grid = group();
  return ((4 * kBlock + kParts + kInside) * (grid / given_stride) + corner * kBlock) * given_stride + grid % given_stride;
}

// Memory: the windows of the corners, then in their place three rows of each level, points -1 .. 2^level + 1;
// what each level takes from the corners; a row on its way out.
int row_of(int level, int j) {  // point 0 of it
  int length = (1 << level) + 3;
  return 9 * ((1 << level) - 1 + 3 * level) + 3 * ((j + 4) % 3 * length + 1);
}

// Around point i of row m, below s and above n, seen along the row, the column (2) or the diagonal (1).
Hexagon hexagon(int s, int m, int n, int turn) {
  int e = m + 3, ne = n + 3, nw = n, w = m - 3, sw = s - 3, se = s;
  return Hexagon(load(turn == 0 ? e : turn == 1 ? ne : nw), load(turn == 0 ? ne : turn == 1 ? nw : w),
                 load(turn == 0 ? nw : turn == 1 ? w : sw), load(turn == 0 ? w : turn == 1 ? sw : se),
                 load(turn == 0 ? sw : turn == 1 ? se : e), load(turn == 0 ? se : turn == 1 ? e : ne));
}
int axis(int i, int j, int size) {
  return j == 0 || j == size ? 0 : i == 0 || i == size ? 2 : i == j ? 1 : 0;
}

// What a corner's ring has the last word on; below 0: nothing. Where A or C and B or D know the same point, A
// and C.
int border_point(int level, int i, int j) {
  const int a = kBorder * kA, b = kBorder * kB, c = kBorder * kC, d = kBorder * kD, first = 3, last = 6;
  int size = 1 << level, at = -1;
  if (j == -1) at = i == 0 ? a + first : i == size - 1 ? b + last : at;
  if (j == size - 1 && i == -1) at = d + first;
  if (j == 1 && i == size + 1) at = b + first;
  if (j == 0) at = i == -1 ? a + last : i == 0 ? a : i == size ? b : at;
  if (j == size) at = i == size + 1 ? c + last : i == size ? c : i == 0 ? d : at;
  if (j == size + 1) at = i == size ? c + first : i == 1 ? d + last : at;
  return at < 0 ? -1 : BORDERS + 4 * kBorder * level + at;
}

// Row j of a level, from the rows of the level before.
void make_row(int level, int j) {
  int size = 1 << level, row = row_of(level, j);
  for (int i = lane() - 1; i <= size + 1; i += LANES) {
    int border = border_point(level, i, j);
    if (border >= 0) {
      store(row + 3 * i, load(border));
    } else if (level > 0) {
      int k = 3 * (i >> 1);
      int s = row_of(level - 1, (j >> 1) - 1) + k, m = row_of(level - 1, j >> 1) + k;
      int n = row_of(level - 1, (j >> 1) + 1) + k;
      bool even_row = (j & 1) == 0, even = (i & 1) == 0;
      if (even_row && even) {
        store(row + 3 * i, vertex_rule(load(m), hexagon(s, m, n, axis(i >> 1, j >> 1, size >> 1))));
      } else {
        int end = even_row ? m + 3 : even ? n : n + 3;
        int left = even_row ? n + 3 : even ? m - 3 : m + 3, right = even_row ? s : even ? n + 3 : n;
        store(row + 3 * i, edge_rule(load(m), load(end), load(left), load(right)));
      }
    }
  }
}

#if LOCAL
Vertex on_edge(int edge, int k) {
  int e = edge_of[5 * group() + edge];
  int at = 6 * (e < 0 ? ~e * (N + 1) + N - k : e * (N + 1) + k);
  return Vertex(vec3(edge_points[at], edge_points[at + 1], edge_points[at + 2]),
                vec3(edge_points[at + 3], edge_points[at + 4], edge_points[at + 5]));
}
#else
Vertex at_corner(int corner) {
  int block = block_of(corner);
  return Vertex(given_point(block, kLimit), given_point(block, kLimit + 3));
}
#endif

// Row j of the limit points.
void put_row(int j, vec3 centre) {
  for (int i = lane(); i <= N; i += LANES) {
    Vertex v;
    int s = row_of(depth, j - 1) + 3 * i, m = row_of(depth, j) + 3 * i, n = row_of(depth, j + 1) + 3 * i;
#if LOCAL
    if (j == 0) v = on_edge(4, i);
    else if (j == N) v = on_edge(3, i);
    else if (i == 0) v = on_edge(0, j);
    else if (i == N) v = on_edge(1, j);
    else if (i == j) v = on_edge(2, j);
#else
    if (j == 0 && i == 0) v = at_corner(kA);
    else if (j == 0 && i == N) v = at_corner(kB);
    else if (j == N && i == N) v = at_corner(kC);
    else if (j == N && i == 0) v = at_corner(kD);
#endif
    else v = limit_rule(load(m), hexagon(s, m, n, axis(i, j, N)), centre);
    stage(i, v);
  }
  put_staged_row(j);
}

void main() {
  precise vec3 centre = batch_centre.xyz;
  vec3 origin = vec3(0.0);
#if LOCAL
  int own = block_of(4) + kInside * given_stride;
  origin = middle(own, given_point(block_of(kA), kCentre), given_point(block_of(kC), kCentre));
  centre = origin * control_unit + centre;
#endif
  for (int k = lane(); k < 12; k += LANES) {
    int corner = k / 3, c = k % 3;
    refine_corner(block_of(corner), 0, core_width(corner), origin[c], c, k * (5 + 2 * depth),
                  BORDERS + kBorder * corner, 4);
  }
  barrier();
  // Each level needs its rows -1, 0 and 1 before the next one's row 1, and one row for each two of the next: first these
  // of each level, then the rows of the last one in turn, each after the rows of the levels before that it needs.
  for (int last = -depth - 1; last <= N + 1; ++last) {
    bool first = last < 0;
    int level = first ? last + depth + 1 : depth, j = first ? -1 : last;
    int rows = first ? min(3, depth - level + 1) : 1;
    for (; !first && level > 0 && (j & 1) == 0; --level) j = j / 2 + 1;
    for (; level <= depth; level = first ? depth + 1 : level + 1, j = 2 * j - 2) {
      for (int row = j; row < j + rows; ++row) make_row(level, row);
      barrier();
    }
    if (last > 0) put_row(last - 1, centre);
  }
}
