# SPDX-License-Identifier: MIT
"""Blender's Subdivision Surface modifier on an OBJ file:  blender -b -P blender_subdivide.py -- cage.obj out.obj [LEVELS]

Then:  limitcheck audit --control cage.obj --tessellation out.obj --tolerance 1e-6

Written for Blender 3.4. The vertices go in and out as they are (no change of axes), with full precision of float. Sharp edges
and vertices are taken from OpenSubdiv's tags (`t crease`, `t corner`, `t interpolateboundary`). Blender's crease c, 0 to 1, is a
sharpness of 10 c^2. It has no Chaikin creasing, no rule for triangles and no holes: a cage with these is refused, with exit code
3. It writes one normal for each vertex, which on an edge that stays sharp is that of neither side. Texture coordinates (`vt`) go
over seams by the rule of `t facevaryinginterpolateboundary`, which the modifier has as "UV Smooth".
"""
import math
import sys

import bmesh
import bpy

cage, out, *rest = sys.argv[sys.argv.index("--") + 1 :]
levels = int(rest[0]) if rest else 3


def number(word):
    numerator, _, denominator = word.partition("/")
    return float(numerator) / float(denominator or 1)


def refuse(why):
    print("not possible in Blender: " + why)
    sys.stdout.flush()
    # Blender would end with 0 after any other way out of a script.
    import os

    os._exit(3)


UV_SMOOTH = [
    "SMOOTH_ALL",
    "PRESERVE_CORNERS",
    "PRESERVE_CORNERS_AND_JUNCTIONS",
    "PRESERVE_CORNERS_JUNCTIONS_AND_CONCAVE",
    "PRESERVE_BOUNDARIES",
    "NONE",
]
vertices, faces, creases, corners, corners_kept = [], [], [], [], False
texture, texture_of_faces, texture_rule = [], [], 2
for line in open(cage):
    words = line.split("#")[0].split()
    if words and words[0] == "v":
        vertices.append(tuple(float(x) for x in words[1:4]))
    elif words and words[0] == "f":
        faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
        texture_of_faces.extend(int(w.split("/")[1]) - 1 for w in words[1:] if "/" in w.split("//")[0])
    elif words and words[0] == "vt":
        texture.append([float(x) for x in words[1:3]])
    elif words and words[0] == "t":
        name, counts, values = words[1], [int(n) for n in words[2].split("/")], words[3:]
        if name == "crease":
            path, sharpness = [int(v) for v in values[: counts[0]]], [number(s) for s in values[counts[0] :]]
            for k, (a, b) in enumerate(zip(path, path[1:])):
                creases.append((a, b, sharpness[min(k, len(sharpness) - 1)]))
        elif name == "corner":
            held, sharpness = [int(v) for v in values[: counts[0]]], [number(s) for s in values[counts[0] :]]
            for k, v in enumerate(held):
                corners.append((v, sharpness[min(k, len(sharpness) - 1)]))
        elif name == "interpolateboundary":
            corners_kept = int(values[0]) == 1
        elif name == "facevaryinginterpolateboundary":
            texture_rule = int(values[0])
        elif not (name == "creasemethod" and values == ["normal"]) and not (name == "smoothtriangles" and values == ["catmark"]):
            refuse("t " + name)


def crease(sharpness):
    return 1.0 if sharpness >= 10 else math.sqrt(sharpness / 10)


mesh = bpy.data.meshes.new("cage")
mesh.from_pydata(vertices, [], faces)
if creases or corners:
    edited = bmesh.new()
    edited.from_mesh(mesh)
    edited.verts.ensure_lookup_table()
    of_edge, of_vertex = edited.edges.layers.crease.verify(), edited.verts.layers.crease.verify()
    for a, b, sharpness in creases:
        edge = edited.edges.get((edited.verts[a], edited.verts[b]))
        if edge is None:
            refuse("no edge %d %d" % (a, b))
        edge[of_edge] = crease(sharpness)
    for v, sharpness in corners:
        edited.verts[v][of_vertex] = crease(sharpness)
    edited.to_mesh(mesh)
    edited.free()
for loop, index in enumerate(texture_of_faces):
    layer = mesh.uv_layers.active or mesh.uv_layers.new()
    layer.data[loop].uv = texture[index]
thing = bpy.data.objects.new("cage", mesh)
bpy.context.collection.objects.link(thing)
modifier = thing.modifiers.new("subdivision", "SUBSURF")
modifier.levels = modifier.render_levels = levels
modifier.quality = 10
modifier.uv_smooth = UV_SMOOTH[texture_rule]
modifier.boundary_smooth = "PRESERVE_CORNERS" if corners_kept else "ALL"

smooth = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
smooth.calc_normals()
with open(out, "w") as file:
    for v in smooth.vertices:
        file.write("v %.9g %.9g %.9g\nvn %.9g %.9g %.9g\n" % (*v.co, *v.normal))
    layer = smooth.uv_layers.active
    for p in smooth.polygons:
        if layer:
            file.writelines("vt %.9g %.9g\n" % tuple(layer.data[k].uv) for k in p.loop_indices)
        corners = zip(p.vertices, p.loop_indices)
        file.write("f " + " ".join("%d/%s/%d" % (v + 1, k + 1 if layer else "", v + 1) for v, k in corners) + "\n")
