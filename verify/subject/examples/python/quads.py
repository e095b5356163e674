#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A subject in Python: Catmull-Clark refinement of faces of any number of corners, by version 2 of the protocol.

    limitcheck audit --program "python3 quads.py" quad-cube prism:5 --depth 2

It delivers the vertices of the refined mesh, not points of the limit surface.
"""
import json
import sys
from array import array
from collections import defaultdict
from math import isfinite


def mean(points):
    points = list(points)
    return tuple(sum(p[k] for p in points) / len(points) for k in range(3))


class Mesh:
    """Positions, and faces (corners, control face, its corner, (i, j) of each corner): an oriented manifold."""

    def __init__(self, positions, faces):
        self.positions, self.faces = positions, faces
        self.left = {}  # the face to the left of each directed edge
        for f, (v, *_) in enumerate(faces):
            for edge in zip(v, v[1:] + v[:1]):
                if edge in self.left:
                    raise ValueError("two faces run along an edge in the same direction")
                self.left[edge] = f
        self.boundary = {a: b for a, b in self.left if (b, a) not in self.left}
        if len(self.boundary) < sum((b, a) not in self.left for a, b in self.left):
            raise ValueError("two fans of faces meet in a vertex")

    def refined(self):
        middle = [mean(self.positions[v] for v in face[0]) for face in self.faces]
        around = defaultdict(list)  # of each vertex: the far ends of the edges that leave it, and the middles
        for (a, b), f in self.left.items():
            around[a] += [self.positions[b], middle[f]]
        positions = []
        before = {b: a for a, b in self.boundary.items()}
        for v, c in enumerate(self.positions):
            if v in self.boundary:
                ends = self.positions[self.boundary[v]], self.positions[before[v]]
                positions.append(mean([c] * 6 + list(ends)))
            elif v in around:
                n, m = len(around[v]) / 2, mean(around[v])
                positions.append(tuple(((n - 2) * x + 2 * y) / n for x, y in zip(c, m)))
            else:
                positions.append(c)
        of_edge = {}
        for (a, b), f in self.left.items():
            if (b, a) not in of_edge:
                ends = [self.positions[a], self.positions[b]]
                of_edge[a, b] = len(positions)
                positions.append(mean(ends + [middle[f], middle[self.left[b, a]]] if (b, a) in self.left else ends))
            else:
                of_edge[a, b] = of_edge[b, a]
        faces = []
        for f, (v, control, corner, at) in enumerate(self.faces):
            for k in range(len(v)):
                e, g = of_edge[v[k], v[(k + 1) % len(v)]], of_edge[v[k - 1], v[k]]
                quad = [v[k], e, len(positions) + f, g]
                if len(v) == 4:
                    place = [tuple(x + y for x, y in zip(at[k], at[c % 4])) for c in range(k, k + 4)]
                    faces.append((quad, control, corner, place))
                else:
                    faces.append((quad, control, k, SQUARE))
        return Mesh(positions + middle, faces)


SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def read(kind, count):
    numbers = array(kind)
    numbers.frombytes(sys.stdin.buffer.read(count * numbers.itemsize))
    return numbers


def write(answer, *arrays):
    sys.stdout.buffer.write(json.dumps({"status": "ok", **answer}).encode() + b"\n")
    for numbers in arrays:
        sys.stdout.buffer.write(numbers.tobytes())
    sys.stdout.buffer.flush()


control = sizes = None
while line := sys.stdin.buffer.readline():
    question = json.loads(line)
    if question["request"] == "capabilities":
        write({"limitcheck": 2, "schemes": ["catmull-clark"], "precision": "float64", "weights": "loop",
               "boundary": "spline", "points": "refined", "max_depth": 6, "normals": False, "per_face_depth": False,
               "exact_lattice": True})
    elif question["request"] == "create":
        xyz, sizes = read("d", 3 * question["vertices"]), read("i", question["faces"])
        corners = list(read("i", question["corners"]))
        faces = []
        for face, size in enumerate(sizes):
            faces.append((corners[:size], face, 0, SQUARE if size == 4 else [(0, 0)] * size))
            del corners[:size]
        try:
            if not faces:
                raise ValueError("there are no faces")
            if not all(map(isfinite, xyz)):
                raise ValueError("a coordinate is not finite")
            if any(not 0 <= v < question["vertices"] for face in faces for v in face[0]):
                raise ValueError("a face names a vertex that does not exist")
            control = Mesh([tuple(xyz[k:k + 3]) for k in range(0, len(xyz), 3)], faces)
            write({})
        except ValueError as refusal:
            write({"status": "invalid-input", "message": str(refusal)})
    elif question["request"] == "tessellate":
        depth = read("i", question["faces"])[0]
        mesh = control
        for _ in range(depth):
            mesh = mesh.refined()
        place, part = {}, {}
        for v, face, corner, at in mesh.faces:
            steps = 2**depth if sizes[face] == 4 else 2**max(depth - 1, 0)
            for k, vertex in enumerate(v):
                place[vertex] = face, *at[k], steps
                part[vertex] = k if len(v) != 4 else corner  # at depth 0 a face that is no quad has its corners
        vertices = range(len(mesh.positions))
        triangles = [(v[0], v[k], v[k + 1], face) for v, face, _, _ in mesh.faces for k in range(1, len(v) - 1)]
        write({"vertices": len(vertices), "triangles": len(triangles)},
              array("d", [x for p in mesh.positions for x in p]),
              array("I", [x for v in vertices for x in place[v]]),
              array("i", [part[v] for v in vertices]),
              array("I", [v for t in triangles for v in t[:3]]),
              array("i", [t[3] for t in triangles]))
