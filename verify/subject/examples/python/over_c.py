#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A subject in Python whose work is done by C: the arrays that it fills are handed on without a copy.

    limitcheck audit --program "python3 over_c.py ./libloop.so" icosahedron holes --depth 3

The library is any with the C interface of <limitcheck/subject.h>; for another one change `Subject` and the calls. (A library
with this interface can be audited itself. This shows how Python calls it.)
"""
import ctypes as c
import json
import sys

LIMIT, FLOAT = ("limit", "refined"), ("float32", "float64")
STATUS = ("ok", "not-supported", "invalid-input", "failed")


class Capabilities(c.Structure):
    _fields_ = [(name, c.c_int32) for name in ("precision", "weights", "boundary", "points", "max_depth", "normals",
                "per_face_depth", "exact_lattice")] + [("size", c.c_uint32), ("scheme", c.c_int32),
                                                       ("schemes", c.c_int32), ("sharp", c.c_int32),
                                                       ("does_not_validate", c.c_int32), ("no_provenance", c.c_int32),
                                                       ("channel_rules", c.c_int32), ("channel_derivatives", c.c_int32),
                                                       ("points_anywhere", c.c_int32), ("quads_only", c.c_int32)]


class Mesh(c.Structure):
    _fields_ = [("positions", c.c_void_p), ("vertex_count", c.c_int64), ("triangles", c.c_void_p), ("triangle_count", c.c_int64),
                ("size", c.c_uint32), ("scheme", c.c_int32), ("corners", c.c_void_p), ("corner_count", c.c_int64),
                ("face_sizes", c.c_void_p), ("face_count", c.c_int64), ("sharp_edges", c.c_void_p), ("sharp_edge_count", c.c_int64),
                ("sharp_vertices", c.c_void_p), ("sharp_vertex_count", c.c_int64), ("creasing", c.c_int32),
                ("corners_held", c.c_int32), ("smooth_triangles", c.c_int32), ("channels", c.c_void_p),
                ("channel_count", c.c_int64)]


Allocate = c.CFUNCTYPE(c.c_void_p, c.c_void_p, c.c_size_t)


class Request(c.Structure):
    _fields_ = [("face_depth", c.c_void_p), ("threads", c.c_int32), ("host", c.c_void_p), ("allocate", Allocate),
                ("size", c.c_uint32)]


class Tessellation(c.Structure):
    _fields_ = [("vertex_count", c.c_int64), ("triangle_count", c.c_int64)] + [(name, c.c_void_p) for name in (
        "positions", "normals", "provenance", "triangles", "triangle_face", "owner")] + [("size", c.c_uint32)] + [
        (name, c.c_void_p) for name in ("corner", "channel_values", "channel_derivatives")]


Message = c.POINTER(c.c_char_p)


class Subject(c.Structure):
    _fields_ = [("abi", c.c_uint32), ("name", c.c_char_p), ("description", c.c_char_p), ("options", c.c_char_p),
                ("capabilities", c.CFUNCTYPE(c.c_int, c.c_char_p, c.POINTER(Capabilities), Message)),
                ("create", c.CFUNCTYPE(c.c_int, c.POINTER(Mesh), c.c_char_p, c.POINTER(c.c_void_p), Message)),
                ("tessellate", c.CFUNCTYPE(c.c_int, c.c_void_p, c.POINTER(Request), c.POINTER(Tessellation), Message)),
                ("release", c.CFUNCTYPE(None, c.c_void_p, c.POINTER(Tessellation))),
                ("destroy", c.CFUNCTYPE(None, c.c_void_p))]


def answer(message, arrays=()):
    sys.stdout.buffer.write(json.dumps(message).encode() + b"\n")
    for address, size in arrays:  # of the memory that the library has filled
        sys.stdout.buffer.write(memoryview((c.c_char * size).from_address(address)).cast("B"))
    sys.stdout.buffer.flush()


def refusal(status, message):
    return {"limitcheck": 1, "status": STATUS[status], "message": (message.value or b"").decode()}


library = c.CDLL(sys.argv[1])
library.lc_subject_get.restype = c.POINTER(Subject)
library.lc_subject_get.argtypes = [c.c_uint32]
subject = next(table for table in map(library.lc_subject_get, (2, 1)) if table)[0]
message, able, instance = c.c_char_p(), Capabilities(size=c.sizeof(Capabilities)), c.c_void_p()
while line := sys.stdin.buffer.readline():
    question = json.loads(line)
    options = question.get("options", "").encode() or None
    if question["request"] == "capabilities":
        status = subject.capabilities(options, able, message)
        answer(refusal(status, message) if status else {
            "limitcheck": 1, "status": "ok", "precision": FLOAT[able.precision], "weights": ("loop", "warren")[able.weights],
            "boundary": ("spline", "none")[able.boundary], "points": LIMIT[able.points], "max_depth": able.max_depth,
            "normals": bool(able.normals), "per_face_depth": bool(able.per_face_depth), "exact_lattice": bool(able.exact_lattice),
            "does_not_validate": bool(able.does_not_validate), "provenance": not able.no_provenance})
    elif question["request"] == "create":
        positions = bytearray(sys.stdin.buffer.read(24 * question["vertices"]))
        corners = bytearray(sys.stdin.buffer.read(12 * question["triangles"]))
        sizes = (c.c_int32 * question["triangles"])(*[3] * question["triangles"])
        address = [c.addressof((c.c_char * max(len(a), 1)).from_buffer(a if a else bytearray(1))) for a in (positions, corners)]
        mesh = Mesh(positions=address[0], vertex_count=question["vertices"], triangles=address[1], triangle_count=question["triangles"],
                    size=c.sizeof(Mesh), corners=address[1], corner_count=3 * question["triangles"],
                    face_sizes=c.addressof(sizes), face_count=question["triangles"])
        status = subject.create(mesh, options, instance, message)
        answer(refusal(status, message) if status else {"status": "ok"})
    else:
        depths, blocks = bytearray(sys.stdin.buffer.read(4 * question["triangles"])), []

        def allocate(_, size):
            blocks.append((c.c_char * (size + 64))())
            return (c.addressof(blocks[-1]) + 63) & ~63

        out = Tessellation(size=c.sizeof(Tessellation))
        request = Request(face_depth=c.addressof((c.c_char * len(depths)).from_buffer(depths)), threads=question["threads"],
                          allocate=Allocate(allocate), size=c.sizeof(Request))
        status = subject.tessellate(instance, request, out, message)
        vector = 3 * (4, 8)[able.precision]
        answer(refusal(status, message) if status else {"status": "ok", "vertices": out.vertex_count, "triangles": out.triangle_count},
               () if status else [(at, size) for at, size in (
                   (out.positions, vector * out.vertex_count), (out.normals if able.normals else None, vector * out.vertex_count),
                   (out.provenance, 16 * out.vertex_count), (out.triangles, 12 * out.triangle_count),
                   (out.triangle_face, 4 * out.triangle_count)) if at])
        if not status:
            subject.release(instance, out)
if instance:
    subject.destroy(instance)
