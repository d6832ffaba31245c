/** The drawing on the screen, `skg ui`, in Debian's firefox-esr: from a drawing to its tape. */
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import puppeteer, { type Browser } from "puppeteer-core";
import { PATIENCE, WHOLE } from "./served.ts";
import { cutByCommand, endAll, start } from "./uistart.ts";

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
    const page = await browser.newPage();
    page.setDefaultTimeout(PATIENCE);
    const said: string[] = [];
    page.on("console", (message) => said.push(`${message.type()}: ${message.text()}`));
    page.on("pageerror", (error) => said.push(String(error)));
    await page.setViewport({ width: 1400, height: 900 });
    await page.goto(url);
    await page.waitForSelector("#base[data-whole=true]");
    await page.waitForSelector("#tree [data-id]");
    const type = async (id: string, text: string): Promise<void> => {
      await page.focus(`#${id}`);
      await page.keyboard.type(text);
      await page.keyboard.press("Enter");
      await page.waitForSelector(`.field.own #${id}`);
    };
    await type("field-wire", "0.18");
    await type("field-gap", "0.01");
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
});
