// SPDX-License-Identifier: MIT
// A script and all it imports as one file: node bundle.mjs IN.mjs OUT.js
import { build } from "esbuild";

try {
  const [script, outfile] = process.argv.slice(2);
  await build({ entryPoints: [script], outfile, bundle: true, minify: true, format: "esm", legalComments: "eof", logLevel: "silent" });
} catch (error) {
  console.error(`bundle.mjs: ${error.message}`);
  process.exitCode = 2;
}
