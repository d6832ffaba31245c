/** Cards for links: title, description and picture of a page, as messengers and networks read them. */
import { deflateSync } from "node:zlib";
import { extentOf, isLine, type Layout, type Placed, placeAt } from "./src/placed.ts";

export interface Card {
  title: string;
  description: string;
  /** Its address and its picture's, seen from the page. */
  address: string;
  picture: string;
}

const [WIDTH, HEIGHT, MARGIN] = [800, 420, 40];
/** Half the line's width, and how near to an arc its chords are: pixels. */
const [HALF, NEAR] = [1.75, 0.1];
const [PAPER, WIRE] = [
  [0xf4, 0xf4, 0xf1],
  [0x00, 0x68, 0xa8],
] as const;

/** A page with its card. Many readers want whole addresses: SKG_URL is the folder that the page will lie in. */
export function withCard(page: string, { title, description, address, picture }: Card): string {
  const base = process.env["SKG_URL"];
  const whole = (file: string): string => (base ? new URL(file, base.endsWith("/") ? base : `${base}/`).href : file);
  const escaped = (text: string): string => text.replace(/&/g, "&amp;").replace(/"/g, "&quot;").replace(/</g, "&lt;");
  const facts = {
    "og:type": "website",
    "og:title": title,
    "og:description": description,
    "og:url": whole(address),
    "og:image": whole(picture),
    "og:image:width": WIDTH,
    "og:image:height": HEIGHT,
    "twitter:card": "summary_large_image",
  };
  const lines = Object.entries(facts).map(([name, value]) => `<meta property="${name}" content="${escaped(String(value))}">\n`);
  return page.replace("</head>", () => `${lines.join("")}</head>`);
}

/** A tape's cut as a PNG. */
export function pictureOf(layout: Layout): Uint8Array {
  const cut = layout.blocks.filter(({ role }) => role === "cut");
  const [left, bottom, right, top] = extentOf(cut) ?? [0, 0, 1, 1];
  const scale = Math.min((WIDTH - 2 * MARGIN) / Math.max(right - left, 1), (HEIGHT - 2 * MARGIN) / Math.max(top - bottom, 1));
  const shade = new Uint8Array(WIDTH * HEIGHT);
  const pixel = ([x, y]: readonly [number, number]): [number, number] => [
    WIDTH / 2 + (x - (left + right) / 2) * scale,
    HEIGHT / 2 - (y - (bottom + top) / 2) * scale,
  ];
  for (const placed of cut) {
    const parts = partsOf(placed, scale);
    for (let part = 0; part < parts; part++) {
      stroke(shade, pixel(placeAt(placed, part / parts)), pixel(placeAt(placed, (part + 1) / parts)));
    }
  }
  return png(shade);
}

/** Chords of a block. */
function partsOf(placed: Placed, scale: number): number {
  if (isLine(placed)) return 1;
  const step = 2 * Math.acos(Math.max(0, 1 - NEAR / Math.max(placed.radius * scale, NEAR)));
  return Math.max(1, Math.ceil(Math.abs(placed.sweep) / step));
}

/** A line with soft edges: a pixel's shade is how much of it lies within. */
function stroke(shade: Uint8Array, [ax, ay]: [number, number], [bx, by]: [number, number]): void {
  const reach = HALF + 1;
  const [dx, dy] = [bx - ax, by - ay];
  const square = dx * dx + dy * dy;
  const clamp = (value: number, most: number): number => Math.max(0, Math.min(most, value));
  const [x0, x1] = [
    clamp(Math.floor(Math.min(ax, bx) - reach), WIDTH - 1),
    clamp(Math.ceil(Math.max(ax, bx) + reach), WIDTH - 1),
  ];
  const [y0, y1] = [
    clamp(Math.floor(Math.min(ay, by) - reach), HEIGHT - 1),
    clamp(Math.ceil(Math.max(ay, by) + reach), HEIGHT - 1),
  ];
  for (let y = y0; y <= y1; y++) {
    for (let x = x0; x <= x1; x++) {
      const part = square ? clamp(((x - ax) * dx + (y - ay) * dy) / square, 1) : 0;
      const inside = clamp(HALF + 0.5 - Math.hypot(x - ax - part * dx, y - ay - part * dy), 1);
      const at = y * WIDTH + x;
      shade[at] = Math.max(shade[at] ?? 0, Math.round(255 * inside));
    }
  }
}

/** A picture of 256 shades from paper to wire. */
function png(shade: Uint8Array): Uint8Array {
  const palette = Buffer.from(
    Array.from({ length: 256 }, (_, at) =>
      PAPER.map((paper, part) => Math.round(paper + (((WIRE[part] ?? 0) - paper) * at) / 255)),
    ).flat(),
  );
  const rows = Buffer.alloc((WIDTH + 1) * HEIGHT);
  for (let y = 0; y < HEIGHT; y++) rows.set(shade.subarray(y * WIDTH, (y + 1) * WIDTH), y * (WIDTH + 1) + 1);
  const header = Buffer.alloc(13);
  header.writeUInt32BE(WIDTH, 0);
  header.writeUInt32BE(HEIGHT, 4);
  header.set([8, 3, 0, 0, 0], 8); // 8 bits, by the palette
  return Buffer.concat([
    Buffer.from("\x89PNG\r\n\x1a\n", "latin1"),
    chunk("IHDR", header),
    chunk("PLTE", palette),
    chunk("IDAT", deflateSync(rows, { level: 9 })),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}

function chunk(kind: string, data: Buffer): Buffer {
  const body = Buffer.concat([Buffer.from(kind, "latin1"), data]);
  const around = Buffer.alloc(8);
  around.writeUInt32BE(data.length, 0);
  around.writeUInt32BE(crc(body), 4);
  return Buffer.concat([around.subarray(0, 4), body, around.subarray(4)]);
}

/** CRC-32 as PNG has it. */
function crc(bytes: Buffer): number {
  let value = 0xffffffff;
  for (const byte of bytes) {
    value ^= byte;
    for (let bit = 0; bit < 8; bit++) value = value & 1 ? (value >>> 1) ^ 0xedb88320 : value >>> 1;
  }
  return (value ^ 0xffffffff) >>> 0;
}
