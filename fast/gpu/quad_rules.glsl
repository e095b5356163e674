// SPDX-License-Identifier: MIT
// Catmull-Clark's rules, times 4 per level, one corner through all levels, and sides: quad_rules-inl.h and
// quad_side-inl.h.

const int kCentre = 5, kEdges = 8, kFaces = 11, kLimit = 14, kEnds = 20, kWindow = 22;  // QuadCornerBlock
int kWidth = 7 + 4 * depth, kBlock = kWindow + 3 * kWidth;
// Of a corner and level: c, then seven entries of the ring, e- f- e f e' f' e''.
const int kBorder = 24;

// Where what is given of a quad or side begins: batches of given_stride lie side by side, quad_input_size(depth) numbers each.
int begin_of(int number) {
  int size = max(4 * kBlock + 8 + 4 * (1 + 3 * depth) + kParts, 72);
  return number / given_stride * size * given_stride + number % given_stride;
}
// Of the quad or side that begins at `at`.
int block_of(int at, int corner) { return corner * kBlock * given_stride + at; }
bool flag(int at, int bits, int k, int number) {
  return (bits >> k & 1) != 0 && given[(number + k) * given_stride + at] != 0.0;
}
bool is_sharp(int at, int side) { return flag(at, sharp, side, 4 * kBlock); }
bool is_polynomial(int at, int side) { return flag(at, some_polynomial, side, 4 * kBlock + 4); }
float dart_number(int at, int corner, int k) {
  return given[(4 * kBlock + 8 + corner * (1 + 3 * depth) + k) * given_stride + at];
}
int own(int at, int part) { return (4 * kBlock + 8 + 4 * (1 + 3 * depth) + part) * given_stride + at; }
// Entry 0 .. 7 of a corner's ring, from e- on, as it lies in a window.
int ring_entry(int corner, int core) {
  int whole = period[corner];
  return whole == 0 ? 2 * depth + core : core >= whole ? core - whole : core;
}
vec3 corner_point(int at, int corner) { return given_point(block_of(at, corner), kCentre); }
Vertex at_corner(int at, int corner) {
  int block = block_of(at, corner);
  return Vertex(given_point(block, kLimit), given_point(block, kLimit + 3));
}

// Three points in a row: the child of the middle one, or of it and the next.
vec3 child(vec3 a, vec3 b, vec3 c, bool between, bool is_sharp_line) {
  precise vec3 next = b + c;
  precise vec3 even = 0.25 * ((a + b) + next) + b;
  return between ? next : is_sharp_line ? b + b : even;
}
vec3 limit_filter(vec3 a, vec3 b, vec3 c) {
  precise vec3 sum = 4.0 * b + (a + c);
  return sum;
}

// Coordinate c of a corner from level 0 to depth, in memory from `window` on; what levels 1 .. depth take
// from it is kept from `border` on, `corners` blocks to a level.
void refine_corner(int at, int corner, float origin, int c, int window, int border, int corners) {
  int block = block_of(at, corner), whole = period[corner], entries = whole > 0 ? whole : kWidth;
  precise float k[5];
  for (int i = 0; i < 5; ++i) k[i] = given[block + i * given_stride];
  precise float v = given[block + (kCentre + c) * given_stride] - origin;
  precise float de = given[block + (kEdges + c) * given_stride];
  precise float df = given[block + (kFaces + c) * given_stride];
  for (int t = 0; t < entries; ++t) {
    precise float entry = given[block + (kWindow + 3 * t + c) * given_stride] - origin;
    memory[window + t] = entry;
  }
  bool is_open = (open >> corner & 1) != 0;
  int start = is_open ? int(given[block + kEnds * given_stride]) : -1;
  int stop = is_open ? int(given[block + (kEnds + 1) * given_stride]) : -1;
  bool dart = (darts >> corner & 1) != 0 && dart_number(at, corner, 0) != 0.0;
  for (int level = 0; level < depth; ++level, border += kBorder * corners) {
    int first = whole > 0 ? 0 : 2 * level, end = whole > 0 ? whole : kWidth - 2 * level;
    precise float here = memory[window + first];
    for (int t = window + first + 1; t + 1 < window + end; t += 2) {
      precise float after = memory[t + 1];
      precise float face = (v + memory[t]) + (here + after);
      memory[t] = face;
      here = after;
    }
    precise float before = memory[window + first + 1];
    if (whole > 0) {
      before = (v + memory[window + end - 1]) + (here + memory[window + first]);
      memory[window + end - 1] = before;
    }
    for (int t = whole > 0 ? first : first + 2; t + 1 < end; t += 2) {
      precise float e = memory[window + t], f = memory[window + t + 1];
      precise float refined = 0.25 * (before + f) + (v + e);
      if (t == start || t == stop) refined = 2.0 * (v + e);
      memory[window + t] = refined;
      before = f;
    }
    precise float moved = 4.0 * v;
    if (dart)
      moved = moved + dart_number(at, corner, 1 + 3 * level + c);
    else
      moved = k[1] * df + (k[0] * de + moved);
    v = moved;
    precise float both = k[2] * de;
    de = k[3] * df + both;
    df = k[4] * df + both;
    memory[border + c] = v;
    for (int core = 0; core < 7; ++core)
      memory[border + 3 * (core + 1) + c] = memory[window + ring_entry(corner, core)];
  }
}

