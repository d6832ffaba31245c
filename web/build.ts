/** Makes web/dist: the page with ROM, examples and manual as they are now. `make web` runs it at the repository's top. */
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { type BuildOptions, type BuildResult, build } from "esbuild";
import { Marked } from "marked";
import { type Card, pictureOf, withCard } from "./card.ts";
import { ascii, Board, bytesOf, ROM_BYTES, readNames } from "./src/board.ts";
import { CATALOGUE } from "./src/catalogue.ts";
import { pack } from "./src/link.ts";
import type { Part } from "./src/parts.ts";
import { PICTURE } from "./src/pieces.ts";
import { layOut } from "./src/placed.ts";
import { thumbnail } from "./src/svg.ts";
import { readTape } from "./src/tape.ts";

const OUT = "web/dist";
/** Programs in other languages are translated when the page is built: by which command of skg. */
const TRANSLATORS: Record<string, string> = { ".xy": "xy", ".tkh": "tekhtran" };
const SKG = process.env["SKG"] ?? ".venv/bin/skg";

const common: BuildOptions = {
  bundle: true,
  minify: true,
  target: "es2022",
  charset: "utf8",
  legalComments: "none",
  logLevel: "warning",
};

function programOf(path: string, ending: string): string {
  const command = TRANSLATORS[ending];
  return command ? execFileSync(SKG, [command, path], { encoding: "latin1" }) : readFileSync(path, "latin1");
}

/** What the machine lists once it has loaded a program. */
async function lister(): Promise<(program: string) => string> {
  const code = await WebAssembly.compile(readFileSync("web/wasm/board.wasm"));
  const board = await Board.create(code, readFileSync("roms/skg.bin"), readNames(readFileSync("roms/skg.sym", "latin1")));
  const type = (line: string): void => {
    board.type(bytesOf(line));
    while (board.run(1_000_000) !== "prompt");
    if (/ERR/.test(ascii(board.takePaper()))) throw new Error(`the machine does not take ${line}`);
  };
  type("\r");
  return (program) => {
    type("NEW\r");
    board.tape(bytesOf(program));
    type("LOAD\r");
    return board.list(board.save());
  };
}

/** All of examples/: those with a tape and a program that the standard ROM runs. */
async function parts(): Promise<Part[]> {
  const list = await lister();
  const files = readdirSync("examples").sort();
  return files
    .filter((file) => file.endsWith(".3b"))
    .flatMap((tape) => {
      const name = basename(tape, ".3b");
      const ending = [".skg", ...Object.keys(TRANSLATORS)].find((each) => files.includes(name + each));
      if (!ending) return [];
      const program = programOf(join("examples", name + ending), ending);
      const { items } = readTape(readFileSync(join("examples", tape), "latin1"));
      const listed = list(program);
      return [{ name, program, picture: thumbnail(layOut(items).layout, 64), ...(listed === program ? {} : { listed }) }];
    });
}

/** A page made of a file of docs/, and the words around it. */
interface Page {
  source: string;
  language: string;
  title: string;
}

/** The words around a page, by its language. */
const AROUND: Record<string, { back: string; attempt: string; attemptName: string }> = {
  en: { back: "SKG in the browser", attempt: "try", attemptName: "try this program in the machine" },
  "zh-CN": { back: "浏览器中的 SKG", attempt: "运行", attemptName: "在机器上运行这个程序" },
};

/** The pages that stand beside the machine, too, by their names; `about` fits on a screen. */
const PAGES: Record<string, Page> = {
  "manual.html": { source: "docs/manual.md", language: "en", title: "The SKG language" },
  "manual.zh.html": { source: "docs/zh/manual.md", language: "zh-CN", title: "SKG 语言" },
  "about.html": { source: "docs/about.md", language: "en", title: "What is SKG?" },
  "about.zh.html": { source: "docs/zh/about.md", language: "zh-CN", title: "SKG 是什么？" },
};

/** Pages that these lead to. They are not kept for visits without a network, and not in skg.html. */
const FARTHER: Record<string, Page> = {
  "shop.html": { source: "docs/shop.md", language: "en", title: "From a drawing to a cut part" },
  "shop.zh.html": { source: "docs/zh/shop.md", language: "zh-CN", title: "从图纸到零件" },
  "pico.html": { source: "docs/pico.md", language: "en", title: "The machine on a Raspberry Pi Pico" },
  "pico.zh.html": { source: "docs/zh/pico.md", language: "zh-CN", title: "用 Raspberry Pi Pico 当机器" },
};

