/** The page in Debian's chromium. */
import assert from "node:assert/strict";
import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { chromium, type Browser, type BrowserContext, type BrowserContextOptions, type Page } from "playwright-core";
import type { Part } from "../src/parts.ts";
import { layOut } from "../src/placed.ts";
import { readTape } from "../src/tape.ts";
import { Walk } from "../src/walk.ts";
import { longTape, serve, type Served } from "./served.ts";

const CHROMIUM = "/usr/bin/chromium";
const SHOTS = process.env["SHOTS"] ?? "web/build/shots";
const PARTS = JSON.parse(readFileSync("web/dist/parts.json", "utf8")) as Part[];
const AXE = readFileSync("web/node_modules/axe-core/axe.min.js", "utf8");
const WIDE = { width: 1400, height: 900 };
const PHONE = { width: 360, height: 740 };

let browser: Browser;
let served: Served;

/** A page in a browser that was never here, and what it said on the console. */
async function visit(options: BrowserContextOptions = {}, hash = "", prepare?: (context: BrowserContext) => Promise<unknown>) {
  const context = await browser.newContext({ viewport: WIDE, acceptDownloads: true, ...options });
  await prepare?.(context);
  context.setDefaultTimeout(15_000);
  const page = await context.newPage();
  const said: string[] = [];
  page.on("console", (message) => said.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => said.push(String(error)));
  await page.goto(served.url + hash);
  await page.waitForSelector("body[data-ready]");
  return { context, page, said };
}

const state = (page: Page, text: string) => page.waitForFunction((wanted) =>
  document.getElementById("state")?.textContent === wanted, text);
const prompt = (page: Page) => state(page, "at its prompt");
const paper = (page: Page) => page.evaluate(() =>
  [...document.querySelectorAll(".xterm-rows > div")].map((row) => row.textContent?.trimEnd()).join("\n"));
const onPaper = (page: Page, text: string) => page.waitForFunction((wanted) =>
  [...document.querySelectorAll(".xterm-rows > div")].map((row) => row.textContent?.trimEnd()).join("\n").includes(wanted), text);
const lines = (page: Page) => page.locator("#lines [role=option]").allTextContents();
const message = (page: Page) => page.locator("#message span").textContent();
const wholeTape = (page: Page) => page.waitForFunction(() =>
  /\d blocks · [\d.]+ mm$/.test(document.getElementById("sum")?.textContent ?? ""));

const active = (page: Page, block: number) => page.waitForFunction((wanted) =>
  document.querySelector("#list")?.getAttribute("aria-activedescendant") === `block-${wanted}`, block);

/** What a button of the menu Save gives. */
async function saved(page: Page, kind: string): Promise<string> {
  await page.locator("details.menu summary").first().click();
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(`[data-save="${kind}"]`)]);
  return readFileSync(await download.path(), "latin1");
}

async function open(page: Page, name: string, text: string): Promise<void> {
  await page.setInputFiles("#file", { name, mimeType: "application/octet-stream", buffer: Buffer.from(text, "latin1") });
}

/** Opens a part and runs it. */
async function runPart(page: Page, name: string): Promise<void> {
  await page.locator(`[data-part="${name}"]`).click();
  await page.waitForFunction(() => document.getElementById("sum")?.textContent === "" &&
    document.querySelectorAll("#lines [role=option]").length > 0);
  await prompt(page);
  await page.click("#run");
  await wholeTape(page);
}

/** Until what was done is drawn: the frame in which it is asked for, and the one behind it. */
const drawn = (page: Page) => page.evaluate(() =>
  new Promise((tell) => requestAnimationFrame(() => requestAnimationFrame(tell))));

async function shot(page: Page, name: string): Promise<void> {
  mkdirSync(SHOTS, { recursive: true });
  await page.waitForTimeout(150);
  await page.screenshot({ path: `${SHOTS}/${name}.png` });
}