// A side as a polynomial (QuadCurve): number k of its four points, from the three control points that lie right of the
// side, on it and left of it; and after a barrier their differences.
const int kCurve = 36, kAlong = 12, kAcross = 21, kOrigin = 33;
void make_curve_point(vec3 r, vec3 m, vec3 l, vec3 origin, int curve, int k) {
  precise vec3 right = r - origin, here = m - origin, left = l - origin, across = left - right;
  store(curve + 3 * k, limit_filter(right, here, left));
  store(curve + kAcross + 3 * k, across);
  precise vec3 there = origin * control_unit + batch_centre.xyz;
  if (k == 0) store(curve + kOrigin, there);
}
void make_curve_difference(int curve, int k) {
  precise vec3 along = load(curve + 3 * k + 3) - load(curve + 3 * k);
  if (k < 3) store(curve + kAlong + 3 * k, along);
}
vec3 blend(int at, float w0, float w1, float w2, float w3) {
  precise vec3 sum = (w0 * load(at) + w3 * load(at + 9)) + (w1 * load(at + 3) + w2 * load(at + 6));
  return sum;
}
// Its point k of N. The weights are exact to depth 7.
Vertex curve_point(int curve, int k) {
  precise float t = float(k) * (1.0 / float(N)), u = 1.0 - t;
  precise float w0 = u * u * u, w3 = t * t * t;
  precise float w1 = 4.0 + t * t * (3.0 * t - 6.0), w2 = 4.0 + u * u * (3.0 * u - 6.0);
  precise float b0 = u * u, b1 = 1.0 + 2.0 * (t * u), b2 = t * t;
  precise vec3 position = blend(curve, w0, w1, w2, w3) * batch_centre.w + load(curve + kOrigin);
  int at = curve + kAlong;
  precise vec3 along = (b0 * load(at) + b2 * load(at + 6)) + b1 * load(at + 3);
  return Vertex(position, unit_normal(along, blend(curve + kAcross, w0, w1, w2, w3)));
}
// Of a side of a streamed quad from corner p to q, which the 12 points around it are; digit k of `cores`: the entry of the
// ring, 8 for the corner itself.
vec3 point_beside(int at, int p, int q, int k, int cores) {
  int corner = k < 2 ? p : q, core = cores >> 4 * k & 15;
  return given_point(block_of(at, corner), core == 8 ? kCentre : kWindow + 3 * ring_entry(corner, core));
}
void make_side_curve_point(int at, int p, int q, int curve, int k) {
  make_curve_point(point_beside(at, p, q, k, 0x7607), point_beside(at, p, q, k, 0x0886),
                   point_beside(at, p, q, k, 0x1245), middle(corner_point(at, p), corner_point(at, q)), curve, k);
}

// A limit from 3 x 3 points: of those on a line the one before it, itself and the one after it, and how far from each lie
// its neighbours right and left of the line; beyond a sharp line is nothing, and the inside is left or right.
Vertex line_limit(ivec3 line, int right_of, int left_of, bool is_sharp_line, bool inside_left, vec3 centre) {
  precise vec3 p[3], q[3];
  for (int k = 0; k < 3; ++k) {
    precise vec3 right = load(line[k] + right_of), here = load(line[k]), left = load(line[k] + left_of);
    p[k] = limit_filter(right, here, left);
    q[k] = left - right;
    if (is_sharp_line) {
      p[k] = 6.0 * here;
      q[k] = 2.0 * (inside_left ? left - here : here - right);
    }
  }
  precise vec3 position = limit_filter(p[0], p[1], p[2]) * limit_unit + centre;
  precise vec3 along = p[2] - p[0];
  return Vertex(position, unit_normal(along, limit_filter(q[0], q[1], q[2])));
}
