// SKG on a Pico as its user has it: a chip, a host, programs at both lines.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { afterEach } from "node:test";
import { Chip, ROOT } from "./chip.mjs";
import { Host } from "./host.mjs";

// (a chip's run blocks node: between two tests it may print)
afterEach(() => new Promise((resolve) => setImmediate(resolve)));

/** An example's program and tape. */
export const part = (name) => readFileSync(new URL(`examples/${name}.skg`, ROOT), "latin1");
export const tape = (name) => readFileSync(new URL(`examples/${name}.3b`, ROOT), "latin1");
export const linesOf = (text) => text.split(/\r?\n/).filter((line) => line);

export class Board {
  /** At its first prompt, both lines open. `flash`: that of another board, whose power has gone. */
  constructor({ flash, rom, feed = 0, punch = true } = {}) {
    this.chip = new Chip(flash);
    this.host = new Host(this.chip);
    this.about = this.host.connect();
    if (punch) this.host.open(this.host.punch);
    this.host.open(this.host.tty);
    this.prompt();
    if (rom) this.type(`#ROM ${rom}`);
    if (feed !== undefined && !flash) this.type(`#FEED ${feed}`);
  }

  get paper() {
    return this.host.tty.received;
  }

  get tape() {
    return this.host.punch.received;
  }

  /** Runs until the paper ends with a prompt behind what has been seen so far; a gear of 600 blocks takes a minute of the chip. */
  prompt(from = 0, ms = 300000) {
    const done = () => this.paper.length > from && /[\n\x1a]>$/.test(this.paper) && !this.host.tty.sending.length;
    assert.ok(this.chip.run(ms, done), `no prompt: ${JSON.stringify(this.paper.slice(-200))}`);
  }

  /** Types a line at the prompt and runs up to the next one. Returns what was printed, without the line. */
  type(line, end = "\r") {
    const from = this.paper.length;
    this.host.send(this.host.tty, line + end);
    this.prompt(from);
    return this.paper.slice(from).replace(/^[^\n]*\n/, "").replace(/>$/, "");
  }

  /** Types a program's lines, at which nothing is printed. */
  program(text) {
    for (const line of linesOf(text)) assert.equal(this.type(line), "", line);
  }

  /** Nobody types, until what there is has been kept in the flash. */
  rest() {
    this.chip.wait(1100);
    this.chip.run(150);
  }

  /** The listing. */
  get listing() {
    return linesOf(this.type("LIST"));
  }

  /** Types a line; presses CR at each D; up to the prompt. The pen's time is waited for. */
  drive(line) {
    let from = this.paper.length;
    let { cutting } = this.chip;
    this.host.send(this.host.tty, line + "\r");
    for (;;) {
      const waits = () => this.paper.length > from && /\n(D\r?|>)$/.test(this.paper);
      const turned = () => cutting !== this.chip.cutting || waits();
      assert.ok(this.chip.run(30000, turned), this.paper.slice(-200));
      if (cutting !== this.chip.cutting) {
        ({ cutting } = this.chip);
        this.chip.wait(245);
        continue;
      }
      // (a D that nobody waits at is followed by more, CR first)
      from = this.paper.length;
      if (this.paper.endsWith(">")) return;
      if (!this.chip.run(3, () => this.paper.length > from)) this.host.send(this.host.tty, "\r");
    }
  }
}
