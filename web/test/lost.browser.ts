/** Nothing is lost without a word, in Debian's chromium: foreign texts, closed stores, tabs, broken links, a machine that is not there. */
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import type { Page } from "playwright-core";
import { pack } from "../src/link.ts";
import {
  begin,
  CHROMIUM,
  drawn,
  end,
  hasLines,
  lines,
  message,
  open,
  prompt,
  runPart,
  saved,
  says,
  served,
  visit,
  visitEmpty,
  wholeTape,
} from "./chromium.ts";
import { WHOLE } from "./served.ts";

/** Puts a text in the place of the editor's. */
async function write(page: Page, text: string): Promise<void> {
  await page.click("#lines .cm-line");
  await page.keyboard.press("Control+A");
  await page.evaluate((text) => {
    const data = new DataTransfer();
    data.setData("text/plain", text);
    document
      .querySelector(".cm-content")
      ?.dispatchEvent(new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }));
  }, text);
}

/** Until the text in the editor is kept as it is. */
const isKept = (page: Page, text: string) =>
  page.waitForFunction(
    (text) => JSON.parse(localStorage.getItem("skg:/some/folder/:machine") ?? "{}").draft?.includes(text),
    text,
  );

const works = (page: Page) => page.locator(".work b").allTextContents();
const inWorks = (page: Page, name: string) =>
  page.waitForFunction((name) => [...document.querySelectorAll(".work b")].some(({ textContent }) => textContent === name), name);

