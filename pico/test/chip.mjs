// A Raspberry Pi Pico with SKG's .uf2 in its flash: rp2040js, a boot ROM of our own, and what is on the pins.
//
// The boot ROM is a stub: the routines that boot2.S and flash.c call, each a BKPT that JavaScript carries out. It looks at
// what it is asked for: flash that is written must have been erased, and left as memory before and after.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { RP2040 } from "rp2040js";

export const ROOT = new URL("../../", import.meta.url);
const FLASH = 0x10000000, FLASH_SIZE = 2 << 20, PAGE = 256, SECTOR = 4096;
const BOOT2_AT = 0x20041f00;
const NANOS_A_CYCLE = 8;
const ROUTINES = ["", "IF", "EX", "RE", "RP", "FC", "CX"];
const SECTOR_ERASE_NANOS = 45e6, PAGE_WRITE_NANOS = 0.7e6;

/** Thrown where the power goes: what was written so far is in the flash. */
export class PowerCut extends Error {}

/** The flash's bytes of a .uf2, each block looked at. */
export function fromUf2(bytes) {
  const flash = new Uint8Array(FLASH_SIZE).fill(0xff);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const word = (at) => view.getUint32(at, true);
  const count = bytes.length / 512;
  assert.ok(Number.isInteger(count) && count > 100);
  for (let i = 0; i < count; i++) {
    const at = 512 * i;
    const [, , flags, address, size, number, of, family] = Array.from({ length: 8 }, (_, k) => word(at + 4 * k));
    assert.deepEqual([word(at), word(at + 4), word(at + 508)], [0x0a324655, 0x9e5d5157, 0x0ab16f30]);
    assert.deepEqual([flags, address, size, number, of, family], [0x2000, FLASH + PAGE * i, PAGE, i, count, 0xe48bff56]);
    flash.set(bytes.subarray(at + 32, at + 32 + PAGE), PAGE * i);
  }
  return flash;
}

/** The boot ROM's sum (RP2040 data sheet 2.8.1.3.1). */
function bootSum(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte << 24;
    for (let i = 0; i < 8; i++) crc = crc & 0x80000000 ? (crc << 1) ^ 0x04c11db7 : crc << 1;
  }
  return crc >>> 0;
}

export class Chip {
  /** @param {Uint8Array} [flash] what the flash holds: it is the chip's, and keeps what is written; else the .uf2 */
  constructor(flash = fromUf2(readFileSync(new URL("build/pico/skg-pico.uf2", ROOT)))) {
    this.flash = flash;
    this.mcu = new RP2040();
    this.clock = this.mcu.clock;
    this.erased = 0; // sectors
    this.writes = 0; // pages and sectors, in this life
    this.cutAt = Infinity; // of these: in its middle the power goes
    this.isMemory = false; // the flash can be read
    this.warnings = [];
    this.mcu.logger = {
      debug() {},
      info() {},
      warn: (name, text) => this.warnings.push(`${name}: ${text}`),
      error: (name, text) => assert.fail(`${name}: ${text}`),
    };
    this.mcu.onBreak = (code) => this.#routine(code);
    this.mcu.flash.set(flash);
    this.#bootRom();
    this.#pins();
    const boot2 = flash.subarray(0, PAGE);
    assert.equal(bootSum(boot2.subarray(0, PAGE - 4)), new DataView(flash.buffer, PAGE - 4).getUint32(0, true));
    this.mcu.sram.set(boot2, BOOT2_AT - 0x20000000);
    this.mcu.core.PC = BOOT2_AT;
    this.mcu.core.SP = BOOT2_AT;
  }

  get nanos() {
    return this.clock.nanos;
  }

  /** Runs for so many milliseconds of the chip's, or until `done`, which is asked every 40 us; false: it never was. */
  run(ms, done = undefined, nanos = NANOS_A_CYCLE) {
    const { core } = this.mcu;
    const end = this.nanos + ms * 1e6;
    while (this.nanos < end) {
      for (let i = 0; i < 2500; i++) this.clock.tick(core.executeInstruction() * nanos);
      if (done?.()) return true;
    }
    return done === undefined;
  }

  /** Lets time pass while the chip has nothing to do but wait: its clock goes 40 times as fast as its instructions. */
  wait(ms, done = undefined) {
    return this.run(ms, done, 40 * NANOS_A_CYCLE);
  }

