/** Makes the page of `skg ui`: three files in tools/skg/ui/assets, which are committed. `make ui-page` runs it at the
 * repository's top; a folder as its argument takes them instead. */
import { copyFileSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { build } from "esbuild";

const OUT = process.argv[2] ?? "tools/skg/ui/assets";

mkdirSync(OUT, { recursive: true });
copyFileSync("web/src/ui/index.html", join(OUT, "index.html"));
await build({
  bundle: true,
  minify: true,
  target: "es2022",
  charset: "utf8",
  legalComments: "none",
  logLevel: "warning",
  format: "esm",
  loader: { ".wasm": "binary" },
  entryPoints: { ui: "web/src/ui/main.ts" },
  outdir: OUT,
});
await build({ bundle: true, minify: true, logLevel: "warning", entryPoints: { ui: "web/src/ui/ui.css" }, outdir: OUT });
