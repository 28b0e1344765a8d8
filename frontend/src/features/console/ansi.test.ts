import { describe, expect, it } from 'vitest';
import { parseAnsi, plainText } from './ansi';

/** Returns a line in which `{1;31}` is replaced by the escape sequence. */
const line = (text: string) => text.replace(/\{([\d;]*)\}/g, '\u001b[$1m');
const styles = (codes: string) => parseAnsi(line(`${codes}x`)).at(-1)?.styles;

describe('parseAnsi', () => {
  it('keeps styles until they are reset', () => {
    expect(parseAnsi(line('a{1;31}b{0}c'))).toEqual([
      { text: 'a', styles: [] },
      { text: 'b', styles: ['bold', 'red'] },
      { text: 'c', styles: [] },
    ]);
    expect(parseAnsi(line('{32}b{}c')).map((span) => span.styles)).toEqual([['green'], []]);
  });

  it.each([
    ['{1}', ['bold']],
    ['{2}', ['dim']],
    ['{4}', ['underline']],
    ['{1;2;4;22}', ['underline']],
    ['{1;4;24}', ['bold']],
    ['{1;31;39}', ['bold']],
    ['{1;91;39}', ['bold']],
    ['{30}', ['black']],
    ['{37}', ['white']],
    ['{38}', []],
    ['{90}', ['bright-black']],
    ['{97}', ['bright-white']],
    ['{98}', []],
    ['{31;32}', ['green']],
    ['{91;34}', ['blue']],
    ['{31;94}', ['bright-blue']],
    ['{7}', []],
  ])('reads %s as %j', (codes, expected) => {
    expect(styles(codes)).toEqual(expected);
  });

  it('drops sequences that set no style', () => {
    expect(plainText('x\u001b[2Ky')).toBe('xy');
    expect(parseAnsi('\u001b[2K')).toEqual([{ text: '', styles: [] }]);
    expect(parseAnsi('a\u001b[31Kb').map(({ styles: of }) => of)).toEqual([[], []]);
    expect(plainText(line('{1}a{0}b'))).toBe('ab');
  });
});
