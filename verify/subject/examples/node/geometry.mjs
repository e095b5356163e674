// SPDX-License-Identifier: MIT
// Audits a function of this process: node geometry.mjs icosahedron holes --depth 3
import { audit } from "./index.mjs";
import { fault, loop } from "./loop.mjs";

audit("loop-in-javascript", ({ position, index }, depth) => {
  let geometry = { position: Float32Array.from(position), index };
  const why = fault(geometry);
  if (why) throw new Error(why);
  for (let step = 0; step < depth; ++step) geometry = loop(geometry);
  return geometry;
}, { points: "refined", precision: "float32" });
