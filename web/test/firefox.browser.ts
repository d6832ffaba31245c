/** The page in Debian's firefox-esr, over WebDriver BiDi: what the chromium tests look at closely works here too. */
import assert from "node:assert/strict";
import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import puppeteer, { type Browser, type Page } from "puppeteer-core";
import { longTape, PATIENCE, type Served, serve, WHOLE } from "./served.ts";

const FIREFOX = "/usr/bin/firefox-esr";
const SHOTS = process.env["SHOTS"] ?? "web/build/shots";

let browser: Browser;
let served: Served;
const said: string[] = [];

const paper = (page: Page): Promise<string> =>
  page.evaluate(() => [...document.querySelectorAll(".xterm-rows > div")].map((row) => row.textContent?.trimEnd()).join("\n"));

async function until(page: Page, what: string, look: () => Promise<boolean>): Promise<void> {
  for (const end = Date.now() + PATIENCE; Date.now() < end; await new Promise((resume) => setTimeout(resume, 50))) {
    if (await look()) return;
  }
  throw new Error(`${what}: ${await paper(page)}`);
}

const onPaper = (page: Page, text: string) => until(page, text, async () => (await paper(page)).includes(text));
const sum = (page: Page) => page.$eval("#sum", (element) => element.textContent ?? "");

/** Until what was done is drawn: the frame in which it is asked for, and the one behind it. */
const drawn = (page: Page) =>
  page.evaluate(() => new Promise((tell) => requestAnimationFrame(() => requestAnimationFrame(tell))));

async function visit(hash = ""): Promise<Page> {
  const page = await browser.newPage();
  page.setDefaultTimeout(PATIENCE);
  page.on("console", (message) => said.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => said.push(String(error)));
  await page.setViewport({ width: 1400, height: 900 });
  await page.goto(served.url + hash);
  await page.waitForSelector("body[data-ready]");
  return page;
}

