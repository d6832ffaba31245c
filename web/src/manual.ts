/** The manual beside the page; its *try* links run in the machine here. */
import { get } from "./dom.ts";
import { t } from "./language.ts";
import { closePane, openPane } from "./pane.ts";
import { insidePage } from "./pieces.ts";
import { paintFrame } from "./theme.ts";

const frame = (): HTMLIFrameElement => get<HTMLIFrameElement>("manual-frame");

/** The manual in the page's language; `chapter`: at its heading. */
export function openManual(chapter = 0): void {
  openPane("manual-pane");
  const page = frame();
  const file = t("manualFile");
  const isThere = page.dataset["file"] === file;
  page.dataset["file"] = file;
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
  if (text === undefined) page.src = file;
  else page.srcdoc = text;
}

/** The page's language has changed. */
export function turnManual(): void {
  if (!get("manual-pane").hidden) openManual();
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
  }
}
