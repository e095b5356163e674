#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// A subject in JavaScript: what subdivides geometries as three.js has them, { position: Float32Array, index: Uint32Array },
// step by step. Put the subdivision that you use in the place of `loop`; it must cut triangle t into 4 t, 4 t + 1, 4 t + 2
// at its corners, each beginning there, and 4 t + 3 in the middle, beginning at the middle of its first side.
//
//     limitcheck audit --program "node geometry.mjs" icosahedron holes --depth 3
import { readSync, writeSync } from "node:fs";

function loop({ position, index }) {
  const vertices = position.length / 3, key = (a, b) => Math.min(a, b) * vertices + Math.max(a, b);
  const edges = new Map(), around = Array.from({ length: vertices }, () => new Set());
  for (let h = 0; h < index.length; ++h) {
    const t = h - (h % 3), a = index[h], b = index[t + ((h + 1) % 3)], k = key(a, b);
    if (!edges.has(k)) edges.set(k, { a, b, opposite: [], vertex: vertices + edges.size });
    edges.get(k).opposite.push(index[t + ((h + 2) % 3)]);
  }
  const boundary = new Map();
  for (const { a, b, opposite } of edges.values()) {
    around[a].add(b); around[b].add(a);
    if (opposite.length === 1) for (const [v, w] of [[a, b], [b, a]]) boundary.set(v, [...(boundary.get(v) ?? []), w]);
  }
  const out = new Float32Array(3 * (vertices + edges.size));
  const set = (v, terms) => { for (let k = 0; k < 3; ++k) out[3 * v + k] = terms.reduce((sum, [w, p]) => sum + w * position[3 * p + k], 0); };
  for (let v = 0; v < vertices; ++v) {
    const ring = boundary.get(v) ?? [...around[v]], n = ring.length;
    const w = boundary.has(v) ? 1 / 8 : (5 / 8 - (3 + 2 * Math.cos((2 * Math.PI) / n)) ** 2 / 64) / n;
    set(v, [[1 - n * w, v], ...ring.map((p) => [w, p])]);
  }
  for (const { a, b, opposite, vertex } of edges.values())
    set(vertex, opposite.length === 1 ? [[1 / 2, a], [1 / 2, b]] : [[3 / 8, a], [3 / 8, b], ...opposite.map((p) => [1 / 8, p])]);
  const triangles = [];
  for (let t = 0; t < index.length; t += 3) {
    const v = [...index.subarray(t, t + 3)], m = v.map((a, k) => edges.get(key(a, v[(k + 1) % 3])).vertex);
    triangles.push(v[0], m[0], m[2], v[1], m[1], m[0], v[2], m[2], m[1], m[0], m[1], m[2]);
  }
  return { position: out, index: Uint32Array.from(triangles) };
}

// Why this is no mesh that can be subdivided, or nothing.
function fault({ position, index }) {
  const vertices = position.length / 3, sides = new Set(), next = new Map();
  if (index.length === 0) return "there are no triangles";
  if (!position.every(Number.isFinite)) return "a coordinate is not finite";
  for (let h = 0; h < index.length; ++h) {
    const t = h - (h % 3), a = index[h], b = index[t + ((h + 1) % 3)], side = `${a} ${b}`;
    if (!(a < vertices && b < vertices)) return "a triangle names a vertex that does not exist";
    if (sides.has(side)) return "two triangles run along an edge in the same direction";
    sides.add(side);
    next.set(a, (next.get(a) ?? new Map()).set(b, index[t + ((h + 2) % 3)]));
  }
  for (const ring of next.values()) {  // from the boundary, if there is one, all the way round
    const ends = new Set(ring.values()), start = [...ring.keys()].find((b) => !ends.has(b)) ?? ring.keys().next().value;
    let count = 0;
    for (let b = start; ring.has(b) && count < ring.size; b = ring.get(b)) ++count;
    if (count !== ring.size || [...ring.keys()].filter((b) => !ends.has(b)).length > 1) return "the triangles at a vertex form more than one fan";
  }
  return null;
}

// The protocol: verify/host/isolation/PROTOCOL.md, version 1.
let kept = Buffer.alloc(0);
function bytes(enough) {
  for (let end = enough(kept); ; end = enough(kept)) {
    if (end >= 0) {
      const taken = kept.subarray(0, end);
      kept = kept.subarray(end);
      return taken;
    }
    const chunk = Buffer.alloc(1 << 16), count = readSync(0, chunk);
    if (count === 0) process.exit(0);
    kept = Buffer.concat([kept, chunk.subarray(0, count)]);
  }
}
const take = (count) => Uint8Array.from(bytes((b) => (b.length >= count ? count : -1))).buffer;
function answer(object, ...arrays) {
  for (const part of [Buffer.from(JSON.stringify({ status: "ok", ...object }) + "\n"), ...arrays.map((a) => Buffer.from(a.buffer))])
    for (let done = 0; done < part.length; ) done += writeSync(1, part, done);
}

let control = null;
for (;;) {
  const question = JSON.parse(bytes((b) => b.indexOf(10) + 1 || -1).toString());
  if (question.request === "capabilities") {
    answer({ limitcheck: 1, precision: "float32", weights: "loop", boundary: "spline", points: "refined", max_depth: 6,
             normals: false, per_face_depth: false, exact_lattice: true });
  } else if (question.request === "create") {
    control = { position: Float32Array.from(new Float64Array(take(24 * question.vertices))), index: new Uint32Array(take(12 * question.triangles)) };
    const why = fault(control);
    answer(why ? { status: "invalid-input", message: why } : {});
  } else {
    const depth = new Int32Array(take(4 * question.triangles))[0], n = 2 ** depth;
    let geometry = control, at = [...Array(control.index.length / 3)].map((_, face) => ({ face, corners: [[0, 0], [n, 0], [0, n]] }));
    for (let step = 0; step < depth; ++step) {
      geometry = loop(geometry);
      at = at.flatMap(({ face, corners: c }) => {
        const m = c.map((p, k) => [(p[0] + c[(k + 1) % 3][0]) / 2, (p[1] + c[(k + 1) % 3][1]) / 2]);
        return [[c[0], m[0], m[2]], [c[1], m[1], m[0]], [c[2], m[2], m[1]], [m[0], m[1], m[2]]].map((corners) => ({ face, corners }));
      });
    }
    const place = new Uint32Array((4 * geometry.position.length) / 3), faces = Int32Array.from(at, (t) => t.face);
    at.forEach(({ face, corners }, t) => corners.forEach((p, k) => place.set([face, p[0], p[1], n], 4 * geometry.index[3 * t + k])));
    answer({ vertices: geometry.position.length / 3, triangles: faces.length }, geometry.position, place, geometry.index, faces);
  }
}