  #bootRom() {
    const rom = new Uint8Array(this.mcu.bootrom.buffer);
    const half = (at, value) => rom.set([value & 255, value >> 8], at);
    half(0x14, 0x1000); // the table: the stub's look-up does not read it
    half(0x18, 0x201);
    for (let i = 0; i < ROUTINES.length; i++) {
      half(0x200 + 4 * i, 0xbe00 | i); // BKPT i
      half(0x202 + 4 * i, 0x4770); // BX LR
    }
  }

  #routine(code) {
    const { registers } = this.mcu.core;
    const [offset, size] = registers;
    switch (ROUTINES[code]) {
      case "": {
        assert.equal(registers[0], 0x1000);
        const number = ROUTINES.indexOf(String.fromCharCode(registers[1] & 255, registers[1] >> 8));
        assert.ok(number > 0, "a routine that the stub has not");
        registers[0] = 0x201 + 4 * number;
        break;
      }
      case "EX":
        this.isMemory = false;
        break;
      case "CX":
        this.isMemory = true;
        break;
      case "RE":
        assert.ok(!this.isMemory && offset % SECTOR === 0 && size % SECTOR === 0 && size > 0);
        assert.ok(offset >= 1 << 20 && offset + size <= FLASH_SIZE, "not in the half that keeps");
        assert.deepEqual([registers[2], registers[3]], [0x10000, 0xd8]);
        for (let at = offset; at < offset + size; at += SECTOR) {
          this.#write(at, SECTOR, () => 0xff, SECTOR_ERASE_NANOS);
          this.erased++;
        }
        break;
      case "RP": {
        assert.ok(!this.isMemory && offset % PAGE === 0 && registers[2] === PAGE);
        assert.ok(offset >= 1 << 20 && offset + PAGE <= FLASH_SIZE, "not in the half that keeps");
        const from = registers[1] - 0x20000000;
        assert.ok(from >= 0 && from < this.mcu.sram.length, "the data must be in RAM");
        const data = this.mcu.sram.slice(from, from + PAGE);
        assert.ok(this.flash.subarray(offset, offset + PAGE).every((b) => b === 0xff), "written, and not erased before");
        this.#write(offset, PAGE, (i) => data[i], PAGE_WRITE_NANOS);
        break;
      }
    }
  }

  #write(offset, size, value, nanos) {
    const cut = ++this.writes >= this.cutAt;
    for (let i = 0; i < (cut ? size / 2 : size); i++) this.flash[offset + i] = value(i);
    if (cut) {
      this.flash[offset + size / 2] &= 0x5a; // a cell that is neither
      throw new PowerCut();
    }
    this.mcu.flash.set(this.flash.subarray(offset, offset + size), offset);
    this.clock.tick(nanos);
  }

  // ---- pins ----

  #pins() {
    const { gpio, qspi } = this.mcu;
    qspi[1].padValue = 0x5a; // as after reset; rp2040js has another value
    this.bootsel = false;
    this.stop = false;
    /** The port's value at each step, and when (ns): one value a rising edge of a step pin. */
    this.steps = [];
    this.stepTimes = [];
    /** Least time between a change of a direction and the step behind it, ns. */
    this.leastSetup = Infinity;
    const turned = [0, 0];
    const port = () => {
      const pins = this.mcu.sio.gpioValue;
      return ((pins >> 2) & 0x0f) | ((pins >> 6) & 1 ? 0x80 : 0);
    };
    for (const axis of [0, 1]) {
      gpio[3 + 2 * axis].addListener(() => (turned[axis] = this.nanos));
      gpio[2 + 2 * axis].addListener((state) => {
        if (state !== 1) return;
        this.leastSetup = Math.min(this.leastSetup, this.nanos - turned[axis]);
        this.steps.push(port());
        this.stepTimes.push(this.nanos);
        if (this.steps.length === this.stopAtStep) this.stop = true;
      });
    }
    this.servo = []; // lengths of its pulses, us
    let rose = 0;
    gpio[9].addListener((state) => {
      if (state === 1) rose = this.nanos;
      else if (rose) this.servo.push(Math.round((this.nanos - rose) / 1000));
    });
  }

  get cutting() {
    return this.mcu.gpio[6].value === 1;
  }

  /** BOOTSEL, pressed or let go. */
  set bootsel(pressed) {
    this.mcu.qspi[1].setInputValue(!pressed);
  }

  /** The chain of switches at GP7: true is open, stop. */
  set stop(open) {
    this.mcu.gpio[7].setInputValue(open);
  }

  /** 8080 cycles and instructions so far, and the chip's own cycles. */
  get counts() {
    const read = (at) => Number(this.mcu.sramView.getBigUint64(at, true));
    return { cycles: read(0), instructions: read(8), chip: this.mcu.core.cycles };
  }
}
