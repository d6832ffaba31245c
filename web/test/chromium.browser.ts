/** The page in Debian's chromium. */
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { pack } from "../src/link.ts";
import { layOut } from "../src/placed.ts";
import { readTape } from "../src/tape.ts";
import { Walk } from "../src/walk.ts";
import {
  AXE,
  active,
  begin,
  CHROMIUM,
  drawn,
  end,
  hasLines,
  lines,
  longestTask,
  message,
  onPaper,
  open,
  PARTS,
  PHONE,
  paste,
  prompt,
  runPart,
  saved,
  says,
  served,
  shot,
  state,
  tap,
  visit,
  visitEmpty,
  wholeTape,
} from "./chromium.ts";
import { longTape, WHOLE } from "./served.ts";

/** Counts of the worker's news at the page: all of them, the most whose paper was not shown yet, the board's cycles. */
declare const heardOfWorker: { heard: number; unseen: number; mostUnseen: number; cycles: number };

describe("the page in chromium", { skip: existsSync(CHROMIUM) ? false : "chromium is not installed", timeout: WHOLE }, () => {
  before(begin);
  after(end);

  test("first visit: small, silent, under a policy without inline script", async (t) => {
    served.sent.clear();
    const { page, said, context } = await visit();
    const ready = Number(await page.getAttribute("body", "data-ready"));
    await prompt(page);
    await onPaper(page, /DD\n>/);
    await page.evaluate(async () => void (await navigator.serviceWorker.ready));
    const bytes = [...served.sent].filter(([name]) => !/^manual/.test(name)).reduce((sum, [, size]) => sum + size, 0);
    t.diagnostic(`ready after ${ready} ms, ${bytes} bytes gzipped`);
    assert.ok(bytes < 500_000);
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
    assert.deepEqual(
      said.filter((text) => !text.includes("Content Security Policy")),
      [],
    );
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

  test("the machine is said to be at its prompt when it is there, and not before", async () => {
    const { page, context } = await visit();
    await prompt(page);
    for (const name of ["die", "wrench", "ratchet", "die"]) {
      const first = await page.evaluate((name) => {
        const state = document.getElementById("state") as HTMLElement;
        // what stands there when it is said first
        new MutationObserver((_, observer) => {
          if (state.textContent !== "at its prompt") return;
          observer.disconnect();
          document.body.dataset["sum"] = document.getElementById("sum")?.textContent ?? "";
        }).observe(state, { childList: true });
        document.querySelector<HTMLElement>(`[data-part=${name}]`)?.click();
        return [state.textContent, document.getElementById("run")?.textContent];
      }, name);
      assert.deepEqual(first, ["running", "Stop (ctrl-C)"]);
      await prompt(page);
      assert.match((await page.getAttribute("body", "data-sum")) ?? "", /^\d+ blocks · [\d.]+ mm$/);
      assert.equal(await saved(page, "3b"), readFileSync(`examples/${name}.3b`, "latin1"), name);
    }
    await context.close();
  });

  test("typing at the prompt, rubout, an error in words and in the program", async () => {
    const { page, said, context } = await visitEmpty();
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
    await message(page, /ERR 06 in line 20: geometry/);
    await says(page, "#lines .wrong", "20 CUT X,(5,5):1");
    await says(page, "#lines .fault", /ERR 06: geometry/);
    // the next run takes the mark away, typed key by key
    await page.keyboard.type("20 CUT (20,0):5\r30 BACK\r40 END\rRUN\r");
    await wholeTape(page);
    await hasLines(page, ["10 FROM O", "20 CUT (20,0):5", "30 BACK", "40 END"]);
    assert.equal(await page.locator("#lines .wrong").count(), 0);
    // pasted, at the machine's pace
    await paste(page, "NEW\n10 I=1\n20 PRINT I\n30 I=I+1\n40 IF I<4 GOTO 20\nRUN\n");
    await onPaper(page, "\n1\n2\n3\n");
    assert.deepEqual(said, []);
    await context.close();
  });

  test("a program without end: the page is not held up, and ctrl-C ends it", async (t) => {
    const { page, context } = await visit({}, "", tap);
    await prompt(page);
    await page.click("#terminal");
    await page.keyboard.type("10 PRINT 1\r20 GOTO 10\rRUN\r");
    await onPaper(page, "\n1\n1\n1\n");
    const heard = await page.evaluate(() => heardOfWorker.heard);
    const longest = await page.evaluate(
      (until) =>
        new Promise<number>((tell) => {
          let most = 0;
          let last = performance.now();
          const frame = (now: number): void => {
            most = Math.max(most, now - last);
            last = now;
            if (heardOfWorker.heard < until) requestAnimationFrame(frame);
            else tell(most);
          };
          requestAnimationFrame(frame);
        }),
      heard + 100,
    );
    t.diagnostic(`longest time between two frames while it prints without end: ${longest.toFixed(0)} ms`);
    // Paper that comes faster than it is shown would hold the page up: the board waits for it.
    assert.ok((await page.evaluate(() => heardOfWorker.mostUnseen)) <= 7);
    await says(page, "#run", "Stop (ctrl-C)");
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
        const hitsAt = (dx: number, dy: number): number => {
          let hits = 0;
          for (const [u, v] of px) {
            const [cx, cy] = [Math.round(u + offX + dx), Math.round(v + offY + dy)];
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
          return hits;
        };
        // (the middles of two pictures in whole pixels are half a pixel unsure)
        const halves = [-0.5, 0, 0.5];
        const hits = Math.max(...halves.flatMap((dx) => halves.map((dy) => hitsAt(dx, dy))));
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
    await page.locator("#lines .cm-line", { hasText: /^180 / }).hover();
    await page.waitForFunction(() => document.querySelectorAll("#list [aria-selected=true]").length > 5);
    const rows = await page.locator("#list [aria-selected=true] .line").allTextContents();
    assert.ok(rows.every((text) => text === "line 180"));
    await page.focus("#list");
    await page.keyboard.press("Home");
    for (let down = 0; down < 3; down++) await page.keyboard.press("ArrowDown");
    await active(page, 4);
    await says(page, "#lines .chosen", "50 CUT X:8.5#I*60");
    await page.focus("#over");
    await page.keyboard.press("n");
    await active(page, 5);
    await page.keyboard.press("p");
    await active(page, 4);
    // by the pointer, on the drawing: the middle of the hexagon's upper edge is block 5
    await drawn(page);
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
    await says(page, "#closing", /close/);
    // The line about a tape has its height from the start: the drawing does not move under the pointer.
    assert.equal(await height(), empty);
    const view = async () => {
      await drawn(page);
      return ((await page.getAttribute("#base", "data-window")) ?? "").split(" ").map(Number);
    };
    const first = await view();
    await page.hover("#over", { position: { x: 200, y: 150 } });
    await page.mouse.wheel(0, -400);
    await page.waitForFunction((before) => document.getElementById("base")?.dataset["window"] !== before, first.join(" "));
    const second = await view();
    assert.ok((second[0] as number) > (first[0] as number) * 1.5);
    await page.mouse.down();
    await page.mouse.move(700, 400, { steps: 4 });
    await page.mouse.up();
    const third = await view();
    assert.equal(third[0], second[0]);
    assert.notEqual(third[1], second[1]);
    await page.focus("#over");
    await page.keyboard.press("-");
    await page.keyboard.press("ArrowLeft");
    const fourth = await view();
    assert.ok((fourth[0] as number) < (third[0] as number));
    await page.keyboard.press("0");
    assert.deepEqual(await view(), first);
    await context.close();
  });

  test("the controller's walk: play, pause, scrub; the tape runs past", async () => {
    const { page, context } = await visit();
    await runPart(page, "wrench");
    await says(page, "#closing", /close/);
    const punched = async () => {
      await drawn(page);
      return page.evaluate(() => (document.getElementById("punched") as HTMLCanvasElement).toDataURL());
    };
    await page.selectOption("#pace", "2000");
    await page.click("#play");
    // (Stopped in the frame that it is seen in: until a click comes from outside it may be at its end.)
    const text = await page.evaluate(
      () =>
        new Promise<string>((tell) => {
          const look = (): void => {
            const text = document.getElementById("walked")?.textContent ?? "";
            if (/^block ([2-9]|\d\d) of 29/.test(text)) {
              document.getElementById("play")?.click();
              tell(text);
            } else {
              requestAnimationFrame(look);
            }
          };
          look();
        }),
    );
    for (let frames = 0; frames < 20; frames++) await drawn(page);
    assert.equal(await page.textContent("#walked"), text, "it stands still");
    assert.match(text, /x -?[\d.]+ y -?[\d.]+ mm · off the contour [\d.]+ µm/);
    const middle = await punched();
    await page.locator("#lines .cm-line", { hasText: /^180 / }).hover();
    await shot(page, "page"); // (docs/pictures/page.png)
    await page.focus("#scrub");
    await page.keyboard.press("End");
    await says(page, "#walked", /^block 29 of 29 · x 45\.\d+ y -(19\.99|20\.00)/);
    assert.notEqual(await punched(), middle, "the tape has run on");
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
    const { page, context, said } = await visitEmpty();
    await prompt(page);
    await page.click("#terminal");
    await page.keyboard.type("10 REM KEPT\rI=42\r");
    await hasLines(page, ["10 REM KEPT"]);
    await page.locator("details.menu summary").nth(2).click();
    await page.selectOption("#theme", "dark");
    await page.fill("#wire", "0.25");
    await page.keyboard.press("Tab");
    await page.waitForFunction(() => {
      const [machine, settings] = ["machine", "settings"].map((name) =>
        JSON.parse(localStorage.getItem(`skg:/some/folder/:${name}`) ?? "{}"),
      );
      return /I=42\r\n>$/.test(machine.paper) && settings.theme === "dark" && settings.wire === 0.25;
    });
    await page.reload();
    await page.waitForSelector("body[data-ready]");
    await onPaper(page, "10 REM KEPT");
    await hasLines(page, ["10 REM KEPT"]);
    await prompt(page);
    await page.click("#terminal");
    await page.keyboard.type("PRINT I\r");
    await onPaper(page, "\n42\n");
    assert.equal(await page.getAttribute("html", "data-theme"), "dark");
    assert.equal(await page.inputValue("#wire"), "0.25");
    const variables = await saved(page, "json");
    await runPart(page, "punch");
    await prompt(page);
    const program = await lines(page);
    const file = await saved(page, "json");
    assert.deepEqual(said, []);
    await context.close();
    const other = await visit();
    await open(other.page, "all.json", file);
    await wholeTape(other.page);
    assert.equal(await saved(other.page, "3b"), readFileSync("examples/punch.3b", "latin1"));
    await hasLines(other.page, program);
    assert.equal(await other.page.getAttribute("html", "data-theme"), "dark");
    await other.context.close();

    // brought in before the board is there
    let come = (): void => undefined;
    const isThere = new Promise<void>((resolve) => (come = resolve));
    const early = await visit({ serviceWorkers: "block" }, "", (context) =>
      context.route("**/board.wasm", (route) => isThere.then(() => route.continue())),
    );
    await open(early.page, "all.json", variables);
    await message(early.page, /all\.json/);
    come();
    await prompt(early.page);
    await early.page.click("#terminal");
    await early.page.keyboard.type("PRINT I,I\r");
    await onPaper(early.page, "\n42 42\n");
    await early.context.close();
  });

  test("reload while a program runs, or asks, that was pasted with its RUN: it is there again", async () => {
    const { page, context, said } = await visit();
    for (const program of ["10 I=0\n20 I=I+1\n30 GOTO 20\n", "10 INPUT D\n20 PRINT D\n30 END\n"]) {
      await prompt(page);
      await page.click("#terminal");
      await paste(page, `NEW\n${program}RUN\n`);
      const there = () => hasLines(page, program.trim().split("\n"));
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
    // (a part has an address with a card, which leads to it)
    const card = await copied("http");
    assert.match(card, /\/part-ratchet\.html$/);
    await page.locator("details.menu summary").nth(1).click();
    await page.click("#copy-embed");
    const frame = await copied("<iframe");
    assert.match(
      frame,
      /^<iframe src="http.*&run&embed" title="SKG" width="100%" height="420" loading="lazy" sandbox="allow-scripts /,
    );
    const link = (/src="(.*?)&embed"/.exec(frame)?.[1] ?? "").replaceAll("&amp;", "&");
    await page.goto(card);
    await page.waitForSelector("body[data-ready]");
    await hasLines(page, program);
    await context.close();

    const hash = link.slice(link.indexOf("#"));
    const other = await visit({}, hash);
    await wholeTape(other.page);
    await hasLines(other.page, program);
    assert.equal(await saved(other.page, "3b"), readFileSync("examples/ratchet.3b", "latin1"));
    await prompt(other.page);
    await other.page.click("#terminal");
    await other.page.keyboard.type("5 REM MINE\r");
    const mine = ["5 REM MINE", ...program];
    await hasLines(other.page, mine);
    await other.page.evaluate(() => {
      location.hash = "#part=scale&run";
    });
    await hasLines(
      other.page,
      PARTS.find(({ name }) => name === "scale")
        ?.program.trim()
        .split("\n") ?? [],
    );
    await wholeTape(other.page, readFileSync("examples/scale.3b", "latin1").match(/^B/gm)?.length);
    await other.page.locator(".work button").first().click();
    await hasLines(other.page, mine);
    await other.page.evaluate(
      (cut) => {
        location.hash = cut;
      },
      hash.slice(0, 80),
    );
    await message(other.page, /link is not whole/);
    await other.page.evaluate(() => {
      location.hash = "#part=nothing";
    });
    await message(other.page, /no part nothing/);
    await other.context.close();

    const small = await visit({ viewport: { width: 800, height: 500 } }, `${hash}&embed`);
    await wholeTape(small.page);
    await hasLines(small.page, program);
    assert.equal(await small.page.isVisible("#parts"), false);
    assert.equal(await small.page.isVisible("#full"), true);
    assert.equal(await small.page.evaluate(() => localStorage.length), 0, "the visitor's own machine is left alone");
    assert.equal(await small.page.isVisible("#message"), false, "there is nothing to complain of");
    await shot(small.page, "embed");
    await small.context.close();
  });

  test("every example of the manual can be tried", async () => {
    for (const [file, source] of [
      ["manual.html", "docs/manual.md"],
      ["manual.zh.html", "docs/zh/manual.md"],
    ] as const) {
      const { page, context, said } = await visit();
      await page.goto(served.url + file);
      const links = await page.locator(".try a").evaluateAll((all) => all.map((link) => link.getAttribute("href") ?? ""));
      const text = readFileSync(source, "utf8");
      const programs = [...text.matchAll(/^```skg.*\n([^]*?)^```$/gm)];
      assert.equal(links.length, programs.length);
      assert.equal(await page.locator("img").count(), [...text.matchAll(/^!\[/gm)].length);
      await page.locator(".try a").first().click();
      await page.waitForSelector("body[data-ready]");
      await wholeTape(page);
      const tape = /^```tape\n([^]*?)^```$/m.exec(text)?.[1];
      assert.equal((await saved(page, "3b")).replaceAll("\r", ""), tape);
      assert.deepEqual(said, []);
      await context.close();
    }
  });

  test("the manual speaks the page's language, and its links to chapters go there", async () => {
    for (const address of [served.url, `file://${process.cwd()}/web/dist/skg.html`]) {
      const { page, context, said } = await visit({ locale: "zh-CN" }, "", undefined, address);
      await page.waitForSelector("body[data-ready]");
      await page.click("#manual");
      const manual = page.frameLocator("#manual-frame");
      assert.match((await manual.locator("h1").textContent()) ?? "", /SKG 语言/);
      assert.equal(await page.locator("#manual-pane a").getAttribute("href"), "manual.zh.html");
      await manual.locator("img").first().scrollIntoViewIfNeeded();
      await page.waitForFunction(() => {
        const text = (document.getElementById("manual-frame") as HTMLIFrameElement).contentDocument;
        return [...(text?.images ?? [])].some((picture) => picture.complete && picture.naturalWidth > 0);
      });
      await manual.locator('a[href="#11-错误"]').first().click();
      await page.waitForFunction(() => {
        const text = (document.getElementById("manual-frame") as HTMLIFrameElement).contentDocument;
        return Math.abs(text?.getElementById("11-错误")?.getBoundingClientRect().top ?? 1000) < 50;
      });
      await shot(page, "manual-zh");
      await page.locator("details.menu summary").nth(2).click();
      await page.selectOption("#language", "en");
      await manual.locator("h1", { hasText: "The SKG language" }).waitFor();
      assert.deepEqual(said, []);
      await context.close();
    }
  });

  test("files: a program, a tape in a foreign form, ISO, SVG and DXF out", async () => {
    const { page, context } = await visit();
    await open(page, "mine.skg", readFileSync("examples/wrench.skg", "latin1"));
    await hasLines(page, readFileSync("examples/wrench.skg", "latin1").trim().split(/\r?\n/));
    await open(page, "foreign.3b", readFileSync("examples/wrench.3b", "latin1").replaceAll("\r\n", "").replaceAll("B", " B "));
    await wholeTape(page);
    await message(page, /^foreign\.3b: 29 blocks, written in another form/);
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
      ["a.3b", "", /a\.3b is empty/],
      ["a.png", "\x89PNG", /is no program, no tape/],
      ["a.skg", "10 REM \xe9", /byte 8/],
      ["a.dxf", "0\nSECTION\n", /skg cut --program/],
      ["a.xy", "(+)D(0,0)=>D0;", /skg xy/],
      ["a.json", '{"format":', /not whole/],
      ["big.3b", "B1B2B2GYL1\n".repeat(200_000), /too large: at most 2048 KB/],
    ] as const) {
      await open(page, name, text);
      await message(page, sentence);
    }
    // a program that the machine refuses: it is there as a text, with the line marked, and the machine keeps its own
    await open(page, "wrong.skg", "10 CUT X\n20 NONSENSE\n30 END\n");
    await message(page, /lines are not taken/);
    await says(page, "#lines .wrong", "20 NONSENSE");
    await says(page, "#lines .fault", /ERR 01: not understood/);
    await runPart(page, "die");
    assert.deepEqual(said, []);
    await context.close();
  });

  test("a browser that keeps nothing, and one without the machine", async () => {
    const refusing = await visit({}, "", (context) =>
      context.addInitScript(() => {
        Storage.prototype.setItem = () => {
          throw new DOMException("full", "QuotaExceededError");
        };
      }),
    );
    await message(refusing.page, /refuses to keep/);
    await runPart(refusing.page, "die");
    assert.deepEqual(refusing.said, []);
    await refusing.context.close();

    const dead = await visit({ serviceWorkers: "block" }, "", (context) =>
      context.route("**/board.wasm", (route) => route.fulfill({ body: "no" })),
    );
    await message(dead.page, /machine cannot run here/);
    await open(dead.page, "a.3b", readFileSync("examples/die.3b", "latin1"));
    await wholeTape(dead.page);
    await dead.page.click("#play");
    await says(dead.page, "#walked", /^block/);
    await dead.context.close();
  });

  test("offline, after the first visit", async () => {
    const { page, context } = await visit();
    await page.evaluate(async () => void (await navigator.serviceWorker.ready));
    await page.waitForFunction(async () => (await caches.keys()).length > 0 && navigator.serviceWorker.controller !== null);
    served.cut(true);
    try {
      await page.reload();
      await page.waitForSelector("body[data-ready]");
      await runPart(page, "recut");
      assert.equal(await saved(page, "3b"), readFileSync("examples/recut.3b", "latin1"));
      await page.goto(`${served.url}manual.html`);
      assert.match((await page.textContent("h1")) ?? "", /SKG language/);
    } finally {
      served.cut(false);
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
      seen.add(
        await page.evaluate(() => {
          const at = document.activeElement as HTMLElement;
          return at.id || at.dataset["part"] || at.dataset["key"] || at.className || at.tagName;
        }),
      );
    }
    for (const wanted of ["run", "open", "wrench", "over", "fit", "list", "reset", "text", "manual", "xterm-helper-textarea"]) {
      assert.ok(seen.has(wanted), `${wanted} of ${[...seen].join(" ")}`);
    }
    await page.focus("[data-part=die]");
    await page.keyboard.press("Enter");
    await prompt(page);
    await page.focus("#run");
    await page.keyboard.press("Space");
    await wholeTape(page);
    await page.focus("#text");
    await page.keyboard.press("Control+A");
    await page.keyboard.type("10 REM TYPED");
    await page.keyboard.press("Control+Enter");
    await hasLines(page, ["10 REM TYPED"]);
    await onPaper(page, "RUN");
    await context.close();
  });

  test("names, roles and contrast, in both languages, light and dark", async () => {
    for (const locale of ["en-US", "zh-CN"]) {
      for (const colorScheme of ["light", "dark"] as const) {
        const { page, context } = await visit({ locale, colorScheme });
        await page.waitForFunction(() => document.querySelectorAll("[data-part]").length > 50);
        assert.equal(await page.getAttribute("html", "lang"), locale === "zh-CN" ? "zh-CN" : "en");
        await page.locator("[data-part=wrench]").click();
        await page.waitForFunction(() => document.querySelectorAll("#lines .cm-line").length >= 12);
        await says(page, "#sum", /^29 .* mm$/);
        await page.locator("#lines .cm-line").nth(7).hover();
        await page.locator("details.menu summary").nth(2).click();
        await page.evaluate(AXE);
        const found = await page.evaluate(async () => {
          const { violations } = await (
            window as unknown as {
              axe: {
                run(options: object): Promise<{
                  violations: { id: string; nodes: { html: string; failureSummary: string }[] }[];
                }>;
              };
            }
          ).axe.run({ runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "best-practice"] });
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
    await page.waitForFunction(() => document.querySelectorAll("#lines .cm-line").length >= 12);
    await wholeTape(page);
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
    await drawn(page);
    const before = await page.getAttribute("#base", "data-window");
    await page.evaluate(() => {
      const canvas = document.getElementById("over") as HTMLElement;
      canvas.setPointerCapture = () => undefined;
      const send = (kind: string, pointerId: number, clientX: number, clientY: number): boolean =>
        canvas.dispatchEvent(new PointerEvent(kind, { pointerId, clientX, clientY, pointerType: "touch", bubbles: true }));
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
    const { page, context } = await visit({}, "", tap);
    await prompt(page);
    await page.locator("details.menu summary").nth(2).click();
    await page.selectOption("#speed", "real");
    await page.keyboard.press("Escape");
    await page.click("#terminal");
    const cycles = () => page.evaluate(() => heardOfWorker.cycles);
    const [began, before] = [Date.now(), await cycles()];
    await page.keyboard.type("PRINT 1/3\r");
    await onPaper(page, "0.33333333\n>");
    const [took, board] = [Date.now() - began, ((await cycles()) - before) / 2e6];
    t.diagnostic(`PRINT 1/3 with echo and answer at 110 baud: ${took} ms; ${board.toFixed(2)} s of the board's clock`);
    // By the board's own clock: a busy machine gives it less time, never more.
    assert.ok(took > 1500);
    assert.ok(board > 1.5 && board < 8, `${board} s`);
    await context.close();
  });

  test("20,000 blocks panned: drawn once a frame, for about ten times what 2,000 cost; the list has the rows in sight alone", async (t) => {
    const { page, context } = await visit();
    const cdp = await context.newCDPSession(page);
    // (The thread's own time: other programs on this machine do not count.)
    await cdp.send("Performance.enable", { timeDomain: "threadTicks" });
    const spent = async () =>
      (await cdp.send("Performance.getMetrics")).metrics.find(({ name }) => name === "ScriptDuration")?.value ?? 0;
    await runPart(page, "wrench");
    await drawn(page);
    t.diagnostic(`a block: ${Number(await page.getAttribute("#base", "data-took")).toFixed(1)} ms`);
    const pan = async (rows: number) => {
      await open(page, `${rows}.3b`, longTape(rows));
      await wholeTape(page, rows * 200);
      await says(page, "#closing", /close/);
      const before = await spent();
      const panned = await page.evaluate(
        () =>
          new Promise<{ frame: number; draws: number; corners: number }>((tell) => {
            const canvas = document.getElementById("over") as HTMLElement;
            const [began, frames] = [performance.now(), 30];
            const counts = { draws: 0, corners: 0 };
            const looking = new MutationObserver((found) => (counts.draws += found.length));
            looking.observe(document.getElementById("base") as HTMLElement, { attributeFilter: ["data-took"] });
            const plain = Path2D.prototype.lineTo;
            Path2D.prototype.lineTo = function (x, y) {
              counts.corners++;
              plain.call(this, x, y);
            };
            let at = 0;
            const frame = (): void => {
              if (at++ === frames) {
                Path2D.prototype.lineTo = plain;
                looking.disconnect();
                tell({
                  frame: (performance.now() - began) / frames,
                  draws: counts.draws / frames,
                  corners: counts.corners / frames,
                });
                return;
              }
              for (let times = 0; times < 3; times++) {
                canvas.dispatchEvent(new KeyboardEvent("keydown", { key: at % 2 ? "ArrowLeft" : "ArrowRight" }));
              }
              requestAnimationFrame(frame);
            };
            requestAnimationFrame(frame);
          }),
      );
      return { ...panned, cost: (await spent()) - before };
    };
    const few = await pan(10);
    const many = await pan(100);
    const times = many.cost / few.cost;
    t.diagnostic(
      `20,000 blocks: ${many.frame.toFixed(1)} ms a frame, ${many.corners} corners, ${times.toFixed(1)} times the time of 2,000`,
    );
    // (three keys a frame; one more draw is that of the tape, which came late)
    assert.deepEqual([few.draws, many.draws].map(Math.round), [1, 1]);
    assert.ok(many.corners > 20_000 && many.corners < 80_000, `${many.corners} corners`);
    assert.ok(times < 30, `${times}: were it quadratic, it would be 100`);
    assert.ok((await page.locator("#list [role=option]").count()) < 100);
    await shot(page, "many");
    await context.close();
  });

  test("a tape that was broken off is saved as it is, named so, and after a question alone", async () => {
    const { page, context } = await visitEmpty();
    await page.keyboard.type("10 FROM O\r20 CUT (10,0);(10,10)\r30 CUT (20,10);(20,20)\r40 CUT X,(5,5):1\r50 BACK\rRUN\r");
    await onPaper(page, "ERR 06 LINE 40");
    await says(page, "#sum", /^3 blocks.* no end/);
    for (const [kind, ending] of [
      ["3b", ".3b"],
      ["iso", ".nc"],
    ] as const) {
      await page.locator("details.menu summary").first().click();
      await page.click(`[data-save="${kind}"]`);
      await page.click("#question-no");
      await page.locator("details.menu summary").first().click();
      await page.click(`[data-save="${kind}"]`);
      const [download] = await Promise.all([page.waitForEvent("download"), page.click("#question-yes")]);
      assert.equal(download.suggestedFilename(), `part-unfinished${ending}`);
      const text = readFileSync(await download.path(), "latin1");
      if (kind === "3b") assert.equal(text, "B10000B0B10000GXL1\r\nB0B10000B10000GYL2\r\nB10000B0B10000GXL1\r\nD\r\n");
      else assert.ok(/G1/.test(text) && !/M30/.test(text), text);
    }
    // in mid-run, waiting
    await page.keyboard.press("Escape");
    await page.click("#terminal");
    await page.keyboard.type("40 INPUT D\rRUN\r");
    await state(page, "asks for a number");
    await page.locator("details.menu summary").first().click();
    await page.click('[data-save="3b"]');
    await says(page, "#question-text", /no end/);
    await page.click("#question-no");
    await context.close();
  });

  test("a typo loses nothing: the line is marked, the machine keeps its program, a reload the text", async () => {
    const { page, context, said } = await visit();
    await wholeTape(page);
    await prompt(page);
    const machine = () =>
      page.evaluate(
        () => JSON.parse(localStorage.getItem("skg:/some/folder/:machine") ?? "{}") as { program: string; draft?: string },
      );
    const before = (await machine()).program;
    await page.click("#lines .cm-line:nth-child(3)");
    await page.keyboard.press("Home");
    await page.keyboard.press("Shift+End");
    await page.keyboard.type("30 FRAM O");
    await says(page, "#lines .wrong", "30 FRAM O");
    await says(page, "#lines .fault", /ERR 01: not understood/);
    await shot(page, "error"); // (docs/pictures/page-error.png)
    await page.keyboard.press("Control+Enter");
    await message(page, /machine keeps its program/);
    assert.equal((await machine()).program, before);
    await says(page, "#made", /program changed/);
    await page.reload();
    await page.waitForSelector("body[data-ready]");
    await says(page, "#lines .cm-line:nth-child(3)", "30 FRAM O");
    await wholeTape(page, 29); // the drawing is there again, too
    // the fault's link opens the manual at its place
    await page.click("#lines .cm-line:nth-child(2)");
    await page.keyboard.press("End");
    await page.keyboard.type(" ");
    await page.click("#lines .fault button");
    await page.waitForFunction(() =>
      (document.getElementById("manual-frame") as HTMLIFrameElement).contentDocument?.getElementById("11-errors"),
    );
    await page.click("#close-manual");
    // put right, it runs; RETURN numbers the next line
    await page.click("#lines .cm-line:nth-child(3)");
    await page.keyboard.press("Home");
    await page.keyboard.press("Shift+End");
    await page.keyboard.type("30 FROM O\n");
    await says(page, "#lines .cm-line:nth-child(4)", "35 ");
    await page.keyboard.type("REM NUMBERED");
    await page.keyboard.press("Control+Enter");
    await page.waitForFunction(() => /35 REM NUMBERED/.test(localStorage.getItem("skg:/some/folder/:machine") ?? ""));
    await wholeTape(page, 29);
    assert.deepEqual(said, []);
    await context.close();
  });

  test("a change of the text runs by itself where that is wanted", async () => {
    const { page, context } = await visit();
    await wholeTape(page);
    await page.locator("details.menu summary").nth(2).click();
    await page.check("#auto");
    await page.keyboard.press("Escape");
    await page.click("#lines .cm-line:nth-child(5)");
    await page.keyboard.press("Home");
    await page.keyboard.press("Shift+End");
    await page.keyboard.type("50 CUT X:7.5#I*60");
    await says(page, "#sum", /^29 blocks · 4[89]\d\.\d mm$/);
    await says(page, "#made", /^A wrench: hexagon/);
    assert.equal(await page.evaluate(() => document.activeElement?.id), "text", "who types goes on typing");
    await context.close();
  });

  test("a link that ends in an ERR takes nothing away: one's own programs are kept until they are deleted", async () => {
    const { page, context } = await visitEmpty();
    await page.keyboard.type("10 REM MY OWN\r20 A=1\r");
    await hasLines(page, ["10 REM MY OWN", "20 A=1"]);
    await page.evaluate((code) => (location.hash = `#z=${code}&run`), await pack("10 FROM O\n20 CUT X,(5,5):1\n30 END\n"));
    await message(page, /ERR 06 in line 20/);
    await page.click("#dismiss");
    await page.locator(".work b", { hasText: "MY OWN" }).waitFor();
    await page.reload();
    await page.waitForSelector("body[data-ready]");
    await page.locator(".work button", { hasText: "MY OWN" }).first().click();
    await hasLines(page, ["10 REM MY OWN", "20 A=1"]);
    await page.locator(".work", { hasText: "MY OWN" }).locator(".bin").click();
    await page.waitForFunction(() => ![...document.querySelectorAll(".work b")].some((one) => one.textContent === "MY OWN"));
    await context.close();
  });

  test("what is drawn says which program made it, and saving says when that has changed", async () => {
    const { page, context } = await visit();
    await wholeTape(page);
    await prompt(page);
    await says(page, "#made", "Wrench");
    await page.click("#terminal");
    await page.keyboard.type("50 CUT X:7.5#I*60\r");
    await says(page, "#made", /program changed/);
    await page.locator("details.menu summary").first().click();
    await page.click('[data-save="3b"]');
    await says(page, "#question-text", /changed after this tape/);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#question-yes")]);
    assert.equal(readFileSync(await download.path(), "latin1"), readFileSync("examples/wrench.3b", "latin1"));
    await open(page, "other.3b", readFileSync("examples/die.3b", "latin1"));
    await says(page, "#made", /file other/);
    await page.locator("details.menu summary").first().click();
    const [tape] = await Promise.all([page.waitForEvent("download"), page.click('[data-save="3b"]')]);
    assert.equal(tape.suggestedFilename(), "other.3b");
    await context.close();
  });

  test("INPUT: who pressed RUN types at the teletype, and RETURN never presses Stop", async () => {
    const { page, context } = await visitEmpty();
    await page.keyboard.type("10 INPUT D\r20 PRINT D*2\r30 END\r");
    // (while it takes lines the button says Stop, and RETURN does not press that)
    await hasLines(page, ["10 INPUT D", "20 PRINT D*2", "30 END"]);
    await prompt(page);
    await page.focus("#run");
    await page.keyboard.press("Enter");
    await state(page, "asks for a number");
    await page.waitForFunction(() => document.activeElement?.className === "xterm-helper-textarea");
    await page.keyboard.type("21\r");
    await onPaper(page, "\n42\n");
    await page.keyboard.type("RUN\r");
    await state(page, "asks for a number");
    await page.focus("#run");
    await page.keyboard.press("Enter");
    await drawn(page);
    await state(page, "asks for a number");
    await context.close();
  });

  test("copies and tabs: nothing shared between copies, a word between tabs, a new version at a click", async () => {
    const { page, context } = await visit();
    await wholeTape(page);
    await page.waitForFunction(async () => (await caches.keys()).length > 0 && navigator.serviceWorker.controller !== null);
    const other = await context.newPage();
    await other.goto(served.url.replace("/some/folder/", "/v2/"));
    await other.waitForSelector("body[data-ready]");
    await other.waitForFunction(async () => (await caches.keys()).length === 2);
    const names = await other.evaluate(() => Object.keys(localStorage));
    assert.ok(names.some((name) => name.startsWith("skg:/v2/:")) && names.some((name) => name.startsWith("skg:/some/folder/:")));
    assert.equal(await page.isVisible("#message"), false);
    const second = await context.newPage();
    await second.goto(served.url);
    await second.waitForSelector("body[data-ready]");
    await message(page, /open in another tab/);
    await second.close();
    // a new version: fetched whole, offered, and there after one click
    served.changed.set("offline.js", `${readFileSync("web/dist/offline.js", "utf8").replace(/[0-9a-f]{12}/, "0123456789ab")}`);
    served.changed.set("index.html", readFileSync("web/dist/index.html", "utf8").replace("<title>SKG", "<title>New SKG"));
    await page.evaluate(async () => void (await (await navigator.serviceWorker.getRegistration())?.update()));
    await message(page, /new version/);
    await page.click("#offer");
    await page.waitForFunction(async () => (await caches.keys()).some((name) => name.endsWith(":0123456789ab")));
    await page.waitForFunction(async () => /<title>New/.test(await (await fetch("./")).text()));
    served.changed.clear();
    await context.close();
  });

  test("60,000 blocks on one spot, and 2 MB of them, do not hold the page up", async (t) => {
    const { page, context } = await visit();
    await wholeTape(page);
    for (const [what, tape, blocks] of [
      ["to and fro", `${"B1B0B1GXL1\r\nB0B1B1GYL2\r\nB1B0B1GXL3\r\nB0B1B1GYL4\r\n".repeat(15_000)}DD\r\n`, 60_000],
      ["a stop after each", `${"B1B0B1GXL1\r\nD\r\nB1B0B1GXL3\r\nD\r\n".repeat(30_000)}DD\r\n`, 60_000],
      ["circles", `${"B9B0B36GYNR1\r\n".repeat(60_000)}DD\r\n`, 60_000],
      ["2 MB", longTape(550), 110_000],
    ] as const) {
      const longest = await longestTask(page, async () => {
        await open(page, "spot.3b", tape);
        await says(page, "#sum", new RegExp(`^${blocks} blocks`));
        await says(page, "#closing", /close/);
        for (let frames = 0; frames < 10; frames++) await drawn(page);
      });
      t.diagnostic(`${what}: longest task ${longest.toFixed(0)} ms of the thread's own time`);
      assert.ok(longest > 1 && longest < 200, `${what}: ${longest} ms`);
    }
    await context.close();
  });

  test("beside the drawing: grid, a measure, blocks step by step; the manual's programs run beside it", async () => {
    const { page, context, said } = await visit();
    await wholeTape(page);
    await prompt(page);
    const picture = async () => {
      await drawn(page);
      return page.evaluate(() => (document.getElementById("base") as HTMLCanvasElement).toDataURL());
    };
    const plain = await picture();
    await page.locator("details.menu summary").nth(2).click();
    await page.check("#grid");
    await page.keyboard.press("Escape");
    assert.notEqual(await picture(), plain);
    await page.click("#measure");
    const [scale = 1, x = 0, y = 0] = ((await page.getAttribute("#base", "data-window")) ?? "").split(" ").map(Number);
    const at = (mm: number) => ({ position: { x: x + mm * 1000 * scale, y: y - 20_000 * scale } });
    await page.click("#over", at(0));
    await page.hover("#over", at(50));
    const said50 = (await page.textContent("#place")) ?? "";
    assert.ok(Math.abs(Number(/distance ([\d.]+)/.exec(said50)?.[1]) - 50) < 0.5, said50);
    await page.click("#play"); // (the block follows the wire)
    await says(page, "#play", "Play");
    await page.focus("#list");
    await page.keyboard.press("Home");
    await active(page, 1);
    await page.click("#next");
    await active(page, 2);
    await page.click("#before");
    await active(page, 1);
    await page.click("#manual");
    await page.frameLocator("#manual-frame").locator(".try a").first().click();
    await says(page, "#made", "A PLATE WITH A HOLE");
    await wholeTape(page);
    assert.ok(await page.isVisible("#manual-frame"));
    assert.deepEqual(said, []);
    await context.close();
  });

  test("one file, from a double click: everything runs from it", async () => {
    const { page, context, said } = await visit({}, "", undefined, `file://${process.cwd()}/web/dist/skg.html`);
    await wholeTape(page, 29);
    await runPart(page, "fit-gear");
    assert.equal(await saved(page, "3b"), readFileSync("examples/fit-gear.3b", "latin1"));
    await page.click("#machine");
    await page.waitForSelector("#inside .code .present");
    await page.click("#machine-pane .close");
    await page.click("#play");
    await says(page, "#walked", /^block/);
    await page.click("#manual");
    await page.frameLocator("#manual-frame").locator(".try a").first().click();
    await says(page, "#made", "A PLATE WITH A HOLE");
    await wholeTape(page);
    assert.deepEqual(said, []);
    await context.close();
  });

  test("numbers to set: a slider cuts the part anew, and the program is plain SKG", async () => {
    const { page, context, said } = await visit();
    await runPart(page, "set-gear");
    assert.equal(await saved(page, "3b"), readFileSync("examples/set-gear.3b", "latin1"));
    assert.equal(await page.isVisible("#works"), false, "an example is none of the visitor's programs, however it is listed");
    const teeth = page.locator("#parameters input[type=range]").nth(1);
    assert.equal(await teeth.getAttribute("aria-label"), "teeth");
    assert.equal(await teeth.inputValue(), "16");
    await teeth.focus();
    for (let more = 0; more < 4; more++) await page.keyboard.press("ArrowRight");
    await page.waitForFunction(() => /50 I1=20/.test(document.querySelector(".cm-content")?.textContent ?? ""));
    await wholeTape(page, 603); // (as the gear of 20 teeth in the field below)
    await says(page, "#made", /^An involute spur gear to set/);
    assert.equal(await page.evaluate(() => (document.activeElement as HTMLInputElement).type), "range");
    assert.match(await saved(page, "skg"), /^50 I1=20$/m);
    assert.deepEqual(said, []);
    await context.close();
  });
});
