/** Pages beside the machine, one at a time: the manual, and what this is; their links to programs run in the machine here. */
import { get } from "./dom.ts";
import { t, type Word } from "./language.ts";
import { closePane, openPane } from "./pane.ts";
import { insidePage } from "./pieces.ts";
import { paintFrame } from "./theme.ts";

/** The words that name the files of the two pages. */
export type Reading = Extract<Word, "manualFile" | "aboutFile">;

let reading: Reading = "manualFile";

const frame = (): HTMLIFrameElement => get<HTMLIFrameElement>("manual-frame");

/** The manual in the page's language; `chapter`: at its heading. */
export const openManual = (chapter = 0): void => openReading("manualFile", chapter);

export function openReading(word: Reading, chapter = 0): void {
  openPane("manual-pane");
  reading = word;
  const page = frame();
  const file = t(word);
  const isThere = page.dataset["file"] === file;
  page.dataset["file"] = file;
  page.title = t(word === "aboutFile" ? "about" : "manual");
  get<HTMLAnchorElement>("manual-alone").href = file;
  const show = (): void => {
    paintFrame(page);
    page.contentDocument?.querySelector(`[id^="${chapter}-"]`)?.scrollIntoView();
    page.contentDocument?.addEventListener("click", follow);
  };
  if (isThere) {
    show();
    return;
  }
  page.addEventListener("load", show, { once: true });
  const text = insidePage(file);
  if (text === undefined) {
    page.removeAttribute("srcdoc");
    page.src = file;
  } else page.srcdoc = text;
}

/** The page's language has changed. */
export function turnManual(): void {
  if (!get("manual-pane").hidden) openReading(reading);
}

/** A link to a program runs it in this page, and leaves the manual where it is; one to a heading goes there in skg.html, too,
 * where it would be a place of the page around the manual. */
function follow(event: MouseEvent): void {
  const link = (event.target as Element | null)?.closest?.("a");
  const href = link?.getAttribute("href") ?? "";
  if (href.startsWith("./#")) {
    event.preventDefault();
    // (the address may be there already: the link is followed all the same)
    if (location.hash === href.slice(2)) dispatchEvent(new HashChangeEvent("hashchange"));
    else location.hash = href.slice(2);
  } else if (href.startsWith("#")) {
    event.preventDefault();
    frame()
      .contentDocument?.getElementById(decodeURIComponent(href.slice(1)))
      ?.scrollIntoView();
  } else if (href === "./") {
    event.preventDefault();
    closePane();
  } else if (/^(manual|about)\b/.test(href)) {
    event.preventDefault();
    openReading(href.startsWith("about") ? "aboutFile" : "manualFile");
  } else if (link) {
    // (other pages are read in a window of their own)
    link.target = "_blank";
  }
}
