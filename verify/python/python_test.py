# SPDX-License-Identifier: MIT
"""The Python package as a user meets it. Values are known ones, or held against the certified point."""
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

import numpy as np

import limitcheck


def right(vertices, faces, depth):
    t = limitcheck.Mesh(vertices, faces).tessellate(depth)
    return t.positions, t.triangles


def wrong(vertices, faces, depth):
    """One vertex 1e-4 too far out."""
    positions, triangles = right(vertices, faces, depth)
    positions[len(positions) // 2] *= 1.0001
    return positions, triangles


def quads(vertices, faces, depth):
    """Catmull and Clark's surface, each quad as such, in another order, each face with vertices of its own."""
    t = limitcheck.Mesh(vertices, faces, scheme="catmull-clark").tessellate(depth)
    corners = t.triangles.reshape(-1, 2, 3)
    faces = np.array([_quad(a, b) for a, b in corners])[::-1]
    return t.positions[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 4)


def _quad(a, b):
    """The corners of two triangles that share a side, around."""
    for k in range(3):
        if a[k] not in b:
            far = next(v for v in b if v not in a)
            return [a[k], a[(k + 1) % 3], far, a[(k + 2) % 3]]
    raise AssertionError("two triangles of the same corners")


class Package(unittest.TestCase):
    def test_a_point_is_the_certified_one(self):
        for mesh, corner in ((limitcheck.Mesh.generate("icosahedron"), 0), (limitcheck.Mesh.generate("quad-cube"), 0),
                             (limitcheck.Mesh.generate("icosahedron", scheme="catmull-clark"), 2)):
            u, v = Fraction(1, 3), Fraction(1, 5)
            found = mesh.evaluate([4], [(float(u), float(v))], corners=[corner])
            exact = mesh.certified(4, u, v, corner=corner, digits=30)
            for name, array in found.items():
                self.assertEqual(array.shape, (1, 3))
                # Positions of a mesh of size 2 are right to 1e-15, first derivatives to 1e-14 (StamError); second ones are
                # some 4 times as large here.
                np.testing.assert_allclose(array[0], [float(x) for x in exact[name].value], rtol=0, atol=4e-14)
            self.assertLess(exact["position"].radius, 1e-29)

    def test_derivatives_that_do_not_exist_are_nan(self):
        at_corner = limitcheck.Mesh.generate("icosahedron").evaluate([0], [(0, 0)])
        self.assertTrue(np.isnan(at_corner["d11"]).all())
        self.assertAlmostEqual(np.linalg.norm(at_corner["normal"]), 1)

    def test_a_mesh_of_arrays_is_the_mesh(self):
        cube = limitcheck.Mesh.generate("quad-cube")
        same = limitcheck.Mesh(cube.vertices, np.array(cube.faces), creases=[(0, 1, 2.5)])
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "cube.obj"
            same.save(file)
            again = limitcheck.Mesh.load(file)
        at = ([0], [(.25, .5)])
        np.testing.assert_array_equal(again.evaluate(*at)["position"], same.evaluate(*at)["position"])
        self.assertGreater(np.abs(same.evaluate(*at)["position"] - cube.evaluate(*at)["position"]).max(), 1e-3)

    def test_a_vertex_lies_where_its_provenance_says(self):
        for mesh in (limitcheck.Mesh.generate("bumpy:20"), limitcheck.generate("dual:icosahedron")):
            size = np.ptp(mesh.vertices, axis=0).max()
            for t in (mesh.tessellate(2), mesh.tessellate([k % 3 for k in range(len(mesh.faces))]),
                      mesh.tessellate(camera=((0, 0, 9), (0, 0, 0)), pixels=20)):
                self.assertGreater(len(t.triangles), 0)
                self.assertLess(t.triangles.max(), len(t.positions))
                at = mesh.evaluate(t.faces, t.uv, corners=t.corners, derivatives=1)
                on_lattice = np.abs(t.uv * 2**5 % 1) < 1e-12  # not the centres of fans, at thirds
                rows = on_lattice.all(axis=1)
                # The window's sums err by 1e-14 of the diagonal (verify/row/bounds.h).
                np.testing.assert_allclose(t.positions[rows], at["position"][rows], rtol=0, atol=2e-14 * size)
        near, far = (len(mesh.tessellate(camera=(0, 0, z)).triangles) for z in (3, 30))
        self.assertGreater(near, far)

    def test_a_hunt_finds_what_is_wrong_and_nothing_else(self):
        self.assertEqual(limitcheck.hunt(right, cases=12)["findings"], [])
        self.assertIn("positions", {f["check"] for f in limitcheck.hunt(wrong, cases=12, arguments=["--attempts", "5"])["findings"]})

    def test_matrices_of_any_kind_are_the_mesh(self):
        """As libigl has them: column by column, in other types."""
        cube = limitcheck.generate("octahedron")
        expected = cube.evaluate([3], [(.25, .5)])["position"]
        for real, whole in ((np.float64, np.int64), (np.float32, np.int32), (np.float64, np.uint16)):
            mesh = limitcheck.Mesh(np.asfortranarray(cube.vertices.astype(real)), np.asfortranarray(np.array(cube.faces, whole)))
            np.testing.assert_array_equal(mesh.evaluate(np.array([3], whole), np.asfortranarray([(.25, .5)]))["position"], expected)

    def test_errors_are_sentences(self):
        with self.assertRaisesRegex(limitcheck.Error, "MESH_INDEX_OUT_OF_RANGE: face 0 names vertex 1"):
            limitcheck.Mesh([(0, 0, 0)], [(0, 1, 2)])
        mesh = limitcheck.Mesh.generate("icosahedron")
        for wrong_call in (lambda: mesh.evaluate([20], [(0, 0)]), lambda: mesh.evaluate([0], [(0, 0, 0)]),
                           lambda: mesh.certified(0, "1/0", 0), lambda: limitcheck.Mesh.load("nowhere.obj"),
                           lambda: limitcheck.Mesh.generate("nothing"), lambda: limitcheck.Mesh([], []),
                           lambda: limitcheck.audit("no-such-subject", ["icosahedron"]),
                           lambda: mesh.tessellate(), lambda: mesh.tessellate(11), lambda: mesh.tessellate(1, camera=(0, 0, 4)),
                           lambda: mesh.tessellate(camera=(0, 0, 0)), lambda: mesh.tessellate(camera=(1, 2)),
                           lambda: mesh.tessellate([1, 2]),
                           lambda: limitcheck.check("nowhere.obj")):
            with self.assertRaises(ValueError):
                wrong_call()

    def test_a_right_function_is_held(self):
        report = limitcheck.audit(right, ["icosahedron", "fan:7", limitcheck.Mesh.generate("torus:4:3")], depth=2)
        self.assertTrue(report.held, report.text)
        self.assertIn("python:right", {row["subject"] for row in report.rows})

    def test_quads_in_any_order_are_held(self):
        report = limitcheck.audit(quads, ["quad-torus:5:4", "dual:icosahedron"], depth=2, scheme="catmull-clark")
        self.assertTrue(report.held, report.text)

    def test_one_wrong_vertex_is_found(self):
        report = limitcheck.audit(wrong, ["bumpy:20"], depth=2)
        self.assertFalse(report)
        row = next(row for row in report.findings if row["check"] == "positions")
        self.assertEqual(row["count"], 1)
        self.assertIn("wrong", report._repr_html_() + report.text)

    def test_what_is_no_such_mesh_is_a_finding(self):
        def coarser(vertices, faces, depth):
            return right(vertices, faces, max(0, depth - 1))

        def fails(vertices, faces, depth):
            raise KeyError("nothing there")

        report = limitcheck.audit(right, ["icosahedron"], depth=1, normals=True)
        self.assertTrue(any("has to return (vertices, faces, normals)" in (row["message"] or "") for row in report.findings))
        for function, text in ((coarser, "80 triangles were delivered; the mesh has 320 at depth 2"), (fails, "KeyError")):
            report = limitcheck.audit(function, ["icosahedron"], depth=2)
            self.assertFalse(report.held)
            self.assertTrue(any(text in (row["message"] or "") for row in report.findings), report.text)

    def test_the_wheel_can_be_installed_without_a_network(self):
        with tempfile.TemporaryDirectory() as folder:
            place = Path(limitcheck.__file__).parent.parent
            sys.path.insert(0, str(place))
            import backend

            wheel = Path(folder) / backend.build_wheel(folder)
            subprocess.run([sys.executable, "-m", "zipfile", "-e", str(wheel), folder + "/there"], check=True)
            subprocess.run([sys.executable, "-c", "import limitcheck; limitcheck.Mesh.generate('octahedron')"], check=True,
                           env={"PYTHONPATH": folder + "/there"}, cwd=folder)


if __name__ == "__main__":
    unittest.main()
