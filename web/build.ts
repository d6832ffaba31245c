/** Makes web/dist: the page with ROM, examples and manual as they are now. `make web` runs it at the repository's top. */
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { type BuildOptions, build } from "esbuild";
import { Marked } from "marked";
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

/** A manual: its file in docs/, and the words around it. */
interface Manual {
  source: string;
  language: string;
  title: string;
  back: string;
  attempt: string;
  attemptName: string;
}

/** The manuals by the names of their pages. */
const MANUALS: Record<string, Manual> = {
  "manual.html": {
    source: "docs/manual.md",
    language: "en",
    title: "The SKG language",
    back: "SKG in the browser",
    attempt: "try",
    attemptName: "try this program in the machine",
  },
  "manual.zh.html": {
    source: "docs/zh/manual.md",
    language: "zh-CN",
    title: "SKG 语言",
    back: "浏览器中的 SKG",
    attempt: "运行",
    attemptName: "在机器上运行这个程序",
  },
};

/** A manual as a page; behind every program of it stands a link that runs it. */
async function manual({ source, language, title, back, attempt, attemptName }: Manual): Promise<string> {
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
        // (other pages of the repository are not in this one)
        return /^(#|https?:)/.test(href) ? `<a href="${href}">${inside}</a>` : inside;
      },
      image({ href, text: name }) {
        const picture = basename(href);
        copyFileSync(join(dirname(source), href), join(OUT, picture));
        return `<img src="${picture}" alt="${escaped(name)}" loading="lazy">`;
      },
    },
  });
  const body = await pages.parse(text);
  return `<!doctype html>
<html lang="${language}"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'self'; img-src 'self'; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1"><title>${title}</title>
<link rel="icon" href="icon.svg" type="image/svg+xml"><link rel="stylesheet" href="manual.css"></head>
<body><nav><a href="./">${back}</a></nav><main>${body}</main></body></html>
`;
}

/** Every part has its place in the catalogue. */
function compare(found: string[], listed: string[]): void {
  const odd = [...found, ...listed].filter(
    (name) => !found.includes(name) || listed.filter((each) => each === name).length !== 1,
  );
  if (odd.length) throw new Error(`web/src/catalogue.ts and examples/ differ: ${[...new Set(odd)].join(" ")}`);
}

/** The files inside the one file, in base64; with the pictures of the manuals. */
const INSIDE = ["worker.js", "board.wasm", "walk.wasm", "skg.bin", "skg.sym", "parts.json", ...Object.keys(MANUALS)];

/** The whole page as one file, skg.html: it runs from a double click, too. */
async function oneFile(): Promise<void> {
  const bundle = await build({ ...common, format: "iife", entryPoints: ["web/src/main.ts"], write: false, outdir: OUT });
  const script = (bundle.outputFiles[0]?.text ?? "").replace(/<\/script/g, "<\\/script");
  const style = readFileSync(join(OUT, "style.css"), "utf8");
  const icon = readFileSync(join(OUT, "icon.svg")).toString("base64");
  const manuals = Object.fromEntries(Object.keys(MANUALS).map((file) => [file, manualAlone(file)]));
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
    .replace(/<meta http-equiv[^>]*>\n/, "")
    .replace(/<link rel="icon"[^>]*>/, "")
    .replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${style}</style>`);
}

async function main(): Promise<void> {
  rmSync(OUT, { recursive: true, force: true });
  mkdirSync(OUT, { recursive: true });
  if (readFileSync("roms/skg.bin").length !== ROM_BYTES) throw new Error(`roms/skg.bin has not ${ROM_BYTES} bytes`);
  readNames(readFileSync("roms/skg.sym", "latin1")); // (says what is missing)
  for (const file of ["skg.bin", "skg.sym"]) copyFileSync(join("roms", file), join(OUT, file));
  for (const wasm of ["board.wasm", "walk.wasm"]) copyFileSync(join("web/wasm", wasm), join(OUT, wasm));
  for (const file of ["index.html", "icon.svg", "manual.css"]) copyFileSync(join("web/src", file), join(OUT, file));
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
  for (const [file, one] of Object.entries(MANUALS)) writeFileSync(join(OUT, file), await manual(one));
  const entryPoints = ["web/src/main.ts", "web/src/style.css"];
  await build({ ...common, format: "esm", splitting: true, entryPoints, outdir: OUT, chunkNames: "[name]" });
  await build({ ...common, format: "iife", entryPoints: ["web/src/worker.ts"], outdir: OUT });
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
  if (!existsSync(join(OUT, "main.js"))) throw new Error("no main.js");
}

await main();
