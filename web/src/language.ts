/** The page's words in English and 中文. Whatever has data-t="key" in the page gets the word as its text, data-l as its name for
 * screen readers and its tooltip, data-h as the address of a link. */

export type Language = "en" | "zh";

const WORDS = {
  title: ["SKG: a numerical-control language of 1983, in your browser", "SKG：1983 年的数控语言，在浏览器中运行"],
  tagline: [
    "Cut a part by wire: a numerical-control language of 1983 and the 8080 that runs it",
    "线切割编程：1983 年的数控语言，运行在 8080 上",
  ],
  skip: ["To the teletype", "跳到电传打字机"],
  views: ["Views", "视图"],
  parts: ["Parts", "示例零件"],
  program: ["Program", "程序"],
  teletype: ["Teletype", "电传打字机"],
  drawing: ["Drawing", "图形"],
  blocks: ["Blocks", "程序段"],
  run: ["RUN", "运行 RUN"],
  stop: ["Stop (ctrl-C)", "停止（ctrl-C）"],
  reset: ["Reset", "复位"],
  open: ["Open…", "打开…"],
  save: ["Save", "保存"],
  saveSkg: ["Program .skg", "程序 .skg"],
  save3b: ["Tape .3b", "3B 代码 .3b"],
  saveIso: ["ISO G-code", "ISO G 代码"],
  saveSvg: ["Picture .svg", "图片 .svg"],
  saveDxf: ["Drawing .dxf", "图纸 .dxf"],
  saveAll: ["Everything, one file", "全部内容（单个文件）"],
  share: ["Link", "链接"],
  copyLink: ["Copy a link to this program", "复制此程序的链接"],
  copyPicture: ["Copy picture", "复制图片"],
  film: ["Film of the wire", "电极丝动画"],
  filming: ["Recording {0} s of film…", "正在录制 {0} 秒动画…"],
  filmed: ["{0} is saved.", "{0} 已保存。"],
  filmBroken: ["Another tape came: there is no film of {0}.", "换了纸带：{0} 的动画没有录成。"],
  noFilm: ["This browser cannot record films.", "此浏览器不能录制动画。"],
  copyEmbed: ["Copy embed code", "复制嵌入代码"],
  settings: ["Settings", "设置"],
  speed: ["Speed", "速度"],
  fast: ["As fast as it goes", "全速"],
  real: ["2 MHz, teletype of 110 baud", "2 MHz，110 波特电传"],
  wire: ["Wire, mm", "电极丝直径 mm"],
  theme: ["Colours", "颜色"],
  auto: ["As the system", "跟随系统"],
  light: ["Light", "浅色"],
  dark: ["Dark", "深色"],
  language: ["Language", "语言"],
  manual: ["Manual", "手册"],
  about: ["What is this?", "这是什么？"],
  aboutFile: ["about.html", "about.zh.html"],
  manualFile: ["manual.html", "manual.zh.html"],
  machine: ["Machine", "机器"],
  inside: ["Inside the machine", "机器内部"],
  noDebugger: ["The debugger could not be loaded: reload the page with a network.", "无法载入调试器：请联网后重新加载本页。"],
  hold: ["Hold", "暂停"],
  goOn: ["Go on", "继续"],
  stepInstruction: ["Instruction", "单步"],
  stepOver: ["Over a call", "跨过调用"],
  stepUp: ["Up to the caller", "返回调用者"],
  stepOperation: ["Operation", "下一运算"],
  held: ["held", "已暂停"],
  passes: ["passes", "经过"],
  cycles: ["{0} cycles", "{0} 周期"],
  code: ["Instructions", "指令"],
  calls: ["Called from", "调用来源"],
  calculator: ["Calculator", "计算器"],
  floats: ["stack, top last: {0}", "栈（栈顶在最后）：{0}"],
  memory: ["Memory", "内存"],
  memoryFrom: ["From", "起始"],
  stops: ["Stops", "断点"],
  stopAt: ["At", "位置"],
  stopHere: ["Stop at {0}", "在 {0} 停止"],
  enterAddress: ["OK", "确定"],
  noPlace: [
    "{0} is no label of roms/skg.sym, and no hexadecimal address.",
    "{0} 不是 roms/skg.sym 中的标号，也不是十六进制地址。",
  ],
  cancel: ["Cancel", "取消"],
  editor: ["Program, editable", "程序（可编辑）"],
  noProgram: [
    "No program. Type one here or at the teletype, or open a part.",
    "没有程序。请在此处或电传打字机上键入，或打开一个零件。",
  ],
  keys: ["Keys", "按键"],
  rubout: ["RUBOUT", "RUBOUT 退格"],
  enter: ["RETURN", "RETURN 回车"],
  sendFile: ["Type a file…", "按键方式输入文件…"],
  paper: ["Tear off paper", "撕下纸"],
  fit: ["Whole part", "全图"],
  zoomIn: ["Zoom in", "放大"],
  zoomOut: ["Zoom out", "缩小"],
  drawingName: [
    "Drawing. Plus and minus zoom, arrow keys pan, 0 shows the whole part, N and P choose the next and the previous block.",
    "图形。加减键缩放，方向键平移，0 显示全图，N 和 P 选择下一段和上一段。",
  ],
  walk: ["Controller's walk", "加工模拟"],
  play: ["Play", "播放"],
  pause: ["Pause", "暂停"],
  position: ["Place in the walk", "模拟进度"],
  walkSpeed: ["Speed of the walk", "模拟速度"],
  tape: ["Punched tape", "穿孔纸带"],
  noBlocks: ["No blocks yet: RUN a program or open a tape.", "还没有程序段：请运行程序或打开纸带。"],
  full: ["Open in the whole page", "在完整页面中打开"],
  byLine: ["line {0}", "行 {0}"],
  stopAfter: ["stop", "停机（D）"],
  where: ["x {0}  y {1} mm", "x {0}  y {1} mm"],
  walkAt: ["block {0} of {1} · x {2} y {3} mm · off the contour {4} µm", "第 {0}/{1} 段 · x {2} y {3} mm · 与轮廓偏差 {4} µm"],
  closes: ["closes exactly", "完全闭合"],
  gap: ["does not close: {0} µm beside its start in x, {1} µm in y", "未闭合：终点与起点相差 x {0} µm，y {1} µm"],
  measuring: ["walking through…", "正在模拟…"],
  summary: ["{0} blocks · {1} mm", "{0} 段 · {1} mm"],
  partial: ["the tape has no end (DD)", "纸带不完整（缺 DD）"],
  busy: ["running", "运行中"],
  prompt: ["at its prompt", "等待命令"],
  input: ["asks for a number", "等待输入数值"],
  wait: ["waits for a key", "等待按键"],
  waitTape: ["LOAD waits for a tape: open a file, or press ctrl-C", "LOAD 等待纸带：请打开文件或按 ctrl-C"],
  halt: ["halted: push reset", "已停机：请复位"],
  heldState: ["held by the debugger", "被调试器暂停"],
  ended: ["ERR {0}: {1}", "ERR {0}：{1}"],
  endedLine: ["ERR {0} in line {2}: {1}", "第 {2} 行 ERR {0}：{1}"],
  err01: ["not understood", "语法错误"],
  err02: ["no such line, RETURN without GOSUB, or too many GOSUBs", "行号不存在，RETURN 无 GOSUB，或 GOSUB 过多"],
  err03: ["a name without a value, or O, X, Y assigned", "变量未赋值，或给 O、X、Y 赋值"],
  err04: ["these kinds cannot be combined", "运算对象类型不符"],
  err05: ["number out of range", "数值超出范围"],
  err06: ["geometry impossible: no crossing, no tangent, no room for a fillet", "几何无解：无交点、无切线，或过渡圆放不下"],
  err07: ["the offset leaves nothing of an arc's radius", "间隙补偿后圆弧半径不大于零"],
  err08: ["out of DATA", "DATA 数据已读完"],
  err09: ["memory full, or the line is too long", "内存已满，或行过长"],
  err10: ["broken off, or a block does not fit the tape", "运行被中断，或数值超出 3B 格式"],
  tapeRead: ["{0}: {1} blocks.", "{0}：{1} 段。"],
  tapeForeign: [
    "{0}: {1} blocks, written in another form than this punch's (blanks, line ends, zeros or numbers).",
    "{0}：{1} 段，书写形式与本机不同（空格、行尾、零或编号）。",
  ],
  tapeNoEnd: [" There is no DD at its end.", " 末尾没有 DD。"],
  copied: ["Copied.", "已复制。"],
  copyThis: ["Copy this: {0}", "请复制：{0}"],
  imported: ["{0} is back: program, variables, settings, tape, My programs.", "{0} 已恢复：程序、变量、设置、纸带、我的程序。"],
  badTape: [
    "{0} is no tape: block {1}, line {2}, column {3}: “{4}” cannot be read.",
    "{0} 不是纸带：第 {1} 段，第 {2} 行第 {3} 列：“{4}” 无法读取。",
  ],
  badText: ["{0} is no text: byte {1} of it is no ASCII character.", "{0} 不是文本：第 {1} 字节不是 ASCII 字符。"],
  badEmpty: ["{0} is empty.", "{0} 是空的。"],
  badLarge: ["{0} is too large: at most {1} KB are read.", "{0} 太大：最多读取 {1} KB。"],
  badKind: ["{0} is no program, no tape and nothing that this page has saved.", "{0} 不是程序、纸带，也不是本页保存的文件。"],
  badSaved: ["{0} is not whole, or of another version of this page.", "{0} 不完整，或来自其他版本的页面。"],
  noDxf: [
    "Drawings are not opened here: skg ui cuts {0} on the screen, skg cut --program makes a program of it.",
    "此处不能打开图纸：skg ui 可在屏幕上切割 {0}，skg cut --program 可将它转成程序。",
  ],
  noIso: [
    "G-code is not opened here: skg gcode --back makes a tape of {0}.",
    "此处不能打开 G 代码：请用 skg gcode --back 将 {0} 转成 3B 代码。",
  ],
  noXy: [
    "{0} is in another language, which the page does not translate: skg xy and skg tekhtran do.",
    "{0} 是另一种语言，本页不翻译：请用 skg xy 或 skg tekhtran。",
  ],
  badLink: ["The link is not whole: no program could be read from it.", "链接不完整：无法读出程序。"],
  badPart: ["There is no part {0}.", "没有零件 {0}。"],
  noParts: ["The part list could not be read.", "无法读取零件表。"],
  noStore: [
    "The browser refuses to keep anything: after a reload the machine will be empty.",
    "浏览器拒绝存储：刷新后机器将是空的。",
  ],
  noMachine: [
    "The machine cannot run here ({0}); tapes can still be opened and drawn.",
    "机器无法在此运行（{0}）；仍可打开和绘制纸带。",
  ],
  noWalk: ["The controller's walk cannot run here ({0}).", "加工模拟无法运行（{0}）。"],
  stalled: ["Block {0} never ends: the controller does not reach its J.", "第 {0} 段永不结束：计数达不到 J。"],
  badKept: [
    "What was kept from the last visit is not whole: the machine begins empty.",
    "上次保存的内容不完整：已清空，重新开始。",
  ],
  lessons: ["Lessons", "课程"],
  lessonBegin: ["Ten steps: from a point to a part", "十步：从一个点到一个零件"],
  lessonFile: ["lessons.md", "lessons.zh.md"],
  lessonText: ["Words of the step", "本步说明"],
  lessonBefore: ["Back", "上一步"],
  lessonNext: ["Next", "下一步"],
  lessonAgain: ["Begin again", "重新开始"],
  lessonAnswer: ["Answer", "答案"],
  lessonClose: ["Close the lessons", "关闭课程"],
  lessonRight: ["Right: this is the tape that is wanted.", "正确：正是要求的纸带。"],
  lessonOwn: ["Right: one RUN made it, and each contour closes.", "正确：一次运行生成，每个轮廓都闭合。"],
  lessonOpen: ["A contour does not close.", "有一个轮廓不闭合。"],
  lessonRun: ["The page compares the tape of a whole RUN of this program.", "本页比较的是此程序完整运行一次的纸带。"],
  lessonBlock: ["Not yet: block {0} leaves the wanted contour; it is marked.", "还不对：第 {0} 段偏离要求的轮廓，已标出。"],
  lessonMissing: ["Not yet: nothing is cut at x {0}  y {1} mm.", "还不对：x {0}  y {1} mm 处没有切割。"],
  lessonStep: ["{0} has no step: a step begins with ## and its title.", "{0} 没有步骤：每步以 ## 和标题开头。"],
  lessonFence: ["{0}, line {1}: the fence ``` has no end.", "{0} 第 {1} 行：围栏 ``` 没有结尾。"],
  lessonKind: [
    "{0}, line {1}: ```skg, ```skg answer and ```tape stand in a step, written so.",
    "{0} 第 {1} 行：```skg、```skg answer、```tape 要写在步骤之中，并照此书写。",
  ],
  lessonTape: ["{0}, line {1}: this is no 3B block.", "{0} 第 {1} 行：这不是 3B 程序段。"],
  works: ["My programs", "我的程序"],
  deleteWork: ["Delete {0}", "删除 {0}"],
  deleted: ["{0} is deleted.", "{0} 已删除。"],
  undo: ["Undo", "撤销"],
  revert: ["Back to the machine's program", "恢复机器中的程序"],
  dismiss: ["Close this message", "关闭消息"],
  close: ["Close", "关闭"],
  manualAlone: ["Open in a page of its own", "在单独页面中打开"],
  notTaken: [
    "Some lines are not taken: they are marked. The machine keeps its program.",
    "有些行不能接受，已标出。机器中的程序保持不变。",
  ],
  noNumber: ["a line begins with its number", "每行以行号开头"],
  twice: ["line {0} is there twice: the later one would replace the earlier", "行 {0} 出现两次：后一行会取代前一行"],
  dropped: [
    "column {1}: the machine has no character {0}; the line is dropped, RETURN begins another",
    "第 {1} 列：机器没有字符 {0}；此行已丢弃，按回车键另起一行",
  ],
  notAscii: ["the machine has no character {0}: it knows ASCII alone", "机器没有字符 {0}：只能使用 ASCII"],
  stale: ["{0}; program changed: press RUN", "{0}；程序已更改：请按运行"],
  fromFile: ["from the file {0}", "来自文件 {0}"],
  askPartial: [
    "The tape has no end: the run was broken off, or is not over. A machine would stop in the middle of the part.",
    "纸带没有结尾：运行被中断或尚未结束。机床会在零件中途停机。",
  ],
  askStale: [
    "The program was changed after this tape was made: the tape is that of the program before.",
    "此纸带生成后程序已更改：纸带对应更改前的程序。",
  ],
  askPart: ["RUN {0} made this tape: it begins in the middle of the program.", "此纸带由 RUN {0} 生成：不是从程序开头运行的。"],
  askTyped: [
    "Statements typed at the teletype made this tape, or a part of it: it is not the program's.",
    "此纸带全部或部分由电传打字机键入的语句生成，不是程序的纸带。",
  ],
  fromLine: ["{0}, RUN {1}", "{0}，RUN {1}"],
  typed: ["statements typed at the teletype", "电传打字机键入的语句"],
  mixed: ["{0}, and statements typed behind it", "{0}，以及随后键入的语句"],
  punchedProgram: [
    "SAVE has punched the program. The drawing and its tape are as before.",
    "SAVE 已穿孔输出程序。图形及其纸带保持不变。",
  ],
  saveAnyway: ["Save it all the same", "仍然保存"],
  otherTab: [
    "SKG is open in another tab, which keeps the machine now. Programs of this tab are still kept under My programs.",
    "SKG 已在另一个标签页打开，由该页保存机器状态。本页的程序仍保存在“我的程序”中。",
  ],
  keepHere: ["Keep this one", "由本页保存"],
  newVersion: ["A new version of this page is here.", "本页有新版本。"],
  reload: ["Reload", "重新加载"],
  reading: ["Reading {0}…", "正在读取 {0}…"],
  autoRun: ["Run each change", "更改后自动运行"],
  plate: ["Steel plate", "钢板"],
  sound: ["Sound (2 MHz)", "声音（2 MHz）"],
  grid: ["Grid and axes", "网格与坐标轴"],
  before: ["Previous block", "上一段"],
  next: ["Next block", "下一段"],
  measure: ["Measure", "测量"],
  measured: ["distance {0}  dx {1}  dy {2} mm", "距离 {0}  dx {1}  dy {2} mm"],
  legend: ["Legend", "图例"],
  legendHole: ["start hole", "穿丝孔"],
  legendEntry: ["entry into the contour", "切入点"],
  legendCut: ["cut", "切割"],
  legendMove: ["lead-in, positioning", "引入线、空程"],
  legendStop: ["stop (D)", "停机（D）"],
  parameters: ["Numbers to set", "可调参数"],
  welcome1: [
    "This program cuts the wrench that is drawn, with a wire, from a steel plate: SKG computes each block.",
    "这个程序用电极丝从钢板上切出图中的扳手：SKG 计算每一个程序段。",
  ],
  welcome2: ["Then try the plate, the gear, the cam. What you write is kept.", "再试试板、齿轮和凸轮。您写的程序会保存下来。"],
  change: ["change this {0}, and press RUN", "改这个 {0}，然后按运行"],
  time: ["{0} min at 5 mm/min", "{0} 分钟（5 mm/min）"],
  near: ["closes within {0} µm", "闭合误差在 {0} µm 以内"],
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

/** That of two texts which is in the present language. */
export const inPresent = (both: readonly [string, string]): string => both[present === "en" ? 0 : 1];

/** A phrase of both languages in the present one, with values for `{0}`, `{1}`… */
export function phrase(both: readonly [string, string], ...values: readonly (string | number)[]): string {
  return inPresent(both).replace(/\{(\d)\}/g, (_, at: string) => String(values[Number(at)] ?? ""));
}

export const t = (word: Word, ...values: readonly (string | number)[]): string => phrase(WORDS[word], ...values);

/** The language that the page speaks now. */
export const spoken = (): Language => present;

export const isWord = (word: string): word is Word => word in WORDS;

/** Puts the page into a language; `find`: what a name of data-t, data-l or data-h means in it. */
export function speak(language: Language, page: Document, find = ofPage): void {
  present = language;
  page.documentElement.lang = language === "zh" ? "zh-CN" : "en";
  page.title = find("title") ?? "";
  for (const element of page.querySelectorAll<HTMLElement>("[data-t], [data-l], [data-h]")) {
    const [text, name, address] = ["t", "l", "h"].map((key) => find(element.dataset[key] ?? ""));
    if (text) element.textContent = text;
    if (address) element.setAttribute("href", address);
    if (name) {
      element.setAttribute("aria-label", name);
      if (element instanceof HTMLButtonElement) element.title = name;
    }
  }
}

const ofPage = (word: string): string | undefined => (isWord(word) ? t(word) : undefined);