describe("nothing is lost", { skip: existsSync(CHROMIUM) ? false : "chromium is not installed", timeout: WHOLE }, () => {
  before(begin);
  after(end);

  test("a tape that one RUN did not make is called what it is, and asks before it is saved; SAVE takes nothing away", async () => {
    const { page, context, said } = await visit();
    await runPart(page, "wrench");
    const tape = readFileSync("examples/wrench.3b", "latin1");
    await page.click("#terminal");
    await page.keyboard.type("SAVE\r");
    await message(page, /SAVE has punched/);
    const [program] = await Promise.all([page.waitForEvent("download"), page.click("#offer")]);
    assert.equal(readFileSync(await program.path(), "latin1"), readFileSync("examples/wrench.skg", "latin1"));
    assert.equal(await saved(page, "3b"), tape);
    for (const [typed, made, name, question] of [
      ["GOTO 170", /typed at the teletype/, "-typed.3b", /Statements typed/],
      ["RUN 20", /RUN 20/, "-from-20.3b", /RUN 20 made/],
    ] as const) {
      await page.click("#terminal");
      await page.keyboard.type(`${typed}\r`);
      await says(page, "#made", made);
      await wholeTape(page);
      await page.locator("details.menu summary").first().click();
      await page.click('[data-save="3b"]');
      await says(page, "#question-text", question);
      const [download] = await Promise.all([page.waitForEvent("download"), page.click("#question-yes")]);
      assert.ok(download.suggestedFilename().endsWith(name), download.suggestedFilename());
      // (it is called so after a reload, too)
      await page.reload();
      await page.waitForSelector("body[data-ready]");
      await says(page, "#made", made);
      await prompt(page);
    }
    await page.click("#run");
    await says(page, "#made", "Wrench");
    await wholeTape(page, 29);
    await prompt(page);
    assert.equal(await saved(page, "3b"), tape);
    assert.deepEqual(said, []);
    await context.close();
  });

  test("a program with Windows line ends, tabs, wide signs of a Chinese keyboard", async () => {
    const { page, context, said } = await visit();
    await wholeTape(page);
    await prompt(page);
    await write(page, "10 R＝0.1\r\n20\tFROM （0，－5）\r\n30 CUT X，Y：10，－X：10，－Y\r\n40 BACK\r\n50　END\r\n");
    await hasLines(page, ["10 R=0.1", "20\tFROM (0,-5)", "30 CUT X,Y:10,-X:10,-Y", "40 BACK", "50 END", ""]);
    await page.keyboard.press("Control+Enter");
    await hasLines(page, ["10 R=0.1", "20 FROM (0,-5)", "30 CUT X,Y:10,-X:10,-Y", "40 BACK", "50 END"]);
    await wholeTape(page);
    assert.equal(await page.locator(".fault").count(), 0);
    assert.deepEqual(said, []);
    await context.close();
  });

  test("a remark in Chinese is said and stays, typed with an input method, pasted, or out of a file", async () => {
    const { page, context, said } = await visit();
    await wholeTape(page);
    await prompt(page);
    await page.click("#lines .cm-line:nth-child(1)");
    await page.keyboard.press("End");
    const cdp = await context.newCDPSession(page);
    for (const part of ["z", "zh", "zhong", "zhongw"]) {
      await cdp.send("Input.imeSetComposition", { text: part, selectionStart: part.length, selectionEnd: part.length });
      await drawn(page);
    }
    await cdp.send("Input.insertText", { text: "中文，" });
    await says(page, "#lines .fault", /no character 中/);
    await says(page, "#lines .cm-line:nth-child(1)", /\(core\)中文,$/);
    await isKept(page, "中文,");
    await page.reload();
    await page.waitForSelector("body[data-ready]");
    await says(page, "#lines .cm-line:nth-child(1)", /中文,$/);
    await page.setInputFiles("#file", {
      name: "a.skg",
      mimeType: "text/plain",
      buffer: Buffer.from("10 REM 扳手\r\n20 END\r\n"),
    });
    await message(page, /lines are not taken/);
    await hasLines(page, ["10 REM 扳手", "20 END"]);
    await says(page, "#lines .fault", /no character 扳/);
    assert.deepEqual(said, []);
    await context.close();
  });

  test("a line of 5,000 characters, a program of 64 KB: marked where the machine is full, kept whole", async () => {
    const { page, context, said } = await visit();
    await wholeTape(page);
    await prompt(page);
    const long = `10 REM ${"X".repeat(5000)}\n20 END\n`;
    await write(page, long);
    await says(page, "#lines .fault", /ERR 09/);
    await isKept(page, "X".repeat(5000));
    const big = Array.from({ length: 2600 }, (_, at) => `${at + 1} P${at % 10}=(${at},${at}.25)`).join("\n");
    assert.ok(big.length > 50_000);
    await write(page, big);
    await page.waitForFunction(() =>
      [...document.querySelectorAll(".cm-line")].some((line) => /^2600 P9/.test(line.textContent ?? "")),
    );
    await page.keyboard.press("Control+Enter");
    await message(page, /lines are not taken/);
    await isKept(page, "2600 P9=(2599,2599.25)");
    await page.keyboard.press("Control+Home");
    await page.keyboard.press("Control+Z");
    await says(page, "#lines .cm-line:nth-child(2)", "20 END");
    assert.deepEqual(said, []);
    await context.close();
  });

  test("broken links: one sentence each, and what was there stays", async () => {
    const { page, context, said } = await visitEmpty();
    await page.keyboard.type("10 REM MINE\r");
    await hasLines(page, ["10 REM MINE"]);
    const code = await pack("10 FROM O\n20 END\n");
    const broken = [
      ...["", "%", "%%%", "AAAA", "A".repeat(100_000), "\u{1f600}", code.slice(1), code.slice(0, -3), `${code}AAAA`].map(
        (each) => `#z=${each}&run`,
      ),
      `#z=${code.slice(0, 9)}x${code.slice(10)}`,
      `#z=${await pack(" \n")}`,
      `#z=${Buffer.from("10 END").toString("base64")}`,
      ...["nothing", "__proto__", "constructor", "<img src=x>", "%00", "../../wrench"].map((name) => `#part=${name}`),
    ];
    assert.ok(broken.length > 15);
    for (const hash of broken) {
      await page.evaluate((hash) => {
        document.getElementById("dismiss")?.click();
        location.hash = hash;
      }, hash);
      await message(page, /not whole|no part/);
    }
    for (const empty of ["#run", "#embed", "#&&&", "#part=", "#x"]) await page.evaluate((hash) => (location.hash = hash), empty);
    await drawn(page);
    assert.deepEqual(await lines(page), ["10 REM MINE"]);
    assert.deepEqual(said, []);
    // back and forward
    await page.evaluate(() => (location.hash = "#part=die&run"));
    await says(page, "#made", "Die: the wire inside");
    await wholeTape(page);
    await page.goto("about:blank");
    await page.goBack();
    await page.waitForSelector("body[data-ready]");
    await inWorks(page, "MINE");
    await says(page, "#lines .cm-line:nth-child(1)", /die of the same contour/);
    await context.close();
  });

  test("a browser that keeps nothing: said until it is read, one's programs stay in the list, and leaving asks", async () => {
    for (const isFull of [true, false]) {
      const { page, context, said } = await visit({}, "", (context) =>
        context.addInitScript((isFull) => {
          if (isFull) {
            Storage.prototype.setItem = () => {
              throw new DOMException("full", "QuotaExceededError");
            };
          } else {
            Object.defineProperty(window, "localStorage", {
              get() {
                throw new DOMException("closed", "SecurityError");
              },
            });
          }
        }, isFull),
      );
      await wholeTape(page);
      await prompt(page);
      await message(page, /refuses to keep/);
      assert.ok(await page.isVisible("#message"));
      await write(page, "10 REM MINE ALONE\n20 I=1\n");
      await page.keyboard.press("Control+Enter");
      await hasLines(page, ["10 REM MINE ALONE", "20 I=1"]);
      await runPart(page, "die");
      await inWorks(page, "MINE ALONE");
      assert.ok(await page.isVisible("#message"), "what is at stake is not hidden by the next thing done");
      await page.click("#dismiss");
      // (also while an example is seen)
      const asked = page.waitForEvent("dialog");
      await page.close({ runBeforeUnload: true });
      const dialog = await asked;
      assert.equal(dialog.type(), "beforeunload");
      await dialog.accept();
      assert.deepEqual(said, []);
      await context.close();
    }
  });

  test("two tabs: a text that is in no machine yet is among the programs of the other", async () => {
    const { page, context } = await visit();
    await wholeTape(page);
    await prompt(page);
    const other = await context.newPage();
    await other.goto(served.url);
    await other.waitForSelector("body[data-ready]");
    await message(page, /open in another tab/);
    await page.bringToFront();
    await write(page, "10 REM FIRST TAB\n20 FRAM O\n");
    await says(page, "#lines .fault", /ERR 01/);
    await page.close();
    await inWorks(other, "FIRST TAB");
    await other.locator(".work button", { hasText: "FIRST TAB" }).click();
    await hasLines(other, ["10 REM FIRST TAB", "20 FRAM O"]);
    // the tab closed in the middle of a word: it is there again
    await other.click("#lines .cm-line:nth-child(2)");
    await other.keyboard.press("End");
    await other.keyboard.type("30 HAL");
    await other.close({ runBeforeUnload: true });
    const again = await context.newPage();
    await again.goto(served.url);
    await again.waitForSelector("body[data-ready]");
    await hasLines(again, ["10 REM FIRST TAB", "20 FRAM O30 HAL"]);
    await context.close();
  });

  test("one identity: a blank is an edit, a program has its own name, what is deleted comes back, and all of it is in one file", async () => {
    const { page, context, said } = await visit();
    await runPart(page, "wrench");
    const text = (...rows: string[]) => rows.join("\n");
    await write(page, text("10 REM HELLOWORLD", "20 CUT O,(5,0)", "30 END"));
    await page.keyboard.press("Control+Enter");
    await says(page, "#made", "HELLOWORLD");
    await wholeTape(page, 1);
    await prompt(page);
    // its file is called after it, not after the part that was there
    await page.locator("details.menu summary").first().click();
    const [tape] = await Promise.all([page.waitForEvent("download"), page.click('[data-save="3b"]')]);
    assert.equal(tape.suggestedFilename(), "helloworld.3b");
    // a blank more is an edit, also after a reload
    await page.click("#lines .cm-line:nth-child(1)");
    await page.keyboard.press("End");
    for (let left = 0; left < 5; left++) await page.keyboard.press("ArrowLeft");
    await page.keyboard.type(" ");
    await isKept(page, "HELLO WORLD");
    await page.reload();
    await page.waitForSelector("body[data-ready]");
    await says(page, "#lines .cm-line:nth-child(1)", "10 REM HELLO WORLD");
    await prompt(page);
    await page.click("#lines .cm-line:nth-child(3)");
    await page.keyboard.press("End");
    // (RETURN numbers a line; one that is still empty is no false alarm)
    await page.keyboard.type("\n");
    await says(page, "#lines .cm-line:nth-child(4)", "40 ");
    await page.keyboard.press("Control+Enter");
    await hasLines(page, ["10 REM HELLO WORLD", "20 CUT O,(5,0)", "30 END"]);
    assert.equal(await page.isVisible("#message"), false);
    await inWorks(page, "HELLO WORLD");
    assert.deepEqual(await works(page), ["HELLO WORLD", "HELLOWORLD"], "another title is another program");
    // a kept one that is opened and changed stays as it was
    await page.locator(".work button", { hasText: "HELLOWORLD" }).first().click();
    await hasLines(page, ["10 REM HELLOWORLD", "20 CUT O,(5,0)", "30 END"]);
    await prompt(page);
    await page.click("#terminal");
    await page.keyboard.type("25 CUT (5,5)\r");
    await page.waitForFunction(() => document.querySelectorAll(".work").length === 3);
    await page.locator(".work button", { hasText: "HELLOWORLD" }).nth(1).click();
    await hasLines(page, ["10 REM HELLOWORLD", "20 CUT O,(5,0)", "30 END"]);
    await prompt(page);
    // deleted, and back
    await page.locator(".work", { hasText: "HELLO WORLD" }).locator(".bin").click();
    await message(page, /HELLO WORLD is deleted/);
    await page.waitForFunction(() => document.querySelectorAll(".work").length === 2);
    await page.click("#offer");
    await inWorks(page, "HELLO WORLD");
    const all = await saved(page, "json");
    assert.deepEqual(said, []);
    await context.close();

    const other = await visit();
    await wholeTape(other.page);
    await open(other.page, "all.json", all);
    await inWorks(other.page, "HELLO WORLD");
    assert.deepEqual((await works(other.page)).sort(), ["HELLO WORLD", "HELLOWORLD", "HELLOWORLD"]);
    await open(other.page, "all.json", all);
    await message(other.page, /all\.json/);
    assert.equal((await works(other.page)).length, 3, "none is there twice");
    // a tape that is none changes nothing
    await open(other.page, "odd.json", JSON.stringify({ ...JSON.parse(all), tape: "B1B2", settings: { theme: "dark" } }));
    await message(other.page, /odd\.json is no tape/);
    assert.equal(await other.page.inputValue("#theme"), "auto");
    // the tape is the saved program's, not that of the part that was seen before; so is it after a reload
    for (const time of ["brought back", "reloaded"]) {
      await says(other.page, "#made", "HELLOWORLD");
      await prompt(other.page);
      await other.page.locator("details.menu summary").first().click();
      const [brought] = await Promise.all([other.page.waitForEvent("download"), other.page.click('[data-save="3b"]')]);
      assert.equal(brought.suggestedFilename(), "helloworld.3b", time);
      await other.page.reload();
      await other.page.waitForSelector("body[data-ready]");
    }
    await other.context.close();
  });

  test("an example is none of one's own programs, however late the list comes", async () => {
    const { page, context } = await visit({ serviceWorkers: "block" });
    await wholeTape(page);
    await prompt(page);
    let come = (): void => undefined;
    const isThere = new Promise<void>((resolve) => (come = resolve));
    await context.route("**/parts.json", (route) => isThere.then(() => route.continue()));
    await page.reload();
    await says(page, "#lines .cm-line:nth-child(1)", /A wrench/);
    come();
    await page.waitForSelector("body[data-ready]");
    assert.deepEqual(await works(page), []);
    await context.close();
  });

  test("without the machine: programs can be read and written, and are there again", async () => {
    const block = (context: import("playwright-core").BrowserContext) =>
      context.route("**/board.wasm", (route) => route.fulfill({ body: "no" }));
    const { page, context, said } = await visit({ serviceWorkers: "block" }, "", block);
    await message(page, /machine cannot run here/);
    await page.click("[data-part=die]");
    await says(page, "#lines .cm-line:nth-child(1)", /die of the same contour/);
    await write(page, "10 REM WITHOUT\n20 END\n");
    await isKept(page, "WITHOUT");
    await page.reload();
    await page.waitForSelector("body[data-ready]");
    await hasLines(page, ["10 REM WITHOUT", "20 END"]);
    await open(page, "a.3b", readFileSync("examples/die.3b", "latin1"));
    await wholeTape(page);
    assert.deepEqual(
      said.filter((text) => !/Service Worker/.test(text)),
      [],
    );
    await context.close();
  });

  test("an update that comes half alone changes nothing; a whole one is offered, and there at a click", async () => {
    const { page, context } = await visit();
    await wholeTape(page);
    await page.waitForFunction(async () => (await caches.keys()).length > 0 && navigator.serviceWorker.controller !== null);
    const names = () => page.evaluate(() => caches.keys());
    const before = await names();
    const next = readFileSync("web/dist/offline.js", "utf8").replace(/[0-9a-f]{12}/, "0123456789ab");
    served.changed.set("offline.js", next.replace('"main.js"', '"main.js","missing.js"'));
    const isOver = page.evaluate(async () => {
      const registration = await navigator.serviceWorker.getRegistration();
      const isGone = new Promise((tell) => {
        registration?.addEventListener("updatefound", () => {
          const { installing } = registration;
          installing?.addEventListener("statechange", () => tell(installing.state));
        });
      });
      void registration?.update().catch(() => undefined);
      return isGone;
    });
    assert.equal(await isOver, "redundant");
    assert.deepEqual(await names(), before);
    assert.equal(await page.isVisible("#message"), false);
    await page.reload();
    await page.waitForSelector("body[data-ready]");
    await wholeTape(page);
    served.changed.set("offline.js", next);
    await page.evaluate(async () => void (await (await navigator.serviceWorker.getRegistration())?.update()));
    await message(page, /new version/);
    // (two tabs say so: each of them gets it at a click)
    const second = await context.newPage();
    await second.goto(served.url);
    await message(second, /new version/);
    await message(page, /another tab/);
    await page.click("#dismiss");
    await message(page, /new version/);
    await Promise.all([page.waitForEvent("load"), page.click("#offer")]);
    await page.waitForSelector("body[data-ready]");
    await message(second, /another tab/);
    await second.click("#dismiss");
    await message(second, /new version/);
    await Promise.all([second.waitForEvent("load"), second.click("#offer")]);
    await second.waitForSelector("body[data-ready]");
    await second.close();
    assert.deepEqual(await names(), ["skg:/some/folder/:0123456789ab"]);
    await wholeTape(page);
    served.changed.clear();
    await context.close();
  });
});
