// SPDX-License-Identifier: MIT
// A Vega-Lite specification to SVG: node render.mjs SPEC.vl.json [NAME=DATA.json ...] > FIGURE.svg
// NAME is the name of a data source in the specification; paths are relative to the working directory. SPEC.vl.json#2 is
// the second of the specification's "panels", each of which adds to what stands beside them.
import { readFileSync } from "node:fs";
import * as vega from "vega";
import { compile } from "vega-lite";

try {
  const [specification, ...sources] = process.argv.slice(2);
  if (!specification) throw new Error("usage: node render.mjs SPEC.vl.json [NAME=DATA.json ...] > FIGURE.svg");
  const [file, panel] = specification.split("#");
  const { panels, ...common } = JSON.parse(readFileSync(file, "utf8"));
  const own = panel ? panels[panel - 1] : {};
  const spec = { ...common, ...own };
  if (common.encoding && own.encoding) spec.encoding = { ...common.encoding, ...own.encoding };
  for (const source of sources) {
    const [name, file] = source.split(/=(.*)/s);
    spec.datasets = { ...spec.datasets, [name]: JSON.parse(readFileSync(file, "utf8")) };
  }
  const view = new vega.View(vega.parse(compile(spec).spec), { renderer: "none", logLevel: vega.Error });
  process.stdout.write(await view.toSVG());
} catch (error) {
  console.error(`render.mjs: ${error.message}`);
  process.exitCode = 2;
}
