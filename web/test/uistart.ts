/** `skg ui` on drawings in folders of their own, for browsers to look at. */
import { type ChildProcess, execFileSync, spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const SKG = process.env["SKG"] ?? ".venv/bin/skg";
export const BRACKET = readFileSync("docs/pictures/bracket.dxf");

// (setups of whoever runs the tests are not theirs)
export const NO_SETUPS = join(tmpdir(), "skg-no-setups");
process.env["XDG_CONFIG_HOME"] = NO_SETUPS;

const left: (() => void)[] = [];

/** Ends what was started. */
export function endAll(): void {
  for (const end of left) end();
}

/** A drawing of lines, circles, and texts in DXF of 1988, without a header. */
export function dxf(...entities: readonly (readonly [string, Record<number, string | number>])[]): string {
  const pairs = entities.flatMap(([kind, values]) => [
    `0\n${kind}`,
    ...Object.entries(values).map(([code, value]) => `${code}\n${value}`),
  ]);
  return `${["0\nSECTION\n2\nENTITIES", ...pairs, "0\nENDSEC\n0\nEOF"].join("\n")}\n`;
}
export const circle = (x: number, y: number, r: number, layer = "PART") => ["CIRCLE", { 8: layer, 10: x, 20: y, 40: r }] as const;
export const line = (x0: number, y0: number, x1: number, y1: number, layer = "PART") =>
  ["LINE", { 8: layer, 10: x0, 20: y0, 11: x1, 21: y1 }] as const;
export const box = (x0: number, y0: number, x1: number, y1: number) => [
  line(x0, y0, x1, y0),
  line(x1, y0, x1, y1),
  line(x1, y1, x0, y1),
  line(x0, y1, x0, y0),
];
/** Circles in rows, 3 mm apart. */
export const field = (count: number): string =>
  dxf(...Array.from({ length: count }, (_, at) => circle(3 * (at % 200), 3 * Math.floor(at / 200), 1)));

export interface Started {
  readonly url: string;
  readonly folder: string;
  readonly process: ChildProcess;
  file(name: string): Buffer;
}

/** `skg ui` on a drawing in a folder of its own. */
export async function start(
  name = "bracket.dxf",
  data: Buffer | string = BRACKET,
  isNamed = true,
  beside: Readonly<Record<string, Buffer>> = {},
): Promise<Started> {
  const folder = mkdtempSync(join(tmpdir(), "skg-ui-"));
  writeFileSync(join(folder, name), data);
  for (const [other, bytes] of Object.entries(beside)) writeFileSync(join(folder, other), bytes);
  const child = spawn(SKG, ["ui", "--no-browser", ...(isNamed ? [join(folder, name)] : [])], {
    stdio: ["ignore", "pipe", "inherit"],
  });
  left.push(() => {
    child.kill();
    rmSync(folder, { recursive: true, force: true });
  });
  const url = await new Promise<string>((found, failed) => {
    let said = "";
    child.stdout?.on("data", (more) => {
      said += more;
      const match = /http:\S+/.exec(said);
      if (match) found(match[0]);
    });
    child.on("exit", (code) => failed(new Error(`skg ui ended with ${code}: ${said}`)));
  });
  return { url, folder, process: child, file: (each) => readFileSync(join(folder, each)) };
}

/** The tape that the command line makes of a drawing in a folder. */
export function cutByCommand(folder: string, name: string, ...options: string[]): Buffer {
  execFileSync(SKG, ["cut", join(folder, name), "-o", join(folder, "command.nodrift.3b"), ...options], { stdio: "pipe" });
  return readFileSync(join(folder, "command.nodrift.3b"));
}
