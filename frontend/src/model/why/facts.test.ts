import { describe, expect, it } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import { isDone, isOnHalt, readFacts } from './facts';

type Pair = readonly [number, NodeStatus];

const nodes = [
  { uid: 1, parent: 0, type: 'Sequence', kind: 'Control' },
  { uid: 2, parent: 1, type: 'TryCatch', kind: 'Control' },
  { uid: 3, parent: 2, type: 'Act', kind: 'Action' },
  { uid: 4, parent: 2, type: 'Act', kind: 'Action' },
];
const read = (before: readonly Pair[], changed: readonly Pair[], flashed: readonly Pair[]) =>
  readFacts({ nodes, before: new Map(before), changed, flashed, conditions: () => null });

describe('what a tick tells of each node', () => {
  it('a result, or a status that it got, shows that it was ticked; so do those below it', () => {
    const all = read([], [[1, 'RUNNING']], [[3, 'SUCCESS']]);
    expect(all.get(3)).toMatchObject({ isEvident: true, last: 'SUCCESS', isRepeated: false });
    expect(all.get(2)).toMatchObject({ isEvident: true, last: 'RUNNING', before: 'IDLE', after: 'IDLE' });
    expect(all.get(4)).toMatchObject({ isEvident: false, last: null });
    expect(all.get(1)?.children.map(({ uid }) => uid)).toEqual([2]);
  });

  it('a node that starts and is skipped keeps RUNNING, but returned SKIPPED', () => {
    expect(read([], [[3, 'RUNNING']], [[3, 'SKIPPED']]).get(3)).toMatchObject({ last: 'SKIPPED' });
  });

  it('a second result in one tick is noticed', () => {
    expect(read([[3, 'RUNNING']], [], [[3, 'SUCCESS']]).get(3)).toMatchObject({
      isRepeated: true,
      last: 'RUNNING',
    });
    expect(read([], [[3, 'FAILURE']], [[3, 'SUCCESS']]).get(3)).toMatchObject({
      isRepeated: true,
      last: null,
    });
  });

  it('a reset alone is no tick', () => {
    expect(read([[3, 'SUCCESS']], [[3, 'IDLE']], []).get(3)).toMatchObject({ isEvident: false });
  });

  it('the child that a halt of TryCatch ticks does not make it ticked', () => {
    const all = read([[2, 'RUNNING']], [[2, 'IDLE']], [[4, 'SUCCESS']]);
    expect(all.get(4)?.isEvident).toBe(true);
    expect(all.get(2)?.isEvident).toBe(false);
    expect([...all.values()].filter(isOnHalt).map(({ uid }) => uid)).toEqual([2]);
  });

  it('SUCCESS and FAILURE are results that end a node', () => {
    const all: (NodeStatus | null)[] = ['IDLE', 'RUNNING', 'SUCCESS', 'FAILURE', 'SKIPPED', null];
    expect(all.filter(isDone)).toEqual(['SUCCESS', 'FAILURE']);
  });
});
