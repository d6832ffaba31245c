/** The pictures of skg ui in the pages, docs/pictures/ui-bracket.png and its Chinese sister: made by `make ui-pictures`. */
import { chromium } from "playwright-core";
import { BRACKET, endAll, start } from "./uistart.ts";

const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu"] });
for (const [locale, name] of [
  ["en-GB", "ui-bracket"],
  ["zh-CN", "ui-bracket-zh"],
] as const) {
  const { url } = await start("bracket.dxf", BRACKET);
  const context = await browser.newContext({ viewport: { width: 1366, height: 640 }, locale });
  const page = await context.newPage();
  await page.goto(url);
  await page.waitForFunction(
    () => document.getElementById("base")?.dataset["whole"] === "true" && document.getElementById("name")?.textContent,
  );
  for (const [id, text] of [
    ["wire", "0.18"],
    ["gap", "0.01"],
  ]) {
    await page.fill(`#field-${id}`, text as string);
    await page.press(`#field-${id}`, "Enter");
  }
  // the outline is chosen, with a tab of two passes that stands proud: that wants a decision
  const tree = page.locator("#tree [role=treeitem]", { hasText: "70 × 30" });
  await tree.click();
  for (const [id, text] of [
    ["passes", "0.06, 0"],
    ["tab", "1.5"],
  ]) {
    await page.fill(`#field-${id}`, text as string);
    await page.press(`#field-${id}`, "Enter");
  }
  await page.click("#cut");
  await page.waitForSelector("#outcome:is(.good, .care)");
  // (the walk, halfway)
  await page.locator("#scrub").evaluate((scrub: HTMLInputElement) => {
    scrub.value = String(Math.round(Number(scrub.max) * 0.62));
    scrub.dispatchEvent(new Event("input", { bubbles: true }));
  });
  await page.mouse.move(0, 0);
  await page.waitForFunction(() => document.getElementById("base")?.dataset["whole"] === "true");
  await page.waitForTimeout(500);
  await page.screenshot({ path: `docs/pictures/${name}.png` });
  await context.close();
}
await browser.close();
endAll();
