/** The line of a hit, in parts: before it, itself, and after it. */
export interface Excerpt {
  readonly before: string;
  readonly hit: string;
  readonly after: string;
  /** From 1. */
  readonly line: number;
}

const BEFORE = 36;
const AFTER = 120;

const isEnd = (text: string, at: number): boolean => text[at] === '\n' || text[at] === '\r';

/** Cuts the line around a hit to what is read at a glance. */
export function excerptOf(text: string, start: number, end: number): Excerpt {
  let from = start;
  while (from > 0 && !isEnd(text, from - 1)) from -= 1;
  let to = end;
  while (to < text.length && !isEnd(text, to)) to += 1;
  const before = text.slice(from, start).trimStart();
  const after = text.slice(end, to).trimEnd();
  return {
    before: before.length > BEFORE ? `…${before.slice(-BEFORE)}` : before,
    hit: shortened(text.slice(start, end)),
    after: after.length > AFTER ? `${after.slice(0, AFTER)}…` : after,
    line: text.slice(0, start).split(/\r\n?|\n/).length,
  };
}

/** A text on one line, cut at its end. */
export function shortened(text: string): string {
  const line = text.replace(/\r\n?|\n/g, '↵');
  return line.length > AFTER ? `${line.slice(0, AFTER)}…` : line;
}
