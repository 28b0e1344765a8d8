import { expect, it } from 'vitest';
import type { Overview } from '@/store/recording/types';
import type { LogLine } from '@/store/session/types';
import { BIT } from '@/store/session/trace/nodeTrace';
import { apart, marksOf, rootStretches } from './strip';

const overview = (more: Partial<Overview> = {}): Overview => ({
  run: 'a',
  read: [[10, 20]],
  root: [
    [10, 'RUNNING'],
    [15, 'FAILURE'],
  ],
  marks: [],
  lines: [],
  faults: [],
  ...more,
});
const line = (time: number, text: string, more: Partial<LogLine> = {}): LogLine => ({
  time,
  text,
  source: 'world',
  level: 'warning',
  node_id: '',
  node_path: '',
  launch_node: '',
  id: time,
  ...more,
});

it('shows what was recorded where that was read, else what the page saw', () => {
  const seen = [{ start: 0, end: 30, mask: BIT.SUCCESS }];
  expect(rootStretches(overview(), seen, 30)).toEqual([
    { start: 0, end: 10, mask: BIT.SUCCESS },
    { start: 20, end: 30, mask: BIT.SUCCESS },
    { start: 10, end: 15, mask: BIT.RUNNING },
    { start: 15, end: 20, mask: BIT.FAILURE },
  ]);
  expect(rootStretches(null, seen, 30)).toEqual(seen);
});

it('marks what the console tells of the last run only', () => {
  const logs = [
    line(3, 'robot bumped into a wall'),
    line(4, '', { run: 2 }),
    line(5, 'robot bumped into a crate'),
    line(6, 'Traceback', { source: 'action', level: 'error' }),
    line(6, 'ValueError', { source: 'action', level: 'error' }),
    line(12, 'robot bumped into a crate'),
  ];
  const read = overview({ marks: [{ t: 12, kind: 'collision', text: 'recorded' }] });
  expect(marksOf(read, logs, 0).map(({ t, kind, text }) => [t, kind, text])).toEqual([
    [5, 'collision', 'robot bumped into a crate'],
    [6, 'fault', 'Traceback'],
    [12, 'collision', 'recorded'],
  ]);
});

it('has the flags and stops of the session in place of the recorded ones of the present run', () => {
  const flag = (id: string, t: number) => ({ t, kind: 'flag' as const, text: id, id });
  const old = { t: 14, kind: 'flag' as const, text: 'of version 2' };
  const read = overview({ marks: [flag('removed', 12), old, { t: 13, kind: 'stopped', text: 'recorded' }] });
  const texts = (own: Parameters<typeof marksOf>[3]) => marksOf(read, [], 0, own).map(({ text }) => text);
  expect(texts([flag('new', 15)])).toEqual(['of version 2', 'new']);
  expect(texts(null)).toEqual(['removed', 'recorded', 'of version 2']);
});

it('leaves out marks under others, and keeps faults', () => {
  const marks = [1, 1.1, 1.2, 5].map((t) => ({
    t,
    kind: t === 1.2 ? ('fault' as const) : ('collision' as const),
    text: '',
  }));
  expect(apart(marks, 0.5).map(({ t }) => t)).toEqual([1.2, 5]);
});
