import { beforeEach, describe, expect, it } from 'vitest';
import type { TreeNode } from '@/generated/messages';
import { liveKey, pastOf, useLiveStore } from './live';

const live = () => useLiveStore.getState();
const node = (uid: number, node_id: string, tree_id = 'T'): TreeNode => ({
  uid,
  parent: 0,
  type: '',
  kind: '',
  name: '',
  path: '',
  node_id,
  tree_id,
});
const status = (id: string) => live().statuses.get(liveKey('T', id));

beforeEach(() => {
  live().clear();
  live().setTree([node(1, 'a'), node(2, 'b'), node(3, 'b')]);
});

describe('live status', () => {
  it('is stored by diagram and node', () => {
    live().setStatuses([[1, 'RUNNING']]);
    expect([status('a'), status('b')]).toEqual(['RUNNING', undefined]);
  });
  it('of a tree that is used twice is that of the most active instance', () => {
    live().setStatuses([
      [2, 'RUNNING'],
      [3, 'SUCCESS'],
    ]);
    expect(status('b')).toBe('RUNNING');
    live().setStatuses([[2, 'IDLE']]);
    expect(status('b')).toBe('SUCCESS');
  });
  it('repeats the animation of a flash at a limited rate', () => {
    live().flash([[1, 'FAILURE']]);
    const first = live().flashes.get(liveKey('T', 'a'));
    live().flash([[1, 'FAILURE']]);
    expect(live().flashes.get(liveKey('T', 'a'))).toBe(first);
    live().flash([[1, 'SUCCESS']]);
    expect(live().flashes.get(liveKey('T', 'a'))?.status).toBe('SUCCESS');
  });
  it('of the last tick is shown on blocks that are idle again, until the next tick', () => {
    live().setStatuses([[1, 'RUNNING']]);
    live().setPast([
      [1, 'FAILURE'],
      [2, 'SUCCESS'],
      [3, 'FAILURE'],
    ]);
    expect([pastOf(live(), liveKey('T', 'a')), pastOf(live(), liveKey('T', 'b'))]).toEqual([
      undefined,
      'FAILURE',
    ]);
    live().setPast([]);
    expect(pastOf(live(), liveKey('T', 'b'))).toBeUndefined();
  });
  it('draws an unchanged last tick only once', () => {
    live().setPast([[1, 'FAILURE']]);
    const first = live().past;
    live().setPast([[1, 'FAILURE']]);
    expect(live().past).toBe(first);
  });
  it('ends with the run', () => {
    live().setStatuses([[1, 'RUNNING']]);
    live().setFault('a', 'T', 'boom');
    live().clear();
    expect([live().active, live().statuses.size, live().faults.size]).toEqual([false, 0, 0]);
  });

  it('is replaced by that of a moment at once', () => {
    live().setStatuses([[1, 'RUNNING']]);
    let draws = 0;
    const stop = useLiveStore.subscribe(() => (draws += 1));
    const moment = {
      statuses: [[2, 'RUNNING']],
      flashed: [
        [1, 'FAILURE'],
        [2, 'SUCCESS'],
      ],
      halted: null,
      faults: [[3, 'no way']],
    } as const;
    live().setMoment(moment);
    expect(draws).toBe(1);
    expect([status('a'), status('b'), pastOf(live(), liveKey('T', 'a'))]).toEqual([
      undefined,
      'RUNNING',
      'FAILURE',
    ]);
    expect([...live().flashes.keys(), ...live().faults.keys()]).toEqual([
      liveKey('T', 'b'),
      liveKey('T', 'b'),
    ]);
    const { past, flashes, faults } = live();
    live().setMoment(moment);
    expect([live().past === past, live().faults === faults]).toEqual([true, true]);
    expect([...live().flashes]).toEqual([...flashes]);
    const halted = { statuses: [[2, 'RUNNING'] as const], flashes: [] };
    live().setMoment({ ...moment, statuses: [], flashed: [], halted });
    expect(pastOf(live(), liveKey('T', 'b'))).toBe('RUNNING');
    live().setMoment({ statuses: [], flashed: [], halted: null, faults: [] });
    expect([live().statuses.size, live().past.size, live().flashes.size, live().faults.size]).toEqual([
      0, 0, 0, 0,
    ]);
    stop();
  });
});
