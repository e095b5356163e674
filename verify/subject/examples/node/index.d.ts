// SPDX-License-Identifier: MIT

/** A control mesh, the function's own: it may keep and change it. */
export interface Mesh {
  /** x, y, z of each vertex */
  position: Float64Array;
  /** the corners of each face, counter-clockwise from outside */
  faces: number[][];
  /** three corners of each triangle, as three.js has them; larger faces are cut from their first corner */
  index: Uint32Array;
}

/** A subdivided mesh: triangles, or faces of any size. A mesh without index and faces is a soup of triangles. */
export interface Geometry {
  /** flat, or a list of points */
  position: ArrayLike<number> | ArrayLike<ArrayLike<number>>;
  /** of length 1; needed if normals are promised */
  normal?: ArrayLike<number> | ArrayLike<ArrayLike<number>>;
  index?: ArrayLike<number>;
  faces?: ArrayLike<number>[];
}

/** As three.js has it. */
export interface BufferGeometry {
  attributes: { position: { array: ArrayLike<number> }; normal?: { array: ArrayLike<number> } };
  index: { array: ArrayLike<number> } | null;
}

export interface Options {
  /** default "loop" */
  scheme?: "loop" | "catmull-clark";
  /** whether the points lie on the limit surface, or are those of the refined mesh; default "limit" */
  points?: "limit" | "refined";
  /** in which the function computes; default "float64" */
  precision?: "float32" | "float64";
  /** of Loop's scheme; default "loop" */
  weights?: "loop" | "warren";
  /** whether normals are returned; default false */
  normals?: boolean;
  /** default 6 */
  maxDepth?: number;
}

/** Subdivides a whole mesh `depth` times. What it throws is a finding. */
export type Tessellate = (mesh: Mesh, depth: number) => Geometry | BufferGeometry;

/**
 * Audits a function: runs `limitcheck audit` with the arguments of the command line (or with `options.arguments`) and ends the
 * process with its exit code: 0 held, 1 findings, 2 bad usage.
 */
export function audit(name: string, tessellate: Tessellate, options?: Options & { arguments?: string[] }): void;

/** Answers `limitcheck audit --program "node this.mjs"`; it does not return. */
export function serve(tessellate: Tessellate, options?: Options): never;
