/** The page's words in English and 中文. Whatever has data-t="key" in the page gets the word as its text, data-l as its name for
 * screen readers and its tooltip. */

export type Language = "en" | "zh";

const WORDS = {
  title: ["SKG: a numerical-control language of 1983, in your browser", "SKG:1983 年的数控语言,在浏览器中运行"],
  tagline: ["The 8080 with its 8 KiB ROM, a teletype, and the part while it is punched", "8080 与 8 KiB ROM、电传打字机,边穿孔边画图"],
  skip: ["To the teletype", "跳到电传打字机"],
  views: ["Views", "视图"],
  parts: ["Parts", "零件"],
  program: ["Program", "程序"],
  teletype: ["Teletype", "电传打字机"],
  drawing: ["Drawing", "图形"],
  blocks: ["Blocks", "程序段"],
  run: ["RUN", "运行 RUN"],
  stop: ["Stop (ctrl-C)", "停止 (ctrl-C)"],
  reset: ["Reset", "复位"],
  open: ["Open…", "打开…"],
  save: ["Save", "保存"],
  saveSkg: ["Program .skg", "程序 .skg"],
  save3b: ["Tape .3b", "纸带 .3b"],
  saveIso: ["ISO G-code", "ISO G 代码"],
  saveSvg: ["Picture .svg", "图片 .svg"],
  saveDxf: ["Drawing .dxf", "图纸 .dxf"],
  saveAll: ["Everything, one file", "全部,一个文件"],
  share: ["Link", "链接"],
  copyLink: ["Copy a link to this program", "复制此程序的链接"],
  copyEmbed: ["Copy the form for other pages", "复制嵌入代码"],
  settings: ["Settings", "设置"],
  speed: ["Speed", "速度"],
  fast: ["As fast as it goes", "全速"],
  real: ["2 MHz, teletype of 110 baud", "2 MHz,110 波特电传"],
  wire: ["Wire, mm", "电极丝直径 mm"],
  theme: ["Colours", "颜色"],
  auto: ["As the system", "跟随系统"],
  light: ["Light", "浅色"],
  dark: ["Dark", "深色"],
  language: ["Language", "语言"],
  manual: ["Manual", "手册"],
  edit: ["Edit", "编辑"],
  load: ["Into the machine", "送入机器"],
  cancel: ["Cancel", "取消"],
  editor: ["Text of the program", "程序文本"],
  noProgram: ["No program in the machine. Type one, or open a part.", "机器里没有程序。请键入,或打开一个零件。"],
  keys: ["Keys", "按键"],
  rubout: ["RUBOUT", "RUBOUT 退格"],
  enter: ["RETURN", "RETURN 回车"],
  sendFile: ["Type a file…", "键入文件…"],
  paper: ["Tear off", "撕纸"],
  fit: ["Whole part", "全图"],
  zoomIn: ["Closer", "放大"],
  zoomOut: ["Farther", "缩小"],
  drawingName: ["Drawing. Plus and minus zoom, arrow keys pan, 0 shows the whole part, N and P choose the next and the last block.",
    "图形。加减键缩放,方向键平移,0 显示全图,N 和 P 选择下一段和上一段。"],
  walk: ["Controller's walk", "控制机走步"],
  play: ["Play", "播放"],
  pause: ["Pause", "暂停"],
  position: ["Place in the walk", "走步位置"],
  walkSpeed: ["Speed of the walk", "走步速度"],
  tape: ["Punched tape", "穿孔纸带"],
  noBlocks: ["No blocks yet: RUN a program or open a tape.", "还没有程序段:请运行程序或打开纸带。"],
  undo: ["Put back what was there", "恢复原来的内容"],
  full: ["Open in the whole page", "在完整页面中打开"],
  byLine: ["line {0}", "行 {0}"],
  stopAfter: ["stop", "停"],
  where: ["x {0}  y {1} mm", "x {0}  y {1} mm"],
  walkAt: ["block {0} of {1} · x {2} y {3} mm · off the contour {4} µm", "第 {0}/{1} 段 · x {2} y {3} mm · 偏离轮廓 {4} µm"],
  closes: ["closes to 0 µm", "闭合误差 0 µm"],
  gap: ["closing error {0}, {1} µm", "闭合误差 {0}, {1} µm"],
  measuring: ["walking through…", "正在走步…"],
  summary: ["{0} blocks · {1} mm", "{0} 段 · {1} mm"],
  partial: ["the tape has no end", "纸带没有结束"],
  busy: ["running", "运行中"],
  prompt: ["at its prompt", "等待命令"],
  input: ["asks for a number", "等待输入"],
  wait: ["waits for a key", "等待按键"],
  waitTape: ["LOAD waits for a tape: open a file, or press ctrl-C", "LOAD 等待纸带:请打开文件或按 ctrl-C"],
  halt: ["halted: push reset", "已停机:请复位"],
  ended: ["ERR {0}: {1}", "ERR {0}:{1}"],
  endedLine: ["ERR {0} in line {2}: {1}", "第 {2} 行 ERR {0}:{1}"],
  err01: ["not understood", "看不懂"],
  err02: ["no such line, RETURN without GOSUB, or too many GOSUBs", "没有该行,RETURN 无 GOSUB,或 GOSUB 过多"],
  err03: ["a name without a value, or O, X, Y assigned", "名字没有值,或给 O、X、Y 赋值"],
  err04: ["these kinds cannot be combined", "类型不能这样组合"],
  err05: ["number out of range", "数超出范围"],
  err06: ["geometry impossible: no crossing, no tangent, no room for a fillet", "几何上不可能:无交点、无切线或圆角放不下"],
  err07: ["the offset leaves nothing of an arc's radius", "偏移后圆弧半径为零或为负"],
  err08: ["out of DATA", "DATA 用完"],
  err09: ["memory full, or the line is too long", "内存满,或行太长"],
  err10: ["broken off, or a block does not fit the tape", "被中断,或程序段超出范围"],
  loaded: ["{0} is in the machine.", "{0} 已送入机器。"],
  tapeRead: ["{0}: {1} blocks.", "{0}:{1} 段。"],
  tapeForeign: ["{0}: {1} blocks, written in another form than this punch's (blanks, line ends, zeros or numbers).",
    "{0}:{1} 段,书写形式与本机不同(空格、行尾、零或编号)。"],
  tapeNoEnd: [" There is no DD at its end.", " 末尾没有 DD。"],
  copied: ["Copied.", "已复制。"],
  copyThis: ["Copy this: {0}", "请复制:{0}"],
  imported: ["{0} is back: program, variables, settings, tape.", "{0} 已恢复:程序、变量、设置、纸带。"],
  badTape: ["{0} is no tape: block {1}, line {2}, column {3}: “{4}” cannot be read.", "{0} 不是纸带:第 {1} 段,第 {2} 行第 {3} 列:“{4}” 无法读取。"],
  badText: ["{0} is no text: byte {1} of it is no ASCII character.", "{0} 不是文本:第 {1} 字节不是 ASCII 字符。"],
  badEmpty: ["{0} is empty.", "{0} 是空的。"],
  badLarge: ["{0} is too large: at most {1} KB are read.", "{0} 太大:最多读取 {1} KB。"],
  badKind: ["{0} is no program, no tape and nothing that this page has saved.", "{0} 不是程序、纸带,也不是本页保存的文件。"],
  badSaved: ["{0} is not whole, or of another version of this page.", "{0} 不完整,或来自其他版本的页面。"],
  noDxf: ["Drawings are not read in the page: skg cut --program makes one of {0}.", "本页不读图纸:请用 skg cut --program 将 {0} 转成程序。"],
  noXy: ["{0} is in another language, which the page does not translate: skg xy and skg tekhtran do.", "{0} 是另一种语言,本页不翻译:请用 skg xy 或 skg tekhtran。"],
  badLink: ["The link is not whole: no program could be read from it.", "链接不完整:无法读出程序。"],
  badPart: ["There is no part {0}.", "没有零件 {0}。"],
  noParts: ["The part list could not be read.", "无法读取零件表。"],
  noStore: ["The browser refuses to keep anything: after a reload the machine will be empty.", "浏览器拒绝存储:刷新后机器将是空的。"],
  noMachine: ["The machine cannot run here ({0}); tapes can still be opened and drawn.", "机器无法在此运行({0});仍可打开和绘制纸带。"],
  noWalk: ["The controller's walk cannot run here ({0}).", "控制机走步无法运行({0})。"],
  stalled: ["Block {0} never ends: the controller does not reach its J.", "第 {0} 段永不结束:控制机达不到 J。"],
  badKept: ["What was kept from the last visit is not whole: the machine begins empty.", "上次保存的内容不完整:机器从空开始。"],
} as const satisfies Record<string, readonly [string, string]>;

export type Word = keyof typeof WORDS;

let present: Language = "en";

/** The language that a browser prefers; English where it is neither. */
export function preferred(languages: readonly string[]): Language {
  for (const one of languages) {
    if (/^zh\b/i.test(one)) return "zh";
    if (/^en\b/i.test(one)) return "en";
  }
  return "en";
}

export function t(word: Word, ...values: readonly (string | number)[]): string {
  return WORDS[word][present === "en" ? 0 : 1].replace(/\{(\d)\}/g, (_, at: string) => String(values[Number(at)] ?? ""));
}

export const isWord = (word: string): word is Word => word in WORDS;

/** Puts the page into a language. */
export function speak(language: Language, page: Document): void {
  present = language;
  page.documentElement.lang = language === "zh" ? "zh-CN" : "en";
  page.title = t("title");
  for (const element of page.querySelectorAll<HTMLElement>("[data-t], [data-l]")) {
    const { t: text, l: name } = element.dataset;
    if (text && isWord(text)) element.textContent = t(text);
    if (name && isWord(name)) {
      element.setAttribute("aria-label", t(name));
      if (element instanceof HTMLButtonElement) element.title = t(name);
    }
  }
}
