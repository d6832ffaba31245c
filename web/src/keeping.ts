/** Sees to it that no work is lost without a word: of two tabs, and where the browser keeps nothing. */
import { t } from "./language.ts";
import { warn } from "./message.ts";
import type { Store } from "./store.ts";
import type { Workbench } from "./workbench.ts";
import type { Works } from "./works.ts";

/** `changed`: another tab has written programs. */
export function keepSafe(bench: Workbench, store: Store, works: Works, changed: () => void): void {
  store.own(() => {
    bench.keepText();
    works.begin();
    warn(t("otherTab"), { label: t("keepHere"), take: () => store.ownAgain() });
  });
  store.watch(changed);
  // (the machine that is kept is another tab's: a text that is in no machine has its place among the programs)
  const leave = (): void => {
    if (!store.isMine) bench.keepText();
  };
  addEventListener("pagehide", leave);
  document.addEventListener("visibilitychange", () => {
    if (document.visibilityState === "hidden") leave();
  });
  addEventListener("beforeunload", (event) => {
    // (what would be kept only when the page is left may be refused then: it is kept now)
    bench.session.keep();
    leave();
    if (store.losesWorks || (store.isRefused && works.isOwn(bench.editor.text))) event.preventDefault();
  });
}
