// SPDX-License-Identifier: MIT
// The first form: a function of one place. A quad whose vertices are all inside the mesh and have four faces each is a
// bicubic B-spline patch of 16 vertices.
#pragma limitcheck scheme catmull-clark
#pragma limitcheck faces quads
#pragma limitcheck boundary none

// Across the half-edge h of a face: behind its first vertex, behind its second, and behind the corner at the first.
void across(int h, out int first, out int second, out int corner) {
  int t = lc_twin(h);
  first = lc_vertex(lc_next(lc_next(t)));
  second = lc_vertex(lc_prev(t));
  corner = lc_vertex(lc_prev(lc_twin(lc_next(t))));
}

// Weights of four control points at t, and their derivatives.
void weights(float t, out vec4 w, out vec4 d) {
  float s = 1.0 - t;
  w = vec4(s * s * s, 3.0 * t * t * t - 6.0 * t * t + 4.0, 3.0 * s * s * s - 6.0 * s * s + 4.0, t * t * t) / 6.0;
  d = vec4(-s * s, 3.0 * t * t - 4.0 * t, 4.0 * s - 3.0 * s * s, t * t) / 2.0;
}

// A point that faces share is evaluated as one of them sees it, whoever asks: so all get the same bits. `uv` is counted from
// where the half-edge h begins, u along it.
void turn_to_owner(inout int h, inout vec2 uv) {
  for (int k = 0; k < 4; ++k) {
    if (uv.y == 0.0 && uv.x < 1.0) {
      int own = h;
      if (uv.x > 0.0) {
        if (lc_twin(h) < h) h = lc_twin(h), uv.x = 1.0 - uv.x;
        return;
      }
      for (int around = lc_twin(lc_prev(own)); around != own; around = lc_twin(lc_prev(around))) h = min(h, around);
      return;
    }
    h = lc_next(h), uv = vec2(uv.y, 1.0 - uv.x);
  }
}

float largest(vec3 x) { return max(abs(x.x), max(abs(x.y), abs(x.z))); }
// Products of small and large derivatives stay in the range of floats; any direction where there is none.
vec3 normal_of(vec3 along_u, vec3 along_v) {
  vec3 n = cross(along_u / max(largest(along_u), 1e-30), along_v / max(largest(along_v), 1e-30));
  float size = largest(n);
  return size > 0.0 ? normalize(n / size) : vec3(0, 0, 1);
}

void evaluate(int face, vec2 uv, out vec3 position, out vec3 normal) {
  int h = lc_first(face);
  turn_to_owner(h, uv);
  // p[j][i] is the vertex at u = i - 1, v = j - 1: the corners of the face are in the middle.
  int right = lc_next(h), top = lc_next(right), left = lc_next(top), p[4][4];
  p[1][1] = lc_vertex(h), p[1][2] = lc_vertex(right), p[2][2] = lc_vertex(top), p[2][1] = lc_vertex(left);
  across(h, p[0][1], p[0][2], p[0][0]);
  across(right, p[1][3], p[2][3], p[0][3]);
  across(top, p[3][2], p[3][1], p[3][3]);
  across(left, p[2][0], p[1][0], p[3][0]);

  vec4 wu, wv, du, dv;
  weights(uv.x, wu, du);
  weights(uv.y, wv, dv);
  vec3 along_u = vec3(0), along_v = vec3(0);
  position = vec3(0);
  for (int j = 0; j < 4; ++j) {
    vec3 row = vec3(0), derivative = vec3(0);
    for (int i = 0; i < 4; ++i) {
      row += wu[i] * lc_position(p[j][i]);
      derivative += du[i] * lc_position(p[j][i]);
    }
    position += wv[j] * row;
    along_u += wv[j] * derivative;
    along_v += dv[j] * row;
  }
  normal = normal_of(along_u, along_v);
}

void lc_evaluate(lc_place at, out vec3 position, out vec3 normal) { evaluate(at.face, at.uv, position, normal); }
