# SPDX-License-Identifier: MIT
"""Audits, by the program `limitcheck`: of a Python function, which is asked in this process, or of anything else that
`limitcheck audit` takes."""
from __future__ import annotations

import html
import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
from pathlib import Path
from typing import Any, Callable, Optional, Sequence, Union

import numpy as np

from ._core import Error


def program() -> str:
    """The program: LIMITCHECK_PROGRAM, the one that was installed with this package, or the one on the path."""
    beside = Path(__file__).parent / "program"
    for place in (os.environ.get("LIMITCHECK_PROGRAM"), beside.read_text().strip() if beside.exists() else None,
                  shutil.which("limitcheck")):
        if place and os.path.exists(place):
            return place
    raise Error("the program limitcheck is not on the path: install it, or name it in LIMITCHECK_PROGRAM")


class Report:
    """What an audit found. `rows` and `causes` are lists of dictionaries, as in the JSON of `limitcheck audit`."""

    def __init__(self, document: dict, code: int, text: str):
        self.document, self.code, self.text = document, code, text
        self.rows: list[dict] = document["results"]
        self.causes: list[dict] = document["causes"]

    @property
    def held(self) -> bool:
        """Whether nothing was found."""
        return self.code == 0

    @property
    def findings(self) -> list[dict]:
        """The rows that say that something is wrong, breakdowns among them."""
        return [row for row in self.rows if row["status"] in ("finding", "error", "crash", "timeout")]

    def to_dataframe(self):
        """The rows as a pandas.DataFrame."""
        import pandas

        return pandas.DataFrame(self.rows)

    def __bool__(self) -> bool:
        return self.held

    def __repr__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        verdict = "nothing found" if self.held else f"{len(self.findings)} findings, {len(self.causes)} root causes"
        lines = "".join(f"<tr><td>{html.escape(c['severity'])}</td><td>{html.escape(c['title'])}</td>"
                        f"<td><code>{html.escape(c['command'] or '')}</code></td></tr>" for c in self.causes)
        return f"<p><b>{verdict}</b></p><table>{lines}</table>"


def audit(subject: Union[str, os.PathLike, Callable], meshes: Optional[Sequence] = None, *, scheme: Optional[str] = None,
          points: str = "limit", normals: bool = False, precision: str = "float64", weights: str = "loop", max_depth: int = 6,
          depth: Optional[int] = None, arguments: Sequence[str] = ()) -> Report:
    """Audits a tessellator.

    subject    a function (vertices, faces, depth) -> (vertices, faces) or (vertices, faces, normals), which subdivides the
               whole mesh `depth` times: vertices (n, 3) float64, faces (m, 3) or (m, 4) int32, or a list of faces where they
               differ in size. Or a shared library, "program:COMMAND", the name of a built-in subject.
    meshes     names, files, limitcheck.Mesh objects; by default those of `limitcheck audit` for one subject
    scheme     of a function: the one that it does, "loop" or "catmull-clark"; by default loop
    points     of a function: whether its vertices are points of the limit surface ("limit") or of the refined mesh ("refined")
    normals    of a function: whether it returns unit normals
    precision  of a function: "float64" or "float32", in which it computes
    weights    of a function of Loop's scheme: "loop" or "warren", its weights of interior vertices
    depth      how often the meshes are subdivided
    arguments  more of the command line: ["--level", "quick"]

    Where a vertex lies on the control mesh is found by how the faces are connected: only the function's points are judged.
    An exception in the function is a finding. Raises Error for what `limitcheck audit` refuses.
    """
    with _Question(subject, scheme, points, normals, precision, weights, max_depth) as ask:
        more = [] if depth is None else ["--depth", str(depth)]
        document, code, text = ask("audit", [*map(ask.mesh, meshes or []), *more, *arguments])
        return Report(document, code, text)


