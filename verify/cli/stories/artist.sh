#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Somebody who models: a sphere as three.js makes it, with a seam that stays open, and a cage in USD with a crease. Runs in
# an empty folder.
set -euo pipefail
# Eight segments, six rings; the last column of vertices is 1e-16 away from the first.
awk 'BEGIN {
  pi = atan2(0, -1)
  for (r = 0; r <= 6; ++r) for (s = 0; s <= 8; ++s) {
    phi = 2 * pi * s / 8; theta = pi * r / 6
    printf "v %.17g %.17g %.17g\n", -cos(phi) * sin(theta), cos(theta), sin(phi) * sin(theta)
  }
  for (r = 0; r < 6; ++r) for (s = 0; s < 8; ++s) {
    a = r * 9 + s + 2; b = a - 1; c = b + 9; d = a + 9
    if (r > 0) print "f", a, b, d
    if (r < 5) print "f", b, c, d
  }
}' >sphere.obj
limitcheck check sphere.obj >open.txt
grep -q 'boundary *[1-9]' open.txt
limitcheck repair sphere.obj --weld 1e-6 -o closed.obj
limitcheck check closed.obj >closed.txt
grep -q 'none: the mesh is closed' closed.txt
limitcheck audit row-stream closed.obj --depth 2

# USD: what is sharp is said, and the surface is that of the same cage in OBJ.
cat >cage.usda <<'USD'
#usda 1.0
def Xform "root"
{
    def Mesh "box"
    {
        uniform token subdivisionScheme = "catmullClark"
        uniform token interpolateBoundary = "edgeOnly"
        point3f[] points = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1),
                            (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]
        int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
        int[] faceVertexIndices = [0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7]
        int[] creaseIndices = [4, 5, 6, 7, 4]
        int[] creaseLengths = [5]
        float[] creaseSharpnesses = [2]
    }
}
USD
limitcheck check cage.usda >usda.txt
grep -q 'catmull-clark (as the file says)' usda.txt
grep -q 'sharp edges *4 semi-sharp (2)' usda.txt
cat >cage.obj <<'OBJ'
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
t crease 2/1/0 4 5 2
t crease 2/1/0 5 6 2
t crease 2/1/0 6 7 2
t crease 2/1/0 7 4 2
OBJ
for cage in cage.usda cage.obj; do limitcheck eval "$cage" 1 1/3 1/4 --digits 30 | sed 's/^cage[^ ]*//' | tail -n +2 >"$cage.txt"; done
cmp cage.usda.txt cage.obj.txt
limitcheck tessellate cage.usda --depth 3 -o fine.glb
limitcheck audit --control cage.usda --tessellation fine.glb
