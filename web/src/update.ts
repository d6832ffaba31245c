/** The page for visits without a network: registers its service worker, and says when a newer page is there. */
import { t } from "./language.ts";
import { warn } from "./message.ts";

export async function isUpdated(): Promise<void> {
  if (!("serviceWorker" in navigator) || location.protocol === "file:") return;
  const registration = await navigator.serviceWorker.register("offline.js", { updateViaCache: "none" }).catch(() => undefined);
  if (!registration) return;
  const offer = (worker: ServiceWorker | null): void => {
    // (the first one of all has no older page beside it)
    if (!worker || !navigator.serviceWorker.controller) return;
    warn(t("newVersion"), {
      label: t("reload"),
      take: () => {
        // (another tab may have fetched it already: it is no longer waiting)
        if (worker.state === "activated" || worker.state === "redundant") location.reload();
        worker.addEventListener("statechange", () => location.reload(), { once: true });
        worker.postMessage("come");
      },
    });
  };
  offer(registration.waiting);
  registration.addEventListener("updatefound", () => {
    const { installing } = registration;
    installing?.addEventListener("statechange", () => {
      if (installing.state === "installed") offer(installing);
    });
  });
}
