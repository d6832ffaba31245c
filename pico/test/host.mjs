// A USB host for the chip: a computer with a program at each of the two serial lines.
//
// It takes the place of what rp2040js does with buffers, which is gentler than a host: here a packet goes when the host
// asks for it, its DATA0 or DATA1 must be the one expected, a buffer's word must stand before it is made available, and a line
// that no program reads is not asked.
import assert from "node:assert/strict";

const FULL = 1 << 15, DATA1 = 1 << 13, STALL = 1 << 11, AVAILABLE = 1 << 10, LENGTH = 0x3ff;
const BUS_RESET = 1 << 19, SETUP = 1 << 17, SUSPENDED = 1 << 4, RESUMED = 1 << 11;
const PACKET = 64;
const PACKET_NANOS = 60e3, FRAME_NANOS = 1e6;
const EP0_BYTES = 0x100;

/** A serial line as the host sees it. */
class Line {
  constructor(first, endpoint) {
    this.first = first; // its interface
    this.endpoint = endpoint;
    this.open = false;
    this.reads = true; // while open
    this.received = ""; // from the board
    this.sending = []; // to the board
    this.inPid = 0;
    this.outPid = 0;
  }
}

export class Host {
  constructor(chip) {
    this.chip = chip;
    this.usb = chip.mcu.usbCtrl;
    this.view = chip.mcu.usbDPRAMView;
    this.words = new Map(); // buffer control words without AVAILABLE
    this.transfer = null;
    this.awake = false;
    this.tty = new Line(0, 2);
    this.punch = new Line(2, 4);
    this.usb.DPRAMUpdated = (offset, value) => this.#updated(offset, value);
    this.usb.onUSBEnabled = () => (this.enabled = true);
    this.usb.onResetReceived = () => (this.resetSeen = true);
    this.service = chip.clock.createAlarm(() => this.#serve());
    this.frame = chip.clock.createAlarm(() => {
      this.usb.sofFrameNumber = (this.usb.sofFrameNumber + 1) & 0x7ff;
      if (this.awake) this.frame.schedule(FRAME_NANOS);
    });
    this.service.schedule(PACKET_NANOS);
  }

  // ---- packets ----

  #at(endpoint, out) {
    return 0x80 + 8 * endpoint + 4 * out;
  }

  #word(endpoint, out) {
    return this.view.getUint32(this.#at(endpoint, out), true);
  }

