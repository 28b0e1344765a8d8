import { describe, expect, it } from 'vitest';
import { excerptOf, shortened } from './excerpt';

const of = (text: string, hit: string) => excerptOf(text, text.indexOf(hit), text.indexOf(hit) + hit.length);

describe('excerptOf', () => {
  it('has the line of the hit without its indentation', () => {
    expect(of('one\n    a hit here  \ntwo', 'hit')).toEqual({
      before: 'a ',
      hit: 'hit',
      after: ' here',
      line: 2,
    });
  });

  it.each(['\n', '\r\n', '\r'])('counts the line end %j once', (end) => {
    expect(of(`1${end}2${end}hit${end}4`, 'hit')).toEqual({ before: '', hit: 'hit', after: '', line: 3 });
  });

  it('cuts long lines around the hit', () => {
    const { before, after } = of(`${'x'.repeat(500)}hit${'y'.repeat(500)}`, 'hit');
    expect(before).toBe(`…${'x'.repeat(36)}`);
    expect(after).toBe(`${'y'.repeat(120)}…`);
  });

  it('shows a hit of several lines on one', () => {
    expect(of('a\nb c\nd', 'b c\nd').hit).toBe('b c↵d');
    expect(shortened('x'.repeat(200))).toHaveLength(121);
  });
});
