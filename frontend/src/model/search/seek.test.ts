import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { MOST_HITS, replaced, seek, type Hits, type SearchRequest } from './seek';

const ask = (text: string, texts: readonly string[], more: Partial<SearchRequest['query']> = {}) => ({
  query: { text, matchesCase: true, isWholeWord: false, isRegex: false, ...more },
  texts,
});

const hitsOf = (request: Omit<SearchRequest, 'replacement'>, replacement: string | null = null) =>
  seek({ ...request, replacement }) as Hits;

const swap = (text: string, pattern: string, replacement: string): string =>
  replaced(text, hitsOf(ask(pattern, [text], { isRegex: true }), replacement).hits);

const letters = fc.string({ unit: fc.constantFrom('a', 'b', '.', '$', '&', '1', '\n') });

describe('seek', () => {
  it('returns text and place of each hit', () => {
    expect(hitsOf(ask('b', ['ab', '', 'bb']))).toEqual({
      hits: [
        { text: 0, start: 1, end: 2, replacement: '' },
        { text: 2, start: 0, end: 1, replacement: '' },
        { text: 2, start: 1, end: 2, replacement: '' },
      ],
      isCut: false,
    });
  });

  it('finds nothing for an empty text', () => {
    expect(hitsOf(ask('', ['a'])).hits).toEqual([]);
    expect(hitsOf(ask('x*', ['axa'], { isRegex: true })).hits).toHaveLength(1);
  });

  it('stops at the largest number of hits', () => {
    const { hits, isCut } = hitsOf(ask('a', ['a'.repeat(MOST_HITS + 1)]));
    expect([hits.length, isCut]).toEqual([MOST_HITS, true]);
    expect(hitsOf(ask('a', ['a'.repeat(MOST_HITS)])).isCut).toBe(false);
  });

  it('answers with the reason for an invalid expression', () => {
    expect(seek({ ...ask('(', ['a'], { isRegex: true }), replacement: null })).toHaveProperty('wrong');
  });
});

describe('replaced', () => {
  it('equals, for plain text, splitting and joining', () => {
    fc.assert(
      fc.property(letters, fc.string({ minLength: 1, maxLength: 2 }), letters, (text, wanted, after) => {
        const { hits } = hitsOf(ask(wanted, [text]), after);
        expect(replaced(text, hits)).toBe(text.split(wanted).join(after));
      }),
    );
  });

  it('equals, for expressions, String.replace', () => {
    const templates = fc.string({ unit: fc.constantFrom('$', '&', '1', '2', '3', '<', 'n', '>', 'x') });
    fc.assert(
      fc.property(letters, templates, (text, template) => {
        const expression = '(a)(?<n>b)?';
        // Our replacements support neither the text before and after a match nor groups of two digits.
        fc.pre(!/\$[`']/.test(template) && !/\$\d\d/.test(template));
        expect(swap(text, expression, template)).toBe(text.replace(/(a)(?<n>b)?/gm, template));
      }),
    );
  });

  it('applies single hits, in any order', () => {
    const { hits } = hitsOf(ask('a', ['a-a-a']), 'b');
    expect(replaced('a-a-a', hits.slice(1).reverse())).toBe('a-b-b');
    expect(replaced('a-a-a', [])).toBe('a-a-a');
  });

  it('keeps the text around a hit, also with lookarounds', () => {
    expect(swap('max_speed speed', '(?<=_)speed', 'v')).toBe('max_v speed');
    expect(swap('k=1', '(\\w)=(\\d)', '$2=$1')).toBe('1=k');
  });
});
