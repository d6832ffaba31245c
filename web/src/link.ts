/** Programs in links: `#z=…` carries one, compressed; `#part=…` names an example. `&run` runs it, `&embed` shows the small
 * form for other pages. */

export interface Link {
  program?: string;
  part?: string;
  /** A step of the lessons, from 1, and a teacher's file of them. */
  lesson?: number;
  lessons?: string;
  run: boolean;
  embed: boolean;
}

/** A link that is not whole. */
export class LinkError extends Error {}

/** No link carries more. */
export const MOST = 65536;

async function through(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream | DecompressionStream): Promise<Uint8Array> {
  const pipe = new Blob([bytes]).stream().pipeThrough(stream as ReadableWritablePair<Uint8Array, BufferSource>);
  const reader = pipe.getReader();
  const parts: Uint8Array[] = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > MOST) throw new LinkError("too long");
    parts.push(value);
  }
  const all = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

/** The text as it stands behind `z=`. */
export async function pack(text: string): Promise<string> {
  const bytes = await through(new TextEncoder().encode(text), new CompressionStream("deflate"));
  return btoa(String.fromCharCode(...bytes))
    .replace(/\+/g, "-")
    .replace(/\//g, "_")
    .replace(/=+$/, "");
}

/** The text behind `z=`; one that was cut short or changed is a LinkError. */
export async function unpack(code: string): Promise<string> {
  try {
    const bytes = Uint8Array.from(atob(code.replace(/-/g, "+").replace(/_/g, "/")), (c) => c.charCodeAt(0));
    // (zlib's form: a check sum stands at its end)
    const text = new TextDecoder("utf-8", { fatal: true }).decode(await through(bytes, new DecompressionStream("deflate")));
    if (!text.trim()) throw new LinkError("empty");
    return text;
  } catch {
    throw new LinkError("not whole");
  }
}

/** Reads the `#…` of an address. */
export async function readLink(hash: string): Promise<Link> {
  const fields = new URLSearchParams(hash.replace(/^#/, ""));
  const link: Link = { run: fields.has("run"), embed: fields.has("embed") };
  const code = fields.get("z");
  const part = fields.get("part");
  if (code !== null) link.program = await unpack(code);
  if (part) link.part = part;
  const [lesson, lessons] = [fields.get("lesson"), fields.get("lessons")];
  if (lesson !== null && !/^[1-9]\d{0,2}$/.test(lesson)) throw new LinkError("no step");
  if (lesson !== null) link.lesson = Number(lesson);
  if (lessons !== null) link.lessons = await unpack(lessons);
  return link;
}
