/** What this is, cards for links, the form for an article, in Debian's chromium. */
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { pack } from "../src/link.ts";
import {
  AXE,
  begin,
  CHROMIUM,
  drawn,
  end,
  hasLines,
  longestTask,
  message,
  open,
  paste,
  prompt,
  runPart,
  says,
  served,
  shot,
  visit,
  wholeTape,
} from "./chromium.ts";
import { serve, WHOLE } from "./served.ts";

interface Axe {
  run(options: object): Promise<{ violations: { id: string; nodes: { html: string; failureSummary: string }[] }[] }>;
}

describe("the story", { skip: existsSync(CHROMIUM) ? false : "chromium is not installed", timeout: WHOLE }, () => {
  before(begin);
  after(end);

  test("what this is: a click away, on one screen, in both languages; a page of the book runs beside it", async () => {
    for (const [locale, file, heading, run] of [
      ["en-US", "about.html", "What is this?", "Run this page"],
      ["zh-CN", "about.zh.html", "这是什么？", "运行这一页"],
    ] as const) {
      for (const colorScheme of ["light", "dark"] as const) {
        const { page, context, said } = await visit({ locale, colorScheme, bypassCSP: true });
        await firstTape(page);
        await page.click("#about");
        const about = page.frameLocator("#manual-frame");
        await about.locator("h1", { hasText: heading }).waitFor();
        assert.equal(await page.getAttribute("#manual-alone", "href"), file);
        await about.locator("a", { hasText: run }).click();
        await says(page, "#lines .cm-line:nth-child(1)", /SKG book 7/);
        await page.waitForFunction(() => /^11 /.test(document.getElementById("sum")?.textContent ?? ""));
        assert.ok(await page.isVisible("#manual-frame"));
        await shot(page, `about-${locale}-${colorScheme}`);
        // alone: all of it on a screen
        await page.setViewportSize({ width: 1440, height: 900 });
        await page.goto(served.url + file);
        const text = (await page.textContent("main")) ?? "";
        for (const fact of ["孙宝成", "1976", "1983", "6,300", "8080", "8,192"]) assert.ok(text.includes(fact), fact);
        assert.ok(await page.evaluate(() => document.documentElement.scrollHeight <= innerHeight), "no more than a screen");
        const bytes = await page.locator("ul.bytes b").allTextContents();
        assert.equal(
          bytes.reduce((sum, each) => sum + Number(each), 0),
          8192,
        );
        await page.evaluate(AXE);
        const found = await page.evaluate(async () => {
          const { violations } = await (window as unknown as { axe: Axe }).axe.run({
            runOnly: ["wcag2a", "wcag2aa", "wcag21aa"],
          });
          return violations.map(({ id, nodes }) => `${id}: ${nodes[0]?.html} ${nodes[0]?.failureSummary}`);
        });
        assert.deepEqual(found, []);
        assert.deepEqual(said, []);
        await context.close();
      }
    }
  });

  test("the plate: the slug drops at a stop, the part stays; a picture for the clipboard", async (t) => {
    for (const reducedMotion of ["no-preference", "reduce"] as const) {
      const { page, context, said } = await visit({ reducedMotion, permissions: ["clipboard-read", "clipboard-write"] });
      await firstTape(page);
      await says(page, "#closing", /close/);
      const at = async (part: number) => {
        await page.evaluate((part) => {
          const scrub = document.getElementById("scrub") as HTMLInputElement;
          scrub.value = String(Number(scrub.max) * part);
          scrub.dispatchEvent(new Event("input"));
        }, part);
        await drawn(page);
      };
      /** The colour of a place, mm, on the canvas above the drawing. */
      const colour = (x: number, y: number) =>
        page.evaluate(
          ([x, y]) => {
            const [scale = 1, left = 0, top = 0, pixels = 1] = (document.getElementById("base")?.dataset["window"] ?? "")
              .split(" ")
              .map(Number);
            const over = (document.getElementById("over") as HTMLCanvasElement).getContext("2d") as CanvasRenderingContext2D;
            const [px, py] = [(left + (x ?? 0) * 1000 * scale) * pixels, (top - (y ?? 0) * 1000 * scale) * pixels];
            return [...over.getImageData(Math.round(px), Math.round(py), 1, 1).data];
          },
          [x, y],
        );
      const isSteel = ([r = 0, , b = 0, a = 0]: number[]) => a === 255 && r > 150 && r < 230 && b >= r;
      const isFloor = ([r = 0, g = 0, b = 0, a = 0]: number[]) => a === 255 && Math.min(r, g, b) > 250;
      await at(0.05);
      assert.ok(isSteel(await colour(3, 3)) && isSteel(await colour(30, 0)), "nothing is cut through yet");
      await at(0.5);
      if (reducedMotion === "reduce") assert.ok(isFloor(await colour(3, 3)), "it is gone, without falling");
      await page.waitForTimeout(900);
      await drawn(page);
      assert.ok(isFloor(await colour(3, 3)), "the slug of the hexagon has dropped");
      assert.ok(isSteel(await colour(30, 0)) && isSteel(await colour(20, -17)));
      await at(1);
      assert.ok(isSteel(await colour(30, 0)), "the part stays");
      assert.ok(!isSteel(await colour(20, -17)), "the rest falls back");
      await at(0.05);
      assert.ok(isSteel(await colour(3, 3)), "and whole again");
      await page.locator("details.menu summary").nth(1).click();
      await page.click("#copy-picture");
      await says(page, "#message span", "Copied.");
      assert.deepEqual(await page.evaluate(async () => (await navigator.clipboard.read())[0]?.types), ["image/png"]);
      await page.locator("details.menu summary").nth(2).click();
      await page.uncheck("#plate");
      await drawn(page);
      assert.equal((await colour(30, 0))[3], 0);
      await page.check("#plate");
      if (reducedMotion === "no-preference") {
        const longest = await longestTask(page, async () => {
          await page.click("#play");
          await page.waitForTimeout(1500);
        });
        t.diagnostic(`the plate while the wire goes: longest task ${longest.toFixed(1)} ms of the thread's own time`);
        assert.ok(longest > 0.2 && longest < 33, `${longest} ms`);
      }
      // (this test looks at the canvas more often than the page does)
      assert.deepEqual(
        said.filter((text) => !text.includes("willReadFrequently")),
        [],
      );
      await context.close();
    }
  });

  test("a film of the wire; sounds, when they are asked for", async () => {
    const { page, context, said } = await visit({}, "", (context) =>
      context.addInitScript(() => {
        const heard = { strokes: 0, sparks: 0 };
        Object.assign(window, { heard });
        const { start, stop } = AudioBufferSourceNode.prototype;
        AudioBufferSourceNode.prototype.start = function (...when) {
          if (this.loop) heard.sparks++;
          else heard.strokes++;
          start.apply(this, when);
        };
        AudioBufferSourceNode.prototype.stop = function (...when) {
          if (this.loop) heard.sparks--;
          stop.apply(this, when as [number]);
        };
      }),
    );
    const heard = () => page.evaluate(() => (window as unknown as { heard: { strokes: number; sparks: number } }).heard);
    await says(page, "#walked", /^block/);
    await page.click("#play");
    await says(page, "#play", "Play");
    assert.deepEqual(await heard(), { strokes: 0, sparks: 0 });
    await page.locator("details.menu summary").nth(1).click();
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#film")]);
    assert.equal(download.suggestedFilename(), "wrench.webm");
    const film = readFileSync(await download.path());
    assert.equal(film.subarray(0, 4).toString("hex"), "1a45dfa3");
    assert.ok(film.length > 20_000, `${film.length} bytes`);
    await says(page, "#walked", /^block 29/);
    // another tape ends the film: it would be neither's
    const films: string[] = [];
    page.on("download", (each) => films.push(each.suggestedFilename()));
    await page.locator("details.menu summary").nth(1).click();
    await page.click("#film");
    await message(page, /film/);
    await page.locator('[data-part="die"]').click();
    await message(page, /no film of wrench/);
    await wholeTape(page);
    await prompt(page);
    assert.deepEqual(films, []);
    await page.locator("details.menu summary").nth(2).click();
    await page.check("#sound");
    await page.selectOption("#speed", "real");
    await page.keyboard.press("Escape");
    await page.click("#terminal");
    await page.keyboard.type("P");
    await page.waitForFunction(() => (window as unknown as { heard: { strokes: number } }).heard.strokes > 0);
    await page.click("#play");
    assert.equal((await heard()).sparks, 1);
    await page.click("#play");
    assert.equal((await heard()).sparks, 0);
    assert.deepEqual(said, []);
    await context.close();
  });

  test("lessons: a task is checked by the tape; a teacher links a step, and brings a file", async () => {
    const { page, context, said } = await visit({}, "#lesson=2");
    await says(page, "#lesson-title", "2/10 A line");
    await says(page, "#lines .cm-line:nth-child(2)", "20 CUT X,Y:40,-X:30,-Y");
    await prompt(page);
    const write = async (line: number, text: string) => {
      await page.click(`#lines .cm-line:nth-child(${line})`);
      await page.keyboard.press("Home");
      await page.keyboard.press("Shift+End");
      await page.keyboard.type(text);
      await page.keyboard.press("Control+Enter");
    };
    await write(2, "20 CUT X,Y:50,-X:31,-Y");
    await says(page, "#lesson-check", /^Not yet: block \d/);
    await page.waitForFunction(() => document.querySelectorAll("#list [aria-selected=true]").length === 1);
    // the learner's own text is there after a reload
    await prompt(page);
    await page.reload();
    await says(page, "#lesson-title", "2/10 A line");
    await says(page, "#lines .cm-line:nth-child(2)", "20 CUT X,Y:50,-X:31,-Y");
    await prompt(page);
    await write(2, "20 CUT X,Y:50,-X:30,-Y");
    await says(page, "#lesson-check", /^Right/);
    await page.evaluate(AXE);
    const found = await page.evaluate(async () => {
      const { violations } = await (window as unknown as { axe: Axe }).axe.run({ runOnly: ["wcag2a", "wcag2aa", "wcag21aa"] });
      return violations.map(({ id, nodes }) => `${id}: ${nodes[0]?.html} ${nodes[0]?.failureSummary}`);
    });
    assert.deepEqual(found, []);
    await shot(page, "lesson");
    await prompt(page);
    await page.click("#lesson-next");
    await says(page, "#lesson-title", "3/10 A circle");
    assert.equal(await page.evaluate(() => location.hash), "#lesson=3");
    await says(page, "#lines .cm-line:nth-child(1)", "10 C=(20,15):6");
    await prompt(page);
    await page.click("#lesson-answer");
    await says(page, "#lesson-check", /^Right/);
    // what lessons give is none of the learner's programs; the learner's own one is
    assert.equal(await page.locator(".work").count(), 1);
    // another language, the same step
    await page.locator("details.menu summary").nth(2).click();
    await page.selectOption("#language", "zh");
    await says(page, "#lesson-title", "3/10 圆");
    await page.selectOption("#language", "en");
    await page.keyboard.press("Escape");
    // a teacher's file: refused with its line, opened, linked
    await open(page, "mine.md", "# M\n\n## A\n\n```tape\nB1\n```\n");
    await says(page, "#message span", "mine.md, line 6: this is no 3B block.");
    await says(page, "#lesson-title", "3/10 A circle");
    await open(
      page,
      "mine.md",
      "# M\n\n## A hole\n\nTask: cut `C`.\n\n```skg\n10 c=o:3.0\n20 from O\n25 cut O,(1,0)\n30 end\n```\n\n```tape\nB3000B0B3000GXL1\nB3000B0B12000GYNR1\nB3000B0B3000GXL3\nDD\n```\n",
    );
    await says(page, "#lesson-title", "1/1 A hole");
    // (given in other letters than the machine lists it, it is still what was given: no answer, and none of the learner's)
    await wholeTape(page, 1);
    await hasLines(page, ["10 C=O:3", "20 FROM O", "25 CUT O,(1,0)", "30 END"]);
    await prompt(page);
    assert.equal(await page.textContent("#lesson-check"), "");
    assert.equal(await page.locator(".work").count(), 1);
    const link = await page.evaluate(() => location.href);
    assert.match(link, /#lessons=[\w-]+&lesson=1$/);
    await context.close();
    const other = await visit({}, new URL(link).hash);
    await says(other.page, "#lesson-title", "1/1 A hole");
    await hasLines(other.page, ["10 C=O:3", "20 FROM O", "25 CUT O,(1,0)", "30 END"]);
    await prompt(other.page);
    await other.page.click("#terminal");
    // (pasted, all in one go: the machine tells the program when the tape is there)
    await paste(other.page, "25 CUT C\n27 BACK\nRUN\n");
    await says(other.page, "#lesson-check", /^Right/);
    await other.page.click("#lesson-again");
    await wholeTape(other.page, 1);
    await prompt(other.page);
    await other.page.click("#lesson-close");
    await runPart(other.page, "die");
    assert.equal(await other.page.locator(".work").count(), 1, "what the step gave is not kept when the lessons are closed");
    assert.equal(await other.page.evaluate(() => location.hash), "");
    assert.equal(await other.page.isVisible("#lesson"), false);
    await other.page.click("#lesson-begin");
    await says(other.page, "#lesson-title", "1/10 A point");
    assert.deepEqual([...said, ...other.said], []);
    await other.context.close();
  });

  test("a card for each part: title and picture; who follows it comes to the part", async () => {
    const { page, context } = await visit();
    await page.goto(`${served.url}part-die.html`);
    await page.waitForURL(/#part=die&run$/);
    await page.waitForSelector("body[data-ready]");
    // (looked at by the clock: a page that was led here draws no frame before somebody looks)
    await page.waitForFunction(() => document.getElementById("made")?.textContent === "Die: the wire inside", undefined, {
      polling: 100,
    });
    const html = readFileSync("web/dist/part-die.html", "utf8");
    assert.match(html, /<meta property="og:title" content="Die: the wire inside: SKG">/);
    assert.match(html, /<meta property="og:image" content="part-die.png">/);
    assert.match(readFileSync("web/dist/index.html", "utf8"), /<meta property="og:image" content="part-wrench.png">/);
    // the picture is one, and something is drawn in it
    const [width, height, shades] = await page.evaluate(async () => {
      const picture = new Image();
      picture.src = "part-die.png";
      await picture.decode();
      const canvas = new OffscreenCanvas(picture.width, picture.height);
      const context = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
      context.drawImage(picture, 0, 0);
      const { data } = context.getImageData(0, 0, picture.width, picture.height);
      return [picture.width, picture.height, new Set(new Uint32Array(data.buffer)).size];
    });
    assert.deepEqual([width, height], [800, 420]);
    assert.ok((shades ?? 0) > 20, `${shades}`);
    await context.close();
  });

  test("in another page's frame: text and drawing side by side, RUN, no keys of a teletype, in a sandbox", async () => {
    const article = await serve();
    const { page, context, said } = await visit({ permissions: ["clipboard-read", "clipboard-write"] });
    try {
      await page.evaluate((code) => (location.hash = `#z=${code}&run`), await pack("10 REM MINE\n20 CUT O,(5,0)\n30 END\n"));
      await says(page, "#made", "MINE");
      await page.locator("details.menu summary").nth(1).click();
      await page.click("#copy-embed");
      await page.waitForFunction(async () => (await navigator.clipboard.readText()).startsWith("<iframe"));
      const code = await page.evaluate(() => navigator.clipboard.readText());
      article.changed.set(
        "article.html",
        `<!doctype html><link rel="icon" href="data:,"><title>An article</title><p>Text.</p>${code}`,
      );
      await page.setViewportSize({ width: 720, height: 600 });
      await page.goto(`${article.url}article.html`);
      const frame = page.frameLocator("iframe");
      await frame.locator("#sum", { hasText: "1 blocks · 5.0 mm" }).waitFor();
      const box = async (selector: string) =>
        (await frame.locator(selector).boundingBox()) ?? { x: 0, y: 0, width: 0, height: 0 };
      const [text, drawing] = [await box("#lines"), await box("#canvases")];
      assert.ok(text.width > 200 && drawing.width > 300 && text.height > 250, JSON.stringify([text, drawing]));
      assert.ok(text.x + text.width <= drawing.x, "side by side");
      assert.equal(await frame.locator("#terminal").isVisible(), false);
      assert.equal(await frame.locator("[data-key='13']").isVisible(), false);
      // changed and run where it stands
      await frame.locator(".cm-line").nth(1).click();
      await page.keyboard.press("End");
      await page.keyboard.type(",(5,5)");
      await frame.locator("#run").click();
      await frame.locator("#sum", { hasText: "2 blocks · 10.0 mm" }).waitFor();
      // a program that prints shows its paper
      await frame.locator(".cm-line").nth(2).click();
      await page.keyboard.press("Home");
      await page.keyboard.press("Shift+End");
      await page.keyboard.type('30 PRINT "HELLO"');
      await frame.locator("#run", { hasText: "RUN" }).waitFor();
      await frame.locator("#run").click();
      await frame.locator("#terminal").waitFor();
      await shot(page, "article");
      assert.deepEqual(said, []);
    } finally {
      await article.stop();
      await context.close();
    }
  });
});

/** The wrench of a first visit, in whatever language. */
const firstTape = async (page: import("playwright-core").Page): Promise<void> => {
  await page.waitForFunction(() => /^29 .* mm$/.test(document.getElementById("sum")?.textContent ?? ""));
};
