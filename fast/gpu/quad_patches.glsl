// SPDX-License-Identifier: MIT
// Regular quads: bicubic polynomials, row by row, a work group for each: quad_patch-inl.h, whose bits these
// are.

// Memory: the coefficients of the patch, its sides, the coefficients of a row, a row on its way out.
const int kPower = 0, kCurves = 48, kCoefficients = kCurves + 4 * kCurve;

vec3 patch_point(int at, int r, int k) { return given_point(at, 3 * (4 * r + k)); }
// The same in the frame of a side.
vec3 beside(int at, int side, int r, int k) {
  ivec2 place = side == 0 ? ivec2(r, k) : side == 1 ? ivec2(k, 3 - r) : side == 2 ? ivec2(3 - r, 3 - k)
                                                                                : ivec2(3 - k, r);
  return patch_point(at, place.x, place.y);
}

// Control points of a uniform cubic B-spline, `step` numbers apart, to the coefficients of 1, t, t^2, t^3, times 6.
void to_powers(int at, int step) {
  precise vec3 a = load(at), b = load(at + step), c = load(at + 2 * step), d = load(at + 3 * step);
  precise vec3 ab = b - a, bc = c - b, cd = d - c;
  precise vec3 p0 = 6.0 * b + (bc - ab), p1 = 3.0 * (ab + bc), p2 = 3.0 * (bc - ab);
  precise vec3 p3 = (ab + cd) - 2.0 * bc;
  store(at, p0), store(at + step, p1), store(at + 2 * step, p2), store(at + 3 * step, p3);
}
void evaluate(vec3 a, vec3 b, vec3 c, vec3 d, float t, out vec3 value, out vec3 slope) {
  precise vec3 p = d * t + c;
  precise vec3 q = p * t + b;
  precise vec3 s = (d * t + p) * t + q, v = q * t + a;
  value = v, slope = s;
}

void main() {
  int at = begin_of(group());
  precise vec3 origin = middle(patch_point(at, 1, 1), patch_point(at, 2, 2));
  precise vec3 centre = origin * control_unit + batch_centre.xyz;
  int side = lane() / 4, number = lane() % 4, curve = kCurves + kCurve * side;
  if (lane() < 16) {
    precise vec3 p = patch_point(at, side, number) - origin;  // row and column, too
    store(kPower + 12 * number + 3 * side, p);
    make_curve_point(beside(at, side, 0, number), beside(at, side, 1, number), beside(at, side, 2, number),
                     middle(beside(at, side, 1, 1), beside(at, side, 1, 2)), curve, number);
  }
  for (int step = 12; step > 0; step -= 9) {  // rows, then columns
    barrier();
    if (lane() < 4) to_powers(kPower + (15 - step) * lane(), step);
  }
  if (lane() < 16) make_curve_difference(curve, number);
  barrier();
  for (int j = 0; j <= N; ++j) {
    if (lane() < 4) {
      int from = kPower + 12 * lane();
      vec3 value, slope;
      float t = float(j) * (1.0 / float(N));
      evaluate(load(from), load(from + 3), load(from + 6), load(from + 9), t, value, slope);
      store(kCoefficients + 3 * lane(), value);
      store(kCoefficients + 12 + 3 * lane(), slope);
    }
    barrier();
    for (int i = lane(); i <= N; i += LANES) {
      Vertex v;
      bool row = j == 0 || j == N, column = i == 0 || i == N;
      if (row && column) {
        int limit = 48 + 6 * (j == 0 ? (i == 0 ? 0 : 1) : (i == 0 ? 3 : 2));
        v = Vertex(given_point(at, limit), given_point(at, limit + 3));
      } else if (row || column) {
        int side = j == 0 ? 0 : j == N ? 2 : i == N ? 1 : 3, k = row ? i : j;
        v = curve_point(kCurves + side * kCurve, side < 2 ? k : N - k);
      } else {
        precise float t = float(i) * (1.0 / float(N));
        vec3 value, along;
        int of = kCoefficients, to = of + 12;
        evaluate(load(of), load(of + 3), load(of + 6), load(of + 9), t, value, along);
        precise vec3 across = ((load(to + 9) * t + load(to + 6)) * t + load(to + 3)) * t + load(to);
        precise vec3 position = value * batch_centre.w + centre;
        v = Vertex(position, unit_normal(along, across));
      }
      stage(i, v);
    }
    put_staged_row(j);
  }
}
