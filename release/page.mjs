/* Runs every part of the page in chromium, the page under a path of its own, and compares the tapes with examples/. */
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join } from "node:path";

const { chromium } = createRequire(join(process.cwd(), "web/package.json"))("playwright-core");
const FOLDER = process.argv[2];
const PATH = "/tools/skg/";
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".svg": "image/svg+xml" };
const asked = [];
const server = createServer((request, response) => {
  const name = decodeURI(request.url.replace(/[?#].*/, ""));
  const file = name.startsWith(PATH) ? join(FOLDER, name.slice(PATH.length) || "index.html") : "";
  if (!file || !existsSync(file)) asked.push(name);
  response.writeHead(file && existsSync(file) ? 200 : 404, { "content-type": TYPES[extname(file)] ?? "application/octet-stream" });
  response.end(file && existsSync(file) ? readFileSync(file) : "");
});
await new Promise((started) => server.listen(0, "127.0.0.1", started));
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
const page = await (await browser.newContext({ acceptDownloads: true })).newPage();
page.setDefaultTimeout(120_000);
const said = [];
page.on("pageerror", (error) => said.push(String(error)));
const parts = JSON.parse(readFileSync(join(FOLDER, "parts.json"), "utf8"));
let right = 0;
for (const { name } of parts) {
  await page.goto("about:blank");
  await page.goto(`http://127.0.0.1:${server.address().port}${PATH}#part=${name}&run`);
  const blocks = readFileSync(`examples/${name}.3b`, "latin1").split("\r\n").filter((line) => line.startsWith("B")).length;
  await page.waitForFunction((count) => (document.querySelector("#sum")?.textContent ?? "").startsWith(`${count} blocks`)
    && document.getElementById("state")?.textContent === "at its prompt", blocks);
  await page.locator("details.menu summary").first().click();
  const [download] = await Promise.all([page.waitForEvent("download"), page.click('[data-save="3b"]')]);
  assert.equal(readFileSync(await download.path(), "latin1"), readFileSync(`examples/${name}.3b`, "latin1"), name);
  right++;
}
assert.deepEqual(said, []);
assert.deepEqual(asked.filter((name) => name.startsWith(PATH)), []);
assert.ok(right > 40);
console.log(`${right} of ${parts.length} parts, under ${PATH}`);
await browser.close();
server.close();
