/** The replacement of a range of a text. It also holds the replaced text, so that it can be undone. */
export interface Splice {
  readonly at: number;
  readonly removed: string;
  readonly inserted: string;
}

/** Returns the single splice that changes one text into another. */
export function difference(before: string, after: string): Splice {
  const most = Math.min(before.length, after.length);
  let head = 0;
  while (head < most && before[head] === after[head]) head += 1;
  let tail = 0;
  while (tail < most - head && before[before.length - 1 - tail] === after[after.length - 1 - tail]) tail += 1;
  return {
    at: head,
    removed: before.slice(head, before.length - tail),
    inserted: after.slice(head, after.length - tail),
  };
}

export const inverse = ({ at, removed, inserted }: Splice): Splice => ({
  at,
  removed: inserted,
  inserted: removed,
});

/** Applies a splice; null if the text is not the one that the splice was made for. */
export function spliced(text: string, { at, removed, inserted }: Splice): string | null {
  if (text.slice(at, at + removed.length) !== removed) return null;
  return text.slice(0, at) + inserted + text.slice(at + removed.length);
}

/** Applies several splices that do not overlap; all offsets refer to the original text. */
export function splicedAll(text: string, splices: readonly Splice[]): string {
  return [...splices].sort((a, b) => b.at - a.at).reduce((now, splice) => spliced(now, splice) ?? now, text);
}
