/** The drawing on the screen, `skg ui`, in Debian's firefox-esr: from a drawing to its tape. */
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import puppeteer, { type Browser, type Page } from "puppeteer-core";
import { PATIENCE, WHOLE } from "./served.ts";
import { cutByCommand, endAll, NO_SETUPS, start } from "./uistart.ts";

const FIREFOX = "/usr/bin/firefox-esr";
let browser: Browser;

describe("skg ui in firefox", { skip: existsSync(FIREFOX) ? false : "firefox-esr is not installed", timeout: WHOLE }, () => {
  before(async () => {
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
    endAll();
  });

  test("wire, gap, Cut, Save: the tape is that of the command line; its walk goes over the drawing", async () => {
    const { url, folder, file } = await start();
    const { page, said } = await opened(url);
    await type(page, "field-wire", "0.18");
    await type(page, "field-gap", "0.01");
    await page.click("#cut");
    await page.waitForSelector("#outcome.good");
    await page.waitForSelector("#walk:not([hidden])");
    await page.focus("#scrub");
    await page.keyboard.press("End");
    await page.waitForFunction(() => /block 94 of 94/.test(document.getElementById("walked")?.textContent ?? ""));
    await page.click("#save");
    await page.click("#save-yes");
    await page.waitForFunction(() => /Saved beside/.test(document.querySelector("#message span")?.textContent ?? ""));
    const tape = file("bracket.nodrift.3b");
    assert.ok(tape.equals(cutByCommand(folder, "bracket.dxf", "--wire", "0.18", "--gap", "0.01")));
    assert.ok(existsSync(join(folder, "bracket.job.toml")));
    assert.deepEqual(said, []);
  });

  test("a setup is kept under a name, the next drawing's by itself, and forgotten by a click", async (t) => {
    const config = mkdtempSync(join(tmpdir(), "skg-setups-"));
    process.env["XDG_CONFIG_HOME"] = config;
    t.after(() => {
      process.env["XDG_CONFIG_HOME"] = NO_SETUPS;
      rmSync(config, { recursive: true, force: true });
    });
    const first = await opened((await start()).url);
    await type(first.page, "field-wire", "0.18");
    await first.page.click("#setups-open");
    await first.page.type("#setups-name", "细丝 0.18");
    await first.page.keyboard.press("Enter");
    await chosen(first.page, "细丝 0.18");
    await first.page.close();
    const next = await opened((await start()).url);
    await chosen(next.page, "细丝 0.18");
    assert.equal(await next.page.$eval("#field-wire", (field) => (field as HTMLInputElement).value), "0.18");
    await next.page.click("#setups-open");
    await next.page.click("#setups-list button");
    await next.page.click("#question-yes");
    await next.page.waitForFunction(() => !document.querySelector("#setups-list li"));
    await next.page.click("#setups-close");
    await chosen(next.page, "");
    assert.deepEqual([...first.said, ...next.said], []);
  });
});

/** A page, when its drawing is there, and what its console says. */
async function opened(url: string): Promise<{ page: Page; said: string[] }> {
  const page = await browser.newPage();
  page.setDefaultTimeout(PATIENCE);
  const said: string[] = [];
  page.on("console", (message) => said.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => said.push(String(error)));
  await page.setViewport({ width: 1400, height: 900 });
  await page.goto(url);
  await page.waitForSelector("#base[data-whole=true]");
  await page.waitForSelector("#tree [data-id]");
  return { page, said };
}

async function type(page: Page, id: string, text: string): Promise<void> {
  await page.focus(`#${id}`);
  await page.keyboard.type(text);
  await page.keyboard.press("Enter");
  await page.waitForSelector(`.field.own #${id}`);
}

/** Waits until a setup is the one that is chosen. */
async function chosen(page: Page, name: string): Promise<void> {
  await page.waitForFunction((wanted) => (document.getElementById("setup") as HTMLSelectElement).value === wanted, {}, name);
}
