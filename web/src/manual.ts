/** The manual beside the page; its *try* links run in the machine here. */
import { get } from "./dom.ts";
import { insideText } from "./pieces.ts";

const frame = (): HTMLIFrameElement => get<HTMLIFrameElement>("manual-frame");

export function openManual(heading = ""): void {
  document.body.classList.add("reading");
  get("manual-pane").hidden = false;
  const text = insideText("manual.html");
  const page = frame();
  const isThere = page.dataset["open"] === "true";
  page.dataset["open"] = "true";
  const show = (): void => {
    page.contentDocument?.getElementById(heading)?.scrollIntoView();
    page.contentDocument?.addEventListener("click", follow);
  };
  if (isThere) {
    show();
    return;
  }
  page.addEventListener("load", show, { once: true });
  if (text === undefined) page.src = "manual.html";
  else page.srcdoc = text;
}

export function closeManual(): void {
  document.body.classList.remove("reading");
  get("manual-pane").hidden = true;
}

/** A link to a program runs it in this page, and leaves the manual where it is. */
function follow(event: MouseEvent): void {
  const link = (event.target as Element | null)?.closest?.("a");
  const href = link?.getAttribute("href") ?? "";
  if (href.startsWith("./#")) {
    event.preventDefault();
    location.hash = href.slice(2);
  } else if (href === "./") {
    event.preventDefault();
    closeManual();
  }
}
