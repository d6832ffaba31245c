/** A web server for web/dist, as any is: files, their types, and nothing else. */
import { readFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { gzipSync } from "node:zlib";

const TYPES: Record<string, string> = {
  html: "text/html; charset=utf-8",
  js: "text/javascript",
  css: "text/css",
  json: "application/json",
  wasm: "application/wasm",
  svg: "image/svg+xml",
  webmanifest: "application/manifest+json",
};

/** Nothing takes so long but what hangs, ms: a test waits for what it wants to see, however busy the machine is. */
export const PATIENCE = Number(process.env["PATIENCE"] ?? 180_000);
/** The same of all tests of a file. */
export const WHOLE = 2_400_000;

export interface Served {
  url: string;
  /** Bytes of each file asked for since it was last emptied, gzipped. */
  sent: Map<string, number>;
  /** Files that are served with another text than that of the folder. */
  changed: Map<string, string>;
  /** Nobody gets through to it, or may again. */
  cut(isCut: boolean): void;
  stop(): Promise<void>;
}

/** Serves the page from a folder of its own. */
export async function serve(folder = "web/dist"): Promise<Served> {
  const sent = new Map<string, number>();
  const changed = new Map<string, string>();
  const server: Server = createServer((request, response) => {
    const name = (request.url ?? "").replace(/^\/[\w/]*\//, "").replace(/[?#].*/, "") || "index.html";
    try {
      if (/[/\\]/.test(name)) throw new Error(name);
      const bytes = Buffer.from(changed.get(name) ?? readFileSync(`${folder}/${name}`));
      sent.set(name, gzipSync(bytes, { level: 9 }).length);
      response.writeHead(200, { "content-type": TYPES[name.split(".").at(-1) ?? ""] ?? "application/octet-stream" });
      response.end(bytes);
    } catch {
      response.writeHead(404);
      response.end();
    }
  });
  let isCut = false;
  server.on("connection", (socket) => isCut && socket.destroy());
  await new Promise<void>((started) => server.listen(0, "127.0.0.1", started));
  return {
    url: `http://127.0.0.1:${(server.address() as AddressInfo).port}/some/folder/`,
    sent,
    changed,
    cut(wanted) {
      isCut = wanted;
      if (isCut) server.closeAllConnections();
    },
    stop: () =>
      new Promise((stopped) => {
        server.close(() => stopped());
        server.closeAllConnections();
      }),
  };
}

/** A tape of 200 blocks a row, lines and half circles, row upon row: 1 mm high each. */
export function longTape(count = 100): string {
  const rows: string[] = [];
  for (let row = 0; row < count; row++) {
    const pair = row % 2 ? ["B500B0B500GXL3", "B250B0B500GYNR1"] : ["B500B0B500GXL1", "B250B0B500GYSR2"];
    rows.push(...Array.from({ length: 99 }, () => pair).flat(), "B0B500B500GYL2", "B0B500B500GYL2");
  }
  return `${rows.join("\r\n")}\r\nDD\r\n`;
}
