import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { parseDiagram } from '../serialize';
import { compare, rising, type Operation } from './operations';

interface Case {
  readonly what: string;
  readonly older: unknown;
  readonly newer: unknown;
  readonly operations: readonly Operation[];
  readonly layout: readonly Operation[];
}

// Made by `python -m tests.shared.make_differences`.
const cases = JSON.parse(readFileSync('../tests/shared/differences.json', 'utf-8')) as readonly Case[];

describe('compare', () => {
  it.each(cases)('finds what the translator finds: $what', ({ older, newer, operations, layout }) => {
    const [one, other] = [parseDiagram(older), parseDiagram(newer)];
    expect(compare(one, other).operations).toEqual(operations);
    expect(compare(one, other, true).operations).toEqual(layout);
  });
});

describe('rising', () => {
  it.each([
    [[], []],
    [[3], [0]],
    [
      [2, 0, 1],
      [1, 2],
    ],
    [
      [4, 1, 3, 0, 5],
      [1, 2, 4],
    ],
  ])('keeps the most of %j', (ranks, places) => {
    expect([...rising(ranks)].sort()).toEqual(places);
  });
});
