import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { deflateSync } from "node:zlib";
import { CATALOGUE } from "../src/catalogue.ts";
import { recognize, tooLarge } from "../src/files.ts";
import { isWord, preferred, t } from "../src/language.ts";
import { LinkError, pack, readLink, unpack } from "../src/link.ts";
import { Keys, withSigns } from "../src/signs.ts";
import { fromBase64, readEverything, Store, toBase64 } from "../src/store.ts";
import { readTape, TapeError } from "../src/tape.ts";
import { View } from "../src/view.ts";

const bytes = (text: string): Uint8Array => Uint8Array.from(text, (character) => character.charCodeAt(0));

test("a link carries every example and opens it again", async () => {
  for (const file of readdirSync("examples").filter((name) => name.endsWith(".skg"))) {
    const program = readFileSync(`examples/${file}`, "latin1");
    const code = await pack(program);
    assert.match(code, /^[\w-]+$/);
    const link = await readLink(`#z=${code}&run&embed`);
    assert.deepEqual(link, { program, run: true, embed: true });
  }
  assert.deepEqual(await readLink("#part=wrench"), { part: "wrench", run: false, embed: false });
  assert.deepEqual(await readLink(""), { run: false, embed: false });
});

test("a link cut short, at any place, or with a wrong character is no program", async () => {
  const code = await pack(readFileSync("examples/wrench.skg", "latin1"));
  for (let length = 0; length < code.length - 1; length += 7) await assert.rejects(unpack(code.slice(0, length)), LinkError);
  await assert.rejects(unpack(code.slice(0, -2)), LinkError);
  const middle = code.length >> 1;
  await assert.rejects(unpack(code.slice(0, middle) + (code[middle] === "A" ? "B" : "A") + code.slice(middle + 1)), LinkError);
  await assert.rejects(unpack("%%%"), LinkError);
  await assert.rejects(unpack(await pack("X".repeat(70_000))), LinkError);
});

test("a link that would unpack to much is left at its limit", async () => {
  const bytes = deflateSync(Buffer.alloc(256 * 1024 * 1024));
  const before = process.memoryUsage().rss;
  await assert.rejects(unpack(bytes.toString("base64url")), LinkError);
  assert.ok(process.memoryUsage().rss - before < 128 * 1024 * 1024);
});

test("files are what they are", () => {
  const kind = (name: string, text: string): string => {
    const found = recognize(name, bytes(text));
    if (found.kind !== "tape") return found.kind === "refused" ? found.why : found.kind;
    try {
      readTape(found.text);
      return "tape";
    } catch (error) {
      return error instanceof TapeError ? "badTape" : "";
    }
  };
  for (const [name, text, expected] of [
    ["a.skg", "10 CUT X\n", "program"],
    ["a.txt", "10 CUT X\r\n20 END", "program"],
    ["a.SKG", "REM direct\n10 A=1", "program"],
    ["a.3b", "B1B2B2GYL1DD", "tape"],
    ["a.txt", "B 1 B 2 B 2 GY L1\nDD", "tape"],
    ["a.TXT", "N 1: B1B2B2GYL1", "tape"],
    ["a.3b", "10 CUT X\n", "badTape"],
    ["a.3b", "", "badEmpty"],
    ["a.skg", " \n", "badEmpty"],
    ["a.skg", "10 REM \xe9\n", "badText"],
    ["a.png", "\x89PNG\r\n\x1a\n", "badKind"],
    ["a.txt", "hello", "badKind"],
    ["a.dxf", "0\nSECTION", "noDxf"],
    ["a.svg", "<svg/>", "noDxf"],
    ["a.NC", "N1G17", "noIso"],
    ["a.xy", "(+)D(0,0)", "noXy"],
    ["a.tkh", "x", "noXy"],
    ["a.json", "{}", "badSaved"],
    ["a.json", '{"format":"skg-page","version":1', "badSaved"],
    ["a.skg", "10 REM\n".repeat(20_000), "badLarge"],
    ["a.json", '{"format":"skg-page","version":1,"kept":null,"settings":{},"tape":""}', "saved"],
    ["a.json", '{"format":"skg-page","version":1,"kept":{"ram":1},"settings":{},"tape":""}', "badSaved"],
  ] as const) {
    assert.equal(kind(name, text), expected, `${name} ${text.slice(0, 20)}`);
  }
  const saved = "10 A=1\r\n\0\0\0\x0020 END\r\n\0\0\0\0\x1a";
  assert.deepEqual(recognize("a.skg", bytes(saved)), { kind: "program", text: "10 A=1\r\n20 END\r\n" });
  assert.equal(tooLarge("a.3b", 20_000_000)?.kind, "refused");
  assert.equal(tooLarge("a.3b", 1_000_000), undefined);
  assert.ok(isWord("badLarge") && t("badTape", "a.3b", 1, 2, 3, "x").includes("a.3b"));
});

test("every word that the page asks for is there", () => {
  const page = readFileSync("web/src/index.html", "utf8");
  const words = [...page.matchAll(/data-[tlh]="(\w+)"/g)].map((match) => match[1] as string);
  assert.ok(words.length > 50);
  for (const word of words) assert.ok(isWord(word), word);
  assert.equal(preferred(["fr", "zh-TW", "en"]), "zh");
  assert.equal(preferred(["en-GB", "zh"]), "en");
  assert.equal(preferred(["ru"]), "en");
});

