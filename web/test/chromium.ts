/** Shared by the tests in chromium: visits, the page's texts, files in and out. */
import { mkdirSync, readFileSync } from "node:fs";
import { type Browser, type BrowserContext, type BrowserContextOptions, chromium, type Page } from "playwright-core";
import type { Part } from "../src/parts.ts";
import { PATIENCE, type Served, serve } from "./served.ts";

export const CHROMIUM = "/usr/bin/chromium";
const SHOTS = process.env["SHOTS"] ?? "web/build/shots";
export const PARTS = JSON.parse(readFileSync("web/dist/parts.json", "utf8")) as Part[];
export const AXE = readFileSync("web/node_modules/axe-core/axe.min.js", "utf8");
export const WIDE = { width: 1400, height: 900 };
export const PHONE = { width: 360, height: 740 };

export let browser: Browser;
export let served: Served;

/** A page in a browser that was never here, and what it said on the console. */
export async function visit(
  options: BrowserContextOptions = {},
  hash = "",
  prepare?: (context: BrowserContext) => Promise<unknown>,
  url = served.url,
) {
  const context = await browser.newContext({ viewport: WIDE, acceptDownloads: true, ...options });
  await prepare?.(context);
  context.setDefaultTimeout(PATIENCE);
  const page = await context.newPage();
  const said: string[] = [];
  page.on("console", (message) => said.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => said.push(String(error)));
  await page.goto(url + hash);
  await page.waitForSelector("body[data-ready]");
  return { context, page, said };
}

export const state = (page: Page, text: string) =>
  page.waitForFunction((wanted) => document.getElementById("state")?.textContent === wanted, text);
export const prompt = (page: Page) => state(page, "at its prompt");
/** An empty machine, where a first visit shows the wrench. */
export async function visitEmpty(...options: Parameters<typeof visit>): ReturnType<typeof visit> {
  const visitor = await visit(...options);
  await wholeTape(visitor.page);
  await prompt(visitor.page);
  await visitor.page.click("#terminal");
  await visitor.page.keyboard.type("NEW\r");
  await hasLines(visitor.page, [""]);
  return visitor;
}

export const onPaper = (page: Page, text: string | RegExp) =>
  page.waitForFunction((wanted) => {
    const paper = [...document.querySelectorAll(".xterm-rows > div")].map((row) => row.textContent?.trimEnd()).join("\n");
    return typeof wanted === "string" ? paper.includes(wanted) : wanted.test(paper);
  }, text);
/** Until an element says this: what the page writes in a later frame or message is waited for, never read at once. */
export const says = (page: Page, selector: string, text: string | RegExp) =>
  page.waitForFunction(
    ([selector, wanted]) => {
      const found = document.querySelector(selector)?.textContent ?? "";
      return typeof wanted === "string" ? found === wanted : wanted.test(found);
    },
    [selector, text] as const,
  );
export const message = (page: Page, text: RegExp) => says(page, "#message span", text);
export const lines = (page: Page) => page.locator("#lines .cm-line").allTextContents();
export const hasLines = (page: Page, wanted: readonly string[]) =>
  page.waitForFunction(
    (wanted) => [...document.querySelectorAll("#lines .cm-line")].map((line) => line.textContent).join("\n") === wanted,
    wanted.join("\n"),
  );
export const wholeTape = (page: Page, blocks?: number) =>
  says(page, "#sum", new RegExp(`^${blocks ?? "\\d+"} blocks · [\\d.]+ mm$`));

export const active = (page: Page, block: number) =>
  page.waitForFunction(
    (wanted) => document.querySelector("#list")?.getAttribute("aria-activedescendant") === `block-${wanted}`,
    block,
  );

/** Pastes into the teletype. */
export function paste(page: Page, text: string): Promise<void> {
  return page.evaluate((text) => {
    const data = new DataTransfer();
    data.setData("text/plain", text);
    document
      .querySelector(".xterm-helper-textarea")
      ?.dispatchEvent(new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }));
  }, text);
}

/** The file that a button of the menu Save gives. */
export async function saved(page: Page, kind: string): Promise<string> {
  await page.locator("details.menu summary").first().click();
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(`[data-save="${kind}"]`)]);
  return readFileSync(await download.path(), "latin1");
}

export async function open(page: Page, name: string, text: string): Promise<void> {
  await page.setInputFiles("#file", { name, mimeType: "application/octet-stream", buffer: Buffer.from(text, "latin1") });
}

/** Opens a part, which runs it. */
export async function runPart(page: Page, name: string): Promise<void> {
  await page.locator(`[data-part="${name}"]`).click();
  await wholeTape(page);
  await prompt(page);
}

/** Counts what the page hears of its worker, as `heardOfWorker`. */
export const tap = (context: BrowserContext) =>
  context.addInitScript(() => {
    const counts = { heard: 0, unseen: 0, mostUnseen: 0, cycles: 0 };
    Object.assign(window, { heardOfWorker: counts });
    window.Worker = class extends Worker {
      constructor(url: string | URL) {
        super(url);
        this.addEventListener("message", ({ data }) => {
          if (data.kind !== "out") return;
          counts.heard++;
          counts.cycles = data.cycles;
          counts.mostUnseen = Math.max(counts.mostUnseen, ++counts.unseen);
        });
      }
      override postMessage(order: { kind: string }): void {
        if (order.kind === "seen") counts.unseen--;
        super.postMessage(order);
      }
    };
  });

/** Until what was done is drawn: the frame in which it is asked for, and the one behind it. */
export const drawn = (page: Page) =>
  page.evaluate(() => new Promise((tell) => requestAnimationFrame(() => requestAnimationFrame(tell))));

export async function shot(page: Page, name: string): Promise<void> {
  mkdirSync(SHOTS, { recursive: true });
  await drawn(page);
  await page.screenshot({ path: `${SHOTS}/${name}.png` });
}

/** Starts chromium and a server for the page; ends both. */
export async function begin(): Promise<void> {
  served = await serve();
  browser = await chromium.launch({
    executablePath: CHROMIUM,
    timeout: PATIENCE,
    args: [
      "--no-sandbox",
      "--disable-gpu",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
    ],
  });
}

export async function end(): Promise<void> {
  await browser?.close();
  await served?.stop();
}

/** The longest that the page's own code holds its thread up at a stretch, ms of the thread's own time: other programs on this
 * machine do not count. */
export async function longestTask(page: Page, act: () => Promise<void>): Promise<number> {
  await browser.startTracing(page, { categories: ["devtools.timeline"] });
  await act();
  const { traceEvents } = JSON.parse((await browser.stopTracing()).toString()) as {
    traceEvents: { name: string; pid: number; tid: number; tdur?: number }[];
  };
  const own = traceEvents.filter(({ name }) =>
    ["TimerFire", "FireAnimationFrame", "RunMicrotasks", "EventDispatch"].includes(name),
  );
  return Math.max(0, ...own.map(({ tdur }) => (tdur ?? 0) / 1000));
}
