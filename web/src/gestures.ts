/** Pointers and wheel on a canvas: pan, zoom, tap, hold, and dragging something on it. */
import type { XY } from "./tape.ts";

/** Something that a pointer has taken hold of. */
export interface Grabbed {
  move(pixel: XY): void;
  /** `isKept`: false when the pointer was taken away. */
  end(isKept: boolean): void;
}

export interface Gestured {
  pan(dx: number, dy: number): void;
  zoom(by: number, about: XY): void;
  /** A pointer is here; undefined: it has left. */
  hover(pixel: XY | undefined, isPressed: boolean): void;
  /** It was pressed and lifted at one place. */
  tap(pixel: XY, event: PointerEvent): void;
  /** It is pressed on something that is to follow it. */
  grab?(pixel: XY, event: PointerEvent): Grabbed | undefined;
  /** A finger stays at one place, or the other button is pressed. */
  hold?(pixel: XY, event: MouseEvent): void;
}

/** A pointer that moves by less stays at its place, pixels. */
const STILL = 3;
/** A finger holds after so long, ms. */
const HOLD = 500;

export function listenTo(canvas: HTMLCanvasElement, on: Gestured): void {
  const pointers = new Map<number, XY>();
  const grabbed = new Map<number, Grabbed>();
  let hasMoved = false;
  let holding = 0;
  const pixelOf = (event: MouseEvent): XY => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };

  /** One pointer pans; two zoom and pan. */
  const drag = (id: number, before: XY, now: XY): void => {
    if (Math.hypot(now[0] - before[0], now[1] - before[1]) < STILL && !hasMoved) return;
    hasMoved = true;
    clearTimeout(holding);
    const other = [...pointers].find(([each]) => each !== id)?.[1];
    pointers.set(id, now);
    if (!other) {
      on.pan(now[0] - before[0], now[1] - before[1]);
      return;
    }
    const [was, is] = [before, now].map(([x, y]) => Math.max(1, Math.hypot(x - other[0], y - other[1]))) as [number, number];
    on.pan((now[0] - before[0]) / 2, (now[1] - before[1]) / 2);
    on.zoom(is / was, [(now[0] + other[0]) / 2, (now[1] + other[1]) / 2]);
  };

  const lift = (event: PointerEvent): void => {
    clearTimeout(holding);
    const held = grabbed.get(event.pointerId);
    grabbed.delete(event.pointerId);
    held?.end(event.type === "pointerup");
    if (!pointers.delete(event.pointerId) || held || hasMoved) return;
    on.tap(pixelOf(event), event);
  };

  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const lines = event.deltaMode ? event.deltaY * 30 : event.deltaY;
      on.zoom(Math.exp(-Math.max(-300, Math.min(300, lines)) / 400), pixelOf(event));
    },
    { passive: false },
  );
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button && on.hold) return;
    canvas.setPointerCapture(event.pointerId);
    const pixel = pixelOf(event);
    pointers.set(event.pointerId, pixel);
    hasMoved = false;
    const held = pointers.size === 1 ? on.grab?.(pixel, event) : undefined;
    if (held) grabbed.set(event.pointerId, held);
    clearTimeout(holding);
    if (event.pointerType !== "touch" || held || pointers.size > 1 || !on.hold) return;
    holding = window.setTimeout(() => {
      hasMoved = true;
      on.hold?.(pixel, event);
    }, HOLD);
  });
  canvas.addEventListener("pointermove", (event) => {
    const now = pixelOf(event);
    const before = pointers.get(event.pointerId);
    const held = grabbed.get(event.pointerId);
    if (held) held.move(now);
    else if (before) drag(event.pointerId, before, now);
    on.hover(now, before !== undefined);
  });
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("pointerleave", () => on.hover(undefined, false));
  canvas.addEventListener("contextmenu", (event) => {
    if (!on.hold) return;
    event.preventDefault();
    if ((event as PointerEvent).pointerType !== "touch") on.hold(pixelOf(event), event);
  });
}
