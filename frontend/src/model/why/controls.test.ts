import { describe, expect, it } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import { CONTROL_RULES } from './controls';
import { readFacts } from './facts';

type Pair = readonly [number, NodeStatus];

/** Returns `code by status` for each of three children, of a control that returned a result. */
function codes(
  type: string,
  result: NodeStatus,
  {
    before = [],
    changed = [],
    flashed = [],
  }: Partial<Record<'before' | 'changed' | 'flashed', readonly Pair[]>>,
): string[] {
  const nodes = [
    { uid: 1, parent: 0, type, kind: 'Control' },
    ...[2, 3, 4].map((uid) => ({ uid, parent: 1, type: 'Act', kind: 'Action' })),
  ];
  const node = readFacts({ nodes, before: new Map(before), changed, flashed, conditions: () => [] }).get(1);
  const verdicts = node ? (CONTROL_RULES[type]?.({ node, result }) ?? []) : [];
  return verdicts.map(({ ticked, reason: { code, by, status } }) =>
    [ticked, code, by, status].filter((part) => part !== undefined).join(' '),
  );
}

describe('the reasons of controls', () => {
  it('a Sequence resumes, continues, and waits', () => {
    const before: Pair[] = [
      [1, 'RUNNING'],
      [2, 'SUCCESS'],
      [3, 'RUNNING'],
    ];
    expect(codes('Sequence', 'RUNNING', { before })).toEqual([
      'no done 2 SUCCESS',
      'yes resumed',
      'no waits 3 RUNNING',
    ]);
    expect(
      codes('Sequence', 'FAILURE', { before, changed: [[3, 'IDLE']], flashed: [[3, 'FAILURE']] }),
    ).toEqual(['no done 2 SUCCESS', 'yes resumed', 'no ended 3 FAILURE']);
  });

  it('an AsyncSequence pauses after a child that succeeded at once', () => {
    expect(codes('AsyncSequence', 'RUNNING', { changed: [[2, 'SUCCESS']] })).toEqual([
      'yes first',
      'no yielded 2 SUCCESS',
      'no yielded 2 SUCCESS',
    ]);
  });

  it('a ReactiveFallback begins with the first child at every tick', () => {
    const before: Pair[] = [[3, 'RUNNING']];
    expect(codes('ReactiveFallback', 'RUNNING', { before, flashed: [[2, 'FAILURE']] })).toEqual([
      'yes each',
      'yes after 2 FAILURE',
      'no waits 3 RUNNING',
    ]);
  });

  it('a Parallel ticks what is not done, until it is decided', () => {
    const before: Pair[] = [
      [1, 'RUNNING'],
      [2, 'SUCCESS'],
      [3, 'RUNNING'],
      [4, 'RUNNING'],
    ];
    expect(codes('Parallel', 'RUNNING', { before })).toEqual(['no done 2 SUCCESS', 'yes all', 'yes all']);
    expect(
      codes('Parallel', 'FAILURE', { before, changed: [[3, 'IDLE']], flashed: [[3, 'FAILURE']] })[2],
    ).toBe('no decided 3 FAILURE');
  });

  it('IfThenElse keeps its choice, WhileDoElse chooses at each tick', () => {
    const before: Pair[] = [
      [1, 'RUNNING'],
      [2, 'SUCCESS'],
      [3, 'RUNNING'],
    ];
    expect(codes('IfThenElse', 'RUNNING', { before })).toEqual([
      'no done 2 SUCCESS',
      'yes chosenEarlier 2 SUCCESS',
      'no notChosenEarlier 2 SUCCESS',
    ]);
    expect(codes('WhileDoElse', 'RUNNING', { before })).toEqual([
      'yes each',
      'yes chosen 2 SUCCESS',
      'no notChosen 2 SUCCESS',
    ]);
  });

  it('a Switch names the child that it chose', () => {
    expect(codes('Switch2', 'RUNNING', { before: [[4, 'RUNNING']] })).toEqual([
      'no otherCase 4',
      'no otherCase 4',
      'yes otherwise',
    ]);
  });

  it('a TryCatch ticks its last child after a failure alone', () => {
    expect(codes('TryCatch', 'RUNNING', { flashed: [[2, 'FAILURE']], changed: [[4, 'RUNNING']] })).toEqual([
      'yes first',
      'no ended 2 FAILURE',
      'yes caught 2 FAILURE',
    ]);
    expect(
      codes('TryCatch', 'SUCCESS', {
        flashed: [
          [2, 'SUCCESS'],
          [3, 'SUCCESS'],
        ],
      })[2],
    ).toBe('no noFailure');
  });

  it('a control without any result of a child was decided by a pre-condition', () => {
    expect(codes('Fallback', 'SKIPPED', {})).toEqual(Array(3).fill('no condition SKIPPED'));
  });
});
