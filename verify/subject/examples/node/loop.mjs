// SPDX-License-Identifier: MIT
// A tessellator such as yours may be: Loop's subdivision of geometries as three.js has them, { position: Float32Array,
// index: Uint32Array }, one step after another. It knows nothing of limitcheck; geometry.mjs does.
export function loop({ position, index }) {
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
export function fault({ position, index }) {
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
