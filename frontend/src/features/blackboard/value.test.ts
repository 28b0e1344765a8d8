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
  ])('shows %s for people', (value, text) => {
    expect(showValue(value)).toBe(text);
  });

  it.each([
    ['0.5', 'double', 0.5],
    ['.5', 'double', 0.5],
    ['5', 'int', 5],
    ['-7', 'uint8', -7],
    ['5', 'string', '5'],
    ['false', 'bool', false],
    ['[1, 2]', 'list', [1, 2]],
    ['{"x": 1}', 'dict', { x: 1 }],
    ['—', 'NoneType', null],
    ['not json', 'Pose', 'not json'],
  ])('reads %s of type %s as the value that it means', (text, type, value) => {
    expect(readValue(text, type)).toEqual({ value });
  });

  it.each([
    ['fast', 'double', 'number'],
    ['', 'float', 'number'],
    ['0,5', 'double', 'number'],
    ['1.5', 'int', 'integer'],
    ['9007199254740993', 'int64', 'integer'],
    ['"a"', 'list', 'list'],
    ['[1', 'list', 'list'],
    ['null', 'dict', 'dict'],
  ])('does not accept %s as a %s', (text, type, wrong) => {
    expect(readValue(text, type)).toEqual({ wrong });
  });
});
