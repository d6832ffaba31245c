/** Pointers on the canvas: what they point at, choose, drag, and ask the menu of. */
import { type Grabbed, listenTo } from "../gestures.ts";
import type { XY } from "../tape.ts";
import type { Canvas } from "./canvas.ts";
import type { Desk } from "./desk.ts";
import { micrometres, millimetres, nearest, type Shape, touches } from "./geometry.ts";
import { dragged, type Handle } from "./handles.ts";

/** A pointer finds a contour within so many pixels, a handle within so many; a finger is thicker: 44 across. */
const REACH = 10;
const GRIP = 14;
const FINGER = 22;
/** A box of fewer pixels is none. */
const STILL = 4;

export function listenToPointers(element: HTMLCanvasElement, canvas: Canvas, desk: Desk): void {
  const { view, overlay } = canvas;

  /** The contour that is nearest to a pixel. */
  const find = (pixel: XY, reach: number): number | undefined => {
    const place = view.toPlace(pixel);
    let best = reach / view.scale;
    let found: number | undefined;
    for (const shape of desk.shapes.values()) {
      const [left, bottom, right, top] = shape.box;
      if (place[0] < left - best || place[0] > right + best || place[1] < bottom - best || place[1] > top + best) continue;
      const { distance } = nearest(shape, place);
      if (distance >= best) continue;
      best = distance;
      found = shape.contour.id;
    }
    return found;
  };

  /** `more`: what is chosen already stays, or goes when it is meant. */
  const choose = (id: number | undefined, more: boolean): void => {
    overlay.place = undefined;
    const { chosen } = desk;
    if (id === undefined) {
      if (!more) desk.choose("all");
      return;
    }
    const after = !more ? [id] : chosen.includes(id) ? chosen.filter((each) => each !== id) : [...chosen, id];
    desk.choose({ contours: after });
  };

  /** A box chooses what lies in it, all of it; drawn to the left, also what it touches. */
  const boxed = (from: XY, event: PointerEvent): Grabbed => {
    const more = event.ctrlKey || event.metaKey ? desk.chosen : [];
    let to = from;
    return {
      move: (now) => {
        to = now;
        canvas.box = [from, to];
      },
      end: (isKept) => {
        canvas.box = undefined;
        if (!isKept) return;
        if (Math.hypot(to[0] - from[0], to[1] - from[1]) < STILL) choose(find(from, REACH), event.shiftKey || more.length > 0);
        else desk.choose({ contours: [...new Set([...more, ...within(from, to)])] });
      },
    };
  };

  const within = (from: XY, to: XY): number[] => {
    const [x0, y0] = view.toPlace([Math.min(from[0], to[0]), Math.max(from[1], to[1])]);
    const [x1, y1] = view.toPlace([Math.max(from[0], to[0]), Math.min(from[1], to[1])]);
    const isTouching = to[0] < from[0];
    const isWithin = ({ box: [left, bottom, right, top] }: Shape): boolean =>
      left >= x0 && right <= x1 && bottom >= y0 && top <= y1;
    return [...desk.shapes.values()]
      .filter((shape) => (isTouching ? touches(shape, [x0, y0, x1, y1], view.scale) : isWithin(shape)))
      .map(({ contour }) => contour.id);
  };

  const grab = (pixel: XY, event: PointerEvent): Grabbed | undefined => {
    if (canvas.isMeasuring) return undefined;
    if (canvas.isBoxing || event.shiftKey) return boxed(pixel, event);
    const distance = ({ place }: Handle): number => {
      const [x, y] = view.toPixel(place);
      return Math.hypot(x - pixel[0], y - pixel[1]);
    };
    const reach = event.pointerType === "touch" ? FINGER : GRIP;
    const [handle] = canvas.handles.filter((each) => distance(each) <= reach).sort((one, two) => distance(one) - distance(two));
    if (!handle) return undefined;
    const joined = `drag ${handle.grip} ${event.timeStamp}`;
    return {
      move: (now) => {
        const wanted = dragged(desk, handle, view.toPlace(now), REACH / view.scale);
        const place = wanted?.start ?? wanted?.entry;
        canvas.drag = { ...handle, place: place ? micrometres(place) : view.toPlace(now) };
        canvas.want(handle, wanted, joined);
      },
      end: () => {
        desk.endJoined();
        void desk.settle().then(() => {
          canvas.drag = undefined;
        });
      },
    };
  };

  listenTo(element, {
    pan: (dx, dy) => canvas.pan(dx, dy),
    zoom: (by, about) => canvas.zoom(by, about),
    grab,
    hover: (pixel, isPressed) => {
      canvas.onPoint(pixel && millimetres(view.toPlace(pixel)));
      if (!isPressed) canvas.hover(pixel && find(pixel, REACH));
    },
    tap: (pixel, event) => {
      if (canvas.isMeasuring) {
        canvas.measure(view.toPlace(pixel), (event.pointerType === "touch" ? FINGER : REACH) / view.scale);
        return;
      }
      const id = find(pixel, event.pointerType === "touch" ? FINGER : REACH);
      choose(id, event.shiftKey || event.ctrlKey || event.metaKey);
    },
    hold: (pixel, event) => {
      const id = find(pixel, FINGER);
      if (id === undefined) return;
      if (!desk.chosen.includes(id)) choose(id, false);
      canvas.onMenu(id, event.clientX, event.clientY);
    },
  });
  element.addEventListener("dblclick", () => canvas.fit());
}
