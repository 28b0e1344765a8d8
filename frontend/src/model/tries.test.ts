import { expect, it } from 'vitest';
import type { PortSpec } from './ports';
import {
  fitOf,
  LARGEST_SEED,
  listFor,
  rangeAround,
  seedsFrom,
  takesRange,
  valuesOfList,
  valuesOfRange,
} from './tries';

const port = (type: string, value: string | null = null): PortSpec => ({
  name: 'p',
  direction: 'input',
  type,
  default: value,
  required: false,
  description: '',
});

it('steps through a range with its ends', () => {
  expect(valuesOfRange({ from: '0.1', to: '0.9', count: '5' }, 'double')).toEqual([
    '0.1',
    '0.3',
    '0.5',
    '0.7',
    '0.9',
  ]);
  expect(valuesOfRange({ from: '5', to: '1', count: '3' }, 'int')).toEqual(['5', '3', '1']);
  expect(valuesOfRange({ from: '0', to: '2', count: '9' }, 'int')).toEqual(['0', '1', '2']);
  expect(valuesOfRange({ from: '2', to: '7', count: '1' }, 'double')).toEqual(['2']);
});

it('refuses a range that is none', () => {
  expect(valuesOfRange({ from: '', to: '1', count: '5' }, 'double')).toBe('noNumber');
  expect(valuesOfRange({ from: '0', to: 'x', count: '5' }, 'double')).toBe('noNumber');
  expect(valuesOfRange({ from: '0', to: '1', count: '2.5' }, 'double')).toBe('badCount');
  expect(valuesOfRange({ from: '0', to: '1', count: '-1' }, 'double')).toBe('badCount');
  expect(valuesOfRange({ from: '0', to: '1', count: '51' }, 'double')).toBe('tooMany');
});

it('reads a list: one a line, and numbers between commas', () => {
  expect(valuesOfList('1, 2\n 2\n\n3', 'double')).toEqual(['1', '2', '3']);
  expect(valuesOfList('a, b\nc', 'string')).toEqual(['a, b', 'c']);
  expect(valuesOfList(' \n', 'string')).toBe('none');
  expect(valuesOfList(Array.from({ length: 51 }, (_, at) => at).join(), 'int')).toBe('tooMany');
});

it('begins around the present value, or with all choices', () => {
  expect(rangeAround(port('double'), '0.3')).toEqual({ from: '0.15', to: '0.45', count: '5' });
  expect(rangeAround(port('int', '4'), null)).toEqual({ from: '2', to: '6', count: '5' });
  expect(rangeAround(port('double'), '{speed}')).toEqual({ from: '0.5', to: '1.5', count: '5' });
  expect(takesRange(port('double'))).toBe(true);
  expect(takesRange(port('bool'))).toBe(false);
  expect(listFor(port('Color[RED;GREEN]'))).toContain('RED\nGREEN');
});

it('begins with both values of a boolean port', () => {
  expect(listFor(port('bool'))).toBe('true\nfalse');
});

it('counts seeds from the first one', () => {
  expect(seedsFrom('7', '3')).toEqual(['7', '8', '9']);
  expect(seedsFrom('-1', '3')).toBe('badSeed');
  expect(seedsFrom('1.5', '3')).toBe('badSeed');
  expect(seedsFrom('', '3')).toBe('badSeed');
  expect(seedsFrom(String(LARGEST_SEED), '2')).toBe('badSeed');
  expect(seedsFrom('1', '0')).toBe('badCount');
  expect(seedsFrom('1', '51')).toBe('tooMany');
});

it('says what does not fit', () => {
  expect(fitOf(port('double'), 'fast')).toBe('bad');
  expect(fitOf(port('double'), '0.5')).toBe('good');
  expect(fitOf(port('double'), '{speed}')).toBe('good');
});
