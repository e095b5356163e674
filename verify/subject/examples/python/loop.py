#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A subject in Python: Loop subdivision of the whole mesh, step by step, then every vertex moved to its limit.

    limitcheck audit --program "python3 loop.py" icosahedron holes --depth 3
"""
import json
import sys
from array import array
from collections import Counter
from math import cos, isfinite, pi, sin, sqrt


def weighted(terms):
    terms = list(terms)
    return tuple(sum(w * p[k] for w, p in terms) for k in range(3))


class Mesh:
    """Positions, and triangles (corners, control face, (i, j) of each corner), which must form an oriented manifold."""

    def __init__(self, positions, triangles):
        self.positions, self.triangles = positions, triangles
        self.after = {}  # (v, a) -> b for each triangle (v, a, b): the next neighbour of v, counter-clockwise
        self.start = {}
        faces = Counter(v for corners, _, _ in triangles for v in corners)
        for corners, _, _ in triangles:
            for k in range(3):
                v, a, b = corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]
                if (v, a) in self.after:
                    raise ValueError("two triangles run along an edge in the same direction")
                self.after[v, a] = b
                self.start[v] = a
        for v in faces:
            ring, boundary = self.ring(v)
            if len(ring) - boundary != faces[v]:
                raise ValueError("the triangles at a vertex form more than one fan")

    def ring(self, v):
        """The neighbours of v counter-clockwise, from boundary to boundary if there is one."""
        first = a = self.start[v]
        while (a, v) in self.after and self.after[a, v] != first:
            a = self.after[a, v]  # clockwise
        boundary = (a, v) not in self.after
        ring, b = [a], self.after[v, a]
        while b != a:
            ring.append(b)
            if (v, b) not in self.after:
                break
            b = self.after[v, b]
        return ring, boundary

    def moved(self, v, limit):
        """Vertex v after one step, or its limit position."""
        ring, boundary = self.ring(v)
        if boundary:
            ring, weight = [ring[0], ring[-1]], 1 / 6 if limit else 1 / 8
        else:
            n = len(ring)
            a = 5 / 8 - (3 + 2 * cos(2 * pi / n)) ** 2 / 64
            weight = 8 * a / (n * (3 + 8 * a)) if limit else a / n
        around = [(weight, self.positions[r]) for r in ring]
        return weighted([(1 - weight * len(ring), self.positions[v])] + around)

    def normal(self, v):
        ring, boundary = self.ring(v)
        n, p = len(ring), self.positions[v]
        if boundary:
            faces = n - 1
            c, s = cos(pi / faces), sin(pi / faces)
            end = 1 if faces == 1 else -c * (1 + c) / ((1 + 2 * c) * s)
            first = [1] + [0] * (n - 2) + [-1]
            second = [end] + [sin(i * pi / faces) for i in range(1, n - 1)] + [end]
        else:
            first = [cos(2 * pi * i / n) for i in range(n)]
            second = [sin(2 * pi * i / n) for i in range(n)]
        edges = [weighted([(1, self.positions[r]), (-1, p)]) for r in ring]
        t, u = weighted(zip(first, edges)), weighted(zip(second, edges))
        cross = (t[1] * u[2] - t[2] * u[1], t[2] * u[0] - t[0] * u[2], t[0] * u[1] - t[1] * u[0])
        length = sqrt(sum(x * x for x in cross))
        return tuple(x / length for x in cross) if length > 0 else (0.0, 0.0, 1.0)

    def refined(self):
        positions = [self.moved(v, limit=False) for v in range(len(self.positions))]
        middle = {}

        def edge_point(a, b, c):
            if (b, a) not in middle:
                d = self.after.get((b, a))
                ends, sides = (1 / 2, []) if d is None else (3 / 8, [(1 / 8, c), (1 / 8, d)])
                terms = [(ends, a), (ends, b)] + sides
                middle[a, b] = len(positions)
                positions.append(weighted([(w, self.positions[v]) for w, v in terms]))
                return middle[a, b]
            return middle[b, a]

        triangles = []
        for v, face, at in self.triangles:
            m = [edge_point(v[k], v[(k + 1) % 3], v[(k + 2) % 3]) for k in range(3)]
            between = [tuple(x + y for x, y in zip(at[k], at[(k + 1) % 3])) for k in range(3)]
            for k in range(3):
                old = tuple(2 * x for x in at[k])
                triangles.append(((v[k], m[k], m[k - 1]), face, (old, between[k], between[k - 1])))
            triangles.append((tuple(m), face, tuple(between)))
        return Mesh(positions, triangles)


def read(kind, count):
    numbers = array(kind)
    numbers.frombytes(sys.stdin.buffer.read(count * numbers.itemsize))
    return numbers


def write(answer, *arrays):
    sys.stdout.buffer.write(json.dumps({"status": "ok", **answer}).encode() + b"\n")
    for numbers in arrays:
        sys.stdout.buffer.write(numbers.tobytes())
    sys.stdout.buffer.flush()


control = None
while line := sys.stdin.buffer.readline():
    question = json.loads(line)
    if question["request"] == "capabilities":
        write({"limitcheck": 1, "precision": "float64", "weights": "loop", "boundary": "spline", "points": "limit",
               "max_depth": 6, "normals": True, "per_face_depth": False, "exact_lattice": True})
    elif question["request"] == "create":
        xyz, corners = read("d", 3 * question["vertices"]), read("i", 3 * question["triangles"])
        faces = [tuple(corners[k:k + 3]) for k in range(0, len(corners), 3)]
        try:
            if not faces:
                raise ValueError("there are no triangles")
            if not all(map(isfinite, xyz)):
                raise ValueError("a coordinate is not finite")
            if min(corners) < 0 or max(corners) >= question["vertices"]:
                raise ValueError("a triangle names a vertex that does not exist")
            control = Mesh([tuple(xyz[k:k + 3]) for k in range(0, len(xyz), 3)],
                           [(v, face, ((0, 0), (1, 0), (0, 1))) for face, v in enumerate(faces)])
            write({})
        except ValueError as refusal:
            write({"status": "invalid-input", "message": str(refusal)})
    elif question["request"] == "tessellate":
        depth = read("i", question["triangles"])[0]
        mesh = control
        for _ in range(depth):
            mesh = mesh.refined()
        vertices = range(len(mesh.positions))
        place = {v: (face, *at[k], 2**depth) for corners, face, at in mesh.triangles for k, v in enumerate(corners)}
        write({"vertices": len(vertices), "triangles": len(mesh.triangles)},
              array("d", [x for v in vertices for x in mesh.moved(v, limit=True)]),
              array("d", [x for v in vertices for x in mesh.normal(v)]),
              array("I", [x for v in vertices for x in place[v]]),
              array("I", [v for corners, _, _ in mesh.triangles for v in corners]),
              array("i", [face for _, face, _ in mesh.triangles]))