  #bytesAt(endpoint, out) {
    return endpoint ? this.view.getUint32(8 * endpoint + 4 * out, true) & 0xffc0 : EP0_BYTES;
  }

  #updated(offset, value) {
    if (offset < 0x80 || offset > 0xfc) return;
    if (value & AVAILABLE) {
      assert.equal(value & ~AVAILABLE, this.words.get(offset), "a buffer's word must stand before it is available");
    }
    this.words.set(offset, value & ~AVAILABLE);
  }

  /** The packet that the device has for the host, or null: it has none yet; "stall". */
  #in(endpoint, pid) {
    const word = this.#word(endpoint, 0);
    if (endpoint === 0 && word & STALL && this.usb.epStallArm & 1) return "stall";
    if (!(word & AVAILABLE)) return null;
    assert.ok(word & FULL && (word & LENGTH) <= PACKET);
    assert.equal(word & DATA1 ? 1 : 0, pid, `endpoint ${endpoint}: DATA0 and DATA1 take turns`);
    const at = this.#bytesAt(endpoint, 0);
    this.view.setUint32(this.#at(endpoint, 0), word & ~(AVAILABLE | FULL), true);
    this.usb.indicateBufferReady(endpoint, false);
    return this.chip.mcu.usbDPRAM.slice(at, at + (word & LENGTH));
  }

  /** Gives the device a packet; false: it has no room yet; "stall". */
  #out(endpoint, pid, bytes) {
    const word = this.#word(endpoint, 1);
    if (endpoint === 0 && word & STALL && this.usb.epStallArm & 2) return "stall";
    if (!(word & AVAILABLE)) return false;
    assert.ok((word & LENGTH) >= bytes.length);
    assert.equal(word & DATA1 ? 1 : 0, pid, `endpoint ${endpoint}: DATA0 and DATA1 take turns`);
    this.chip.mcu.usbDPRAM.set(bytes, this.#bytesAt(endpoint, 1));
    this.view.setUint32(this.#at(endpoint, 1), (word & ~(AVAILABLE | LENGTH)) | FULL | bytes.length, true);
    this.usb.indicateBufferReady(endpoint, true);
    return true;
  }

  #serve() {
    if (this.awake) {
      this.#serveControl();
      for (const line of this.configured ? [this.tty, this.punch] : []) {
        if (line.open && line.reads) {
          const packet = this.#in(line.endpoint, line.inPid);
          if (packet) {
            line.inPid ^= 1;
            line.received += String.fromCharCode(...packet);
          }
        }
        if (line.sending.length && this.#out(line.endpoint, line.outPid, line.sending.slice(0, PACKET))) {
          line.outPid ^= 1;
          line.sending.splice(0, PACKET);
        }
      }
    }
    this.service.schedule(PACKET_NANOS);
  }

  #serveControl() {
    const t = this.transfer;
    if (!t || t.result) return;
    if (t.stage === "data in") {
      const packet = this.#in(0, t.pid);
      if (packet === "stall") t.result = "stall";
      else if (packet) {
        t.pid ^= 1;
        t.bytes.push(...packet);
        assert.ok(t.bytes.length <= t.wanted);
        if (packet.length < PACKET || t.bytes.length === t.wanted) t.stage = "status out";
      }
    } else if (t.stage === "data out") {
      const taken = this.#out(0, 1, t.data);
      if (taken === "stall") t.result = "stall";
      else if (taken) t.stage = "status in";
    } else if (t.stage === "status in") {
      const packet = this.#in(0, 1);
      if (packet === "stall") t.result = "stall";
      else if (packet) {
        assert.equal(packet.length, 0);
        t.result = [];
      }
    } else if (this.#out(0, 1, []) === true) {
      t.result = t.bytes;
    }
  }

  /** A control transfer: bytes that come back, or "stall". */
  control(type, request, value, index, wanted = 0, data = []) {
    const length = data.length || wanted;
    const packet = [type, request, value & 255, value >> 8, index & 255, index >> 8, length & 255, length >> 8];
    for (const out of [0, 1]) this.view.setUint32(this.#at(0, out), 0, true); // a SETUP ends what was before
    this.usb.epStallArm = 0;
    const stage = type & 0x80 ? "data in" : data.length ? "data out" : "status in";
    this.transfer = { stage, wanted, data, pid: 1, bytes: [], result: null };
    this.usb.sendSetupPacket(Uint8Array.from(packet));
    assert.ok(this.chip.run(5000, () => this.transfer.result), `no answer to ${packet}`);
    return this.transfer.result;
  }

  // ---- what computers do ----

  reset() {
    this.awake = true;
    this.frame.schedule(FRAME_NANOS);
    this.configured = false;
    this.resetSeen = false;
    this.usb.sieStatus |= BUS_RESET;
    assert.ok(this.chip.run(1000, () => this.resetSeen));
    this.chip.run(1);
    assert.equal(this.usb.addrEndp, 0);
  }

  /** As Linux and Windows do it, one after the other. Returns the device's descriptors and strings. */
  connect() {
    assert.ok(this.chip.run(1000, () => this.enabled && this.usb.sieCtrl & (1 << 16)), "it does not connect");
    this.reset();
    const device = this.control(0x80, 6, 0x100, 0, 64);
    assert.equal(device.length, 18);
    this.reset();
    assert.deepEqual(this.control(0x00, 5, 42, 0), []);
    this.chip.run(2);
    assert.equal(this.usb.addrEndp, 42, "the address holds behind its own transfer");
    assert.deepEqual(this.control(0x80, 6, 0x100, 0, 18), device);
    assert.equal(this.control(0x80, 6, 0x600, 0, 10), "stall", "no qualifier: full speed alone");
    const head = this.control(0x80, 6, 0x200, 0, 9);
    const configuration = this.control(0x80, 6, 0x200, 0, 255);
    assert.deepEqual(configuration.slice(0, 9), head);
    assert.equal(configuration.length, head[2] | (head[3] << 8));
    const languages = this.control(0x80, 6, 0x300, 0, 255);
    assert.deepEqual(languages, [4, 3, 9, 4]);
    const text = (number) => {
      const bytes = this.control(0x80, 6, 0x300 | number, 0x409, 255);
      assert.deepEqual([bytes[0], bytes[1]], [bytes.length, 3]);
      return Buffer.from(bytes.slice(2)).toString("utf16le");
    };
    const strings = [device[14], device[15], 3, 4].map(text);
    assert.deepEqual(this.control(0x00, 9, 1, 0), []);
    this.configured = true;
    for (const line of [this.tty, this.punch]) line.inPid = line.outPid = 0;
    assert.deepEqual(this.control(0x80, 8, 0, 0, 1), [1]);
    assert.deepEqual(this.control(0x80, 0, 0, 0, 2), [0, 0]);
    return { device, configuration, strings };
  }

  /** A program opens a line: rate, then DTR and RTS. */
  open(line, baud = 115200) {
    const coding = [baud & 255, (baud >> 8) & 255, (baud >> 16) & 255, 0, 0, 0, 8];
    assert.deepEqual(this.control(0x21, 0x20, 0, line.first, 0, coding), []);
    assert.deepEqual(this.control(0xa1, 0x21, 0, line.first, 7), coding);
    line.open = true;
    assert.deepEqual(this.control(0x21, 0x22, 3, line.first), []);
  }

  close(line) {
    assert.deepEqual(this.control(0x21, 0x22, 0, line.first), []);
    line.open = false;
  }

  send(line, text) {
    line.sending.push(...Buffer.from(text, "latin1"));
  }

  break() {
    assert.deepEqual(this.control(0x21, 0x23, 0xffff, 0), []);
    this.chip.run(5);
    assert.deepEqual(this.control(0x21, 0x23, 0, 0), []);
  }

  /** The computer sleeps, or its cable is out. */
  sleep() {
    this.awake = false;
    this.usb.sieStatus |= SUSPENDED;
    this.chip.run(20);
  }

  wake() {
    this.awake = true;
    this.usb.sieStatus = (this.usb.sieStatus & ~SUSPENDED) | RESUMED;
    this.frame.schedule(FRAME_NANOS);
  }
}
