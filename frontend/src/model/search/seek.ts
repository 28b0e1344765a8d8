import { compile, type Query, type WrongQuery } from './query';

/** A search in texts. A worker runs it, since a user's expression can take forever. */
export interface SearchRequest {
  readonly query: Query;
  /**
   * The text that replaces each hit, with references such as `$1` for a regular expression; null: no
   * replacement.
   */
  readonly replacement: string | null;
  readonly texts: readonly string[];
}

export interface Hit {
  /** The index of the text that contains the hit. */
  readonly text: number;
  readonly start: number;
  readonly end: number;
  /** The text that the replacement puts there. */
  readonly replacement: string;
}

export interface Hits {
  readonly hits: readonly Hit[];
  /** There are more hits than are returned. */
  readonly isCut: boolean;
}

export type SearchAnswer = Hits | WrongQuery;

export const MOST_HITS = 1000;

const REFERENCE = /\$(?:(\$)|(&)|(\d\d?)|<([^>]*)>)/g;

/** Returns the replacement for one match; references to unknown groups stay as text. */
function expand(template: string, match: RegExpExecArray): string {
  return template.replace(REFERENCE, (whole, dollar, all, number: string | undefined, name?: string) => {
    if (dollar !== undefined) return '$';
    if (all !== undefined) return match[0];
    if (name !== undefined) return match.groups ? (match.groups[name] ?? '') : whole;
    const index = Number(number);
    return index > 0 && index < match.length ? (match[index] ?? '') : whole;
  });
}

/** Returns all hits of a query in texts, in order; empty matches are left out. */
export function seek({ query, replacement, texts }: SearchRequest): SearchAnswer {
  const pattern = compile(query);
  if ('wrong' in pattern) return pattern;
  const hits: Hit[] = [];
  if (query.text === '') return { hits, isCut: false };
  for (const [index, text] of texts.entries()) {
    for (const match of text.matchAll(pattern)) {
      if (match[0] === '') continue;
      if (hits.length === MOST_HITS) return { hits, isCut: true };
      const after = replacement === null || !query.isRegex ? (replacement ?? '') : expand(replacement, match);
      hits.push({
        text: index,
        start: match.index,
        end: match.index + match[0].length,
        replacement: after,
      });
    }
  }
  return { hits, isCut: false };
}

/** Returns a text with these hits replaced. */
export function replaced(text: string, hits: readonly Omit<Hit, 'text'>[]): string {
  let after = '';
  let at = 0;
  for (const { start, end, replacement } of [...hits].sort((a, b) => a.start - b.start)) {
    after += text.slice(at, start) + replacement;
    at = end;
  }
  return after + text.slice(at);
}
