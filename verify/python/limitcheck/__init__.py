# SPDX-License-Identifier: MIT
"""Subdivision surfaces judged: exact points of the limit surface, and audits of tessellators.

    import limitcheck
    mesh = limitcheck.Mesh.generate("icosahedron")
    mesh.evaluate([0, 3], [(1/3, 1/3), (0, 0)])["position"]
    limitcheck.audit(my_subdivide, meshes=["icosahedron", "torus"], depth=3)

Every error that a caller can mend is a limitcheck.Error, which is a ValueError, with one sentence.
"""
from __future__ import annotations

import os
from fractions import Fraction
from typing import Any, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _core
from ._core import Error
from .audits import Report, audit, check, hunt, repair

__all__ = ["Certified", "Error", "Mesh", "Report", "Tessellation", "audit", "check", "generate", "hunt", "repair"]


class Certified(NamedTuple):
    """A vector to so many digits: each true coordinate is within `radius` of the decimal."""

    value: tuple[str, str, str]
    radius: float


class Tessellation(NamedTuple):
    """Triangles of the limit surface."""

    positions: np.ndarray  # (n, 3) float64
    normals: np.ndarray  # (n, 3) float64, unit length
    triangles: np.ndarray  # (m, 3) uint32, counter-clockwise from outside
    # Where each vertex lies on the control mesh: evaluate(faces, uv, corners=corners) has it.
    faces: np.ndarray  # (n) int32
    uv: np.ndarray  # (n, 2) float64
    corners: np.ndarray  # (n) int32: 0 on triangles (Loop) and quads


class Mesh:
    """A control mesh: an oriented 2-manifold, boundaries allowed.

    vertices   (n, 3), finite
    faces      (m, 3) or (m, 4) integers, or a sequence of faces with 3 corners or more each, counter-clockwise
    creases    (vertex, vertex, sharpness) for each sharp edge; 10 and more stays sharp
    corners    (vertex, sharpness) for each sharp vertex
    boundary   "edge", or "edge-and-corner": boundary vertices of one face are held
    scheme     "loop" (triangles only) or "catmull-clark"; by default loop if all faces are triangles

    Raises Error if the mesh is none that the scheme is defined on.
    """

    def __init__(self, vertices, faces, *, creases: Sequence = (), corners: Sequence = (),
                 boundary: str = "edge", scheme: Optional[str] = None):
        if boundary not in ("edge", "edge-and-corner"):
            raise Error(f"boundary is 'edge' or 'edge-and-corner', not {boundary!r}")
        rows = [np.asarray(face, dtype=np.int32).ravel() for face in faces]
        sizes = np.array([len(row) for row in rows], dtype=np.int32)
        flat = np.concatenate(rows) if rows else np.empty(0, np.int32)
        self._core = _core.Mesh.made(np.asarray(vertices, dtype=np.float64), flat, sizes, list(map(tuple, creases)),
                                     list(map(tuple, corners)), boundary == "edge-and-corner", scheme)

    @classmethod
    def _of(cls, core) -> "Mesh":
        mesh = cls.__new__(cls)
        mesh._core = core
        return mesh

    @classmethod
    def load(cls, file: Union[str, os.PathLike], scheme: Optional[str] = None) -> "Mesh":
        """A mesh from an OBJ, OFF, PLY, STL or USD (.usda) file."""
        return cls._of(_core.Mesh.load(os.fspath(file), scheme))

    @classmethod
    def generate(cls, name: str, scheme: Optional[str] = None) -> "Mesh":
        """A mesh by name, as `limitcheck generate` lists them: "icosahedron", "torus:12:6", "bumpy:200"."""
        return cls._of(_core.Mesh.generate(name, scheme))

    def save(self, file: Union[str, os.PathLike]) -> None:
        """To an OBJ (all tags), OFF or PLY file, so that load() gives back the same bits."""
        self._core.save(os.fspath(file))

    @property
    def scheme(self) -> str:
        return self._core.scheme

    @property
    def vertices(self) -> np.ndarray:
        """(n, 3) float64"""
        return self._core.vertices

    @property
    def faces(self) -> list[list[int]]:
        return self._core.faces

    def evaluate(self, faces, uv, *, corners=None, derivatives: int = 2) -> dict[str, np.ndarray]:
        """Points of the limit surface in double, on all cores.

        faces        (n) integers
        uv           (n, 2): the barycentric weights of a triangle's second and third corner (Loop); u and v of a quad, or
                     of the quad at a corner of another face (Catmull-Clark)
        corners      (n): which corner, where a face is no quad
        derivatives  0: position; 1: also d1, d2 and normal; 2: also d11, d12, d22

        Each array has the shape (n, 3). Derivatives that do not exist, at extraordinary corners, are NaN; a normal always
        is there. Errors are some 1e-15 of the mesh's size; certified() has bounds.
        """
        return self._core.evaluate(np.asarray(faces), np.asarray(uv), None if corners is None else np.asarray(corners),
                                   derivatives)

    def certified(self, face: int, u, v, *, corner: int = 0, digits: int = 30) -> dict[str, Certified]:
        """One point to `digits` digits (1 to 10000), with proven radii. u and v are taken exactly: numbers, Fractions, or
        text such as "1/3"."""
        found = self._core.certified(face, _exact(u), _exact(v), corner, digits)
        return {name: Certified(tuple(value), radius) for name, (value, radius) in found.items()}

    def tessellate(self, depth: Union[int, Sequence[int], None] = None, *, camera: Optional[Sequence] = None,
                   viewport: tuple[int, int] = (1024, 768), field_of_view: float = 45, pixels: float = 60,
                   max_depth: int = 5) -> Tessellation:
        """Points and normals of the limit surface in double, watertight.

        depth          0 to 10: every face in 4^depth triangles (or pairs of them); or a depth for each face, -1 for a face that
                       is left out
        camera         instead: eye, or (eye, target), or (eye, target, up). Each face is as deep as its size on the screen and
                       its curvature want (the paper's combined strategy); faces seen from behind are left out
        viewport       width and height in pixels
        field_of_view  vertical, degrees
        pixels         the size of a face's part that is aimed at
        max_depth      0 to 10
        """
        if (depth is None) == (camera is None):
            raise Error("tessellate() takes either a depth or a camera")
        if camera is None:
            depths = np.broadcast_to(np.asarray(depth, np.int32), len(self.faces)).tolist()
            return Tessellation(**self._core.tessellate(depths, None))
        points = np.atleast_2d(np.asarray(camera, float))
        if points.ndim != 2 or points.shape[1] != 3 or len(points) > 3:
            raise Error("camera is eye, (eye, target) or (eye, target, up), points of three coordinates")
        view = np.concatenate([points, [(0, 0, 4), (0, 0, 0), (0, 1, 0)][len(points):]]) if len(points) < 3 else points
        return Tessellation(**self._core.tessellate(
            [], [*view.ravel(), field_of_view, viewport[0], viewport[1], pixels, max_depth]))

    def __repr__(self) -> str:
        return f"<limitcheck.Mesh of {len(self.vertices)} vertices and {len(self.faces)} faces, {self.scheme}>"


#: A mesh by name: limitcheck.generate("torus:12:6").
generate = Mesh.generate


def _exact(number: Any) -> str:
    return number if isinstance(number, str) else str(Fraction(number))