def hunt(subject: Union[str, os.PathLike, Callable], *, cases: int = 1000, seed: int = 1, scheme: Optional[str] = None,
         points: str = "limit", normals: bool = False, precision: str = "float64", weights: str = "loop", max_depth: int = 6,
         arguments: Sequence[str] = ()) -> dict:
    """Searches for anything wrong with a tessellator on random meshes; the rest is as for audit(). Returns the JSON of
    `limitcheck hunt` as a dictionary: ["findings"] has what was found, each shrunk to few faces."""
    with _Question(subject, scheme, points, normals, precision, weights, max_depth) as ask:
        return ask("hunt", ["--cases", str(cases), "--seed", str(seed), "--jobs", "1", "--witnesses",
                            os.path.join(ask.folder, "witnesses"), *arguments])[0]


class _Question:
    """The program, asked about a subject: a function of this process or whatever it takes itself."""

    def __init__(self, subject, scheme, points, normals, precision, weights, max_depth):
        self._folder = tempfile.TemporaryDirectory(prefix="limitcheck-")
        self.folder = self._folder.name
        self.scheme = [] if scheme is None else ["--scheme", scheme]
        self.meshes = 0
        self.served = None
        if callable(subject):
            self.served = _Served(subject, self.folder, scheme or "loop", points, normals, precision, weights, max_depth)
        self.label = self.served.label if self.served else os.fspath(subject)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.served:
            self.served.close()
        self._folder.cleanup()

    def mesh(self, mesh) -> str:
        """A mesh as the command line names it."""
        if not hasattr(mesh, "save"):
            return os.fspath(mesh)
        self.meshes += 1
        name = os.path.join(self.folder, f"mesh-{self.meshes}.obj")
        mesh.save(name)
        return name

    def __call__(self, command: str, arguments: Sequence[str]):
        report = os.path.join(self.folder, "report.json")
        done = subprocess.run([program(), command, self.label, *arguments, "--json", report, *self.scheme],
                              capture_output=True, text=True)
        if done.returncode not in (0, 1) or not os.path.exists(report):
            raise Error((done.stderr or done.stdout).strip() or f"limitcheck ended with {done.returncode}")
        text, document = done.stdout, Path(report).read_text()
        if self.served:  # by its name, not by the command of the relay
            for label in (_quoted(self.label), self.label):
                text = text.replace(label, self.served.name)
                document = document.replace(json.dumps(label)[1:-1], json.dumps(self.served.name)[1:-1])
        return json.loads(document), done.returncode, text


def check(mesh) -> dict:
    """What `limitcheck check` says of a mesh, as a dictionary; raises Error if it is none."""
    with tempfile.TemporaryDirectory(prefix="limitcheck-") as folder:
        name = mesh
        if hasattr(mesh, "save"):
            name = os.path.join(folder, "mesh.obj")
            mesh.save(name)
        done = subprocess.run([program(), "check", os.fspath(name), "--json"], capture_output=True, text=True)
        try:
            return json.loads(done.stdout)
        except json.JSONDecodeError:
            raise Error(done.stderr.strip()) from None


