/** The drawing on the screen, `skg ui`, in Debian's chromium. */
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { type Browser, type BrowserContextOptions, chromium, type Locator, type Page } from "playwright-core";
import { PATIENCE, WHOLE } from "./served.ts";
import { BRACKET, box, circle, cutByCommand, dxf, endAll, field, line, NO_SETUPS, SKG, start } from "./uistart.ts";

const CHROMIUM = "/usr/bin/chromium";
const SHOTS = process.env["SHOTS"] ?? "web/build/shots";
const AXE = readFileSync("web/node_modules/axe-core/axe.min.js", "utf8");
const WIDE = { width: 1400, height: 900 };
/** What a browser leaves of a screen of 1366 x 768. */
const LOW = { width: 1366, height: 640 };
const PHONE = { width: 360, height: 740 };
/** A drawing of so many circles. */
const MANY = 20_000;

let browser: Browser;

/** A page in a browser that was never here. */
async function visit(url: string, options: BrowserContextOptions = {}) {
  const context = await browser.newContext({ viewport: WIDE, acceptDownloads: true, locale: "en-GB", ...options });
  context.setDefaultTimeout(PATIENCE);
  const page = await context.newPage();
  const said: string[] = [];
  page.on("console", (message) => said.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => said.push(String(error)));
  await page.goto(url);
  await page.waitForSelector("body[data-ready]");
  return { context, page, said };
}

/** Until the drawing is there, planned and drawn. */
const drawn = (page: Page) =>
  page.waitForFunction(
    () => document.getElementById("name")?.textContent && document.getElementById("base")?.dataset["whole"] === "true",
  );
/** The same, once what was to come or go has done so. */
const settledView = async (page: Page): Promise<void> => {
  await page.evaluate(() => new Promise((tell) => requestAnimationFrame(() => requestAnimationFrame(tell))));
  await drawn(page);
};
const says = (page: Page, selector: string, text: string | RegExp) =>
  page.waitForFunction(
    ([selector, wanted]) => {
      const found = document.querySelector(selector)?.textContent ?? "";
      return typeof wanted === "string" ? found === wanted : wanted.test(found);
    },
    [selector, text] as const,
  );
const message = (page: Page, text: RegExp) => says(page, "#message:not([hidden]) span", text);
const value = (page: Page, id: string, wanted: string | RegExp) =>
  page.waitForFunction(
    ([id, wanted]) => {
      const found = (document.getElementById(id) as HTMLInputElement).value;
      return typeof wanted === "string" ? found === wanted : wanted.test(found);
    },
    [id, wanted] as const,
  );
/** A field takes what is typed, and its row is bold: it is wanted now. */
async function type(page: Page, id: string, text: string): Promise<void> {
  await page.fill(`#${id}`, text);
  await page.press(`#${id}`, "Enter");
  await page.waitForSelector(`.field.own #${id}`, { state: "attached" });
}
/** Until the plan is that of what is wanted. */
const settled = (page: Page) => page.waitForFunction(() => document.body.dataset["settled"] === "true");
/** Cuts; a line that wants care (the wire on the line, a tab that stands proud) leaves the dot amber. */
const cut = async (page: Page): Promise<void> => {
  await page.click("#cut");
  await page.waitForSelector("#which-wire[open], #cancel:not([hidden]), #outcome:is(.good, .care)");
  if (await page.isVisible("#wire-line")) await page.click("#wire-line");
  await page.waitForSelector("#outcome:is(.good, .care)");
};

/** The pixel of the window where a place of the drawing is, mm. */
const pixel = (page: Page, place: readonly [number, number]): Promise<[number, number]> =>
  page.evaluate(([x, y]) => {
    const canvas = document.getElementById("base") as HTMLCanvasElement;
    const [scale, left, top] = (canvas.dataset["window"] ?? "").split(" ").map(Number) as [number, number, number];
    const { left: boxLeft, top: boxTop } = canvas.getBoundingClientRect();
    return [boxLeft + left + x * 1000 * scale, boxTop + top - y * 1000 * scale] as [number, number];
  }, place);

const click = async (page: Page, place: readonly [number, number]): Promise<void> =>
  page.mouse.click(...(await pixel(page, place)));

async function drag(page: Page, from: readonly [number, number], to: readonly [number, number]): Promise<void> {
  await page.mouse.move(...(await pixel(page, from)));
  await page.mouse.down();
  await page.mouse.move(...(await pixel(page, to)), { steps: 6 });
  await page.mouse.up();
}

async function drop(page: Page, name: string, data: Buffer | string): Promise<void> {
  const bytes = Buffer.from(data).toString("base64");
  await page.evaluate(
    ([name, bytes]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([Uint8Array.from(atob(bytes), (each) => each.charCodeAt(0))], name));
      document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
    },
    [name, bytes] as const,
  );
}

/** Words of a text in Latin letters that are neither units, nor names of files, kinds of entities, ROMs or controls' words. */
const foreign = (text: string, names: readonly string[]): string[] =>
  (text.replace(/[\w.-]+\.(dxf|svg|3b|skg|toml|pdf)\b/g, "").match(/[A-Za-z][A-Za-z-]+/g) ?? []).filter(
    (word) => !names.includes(word) && !/^([A-Z]{2,}|[acmkµu]?m|min|KiB|mil|no-drift|standard|nodrift|GX?L?|NR)$/.test(word),
  );

/** Words on the page that are not Chinese, in what is seen and what is read out. */
const english = async (page: Page, names: readonly string[]): Promise<string[]> => {
  const texts = await page.evaluate(() =>
    [...document.querySelectorAll("body *")].flatMap((each) => {
      if (each.closest("[lang=en], script, #program, #list, #setup, #menu:empty")) return [];
      const own = [...each.childNodes].filter(({ nodeType }) => nodeType === 3).map(({ nodeValue }) => nodeValue);
      return [each.ariaLabel, each.getAttribute("title"), each.getAttribute("alt"), ...own].map((text) => text ?? "");
    }),
  );
  return [...new Set(texts.filter((text) => foreign(text, names).length))];
};

const row = (page: Page, text: string): Locator => page.locator("#tree [role=treeitem]", { hasText: text });

async function shot(page: Page, name: string): Promise<void> {
  mkdirSync(SHOTS, { recursive: true });
  await page.evaluate(() => new Promise((tell) => requestAnimationFrame(() => requestAnimationFrame(tell))));
  await page.screenshot({ path: `${SHOTS}/ui-${name}.png` });
}

