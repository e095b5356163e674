// SPDX-License-Identifier: MIT
// Opens the report in headless Chromium as a reader would: node browser_test.mjs INDEX.html FOLDER
// (npm ci --ignore-scripts in this folder first; Debian's chromium). Fails on a console error, a request to anywhere, a dead button or key,
// sideways scrolling on a telephone; leaves screenshots and a PDF in FOLDER.
import { chromium } from "playwright-core";
import path from "node:path";

const [page_file, folder] = process.argv.slice(2);
const problems = [];
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--disable-background-networking", "--disable-component-update"],
});
const shots = (name) => path.join(folder, `${name}.png`);

async function try_viewer(page, name) {
  const viewer = page.locator("#viewer"), canvas = viewer.locator("canvas"), words = viewer.locator("output");
  let last = null;
  async function changes(what, act) {
    await act();
    const now = await canvas.screenshot({ path: shots(`viewer-${name}-${what.replaceAll(" ", "-")}`) });
    if (last && last.equals(now)) problems.push(`${name}: the view does not change: ${what}`);
    last = now;
  }
  await canvas.scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.querySelector("#viewer output").textContent !== "");
  await changes("at first", async () => {});
  await changes("colour", () => viewer.locator("select[name=colour]").selectOption("position"));
  await changes("worst triangle", () => viewer.locator("button[name=worst]").click());
  await changes("arrow key", async () => { await canvas.focus(); await page.keyboard.press("ArrowLeft"); });
  await changes("plus key", () => page.keyboard.press("+"));

  const surface = viewer.locator("select[name=surface]");
  for (let k = (await surface.locator("option").count()) - 1; k >= 0; --k) {
    await changes(`surface ${k}`, () => surface.selectOption(String(k)));
    if (!(await words.textContent()).includes("diagonal")) problems.push(`${name}: surface ${k} has no legend of its errors`);
  }

  // A witness by keyboard alone: open the list, reach its button, press it.
  const button = page.locator("button.jump").first();
  if (await button.count()) {
    await page.locator("#audit summary").first().focus();
    await page.keyboard.press("Enter");
    const witness = JSON.parse(await button.getAttribute("data-witness"));
    await changes("witness", async () => { await button.focus(); await page.keyboard.press("Enter"); });
    if ((await words.textContent()) !== witness.text) problems.push(`${name}: the view does not say which witness it shows`);
    const focused = await page.evaluate(() => document.activeElement.tagName);
    if (focused !== "CANVAS") problems.push(`${name}: after a jump the keyboard is at ${focused}, not at the view`);
    await viewer.locator("button[name=table]").click();
    if (!(await button.evaluate((b) => b === document.activeElement))) problems.push(`${name}: the way back to the table does not lead to the witness`);
    // One witness of every mesh.
    await page.evaluate(() => {
      const seen = new Set();
      for (const b of document.querySelectorAll("button.jump")) {
        const { mesh } = JSON.parse(b.dataset.witness);
        if (!seen.has(mesh)) b.click();
        seen.add(mesh);
      }
    });
    await changes("back", () => viewer.locator("button[name=back]").click());
  } else if (await page.locator("#audit").count()) {
    problems.push(`${name}: no witness of the audit can be shown`);
  }
}

const wide = { width: 1400, height: 900 }, phone = { width: 390, height: 844 };
for (const [name, viewport, colorScheme] of [["wide", wide, "light"], ["wide-dark", wide, "dark"], ["phone", phone, "dark"], ["phone-light", phone, "light"]]) {
  const page = await browser.newPage({ viewport, colorScheme, offline: true });
  page.setDefaultTimeout(120000);
  page.on("console", (message) => message.type() === "error" && problems.push(`${name}: console: ${message.text()}`));
  page.on("pageerror", (error) => problems.push(`${name}: ${error.message}`));
  const file = "file://" + path.resolve(page_file);
  page.on("request", (request) => {
    if (request.url() !== file && !/^(data|blob):/.test(request.url())) problems.push(`${name}: asks for ${request.url()}`);
  });
  const start = Date.now();
  await page.goto(file);
  console.log(`${name}: loaded in ${((Date.now() - start) / 1000).toFixed(1)} s`);
  const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  if (overflow > 0) problems.push(`${name}: the page is ${overflow} pixels too wide`);
  // Section by section: a picture of the whole page would be too tall for the browser.
  const boxes = await page.evaluate(() => [...document.querySelectorAll("main > section")].map((section) => {
    const box = section.getBoundingClientRect();
    return { id: section.id, clip: { x: 0, y: box.y + scrollY, width: innerWidth, height: Math.min(box.height, 8000) } };
  }));
  for (const { id, clip } of boxes) await page.screenshot({ path: shots(`report-${name}-${id}`), fullPage: true, clip });
  if (await page.locator("#viewer").count()) await try_viewer(page, name);
  await page.evaluate(() => document.querySelectorAll("details").forEach((d) => (d.open = true)));
  const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  if (wider > 0) problems.push(`${name}: with everything unfolded the page is ${wider} pixels too wide`);
  if (name === "wide") await page.pdf({ path: path.join(folder, "report.pdf"), format: "A4" });
  await page.close();
}
await browser.close();
for (const problem of problems) console.error(problem);
console.log(problems.length ? `${problems.length} problems` : "the report works in Chromium: wide and phone, light and dark, keyboard");
process.exitCode = problems.length ? 1 : 0;
