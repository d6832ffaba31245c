/** The part list in the order in which one gets to know them: groups, and each part's name and what to try, in both languages. */

import { spoken } from "./language.ts";

type Both = readonly [english: string, chinese: string];

export interface Entry {
  name: string;
  title: Both;
  hint?: Both;
  /** A number to change first: its program line, and what stands before it there. */
  change?: Change;
}

export interface Change {
  line: number;
  before: string;
  number: string;
}

export interface Group {
  title: Both;
  parts: readonly Entry[];
}

const part = (name: string, english: string, chinese: string, hint?: Both, change?: Change): Entry => ({
  name,
  title: [english, chinese],
  ...(hint ? { hint } : {}),
  ...(change ? { change } : {}),
});

/** The labels of the parts' sliders. */
const LABELS: Readonly<Record<string, string>> = {
  "module, mm": "模数，mm",
  teeth: "齿数",
  "lift, mm": "升程，mm",
  "base radius, mm": "基圆半径，mm",
};

export const CATALOGUE: readonly Group[] = [
  {
    title: ["First parts", "入门零件"],
    parts: [
      part(
        "plate-fillets",
        "Plate with two holes",
        "带两孔的板",
        ["Change a fillet: line 180, the 8 behind P5.", "改一个过渡圆角：第 180 行 P5 后面的 8。"],
        { line: 180, before: "P5,", number: "8" },
      ),
      part("wrench", "Wrench", "扳手", ["Change the hexagon: line 50, the 8.5.", "改六角孔：第 50 行的 8.5。"], {
        line: 50,
        before: "X:",
        number: "8.5",
      }),
      part("set-gear", "Spur gear", "直齿轮", ["Move the sliders: module and teeth.", "拖动滑块：模数和齿数。"]),
      part("set-cam", "Disc cam", "盘形凸轮", ["Move the sliders: lift and base radius.", "拖动滑块：升程和基圆半径。"]),
    ],
  },
  {
    title: ["Contours and fillets", "轮廓与过渡圆"],
    parts: [
      part("punch", "Punch: the wire outside", "凸模：电极丝在外侧"),
      part("die", "Die: the wire inside", "凹模：电极丝在内侧"),
      part("collet", "Clamp ring with a slit", "带开口的夹紧环"),
      part("cad-tape", "Path drawn in a CAD package", "CAD 软件绘制的路径"),
      part("data-polygon", "Profile from a table", "由数据表给出的轮廓"),
      part("recut", "Rough cut and skim cut", "粗切与精切"),
      part("scale", "One outline at two scales", "同一轮廓的两种比例"),
      part("xy-hexagon", "Hexagonal hole", "六角孔"),
      part("xy-pointer", "Pointer", "指针"),
      part("xy-notched-disc", "Notched disc", "带缺口的圆盘"),
      part("xy-star", "Five-pointed star", "五角星"),
    ],
  },
  {
    title: ["Copies", "复制"],
    parts: [
      part("rep-wheel", "Wheel of ten teeth", "十齿轮"),
      part("ratchet", "Ratchet wheel", "棘轮"),
      part("sym-keyhole", "Keyhole, mirrored", "镜像锁孔"),
      part("gosub-holes", "Flange with six holes", "六孔法兰"),
      part("xy-fig1-loop", "Wheel with eight slots, by a loop", "八槽轮（循环）"),
      part("xy-fig1-rep", "Wheel with eight slots, by copies", "八槽轮（复制）"),
      part("xy-hexagon-rep", "Hexagon of one corner, six times", "一个角点重复六次的六边形"),
    ],
  },
  {
    title: ["Curves", "曲线"],
    parts: [
      part("fit-ellipse", "Ellipse", "椭圆"),
      part("fit-gear", "Spur gear, 20 teeth", "直齿轮，20 齿"),
      part("fit-cam", "Disc cam, two passes", "盘形凸轮，两次切割"),
      part("fit-parabola", "Parabolic mirror", "抛物面镜"),
      part("fit-cycloid", "Cycloid", "摆线"),
      part("fit-epicycloid", "Epicycloid of five arches", "五瓣外摆线"),
      part("fit-hypocycloid", "Hypocycloid of four arches", "四瓣内摆线"),
      part("fit-spiral", "Archimedean spiral cam", "阿基米德螺线凸轮"),
      part("fit-airfoil", "Airfoil section", "翼型"),
      part("fit-cam-constant", "Cam of constant speed", "等速凸轮"),
      part("fit-cam-cycloidal", "Cycloidal cam", "摆线运动凸轮"),
      part("fit-envelope", "Cam of a flat follower", "平底从动件凸轮"),
      part("fit-roller", "Cam of a roller follower", "滚子从动件凸轮"),
      part("fit-tol-cam", "Cam of three lobes, fewer arcs", "三凸起凸轮（减少圆弧段）"),
      part("fit-tol-ellipse", "Ellipse, fewer arcs", "椭圆（减少圆弧段）"),
    ],
  },
  {
    title: ["Constructions, from the SKG book", "几何作图（SKG 书）"],
    parts: [
      part("skg02-circles", "Hole and disc", "孔与圆盘"),
      part("skg03-concentric", "Ring of concentric circles", "同心圆环"),
      part("skg03-parallels", "Bar between parallels", "平行线之间的条"),
      part("skg04-polar", "Points by radius and angle", "极坐标点"),
      part("skg04-rotated-lines", "Pentagon of turned lines", "旋转直线构成的五边形"),
      part("skg06-belts", "Belt lines of two circles", "两圆的公切线"),
      part("skg06-bisector", "Perpendicular bisector", "垂直平分线"),
      part("skg06-tangent-slot", "Slot of tangents", "切线构成的槽"),
      part("skg07-line-circle", "Disc cut in two by a line", "直线分割的圆盘"),
      part("skg07-two-circles", "Lens and union of two circles", "两圆的交与并"),
      part("skg08-foot", "Mirror image of a point", "点的镜像"),
      part("skg08-quasi-mirror", "Half an outline and its image", "半个轮廓及其镜像"),
      part("skg09-line-circle", "Transition from line to circle", "直线与圆的过渡"),
      part("skg09-link", "Link of transition circles", "过渡圆连杆"),
      part("skg09-point-arcs", "Arcs between two points", "两点之间的圆弧"),
      part("skg09-three-points", "Circle through three points", "三点圆"),
    ],
  },
  {
    title: ["From the language XY", "来自 XY 语言"],
    parts: [
      part("xy-book-1-pointer", "Pointer", "指针"),
      part("xy-book-2-hexagon", "Hexagon", "六边形"),
      part("xy-book-3-disc", "Notched disc", "带缺口的圆盘"),
      part("xy-book-3-reversed", "Notched disc, reversed", "带缺口的圆盘（反向）"),
      part("xy-book-fig1", "Wheel with eight slots", "八槽轮"),
      part("xy-book-star", "Star", "五角星"),
      part("xy-die-set", "Punch and die", "凸凹模"),
      part("xy-gear", "Toothed wheel", "齿轮"),
      part("xy-pulley-plate", "Plate for three pulleys", "三滑轮板"),
    ],
  },
  {
    title: ["From the language TEKHTRAN", "来自 TEKHTRAN 语言"],
    parts: [
      part("tkh-bracket", "Bracket", "支架"),
      part("tkh-cam", "Cam of three lobes", "三凸起凸轮"),
      part("tkh-fork", "Fork", "拨叉"),
      part("tkh-maltese", "Maltese cross", "马耳他十字"),
      part("tkh-pointer", "Pointer", "指针"),
      part("tkh-text-centres", "Line of centres", "连心线"),
      part("tkh-text-lines", "Lines", "直线"),
      part("tkh-text-planes", "Planes", "平面"),
      part("tkh-text-points", "Points", "点"),
    ],
  },
];

export const inLanguage = (both: Both, language: string): string => both[language === "zh" ? 1 : 0];

/** A part's title in the present language; undefined where there is no such part. */
export function partTitle(name: string): string | undefined {
  const entry = CATALOGUE.flatMap(({ parts }) => parts).find((each) => each.name === name);
  return entry && inLanguage(entry.title, spoken());
}

/** The number of a part to change first. */
export const changeOf = (name: string): Change | undefined =>
  CATALOGUE.flatMap(({ parts }) => parts).find((each) => each.name === name)?.change;

/** A slider's label, in the present language if it is a part's. */
export const labelOf = (label: string): string => (spoken() === "zh" ? (LABELS[label] ?? label) : label);
