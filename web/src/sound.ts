/** Sounds of teletype, punch and spark, made by the browser. Silent until they are asked for. */

/** A teletype's characters and a punch's follow each other so fast, s. */
const [CHARACTER, HOLE] = [0.1, 0.05];
/** No more sounds than these wait to be made, s. */
const MOST = 2;

export class Sound {
  #context: AudioContext | undefined;
  #noise: AudioBuffer | undefined;
  #crackle: AudioBufferSourceNode | undefined;
  #isOn = false;
  /** The teletype and the punch are heard at the machine's own speed alone: faster they are no clatter. */
  isReal = false;
  #isCutting = false;
  /** Until then the teletype prints, the punch punches. */
  #printing = 0;
  #punching = 0;

  /** Is asked for by a press of the visitor's, or kept from the last visit: then it begins with the next press. */
  set isOn(isOn: boolean) {
    this.#isOn = isOn;
    if (isOn) this.#begin();
    else void this.#context?.suspend();
    this.#cut();
  }

  /** The teletype prints so many characters. */
  print(characters: number): void {
    if (this.isReal) this.#printing = this.#each(characters, this.#printing, CHARACTER, 1700, 0.25);
  }

  /** The punch makes so many rows of holes. */
  punch(rows: number): void {
    if (this.isReal) this.#punching = this.#each(rows, this.#punching, HOLE, 3400, 0.12);
  }

  /** The wire cuts, or stands. */
  set isCutting(isCutting: boolean) {
    this.#isCutting = isCutting;
    this.#cut();
  }

  constructor() {
    // (a page that is not seen draws no wire: it does not go on there)
    document.addEventListener("visibilitychange", () => this.#cut());
  }

  #begin(): void {
    this.#context ??= new AudioContext();
    const context = this.#context;
    const wake = (): void => {
      if (this.#isOn) void context.resume();
    };
    wake();
    addEventListener("pointerdown", wake, { once: true });
    addEventListener("keydown", wake, { once: true });
    this.#noise ??= noiseOf(context, 0.3, () => 1);
  }

  /** So many strokes, `apart` from each other, behind those that are under way; when they are over. */
  #each(count: number, under: number, apart: number, pitch: number, loud: number): number {
    const context = this.#context;
    if (!this.#isOn || !context || !this.#noise) return 0;
    let at = Math.max(under, context.currentTime);
    for (let stroke = 0; stroke < count && at < context.currentTime + MOST; stroke++) {
      this.#stroke(context, this.#noise, at, pitch, loud);
      at += apart;
    }
    return at;
  }

  /** A stroke of metal: a burst of noise about a pitch, and a thump below it. */
  #stroke(context: AudioContext, noise: AudioBuffer, at: number, pitch: number, loud: number): void {
    const burst = new AudioBufferSourceNode(context, { buffer: noise });
    const band = new BiquadFilterNode(context, { type: "bandpass", frequency: pitch, Q: 1.5 });
    const thump = new OscillatorNode(context, { type: "triangle", frequency: pitch / 14 });
    const level = new GainNode(context, { gain: 0 });
    level.gain.setValueAtTime(loud, at);
    level.gain.exponentialRampToValueAtTime(0.001, at + 0.04);
    burst.connect(band).connect(level);
    thump.connect(level);
    level.connect(context.destination);
    burst.start(at, 0.2 * Math.random(), 0.05);
    thump.start(at);
    thump.stop(at + 0.05);
  }

  #cut(): void {
    const context = this.#context;
    const wants = this.#isOn && this.#isCutting && document.visibilityState === "visible" && context;
    if (!wants) {
      this.#crackle?.stop();
      this.#crackle = undefined;
      return;
    }
    if (this.#crackle) return;
    // (sparks: short strokes of noise at random, few a moment)
    let spark = 0;
    const buffer = noiseOf(context, 2, () => {
      if (Math.random() < 0.0012) spark = 0.3 + 0.7 * Math.random();
      spark *= 0.985;
      return spark;
    });
    this.#crackle = new AudioBufferSourceNode(context, { buffer, loop: true });
    const level = new GainNode(context, { gain: 0.12 });
    this.#crackle
      .connect(new BiquadFilterNode(context, { type: "highpass", frequency: 1800 }))
      .connect(level)
      .connect(context.destination);
    this.#crackle.start();
  }
}

function noiseOf(context: AudioContext, seconds: number, level: () => number): AudioBuffer {
  const buffer = context.createBuffer(1, Math.round(context.sampleRate * seconds), context.sampleRate);
  const samples = buffer.getChannelData(0);
  for (let at = 0; at < samples.length; at++) samples[at] = (2 * Math.random() - 1) * level();
  return buffer;
}
