/** The name of a program: that of the part that it is, of the file that it came from, else by its first REM. */
import { titleOf } from "./works.ts";

/** The file from which a program came, and its title then. */
export interface Origin {
  stem: string;
  title: string;
}

/** The name of a program's files; `isPart`: that of a part of the list, whose title the page tells in its language. */
export interface Name {
  name: string;
  isPart: boolean;
}

/** Characters of a file's name. */
const MOST = 40;

/** A title as a file's name: words with hyphens; "part" where nothing is left of it. */
export function stemOf(title: string): string {
  const words = title.toLowerCase().match(/[\p{L}\p{N}_]+/gu) ?? [];
  let stem = "";
  for (const word of words) {
    const longer = stem ? `${stem}-${word}` : word.slice(0, MOST);
    if (longer.length > MOST) break;
    stem = longer;
  }
  return stem || "part";
}

export const originOf = (file: string, program: string): Origin => ({
  stem: stemOf(file.replace(/\.\w+$/, "")),
  title: titleOf(program),
});

/** `part`: the part whose program this is, letter for letter; `origin`: the file that was opened, while its title stays. */
export function nameFor(program: string, part: string | undefined, origin: Origin | undefined): Name {
  if (part !== undefined) return { name: part, isPart: true };
  const title = titleOf(program);
  return { name: origin && origin.title === title ? origin.stem : stemOf(title), isPart: false };
}
