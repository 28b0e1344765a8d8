import { expect, it } from 'vitest';
import type { Revision } from '@/api/revisions';
import { revision } from '../../../harness/requests';
import { groupRevisions } from './groups';

const save = (number: number, minute: number, more: Partial<Revision> = {}): Revision =>
  revision(number, {
    created_at: new Date(Date.UTC(2026, 0, 1, 10, minute)).toISOString(),
    ...more,
  });

const numbers = (revisions: readonly Revision[]) =>
  groupRevisions(revisions).map(({ saves }) => saves.map(({ number }) => number));

it('groups the saves of one sitting', () => {
  expect(numbers([save(5, 50), save(4, 31), save(3, 30), save(2, 21)])).toEqual([[5], [4, 3, 2]]);
});

it('separates authors, messages and labels', () => {
  const revisions = [
    save(5, 4),
    save(4, 3, { author: 'bob' }),
    save(3, 2),
    save(2, 1, { label: 'works' }),
    save(1, 0),
  ];
  expect(numbers(revisions)).toEqual([[5], [4], [3], [2, 1]]);
  expect(numbers([save(2, 1, { message: 'Import' }), save(1, 0)])).toEqual([[2], [1]]);
});

it('shows the newest save of each group', () => {
  const groups = groupRevisions([save(3, 2), save(2, 1), save(1, 0, { author: 'bob' })]);
  expect(groups.map(({ newest }) => newest.number)).toEqual([3, 1]);
  expect(groupRevisions([])).toEqual([]);
});

it('ends a sitting after ten minutes', () => {
  expect(numbers([save(2, 10), save(1, 0)])).toEqual([[2, 1]]);
  expect(numbers([save(2, 11), save(1, 0)])).toEqual([[2], [1]]);
});
