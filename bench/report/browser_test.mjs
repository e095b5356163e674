// SPDX-License-Identifier: MIT
// Opens the report in headless Chromium as a reader would: node browser_test.mjs INDEX.html FOLDER
// Fails on any console error, a dead button, or sideways scrolling on a telephone; leaves screenshots in FOLDER.
import { chromium } from "playwright-core";
import path from "node:path";

const [page_file, folder] = process.argv.slice(2);
const problems = [];
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--disable-background-networking", "--disable-component-update"],
});
for (const [name, viewport, colorScheme] of [["wide", { width: 1280, height: 900 }, "light"], ["phone", { width: 390, height: 844 }, "dark"]]) {
  const page = await browser.newPage({ viewport, colorScheme, offline: true });
  page.setDefaultTimeout(120000);
  page.on("console", (message) => message.type() === "error" && problems.push(`${name}: console: ${message.text()}`));
  page.on("pageerror", (error) => problems.push(`${name}: ${error.message}`));
  await page.goto("file://" + path.resolve(page_file));
  const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  if (overflow > 0) problems.push(`${name}: the page is ${overflow} pixels too wide`);
  const viewer = page.locator("#viewer");
  if (await viewer.count()) {
    const canvas = viewer.locator("canvas");
    await canvas.scrollIntoViewIfNeeded();
    const before = await canvas.screenshot({ path: path.join(folder, `viewer-${name}.png`) });
    await viewer.locator("select").selectOption("position");
    await viewer.locator("button").click();
    const after = await canvas.screenshot({ path: path.join(folder, `viewer-${name}-worst.png`) });
    if (before.equals(after)) problems.push(`${name}: the viewer does not change when its button is pressed`);
  }
  for (const summary of await page.locator("summary").all()) await summary.click();
  await page.screenshot({ path: path.join(folder, `report-${name}.png`), fullPage: true });
  await page.close();
}
await browser.close();
for (const problem of problems) console.error(problem);
console.log(problems.length ? `${problems.length} problems` : "the report works in Chromium: wide and phone, light and dark");
process.exitCode = problems.length ? 1 : 0;
