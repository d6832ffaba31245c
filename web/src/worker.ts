/** The worker in which the board runs: the page never waits for it, whatever is typed or pasted. */
import { type Order, Runner } from "./runner.ts";

const runner = new Runner((news) => postMessage(news));
addEventListener("message", (event: MessageEvent<Order>) => runner.hear(event.data));