test("a browser that refuses to keep anything is told of once; what it refused is there until the page is left", () => {
  let refusals = 0;
  const refuse = (): never => {
    throw new Error("no");
  };
  Object.defineProperty(globalThis, "localStorage", { configurable: true, value: { getItem: refuse, setItem: refuse } });
  const store = new Store(() => refusals++);
  store.settings = { speed: "real" };
  store.machine = null;
  assert.equal(store.machine, null);
  assert.deepEqual(store.settings, { speed: "real" });
  assert.ok(store.isRefused);
  assert.equal(refusals, 1);
  const kept = new Map<string, string>([["skg.board", '{"ram":5}']]);
  Object.defineProperty(globalThis, "localStorage", {
    value: { getItem: (key: string) => kept.get(key) ?? null, setItem: (key: string, value: string) => kept.set(key, value) },
  });
  const next = new Store(() => refusals++);
  assert.equal(next.machine, null, "what is not whole is nothing");
  next.settings = { wire: 0.2 };
  next.settings = { theme: "dark" };
  assert.deepEqual(next.settings, { wire: 0.2, theme: "dark" });
  assert.ok(!next.isRefused);
});

test("base64 and saved pages", () => {
  const some = Uint8Array.from({ length: 8192 }, (_, at) => at * 7);
  assert.deepEqual(fromBase64(toBase64(some)), some);
  assert.equal(fromBase64("*"), undefined);
  assert.equal(readEverything("not json"), undefined);
  const saved = { format: "skg-page", version: 1, kept: null, settings: {}, tape: "DD\r\n", made: { name: "a", program: "" } };
  assert.deepEqual(readEverything(JSON.stringify(saved)), saved);
  assert.equal(readEverything(JSON.stringify({ ...saved, made: {} })), undefined);
  assert.equal(readEverything(JSON.stringify({ ...saved, lines: [{}] })), undefined);
  // a tape of 2 MB is opened, so all that is saved beside it is, too
  const large = new TextEncoder().encode(JSON.stringify({ ...saved, tape: "x".repeat(2 ** 21) }));
  assert.equal(recognize("all.json", large).kind, "saved");
});

test("the window zooms about a pixel and shows all of a box", () => {
  const view = new View();
  view.fit([-1000, 0, 9000, 4000], 400, 300);
  for (const corner of [
    [-1000, 0],
    [9000, 4000],
  ] as const) {
    const [x, y] = view.toPixel(corner);
    assert.ok(x >= 0 && x <= 400 && y >= 0 && y <= 300);
  }
  const place = view.toPlace([123, 45]);
  view.zoom(3, [123, 45]);
  const [x, y] = view.toPlace([123, 45]);
  assert.ok(Math.hypot(x - place[0], y - place[1]) < 1e-6);
  view.zoom(1e30, [0, 0]);
  assert.equal(view.scale, 1000);
});

test("a program in UTF-8 is opened, with what the machine has no sign for; a binary is none", () => {
  const program = "10 REM 扳手\n20 END\n";
  assert.deepEqual(recognize("a.skg", new TextEncoder().encode(program)), { kind: "program", text: program });
  assert.deepEqual(recognize("a.txt", new TextEncoder().encode(program)), { kind: "program", text: program });
  for (const bad of ["10 REM \xe9\n", "10 REM \x01\xc3\xa9\n"]) assert.equal(recognize("a.skg", bytes(bad)).kind, "refused");
});

test("signs in other forms become those that the machine has, one for one, as on every other way in", () => {
  assert.equal(withSigns("１０　ＣＵＴ（Ｘ，−５）：“＃”中"), '10 CUT(X,-5):"#"中');
  const theirs = JSON.parse(readFileSync(`${process.env["PAGE_TEST"]}/signs.json`, "utf8")) as string[];
  assert.equal(theirs.length, 0xd800);
  for (const [code, sign] of theirs.entries()) assert.equal(withSigns(String.fromCharCode(code)), sign, code.toString(16));
});

test("a typed line with a character that the machine has not is dropped, and what is typed behind it is not", () => {
  const keys = new Keys();
  assert.deepEqual(keys.feed("PRINT 5−3\r"), { sent: "PRINT 5-3\r", strange: [] });
  assert.deepEqual(keys.feed("PRINT\b 1é2ü"), { sent: "PRINT\b 1\x15", strange: [{ character: "é", column: 7 }] });
  assert.deepEqual(keys.feed("3\x11\r"), { sent: "\x11", strange: [] });
  assert.deepEqual(keys.feed("😀\x15LIST\r"), { sent: "\x15LIST\r", strange: [{ character: "😀", column: 1 }] });
});

test("a link without a program is none", async () => {
  await assert.rejects(unpack(await pack(" \n")), LinkError);
  assert.deepEqual(await readLink("#part="), { run: false, embed: false });
  for (const none of ["#lesson=x", "#lesson=0", "#lesson=", "#lessons="]) await assert.rejects(readLink(none), LinkError, none);
});

test("every part of examples/ has one place in the catalogue", () => {
  const files = readdirSync("examples");
  const programs = files.map((file) => /^(.+)\.(?:skg|xy|tkh)$/.exec(file)?.[1]);
  const parts = new Set(programs.filter((name) => name && files.includes(`${name}.3b`)));
  const listed = CATALOGUE.flatMap((group) => group.parts.map(({ name }) => name)).sort();
  assert.deepEqual(listed, [...parts].sort());
});

test("beside Chinese words stands Chinese punctuation", () => {
  const sources = ["language", "catalogue"].map((name) => readFileSync(`web/src/${name}.ts`, "utf8"));
  const chinese = sources.flatMap((source) => source.match(/"[^"\n]*[\u4e00-\u9fff][^"\n]*"/g) ?? []);
  assert.ok(chinese.length > 200);
  assert.deepEqual(
    chinese.filter((words) => /[\u4e00-\u9fff] ?[,;:!?()]|[,;:!?()] ?[\u4e00-\u9fff]/.test(words)),
    [],
  );
});