describe("the page in chromium", { skip: existsSync(CHROMIUM) ? false : "chromium is not installed" }, () => {
  before(async () => {
    served = await serve();
    browser = await chromium.launch({
      executablePath: CHROMIUM,
      args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
        "--disable-component-update", "--disable-sync"],
    });
  });
  after(async () => {
    await browser?.close();
    await served?.stop();
  });

  test("first visit: small, quick, silent, under a policy without inline script", async (t) => {
    served.sent.clear();
    const { page, said, context } = await visit();
    const ready = Number(await page.getAttribute("body", "data-ready"));
    await prompt(page);
    assert.match(await paper(page), /SKG \d+\n>/);
    await page.evaluate(async () => void await navigator.serviceWorker.ready);
    const bytes = [...served.sent].filter(([name]) => !/^manual/.test(name)).reduce((sum, [, size]) => sum + size, 0);
    t.diagnostic(`ready after ${ready} ms, ${bytes} bytes gzipped`);
    assert.ok(bytes < 500_000);
    assert.ok(ready < 4000);
    const policy = await page.getAttribute("meta[http-equiv]", "content");
    assert.match(policy ?? "", /default-src 'none'/);
    assert.ok(!/script-src[^;]*(unsafe-inline|unsafe-eval(?<!wasm-unsafe-eval))/.test(policy ?? ""));
    // the policy is in force: a script that is put into the page does not run
    await page.evaluate(() => {
      const script = document.createElement("script");
      script.textContent = "window.intruder = true";
      document.body.append(script);
    });
    assert.equal(await page.evaluate(() => "intruder" in window), false);
    assert.deepEqual(said.filter((text) => !text.includes("Content Security Policy")), []);
    await shot(page, "first");
    await context.close();
  });

  test("every part's tape, byte for byte, and no message on the console", async () => {
    const { page, said, context } = await visit();
    assert.ok(PARTS.length > 50);
    for (const { name } of PARTS) {
      await runPart(page, name);
      assert.equal(await saved(page, "3b"), readFileSync(`examples/${name}.3b`, "latin1"), name);
    }
    assert.deepEqual(said, []);
    await context.close();
  });

  test("typing at the prompt, rubout, an error in words and in the program", async () => {
    const { page, said, context } = await visit();
    await prompt(page);
    await page.click("#terminal");
    await page.keyboard.type("PRINT 2*3,SQR 16\r");
    await onPaper(page, "\n6 4\n");
    await page.keyboard.type("PRINT 7");
    await page.keyboard.press("Backspace");
    await page.keyboard.type("8\r");
    await onPaper(page, "\n8\n");
    await page.keyboard.type("10 FROM O\r20 CUT X,(5,5):1\r30 END\rRUN\r");
    await onPaper(page, "ERR 06 LINE 20");
    assert.match(await message(page) ?? "", /ERR 06 in line 20: geometry/);
    assert.equal(await page.locator("#lines .wrong").textContent(), "20 CUT X,(5,5):1");
    // pasted, at the machine's pace
    await page.evaluate(() => {
      const data = new DataTransfer();
      data.setData("text/plain", "NEW\n10 I=1\n20 PRINT I\n30 I=I+1\n40 IF I<4 GOTO 20\nRUN\n");
      document.querySelector(".xterm-helper-textarea")?.dispatchEvent(
        new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }));
    });
    await onPaper(page, "\n1\n2\n3\n");
    assert.deepEqual(said, []);
    await context.close();
  });

  test("a program without end: the page is not held up, and ctrl-C ends it", async (t) => {
    const { page, context } = await visit();
    await prompt(page);
    await page.click("#terminal");
    await page.keyboard.type("10 PRINT 1\r20 GOTO 10\rRUN\r");
    await state(page, "running");
    const longest = await page.evaluate(() => new Promise<number>((tell) => {
      let most = 0;
      let last = performance.now();
      const end = last + 2000;
      const frame = (now: number): void => {
        most = Math.max(most, now - last);
        last = now;
        if (now < end) requestAnimationFrame(frame);
        else tell(most);
      };
      requestAnimationFrame(frame);
    }));
    t.diagnostic(`longest time between two frames while it prints without end: ${longest.toFixed(0)} ms`);
    assert.ok(longest < 1000);
    assert.equal(await page.textContent("#run"), "Stop (ctrl-C)");
    await page.click("#run");
    await onPaper(page, "ERR 10");
    await prompt(page);
    await context.close();
  });

  test("the drawing is the simulator's path, and nothing else", async () => {
    const { page, context } = await visit();
    for (const name of ["wrench", "fit-ellipse", "gosub-holes"]) {
      await runPart(page, name);
      await drawn(page);
      const { layout } = layOut(readTape(readFileSync(`examples/${name}.3b`, "latin1")).items);
      const walk = new Walk(new WebAssembly.Module(readFileSync("web/dist/walk.wasm")));
      walk.begin(layout.blocks);
      assert.ok(walk.measure(1e9));
      const path: number[][] = [];
      for (let step = 0; step < walk.steps; step += walk.steps / 4000) {
        const position = walk.locate(step);
        if (position && layout.blocks[position.at]?.role === "cut") path.push([...position.place]);
      }
      const { hits, strays } = await page.evaluate((path) => {
        const canvas = document.getElementById("base") as HTMLCanvasElement;
        const [scale = 1, , , pixels = 1] = (canvas.dataset["window"] ?? "").split(" ").map(Number);
        const { width, height } = canvas;
        const { data } = (canvas.getContext("2d") as CanvasRenderingContext2D).getImageData(0, 0, width, height);
        const isWire = (at: number): boolean => {
          const [r = 0, g = 0, b = 0, a = 0] = data.subarray(4 * at, 4 * at + 4);
          return a > 60 && b > r + 60 && b > g + 20;
        };
        // the drawing stands where the program has it, the tape alone begins at (0, 0): laid on each other by their middles
        const wire: number[] = [];
        for (let at = 0; at < width * height; at++) if (isWire(at)) wire.push(at);
        const px = path.map(([u = 0, v = 0]) => [u * scale * pixels, -v * scale * pixels] as const);
        const least = (values: number[]): number => values.reduce((a, b) => Math.min(a, b), Infinity);
        const most = (values: number[]): number => values.reduce((a, b) => Math.max(a, b), -Infinity);
        const middle = (values: number[]): number => (least(values) + most(values)) / 2;
        const offX = middle(wire.map((at) => at % width)) - middle(px.map(([u]) => u));
        const offY = middle(wire.map((at) => Math.floor(at / width))) - middle(px.map(([, v]) => v));
        const near = new Uint8Array(width * height);
        let hits = 0;
        for (const [u, v] of px) {
          const [cx, cy] = [Math.round(u + offX), Math.round(v + offY)];
          let hit = false;
          for (let j = -10; j <= 10; j++) {
            for (let i = -10; i <= 10; i++) {
              const at = (cy + j) * width + cx + i;
              near[at] = 1;
              if (Math.abs(i) <= 1 && Math.abs(j) <= 1) hit ||= isWire(at);
            }
          }
          if (hit) hits++;
        }
        return { hits, strays: wire.filter((at) => !near[at]).length };
      }, path);
      assert.ok(path.length > 1000);
      assert.equal(hits, path.length, name);
      assert.equal(strays, 0, name);
    }
    await context.close();
  });

  test("a block, its line and its place on the drawing belong together", async () => {
    const { page, context } = await visit();
    await runPart(page, "wrench");
    await page.locator("#lines [role=option]", { hasText: /^180 / }).hover();
    await page.waitForFunction(() => document.querySelectorAll("#list [aria-selected=true]").length > 5);
    const rows = await page.locator("#list [aria-selected=true] .line").allTextContents();
    assert.ok(rows.every((text) => text === "line 180"));
    await page.focus("#list");
    await page.keyboard.press("Home");
    for (let down = 0; down < 3; down++) await page.keyboard.press("ArrowDown");
    await active(page, 4);
    assert.equal(await page.locator("#lines [aria-selected=true]").textContent(), "50 CUT X:8.5#I*60");
    // by the pointer, on the drawing: the middle of the hexagon's lower edge is block 2 or 8
    await page.focus("#over");
    await page.keyboard.press("n");
    await active(page, 5);
    const at = await page.evaluate(() => {
      const canvas = document.getElementById("base") as HTMLCanvasElement;
      const [scale = 1, x = 0, y = 0] = (canvas.dataset["window"] ?? "").split(" ").map(Number);
      const box = canvas.getBoundingClientRect();
      return [box.left + x, box.top + y - 8400 * scale];
    });
    await page.mouse.move(at[0] as number, at[1] as number);
    await active(page, 5);
    await shot(page, "linked");
    await context.close();
  });

  test("zoom and pan by wheel, mouse and keys", async () => {
    const { page, context } = await visit();
    const height = () => page.evaluate(() => document.getElementById("base")?.clientHeight);
    const empty = await height();
    await runPart(page, "die");
    await page.waitForFunction(() => /closing error|closes/.test(document.getElementById("closing")?.textContent ?? ""));
    // What is said of a tape has its room from the start: the drawing does not move under the pointer.
    assert.equal(await height(), empty);
    const view = async () => (await page.getAttribute("#base", "data-window") ?? "").split(" ").map(Number);
    const first = await view();
    await page.hover("#over", { position: { x: 200, y: 150 } });
    await page.mouse.wheel(0, -400);
    await page.waitForFunction((before) => document.getElementById("base")?.dataset["window"] !== before, first.join(" "));
    const second = await view();
    assert.ok((second[0] as number) > (first[0] as number) * 1.5);
    await page.mouse.down();
    await page.mouse.move(700, 400, { steps: 4 });
    await page.mouse.up();
    await drawn(page);
    const third = await view();
    assert.equal(third[0], second[0]);
    assert.notEqual(third[1], second[1]);
    await page.focus("#over");
    await page.keyboard.press("-");
    await page.keyboard.press("ArrowLeft");
    await drawn(page);
    const fourth = await view();
    assert.ok((fourth[0] as number) < (third[0] as number));
    await page.keyboard.press("0");
    await drawn(page);
    assert.deepEqual(await view(), first);
    await context.close();
  });

  test("the controller's walk: play, pause, scrub; the tape runs past", async () => {
    const { page, context } = await visit();
    await runPart(page, "wrench");
    await page.waitForFunction(() => /closing error|closes/.test(document.getElementById("closing")?.textContent ?? ""));
    await page.selectOption("#pace", "2000");
    await page.click("#play");
    await page.waitForFunction(() => /^block ([2-9]|\d\d) of 29/.test(document.getElementById("walked")?.textContent ?? ""));
    await page.click("#play");
    const text = await page.textContent("#walked");
    await page.waitForTimeout(200);
    assert.equal(await page.textContent("#walked"), text, "it stands still");
    assert.match(text ?? "", /x -?[\d.]+ y -?[\d.]+ mm · off the contour [\d.]+ µm/);
    await page.locator("#lines [role=option]", { hasText: /^180 / }).hover();
    await shot(page, "page"); // (docs/pictures/page.png)
    await page.focus("#scrub");
    await page.keyboard.press("End");
    assert.match(await page.textContent("#walked") ?? "", /^block 29 of 29 · x 45\.\d+ y -(19\.99|20\.00)/);
    const holes = await page.evaluate(() => {
      const canvas = document.getElementById("punched") as HTMLCanvasElement;
      const { data } = (canvas.getContext("2d") as CanvasRenderingContext2D).getImageData(0, 0, canvas.width, canvas.height);
      return new Set(new Uint32Array(data.buffer)).size;
    });
    assert.ok(holes > 3);
    await shot(page, "walk");
    await context.close();
  });

  test("reload: program, variables, paper and settings are there again; a tape too when it was exported", async () => {
    const { page, context, said } = await visit();
    await prompt(page);
    await page.click("#terminal");
    await page.keyboard.type("10 REM KEPT\rI=42\r");
    await page.waitForFunction(() => document.querySelectorAll("#lines [role=option]").length === 1);
    await prompt(page);
    await page.locator("details.menu summary").nth(2).click();
    await page.selectOption("#theme", "dark");
    await page.fill("#wire", "0.25");
    await page.keyboard.press("Tab");
    await page.waitForTimeout(500); // (Storing is not seen from outside.)
    await page.reload();
    await page.waitForSelector("body[data-ready]");
    await onPaper(page, "10 REM KEPT");
    await page.waitForFunction(() => document.querySelector("#lines")?.textContent === "10 REM KEPT");
    await prompt(page);
    await page.click("#terminal");
    await page.keyboard.type("PRINT I\r");
    await onPaper(page, "\n42\n");
    assert.equal(await page.getAttribute("html", "data-theme"), "dark");
    assert.equal(await page.inputValue("#wire"), "0.25");
    await runPart(page, "punch");
    const file = await saved(page, "json");
    assert.deepEqual(said, []);
    await context.close();
    const other = await visit();
    await open(other.page, "all.json", file);
    await wholeTape(other.page);
    assert.equal(await saved(other.page, "3b"), readFileSync("examples/punch.3b", "latin1"));
    await other.page.waitForFunction(() => document.querySelectorAll("#lines [role=option]").length > 3);
    assert.equal(await other.page.getAttribute("html", "data-theme"), "dark");
    await other.context.close();
  });

  test("reload while a program runs, or asks, that was pasted with its RUN: it is there again", async () => {
    const { page, context, said } = await visit();
    for (const program of ["10 I=0\n20 I=I+1\n30 GOTO 20\n", "10 INPUT D\n20 PRINT D\n30 END\n"]) {
      await prompt(page);
      await page.click("#terminal");
      await page.evaluate((text) => {
        const data = new DataTransfer();
        data.setData("text/plain", text);
        document.querySelector(".xterm-helper-textarea")?.dispatchEvent(
          new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }));
      }, `NEW\n${program}RUN\n`);
      const there = () => page.waitForFunction((wanted) =>
        [...document.querySelectorAll("#lines [role=option]")].map((line) => `${line.textContent}\n`).join("") === wanted, program);
      await there();
      await page.waitForFunction(() => document.getElementById("state")?.textContent !== "at its prompt");
      await page.reload();
      await page.waitForSelector("body[data-ready]");
      await there();
    }
    assert.deepEqual(said, []);
    await context.close();
  });

  test("links: one made here, one cut short, a part's; what was there can be put back; the form for other pages", async () => {
    const { page, context } = await visit({ permissions: ["clipboard-read", "clipboard-write"] });
    await runPart(page, "ratchet");
    const program = await lines(page);
    await page.locator("details.menu summary").nth(1).click();
    await page.click("#copy-link");
    const copied = async (start: string): Promise<string> => {
      await page.waitForFunction(async (wanted) => (await navigator.clipboard.readText()).startsWith(wanted), start);
      return page.evaluate(() => navigator.clipboard.readText());
    };
    const link = await copied("http");
    await page.locator("details.menu summary").nth(1).click();
    await page.click("#copy-embed");
    assert.match(await copied("<iframe"), /^<iframe src="http.*&run&embed" title="SKG"/);
    await context.close();

    const hash = link.slice(link.indexOf("#"));
    const other = await visit({}, hash);
    await wholeTape(other.page);
    assert.deepEqual(await lines(other.page), program);
    assert.equal(await saved(other.page, "3b"), readFileSync("examples/ratchet.3b", "latin1"));
    await prompt(other.page);
    await other.page.click("#terminal");
    await other.page.keyboard.type("5 REM MINE\r");
    await other.page.waitForFunction(() => document.querySelector("#lines [role=option]")?.textContent === "5 REM MINE");
    await other.page.evaluate(() => { location.hash = "#part=scale&run"; });
    await wholeTape(other.page);
    await other.page.click("#undo");
    await other.page.waitForFunction(() => document.querySelector("#lines [role=option]")?.textContent === "5 REM MINE");
    await other.page.evaluate((cut) => { location.hash = cut; }, hash.slice(0, 80));
    await other.page.waitForFunction(() => /link is not whole/.test(document.querySelector("#message span")?.textContent ?? ""));
    await other.page.evaluate(() => { location.hash = "#part=nothing"; });
    await other.page.waitForFunction(() => /no part nothing/.test(document.querySelector("#message span")?.textContent ?? ""));
    await other.context.close();

    const small = await visit({ viewport: { width: 800, height: 500 } }, `${hash}&embed`);
    await small.page.waitForFunction(() => /\d blocks/.test(document.getElementById("sum")?.textContent ?? ""));
    assert.equal(await small.page.isVisible("#parts"), false);
    assert.equal(await small.page.isVisible("#full"), true);
    assert.equal(await small.page.evaluate(() => localStorage.length), 0, "the visitor's own machine is left alone");
    assert.equal(await small.page.isVisible("#message"), false, "there is nothing to complain of");
    await shot(small.page, "embed");
    await small.context.close();
  });

  test("every example of the manual can be tried", async () => {
    const { page, context, said } = await visit();
    await page.goto(`${served.url}manual.html`);
    const links = await page.locator(".try a").evaluateAll((all) => all.map((link) => link.getAttribute("href") ?? ""));
    const programs = [...readFileSync("docs/manual.md", "utf8").matchAll(/^```skg.*\n([^]*?)^```$/gm)];
    assert.equal(links.length, programs.length);
    await page.locator(".try a").first().click();
    await page.waitForSelector("body[data-ready]");
    await wholeTape(page);
    const tape = /^```tape\n([^]*?)^```$/m.exec(readFileSync("docs/manual.md", "utf8"))?.[1];
    assert.equal((await saved(page, "3b")).replaceAll("\r", ""), tape);
    assert.deepEqual(said, []);
    await context.close();
  });

  test("files: a program, a tape in a foreign form, ISO, SVG and DXF out", async () => {
    const { page, context } = await visit();
    await open(page, "mine.skg", readFileSync("examples/wrench.skg", "latin1"));
    await page.waitForFunction(() => document.querySelectorAll("#lines [role=option]").length === 21);
    await open(page, "foreign.3b", readFileSync("examples/wrench.3b", "latin1").replaceAll("\r\n", "").replaceAll("B", " B "));
    await wholeTape(page);
    assert.match(await message(page) ?? "", /^foreign\.3b: 29 blocks, written in another form/);
    assert.equal(await saved(page, "3b"), readFileSync("examples/wrench.3b", "latin1"));
    assert.match(await saved(page, "iso"), /^N1G17G21G90G94\r\nN2G0X-?[\d.]+Y-?[\d.]+\r\nN3G1X[^\r]*F100\r\n/);
    assert.match(await saved(page, "svg"), /<path id="wire"/);
    assert.match(await saved(page, "dxf"), /ARC/);
    assert.match(await saved(page, "skg"), /^10 REM A wrench/);
    await context.close();
  });

  test("bad input: one sentence each, and the rest works", async () => {
    const { page, context, said } = await visit();
    await prompt(page);
    for (const [name, text, sentence] of [
      ["a.3b", "B1B2B2GYL1\nB1B2X", /a\.3b is no tape: block 2, line 2, column 1/],
      ["a.3b", "", /a\.3b is empty/], ["a.png", "\x89PNG", /is no program, no tape/], ["a.skg", "10 REM \xe9", /byte 8/],
      ["a.dxf", "0\nSECTION\n", /skg from-dxf/], ["a.xy", "(+)D(0,0)=>D0;", /skg xy/], ["a.json", "{\"format\":", /not whole/],
      ["big.3b", "B1B2B2GYL1\n".repeat(1_600_000), /too large: at most 16384 KB/],
    ] as const) {
      await open(page, name, text);
      await page.waitForFunction((source) => new RegExp(source).test(document.querySelector("#message span")?.textContent ?? ""),
        sentence.source);
    }
    // a program that the machine refuses: its own words, and the page's
    await open(page, "wrong.skg", "10 CUT X\n20 NONSENSE\n30 END\n");
    await onPaper(page, "ERR 01");
    assert.match(await message(page) ?? "", /ERR 01: not understood/);
    await runPart(page, "die");
    assert.deepEqual(said, []);
    await context.close();
  });

  test("a browser that keeps nothing, and one without the machine", async () => {
    const refusing = await visit({}, "", (context) => context.addInitScript(() => {
      Storage.prototype.setItem = () => { throw new DOMException("full", "QuotaExceededError"); };
    }));
    await refusing.page.waitForFunction(() => /refuses to keep/.test(document.querySelector("#message span")?.textContent ?? ""));
    await runPart(refusing.page, "die");
    assert.deepEqual(refusing.said, []);
    await refusing.context.close();

    const dead = await visit({ serviceWorkers: "block" }, "", (context) =>
      context.route("**/board.wasm", (route) => route.fulfill({ body: "no" })));
    await dead.page.waitForFunction(() => /machine cannot run here/.test(document.querySelector("#message span")?.textContent ?? ""));
    await open(dead.page, "a.3b", readFileSync("examples/die.3b", "latin1"));
    await wholeTape(dead.page);
    await dead.page.click("#play");
    await dead.page.waitForFunction(() => /^block/.test(document.getElementById("walked")?.textContent ?? ""));
    await dead.context.close();
  });

  test("offline, after the first visit", async () => {
    const { page, context } = await visit();
    await page.evaluate(async () => void await navigator.serviceWorker.ready);
    await page.waitForFunction(async () => (await caches.keys()).length > 0 && navigator.serviceWorker.controller !== null);
    const port = Number(new URL(served.url).port);
    await served.stop();
    try {
      await page.reload();
      await page.waitForSelector("body[data-ready]");
      await runPart(page, "recut");
      assert.equal(await saved(page, "3b"), readFileSync("examples/recut.3b", "latin1"));
      await page.goto(`${served.url}manual.html`);
      assert.match(await page.textContent("h1") ?? "", /SKG language/);
    } finally {
      served = await serve(port);
    }
    await context.close();
  });

  test("by the keyboard alone", async () => {
    const { page, context } = await visit();
    await prompt(page);
    await page.keyboard.press("Tab");
    await page.keyboard.press("Enter");
    await page.keyboard.type("PRINT 1+1\r");
    await onPaper(page, "\n2\n");
    // on through the whole page: everything that can be pressed has its turn, and nothing holds the focus
    const seen = new Set<string>();
    for (let tabs = 0; tabs < 140; tabs++) {
      await page.keyboard.press("Tab");
      seen.add(await page.evaluate(() => {
        const at = document.activeElement as HTMLElement;
        return at.id || at.dataset["part"] || at.dataset["key"] || at.className || at.tagName;
      }));
    }
    for (const wanted of ["run", "open", "wrench", "over", "fit", "list", "reset", "edit", "manual", "xterm-helper-textarea"]) {
      assert.ok(seen.has(wanted), `${wanted} of ${[...seen].join(" ")}`);
    }
    await page.focus("[data-part=die]");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => document.querySelectorAll("#lines [role=option]").length > 3);
    await prompt(page);
    await page.focus("#run");
    await page.keyboard.press("Space");
    await wholeTape(page);
    await page.focus("#edit");
    await page.keyboard.press("Enter");
    await page.keyboard.press("Control+A");
    await page.keyboard.type("10 REM TYPED");
    await page.focus("#load");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => document.querySelector("#lines")?.textContent === "10 REM TYPED");
    await context.close();
  });

  test("names, roles and contrast, in both languages, light and dark", async () => {
    for (const locale of ["en-US", "zh-CN"]) {
      for (const colorScheme of ["light", "dark"] as const) {
        const { page, context } = await visit({ locale, colorScheme });
        await page.waitForFunction(() => document.querySelectorAll("[data-part]").length > 50);
        assert.equal(await page.getAttribute("html", "lang"), locale === "zh-CN" ? "zh-CN" : "en");
        await page.locator("[data-part=wrench]").click();
        await page.waitForFunction(() => document.querySelectorAll("#lines [role=option]").length === 21);
        await page.click("#run");
        await page.waitForFunction(() => /^29 /.test(document.getElementById("sum")?.textContent ?? ""));
        await page.locator("#lines [role=option]").nth(17).hover();
        await page.locator("details.menu summary").nth(2).click();
        await page.evaluate(AXE);
        const found = await page.evaluate(async () => {
          const { violations } = await (window as unknown as { axe: { run(options: object): Promise<{
            violations: { id: string; nodes: { html: string; failureSummary: string }[] }[] }> } }).axe.run(
            { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "best-practice"] });
          return violations.map(({ id, nodes }) => `${id}: ${nodes[0]?.html} ${nodes[0]?.failureSummary}`);
        });
        assert.deepEqual(found, [], `${locale} ${colorScheme}`);
        await shot(page, `${locale}-${colorScheme}`);
        await context.close();
      }
    }
  });

  test("on a phone of 360 pixels", async () => {
    const { page, context, said } = await visit({ viewport: PHONE, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
    const fits = () => page.evaluate(() => document.documentElement.scrollWidth <= innerWidth);
    assert.ok(await fits());
    await page.tap("#views [data-view=parts]");
    await page.tap("[data-part=wrench]");
    await page.waitForFunction(() => document.querySelectorAll("#lines [role=option]").length === 21);
    await prompt(page);
    await page.tap("#run");
    await wholeTape(page);
    for (const view of ["parts", "program", "teletype", "drawing", "blocks"]) {
      await page.tap(`#views [data-view=${view}]`);
      const box = await page.locator(`#${view}`).boundingBox();
      assert.ok(box && box.height > 450 && box.width > 340, `${view} has the screen: ${JSON.stringify(box)}`);
      assert.ok(await fits(), view);
      await shot(page, `phone-${view}`);
    }
    await page.tap("#views [data-view=teletype]");
    await page.tap("#terminal");
    await page.keyboard.type("PRINT 5");
    await page.tap("[data-key='127']");
    await page.keyboard.type("6");
    await page.tap("[data-key='13']");
    await onPaper(page, "\n6");
    // two fingers zoom
    await page.tap("#views [data-view=drawing]");
    const before = await page.getAttribute("#base", "data-window");
    await page.evaluate(() => {
      const canvas = document.getElementById("over") as HTMLElement;
      canvas.setPointerCapture = () => undefined;
      const send = (kind: string, pointerId: number, clientX: number, clientY: number): boolean => canvas.dispatchEvent(
        new PointerEvent(kind, { pointerId, clientX, clientY, pointerType: "touch", bubbles: true }));
      send("pointerdown", 1, 150, 300);
      send("pointerdown", 2, 200, 300);
      for (let step = 1; step < 8; step++) send("pointermove", 2, 200 + 15 * step, 300);
      send("pointerup", 1, 150, 300);
      send("pointerup", 2, 305, 300);
    });
    await drawn(page);
    const [was, is] = [before, await page.getAttribute("#base", "data-window")].map((text) => Number(text?.split(" ")[0]));
    assert.ok((is as number) > 2 * (was as number));
    assert.deepEqual(said, []);
    await context.close();
  });

  test("speed: 2 MHz and 110 baud take their time", async (t) => {
    const { page, context } = await visit();
    await prompt(page);
    await page.locator("details.menu summary").nth(2).click();
    await page.selectOption("#speed", "real");
    await page.keyboard.press("Escape");
    await page.click("#terminal");
    const began = Date.now();
    await page.keyboard.type("PRINT 1/3\r");
    await onPaper(page, "0.33333333\n");
    const took = Date.now() - began;
    t.diagnostic(`PRINT 1/3 with echo and answer at 110 baud: ${took} ms`);
    assert.ok(took > 1500 && took < 8000);
    await context.close();
  });

  test("budgets: a block drawn, 20,000 blocks panned", async (t) => {
    const { page, context } = await visit();
    await runPart(page, "wrench");
    const block = Number(await page.getAttribute("#base", "data-took"));
    await open(page, "many.3b", longTape());
    await page.waitForFunction(() => /^20000 blocks/.test(document.getElementById("sum")?.textContent ?? ""));
    await page.focus("#over");
    const rate = await page.evaluate(() => new Promise<{ frame: number; draw: number }>((tell) => {
      const canvas = document.getElementById("over") as HTMLElement;
      const base = document.getElementById("base") as HTMLElement;
      const began = performance.now();
      let frames = 0;
      let draw = 0;
      const frame = (): void => {
        draw += Number(base.dataset["took"]);
        if (frames++ === 60) {
          tell({ frame: (performance.now() - began) / 60, draw: draw / 60 });
          return;
        }
        canvas.dispatchEvent(new KeyboardEvent("keydown", { key: frames % 2 ? "ArrowLeft" : "ArrowRight" }));
        requestAnimationFrame(frame);
      };
      requestAnimationFrame(frame);
    }));
    t.diagnostic(`a block: ${block.toFixed(1)} ms; 20,000 blocks: ${rate.draw.toFixed(1)} ms to draw, ${rate.frame.toFixed(1)} ms a frame`);
    // (Many times what an idle machine takes: a growth that is quadratic is seen, a busy machine is not.)
    assert.ok(block < 250);
    assert.ok(rate.frame < 250);
    await shot(page, "many");
    await context.close();
  });
});
