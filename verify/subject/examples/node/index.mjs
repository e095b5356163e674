// SPDX-License-Identifier: MIT
// limitcheck for Node: audits a function that subdivides meshes. No dependencies; the program `limitcheck` is on the path, or
// named in LIMITCHECK_PROGRAM. index.d.ts says what is taken and returned.
import { spawn } from "node:child_process";
import { readSync, writeSync } from "node:fs";

/** A shell's word. */
const quoted = (text) => `'${text.replaceAll("'", "'\\''")}'`;

/** Runs `limitcheck audit` on `tessellate` with the arguments of the command line, and ends with its exit code. */
export function audit(name, tessellate, { arguments: given = process.argv.slice(2), ...options } = {}) {
  if (process.env.LIMITCHECK_SERVES === name) return serve(tessellate, options);
  const self = `LIMITCHECK_SERVES=${quoted(name)} ${quoted(process.execPath)} ${quoted(process.argv[1])}`;
  const program = process.env.LIMITCHECK_PROGRAM ?? "limitcheck";
  const child = spawn(program, ["audit", "--program", self, ...given], { stdio: "inherit" });
  child.on("error", (error) => {
    console.error(error.code === "ENOENT" ? `there is no program ${program}: install limitcheck, or name it in LIMITCHECK_PROGRAM` : error.message);
    process.exit(2);
  });
  child.on("exit", (code, signal) => process.exit(code ?? (signal ? 1 : 2)));
}

/** Answers the questions of `limitcheck audit --program "node this.mjs"`: verify/host/isolation/PROTOCOL.md, version 2. */
export function serve(tessellate, { scheme = "loop", points = "limit", precision = "float64", weights = "loop", normals = false, maxDepth = 6 } = {}) {
  const Real = { float32: Float32Array, float64: Float64Array }[precision];
  if (!Real) throw new Error(`precision is "float32" or "float64", not ${JSON.stringify(precision)}`);
  let mesh = null;
  for (;;) {
    const question = JSON.parse(bytes((b) => b.indexOf(10) + 1 || -1).toString());
    if (question.request === "capabilities") {
      answer({ limitcheck: 2, schemes: [scheme], precision, weights, boundary: "spline", points, max_depth: maxDepth, normals,
               per_face_depth: false, exact_lattice: true, provenance: false, does_not_validate: true });
    } else if (question.request === "create") {
      mesh = read(question);
      answer({});
    } else {
      const depth = new Int32Array(take(4 * question.faces))[0];
      let parts;
      try {
        parts = delivered(tessellate(copied(mesh), depth), Real, normals);
      } catch (error) {
        answer({ status: "failed", message: String(error?.message ?? error).slice(0, 500) });
        continue;
      }
      answer({ vertices: parts[0].length / 3, triangles: parts.at(-1).length / 3 }, ...parts);
    }
  }
}

function read({ vertices, faces, corners, sharp_edges: edges, sharp_vertices: held }) {
  const position = new Float64Array(take(24 * vertices)), sizes = new Int32Array(take(4 * faces));
  const all = new Int32Array(take(4 * corners));
  take(12 * edges + 8 * held);
  let first = 0;
  return { position, faces: Array.from(sizes, (size) => Array.from(all.subarray(first, (first += size)))) };
}

// What a function may keep and change: a mesh as index.d.ts has it.
function copied({ position, faces }) {
  return { position: position.slice(), faces: faces.map((face) => face.slice()), index: Uint32Array.from(faces.flatMap(fan)) };
}
const fan = (face) => face.slice(2).flatMap((last, k) => [face[0], face[k + 1], last]);

// Positions, normals if there are to be some, triangles.
function delivered(geometry, Real, normals) {
  const given = geometry?.attributes ? { position: geometry.attributes.position.array, normal: geometry.attributes.normal?.array, index: geometry.index?.array } : geometry;
  if (!given?.position) throw new Error("the function has to return { position, index } or { position, faces }, or a BufferGeometry");
  const flat = (list) => Real.from(typeof list[0] === "number" || list.length === 0 ? list : Array.from(list).flat());
  const position = flat(given.position);
  const index = given.faces ? given.faces.flatMap((face) => fan(Array.from(face))) : given.index ?? Array.from({ length: position.length / 3 }, (_, v) => v);
  if (normals && !given.normal) throw new Error("normals are promised, and the function returned none");
  return [position, ...(normals ? [flat(given.normal)] : []), Uint32Array.from(index)];
}

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
  const parts = [Buffer.from(JSON.stringify({ status: "ok", ...object }) + "\n"), ...arrays.map((a) => Buffer.from(a.buffer, a.byteOffset, a.byteLength))];
  for (const part of parts) for (let done = 0; done < part.length; ) done += writeSync(1, part, done);
}
