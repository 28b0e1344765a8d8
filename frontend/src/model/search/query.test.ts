import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compile, type Query } from './query';

const query = (text: string, more: Partial<Query> = {}): Query => ({
  text,
  matchesCase: false,
  isWholeWord: false,
  isRegex: false,
  ...more,
});

const found = (text: string, asked: Query): string[] => {
  const pattern = compile(asked);
  if ('wrong' in pattern) throw new Error(pattern.wrong);
  return [...text.matchAll(pattern)].map(([hit]) => hit);
};

describe('compile', () => {
  it('finds any text as it is written', () => {
    fc.assert(
      fc.property(fc.string({ minLength: 1, unit: 'grapheme' }), (text) => {
        expect(found(`<${text}>`, query(text, { matchesCase: true }))).toContain(text);
      }),
    );
  });

  it('ignores case unless it matters', () => {
    expect(found('Speed speed ÑU ñu', query('speed'))).toEqual(['Speed', 'speed']);
    expect(found('Speed speed', query('speed', { matchesCase: true }))).toEqual(['speed']);
    expect(found('Ñu', query('ñU'))).toEqual(['Ñu']);
  });

  it('finds whole words of any alphabet', () => {
    const word = { isWholeWord: true };
    expect(found('speed speeds max_speed {speed}', query('speed', word))).toHaveLength(2);
    expect(found('año años', query('año', word))).toEqual(['año']);
    expect(found('a ab b', query('a|b', { ...word, isRegex: true }))).toEqual(['a', 'b']);
  });

  it('reads ^ and $ at each line', () => {
    expect(found('one\ntwo', query('^t\\w+$', { isRegex: true }))).toEqual(['two']);
  });

  it.each(['(', '[a', '*', 'a{2,1}', '\\'])('reports why %s is invalid', (text) => {
    const answer = compile(query(text, { isRegex: true }));
    expect(answer).toHaveProperty('wrong');
    expect((answer as { wrong: string }).wrong).toMatch(/^[A-Za-z\\]/);
    expect((answer as { wrong: string }).wrong).not.toContain('/gimu');
  });
});
