import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { pieceThatDiffers } from './difference';

const applied = (before: string, after: string) => {
  const piece = pieceThatDiffers(before, after);
  return piece ? before.slice(0, piece.from) + piece.insert + before.slice(piece.to) : before;
};

describe('pieceThatDiffers', () => {
  it.each([
    ['abc', 'abc', null],
    ['abc', 'abXc', { from: 2, to: 2, insert: 'X' }],
    ['abXc', 'abc', { from: 2, to: 3, insert: '' }],
    ['abc', 'aYc', { from: 1, to: 2, insert: 'Y' }],
    ['', 'abc', { from: 0, to: 0, insert: 'abc' }],
    ['abc', '', { from: 0, to: 3, insert: '' }],
    ['aa', 'aaa', { from: 2, to: 2, insert: 'a' }],
    ['aaa', 'aa', { from: 2, to: 3, insert: '' }],
  ])('of %j and %j', (before, after, piece) => {
    expect(pieceThatDiffers(before, after)).toEqual(piece);
  });

  it('turns any text into any other', () => {
    const text = fc.string({ unit: fc.constantFrom('a', 'b', '\n'), maxLength: 12 });
    fc.assert(
      fc.property(text, text, (before, after) => {
        expect(applied(before, after)).toBe(after);
      }),
    );
  });
});
