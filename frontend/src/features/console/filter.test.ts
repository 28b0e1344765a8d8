import { describe, expect, it } from 'vitest';
import type { LogLine } from '@/store/session/types';
import { filterLines, LEVELS, type ConsoleFilter } from './filter';

const line = (text: string, more: Partial<LogLine> = {}): LogLine => ({
  id: 1,
  source: 'action',
  level: 'info',
  text,
  node_id: '',
  node_path: '',
  time: 1,
  launch_node: '',
  ...more,
});

const lines = [
  line('hello'),
  line('care\u001b[31mful', { level: 'warning', source: 'world' }),
  line('why', { level: 'debug', node_path: 'Main/Drive::3' }),
  line('broken', { level: 'error', source: 'launch', launch_node: 'n1' }),
];

const texts = (filter: Partial<ConsoleFilter>) =>
  filterLines(lines, { source: 'all', level: 'debug', search: '', ...filter }).map(({ text }) =>
    text.slice(0, 4),
  );

describe('filterLines', () => {
  it.each([
    [{}, ['hell', 'care', 'why', 'brok']],
    [{ level: 'info' }, ['hell', 'care', 'brok']],
    [{ level: 'warning' }, ['care', 'brok']],
    [{ level: 'error' }, ['brok']],
    [{ source: 'world' }, ['care']],
    [{ source: 'launch' }, ['brok']],
    [{ source: 'launch:n1' }, ['brok']],
    [{ source: 'launch:n2' }, []],
    [{ search: ' HELL ' }, ['hell']],
    [{ search: 'careful' }, ['care']],
    [{ search: 'drive' }, ['why']],
    [{ search: '31m' }, []],
    [{ search: 'e', level: 'warning' }, ['care', 'brok']],
  ] as const)('%j', (filter, expected) => {
    expect(texts(filter)).toEqual(expected);
  });

  it('has the levels in order, the lowest first', () => {
    expect(LEVELS).toEqual(['debug', 'info', 'warning', 'error']);
  });
});

describe('a divider between runs', () => {
  const of = (all: LogLine[], filter: Partial<ConsoleFilter> = {}) =>
    filterLines(all, { source: 'all', level: 'info', search: '', ...filter }).map(
      ({ text, run }) => run ?? text,
    );
  const divider = (run: number) => line('', { run });

  it('passes every filter if it has lines on both sides', () => {
    const all = [line('a'), divider(2), line('b'), line('c', { source: 'world' })];
    expect(of(all)).toEqual(['a', 2, 'b', 'c']);
    expect(of(all, { source: 'action', search: 'b' })).toEqual(['b']);
    expect(of(all, { source: 'action' })).toEqual(['a', 2, 'b']);
  });

  it('is never first, last or repeated', () => {
    expect(of([divider(1), line('a'), divider(2), divider(3), line('b'), divider(4)])).toEqual(['a', 3, 'b']);
  });
});
