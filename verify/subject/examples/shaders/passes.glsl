// SPDX-License-Identifier: MIT
// The second form: compute passes. Catmull and Clark's subdivision on half-edges, each step in four passes; every new
// vertex is gathered by one half-edge alone, so that nothing depends on the order in which they run.
#pragma limitcheck scheme catmull-clark
#pragma limitcheck points refined
#pragma limitcheck no-normals
#pragma limitcheck max-depth 6
#pragma limitcheck buffer 2 24*V(d)                // points of two levels, which take turns
#pragma limitcheck buffer 3 24*C(d)                // vertex, twin and edge of the half-edges of two levels
#pragma limitcheck pass START V+C
#pragma limitcheck pass FACES F(level) 0..d-1
#pragma limitcheck pass EDGES C(level) 0..d-1
#pragma limitcheck pass VERTICES C(level) 0..d-1
#pragma limitcheck pass SPLIT C(level) 0..d-1
#pragma limitcheck pass DELIVER V(d)+F(d)
#pragma limitcheck output V(d) C(d)-2*F(d)

layout(std430, binding = 2) buffer Points { float points[]; };
layout(std430, binding = 3) buffer HalfEdges { int half_edges[]; };

#ifdef DELIVER
int level = lc_depth;
#else
int level = lc_level;
#endif
ivec4 now = lc_counts(level), last = lc_counts(lc_depth);  // vertices, faces, corners, edges

int point_at(int l, int v) { return 3 * ((l & 1) * last.x + v); }
vec3 point(int l, int v) {
  int k = point_at(l, v);
  return vec3(points[k], points[k + 1], points[k + 2]);
}
void put(int l, int v, vec3 x) {
  int k = point_at(l, v);
  points[k] = x.x, points[k + 1] = x.y, points[k + 2] = x.z;
}
int half_edge_at(int l, int h) { return 3 * ((l & 1) * last.z + h); }
int vertex(int h) { return half_edges[half_edge_at(level, h)]; }
int twin(int h) { return half_edges[half_edge_at(level, h) + 1]; }
int edge(int h) { return half_edges[half_edge_at(level, h) + 2]; }
void put_half_edge(int l, int h, int v, int t, int e) {
  int k = half_edge_at(l, h);
  half_edges[k] = v, half_edges[k + 1] = t, half_edges[k + 2] = e;
}
// After the first step all faces are quads.
int first(int f) { return level == 0 ? lc_first(f) : 4 * f; }
int size(int f) { return level == 0 ? lc_size(f) : 4; }
int face(int h) { return level == 0 ? lc_face(h) : h >> 2; }
int next(int h) { return level == 0 ? lc_next(h) : (h & ~3) | ((h + 1) & 3); }
int prev(int h) { return level == 0 ? lc_prev(h) : (h & ~3) | ((h + 3) & 3); }
bool owns_edge(int h) { return twin(h) < h; }
vec3 face_point(int h) { return point(level + 1, now.x + face(h)); }

void main() {
  int k = lc_item;
  if (k >= lc_items) return;
#ifdef START
  if (k < lc_V)
    put(0, k, lc_position(k));
  else
    put_half_edge(0, k - lc_V, lc_vertex(k - lc_V), lc_twin(k - lc_V), lc_edge(k - lc_V));
#endif
#ifdef FACES
  vec3 sum = vec3(0);
  for (int c = 0; c < size(k); ++c) sum += point(level, vertex(first(k) + c));
  put(level + 1, now.x + k, sum / float(size(k)));
#endif
#ifdef EDGES
  if (!owns_edge(k)) return;
  vec3 middle = (point(level, vertex(k)) + point(level, vertex(next(k)))) / 2.0;
  if (twin(k) >= 0) middle = (middle + (face_point(k) + face_point(twin(k))) / 2.0) / 2.0;
  put(level + 1, now.x + now.y + edge(k), middle);
#endif
#ifdef VERTICES
  // Around the vertex, counter-clockwise from the boundary if there is one; the half-edge with the lowest number does it.
  int start = k, count = 0;
  for (int h = k; twin(h) >= 0;) {
    start = h = next(twin(h));
    if (h == k) break;
  }
  vec3 own = point(level, vertex(k)), faces = vec3(0), ends = vec3(0);
  int h = start, last_face;
  do {
    if (h < k) return;
    faces += face_point(h);
    ends += point(level, vertex(next(h)));
    ++count;
    last_face = h;
    h = twin(prev(h));
  } while (h >= 0 && h != start);
  if (h < 0) {
    vec3 a = point(level, vertex(next(start))), b = point(level, vertex(prev(last_face)));
    put(level + 1, vertex(k), (6.0 * own + (a + b)) / 8.0);
  } else {
    float n = float(count);
    put(level + 1, vertex(k), (faces / n + (own + ends / n) + (n - 3.0) * own) / n);
  }
#endif
#ifdef SPLIT
  int p = prev(k), t = twin(k), tp = twin(p), middles = now.x + now.y;
  put_half_edge(level + 1, 4 * k, vertex(k), t < 0 ? -1 : 4 * next(t) + 3, 2 * edge(k) + (owns_edge(k) ? 0 : 1));
  put_half_edge(level + 1, 4 * k + 1, middles + edge(k), 4 * next(k) + 2, 2 * now.w + k);
  put_half_edge(level + 1, 4 * k + 2, now.x + face(k), 4 * p + 1, 2 * now.w + p);
  put_half_edge(level + 1, 4 * k + 3, middles + edge(p), tp < 0 ? -1 : 4 * tp, 2 * edge(p) + (owns_edge(p) ? 1 : 0));
#endif
#ifdef DELIVER
  if (k < now.x) {
    lc_put_vertex(k, point(level, k));
    return;
  }
  int f = k - now.x, h = first(f);
  for (int c = 1; c + 1 < size(f); ++c)
    lc_put_triangle(h - 2 * f + c - 1, vertex(h), vertex(h + c), vertex(h + c + 1));
#endif
}
