/** The line of a hit in three parts: before the hit, the hit, and after it. */
export interface Excerpt {
  readonly before: string;
  readonly hit: string;
  readonly after: string;
  /** The line number, from 1. */
  readonly line: number;
}

const BEFORE = 36;
const AFTER = 120;

const isEnd = (text: string, at: number): boolean => text[at] === '\n' || text[at] === '\r';

/** Cuts the line around a hit to a length that can be read at a glance. */
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

/** Returns a text as one line, shortened at its end. */
export function shortened(text: string): string {
  const line = text.replace(/\r\n?|\n/g, '↵');
  return line.length > AFTER ? `${line.slice(0, AFTER)}…` : line;
}
