/** The service worker: the whole page is kept at the first visit and comes from there ever after. A new version is fetched whole
 * beside it, and takes its place when the visitor wants it or no page is open. FILES and VERSION are put in when the page is built. */
declare const FILES: readonly string[];
declare const VERSION: string;

export {}; // (a module: its names are its own)

const worker = self as unknown as ServiceWorkerGlobalScope;
const { pathname } = new URL("./", worker.location.href);
/** Each copy of the page has its own: two on one server leave each other alone. */
const OURS = `skg:${pathname}:`;
const NAME = OURS + VERSION;

worker.addEventListener("install", (event) => {
  event.waitUntil(
    (async () => {
      try {
        const cache = await caches.open(NAME);
        await cache.addAll(FILES.map((file) => new Request(file, { cache: "reload" })));
      } catch (error) {
        await caches.delete(NAME); // half a version is none
        throw error;
      }
    })(),
  );
});

worker.addEventListener("message", (event) => {
  if (event.data === "come") event.waitUntil(worker.skipWaiting());
});

/** A cache of before copies had names of their own: ours, when it holds our files. */
async function isOurs(name: string): Promise<boolean> {
  if (name.startsWith(OURS)) return name !== NAME;
  if (!/^skg-[0-9a-f]{12}$/.test(name)) return false;
  const kept = await (await caches.open(name)).keys();
  return kept.some(({ url }) => new URL(url).pathname === pathname);
}

worker.addEventListener("activate", (event) => {
  event.waitUntil(
    (async () => {
      for (const name of await caches.keys()) if (await isOurs(name)) await caches.delete(name);
      await worker.clients.claim();
    })(),
  );
});

worker.addEventListener("fetch", (event) => {
  if (event.request.method !== "GET" || new URL(event.request.url).origin !== worker.location.origin) return;
  event.respondWith(
    (async () => {
      const cache = await caches.open(NAME);
      const kept = await cache.match(event.request, { ignoreSearch: true });
      return kept ?? fetch(event.request);
    })(),
  );
});