describe("the page in firefox", { skip: existsSync(FIREFOX) ? false : "firefox-esr is not installed", timeout: WHOLE }, () => {
  before(async () => {
    served = await serve();
    browser = await puppeteer.launch({
      browser: "firefox",
      executablePath: FIREFOX,
      headless: true,
      args: ["--no-sandbox"],
      timeout: PATIENCE,
      protocolTimeout: PATIENCE,
    });
  });
  after(async () => {
    await browser?.close();
    await served?.stop();
  });

  test("typing, tapes, drawing, reload, link", async (t) => {
    const page = await visit();
    t.diagnostic(`ready after ${await page.$eval("body", (body) => body.dataset["ready"])} ms`);
    await onPaper(page, "\n>");
    await page.click("#terminal");
    await page.keyboard.type("PRINT 2*3\r");
    await onPaper(page, "\n6\n");
    for (const name of ["wrench", "fit-tol-cam", "gosub-holes", "xy-gear"]) {
      const wanted = readFileSync(`examples/${name}.3b`, "latin1");
      const blocks = wanted.split("\r\n").filter((line) => line.startsWith("B"));
      await page.click(`[data-part="${name}"]`);
      await until(page, name, async () => (await page.$eval("#state", (element) => element.textContent)) === "at its prompt");
      await until(page, name, async () => new RegExp(`^${blocks.length} blocks · [\\d.]+ mm$`).test(await sum(page)));
      // block by block down the list: that is the tape
      await page.focus("#list");
      await page.keyboard.press("Home");
      await drawn(page);
      const found: string[] = [];
      for (let at = 0; at < Math.min(blocks.length, 40); at++) {
        await page.waitForFunction(
          (id) =>
            document.getElementById(id)?.ariaSelected === "true" ||
            document.getElementById(id)?.getAttribute("aria-selected") === "true",
          {},
          `block-${at + 1}`,
        );
        found.push(await page.$eval(`#block-${at + 1} .text`, (element) => element.textContent ?? ""));
        await page.keyboard.press("ArrowDown");
      }
      assert.deepEqual(found, blocks.slice(0, 40), name);
    }
    await drawn(page);
    const colours = await page.$eval("#base", (element) => {
      const canvas = element as HTMLCanvasElement;
      const { data } = (canvas.getContext("2d") as CanvasRenderingContext2D).getImageData(0, 0, canvas.width, canvas.height);
      return new Set(new Uint32Array(data.buffer)).size;
    });
    assert.ok(colours > 10, "something is drawn");
    mkdirSync(SHOTS, { recursive: true });
    await page.screenshot({ path: `${SHOTS}/firefox.png` });
    await page.reload();
    await page.waitForSelector("body[data-ready]");
    await until(page, "program kept", async () => (await page.$$("#lines .cm-line")).length > 10);
    await page.close();
    const other = await visit("#part=scale&run");
    await until(other, "link", async () => /^\d+ blocks/.test(await sum(other)));
    assert.deepEqual(said, []);
    await other.close();
  });

  test("20,000 blocks panned", async (t) => {
    const page = await visit();
    const rate = await page.evaluate(async (tape) => {
      const data = new DataTransfer();
      data.items.add(new File([tape], "many.3b"));
      dispatchEvent(new DragEvent("drop", { dataTransfer: data, cancelable: true }));
      while (!/^20000/.test(document.getElementById("sum")?.textContent ?? "")) await new Promise((next) => setTimeout(next, 20));
      const canvas = document.getElementById("over") as HTMLElement;
      await new Promise((next) => requestAnimationFrame(next));
      let draws = 0;
      new MutationObserver((found) => (draws += found.length)).observe(document.getElementById("base") as HTMLElement, {
        attributeFilter: ["data-took"],
      });
      const began = performance.now();
      for (let frames = 0; frames < 60; frames++) {
        canvas.dispatchEvent(new KeyboardEvent("keydown", { key: frames % 2 ? "ArrowLeft" : "ArrowRight" }));
        await new Promise((next) => requestAnimationFrame(next));
      }
      return { frame: (performance.now() - began) / 60, draws };
    }, longTape());
    t.diagnostic(`20,000 blocks: ${rate.frame.toFixed(1)} ms a frame`);
    // (one more is that of the tape, which came late)
    assert.ok(rate.draws === 60 || rate.draws === 61, `${rate.draws} draws`);
    await page.close();
  });

  test("a first visit is cut; a typo marks its line, and the machine keeps its program; one's own programs are kept", async () => {
    const page = await visit("#part=wrench&run");
    await until(page, "cut", async () => /^29 blocks · [\d.]+ mm$/.test(await sum(page)));
    await page.click("#lines .cm-line:nth-child(3)");
    await page.keyboard.press("Home");
    await page.keyboard.down("Shift");
    await page.keyboard.press("End");
    await page.keyboard.up("Shift");
    await page.keyboard.type("30 FRAM O");
    const text = (selector: string) => page.$eval(selector, (element) => element.textContent ?? "").catch(() => "");
    await until(page, "marked", async () => /ERR 01/.test(await text("#lines .fault")));
    await page.keyboard.down("Control");
    await page.keyboard.press("Enter");
    await page.keyboard.up("Control");
    await until(page, "said", async () => /machine keeps its program/.test(await text("#message span")));
    await page.reload();
    await page.waitForSelector("body[data-ready]");
    await until(page, "text kept", async () => (await text("#lines .cm-line:nth-child(3)")) === "30 FRAM O");
    await page.click('[data-part="die"]');
    await until(page, "in the list", async () => /A wrench/.test(await text(".work b")));
    await page.close();
  });

  test("a step of the lessons, the plate under the wire, what this is", async () => {
    const page = await visit("#lesson=2");
    const text = (selector: string) => page.$eval(selector, (element) => element.textContent ?? "").catch(() => "");
    await until(page, "the step", async () => (await text("#lesson-title")) === "2/10 A line");
    await until(page, "cut", async () => /^7 blocks/.test(await sum(page)));
    await until(page, "at its prompt", async () => (await text("#state")) === "at its prompt");
    await page.click("#lines .cm-line:nth-child(2)");
    await page.keyboard.press("Home");
    await page.keyboard.down("Shift");
    await page.keyboard.press("End");
    await page.keyboard.up("Shift");
    await page.keyboard.type("20 CUT X,Y:50,-X:30,-Y");
    await page.click("#run");
    await until(page, "right", async () => /^Right/.test(await text("#lesson-check")));
    await page.$eval("#scrub", (element) => {
      const scrub = element as HTMLInputElement;
      scrub.value = scrub.max;
      scrub.dispatchEvent(new Event("input"));
    });
    await drawn(page);
    const covered = await page.$eval("#over", (element) => {
      const canvas = element as HTMLCanvasElement;
      const { data } = (canvas.getContext("2d") as CanvasRenderingContext2D).getImageData(0, 0, canvas.width, canvas.height);
      return data.filter((value, at) => at % 4 === 3 && value === 255).length / (data.length / 4);
    });
    assert.ok(covered > 0.3, `${covered} of the drawing is plate`);
    await page.click("#about");
    await until(page, "what this is", async () =>
      page.$eval("#manual-frame", (frame) =>
        /孙宝成/.test((frame as HTMLIFrameElement).contentDocument?.body?.textContent ?? ""),
      ),
    );
    await page.close();
  });

  test("one file, from a double click", async () => {
    const page = await browser.newPage();
    await page.setViewport({ width: 1400, height: 900 });
    await page.goto(`file://${process.cwd()}/web/dist/skg.html`);
    await page.waitForSelector("body[data-ready]");
    await page.click('[data-part="die"]');
    await until(page, "cut", async () => /^\d+ blocks · [\d.]+ mm$/.test(await sum(page)));
    await page.click("#machine");
    await until(page, "the machine's inside", async () => (await page.$$("#inside .code li")).length > 10);
    await page.click('[data-move="hold"]');
    await until(page, "held", async () =>
      /^held/.test(await page.$eval("#inside .place", ({ textContent }) => textContent ?? "")),
    );
    await page.close();
  });
});
