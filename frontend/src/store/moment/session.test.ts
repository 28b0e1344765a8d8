import { expect, it } from 'vitest';
import { treeNode } from '../../../harness/running';
import { IN_PLACE, type EntryAt, type Moment } from '@/store/recording/types';
import { consoleOf, linesUntil, rowsOf } from './session';

const moment = (entries: EntryAt[]): Moment => ({
  t: 1,
  tick: 1,
  tickT: 1,
  durationMs: null,
  generation: 1,
  tree: null,
  files: null,
  statuses: [],
  flashes: [],
  forced: [],
  was: [],
  halted: null,
  entries,
  scene: null,
  sceneId: -1,
  poses: null,
  scan: null,
  pictures: [],
});
const entry = (key: string, more: Partial<EntryAt> = {}): EntryAt => ({
  scope: '',
  key,
  type: 'int',
  value: 1,
  isPreview: false,
  since: 0.5,
  writer: 2,
  ...more,
});

it('makes a row for each line of text, with faults among them, in order', () => {
  const lines = consoleOf({
    lines: [
      { t: 1, source: 'action', level: 'info', text: 'a\nb\n', path: '/x' },
      { t: 3, source: 'flag', level: 'info', text: 'c', path: '' },
    ],
    faults: [
      {
        t: 2,
        uid: 4,
        kind: 'exception',
        file: '',
        line: 0,
        message: 'no',
        traceback: 'Traceback\nno',
        path: '/y',
      },
    ],
  });
  expect(lines.map(({ text, source, time }) => [text, source, time])).toEqual([
    ['a', 'action', 1],
    ['b', 'action', 1],
    ['Traceback', 'action', 2],
    ['no', 'action', 2],
    ['c', 'manager', 3],
  ]);
  expect(linesUntil(lines, 2).map(({ text }) => text)).toEqual(['a', 'b', 'Traceback', 'no']);
  expect(linesUntil(lines, 0.5)).toEqual([]);
});

it('names the writer of a value, where it is known', () => {
  const tree = [treeNode(2, 1, 'Steer::2')];
  const entries = [
    entry('a'),
    entry('b', { writer: 0 }),
    entry('c', { writer: IN_PLACE }),
    entry('d', { writer: null, since: null }),
  ];
  const rows = Object.values(rowsOf(moment(entries), tree)).map(({ key, written }) => [key, written]);
  expect(rows).toEqual([
    ['a', { t: 0.5, by: 'Steer' }],
    ['b', { t: 0.5, by: '' }],
    ['c', { t: 0.5, by: '' }],
    ['d', { t: null, by: null }],
  ]);
});
