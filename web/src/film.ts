/** The drawing as a picture for the clipboard, and the walk as a short film, in what the browser can record. */
import { saveFile } from "./files.ts";
import { say } from "./message.ts";
import type { Layout } from "./placed.ts";

/** A film's length and how long its end is shown, ms; frames a second. */
const [LENGTH, END, RATE] = [6000, 1000, 30];
const KINDS = ["video/webm;codecs=vp9", "video/webm", "video/mp4"];

export interface Filmed {
  /** The drawing as it is seen now, on its paper. */
  picture(onto?: HTMLCanvasElement): HTMLCanvasElement;
  /** Puts the wire at a part of its way, 0 to 1, and draws it. */
  at(part: number): void;
  /** The present tape: another object is another tape. */
  readonly layout: Layout;
}

let isFilming = false;

/** Copies the picture; where the browser refuses that, it is a file. */
export async function copyPicture({ picture }: Pick<Filmed, "picture">, name: string): Promise<void> {
  const blob = await new Promise<Blob | null>((done) => picture().toBlob(done, "image/png"));
  if (!blob) return;
  try {
    await navigator.clipboard.write([new ClipboardItem({ "image/png": blob })]);
    say("copied");
  } catch {
    saveFile(`${name}.png`, blob);
  }
}

/** Records the wire's way from its start hole to its end, and saves it. */
export async function film(filmed: Filmed, name: string): Promise<void> {
  if (isFilming) return;
  const kind = globalThis.MediaRecorder && KINDS.find((each) => MediaRecorder.isTypeSupported(each));
  if (!kind) {
    say("noFilm");
    return;
  }
  isFilming = true;
  say("filming", LENGTH / 1000);
  const { layout } = filmed;
  filmed.at(0);
  const canvas = filmed.picture();
  const recorder = new MediaRecorder(canvas.captureStream(RATE), { mimeType: kind, videoBitsPerSecond: 4_000_000 });
  const pieces: Blob[] = [];
  recorder.addEventListener("dataavailable", ({ data }) => pieces.push(data));
  const isOver = new Promise((tell) => recorder.addEventListener("stop", tell));
  recorder.start();
  const began = performance.now();
  await new Promise<void>((done) => {
    const frame = (): void => {
      const passed = performance.now() - began;
      if (filmed.layout === layout) {
        filmed.at(Math.min(1, passed / LENGTH));
        filmed.picture(canvas);
      }
      if (filmed.layout === layout && passed < LENGTH + END) requestAnimationFrame(frame);
      else done();
    };
    frame();
  });
  recorder.stop();
  await isOver;
  isFilming = false;
  if (filmed.layout !== layout) {
    say("filmBroken", name);
    return;
  }
  const ending = kind.startsWith("video/webm") ? "webm" : "mp4";
  saveFile(`${name}.${ending}`, new Blob(pieces, { type: kind }));
  say("filmed", `${name}.${ending}`);
}
