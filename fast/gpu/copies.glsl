// SPDX-License-Identifier: MIT
// Vertices of a frame one by one, a lane for each, from where their positions and normals were made: `given`, three
// numbers each.

layout(std430, binding = 3) readonly buffer Copies { ivec4 copies[]; };  // Copy of shaders.h

void main() {
  ivec4 copy = copies[group() * LANES + lane()];
  stage(lane(), Vertex(vec3(given[3 * copy.y], given[3 * copy.y + 1], given[3 * copy.y + 2]),
                       vec3(given[3 * copy.z], given[3 * copy.z + 1], given[3 * copy.z + 2])));
  for (int k = 0; k < kNumbers; ++k) points[kNumbers * copy.x + k] = staged(kNumbers * lane() + k);
}
