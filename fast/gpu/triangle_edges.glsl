// SPDX-License-Identifier: MIT
// Control edges, one for each work group: a strip of three rows along it, which needs nothing but the rings
// of its two ends; see EdgeStream of fast/stream/kernel/stream-inl.h, whose bits these are.

struct EdgeEnds { int p, p_first, q, q_first, own; };  // see shaders.h
layout(std430, binding = 3) readonly buffer Ends { EdgeEnds ends[]; };

// Memory: the windows of the ends; in their place the strip, two levels in turn; what each level takes from
// the ends.
int kRow = 3 * (N + 2);
int line_of(int level) { return (level & 1) * 3 * kRow + 3; }
int up_of(int level) { return line_of(level) + kRow; }
int down_of(int level) { return up_of(level) + kRow; }
int border_of(int level, int end) { return BORDERS + kBorder * (2 * level + end); }
const int kFirst = 3, kLast = 6;  // of the core of three: before the edge and after it

Hexagon hexagon(int level, int i) {
  int line = line_of(level) + 3 * i, up = up_of(level) + 3 * i, down = down_of(level) + 3 * i;
  return Hexagon(load(line + 3), load(up), load(up - 3), load(line - 3), load(down - 3), load(down));
}

// Points i of the line and of the rows on either side. The ends know what is next to them.
void make_line(int level, int i) {
  int size = 1 << level, k = i >> 1;
  vec3 v;
  if (i == 0 || i == size) v = load(border_of(level, i == 0 ? 0 : 1));
  else {
    Hexagon h = hexagon(level - 1, k);
    vec3 c = load(line_of(level - 1) + 3 * k);
    v = (i & 1) == 0 ? vertex_rule(c, h) : edge_rule(c, h.e, h.ne, h.se);
  }
  store(line_of(level) + 3 * i, v);
}
void make_side(int level, int i, bool up) {
  int size = 1 << level, k = i >> 1;
  int p = border_of(level, 0) + (up ? kLast : kFirst), q = border_of(level, 1) + (up ? kFirst : kLast);
  vec3 v;
  if (level == 0) {
    v = load(p);
  } else if (i == 0 || i == size - 1) {
    v = load(i == 0 ? p : q);
  } else {
    int line = line_of(level - 1) + 3 * k, side = (up ? up_of(level - 1) : down_of(level - 1)) + 3 * k;
    bool even = (i & 1) == 0;
    int near = even ? line : line + 3, far = even ? line + 3 : line;
    v = edge_rule(load(near), load(side), load(far), load(even ? side - 3 : side + 3));
  }
  store((up ? up_of(level) : down_of(level)) + 3 * i, v);
}

void main() {
  EdgeEnds end = ends[group()];
  precise vec3 centre = batch_centre.xyz;
  vec3 origin = vec3(0.0);
#if LOCAL
  origin = middle(end.own, given_point(end.p, kCentre), given_point(end.q, kCentre));
  centre = origin * control_unit + centre;
#endif
  for (int k = lane(); k < 6; k += LANES) {
    int c = k % 3;
    refine_corner(k < 3 ? end.p : end.q, k < 3 ? end.p_first : end.q_first, 3, origin[c], c, k * (3 + 2 * depth),
                  border_of(0, k / 3), 2);
  }
  barrier();
  for (int level = 0; level <= depth; ++level) {
    for (int i = lane(); i <= 1 << level; i += LANES) {
      make_line(level, i);
      if (i < 1 << level) make_side(level, i, true), make_side(level, i, false);
    }
    barrier();
  }
  for (int i = lane(); i <= N; i += LANES) {
    Vertex v;
    if (i == 0 || i == N) {
      int block = i == 0 ? end.p : end.q;
      v = Vertex(given_point(block, kLimit), given_point(block, kLimit + 3));
    } else {
      v = limit_rule(load(line_of(depth) + 3 * i), hexagon(depth, i), centre);
    }
    put(first_vertex(N + 1) + i, v);
  }
}