def repair(file: Union[str, os.PathLike], output: Union[str, os.PathLike], *arguments: str) -> str:
    """Repairs a mesh file into another one; returns what was done, and raises Error if it cannot be."""
    done = subprocess.run([program(), "repair", os.fspath(file), "-o", os.fspath(output), *arguments],
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise Error((done.stderr or done.stdout).strip())
    return done.stdout


class _Served:
    """Answers the protocol of verify/host/isolation/PROTOCOL.md with a function of this process: the program starts a relay
    (relay.py) for each mesh, which connects to a socket here."""

    def __init__(self, function: Callable, folder: str, scheme: str, points: str, normals: bool, precision: str, weights: str,
                 max_depth: int):
        self.function = function
        self.real = np.dtype(precision)
        self.capabilities = {"limitcheck": 2, "status": "ok", "schemes": [scheme], "precision": precision, "weights": weights,
                             "boundary": "spline", "points": points, "max_depth": max_depth, "normals": normals,
                             "per_face_depth": False, "exact_lattice": True, "provenance": False,
                             "does_not_validate": True}
        path = os.path.join(folder, "socket")
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.bind(path)
        self.socket.listen()
        self.lock = threading.Lock()
        relay = Path(__file__).with_name("relay.py")
        self.name = f"python:{getattr(function, '__qualname__', type(function).__name__)}"
        self.label = f"program:{_quoted(sys.executable)} -E -S {_quoted(str(relay))} {_quoted(path)}"
        threading.Thread(target=self._accept, daemon=True).start()

    def close(self):
        self.socket.close()

    def _accept(self):
        while True:
            try:
                connection, _ = self.socket.accept()
            except OSError:
                return
            threading.Thread(target=self._serve, args=(connection,), daemon=True).start()

    def _serve(self, connection):
        with connection, connection.makefile("rb") as questions, connection.makefile("wb") as answers:
            vertices = faces = None
            for line in questions:
                question = json.loads(line)
                payload = b""
                if question["request"] == "capabilities":
                    answer = self.capabilities
                elif question["request"] == "create":
                    vertices, faces = _read_mesh(question, questions)
                    answer = {"status": "ok"}
                else:
                    depth = np.frombuffer(questions.read(4 * question["faces"]), np.int32)[0]
                    try:
                        with self.lock:
                            answer, payload = self._tessellation(self.function(vertices.copy(), _copied(faces), int(depth)))
                    except Exception as error:  # noqa: BLE001: whatever the function raises is its answer
                        answer, payload = {"status": "failed", "message": f"{type(error).__name__}: {error}"[:500]}, b""
                try:
                    answers.write(json.dumps(answer).encode() + b"\n" + payload)
                    answers.flush()
                except OSError:
                    return

    def _tessellation(self, result):
        if not isinstance(result, (tuple, list)) or len(result) < 2 + self.capabilities["normals"]:
            raise ValueError("the function has to return (vertices, faces" +
                             (", normals)" if self.capabilities["normals"] else ")"))
        vertices, faces, *rest = result
        vertices = np.ascontiguousarray(vertices, self.real)
        if vertices.ndim != 2 or vertices.shape[1] != 3:
            raise ValueError(f"vertices have the shape {vertices.shape}, not (n, 3)")
        triangles = np.concatenate([_fan(face) for face in _groups(faces)])
        payload = vertices.tobytes()
        if self.capabilities["normals"]:
            payload += np.ascontiguousarray(rest[0], self.real).reshape(vertices.shape).tobytes()
        answer = {"status": "ok", "vertices": len(vertices), "triangles": len(triangles)}
        return answer, payload + np.ascontiguousarray(triangles, np.uint32).tobytes()


def _read_mesh(question: dict, source):
    def array(count, kind):
        kind = np.dtype(kind)
        return np.frombuffer(source.read(count * kind.itemsize), kind)

    vertices = array(3 * question["vertices"], np.float64).reshape(-1, 3)
    sizes = array(question["faces"], np.int32)
    corners = array(question["corners"], np.int32)
    source.read(12 * question["sharp_edges"] + 8 * question["sharp_vertices"])
    if (sizes == sizes[0]).all():
        return vertices, corners.reshape(-1, sizes[0])
    return vertices, np.split(corners, np.cumsum(sizes)[:-1])


def _copied(faces):
    return faces.copy() if isinstance(faces, np.ndarray) else [face.copy() for face in faces]


def _groups(faces):
    """(m, k) arrays of the faces, in their order."""
    if isinstance(faces, np.ndarray) and faces.ndim == 2:
        return [faces]
    return [np.asarray(face).reshape(1, -1) for face in faces]


def _fan(faces: np.ndarray) -> np.ndarray:
    """The triangles of each face, one face after the other."""
    if faces.shape[1] == 3:
        return faces
    return np.stack([faces[:, [0, k, k + 1]] for k in range(1, faces.shape[1] - 1)], 1).reshape(-1, 3)


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "'\\''") + "'"
