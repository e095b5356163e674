# SPDX-License-Identifier: MIT
"""Blender's Subdivision Surface modifier on an OBJ file:  blender -b -P blender_subdivide.py -- cage.obj out.obj [LEVELS]

Written for Blender 3.4. The vertices go in and out as they are (no change of axes), with full precision of float.
"""
import sys

import bpy

cage, out, *rest = sys.argv[sys.argv.index("--") + 1 :]
levels = int(rest[0]) if rest else 3

vertices, faces = [], []
for line in open(cage):
    words = line.split()
    if words and words[0] == "v":
        vertices.append(tuple(float(x) for x in words[1:4]))
    elif words and words[0] == "f":
        faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])

mesh = bpy.data.meshes.new("cage")
mesh.from_pydata(vertices, [], faces)
thing = bpy.data.objects.new("cage", mesh)
bpy.context.collection.objects.link(thing)
modifier = thing.modifiers.new("subdivision", "SUBSURF")
modifier.levels = modifier.render_levels = levels
modifier.quality = 10

smooth = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
smooth.calc_normals()
with open(out, "w") as file:
    for v in smooth.vertices:
        file.write("v %.9g %.9g %.9g\nvn %.9g %.9g %.9g\n" % (*v.co, *v.normal))
    for p in smooth.polygons:
        file.write("f " + " ".join("%d//%d" % (v + 1, v + 1) for v in p.vertices) + "\n")
