/** The machine's inside, and a first visit, in Debian's chromium. */
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
  message,
  onPaper,
  PHONE,
  prompt,
  saved,
  says,
  served,
  shot,
  visit,
  wholeTape,
} from "./chromium.ts";
import { WHOLE } from "./served.ts";

describe("seen at a glance", { skip: existsSync(CHROMIUM) ? false : "chromium is not installed", timeout: WHOLE }, () => {
  before(begin);
  after(end);

  test("a first visit: the wire cuts a part, a few lines say what this is; it stands still where that is wanted", async () => {
    const { page, context } = await visit();
    await says(page, "#walked", /^block/);
    assert.ok(await page.isVisible("#welcome"));
    assert.ok(await page.isVisible("#legend li"));
    const box = await page.locator("#lines").boundingBox();
    assert.ok(box && box.height > 250, `the program has room: ${JSON.stringify(box)}`);
    await page.click("#play");
    await says(page, "#play", "Play");
    await context.close();
    const still = await visit({ reducedMotion: "reduce" });
    await wholeTape(still.page);
    await prompt(still.page);
    await says(still.page, "#closing", /close/);
    for (let frames = 0; frames < 5; frames++) await drawn(still.page);
    assert.equal(await still.page.textContent("#walked"), "");
    await still.context.close();
  });

  test("on a phone the lines stand beside the drawing; the manual has the screen, and its programs go to the drawing", async () => {
    const { page, context, said } = await visit({ viewport: PHONE, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
    await wholeTape(page);
    assert.ok(await page.isVisible("#drawing #welcome"));
    await shot(page, "phone-first"); // (docs/pictures/page-phone.png)
    await page.tap("#manual");
    assert.equal(await page.isVisible("#drawing"), false);
    await page.frameLocator("#manual-frame").locator(".try a").first().tap();
    await says(page, "#made", "A PLATE WITH A HOLE");
    await wholeTape(page);
    await page.waitForSelector("#manual-pane", { state: "hidden" });
    assert.ok(await page.isVisible("#drawing"));
    await page.tap("#machine");
    await page.waitForSelector("#inside [data-move=hold]");
    assert.equal(await page.isVisible("#drawing"), false);
    await page.tap("#views [data-view=program]");
    assert.ok(await page.isVisible("#program"));
    assert.equal(await page.isVisible("#machine-pane"), false);
    assert.deepEqual(said, []);
    await context.close();
  });

  test("the manual in the dark, an ERR's sentence whole, a link that is not whole, and the link in the address", async () => {
    const { page, context } = await visit({ colorScheme: "dark", viewport: { width: 1440, height: 900 } }, "#z=AAAA&run");
    await message(page, /link is not whole/);
    await wholeTape(page, 29); // (no empty machine)
    await page.click("#manual");
    const paper = page.frameLocator("#manual-frame").locator("body");
    await paper.locator("h1").waitFor();
    const seen = () =>
      paper.evaluate((body) => [getComputedStyle(body).color, getComputedStyle(document.documentElement).backgroundColor]);
    const light = ([, back = ""]: string[]) => Number(/\d+/.exec(back)?.[0]) > 128;
    const [dark] = [await seen()];
    assert.ok(!light(dark) && dark[0] === "rgb(255, 255, 255)", String(dark));
    await page.locator("details.menu summary").nth(2).click();
    await page.selectOption("#theme", "light");
    assert.ok(light(await seen()), "it takes the page's colours, not the system's");
    await page.selectOption("#theme", "auto");
    await page.keyboard.press("Escape");
    await page.click("#close-manual");
    await prompt(page);
    await page.click("#terminal");
    await page.keyboard.type("190 CUT X,(5,5):1\rRUN\r");
    await says(page, "#lines .fault", /no room for a fillet/);
    const [left, right] = await page.evaluate(() => {
      const [fault, lines] = [document.querySelector(".fault span"), document.getElementById("lines")];
      return [fault, lines].map((one) => one?.getBoundingClientRect().right ?? 0) as [number, number];
    });
    assert.ok(left > 0 && left <= right, `${left} ${right}`);
    // a link stays in the address while its program is seen, also one that was written in other letters than the machine's, and
    // goes with the first change
    const hash = `#z=${await pack("10 rem mine\n20 d=5.0\n30 cut o,(d,0)\n40 end\n")}&run`;
    await page.evaluate((hash) => (location.hash = hash), hash);
    await says(page, "#made", "mine");
    await wholeTape(page);
    await prompt(page);
    assert.equal(await page.evaluate(() => location.hash), hash);
    await page.click("#terminal");
    await page.keyboard.type("I=42\r");
    await page.waitForFunction(() => /I=42/.test(localStorage.getItem("skg:/some/folder/:machine") ?? ""));
    await page.reload();
    await page.waitForSelector("body[data-ready]");
    await wholeTape(page);
    await prompt(page);
    await page.click("#terminal");
    await page.keyboard.type("PRINT I\r");
    await onPaper(page, "\n42\n");
    assert.equal(await page.evaluate(() => location.hash), hash, "a reload leaves the machine and the address alone");
    await page.keyboard.type("5 REM MINE\r");
    await page.waitForFunction(() => location.hash === "");
    await context.close();
  });

  test("while the wire goes, block and line follow, and a screen reader is left in peace; few stops of the Tab key", async () => {
    const { page, context } = await visit({ viewport: { width: 1440, height: 700 } });
    await wholeTape(page);
    await prompt(page);
    await says(page, "#closing", /close/);
    await says(page, "#walked", /^block/);
    await page.evaluate(() => {
      const said: string[] = [];
      Object.assign(window, { said });
      for (const region of document.querySelectorAll("[role=status], [role=alert], [aria-live], output")) {
        // (the teletype says its own paper, and is still at it when the machine is at its prompt)
        if (region.getAttribute("aria-live") === "off" || region.closest(".xterm")) continue;
        new MutationObserver(() => said.push(`${region.id}: ${region.textContent}`)).observe(region, {
          childList: true,
          subtree: true,
          characterData: true,
        });
      }
    });
    await says(page, "#walked", /^block 1\d/);
    assert.deepEqual(await page.evaluate(() => (window as unknown as { said: string[] }).said), []);
    await page.click("#play");
    await drawn(page);
    const seen = await page.evaluate(() => {
      const block = Number(/\d+/.exec(document.getElementById("walked")?.textContent ?? "")?.[0]);
      const [row, line] = [document.getElementById(`block-${block}`), document.querySelector("#lines .chosen")];
      const isIn = (one: Element | null, box: Element | null): boolean => {
        const [a, b] = [one?.getBoundingClientRect(), box?.getBoundingClientRect()];
        return Boolean(a && b && a.top >= b.top - 1 && a.bottom <= b.bottom + 1);
      };
      return {
        chosen: row?.ariaSelected,
        row: isIn(row, document.getElementById("list")),
        line: isIn(line, document.querySelector("#lines .cm-scroller")),
        number: [/line (\d+)/.exec(row?.textContent ?? "")?.[1], /^\d+/.exec(line?.textContent ?? "")?.[0]],
      };
    });
    assert.deepEqual({ ...seen, number: [] }, { chosen: "true", row: true, line: true, number: [] });
    assert.equal(seen.number[0], seen.number[1]);
    // from the page's start to the program
    await page.evaluate(() => (document.activeElement as HTMLElement).blur());
    await page.reload();
    await page.waitForSelector("body[data-ready]");
    await wholeTape(page);
    let tabs = 0;
    for (; tabs < 20 && (await page.evaluate(() => document.activeElement?.id)) !== "text"; tabs++) {
      await page.keyboard.press("Tab");
    }
    assert.ok(tabs < 15, `${tabs} tabs`);
    await page.focus("[data-part=wrench]");
    await page.keyboard.press("ArrowDown");
    assert.equal(await page.evaluate(() => (document.activeElement as HTMLElement).dataset["part"]), "set-gear");
    await page.keyboard.press("Enter");
    await says(page, "#made", "Spur gear");
    await context.close();
  });

  test("320 pixels: nothing scrolls sideways; the drawing is first, and what to change stands at its number", async () => {
    for (const locale of ["en-US", "zh-CN"]) {
      const { page, context } = await visit({ viewport: { width: 320, height: 640 }, hasTouch: true, isMobile: true, locale });
      await page.waitForFunction(() => /29/.test(document.getElementById("sum")?.textContent ?? ""));
      const fits = () => page.evaluate(() => document.documentElement.scrollWidth <= 320 && innerWidth <= 320);
      const [drawing, canvas] = [await page.locator("#drawing").boundingBox(), await page.locator("#canvases").boundingBox()];
      assert.ok(drawing && canvas && canvas.y - drawing.y < 10 && canvas.height > 280, JSON.stringify(canvas));
      for (const menu of await page.locator("details.menu summary").all()) {
        await menu.tap();
        assert.ok(await fits(), `${locale} ${await menu.textContent()}`);
        const box = await page.locator("details.menu[open] > div").boundingBox();
        assert.ok(box && box.x >= 0 && box.x + box.width <= 320, JSON.stringify(box));
        await menu.tap();
      }
      for (const view of ["parts", "teletype", "blocks", "program"]) {
        await page.tap(`#views [data-view=${view}]`);
        assert.ok(await fits(), `${locale} ${view}`);
      }
      await says(page, ".tip", /8\.5/);
      const place = await page.evaluate(() => {
        const row = [...document.querySelectorAll(".cm-line")].find((line) => /^50 /.test(line.textContent ?? ""));
        return [row, document.querySelector(".tip")].map((one) => one?.getBoundingClientRect().top ?? 0);
      });
      assert.ok((place[1] as number) > (place[0] as number) && (place[1] as number) < (place[0] as number) + 30);
      await context.close();
    }
  });

  test("in Chinese: the manual, the parts, what their sliders set", async () => {
    const { page, context, said } = await visit({ locale: "zh-CN" });
    await says(page, "#made", "扳手");
    await page.click("#manual");
    await says(page, "#manual-alone", "在单独页面中打开");
    await page.frameLocator("#manual-frame").locator("h1", { hasText: "SKG 语言" }).waitFor();
    await page.frameLocator("#manual-frame").locator(".try a").first().click();
    await says(page, "#made", "A PLATE WITH A HOLE");
    await page.locator("details.menu summary").nth(2).click();
    await page.selectOption("#language", "en");
    await page.frameLocator("#manual-frame").locator("h1", { hasText: "The SKG language" }).waitFor();
    await page.selectOption("#language", "zh");
    await page.keyboard.press("Escape");
    await page.click("#close-manual");
    await page.click("[data-part=set-gear]");
    await says(page, "#parameters span", "模数，mm");
    assert.deepEqual(said, []);
    await context.close();
  });

  test("the debugger: loaded when it is wanted, stops by name, steps, shows floats and memory; the tape is the same", async () => {
    served.sent.clear();
    const { page, context, said } = await visit({ serviceWorkers: "block" });
    await wholeTape(page);
    await prompt(page);
    assert.ok(![...served.sent.keys()].some((name) => /debugger/.test(name)));
    await page.click("#machine");
    await page.waitForSelector("#inside [data-move=hold]");
    assert.ok(served.sent.has("debugger.js"));
    const place = (text: RegExp) => says(page, "#inside .place", text);
    await place(/passes · \w+(\+\d+)? · asm\/[\w/]+\.asm/);
    const stop = page.locator("#inside form").nth(1).locator("input");
    await stop.fill("NOWHERE");
    await stop.press("Enter");
    assert.match(await stop.evaluate((input) => (input as HTMLInputElement).validationMessage), /NOWHERE is no label/);
    await stop.fill("SCUT");
    await stop.press("Enter");
    await says(page, "#inside .stops", /0F6A SCUT|SCUT/);
    await page.click("#run");
    await place(/^held · SCUT · asm\/[\w/]+\.asm/);
    await says(page, "#state", "held by the debugger");
    await says(page, "#inside .code .present", /SCUT.*CALL FITEND/);
    // a stop by the keyboard, set and taken away
    const dot = page.locator("#inside .code button[data-address]").nth(1);
    await dot.focus();
    for (const pressed of ["true", "false"]) {
      await page.keyboard.press("Space");
      await page.waitForFunction((pressed) => document.activeElement?.getAttribute("aria-pressed") === pressed, pressed);
    }
    await page.click("[data-move=instruction]");
    await place(/^held · FITEND · /);
    await says(page, "#inside .calls", /^SCUT\+3 ←/);
    await page.click("[data-move=up]");
    await place(/^held · SCUT\+3 · /);
    await page.click("[data-move=operation]");
    await place(/^held · CALC1 · asm\/calc\.asm/);
    assert.ok(await page.locator("#inside .code >> nth=1").isVisible(), "byte-code by its names");
    await page.locator("#inside form").first().locator("input").fill("SCUT");
    await page.locator("#inside form").first().locator("input").press("Enter");
    const rom = readFileSync("roms/skg.bin");
    const at = parseInt(/^([0-9A-F]{4}) SCUT /m.exec(readFileSync("roms/skg.sym", "latin1"))?.[1] ?? "", 16);
    const bytes = [...rom.subarray(at, at + 8)].map((byte) => byte.toString(16).toUpperCase().padStart(2, "0")).join(" ");
    await says(page, "#inside pre", new RegExp(`^${at.toString(16).toUpperCase().padStart(4, "0")}  ${bytes}  `));
    await shot(page, "inside"); // (docs/pictures/page-inside.png)
    await page.evaluate(AXE);
    const found = await page.evaluate(async () => {
      const { axe } = window as unknown as {
        axe: { run(options: object): Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> };
      };
      const { violations } = await axe.run({ runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "best-practice"] });
      return violations.map(({ id, nodes }) => `${id}: ${nodes[0]?.html}`);
    });
    assert.deepEqual(found, []);
    // on from stop to stop, and then without: the tape is the one that it always was
    await page.click("[data-move=go]");
    await place(/^held · SCUT · /);
    await page.click("#machine-pane .close");
    await wholeTape(page, 29);
    await prompt(page);
    assert.equal(await saved(page, "3b"), readFileSync("examples/wrench.3b", "latin1"));
    // ctrl-C frees a machine that is held
    await page.click("#machine");
    await page.click("#run");
    await place(/^held · SCUT · /);
    await page.click("#run");
    await message(page, /ERR 10/);
    await prompt(page);
    assert.deepEqual(
      said.filter((text) => !/Service Worker/.test(text)),
      [],
    );
    await context.close();
  });
});
