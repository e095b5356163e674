// SPDX-License-Identifier: MIT
// What all shaders of this folder have: their bits are those of the kernels of fast/stream/kernel on a number
// that has no fused multiply-add. All sums are precise, so that no compiler fuses or reorders them. The host
// defines LANES, LOCAL: whether edges and grids have origins of their own, PLACED and COMPACT: the Output, and where
// things lie in `memory`, MEMORY numbers in all (shaders.h).

layout(local_size_x = LANES) in;
shared float memory[MEMORY];

layout(std140, binding = 0) uniform Batch {
  vec4 batch_centre;  // of the caller's coordinates; w: quads: unit of polynomials
  float control_unit; // of control points,
  float limit_unit;   // of limit points, which the rules leave larger at each level
  int given_stride;   // from a number of a corner block to the next
  int sides;          // quads: sides that are evaluated of each
  ivec4 period;       // quads: see QuadBatch of layout.h
  int open, darts, sharp, some_polynomial;
  int depth;
  int first_group;  // of the grids, quads, edges or sides that are given, that which work group 0 does
};
int group() { return first_group + int(gl_WorkGroupID.x); }
layout(std430, binding = 1) readonly buffer Given { float given[]; };  // corner blocks, see layout.h

// Vertices: position and normal, or position and both numbers of the normal's place on an octahedron (CompactVertex).
#if COMPACT
const int kNumbers = 4;
layout(std430, binding = 2) writeonly buffer Points { uint points[]; };
#else
const int kNumbers = 6;
layout(std430, binding = 2) writeonly buffer Points { float points[]; };
#endif
#if PLACED
layout(std430, binding = 5) readonly buffer Places { int places[]; };  // the first vertex of what each group makes
int first_vertex(int made) { return places[group()]; }
#else
int first_vertex(int made) { return group() * made; }
#endif

int N = 1 << depth;
int lane() { return int(gl_LocalInvocationID.x); }

vec3 given_point(int block, int k) {
  return vec3(given[block + k * given_stride], given[block + (k + 1) * given_stride],
              given[block + (k + 2) * given_stride]);
}
vec3 load(int k) { return vec3(memory[k], memory[k + 1], memory[k + 2]); }
void store(int k, vec3 v) { memory[k] = v.x, memory[k + 1] = v.y, memory[k + 2] = v.z; }

struct Vertex { vec3 position, normal; };

// The unit vector along a x b. 1 / sqrt as in rules-inl.h: a seed from the halved exponent and two steps,
// with the same bits on every machine.
vec3 unit_normal(vec3 a, vec3 b) {
  precise vec3 n = a.yzx * b.zxy - a.zxy * b.yzx;
  n.z = n.z + 8.67361738e-19;  // a zero product becomes (0, 0, 1)
  precise float square = n.x * n.x + (n.y * n.y + n.z * n.z);
  precise float y = intBitsToFloat(0x5f5f2000 - (floatBitsToInt(square) >> 1));
  precise float t = square * y;
  y = y * (4.73500586 - t * y);
  t = (square * y) * y;
  y = y * ((0.00038352891 * t + -0.0200802963) * t + 0.473101854);
  n = n * y;
  return mix(n, vec3(0.0), equal(n, vec3(0.0)));  // zeros have no sign
}

// Half the sum of two points, with few enough digits that moving there and back costs hardly any; 0 where what is given
// says that this part has no origin of its own.
const int kInside = 5, kParts = 6;  // Part
vec3 middle(vec3 p, vec3 q) {
  precise vec3 m = (0.5 * (p + q) + 3072.0) - 3072.0;
  return m;
}
vec3 middle(int own, vec3 p, vec3 q) {
  return given[own] == 0.0 ? vec3(0.0) : middle(p, q);
}

#if COMPACT
uint packed_normal(vec3 n) {
  precise float inverse = 1.0 / (abs(n.x) + abs(n.y) + abs(n.z));
  precise vec2 p = n.xy * inverse, folded = 1.0 - abs(p.yx);
  if (n.z < 0.0) p = mix(folded, -folded, lessThan(n.xy, vec2(0.0)));
  precise vec2 scaled = 32767.0 * p;
  ivec2 whole = ivec2(roundEven(scaled));
  return (uint(whole.x) & 0xffffu) | uint(whole.y) << 16;
}
uint staged(int k) {
  int vertex = STAGED + 6 * (k / 4), part = k % 4;
  return part < 3 ? floatBitsToUint(memory[vertex + part]) : packed_normal(load(vertex + 3));
}
#else
float staged(int k) { return memory[STAGED + k]; }
#endif

// A row on its way out: staged, so that neighbouring lanes write neighbouring numbers.
void stage(int i, Vertex v) {
  store(STAGED + 6 * i, v.position);
  store(STAGED + 6 * i + 3, v.normal);
}
void put_staged_row(int j) {
  barrier();
  int to = kNumbers * (first_vertex((N + 1) * (N + 1)) + (N + 1) * j);
  for (int k = lane(); k < kNumbers * (N + 1); k += LANES) points[to + k] = staged(k);
}
#if !COMPACT
void put(int i, Vertex v) {
  int to = 6 * i;
  points[to] = v.position.x, points[to + 1] = v.position.y, points[to + 2] = v.position.z;
  points[to + 3] = v.normal.x, points[to + 4] = v.normal.y, points[to + 5] = v.normal.z;
}
#endif