const axe = async (page: Page): Promise<string[]> => {
  // (the page's policy lets no script in: it is brought by the driver)
  await page.evaluate(AXE);
  return page.evaluate(async () => {
    const { violations } = await (
      window as unknown as { axe: { run(): Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> } }
    ).axe.run();
    return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" ")}`);
  });
};

describe("skg ui in chromium", { skip: existsSync(CHROMIUM) ? false : "chromium is not installed", timeout: WHOLE }, () => {
  before(async () => {
    browser = await chromium.launch({
      executablePath: CHROMIUM,
      timeout: PATIENCE,
      args: ["--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking", "--disable-sync"],
    });
  });
  after(async () => {
    await browser?.close();
    endAll();
  });

  test("drop a drawing, wire, gap, Cut, Save: the tape is that of the command line, byte for byte", async () => {
    const { url, folder } = await start("bracket.dxf", BRACKET, false);
    const { page, said, context } = await visit(url);
    await page.waitForSelector("#empty:not([hidden])");
    await drop(page, "bracket.dxf", BRACKET);
    await drawn(page);
    await type(page, "field-wire", "0.18");
    await type(page, "field-gap", "0,01");
    await cut(page);
    await page.click("#save");
    for (const what of ["job", "sheet"]) await page.uncheck(`#save-as [value=${what}]`);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-yes")]);
    const tape = readFileSync(await download.path());
    assert.match(download.suggestedFilename(), /^bracket.*\.3b$/);
    assert.ok(tape.equals(cutByCommand(folder, "bracket.dxf", "--wire", "0.18", "--gap", "0.01")));
    assert.match((await page.textContent("#report")) ?? "", /checked with the controller/);
    assert.deepEqual(said, []);
    await context.close();
  });

  test("what was clicked is a job that makes the same tape; nothing is overwritten without a question", async () => {
    const { url, folder, file } = await start();
    const { page, context } = await visit(url);
    await drawn(page);
    await type(page, "field-wire", "0.18");
    await click(page, [55, 0]);
    await says(page, "#h-values", "outline 70 × 30");
    await type(page, "field-tab", "1.5");
    await row(page, "opening 12 × 6").locator(".check").click();
    await page.waitForSelector("[role=treeitem][aria-checked=false]");
    await cut(page);
    // (name and style are asked for once; tape, sheet and job are written together)
    await page.click("#save");
    await page.fill("#save-name", "a/b");
    await page.click("#save-yes");
    await says(page, "#save-hint", /without a folder/);
    await page.fill("#save-name", "bracket");
    await page.click("#save-yes");
    await message(page, /Saved beside the drawing/);
    const names = ((await page.textContent("#message span")) ?? "").replace(/.*: /, "").split(", ").sort();
    const [job, tape] = names as [string, string];
    assert.deepEqual(names, ["bracket.job.toml", "bracket.nodrift.3b", "bracket.pdf"]);
    assert.ok(file(tape).equals(cutByCommand(folder, job)));
    writeFileSync(join(folder, tape), "mine");
    await page.click("#save");
    await page.waitForSelector("#question[open]");
    await page.click("#question-no");
    assert.equal(file(tape).toString(), "mine");
    await page.click("#save");
    await page.waitForSelector("#question[open]");
    await page.click("#question-yes");
    // (the message of the first time may still be seen)
    while (["mine", ""].includes(file(tape).toString())) await page.waitForTimeout(20);
    await message(page, /Saved beside/);
    assert.ok(file(tape).equals(cutByCommand(folder, job)));
    await context.close();
  });

  test("start hole, entry and tab are dragged; undo and redo; the layer's values again", async () => {
    const { url } = await start();
    const { page, context } = await visit(url);
    await drawn(page);
    await type(page, "field-wire", "0.2");
    await settled(page);
    await click(page, [55, 0]);
    await says(page, "#h-values", "outline 70 × 30");
    await type(page, "field-tab", "2");
    await settled(page);
    const place = async (key: string): Promise<[number, number]> =>
      [Number(await page.inputValue(`#field-${key}-x`)), Number(await page.inputValue(`#field-${key}-y`))] as [number, number];
    await drag(page, await place("entry"), [20, 0]);
    await page.waitForSelector(".field.own #field-entry-x");
    await settled(page);
    const [x, y] = await place("entry");
    assert.ok(Math.abs(x - 20) < 1 && Math.abs(y) < 1e-6, `${x} ${y}`);
    await drag(page, await place("start"), [20, -6]);
    await page.waitForSelector(".field.own #field-start-x");
    await settled(page);
    const [hx, hy] = await place("start");
    assert.ok(Math.abs(hx - 20) < 1 && Math.abs(hy + 6) < 1, `${hx} ${hy}`);
    // the tab reaches from the entry back, against the way of the wire
    const before = Number(await page.inputValue("#field-tab"));
    const way = JSON.parse((await page.getAttribute("#over", "data-handles")) ?? "{}") as Record<string, [number, number]>;
    const tab = way["tab"] as [number, number];
    await drag(page, tab, [tab[0] + (tab[0] < x ? -3 : 3), tab[1]]);
    await page.waitForFunction(
      (before) => Number((document.getElementById("field-tab") as HTMLInputElement).value) > before + 1,
      before,
    );
    await settled(page);
    await shot(page, "dragged");
    await page.click("#undo");
    await value(page, "field-tab", String(before));
    await page.click("#redo");
    await page.waitForFunction(
      (before) => Number((document.getElementById("field-tab") as HTMLInputElement).value) > before + 1,
      before,
    );
    await page.click("#reset");
    await page.waitForFunction(() => !document.querySelector("#fields .own"));
    await value(page, "field-tab", "0");
    // a row that is dragged onto another one is cut in its place
    await row(page, "12 × 6").dragTo(row(page, "12 × 12"));
    await settled(page);
    await row(page, "12 × 6").click();
    await value(page, "field-order", "1");
    assert.equal(await row(page, "12 × 6").locator(".order").textContent(), "1");
    await context.close();
  });

  test("by the keyboard alone: choose, side, skip, hole, entry, tab, order, undo, cut, save", async () => {
    const { url, file } = await start();
    const { page, context } = await visit(url);
    await drawn(page);
    const press = async (...keys: string[]): Promise<void> => {
      for (const key of keys) await page.keyboard.press(key);
    };
    const tabTo = async (id: string): Promise<void> => {
      for (let count = 0; count < 60; count++) {
        if (await page.evaluate((id) => document.activeElement?.id === id, id)) return;
        await page.keyboard.press("Tab");
      }
      assert.fail(`no way to #${id} by the tab key`);
    };
    await tabTo("over");
    await press("ArrowRight");
    await says(page, "#h-values", "opening 12 × 12");
    await press("ArrowRight");
    await says(page, "#h-values", "opening 18 × 8");
    await press("x");
    await page.waitForFunction(() => !(document.getElementById("field-cut") as HTMLInputElement).checked);
    await press("Control+z");
    await page.waitForFunction(() => (document.getElementById("field-cut") as HTMLInputElement).checked);
    await press("s");
    await value(page, "field-side", "inside");
    await press("]");
    await value(page, "field-order", "3");
    await settled(page);
    await press("h", "ArrowRight", "ArrowRight", "Shift+ArrowRight", "Enter");
    await page.waitForSelector(".field.own #field-start-x");
    await press("e", "ArrowRight", "Escape");
    await page.waitForSelector(".field.own #field-entry-x");
    await settled(page);
    await press("Escape");
    await says(page, "#h-values", "All contours");
    await tabTo("field-wire");
    // (F5 takes what is still being typed, and cuts nothing with a value that it cannot read)
    await page.keyboard.type("0.1q");
    await press("F5");
    await message(page, /“0.1q” is no number/);
    await page.waitForSelector("#field-wire:focus[aria-invalid=true]");
    await press("Control+a");
    await page.keyboard.type("０．１８");
    await press("F5");
    await page.waitForSelector(".field.own #field-wire");
    await page.waitForSelector("#outcome.good");
    await press("Control+s");
    await page.waitForSelector("#save-as[open]");
    await press("Enter");
    await message(page, /Saved beside the drawing/);
    assert.ok(file("bracket.job.toml").includes("entry"));
    // the tree, too
    await page.focus("#tree");
    await press("Home", "ArrowDown", "ArrowDown", " ");
    await page.waitForSelector("#tree [aria-checked=false]");
    await press("Shift+F10");
    await page.waitForSelector("#menu:not([hidden]) [role=menuitem]:focus");
    await press("ArrowDown", "Escape");
    await page.waitForSelector("#menu", { state: "hidden" });
    await context.close();
  });

  test("on a phone: a finger chooses, holds for the menu, drags a handle, and everything is 44 pixels large", async () => {
    const { url } = await start();
    const { page, context } = await visit(url, { viewport: PHONE, hasTouch: true, isMobile: true });
    await drawn(page);
    const session = await context.newCDPSession(page);
    const touch = (type: "touchStart" | "touchMove" | "touchEnd", place?: [number, number]) =>
      session.send("Input.dispatchTouchEvent", { type, touchPoints: place ? [{ x: place[0], y: place[1] }] : [] });
    await page.touchscreen.tap(...(await pixel(page, [55, 0])));
    await says(page, "#h-values", "outline 70 × 30");
    await page.waitForSelector("#over[data-handles*=start]");
    const handles = JSON.parse((await page.getAttribute("#over", "data-handles")) ?? "{}") as Record<string, [number, number]>;
    await touch("touchStart", await pixel(page, handles["start"] as [number, number]));
    await touch("touchMove", await pixel(page, [30, -5]));
    await touch("touchMove", await pixel(page, [20, -5]));
    await touch("touchEnd");
    await page.waitForSelector(".field.own #field-start-x", { state: "attached" });
    assert.ok(Math.abs(Number(await page.inputValue("#field-start-x")) - 20) < 1.5);
    await touch("touchStart", await pixel(page, [6, 15]));
    await page.waitForSelector("#menu:not([hidden])");
    await touch("touchEnd");
    await page.getByRole("menuitem", { name: "Do not cut" }).tap();
    await page.waitForFunction(() => !(document.getElementById("field-cut") as HTMLInputElement).checked);
    await shot(page, "phone");
    const small: string[] = [];
    for (const view of ["drawing", "contours", "values", "results"]) {
      await page.tap(`#views [data-view=${view}]`);
      await page.waitForSelector(`#${view}`);
      small.push(
        ...(await page.evaluate(() =>
          [...document.querySelectorAll<HTMLElement>("button, summary, select, [role=treeitem]")]
            .filter((each) => each.checkVisibility({ visibilityProperty: true }) && each.getBoundingClientRect().height < 43.5)
            .map((each) => `${each.id || each.textContent} ${each.getBoundingClientRect().height}`),
        )),
      );
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0, view);
      await shot(page, `phone-${view}`);
    }
    assert.deepEqual(small, []);
    await context.close();
  });

  test("axe finds nothing, empty, open, chosen, cut, wrong, in both languages, light and dark", async () => {
    const { url } = await start("bracket.dxf", BRACKET, false);
    for (const [locale, colorScheme] of [
      ["en-GB", "light"],
      ["zh-CN", "dark"],
    ] as const) {
      const { page, context } = await visit(url, { locale, colorScheme });
      if (locale === "en-GB") {
        await page.waitForSelector("#empty:not([hidden])");
        assert.deepEqual(await axe(page), []);
        await drop(page, "bracket.dxf", BRACKET);
        await drawn(page);
        await type(page, "field-wire", "0.18");
      }
      await drawn(page);
      await click(page, [55, 0]);
      await page.waitForSelector("#tree [aria-selected=true]");
      await page.click("#cut");
      await page.waitForSelector("#outcome.good");
      assert.deepEqual(await axe(page), []);
      for (const tab of ["blocks", "program", "sheet"]) {
        await page.click(`#tab-${tab}`);
        await page.waitForSelector(`#${tab}:not([hidden])`);
        if (tab === "sheet") await page.waitForSelector("#sheet img");
        assert.deepEqual(await axe(page), [], tab);
      }
      await page.click("#tab-sheet");
      await page.waitForSelector("#drawer", { state: "hidden" });
      await page.click("#settings summary");
      await page.click("#help");
      assert.deepEqual(await axe(page), []);
      await page.click("#close-keys");
      await page.click("#settings summary");
      assert.deepEqual(await axe(page), []);
      await page.click("#settings summary");
      await row(page, "18 × 8").click();
      await type(page, "field-offset", "4.9");
      await page.click("#cut");
      await page.waitForSelector("#decide.wrong");
      await page.click("#tab-report");
      await page.waitForSelector("#report .wrong");
      assert.deepEqual(await axe(page), []);
      await shot(page, `wrong-${colorScheme}`);
      await page.click("#reset");
      await page.waitForFunction(() => !document.querySelector("#report .wrong"));
      await context.close();
    }
  });

  test("中文: every word of the page, kept for the next visit", async () => {
    const { url } = await start();
    const { page, context } = await visit(url);
    await drawn(page);
    await page.click("#settings summary");
    await page.selectOption("#language", "zh");
    await says(page, "#cut", "生成 3B");
    await says(page, "#h-values", "全部轮廓");
    await page.click("#settings summary");
    await click(page, [55, 0]);
    await says(page, "#h-values", /^外轮廓/);
    await type(page, "field-wire", "0.18");
    await cut(page);
    assert.match((await page.textContent("#outcome")) ?? "", /已校验/);
    await page.click("#tab-report");
    assert.deepEqual(await english(page, ["PART", "NOTES"]), []);
    await page.click("#tab-sheet");
    await page.waitForSelector("#sheet img");
    await page.click("#save");
    await page.waitForSelector("#save-as[open]");
    assert.deepEqual(await english(page, ["PART", "NOTES"]), []);
    await page.keyboard.press("Escape");
    const sheet = await page.evaluate(async () => {
      const headers = { Authorization: `Bearer ${sessionStorage.getItem("token")}` };
      const text = await (await fetch("api/run/1/sheet.svg?language=zh", { headers })).text();
      const texts = new DOMParser().parseFromString(text, "image/svg+xml").querySelectorAll("text");
      return [...texts].map(({ textContent }) => textContent ?? "");
    });
    assert.ok(sheet.length > 40);
    assert.deepEqual(
      sheet.flatMap((text) => foreign(text, [])),
      [],
    );
    await shot(page, "chinese");
    await page.reload();
    await says(page, "#cut", "生成 3B");
    // what is wrong, what is left and why, what can be done
    const open = [...box(0, 0, 60, 40).slice(0, 3), line(0, 40, 0, 0.8), circle(15, 20, 5), line(70, 0, 70, 9, "AXIS")];
    await drop(page, "open.dxf", dxf(...open, circle(25.3, 20, 5)));
    await says(page, "#name", "open.dxf");
    await type(page, "field-wire", "0.2");
    await page.waitForSelector("#decide.wrong");
    await page.click("#tab-report");
    assert.deepEqual(await english(page, ["PART", "AXIS"]), []);
    await page.locator("#decide-fixes button", { hasText: "连接" }).first().click();
    await settled(page);
    assert.deepEqual(await english(page, ["PART", "AXIS"]), []);
    await context.close();
  });

  test("the key is not in the address bar, names are shown and not obeyed", async () => {
    const { url } = await start("part\u202e.dxf", dxf(...box(0, 0, 60, 40), circle(15, 20, 5, "A\u200b\u202eB")));
    const { page, context } = await visit(url);
    await drawn(page);
    assert.equal(page.url(), new URL("/", url).href);
    assert.equal(await page.textContent("#name"), "part\\u202e.dxf");
    assert.ok(((await page.textContent("#tree")) ?? "").includes("A\\u200b\\u202eB"));
    const seen = await page.evaluate(() => document.body.innerText);
    assert.doesNotMatch(seen, /[\u200b\u202e]/);
    await context.close();
  });

  test("a reload loses nothing: job, plan, tape, walk", async () => {
    const { url } = await start();
    const { page, context } = await visit(url);
    await drawn(page);
    await type(page, "field-wire", "0.18");
    await click(page, [55, 0]);
    await says(page, "#h-values", "outline 70 × 30");
    await type(page, "field-tab", "1.5");
    await cut(page);
    await page.waitForSelector("#walk:not([hidden])");
    const outcome = await page.textContent("#outcome");
    await page.reload();
    await says(page, "#outcome", outcome ?? "");
    await value(page, "field-wire", "0.18");
    await page.waitForSelector("#walk:not([hidden])");
    await drawn(page);
    await click(page, [55, 0]);
    await value(page, "field-tab", "1.5");
    // the walk goes over the drawing, and shows its block in the list
    await page.click("#tab-blocks");
    await page.focus("#scrub");
    await page.keyboard.press("End");
    await says(page, "#walked", /block (\d+) of \1 /);
    await page.waitForSelector("#list [aria-selected=true]");
    await shot(page, "walk");
    await context.close();
  });

  test("two tabs: the slower one is told, and shows what the other has made of it", async () => {
    const { url } = await start();
    const one = await visit(url);
    await drawn(one.page);
    // (this tab hears nothing of the other one)
    await one.page.route(/api\/state\?/, () => undefined);
    await one.page.reload();
    await drawn(one.page);
    const two = await visit(url);
    await drawn(two.page);
    await type(two.page, "field-wire", "0.25");
    await settled(two.page);
    await one.page.fill("#field-feed", "7");
    await one.page.press("#field-feed", "Enter");
    await message(one.page, /another tab/);
    await value(one.page, "field-wire", "0.25");
    await value(one.page, "field-feed", "5");
    // and one that hears of it shows it by itself
    await type(one.page, "field-gap", "0.02");
    await value(two.page, "field-gap", "0.02");
    await one.context.close();
    await two.context.close();
  });

  test("the drawing is saved again: read anew, moved contours are to be confirmed, lost ones are red", async () => {
    const part = (x: number, hole: number): string => dxf(...box(0, 0, 60, 40), circle(x, 20, hole), circle(45, 20, 4));
    const { url, folder } = await start("part.dxf", part(15, 5));
    const { page, context } = await visit(url);
    await drawn(page);
    await click(page, [15, 15]);
    await says(page, "#h-values", "opening 10 × 10");
    await type(page, "field-offset", "0.3");
    await click(page, [45, 16]);
    await says(page, "#h-values", "opening 8 × 8");
    await type(page, "field-offset", "0.4");
    await settled(page);
    writeFileSync(join(folder, "part.dxf"), part(16, 5));
    await says(page, "#again", "saved again: read anew");
    await page.waitForSelector("#matches .doubt");
    await page.click("#matches .doubt button");
    await page.waitForSelector("#matches .doubt", { state: "detached" });
    await click(page, [16, 15]);
    await value(page, "field-offset", "0.3");
    await settled(page);
    // one that cannot be read: what was read before stays, and nothing says that it is the new one
    writeFileSync(join(folder, "part.dxf"), "no drawing");
    await says(page, "#again", /cannot be read/);
    await page.waitForSelector("#decide.wrong");
    assert.equal(await page.locator("#tree [data-id]").count(), 3);
    assert.equal(await page.locator("#matches li").count(), 0);
    writeFileSync(join(folder, "part.dxf"), part(16, 9));
    await page.waitForSelector("#matches .lost");
    await shot(page, "lost");
    assert.deepEqual(await axe(page), []);
    await page.click("#matches .lost button");
    await page.waitForSelector("#matches .lost", { state: "detached" });
    await context.close();
  });

  test("a cut is cancelled, and begun again; a server that has ended is said to have", async () => {
    const { url, process } = await start("circles.dxf", field(3000));
    const { page, context } = await visit(url);
    await drawn(page);
    await page.click("#cut");
    await page.click("#wire-line");
    await page.click("#cancel");
    await says(page, "#outcome", /cancelled/);
    await cut(page);
    process.kill("SIGKILL");
    await message(page, /has ended/);
    assert.ok(await page.isDisabled("#cut"));
    await context.close();
  });

  test("what is refused is said: no drawing, a wrong number, a contour without room, with a place to look at", async () => {
    const { url } = await start("part.dxf", dxf(...box(0, 0, 60, 40), circle(15, 20, 5), circle(45, 20, 0.2)));
    const { page, context } = await visit(url);
    await drawn(page);
    await page.fill("#field-wire", "thick");
    await page.press("#field-wire", "Enter");
    await message(page, /enter a number/);
    await page.click("#dismiss");
    await type(page, "field-wire", "0.5");
    await page.click("#cut");
    await page.waitForSelector("#decide.wrong");
    await page.click("#tab-report");
    await page.locator("#report .wrong button").first().click();
    await says(page, "#h-values", "opening 0.4 × 0.4");
    await shot(page, "error");
    await drop(page, "no.dxf", "this is no drawing");
    await page.waitForFunction(() =>
      /no\.dxf/.test(`${document.querySelector("#message span")?.textContent} ${document.getElementById("report")?.textContent}`),
    );
    // (an address without its key shows nothing of it)
    const stranger = await visit(url.replace(/#.*/, ""));
    await message(stranger.page, /no key/);
    assert.equal(await stranger.page.textContent("#name"), "");
    await stranger.context.close();
    // and is forgotten with the next drawing
    await drop(page, "bracket.dxf", BRACKET);
    await says(page, "#name", "bracket.dxf");
    await page.waitForFunction(() => !document.querySelector("#report .wrong"));
    await context.close();
  });

  test("what wants a decision stands above the drawing, with what can be done about it; then the dot is green", async () => {
    const { url } = await start("part.dxf", dxf(...box(0, 0, 60, 40), circle(15, 20, 5), circle(45, 20, 0.04)));
    const { page, context } = await visit(url, { viewport: LOW });
    await drawn(page);
    const press = (name: string) => page.locator("#decide-fixes").getByRole("button", { name }).click();
    await page.waitForSelector("#decide", { state: "hidden" });
    // (no wire: asked for once)
    await page.click("#cut");
    await page.fill("#field-ask-wire", "0,2");
    await page.click("#wire-cut");
    await page.waitForSelector("#decide.wrong:not([hidden])");
    await value(page, "field-wire", "0.2");
    const { y, height } = (await page.locator("#decide").boundingBox()) ?? { y: 0, height: LOW.height };
    assert.ok(y + height < LOW.height / 4, "above the drawing");
    await shot(page, "decide");
    assert.deepEqual(await axe(page), []);
    await press("Show");
    await says(page, "#h-values", "opening 0.08 × 0.08");
    await press("Leave this contour");
    await page.waitForSelector("#decide", { state: "hidden" });
    await settledView(page);
    await click(page, [55, 0]);
    await says(page, "#h-values", "outline 60 × 40");
    await type(page, "field-passes", "0.05, 0.02");
    await page.click("#cut");
    await page.waitForSelector("#outcome.care");
    await says(page, "#decide-count", /^1 of \d$/);
    for (let left = 9; left && (await page.isVisible("#decide")); left--) await press("As it is");
    await page.waitForSelector("#outcome.good");
    await page.click("#cut");
    await page.waitForSelector("#outcome.good");
    await context.close();
  });

  test("the drawing has the room: what is left is drawn, alike contours are a row, a box chooses, the drawer keeps its height", async () => {
    const holes = [10, 25, 40, 55].map((x) => circle(x, 8, 2));
    const text = ["TEXT", { 8: "NOTES", 10: 20, 20: 25, 40: 5, 1: "PART 12" }] as const;
    const { url } = await start("part.dxf", dxf(...box(0, 0, 60, 40), ...holes, circle(15, 30, 5), text));
    const { page, context } = await visit(url, { viewport: LOW });
    await drawn(page);
    const { width, height } = (await page.locator("#over").boundingBox()) ?? { width: 0, height: 0 };
    assert.ok(width * height > 0.46 * LOW.width * LOW.height, `${width} × ${height}`);
    /** Something is drawn in a box of the drawing, mm. */
    const isInked = async (left: number, low: number, right: number, high: number): Promise<boolean> => {
      const [x0, y0] = await pixel(page, [left, high]);
      const [x1, y1] = await pixel(page, [right, low]);
      return page.evaluate(
        ([x0, y0, x1, y1]) => {
          const canvas = document.getElementById("base") as HTMLCanvasElement;
          const { left, top } = canvas.getBoundingClientRect();
          const data = canvas.getContext("2d")?.getImageData(x0 - left, y0 - top, x1 - x0, y1 - y0).data ?? [];
          return data.some((value, at) => at % 4 === 3 && value > 0);
        },
        [x0, y0, x1, y1] as const,
      );
    };
    assert.ok(await isInked(21, 25, 40, 30), "the text is seen");
    assert.ok(!(await isInked(45, 15, 58, 24)), "and nothing where nothing is");
    // alike ones: a row of four, opened and folded; all of them by a click
    await says(page, "#tree .alike .times", "× 4");
    assert.equal(await page.locator("#tree .within").count(), 0);
    await page.click("#tree .alike .fold");
    await page.waitForFunction(() => document.querySelectorAll("#tree .within").length === 4);
    await click(page, [25, 6]);
    await says(page, "#h-values", "opening 4 × 4");
    await page.click("#alike");
    await says(page, "#h-values", "4 contours");
    await page.locator("#tree .alike .check").click();
    await page.waitForSelector("#tree .alike[aria-checked=false]");
    // a box from left to right has what lies in it, from right to left also what it touches
    await page.keyboard.down("Shift");
    await drag(page, [5, 4], [45, 14]);
    await page.keyboard.up("Shift");
    await says(page, "#h-values", "3 contours");
    await page.click("#box");
    await drag(page, [56, 12], [38, 7]);
    await says(page, "#h-values", "2 contours");
    await page.click("#box");
    // the drawer
    await page.click("#tab-report");
    const tall = async (): Promise<number> => (await page.locator("#drawer").boundingBox())?.height ?? 0;
    const before = await tall();
    for (const tab of ["blocks", "program"]) {
      await page.click(`#tab-${tab}`);
      assert.equal(await tall(), before);
    }
    // (the sheet is seen as a whole)
    await page.click("#tab-sheet");
    assert.ok((await tall()) > before);
    assert.equal((await page.locator("#over").boundingBox())?.height, height);
    await page.keyboard.press("Escape");
    await page.waitForSelector("#drawer", { state: "hidden" });
    await context.close();
  });

  test("a job beside the drawing is offered; the rest of a tape from a block on, and where the wire must stand", async () => {
    const { url, file } = await start();
    const { page, context } = await visit(url);
    await drawn(page);
    await type(page, "field-wire", "0.18");
    await cut(page);
    await page.click("#save");
    await page.check("#save-eight");
    await value(page, "save-name", "BRACKET");
    await page.selectOption("#save-style", "numbered");
    await page.click("#save-yes");
    await message(page, /Saved beside the drawing/);
    assert.match(file("BRACKET.3b").toString(), /^N {3}1: B/);
    await page.click("#tab-blocks");
    await page.locator("#list [role=option]").nth(4).click();
    await says(page, "#go-on-save", /block 5$/);
    await shot(page, "go-on");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#go-on-save")]);
    assert.equal(download.suggestedFilename(), "bracket.from5.nodrift.3b");
    const [, ...rest] = readFileSync(await download.path())
      .toString()
      .split(/N +\d+: /);
    assert.deepEqual(
      rest,
      file("BRACKET.3b")
        .toString()
        .split(/N +\d+: /)
        .slice(-rest.length),
    );
    // (the wire must stand where the blocks before have brought it)
    const sums = file("BRACKET.3b")
      .toString()
      .split(/\r\n/)
      .slice(0, 4)
      .map((line) => /B +(\d+) B +(\d+) B +\d+ G([XY]) (L)([1-4])/.exec(line));
    if (sums.every(Boolean)) {
      const way = sums.map((found) => {
        const [, u, v, , , quadrant] = found as RegExpExecArray;
        const [right, up] = [quadrant === "1" || quadrant === "4", quadrant === "1" || quadrant === "2"];
        return [(right ? 1 : -1) * Number(u), (up ? 1 : -1) * Number(v)];
      });
      const [dx, dy] = [0, 1].map((axis) => way.reduce((sum, each) => sum + (each[axis] as number), 0) / 1000);
      await says(page, "#go-on-way", new RegExp(`${dx?.toFixed(3)} mm in x, ${dy?.toFixed(3)} mm`));
    }
    await context.close();
    const again = await start("bracket.dxf", BRACKET, true, { "bracket.job.toml": file("bracket.job.toml") });
    const other = await visit(again.url);
    await drawn(other.page);
    await says(other.page, "#decide-text", /bracket\.job\.toml/);
    await other.page.locator("#decide-fixes button").first().click();
    await value(other.page, "field-wire", "0.18");
    await other.page.waitForSelector("#decide", { state: "hidden" });
    await other.context.close();
  });

  test("a setup is kept, chosen by a click, the next drawing's by itself, and the command line's by its name", async (t) => {
    const config = mkdtempSync(join(tmpdir(), "skg-config-"));
    process.env["XDG_CONFIG_HOME"] = config;
    t.after(() => {
      process.env["XDG_CONFIG_HOME"] = NO_SETUPS;
      rmSync(config, { recursive: true });
    });
    const { url, file, folder } = await start("bracket.dxf", BRACKET);
    const { page, context } = await visit(url);
    await drawn(page);
    for (const [id, text] of [
      ["wire", "0.18"],
      ["gap", "0.01"],
      ["feed", "8"],
      ["passes", "0.06, 0"],
      ["tab", "2"],
    ])
      await type(page, `field-${id}`, text as string);
    await cut(page);
    await page.click("#save");
    await page.selectOption("#save-style", "numbered");
    await page.click("#save-yes");
    await message(page, /Saved beside the drawing/);
    await page.click("#setups-open");
    await page.fill("#setups-name", "../x");
    await page.click("#setups-keep");
    await says(page, "#setups-hint", /cannot name a setup/);
    await page.fill("#setups-name", "细丝 0.18");
    await page.press("#setups-name", "Enter");
    await message(page, /is kept/);
    await value(page, "setup", "细丝 0.18");
    // (what is kept is what was cut)
    await page.waitForSelector("#outcome:is(.good, .care)");
    await type(page, "field-wire", "0.25");
    await value(page, "setup", "");
    await page.selectOption("#setup", "细丝 0.18");
    await value(page, "field-wire", "0.18");
    assert.deepEqual(await axe(page), []);
    await shot(page, "setup");
    const command = cutByCommand(folder, "bracket.dxf", "--setup", "细丝 0.18", "--tab", "2");
    assert.deepEqual(command, file("bracket.nodrift.3b"));
    assert.match(command.toString(), /^N {3}1: B/);
    await context.close();
    const other = await start("circle.dxf", dxf(circle(0, 0, 9)));
    const next = await visit(other.url);
    await drawn(next.page);
    await value(next.page, "setup", "细丝 0.18");
    await value(next.page, "field-feed", "8");
    await next.page.click("#setups-open");
    await next.page.click("#setups-list button");
    await next.page.click("#question-yes");
    await next.page.waitForFunction(() => !document.querySelector("#setups-list li"));
    await next.page.click("#setups-close");
    await value(next.page, "setup", "");
    await next.context.close();
    writeFileSync(join(config, "skg", "setups", "bad.toml"), "[machine");
    writeFileSync(join(config, "skg", "setups", "last"), "bad");
    const damaged = await visit((await start("circle.dxf", dxf(circle(0, 0, 9)))).url);
    await message(damaged.page, /bad\.toml: .*TOML/);
    await drawn(damaged.page);
    await value(damaged.page, "setup", "");
    await damaged.context.close();
  });

  test("thickness, rates and prices: area, time and price stand beside the tape's figures, and on the sheet", async () => {
    const { url, file } = await start("square.dxf", dxf(...box(0, 0, 30, 20)));
    const { page, context } = await visit(url, { viewport: LOW });
    await drawn(page);
    await page.fill("#field-thickness", "20 mm");
    await page.press("#field-thickness", "Enter");
    await message(page, /Thickness: enter a number/);
    await type(page, "field-thickness", "10");
    await page.click("#more summary");
    for (const [id, text] of [
      ["rates", "40"],
      ["per_area", "0.015"],
      ["per_hole", "2.5"],
      ["currency", "元"],
    ])
      await type(page, `field-${id}`, text as string);
    await cut(page);
    // (100 mm around and 3 mm of lead, forth and back, 10 mm thick)
    await says(page, "#outcome", /106\.0 mm · 26 min 30 s · 1060 mm² · 18\.40 元$/);
    await page.click("#tab-report");
    await says(page, "#report", /price 18\.40 元: 15\.90 for 1060 mm², 2\.50 for 1 start hole/);
    await page.click("#tab-sheet");
    await page.waitForSelector("#sheet img");
    const sheet = await page.evaluate(async () => {
      const headers = { Authorization: `Bearer ${sessionStorage.getItem("token")}` };
      return (await fetch("api/run/1/sheet.svg", { headers })).text();
    });
    assert.match(sheet, /18\.40 元/);
    await page.click("#save");
    await page.check("[name=what][value=holes]");
    await page.check("[name=what][value=drill]");
    await page.click("#save-yes");
    await message(page, /square-holes\.csv, square-holes\.nc/);
    assert.match(file("square-holes.csv").toString(), /^1,15\.000,-3\.000,1,outline\r$/m);
    assert.match(file("square-holes.nc").toString(), /G81X15Y-3Z-12R2F100/);
    assert.deepEqual(await axe(page), []);
    await shot(page, "price");
    await context.close();
  });

  test("an open end is bridged by a click, kept in the job, undone; distance, radius and angle are measured", async () => {
    const open = dxf(...box(0, 0, 60, 40).slice(0, 3), line(0, 40, 0, 0.8), circle(15, 20, 5));
    const { url, file } = await start("open.dxf", open);
    const { page, context } = await visit(url, { viewport: LOW });
    await drawn(page);
    await type(page, "field-wire", "0.2");
    await page.waitForSelector("#decide.wrong");
    // (the drawing stays, with what is wrong ringed)
    assert.equal(await page.locator("#tree [role=treeitem]").count(), 3);
    await shot(page, "open-end");
    await page.getByRole("button", { name: "Bridge 0.8 mm" }).click();
    await page.waitForSelector("#decide", { state: "hidden" });
    await says(page, "#repair-count", "1");
    await page.waitForFunction(() =>
      [...document.querySelectorAll("#tree .title")].some(({ textContent }) => textContent === "outline 60 × 40"),
    );
    await page.click("#undo");
    await page.waitForSelector("#decide.wrong");
    await page.click("#redo");
    await cut(page);
    await page.click("#save");
    await page.click("#save-yes");
    await message(page, /Saved beside/);
    assert.match(file("open.job.toml").toString(), /bridges = \[\[0.0, 0.0, 0.0, 0.8\]\]/);
    // measuring: ends and centres are snapped to
    await settledView(page);
    await page.click("#measure");
    await click(page, [60, 40]);
    await click(page, [0, 0]);
    await says(page, "#measured", /^72\.111 mm +dx 60\.000 +dy 40\.000$/);
    await click(page, [15 + 5 * Math.cos(0.7), 20 + 5 * Math.sin(0.7)]);
    await says(page, "#measured", /^R 5\.000 +⌀ 10\.000 mm +centre 15\.000, 20\.000$/);
    await page.keyboard.press("Escape");
    await page.waitForSelector("#measure[aria-pressed=false]");
    await page.click("#measure");
    await click(page, [22, 0]);
    await click(page, [60, 11]);
    await says(page, "#measured", /angle 90\.000°$/);
    assert.deepEqual(await axe(page), []);
    await context.close();
  });

  test("ends go to their crossing, a stray line is left, by a click each or all; taken back, undone, kept in the job", async () => {
    // two corners run past, one is short of; a stray line beside the outline
    const lines = [line(-2, 0, 59, 0), line(60, 1, 60, 42), line(61, 40, 0, 40), line(0, 42, 0, -1), line(70, 5, 75, 9)];
    const { url, file } = await start("crossed.dxf", dxf(...lines));
    const { page, context } = await visit(url, { viewport: LOW });
    await drawn(page);
    await type(page, "field-wire", "0.2");
    await page.waitForSelector("#decide.wrong");
    await page.getByRole("button", { name: "All 4 to their crossings" }).click();
    await says(page, "#repair-count", "4");
    // what is left to decide is the stray line
    await page.getByRole("button", { name: "Leave this line" }).click();
    await page.waitForSelector("#decide", { state: "hidden" });
    await says(page, "#repair-count", "5");
    await page.waitForFunction(() => document.querySelector("#tree")?.textContent?.includes("outline 60 × 40"));
    await shot(page, "repaired");
    await settled(page);
    await page.click("#no-repairs");
    await settled(page);
    await page.waitForSelector("#decide.wrong");

    await page.getByRole("button", { name: "To their crossing, 1 mm" }).click();
    await says(page, "#repair-count", "1");
    await settled(page);
    await page.click("#undo");
    await page.waitForSelector("#repairs", { state: "hidden" });
    await page.click("#undo");
    await says(page, "#repair-count", "5");
    await cut(page);
    const codes = await page.evaluate(() => document.getElementById("report")?.textContent ?? "");
    assert.equal(codes.match(/brought to their crossing/g)?.length, 4);
    await page.click("#save");
    await page.click("#save-yes");
    await message(page, /Saved beside/);
    const job = file("crossed.job.toml").toString();
    assert.equal(job.match(/corners = (.*)/)?.[1]?.match(/\[[^[]+?\]/g)?.length, 4);
    assert.match(job, /strays = \[\[72\.5, 7\.0\]\]/);
    await context.close();
  });

  test("the part is turned, mirrored, given a zero and copied: the tape is the command line's, drawing and job stay the drawing's", async () => {
    const started = await start();
    const { context, page, said } = await visit(started.url, { viewport: LOW });
    await drawn(page);
    await type(page, "field-wire", "0.18");
    await page.click("#part summary");
    await page.selectOption("#field-mirror", "x");
    await type(page, "field-turn", "90");
    await page.selectOption("#field-origin", "lower-left");
    await type(page, "field-columns", "2");
    // (a step with room, as the part lies: 30 wide, 70 high)
    await value(page, "field-step-x", "35");
    await type(page, "field-step-x", "40");
    await settled(page);
    await settledView(page);
    // the copy and the zero are on the drawing, whose places are what they were
    // (on the machine x runs where the drawing's y does, downwards: the copy is 40 below)
    const places = [
      [35, 30],
      [35, -40],
      [35, -25],
    ] as const;
    const isDrawn = await page.evaluate(
      (pixels) => {
        const canvas = document.getElementById("base") as HTMLCanvasElement;
        const { left, top } = canvas.getBoundingClientRect();
        const of = canvas.width / canvas.clientWidth;
        // (all at once: a canvas that is read often is said to be slow)
        const image = canvas.getContext("2d")?.getImageData(0, 0, canvas.width, canvas.height) as ImageData;
        const near = [-2, -1, 0, 1, 2];
        return pixels.map(([x, y]) => {
          const [column, row] = [Math.round((x - left) * of), Math.round((y - top) * of)];
          return near.some((by) =>
            near.some((aside) => (image.data[4 * ((row + by) * image.width + column + aside) + 3] ?? 0) > 0),
          );
        });
      },
      await Promise.all(places.map((place) => pixel(page, place))),
    );
    assert.deepEqual(isDrawn, [true, true, false]);
    await click(page, [18, 15]);
    await settled(page);
    await settledView(page);
    const handles = JSON.parse((await page.getAttribute("#over", "data-handles")) ?? "");
    assert.ok(Math.hypot(handles.start[0] - 12, handles.start[1] - 15) < 0.01);
    await cut(page);
    await page.click("#tab-report");
    await says(page, "#report", /2 copies/);
    await page.screenshot({ path: join(SHOTS, "ui-part.png") });
    await page.click("#save");
    await page.click("#save-yes");
    await message(page, /beside the drawing/);
    await page.click("#shut");
    const words = "--wire 0.18 --mirror x --turn 90 --origin lower-left --columns 2 --step 40,75".split(" ");
    assert.deepEqual(started.file("bracket.nodrift.3b"), cutByCommand(started.folder, "bracket.dxf", ...words));
    // a step of a moment's thought: none is no job, and a contour's middle is the zero
    await page.click("#fit");
    await settledView(page);
    await page.mouse.click(...(await pixel(page, [18, 15])), { button: "right" });
    await page.click("#menu >> text=Zero here");
    await value(page, "field-origin", "point");
    await value(page, "field-origin-at-x", "12");
    await type(page, "field-around", "3");
    await value(page, "field-columns", "1");
    await value(page, "field-about-x", "0");
    await settled(page);
    assert.deepEqual(said, []);
    await context.close();
  });

  test("the sheet is seen as a whole, and printed as one page with nothing else; the outcome has the report's figures", async () => {
    const { url } = await start();
    const { page, context } = await visit(url, { viewport: LOW });
    await drawn(page);
    await type(page, "field-wire", "0.18");
    await cut(page);
    const outcome = (await page.textContent("#outcome")) ?? "";
    await page.click("#tab-report");
    const report = (await page.textContent("#report")) ?? "";
    assert.ok(outcome.split(" · ").length === 5);
    for (const figure of outcome.split(" · ").slice(1)) assert.ok(report.includes(figure), figure);
    await page.click("#tab-sheet");
    await page.waitForSelector("#sheet img");
    await page.waitForFunction(() => (document.querySelector("#sheet img") as HTMLImageElement).naturalWidth > 0);
    // (A4 on its side: all of it is in sight, and it has most of the room)
    const seen = await page.locator("#sheet img").boundingBox();
    assert.ok(seen && seen.height > 450 && seen.y + seen.height <= LOW.height, JSON.stringify(seen));
    assert.equal(await page.evaluate(() => typeof window.print), "function");
    await page.evaluate(() => {
      window.print = () => document.body.setAttribute("data-printed", "");
    });
    await page.getByRole("button", { name: "Print" }).click();
    await page.waitForSelector("[data-printed]");
    const pdf = (await page.pdf({ preferCSSPageSize: true })).toString("latin1");
    assert.equal(pdf.match(/\/Type *\/Page\b/g)?.length, 1);
    await page.emulateMedia({ media: "print" });
    const parts = await page.evaluate(() =>
      [...document.querySelectorAll("body *")]
        .filter((each) => each.checkVisibility() && each.getBoundingClientRect().width)
        .map(({ id, tagName }) => id || tagName),
    );
    assert.deepEqual(parts, ["MAIN", "results", "drawer", "sheet", "IMG"]);
    await context.close();
  });

  test("five clicks from a drawing to a saved tape: how long each takes; all of it in 1366 × 640, in both languages", async (t) => {
    for (const locale of ["en-GB", "zh-CN"]) {
      const { url, file } = await start();
      const { page, context } = await visit(url, { viewport: LOW, locale });
      const begun = Date.now();
      const marks: string[] = [];
      const mark = (what: string) => marks.push(`${what} ${Date.now() - begun} ms`);
      await drawn(page);
      mark("drawn");
      // (two numbers, and the clicks: wire, gap, Cut, Save, Save)
      await page.click("#field-wire");
      await page.keyboard.type("0.18");
      await page.click("#field-gap");
      await page.keyboard.type("0.01");
      await page.click("#cut");
      await page.waitForSelector("#outcome.good");
      mark("cut and checked");
      await page.click("#save");
      await page.click("#save-yes");
      await page.waitForFunction(() => document.getElementById("message")?.textContent?.includes("bracket.nodrift.3b"));
      mark("saved");
      t.diagnostic(`${locale}: ${marks.join(", ")}`);
      assert.ok(file("bracket.nodrift.3b").length > 1000);
      // nothing is cut off or under something else: buttons, fields, the line above the drawing with all that it offers
      await drop(page, "open.dxf", dxf(line(-2, 0, 59, 0), line(60, 1, 60, 42), line(61, 40, 0, 40), line(0, 42, 0, -1)));
      await says(page, "#name", "open.dxf");
      await type(page, "field-wire", "0.2");
      await page.waitForSelector("#decide.wrong");
      await settled(page);
      const hidden = await page.evaluate(() =>
        [...document.querySelectorAll<HTMLElement>("header :is(button, input, select), #decide *, #tools button, #action *")]
          .filter((each) => each.checkVisibility({ visibilityProperty: true }) && each.tagName !== "OPTION")
          .filter((each) => {
            const { left, right, top, bottom, width } = each.getBoundingClientRect();
            const at = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
            const isSeen = at && (each.contains(at) || at.contains(each));
            return width > 1 && (left < 0 || right > innerWidth || top < 0 || bottom > innerHeight || !isSeen);
          })
          .map((each) => `${each.id} ${each.textContent}`),
      );
      assert.deepEqual(hidden, []);
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0);
      await shot(page, `low-${locale}`);
      await context.close();
    }
  });

  test("a thin wall wants a decision before Cut, and once", async () => {
    const { url } = await start("wall.dxf", dxf(...box(0, 0, 60, 40), circle(15, 20, 5), circle(25.3, 20, 5)));
    const { page, context } = await visit(url, { viewport: LOW });
    await drawn(page);
    await type(page, "field-wire", "0.2");
    await settled(page);
    await page.waitForSelector("#decide.care");
    await says(page, "#decide-text", /0\.3 mm thick/);
    await page.getByRole("button", { name: "Leave this contour" }).waitFor();
    await page.getByRole("button", { name: "As it is" }).click();
    await page.waitForSelector("#decide", { state: "hidden" });
    await cut(page);
    await page.waitForSelector("#outcome.good");
    await context.close();
  });

  test("contours that the wire does not get around are told one by one, and left together", async () => {
    const { url } = await start(
      "small.dxf",
      dxf(...box(0, 0, 60, 40), circle(15, 20, 0.08), circle(40, 20, 0.06), circle(30, 20, 6)),
    );
    const { page, context } = await visit(url, { viewport: LOW });
    await drawn(page);
    await type(page, "field-wire", "0.2");
    await says(page, "#decide-count", /2/);
    await says(page, "#decide-text", /contour \d, at \((14\.92|39\.94), 20\)/);
    await page.getByRole("button", { name: "Leave what is too small" }).click();
    await page.waitForSelector("#decide", { state: "hidden" });
    await cut(page);
    await says(page, "#report", /2 (contours|CIRCLE)/);
    await context.close();
  });

  test("a drawing of an unlikely size, without units, is read in inches by a click", async () => {
    const { url } = await start("inch.dxf", dxf(...box(0, 0, 2, 1.5)));
    const { page, context } = await visit(url, { viewport: LOW, locale: "zh-CN" });
    await page.getByRole("button", { name: "按 英寸 读取" }).click();
    await says(page, "#size", /50\.8 × 38\.1/);
    await page.waitForSelector("#decide", { state: "hidden" });
    await context.close();
  });

  test("a punch and its die: a clearance, both tapes and sheets, one or the other is looked at; saved together", async () => {
    const started = await start();
    const { context, page, said } = await visit(started.url);
    await drawn(page);
    await type(page, "field-wire", "0.2");
    assert.equal(await page.isVisible("#field-clearance_on"), false);
    await type(page, "field-clearance", "0.02");
    await page.selectOption("#field-clearance_on", "die");
    await cut(page);
    await page.click("#tab-report");
    await says(page, "#report", /punch: cut from outside, to the size that is drawn.*die: cut from inside, 0.02 mm larger/s);
    const punch = (await page.textContent("#outcome")) ?? "";
    await page.selectOption("#member", "die");
    await page.waitForFunction((before) => document.getElementById("outcome")?.textContent !== before, punch);
    await page.click("#tab-program");
    await says(page, "#program", /1 CONTOUR/);
    await page.click("#shut");
    await page.click("#save");
    await page.click("#save-yes");
    await message(page, /bracket-punch.*bracket-die/);
    const words = ["--wire", "0.2", "--clearance", "0.02", "--clearance-on", "die"];
    execFileSync(SKG, ["cut", join(started.folder, "bracket.dxf"), "-o", join(started.folder, "own.nodrift.3b"), ...words], {
      stdio: "pipe",
    });
    for (const member of ["punch", "die"]) {
      assert.deepEqual(started.file(`bracket-${member}.nodrift.3b`), started.file(`own-${member}.nodrift.3b`));
      assert.equal(started.file(`bracket-${member}.pdf`).subarray(0, 5).toString(), "%PDF-");
    }
    // without the clearance it is the part again
    await page.fill("#field-clearance", "");
    await page.press("#field-clearance", "Enter");
    await settled(page);
    await cut(page);
    assert.equal(await page.isVisible("#member"), false);
    assert.deepEqual(said, []);
    await context.close();
  });

  test("20,000 circles: open, panned, chosen; a frame costs no more than one of 2,000", async (t) => {
    const costs: number[] = [];
    for (const count of [MANY / 10, MANY]) {
      const { url } = await start("circles.dxf", field(count));
      const { page, context } = await visit(url);
      await drawn(page);
      const opened = Math.round(await page.evaluate(() => performance.now()));
      const frames = await page.evaluate(async () => {
        const over = document.getElementById("over") as HTMLCanvasElement;
        const base = document.getElementById("base") as HTMLCanvasElement;
        const { left, top, width, height } = over.getBoundingClientRect();
        const at = (x: number, type: string) =>
          over.dispatchEvent(
            new PointerEvent(type, { pointerId: 1, clientX: left + width / 2 + x, clientY: top + height / 2, bubbles: true }),
          );
        over.setPointerCapture = () => undefined;
        const took: number[] = [];
        at(0, "pointerdown");
        for (let x = 1; x <= 60; x++) {
          at(4 * x, "pointermove");
          await new Promise((next) => requestAnimationFrame(next));
          await new Promise((next) => setTimeout(next));
          took.push(Number(base.dataset["took"]));
        }
        at(240, "pointerup");
        return took.sort((one, two) => one - two);
      });
      const median = frames[30] as number;
      costs.push(median);
      t.diagnostic(
        `${count} circles: open after ${opened} ms; a frame of panning ${median.toFixed(1)} ms, at most ${frames[59]?.toFixed(1)} ms`,
      );
      await page.keyboard.press("Tab");
      await drawn(page);
      await page.click("#fit");
      await drawn(page);
      await click(page, [3, 1]);
      await says(page, "#h-values", "outline 2 × 2");
      assert.ok((await page.locator("#tree [role=treeitem]").count()) < 100);
      await context.close();
    }
    const [few, many] = costs as [number, number];
    assert.ok(many < 3 * few + 10, `${few} ms, ${many} ms`);
  });
});