/** Where a link of docs/ leads in the pages: an example runs, a page that is there opens; others are words. */
function addressOf(href: string, source: string): string | undefined {
  if (/^(#|https?:)/.test(href)) return href;
  const example = /examples\/([\w-]+)\.skg$/.exec(href)?.[1];
  if (example) return `./#part=${example}&run`;
  const file = join(dirname(source), href.replace(/#.*/, ""));
  const found = Object.entries({ ...PAGES, ...FARTHER }).find(([, page]) => page.source === file)?.[0];
  return found && found + (/#.*/.exec(href)?.[0] ?? "");
}

/** The ROM's bytes by what they are for; the table is that of docs/firmware.md. */
const USES: readonly (readonly [english: string, chinese: string, files: string])[] = [
  ["arithmetic", "算术", "float decimal calc ops consts value round"],
  ["points, lines, circles", "点、直线、圆", "geom"],
  ["the language, the editor", "语言、编辑", "parser lexer program data run monitor words"],
  ["cutting", "切割", "route corner cut ends repeat"],
  ["smooth curves", "光滑曲线", "fit tol"],
  ["tape, board", "纸带、单板机", ""],
  ["free", "空余", "free"],
];

/** A bar of all bytes, and its words below. */
function bytesBar(language: string): string {
  const table = /```bytes\n([^]*?)```/.exec(readFileSync("docs/firmware.md", "utf8"))?.[1] ?? "";
  const rows = [...table.matchAll(/^ *(\w+)\.asm +(\d+)/gm)].map(([, file = "", bytes]) => [file, Number(bytes)] as const);
  const free = Number(/free +(\d+)/.exec(table)?.[1]);
  const named = new Set(USES.flatMap(([, , files]) => files.split(" ")));
  const sums = USES.map(([, , files]) => {
    if (files === "free") return free;
    const wanted = files.split(" ");
    return rows.filter(([file]) => (files ? wanted.includes(file) : !named.has(file))).reduce((sum, [, bytes]) => sum + bytes, 0);
  });
  if (sums.reduce((sum, bytes) => sum + bytes, 0) !== ROM_BYTES)
    throw new Error(`docs/firmware.md: ${sums} are not the ROM's bytes`);
  let at = 0;
  const bars = sums.map((bytes, use) => {
    at += bytes;
    return `<rect class="u${use}" x="${at - bytes}" width="${bytes}" height="400"/>`;
  });
  const words = USES.map(
    ([english, chinese], use) => `<li class="u${use}"><b>${sums[use]}</b> ${language === "en" ? english : chinese}</li>`,
  );
  return `<svg class="bytes" viewBox="0 0 ${ROM_BYTES} 400" preserveAspectRatio="none" aria-hidden="true">${bars.join("")}</svg><ul class="bytes">${words.join("")}</ul>`;
}

/** A page of docs/; behind every program of it stands a link that runs it. */
async function pageOf({ source, language, title }: Page): Promise<string> {
  const { back, attempt, attemptName } = AROUND[language] as (typeof AROUND)[string];
  const text = readFileSync(source, "utf8");
  const links = new Map<string, string>();
  for (const [, program = ""] of text.matchAll(/^```skg.*\n([^]*?)^```$/gm)) {
    links.set(program.trim(), `./#z=${await pack(program)}&run`);
  }
  const slug = (heading: string): string =>
    heading
      .toLowerCase()
      .replace(/<[^>]*>|&[a-z]+;|[^\p{L}\p{N} _-]/gu, "")
      .trim()
      .replace(/ /g, "-");
  const escaped = (code: string): string => code.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");
  const pages = new Marked({
    renderer: {
      code({ text: code, lang }) {
        const link = links.get(code.trim());
        const run =
          (lang ?? "").startsWith("skg") && link
            ? `<p class="try"><a href="${link}" aria-label="${attemptName}">${attempt}</a></p>`
            : "";
        return `<pre tabindex="0"><code>${escaped(code)}</code></pre>\n${run}`;
      },
      heading({ tokens, depth, text: heading }) {
        return `<h${depth} id="${slug(heading)}">${this.parser.parseInline(tokens)}</h${depth}>\n`;
      },
      link({ href, tokens }) {
        const inside = this.parser.parseInline(tokens);
        const address = addressOf(href, source);
        return address ? `<a href="${address}">${inside}</a>` : inside;
      },
      image({ href, text: name }) {
        const picture = basename(href);
        copyFileSync(join(dirname(source), href), join(OUT, picture));
        return `<img src="${picture}" alt="${escaped(name)}" loading="lazy">`;
      },
      html({ text: html }) {
        return html.includes("<!-- bytes -->") ? bytesBar(language) : html;
      },
    },
  });
  const body = await pages.parse(text);
  const isAbout = basename(source) === "about.md";
  // (a section of what fits on a screen is one of its columns' pieces)
  const content = isAbout ? body.replace(/<h2[^]*?(?=<h2|$)/g, (section) => `<section>${section}</section>`) : body;
  return `<!doctype html>
<html lang="${language}"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'self'; img-src 'self'; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1"><title>${title}</title>
<link rel="icon" href="icon.svg" type="image/svg+xml"><link rel="stylesheet" href="manual.css"></head>
<body${isAbout ? ' class="about"' : ""}><nav><a href="./">${back}</a></nav><main>${content}</main></body></html>
`;
}

/** The card of the page itself. */
const CARD: Card = {
  title: "SKG: a numerical-control language of 1983, in your browser",
  description: "Cut a part by wire: write a few lines of geometry, and the 8080 of 1983 computes each block.",
  address: "./",
  picture: "part-wrench.png",
};

/** For each part an address with a card: its title and picture. Who follows it comes to the part. */
function writeCards(found: readonly Part[]): void {
  const titles = new Map(CATALOGUE.flatMap((group) => group.parts.map(({ name, title }) => [name, title[0]] as const)));
  for (const { name } of found) {
    const { items } = readTape(readFileSync(join("examples", `${name}.3b`), "latin1"));
    writeFileSync(join(OUT, `part-${name}.png`), pictureOf(layOut(items).layout));
    const card = { ...CARD, title: `${titles.get(name)}: SKG`, address: `part-${name}.html`, picture: `part-${name}.png` };
    const page = `<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>SKG</title><link rel="icon" href="icon.svg" type="image/svg+xml">
<meta http-equiv="refresh" content="0; url=./#part=${name}&amp;run"></head>
<body><p><a href="./#part=${name}&amp;run">${titles.get(name)}</a></p></body></html>
`;
    writeFileSync(join(OUT, `part-${name}.html`), withCard(page, card));
  }
}

/** Every part has its place in the catalogue. */
function compare(found: string[], listed: string[]): void {
  const odd = [...found, ...listed].filter(
    (name) => !found.includes(name) || listed.filter((each) => each === name).length !== 1,
  );
  if (odd.length) throw new Error(`web/src/catalogue.ts and examples/ differ: ${[...new Set(odd)].join(" ")}`);
}

const WASM = ["board.wasm", "walk.wasm", "inside.wasm"];
const LESSONS = ["lessons.md", "lessons.zh.md"];

/** The files inside the one file, in base64; with the pictures of the manuals. */
const INSIDE = ["worker.js", ...WASM, "skg.bin", "skg.sym", "parts.json", ...LESSONS, ...Object.keys(PAGES)];

/** The whole page as one file, skg.html: it runs from a double click, too. */
async function oneFile(): Promise<void> {
  const bundle = await build({ ...common, format: "iife", entryPoints: ["web/src/main.ts"], write: false, outdir: OUT });
  const script = (bundle.outputFiles[0]?.text ?? "").replace(/<\/script/g, "<\\/script");
  const style = readFileSync(join(OUT, "style.css"), "utf8");
  const icon = readFileSync(join(OUT, "icon.svg")).toString("base64");
  const manuals = Object.fromEntries(Object.keys(PAGES).map((file) => [file, manualAlone(file)]));
  const pictures = new Set(Object.values(manuals).flatMap((text) => [...text.matchAll(PICTURE)].map(([, file = ""]) => file)));
  const pieces = [...INSIDE, ...pictures].map((file) => {
    const text = manuals[file];
    const bytes = text === undefined ? readFileSync(join(OUT, file)) : Buffer.from(text);
    return `<script type="application/octet-stream" data-file="${file}">${bytes.toString("base64")}</script>`;
  });
  const hash = createHash("sha256").update(script).digest("base64");
  const page = readFileSync("web/src/index.html", "utf8")
    .replace(
      /content="default-src[^"]*"/,
      () =>
        `content="default-src 'none'; script-src 'sha256-${hash}' blob: 'wasm-unsafe-eval'; worker-src blob:; connect-src blob: data:; style-src 'unsafe-inline'; img-src data: blob:; frame-src 'self' blob:; base-uri 'none'; form-action 'none'"`,
    )
    .replace(/<link rel="icon"[^>]*>/, () => `<link rel="icon" href="data:image/svg+xml;base64,${icon}">`)
    .replace(/<link rel="manifest"[^>]*>\n/, "")
    .replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${style}</style>`)
    .replace(/<script type="module"[^>]*><\/script>\n/, "")
    .replace("</body>", () => `${pieces.join("\n")}\n<script>${script}</script>\n</body>`);
  writeFileSync(join(OUT, "skg.html"), page);
}

/** A manual with its style in itself. */
function manualAlone(file: string): string {
  const style = readFileSync(join(OUT, "manual.css"), "utf8");
  return readFileSync(join(OUT, file), "utf8")
    .replace(/<a href="([\w.]+\.html)[^"]*">(.*?)<\/a>/g, (link, to: string, words: string) => (FARTHER[to] ? words : link))
    .replace(/<meta http-equiv[^>]*>\n/, "")
    .replace(/<link rel="icon"[^>]*>/, "")
    .replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${style}</style>`);
}

/** The licences of the packages that are in the page's files. */
function notices(bundles: BuildResult[]): string {
  const inputs = bundles.flatMap(({ metafile }) => Object.keys(metafile?.inputs ?? {}));
  const folders = new Set(inputs.map((file) => /^.*node_modules\/(?:@[^/]+\/)?[^/]+/.exec(file)?.[0]).filter((file) => file));
  const parts = [...folders].sort().map((folder = "") => {
    const { name, version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find((each) => /^licen[cs]e/i.test(each));
    if (!file) throw new Error(`${name} brings no licence along`);
    return {
      row: `  ${name} ${version}: ${license}`,
      text: `\n${name} ${version}\n\n${readFileSync(join(folder, file), "utf8")}`,
    };
  });
  // (inside.wasm: wasi-libc itself is in the public domain, its stdio is musl's)
  parts.push({ row: "  musl, in wasi-libc: MIT", text: `\nmusl\n\n${readFileSync("release/notices/musl.txt", "utf8")}` });
  const rows = parts.map(({ row }) => row).join("\n");
  return `This page holds these works of others, under their licences:\n\n${rows}\n${parts.map(({ text }) => text).join("")}`;
}

async function main(): Promise<void> {
  rmSync(OUT, { recursive: true, force: true });
  mkdirSync(OUT, { recursive: true });
  if (readFileSync("roms/skg.bin").length !== ROM_BYTES) throw new Error(`roms/skg.bin has not ${ROM_BYTES} bytes`);
  readNames(readFileSync("roms/skg.sym", "latin1")); // (says what is missing)
  for (const file of ["skg.bin", "skg.sym"]) copyFileSync(join("roms", file), join(OUT, file));
  for (const wasm of WASM) copyFileSync(join("web/wasm", wasm), join(OUT, wasm));
  for (const file of ["icon.svg", "manual.css", ...LESSONS]) copyFileSync(join("web/src", file), join(OUT, file));
  writeFileSync(join(OUT, "index.html"), withCard(readFileSync("web/src/index.html", "utf8"), CARD));
  writeFileSync(
    join(OUT, "manifest.webmanifest"),
    JSON.stringify({
      name: "SKG",
      short_name: "SKG",
      start_url: "./",
      display: "standalone",
      background_color: "#f4f4f1",
      theme_color: "#0b5394",
      icons: [{ src: "icon.svg", sizes: "any", type: "image/svg+xml" }],
    }),
  );
  const found = await parts();
  compare(
    found.map(({ name }) => name),
    CATALOGUE.flatMap((group) => group.parts.map(({ name }) => name)),
  );
  writeFileSync(join(OUT, "parts.json"), JSON.stringify(found));
  for (const [file, one] of Object.entries(PAGES)) writeFileSync(join(OUT, file), await pageOf(one));
  const entryPoints = ["web/src/main.ts", "web/src/style.css"];
  const bundles = [
    await build({ ...common, format: "esm", splitting: true, entryPoints, outdir: OUT, chunkNames: "[name]", metafile: true }),
    await build({ ...common, format: "iife", entryPoints: ["web/src/worker.ts"], outdir: OUT, metafile: true }),
  ];
  // (behind the list of what is kept for visits without a network: it is for those who take it away)
  const files = readdirSync(OUT).sort();
  const hash = createHash("sha256");
  for (const file of files) hash.update(file).update(readFileSync(join(OUT, file)));
  await build({
    ...common,
    format: "iife",
    entryPoints: ["web/src/offline.ts"],
    outdir: OUT,
    define: { FILES: JSON.stringify(["./", ...files]), VERSION: JSON.stringify(hash.digest("hex").slice(0, 12)) },
  });
  await oneFile();
  for (const [file, one] of Object.entries(FARTHER)) writeFileSync(join(OUT, file), await pageOf(one));
  writeCards(found);
  writeFileSync(join(OUT, "NOTICES.txt"), notices(bundles));
  if (!existsSync(join(OUT, "main.js"))) throw new Error("no main.js");
}

await main();
