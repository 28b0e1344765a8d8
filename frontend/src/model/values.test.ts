import { describe, expect, it } from 'vitest';
import { choicesOf, widgetOf } from './ports';
import { fit, namesOf, outside, partRead, typeLabel } from './values';

const COLOR = 'Color[RED;GREEN]';

describe('a type of an enumeration', () => {
  it.each([
    ['GREEN', 'good'],
    ['7', 'good'],
    ['BLUE', 'bad'],
    ['12x', 'loose'],
    ['99999999999', 'range'],
  ])('takes %s: %s', (text, suits) => {
    expect(fit(COLOR, text)).toBe(suits);
  });

  it('has names, which the inspector offers', () => {
    expect(namesOf(COLOR)).toEqual(['RED', 'GREEN']);
    expect([namesOf('list[int]'), namesOf('int')]).toEqual([null, null]);
    expect(choicesOf(COLOR)).toEqual(['RED', 'GREEN']);
    expect(widgetOf(COLOR)).toBe('enum');
  });

  it('is called by its name', () => {
    expect([COLOR, 'list[int]', 'any'].map(typeLabel)).toEqual(['Color', 'list[int]', 'any']);
  });

  it('holds numbers of 32 bits', () => {
    expect(outside(COLOR, '99999999999')).toMatchObject({ number: '99999999999', high: '2147483647' });
    expect(partRead(COLOR, '12x')).toBe('12');
  });
});
