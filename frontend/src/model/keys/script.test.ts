import { describe, expect, it } from 'vitest';
import { keysInScript, renameInScript } from './script';

const rename = (name: string): string => ({ a: 'b', '@a': '@b' })[name] ?? name;

describe('renameInScript', () => {
  it.each([
    ['a := a + 1', 'b := b + 1'],
    ["ab == 'a' && a", "ab == 'a' && b"],
    ['@a > a', '@b > b'],
    ['a ? true : aa', 'b ? true : aa'],
    ['', ''],
  ])('%s becomes %s', (before, after) => {
    expect(renameInScript(before, rename)).toBe(after);
  });

  it('is null for an unreadable script', () => {
    expect(renameInScript('a % 2', rename)).toBeNull();
  });
});

it('finds the keys of a script', () => {
  expect(keysInScript("a := @b; c == true ? 'd' : 1")).toEqual(['a', '@b', 'c']);
  expect(keysInScript('%')).toEqual([]);
});
