import { beforeEach, describe, expect, it } from 'vitest';
import type { NodeStatus, ServerMessage } from '@/generated/messages';
import { feedLastTick, useLastTick } from './lastTick';

const tell = (command: string, data: unknown) =>
  feedLastTick({ id: 'e', command, data, seq: 1, t: 0 } as ServerMessage);
const tick = (n: number, changed: [number, NodeStatus][], flashed: [number, NodeStatus][] = []) =>
  tell('tick', { n, changed, flashed, forced: [], duration_ms: 1, past: [] });

beforeEach(() => tell('tree', { nodes: [] }));

describe('the last tick', () => {
  it('has the statuses after it, and those from before of what it changed', () => {
    tell('snapshot', { tree: null, statuses: [[1, 'RUNNING']] });
    tick(7, [
      [2, 'RUNNING'],
      [1, 'SUCCESS'],
    ]);
    tick(8, [[2, 'IDLE']], [[2, 'FAILURE']]);
    expect(useLastTick.getState()).toEqual({
      number: 8,
      statuses: [[1, 'SUCCESS']],
      was: [[2, 'RUNNING']],
      flashes: [[2, 'FAILURE']],
      forced: [],
      halted: null,
    });
  });

  it('knows a halt by its number, and forgets all with another tree', () => {
    tick(3, [[1, 'RUNNING']]);
    const ticked = { statuses: [[1, 'RUNNING']], was: [[1, 'IDLE']] };
    for (const changed of [[[1, 'IDLE']], []] as [number, NodeStatus][][]) {
      tick(3, changed);
      expect(useLastTick.getState()).toMatchObject({ halted: ticked, statuses: [] });
    }
    tell('tree', { nodes: [] });
    expect(useLastTick.getState()).toMatchObject({ number: 0, halted: null });
  });
});
