import { describe, expect, it } from 'vitest';
import { readValue, showValue } from './value';

describe('values', () => {
  it.each([
    [0.1 + 0.2, '0.3'],
    [3, '3'],
    ['text', 'text'],
    [null, '—'],
    [{ x: 1 }, '{"x":1}'],
    [true, 'true'],
  ])('shows %s as people read it', (value, text) => {
    expect(showValue(value)).toBe(text);
  });

  it('reads what was typed as the value that it stands for', () => {
    expect(readValue('0.5', 'double')).toBe(0.5);
    expect(readValue('5', 'str')).toBe('5');
    expect(readValue('[1, 2]', 'list')).toEqual([1, 2]);
    expect(readValue('not json', 'object')).toBe('not json');
  });
});
