import { describe, expect, it } from 'vitest';
import type { Passage } from '@/model/search/passages';
import { replacementsOf, resultsOf } from './results';

const passages: Passage[] = [
  { path: 'trees/Main.json', place: { node: 'a', field: { part: 'type' } }, text: 'Go' },
  { path: 'trees/Main.json', place: { node: 'a', field: { part: 'name' } }, text: 'Go Go' },
  { path: 'actions/Go.py', place: null, text: 'class Go' },
];
const hit = (text: number, start: number) => ({ text, start, end: start + 2, replacement: 'Run' });
const results = resultsOf(passages, { hits: [hit(0, 0), hit(1, 0), hit(1, 3), hit(2, 6)], isCut: true });

describe('resultsOf', () => {
  it('groups hits by document', () => {
    expect(results.groups.map(({ path, rows }) => [path, rows.length])).toEqual([
      ['trees/Main.json', 3],
      ['actions/Go.py', 1],
    ]);
    expect([results.count, results.isCut]).toEqual([4, true]);
  });
});

describe('replacementsOf', () => {
  it('joins the hits of one text, without those that only refer to something', () => {
    const rows = results.groups.flatMap((group) => group.rows);
    expect(replacementsOf(rows).map(({ passage, hits }) => [passage, hits.length])).toEqual([
      [passages[1], 2],
      [passages[2], 1],
    ]);
  });
});
