import { act, renderHook } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import type { NodeStatus, ServerMessage, TreeNode } from '@/generated/messages';
import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { feedLastTick } from '@/store/session/trace/lastTick';
import { setViewMode } from '@/store/viewMode';
import { openDiagram } from '../../../harness/canvas';
import { atPresent, useMoment } from './store';
import { askWhy, useShownTick, useWhy } from './why';

const node = (uid: number, parent: number, type: string, node_id: string): TreeNode => ({
  ...{ uid, parent, type, node_id, tree_id: 'Main' },
  ...{ kind: 'Control', name: type, path: type },
});
const nodes = [node(1, 0, 'Sequence', 'r'), node(2, 1, 'Sleep', 'a')];
const tick = (n: number, changed: [number, NodeStatus][]) =>
  feedLastTick({ command: 'tick', data: { n, changed, flashed: [] } } as unknown as ServerMessage);

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: ['a'], conditions: { _skipIf: 'x > 1', _post: 'x = 1' } },
      a: { type: 'Sleep', ports: { msec: '5' } },
    },
  });
  useMoment.setState(atPresent);
  useSessionStore.setState({ ...initialSession, tree: nodes });
  feedLastTick({ command: 'tree', data: {} } as unknown as ServerMessage);
  useRunStore.setState({ ranAt: useProjectStore.getState().changeCounter });
});

describe('the shown tick', () => {
  it('is the last one of the session, and nothing before it or while nobody asks', () => {
    const { result, rerender } = renderHook(({ isWanted }) => useShownTick(isWanted), {
      initialProps: { isWanted: true },
    });
    expect(result.current).toBeNull();
    act(() => {
      tick(1, [[1, 'RUNNING']]);
      tick(2, [[1, 'SUCCESS']]);
    });
    expect(result.current).toMatchObject({ number: 2, isHalted: false });
    expect(result.current?.facts.before.get(1)).toBe('RUNNING');
    expect(result.current?.facts.changed).toEqual([[1, 'SUCCESS']]);
    rerender({ isWanted: false });
    expect(result.current).toBeNull();
  });

  it('knows the pre-conditions only while the tree is as it ran', () => {
    const { result } = renderHook(() => useShownTick(true));
    act(() => tick(1, [[1, 'RUNNING']]));
    expect(result.current?.facts.conditions(1)).toEqual(['_skipIf']);
    expect(result.current?.facts.conditions(2)).toEqual([]);
    act(() => useRunStore.setState({ ranAt: -1 }));
    expect(result.current?.facts.conditions(1)).toBeNull();
  });

  it('is that of the moment while one looks back', () => {
    const { result } = renderHook(() => useShownTick(true));
    act(() =>
      useMoment.setState({
        t: 1,
        tree: nodes.map((node) => ({ ...node, ports: {} })),
        shown: {
          ...{ t: 1, tick: 5, tickT: 1, durationMs: 1, generation: 1, tree: null, files: null },
          ...{ statuses: [[2, 'RUNNING']], was: [[2, 'IDLE']], flashes: [[1, 'SKIPPED']], forced: [1] },
          ...{ entries: [], scene: null, sceneId: -1, poses: null, scan: null, pictures: [], halted: null },
        },
      }),
    );
    expect(result.current).toMatchObject({ number: 5, isHalted: false });
    expect(result.current?.facts).toMatchObject({ changed: [[2, 'RUNNING']], flashed: [[1, 'SKIPPED']] });
    expect(result.current?.facts.forced).toEqual(new Set([1]));
  });
});

it('asking opens the answer, and asks for the focus each time', () => {
  const { asked } = useWhy.getState();
  askWhy();
  askWhy();
  expect(useWhy.getState()).toEqual({ isOpen: true, asked: asked + 2 });
});

it('opens with the basic page, also when it was closed where everything is shown', () => {
  setViewMode('full');
  useWhy.setState({ isOpen: false });
  setViewMode('basic');
  expect(useWhy.getState().isOpen).toBe(true);
  setViewMode('full');
});
